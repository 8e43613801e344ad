//! The calls of a sequence of frames. Their debug text is code.

use proptest::prelude::*;
use tess_core::{Domain, Partitioning, PatchFactors};
use tess_gpu::{Capacity, Order};
use tess_testkit::pairs::Options;
use tess_verify::generate::SplitMix64;
use tess_wgpu::stage::{Overflow, Points, Room};

/// One call. All except the first kind go to the stage in use, which is stage 0 at first.
#[derive(Clone, Copy, Debug)]
pub(crate) enum StageCall {
    /// Uses another stage, which is built if it is new.
    Use { stage: usize },
    /// Replaces the stage in use by one with another hull or fragment shader, on a tessellator of
    /// its own or on the shared one.
    Rebuild { variant: u32, is_alone: bool },
    /// Gives the patches other factors, by a seed. The encoder that records them may be dropped.
    Give { seed: u64, is_dropped: bool },
    /// Moves the patches by a number of places of the grid, through the uniform or another bind
    /// group.
    Move { by: u32, is_bound: bool },
    /// Sets other groups of patches, which take effect in the next frame.
    Group { groups: u32 },
    /// Sets the number of instances, which takes effect in the next frame.
    Repeat { instances: u32 },
    /// Makes the other material of the stage again, with the factors in its pixels or without.
    Paint { shows_factors: bool },
    /// Prepares and draws a frame of the first `count` patches.
    Frame { count: u32, from: Count, draw: Draw, then: Then },
    /// Draws the last prepared frame again, if it ran.
    Again { draw: Draw },
    /// Submits the oldest frame that was kept.
    Late,
    /// Makes the room that a frame needs.
    MakeRoom { count: u32 },
    /// Makes a call that is refused.
    Refused { wrong: WrongFrame },
}

/// The source of the number of patches.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Count {
    Host,
    Device,
}

/// The part of the output that is drawn.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Draw {
    Everything,
    /// A group, by a number that wraps around.
    One(u32),
    /// Everything, after every stage is prepared in the same encoder.
    AmongOthers,
    /// Everything, by the other material.
    ByAnother,
    /// A group, by the other material.
    OneByAnother(u32),
}

impl Draw {
    pub(crate) const fn is_by_another(self) -> bool {
        matches!(self, Self::ByAnother | Self::OneByAnother(_))
    }
}

/// The fate of a frame.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Then {
    Submit,
    Drop,
    Keep,
}

#[derive(Clone, Copy, Debug)]
pub(crate) enum WrongFrame {
    Count,
    Offset,
    Groups,
    BindGroup,
    Factors,
    /// Draws the frame before the last.
    Old,
}

/// The source of a stage's factors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Source {
    Hull,
    Host,
    Buffer,
}

/// The options of a stage.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StageForm {
    pub(crate) domain: Domain,
    pub(crate) partitioning: Partitioning,
    pub(crate) points: Points,
    pub(crate) source: Source,
    pub(crate) room: Room,
    pub(crate) overflow: Overflow,
    pub(crate) order: Order,
}

/// Rooms, from too small for most frames to large enough for any.
const ROOMS: [Room; 4] = [
    Room::Automatic { most_bytes: 40_000 },
    Room::Exactly(Capacity { points: 300, primitives: 350 }),
    Room::Automatic { most_bytes: 1 << 20 },
    Room::WorstCase,
];

/// A stage with these values of its options.
fn form(row: &[usize]) -> StageForm {
    StageForm {
        domain: [Domain::Quad, Domain::Triangle][row[0]],
        partitioning: Partitioning::ALL[row[1]],
        points: crate::drawing::WAYS[row[2]],
        source: [Source::Hull, Source::Host, Source::Buffer][row[3]],
        room: ROOMS[row[4]],
        overflow: [Overflow::Coarser, Overflow::DrawNothing][row[5]],
        order: [Order::VertexCache, Order::Specification][row[6]],
    }
}

/// The stages: a few, whose pipelines are made quickly, or every pair of options.
pub(crate) fn forms(is_long: bool) -> Vec<StageForm> {
    if is_long {
        let options = Options::new(&[2, 4, 4, 3, 4, 2, 2], |_, _| false);
        return options.rows().iter().map(|row| form(row)).collect();
    }
    let few = [
        [0, 2, 0, 0, 0, 0, 0],
        [0, 0, 1, 1, 1, 0, 1],
        [1, 3, 2, 0, 1, 1, 0],
        [1, 1, 0, 2, 2, 1, 0],
        [0, 3, 3, 0, 0, 0, 0],
    ];
    few.iter().map(|row| form(row)).collect()
}

/// The factors of all patches.
pub(crate) fn factors(domain: Domain, seed: u64) -> Vec<PatchFactors> {
    let mut random = SplitMix64::new(seed);
    // Eighths up to 10 or, in one of four, up to 3; sometimes a factor that culls or that is out of
    // range.
    let most = if seed.is_multiple_of(4) { 24 } else { 80 };
    let mut factor = || match random.below(60) {
        0 => 0.0,
        1 => f32::NAN,
        2 if seed % 16 == 1 => f32::INFINITY,
        3 => 0.5,
        _ => (8 + random.below(most)) as f32 / 8.0,
    };
    (0..crate::scene::PATCHES).map(|_| PatchFactors::from_fn(domain, |_| factor())).collect()
}

/// A call; `stages` is the number of stages.
pub(crate) fn call(stages: usize) -> impl Strategy<Value = StageCall> + Clone {
    let select = prop::sample::select::<Draw>;
    let draw = prop_oneof![
        4 => Just(Draw::Everything),
        2 => (0..5_u32).prop_map(Draw::One),
        1 => (0..5_u32).prop_map(Draw::OneByAnother),
        2 => select(vec![Draw::AmongOthers, Draw::ByAnother]),
    ];
    let from = prop_oneof![2 => Just(Count::Host), 1 => Just(Count::Device)];
    let then = prop_oneof![5 => Just(Then::Submit), 1 => Just(Then::Drop), 1 => Just(Then::Keep)];
    let wrong = vec![
        WrongFrame::Count,
        WrongFrame::Offset,
        WrongFrame::Groups,
        WrongFrame::BindGroup,
        WrongFrame::Factors,
        WrongFrame::Old,
    ];
    prop_oneof![
        2 => (0..stages).prop_map(|stage| StageCall::Use { stage }),
        1 => (0..4_u32, prop::bool::weighted(0.2))
            .prop_map(|(variant, is_alone)| StageCall::Rebuild { variant, is_alone }),
        5 => (any::<u64>(), prop::bool::weighted(0.2))
            .prop_map(|(seed, is_dropped)| StageCall::Give { seed, is_dropped }),
        2 => (0..8_u32, any::<bool>()).prop_map(|(by, is_bound)| StageCall::Move { by, is_bound }),
        3 => (0..6_u32).prop_map(|groups| StageCall::Group { groups }),
        1 => (0..3_u32).prop_map(|instances| StageCall::Repeat { instances }),
        2 => any::<bool>().prop_map(|shows_factors| StageCall::Paint { shows_factors }),
        2 => draw.clone().prop_map(|draw| StageCall::Again { draw }),
        9 => (prop_oneof![Just(crate::scene::PATCHES), 0..9_u32], from, draw, then)
            .prop_map(|(count, from, draw, then)| StageCall::Frame { count, from, draw, then }),
        1 => Just(StageCall::Late),
        1 => (0..9_u32).prop_map(|count| StageCall::MakeRoom { count }),
        1 => prop::sample::select(wrong).prop_map(|wrong| StageCall::Refused { wrong }),
    ]
}
