//! Makes the calls of a sequence, and compares the results with the model.
//!
//! Every buffer that batches write has a shadow: the words that it must hold. A batch whose output
//! fits changes the beginning of its shadows, and nothing else ever changes. A buffer that equals
//! its shadow was therefore written in the right places and nowhere else.

mod checks;

use crate::bare::{Bare, Pipelines, Runner};
use crate::calls::{Destination, DeviceCall, Kind, Patches, Then};
use crate::common::device::{Machine, POISON};
use crate::common::expected::Expected;
use crate::pulling::Pulling;
use std::collections::VecDeque;
use std::rc::Rc;
use tess_core::{Domain, Patch, PatchFactors};
use tess_gpu::layout::factor_words;
use tess_gpu::{Capacity, IndexType, Limits, Numbering, Plan, Resource, Setup, Written};
use tess_verify::generate::SplitMix64;
use tess_wgpu::Outputs;
use wgpu::BufferUsages as Usage;

/// The numbers of points and of words of indices in the buffers that batches share.
const SHARED: [[usize; 2]; 3] = [[50, 100], [3000, 10_000], [70_000, 150_000]];
pub(crate) const LOW: Limits = Limits { storage_binding: 4 << 20, workgroups: 3 };

/// A buffer that batches write.
struct Store {
    what: String,
    buffer: wgpu::Buffer,
    shadow: Vec<u32>,
    last: Last,
}

/// The last writer of a store: the setup, the factors, and the first word or 16-bit half of each
/// patch.
#[derive(Default)]
struct Last(Option<(Setup, Vec<PatchFactors>, Vec<usize>)>);

/// A batch, and the facts that the model needs.
struct Made {
    runner: Runner,
    setup: Setup,
    count: usize,
    groups: Vec<u32>,
    room: Capacity,
    /// The stores of points and of indices.
    stores: [Option<usize>; 2],
    /// Whether the vertex shader computes the elements that are not stored.
    is_pulled: bool,
}

/// Pipelines that outlive a sequence.
#[derive(Default)]
pub(crate) struct Kept {
    pulling: Pulling,
    bare: Pipelines,
}

/// Everything that lives as long as a sequence, and the pipelines, which outlive it.
pub(crate) struct World<'a> {
    machine: &'a mut Machine,
    kept: &'a mut Kept,
    setups: &'a [Setup],
    /// The buffer of factors and the patches of each domain.
    factors: Vec<(wgpu::Buffer, Vec<PatchFactors>)>,
    limits: Limits,
    stores: Vec<Store>,
    batches: Vec<Rc<Made>>,
    late: VecDeque<(wgpu::CommandEncoder, Vec<Rc<Made>>)>,
    /// The number of compared words.
    pub(crate) words: u64,
    /// The number of batches that ran with output that fitted.
    pub(crate) written: usize,
}

impl<'a> World<'a> {
    /// A world with buffers for the factors of `patches` patches of each domain, of which the first
    /// few are not culled.
    pub(crate) fn new(
        machine: &'a mut Machine,
        kept: &'a mut Kept,
        setups: &'a [Setup],
        patches: u32,
    ) -> Self {
        let some = |domain| {
            let mut all = vec![PatchFactors::uniform(domain, 0.0); patches as usize];
            let some = Patches { kind: Kind::Any, count: patches.min(400), seed: 1 }.of(domain);
            all[..some.len()].clone_from_slice(&some);
            all
        };
        let usage = Usage::STORAGE | Usage::COPY_DST;
        let factors = Domain::ALL.map(|domain| {
            let patches = some(domain);
            (machine.upload(&factor_words(&patches), usage), patches)
        });
        let limits = limit(machine, false);
        let (stores, batches, late) = (Vec::new(), Vec::new(), VecDeque::new());
        let factors = factors.into();
        let mut own = Self {
            machine,
            kept,
            setups,
            factors,
            limits,
            stores,
            batches,
            late,
            words: 0,
            written: 0,
        };
        for (number, [points, indices]) in SHARED.into_iter().enumerate() {
            own.store(format!("points {number}"), 2 * points);
            own.store(format!("indices {number}"), indices);
        }
        own
    }

    /// A store of this many words, which nothing has written.
    fn store(&mut self, what: String, words: usize) -> usize {
        let shadow = vec![POISON; words.max(1)];
        let buffer = self.machine.upload(&shadow, Usage::STORAGE | Usage::COPY_SRC);
        self.stores.push(Store { what, buffer, shadow, last: Last::default() });
        self.stores.len() - 1
    }

    /// Makes a call, and returns what is wrong afterwards.
    pub(crate) fn call(&mut self, call: DeviceCall) -> Result<(), String> {
        match call {
            DeviceCall::Fill { domain, with } => self.fill(domain, with),
            DeviceCall::Make { setup, count, groups, output, is_bare } => {
                let setup = self.setup(setup);
                self.make((setup, is_bare), count, groups, output)?;
            }
            DeviceCall::Run { first, count, then } => return self.run(first, count, then),
            DeviceCall::Late => {
                if let Some((encoder, batches)) = self.late.pop_front() {
                    return self.submit(encoder, &batches);
                }
            }
            DeviceCall::Forget { batch } if !self.batches.is_empty() => {
                self.batches.remove(batch % self.batches.len());
            }
            DeviceCall::Forget { .. } => {}
            DeviceCall::Limit { is_low } => self.limits = limit(self.machine, is_low),
            DeviceCall::Whole { setup, with } => return self.whole(self.setup(setup), with),
            DeviceCall::Refused { setup, wrong } => return self.refused(self.setup(setup), wrong),
        }
        Ok(())
    }

    fn setup(&self, number: usize) -> Setup {
        self.setups[number % self.setups.len()]
    }

    /// The buffer of factors of a domain, and its patches.
    fn factors(&self, domain: Domain) -> &(wgpu::Buffer, Vec<PatchFactors>) {
        &self.factors[position(domain)]
    }

    fn fill(&mut self, domain: Domain, with: Patches) {
        let patches = with.of(domain);
        let words = factor_words(&patches);
        let (buffer, all) = &mut self.factors[position(domain)];
        self.machine.gpu.queue.write_buffer(buffer, 0, bytemuck::cast_slice(&words));
        all[..patches.len()].clone_from_slice(&patches);
    }

    fn make(
        &mut self,
        (setup, is_bare): (Setup, bool),
        count: u32,
        groups: u32,
        output: Destination,
    ) -> Result<(), String> {
        let mut random = SplitMix64::new(u64::from(groups));
        let mut groups: Vec<u32> = (0..groups).map(|_| random.below(count + 1)).collect();
        groups.sort_unstable();
        let (room, stores) = self.room_and_stores(setup, count, output);
        let buffer = |store: Option<usize>| store.map(|store| &self.stores[store].buffer);
        let outputs = match (output, buffer(stores[0]), buffer(stores[1])) {
            (_, Some(points), Some(indices)) => Outputs::Buffers { points, indices },
            (_, _, Some(indices)) => Outputs::Indices { points: room.points, indices },
            (Destination::Count, ..) => Outputs::CountOnly,
            _ => Outputs::Arguments(room),
        };
        let promised =
            self.room(setup, room, stores, matches!(output, Destination::Arguments { .. }));
        let factors = &self.factors[position(setup.domain)].0;
        let runner = if is_bare {
            let given = [
                (Resource::Factors, Some(factors)),
                (Resource::Points, buffer(stores[0])),
                (Resource::Indices, buffer(stores[1])),
            ];
            let given: Vec<_> =
                given.into_iter().filter_map(|(of, buffer)| Some((of, buffer?))).collect();
            // The room of the buffers, even if indices cannot number that many points: the plan
            // must limit that itself.
            let held =
                |store: usize| u32::try_from(self.stores[store].shadow.len() / 2).unwrap_or(0);
            let room = Capacity { points: stores[0].map_or(room.points, held), ..promised };
            let plan = Plan::writing(written(output), setup, count, room, self.limits);
            let plan = plan.with_groups(u32::try_from(groups.len()).unwrap_or(u32::MAX));
            Runner::Bare(Bare::new(
                self.machine,
                &mut self.kept.bare,
                (setup, plan),
                &groups,
                &given,
            ))
        } else {
            let batch =
                self.machine.tessellator.batch_in_groups(setup, count, &groups, factors, outputs);
            let batch = batch.map_err(|error| format!("{setup:?}, {count} patches: {error}"))?;
            Runner::Batch(Box::new(batch))
        };
        let room = promised;
        let is_pulled =
            matches!(output, Destination::Indices { .. } | Destination::Arguments { .. });
        let count = count as usize;
        self.batches.push(Rc::new(Made { runner, setup, count, groups, room, stores, is_pulled }));
        Ok(())
    }

    /// The room that a batch is given, and the stores of its points and indices.
    fn room_and_stores(
        &mut self,
        setup: Setup,
        count: u32,
        output: Destination,
    ) -> (Capacity, [Option<usize>; 2]) {
        let patches = &self.factors(setup.domain).1[..count as usize];
        let needed = needed(setup, patches);
        let room = |points: i32, primitives: i32| Capacity {
            points: needed.points.saturating_add_signed(points),
            primitives: needed.primitives.saturating_add_signed(primitives),
        };
        match output {
            Destination::Count => (Capacity::default(), [None; 2]),
            Destination::Shared { points, indices } => {
                (ALL, [Some(2 * (points % 3)), Some(2 * (indices % 3) + 1)])
            }
            Destination::Own { points, primitives } => {
                let Capacity { points, primitives } = room(points, primitives);
                let points = self.store("own points".to_owned(), 2 * points as usize);
                (ALL, [Some(points), Some(self.indices_for(setup, primitives))])
            }
            Destination::Indices { points, primitives } => {
                let room = room(points, primitives);
                (room, [None, Some(self.indices_for(setup, room.primitives))])
            }
            Destination::Arguments { points, primitives } => (room(points, primitives), [None; 2]),
        }
    }

    /// A store of indices for this many primitives, in whole 8 bytes, because only these are used.
    fn indices_for(&mut self, setup: Setup, primitives: u32) -> usize {
        let bytes = primitives as usize * setup.primitive_bytes() as usize;
        self.store("own indices".to_owned(), bytes.div_ceil(8) * 2)
    }

    /// The room that the documentation promises: whole points, whole 8 bytes of indices, and no
    /// more points than indices can number.
    fn room(
        &self,
        setup: Setup,
        room: Capacity,
        [points, indices]: [Option<usize>; 2],
        is_arguments: bool,
    ) -> Capacity {
        let words = |store: usize| u32::try_from(self.stores[store].shadow.len()).unwrap_or(0);
        let mut room = Capacity {
            points: points.map_or(room.points, |store| words(store) / 2),
            primitives: indices
                .map_or(room.primitives, |store| words(store) / 2 * 8 / setup.primitive_bytes()),
        };
        let is_narrow =
            (setup.index_type, setup.numbering) == (IndexType::U16, Numbering::PerBatch);
        if is_narrow && !is_arguments {
            room.points = room.points.min(65_536);
        }
        room
    }

    fn run(&mut self, first: usize, count: usize, then: Then) -> Result<(), String> {
        let all = self.batches.len();
        if all == 0 {
            return Ok(());
        }
        let chosen: Vec<_> =
            (first..first + count).map(|number| Rc::clone(&self.batches[number % all])).collect();
        let mut encoder = self.machine.gpu.device.create_command_encoder(&Default::default());
        for made in &chosen {
            made.runner.encode(&mut encoder);
        }
        match then {
            Then::Submit => return self.submit(encoder, &chosen),
            Then::Keep => self.late.push_back((encoder, chosen)),
            Then::Drop => drop(encoder),
        }
        Ok(())
    }

    /// Submits batches, updates the shadows by the model, and compares everything.
    fn submit(
        &mut self,
        encoder: wgpu::CommandEncoder,
        batches: &[Rc<Made>],
    ) -> Result<(), String> {
        self.machine.gpu.run(encoder).map_err(|error| error.to_string())?;
        for (number, made) in batches.iter().enumerate() {
            let patches = self.factors(made.setup.domain).1[..made.count].to_vec();
            let expected = Expected::new(made.setup, &patches);
            let of_batch = |what: String| {
                format!("batch {number} of the submission, {:?}: {what}", made.setup)
            };
            self.compare_own(made, &expected).map_err(of_batch)?;
            if made.overflow(&expected) == 0 {
                self.written += usize::from(expected.begins().last() != Some(&[0, 0]));
                self.write(made, &expected, &patches);
            }
        }
        self.compare_stores()
    }

    /// Writes a batch's output to the shadows.
    fn write(&mut self, made: &Made, expected: &Expected<'_>, patches: &[PatchFactors]) {
        let output = expected.output();
        let (begins, each) = (expected.begins(), made.setup.indices_per_primitive() as usize);
        for (kind, store) in made.stores.into_iter().enumerate() {
            let Some(store) = store else { continue };
            let Store { shadow, last, .. } = &mut self.stores[store];
            if kind == 1 && made.setup.index_type == IndexType::U16 {
                for (at, &index) in output[1].iter().enumerate() {
                    let (word, shift) = (&mut shadow[at / 2], 16 * (at % 2));
                    *word = *word & !(0xFFFF << shift) | index << shift;
                }
            } else {
                shadow[..output[kind].len()].copy_from_slice(output[kind]);
            }
            let begin = |begin: &[u32; 2]| begin[kind] as usize * [2, each][kind];
            *last = Last(Some((made.setup, patches.to_vec(), begins.iter().map(begin).collect())));
        }
    }
}

const ALL: Capacity = Capacity { points: u32::MAX, primitives: u32::MAX };

impl Made {
    /// The status's overflow: 1 for points, 2 for primitives.
    fn overflow(&self, expected: &Expected<'_>) -> u32 {
        let [points, primitives] = *expected.begins().last().expect("the end");
        u32::from(points > self.room.points) | u32::from(primitives > self.room.primitives) << 1
    }
}

/// The patches' needs.
fn needed(setup: Setup, patches: &[PatchFactors]) -> Capacity {
    let counts = patches.iter().map(|&patch| Patch::new(setup.config, patch).counts());
    counts.fold(Capacity::default(), |sum, own| Capacity {
        points: sum.points + own.points,
        primitives: sum.primitives + own.primitives,
    })
}

/// The number of a domain.
fn position(domain: Domain) -> usize {
    Domain::ALL.iter().position(|other| *other == domain).unwrap_or(0)
}

/// The kind of plan for this output.
const fn written(output: Destination) -> Written {
    match output {
        Destination::Indices { .. } => Written::Indices,
        Destination::Arguments { .. } => Written::Arguments,
        _ => Written::Everything,
    }
}

/// Limits all batches that are made later. The pipelines stay.
fn limit(machine: &mut Machine, is_low: bool) -> Limits {
    let limits = if is_low { LOW } else { Limits::WEBGPU };
    machine.limit(limits);
    limits
}
