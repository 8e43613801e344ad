//! Arguments of a call, and the refusals that explain what is wrong with them.

use super::calls::{BufferName, Room, To, Wrong};
use super::memory::GuardedMemory;
use super::model::Model;
use std::ffi::c_void;
use std::ptr::null_mut;
use tess_capi::batch::{
    TESS_INDEX_U16, TESS_NUMBERING_PER_BATCH, TESS_POINT_F32_APART, TessBatchCounts,
    TessBatchOutput,
};
use tess_capi::shortage::{
    TESS_BUFFER_INDICES, TESS_BUFFER_POINTS, TESS_BUFFER_RANGES, TessShortage, tess_shortage,
};
use tess_capi::status::{
    TESS_BUFFER_TOO_SMALL, TESS_INDEX_TOO_LARGE, TESS_MISALIGNED, TESS_NULL_POINTER, TESS_OK,
    TESS_OVERLAP, TESS_TOO_LARGE, TESS_UNKNOWN_VALUE, TESS_WRONG_FACTOR_COUNT, TessStatus,
};
use tess_capi::types::TessCounts;

/// The function that is called.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum BatchCall {
    Count,
    Batch,
    Single,
}

/// Every part's buffer, by the number of the part.
pub(crate) type Buffers = [GuardedMemory; 6];

/// The arguments of a call.
pub(crate) struct Arguments {
    pub(crate) way: BatchCall,
    /// Where each part is said to lie.
    pub(crate) at: [*mut c_void; 6],
    /// Floats that there are said to be.
    pub(crate) floats: usize,
    /// Elements that there is said to be room for: points, indices, ranges.
    pub(crate) capacities: [usize; 3],
    /// Bytes of an element of each part.
    pub(crate) sizes: [usize; 6],
    pub(crate) base_vertex: u32,
    /// Statuses that refuse the call before anything is counted.
    refused: Vec<TessStatus>,
    /// Statuses that refuse it then.
    unfit: Vec<TessStatus>,
    /// The first buffer that is too small.
    shortage: Option<TessShortage>,
}

impl Arguments {
    /// Makes the buffers ready.
    pub(crate) fn new(
        way: BatchCall,
        model: &Model,
        to: &To,
        wrong: Wrong,
        buffers: &mut Buffers,
    ) -> Self {
        let counts = if way == BatchCall::Single {
            size_of::<TessCounts>()
        } else {
            size_of::<TessBatchCounts>()
        };
        let index = if to.index_type == TESS_INDEX_U16 { 2 } else { 4 };
        let sizes = [4, 8, index, 16, counts, size_of::<TessBatchOutput>()];
        let needed = model.sizes();
        let capacities = std::array::from_fn(|i| capacity(to.room[i], needed[i], sizes[i + 1]));
        let mut factors = model.factors();
        if wrong == Wrong::Floats {
            factors.push(3.0);
        }
        let real = std::array::from_fn(|i| match i {
            0 => factors.len(),
            1..4 if matches!(to.room[i - 1], Room::Impossible) => needed[i - 1],
            1..4 => capacities[i - 1],
            _ => 1,
        });
        fit(buffers, real, sizes, to.keep);
        let bits: Vec<u8> = factors.iter().flat_map(|factor| factor.to_ne_bytes()).collect();
        buffers[BufferName::Factors as usize].put(&bits);
        let mut arguments = Self {
            way,
            at: std::array::from_fn(|i| match i {
                1..4 if matches!(to.room[i - 1], Room::Absent) => null_mut(),
                _ => buffers[i].start(),
            }),
            floats: factors.len() - usize::from(way == BatchCall::Single && wrong == Wrong::Floats),
            capacities,
            sizes,
            base_vertex: model.base(to.base, largest_index(to)),
            refused: Vec::new(),
            unfit: Vec::new(),
            shortage: None,
        };
        arguments.spoil(wrong);
        arguments.judge_pointers();
        arguments.judge_numbers(to);
        arguments.judge_sizes(model, to);
        let output = arguments.output(to);
        unsafe {
            buffers[BufferName::Output as usize].start().cast::<TessBatchOutput>().write(output)
        };
        arguments
    }

    /// The parts that the function looks at.
    fn parts(&self) -> &'static [BufferName] {
        use BufferName::{Counts, Factors, Indices, Output, Points, Ranges};
        match self.way {
            BatchCall::Count => &[Factors, Counts],
            BatchCall::Batch => &[Factors, Points, Indices, Ranges, Counts, Output],
            BatchCall::Single => &[Factors, Points, Indices, Counts, Output],
        }
    }

    /// Elements that a part is said to have.
    fn elements(&self, part: BufferName) -> usize {
        match part {
            BufferName::Factors => self.floats,
            BufferName::Points | BufferName::Indices | BufferName::Ranges => {
                self.capacities[part as usize - 1]
            }
            BufferName::Counts | BufferName::Output => 1,
        }
    }

    /// Makes pointers wrong.
    fn spoil(&mut self, wrong: Wrong) {
        let used = |part: BufferName| self.parts().contains(&part) && self.elements(part) > 0;
        match wrong {
            Wrong::Null(part) => self.at[part as usize] = null_mut(),
            Wrong::Askew(part) => {
                let pointer = &mut self.at[part as usize];
                *pointer = pointer.wrapping_byte_add(1);
            }
            Wrong::Shared(one, other) if one != other && used(one) && used(other) => {
                let read_alone = |part| part == BufferName::Output;
                if self.way != BatchCall::Count && !read_alone(one) && !read_alone(other) {
                    self.at[one as usize] = self.at[other as usize];
                    self.refused.push(TESS_OVERLAP);
                }
            }
            Wrong::Floats if self.way != BatchCall::Single => {
                self.refused.push(TESS_WRONG_FACTOR_COUNT)
            }
            _ => {}
        }
    }

    fn judge_pointers(&mut self) {
        for &part in self.parts() {
            let (elements, size) = (self.elements(part), self.sizes[part as usize]);
            let alignment = match part {
                BufferName::Counts if self.way == BatchCall::Single => 4,
                BufferName::Counts | BufferName::Output => 8,
                _ => size.min(4),
            };
            let address = self.at[part as usize].addr();
            if elements == 0 {
                continue;
            } else if address == 0 {
                self.refused.push(TESS_NULL_POINTER);
            } else if !address.is_multiple_of(alignment) {
                self.refused.push(TESS_MISALIGNED);
            }
            if elements > isize::MAX.unsigned_abs() / size {
                self.refused.push(TESS_TOO_LARGE);
            }
        }
    }

    fn judge_numbers(&mut self, to: &To) {
        let batch = self.way == BatchCall::Batch && to.numbering > 1;
        if self.way != BatchCall::Count
            && (to.point_format > 2 || to.index_type > 1 || to.memory > 1 || batch)
        {
            self.refused.push(TESS_UNKNOWN_VALUE);
        }
    }

    fn judge_sizes(&mut self, model: &Model, to: &To) {
        let needed = model.sizes();
        let (points, indices) = ((TESS_BUFFER_POINTS, 0), (TESS_BUFFER_INDICES, 1));
        let asked = match self.way {
            BatchCall::Count => vec![],
            BatchCall::Batch if self.has_ranges() => {
                vec![(TESS_BUFFER_RANGES, 2), points, indices]
            }
            BatchCall::Batch | BatchCall::Single => vec![points, indices],
        };
        self.shortage = asked.into_iter().find_map(|(buffer, i)| {
            let (needed, got) = (needed[i], self.capacities[i]);
            (got < needed).then_some(TessShortage { buffer, needed, got })
        });
        self.unfit.extend(self.shortage.map(|_| TESS_BUFFER_TOO_SMALL));
        let end = u64::from(self.base_vertex) + needed[0] as u64;
        let is_numbered = self.way == BatchCall::Batch && to.numbering == TESS_NUMBERING_PER_BATCH;
        if is_numbered && needed[0] > 0 && end - 1 > u64::from(largest_index(to)) {
            self.unfit.push(TESS_INDEX_TOO_LARGE);
        }
    }

    /// Whether the caller wants ranges.
    pub(crate) fn has_ranges(&self) -> bool {
        !self.at[BufferName::Ranges as usize].is_null()
    }

    fn output(&self, to: &To) -> TessBatchOutput {
        let [_, points, indices, ranges, ..] = self.at;
        let [point_capacity, index_capacity, range_capacity] = self.capacities;
        TessBatchOutput {
            points,
            point_capacity,
            indices,
            index_capacity,
            ranges: ranges.cast(),
            range_capacity,
            point_format: to.point_format,
            index_type: to.index_type,
            numbering: to.numbering,
            base_vertex: self.base_vertex,
            memory: to.memory,
        }
    }

    /// Whether an answer is right, the batch being there or not.
    pub(crate) fn check(&self, is_there: bool, status: TessStatus) -> Result<(), String> {
        let mut refused = self.refused.clone();
        if !is_there {
            refused.push(TESS_NULL_POINTER);
        }
        let right = if refused.is_empty() { &self.unfit } else { &refused };
        let is_right = if right.is_empty() { status == TESS_OK } else { right.contains(&status) };
        let right = if right.is_empty() { &vec![TESS_OK] } else { right };
        if !is_right {
            return Err(format!("status {status}, not one of {right:?}"));
        }
        if status == TESS_BUFFER_TOO_SMALL { self.check_shortage() } else { Ok(()) }
    }

    fn check_shortage(&self) -> Result<(), String> {
        let mut told = TessShortage { buffer: 9, needed: 0, got: 0 };
        let status = unsafe { tess_shortage(&mut told) };
        match (status, self.shortage) {
            (TESS_OK, Some(expected)) if told == expected => Ok(()),
            (_, expected) => Err(format!("tess_shortage: {status}, {told:?}, not {expected:?}")),
        }
    }

    /// Where coordinate 0 or 1 of a point lies, in words.
    pub(crate) fn coordinate(&self, to: &To, point: usize, which: usize) -> usize {
        match to.point_format {
            TESS_POINT_F32_APART => which * self.capacities[0] + point,
            _ => 2 * point + which,
        }
    }
}

fn capacity(room: Room, needed: usize, size: usize) -> usize {
    match room {
        Room::Exact => needed,
        Room::More(more) => needed + usize::from(more),
        Room::Short => needed.saturating_sub(1),
        Room::Absent => 0,
        Room::Impossible => isize::MAX.unsigned_abs() / size + 1,
    }
}

fn fit(buffers: &mut Buffers, elements: [usize; 6], sizes: [usize; 6], keep: bool) {
    for (i, buffer) in buffers.iter_mut().enumerate() {
        buffer.fit(elements[i] * sizes[i], keep && (1..4).contains(&i));
    }
}

fn largest_index(to: &To) -> u32 {
    if to.index_type == TESS_INDEX_U16 { u32::from(u16::MAX) } else { u32::MAX }
}
