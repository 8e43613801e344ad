//! A batch, and its calls compared with the model.

use super::arguments::{Arguments, BatchCall, Buffers};
use super::calls::{Bits, BufferName, Call, PatchRuns, To, Wrong};
use super::memory::{GuardedMemory, Image};
use super::model::Model;
use super::output::{described, put_counts, put_output, put_words};
use std::ptr::null_mut;
use tess_capi::batch::{
    TESS_POINT_F32_APART, TessBatch, TessRange, tess_batch_count, tess_batch_create,
    tess_batch_free, tess_batch_groups, tess_batch_level, tess_batch_patch, tess_batch_reserve,
    tess_batch_run, tess_batch_set_threads, tess_batch_set_triangles,
};
use tess_capi::status::{
    TESS_BUFFER_TOO_SMALL, TESS_LEVEL_UNAVAILABLE, TESS_NULL_POINTER, TESS_OK, TESS_OUT_OF_RANGE,
    TESS_UNKNOWN_VALUE, TessStatus,
};
use tess_capi::types::TessConfig;
use tess_core::{Config, Domain, Order, OutputPrimitive, Partitioning, SplitOrder};
use tess_simd::Level;

/// Elements behind the output that a call on one patch may overwrite.
const OVERRUN: usize = 64;

/// A fault on the observed side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fault {
    /// The first index of the call after a refused one.
    IndexAfterRefusal,
    /// The first byte behind points that have just enough room.
    BehindExact,
}

/// A batch, if there is one, and the memory of its caller.
pub(crate) struct Slot {
    batch: *mut TessBatch,
    config: Config,
    domain: Domain,
    order: Order,
    level: u32,
    buffers: Buffers,
    /// The ranges of the batch that was run last.
    ranges: Vec<TessRange>,
    fault: Option<Fault>,
    was_refused: bool,
}

// A batch may be in one call at a time, on any thread.
unsafe impl Send for Slot {}

impl Drop for Slot {
    fn drop(&mut self) {
        unsafe { tess_batch_free(self.batch) };
    }
}

impl Slot {
    pub(crate) fn new(fault: Option<Fault>) -> Self {
        Self {
            batch: null_mut(),
            config: Config::new(Partitioning::Integer, OutputPrimitive::Point),
            domain: Domain::Quad,
            order: Order::Specification,
            level: 0,
            buffers: std::array::from_fn(|_| GuardedMemory::default()),
            ranges: Vec::new(),
            fault,
            was_refused: false,
        }
    }

    /// Makes a call. Gives its status, or what was wrong.
    pub(crate) fn perform(&mut self, call: &Call) -> Result<TessStatus, String> {
        let status = match call {
            Call::Create { config, level } => self.create(*config, *level),
            Call::Free => {
                unsafe { tess_batch_free(self.batch) };
                self.batch = null_mut();
                Ok(TESS_OK)
            }
            Call::Reserve => {
                self.there_or_null("tess_batch_reserve", unsafe { tess_batch_reserve(self.batch) })
            }
            Call::Triangles { order } => self.set_triangles(*order),
            Call::Pool { threads } => {
                let status = unsafe { tess_batch_set_threads(self.batch, *threads) };
                let expected = if *threads == 0 { TESS_OUT_OF_RANGE } else { self.if_there() };
                answered("tess_batch_set_threads", status, expected)
            }
            Call::Level => self.ask_level(),
            Call::Count { patches: PatchRuns(runs), wrong } => {
                self.call(BatchCall::Count, runs, &To::NOTHING, *wrong)
            }
            Call::Run { patches: PatchRuns(runs), to, wrong } => {
                self.call(BatchCall::Batch, runs, to, *wrong)
            }
            Call::Single { factors, to, wrong } => {
                self.call(BatchCall::Single, &[(1, *factors)], to, *wrong)
            }
            Call::Groups { starts } => self.groups(*starts),
        };
        self.was_refused = status != Ok(TESS_OK);
        status
    }

    fn create(&mut self, numbers: [u32; 4], level: u32) -> Result<TessStatus, String> {
        let [domain, partitioning, output, split] = numbers;
        let config = TessConfig { domain, partitioning, output, split };
        let sentinel = (&raw mut *self).cast();
        let mut made = sentinel;
        let status = unsafe { tess_batch_create(&config, level, &mut made) };
        let is_known = domain < 3 && partitioning < 4 && output < 4 && split < 2 && level < 4;
        let is_there = level == 0
            || Level::ALL.get(level as usize - 1).is_some_and(|level| level.is_available());
        let expected = match (is_known, is_there) {
            (false, _) => TESS_UNKNOWN_VALUE,
            (true, false) => TESS_LEVEL_UNAVAILABLE,
            (true, true) => TESS_OK,
        };
        if status != expected || (made == sentinel) != (status != TESS_OK) {
            return Err(format!("status {status}, not {expected}; the batch is {made:?}"));
        }
        if status == TESS_OK {
            unsafe { tess_batch_free(self.batch) };
            (self.batch, self.level, self.domain) = (made, level, Domain::ALL[domain as usize]);
            self.order = Order::Specification;
            self.config = Config {
                partitioning: Partitioning::ALL[partitioning as usize],
                output: OutputPrimitive::ALL[output as usize],
                split: SplitOrder::ALL[split as usize],
            };
        }
        Ok(status)
    }

    fn ask_level(&self) -> Result<TessStatus, String> {
        let mut level = 9;
        let status = unsafe { tess_batch_level(self.batch, &mut level) };
        let is_right = match (self.batch.is_null(), self.level) {
            (true, _) => level == 9,
            (false, 0) => (1..4).contains(&level),
            (false, asked) => level == asked,
        };
        if is_right {
            return self.there_or_null("tess_batch_level", status);
        }
        Err(format!("level {level}, asked was {}", self.level))
    }

    fn set_triangles(&mut self, number: u32) -> Result<TessStatus, String> {
        let order = [Order::Specification, Order::VertexCache].get(number as usize);
        let status = unsafe { tess_batch_set_triangles(self.batch, number) };
        let expected = order.map_or(TESS_UNKNOWN_VALUE, |_| self.if_there());
        if let (Some(&order), TESS_OK) = (order, status) {
            self.order = order;
        }
        answered("tess_batch_set_triangles", status, expected)
    }

    /// The status of a call that nothing but a missing batch makes fail.
    fn if_there(&self) -> TessStatus {
        if self.batch.is_null() { TESS_NULL_POINTER } else { TESS_OK }
    }

    fn there_or_null(&self, name: &str, status: TessStatus) -> Result<TessStatus, String> {
        answered(name, status, self.if_there())
    }

    /// Counts or tessellates.
    fn call(
        &mut self,
        way: BatchCall,
        runs: &[(u8, Bits)],
        to: &To,
        wrong: Wrong,
    ) -> Result<TessStatus, String> {
        let model = Model::new(self.config, self.domain, self.order, runs);
        let given = Arguments::new(way, &model, to, wrong, &mut self.buffers);
        let mut expected: Vec<Image> = self.buffers.iter().map(GuardedMemory::image).collect();
        let [factors, _, _, _, counts, output] = given.at;
        let status = unsafe {
            match way {
                BatchCall::Count => {
                    tess_batch_count(self.batch, factors.cast(), given.floats, counts.cast())
                }
                BatchCall::Batch => tess_batch_run(
                    self.batch,
                    factors.cast(),
                    given.floats,
                    output.cast(),
                    counts.cast(),
                ),
                BatchCall::Single => {
                    tess_batch_patch(self.batch, factors.cast(), output.cast(), counts.cast())
                }
            }
        };
        given.check(!self.batch.is_null(), status)?;
        if matches!(status, TESS_OK | TESS_BUFFER_TOO_SMALL) {
            put_counts(&mut expected[BufferName::Counts as usize], way, &model);
        }
        if status == TESS_OK && way != BatchCall::Count {
            put_output(&mut expected, &given, &model, to);
            self.plant(&given, &model);
        }
        if status == TESS_OK && way == BatchCall::Single {
            self.leave_overrun(&mut expected, &given, &model, to);
        }
        if status == TESS_OK && way == BatchCall::Batch {
            self.ranges = model.parts().map(|(.., range)| range).collect();
        }
        for part in [
            BufferName::Counts,
            BufferName::Points,
            BufferName::Indices,
            BufferName::Ranges,
            BufferName::Factors,
            BufferName::Output,
        ] {
            let observed = self.buffers[part as usize].image();
            let expected = &expected[part as usize];
            if let Some(at) = expected.first_difference(&observed) {
                return Err(described(part, at, (&observed, expected), &given, &model, to));
            }
        }
        Ok(status)
    }

    /// Anything may lie behind the output of one patch.
    fn leave_overrun(&self, expected: &mut [Image], given: &Arguments, model: &Model, to: &To) {
        let arrays = match to.point_format {
            TESS_POINT_F32_APART => {
                vec![(BufferName::Points, 0, 4), (BufferName::Points, given.capacities[0], 4)]
            }
            _ => vec![(BufferName::Points, 0, 8)],
        };
        let indices = (BufferName::Indices, 0, given.sizes[BufferName::Indices as usize]);
        for (part, first, size) in arrays.into_iter().chain([indices]) {
            let needed = model.sizes()[part as usize - 1];
            let end = given.capacities[part as usize - 1].min(needed + OVERRUN);
            let observed = self.buffers[part as usize].image();
            expected[part as usize].take(&observed, (first + needed) * size..(first + end) * size);
        }
    }

    /// Makes the output wrong if it is to be.
    fn plant(&mut self, given: &Arguments, model: &Model) {
        let [_, indices, _] = model.sizes();
        match self.fault {
            Some(Fault::IndexAfterRefusal) if self.was_refused && indices > 0 => {
                self.buffers[BufferName::Indices as usize].flip(0);
            }
            Some(Fault::BehindExact) if given.way == BatchCall::Batch => {
                self.buffers[BufferName::Points as usize].flip(8 * given.capacities[0]);
            }
            _ => {}
        }
    }

    fn groups(&mut self, starts: [u32; 3]) -> Result<TessStatus, String> {
        let end = |range: &TessRange| {
            (range.first_point + range.points, range.first_index + range.indices)
        };
        let patches = self.ranges.len();
        let place = |start: u32| match start.checked_sub(1) {
            None => (0, 0),
            Some(last) => self.ranges.get(last as usize).map_or((0, 0), end),
        };
        let is_right = starts.is_sorted() && starts[2] as usize <= patches;
        let to = &mut self.buffers[BufferName::Ranges as usize];
        to.fit(48, false);
        let mut expected = to.image();
        let ranges = self.ranges.as_ptr();
        let status =
            unsafe { tess_batch_groups(ranges, patches, starts.as_ptr(), 3, to.start().cast()) };
        if is_right {
            let small = u32::try_from(patches).expect("few patches");
            for (i, (from, to)) in starts.into_iter().zip([starts[1], starts[2], small]).enumerate()
            {
                let ((point, index), (points, indices)) = (place(from), place(to));
                put_words(&mut expected, 4 * i, [point, points - point, index, indices - index]);
            }
        }
        let right = if is_right { TESS_OK } else { TESS_OUT_OF_RANGE };
        if status != right || expected != self.buffers[BufferName::Ranges as usize].image() {
            return Err(format!("status {status}, not {right}, or other groups"));
        }
        Ok(status)
    }
}

fn answered(name: &str, status: TessStatus, expected: TessStatus) -> Result<TessStatus, String> {
    if status == expected {
        Ok(status)
    } else {
        Err(format!("{name}: status {status}, not {expected}"))
    }
}
