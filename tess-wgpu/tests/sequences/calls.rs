//! The calls of a sequence. Their debug text is code.

use proptest::prelude::*;
use tess_core::{Domain, PatchFactors};
use tess_verify::generate::{SplitMix64, random_patch};

/// One call. Numbers of setups, batches and buffers wrap around.
#[derive(Clone, Copy, Debug)]
pub(crate) enum DeviceCall {
    /// Replaces the first patches in a domain's buffer of factors.
    Fill { domain: Domain, with: Patches },
    /// Makes a batch of the first `count` patches of its domain's buffer, in groups; or a plan in
    /// long stages on bare wgpu.
    Make { setup: usize, count: u32, groups: u32, output: Destination, is_bare: bool },
    /// Encodes `count` batches, beginning with batch `first`, into one encoder.
    Run { first: usize, count: usize, then: Then },
    /// Submits the oldest encoder that was kept.
    Late,
    /// Drops a batch.
    Forget { batch: usize },
    /// Gives batches that are made later low limits, or the device's.
    Limit { is_low: bool },
    /// Tessellates patches and reads the output back.
    Whole { setup: usize, with: Patches },
    /// Makes a call that is refused.
    Refused { setup: usize, wrong: WrongCall },
}

/// The buffers that a batch writes. Room is what its patches need at that time, plus a difference.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Destination {
    Count,
    /// Buffers that other batches write too.
    Shared {
        points: usize,
        indices: usize,
    },
    /// Buffers of its own.
    Own {
        points: i32,
        primitives: i32,
    },
    /// Only indices, into a buffer of its own.
    Indices {
        points: i32,
        primitives: i32,
    },
    /// Only draw arguments.
    Arguments {
        points: i32,
        primitives: i32,
    },
}

/// The fate of an encoder.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Then {
    Submit,
    Drop,
    Keep,
}

/// The mistake of a call.
#[derive(Clone, Copy, Debug)]
pub(crate) enum WrongCall {
    GroupsDescend,
    GroupBehind,
    FewFactors,
    OneBuffer,
    NotStorage,
    OtherDomain,
}

/// Patches made from a seed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Patches {
    pub(crate) kind: Kind,
    pub(crate) count: u32,
    pub(crate) seed: u64,
}

/// Patches of one kind.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Kind {
    Culled,
    /// Runs of 1 to 600 equal ones.
    Runs,
    /// Small on average, with every kind of factor.
    Any,
    /// Factors up to 3.
    Tiny,
    /// Factors up to 3, but seven of eight patches are culled.
    Sparse,
    /// Few patches, with factors from 40 to 66.
    Large,
}

impl Patches {
    /// The patches.
    pub(crate) fn of(self, domain: Domain) -> Vec<PatchFactors> {
        let mut random = SplitMix64::new(self.seed);
        let mut all: Vec<PatchFactors> = Vec::new();
        let most = if matches!(self.kind, Kind::Large) { 30 } else { u32::MAX };
        let count = self.count.min(most) as usize;
        while all.len() < count {
            let (length, patch) = match self.kind {
                Kind::Culled => (1, PatchFactors::uniform(domain, 0.0)),
                Kind::Sparse if all.len() % 8 != 0 => (1, PatchFactors::uniform(domain, 0.0)),
                Kind::Tiny | Kind::Sparse => {
                    let factors = [0.0, 1.0, 1.0, 1.5, 2.0, 3.0];
                    let mut factor = |_| factors[random.below(6) as usize];
                    (1, PatchFactors::from_fn(domain, &mut factor))
                }
                Kind::Any => (1, random_patch(domain, &mut random)),
                Kind::Runs => (1 + random.below(600), random_patch(domain, &mut random)),
                Kind::Large => {
                    let mut factor = |_| f32::from(40 + random.next_u32().to_le_bytes()[0] % 27);
                    (1, PatchFactors::from_fn(domain, &mut factor))
                }
            };
            all.extend(std::iter::repeat_n(patch, length as usize));
        }
        all.truncate(count);
        all
    }
}

fn patches() -> impl Strategy<Value = Patches> + Clone {
    let kinds = vec![Kind::Culled, Kind::Tiny, Kind::Runs, Kind::Any, Kind::Any, Kind::Large];
    let counts = prop_oneof![
        4 => 0..300_u32,
        2 => prop::sample::select(vec![255_u32, 256, 257, 1023, 1024, 1025]),
        2 => 1000..2600_u32,
    ];
    (prop::sample::select(kinds), counts, any::<u64>()).prop_map(|(kind, count, seed)| Patches {
        kind,
        count,
        seed,
    })
}

fn output() -> impl Strategy<Value = Destination> + Clone {
    let more = || prop_oneof![4 => Just(0), 1 => Just(1), 1 => Just(-1), 1 => 0..3000];
    let room = move || (more(), more());
    prop_oneof![
        1 => Just(Destination::Count),
        4 => (0..3_usize, 0..3_usize)
            .prop_map(|(points, indices)| Destination::Shared { points, indices }),
        4 => room().prop_map(|(points, primitives)| Destination::Own { points, primitives }),
        2 => room().prop_map(|(points, primitives)| Destination::Indices { points, primitives }),
        2 => room().prop_map(|(points, primitives)| Destination::Arguments { points, primitives }),
    ]
}

/// A call; `setups` is the number of setups.
pub(crate) fn call(setups: usize) -> impl Strategy<Value = DeviceCall> + Clone {
    let domain = prop::sample::select(&Domain::ALL[..]);
    let then = prop::sample::select(vec![
        Then::Submit,
        Then::Submit,
        Then::Submit,
        Then::Keep,
        Then::Drop,
    ]);
    let count = prop_oneof![
        6 => 0..300_u32,
        2 => prop::sample::select(vec![256_u32, 1024, 1025]),
        3 => 1000..2600_u32,
        1 => Just(16_384_u32),
    ];
    let groups = prop_oneof![2 => Just(0), 1 => 1..4_u32, 1 => 200..300_u32];
    let wrong = prop::sample::select(vec![
        WrongCall::GroupsDescend,
        WrongCall::GroupBehind,
        WrongCall::FewFactors,
        WrongCall::OneBuffer,
        WrongCall::NotStorage,
        WrongCall::OtherDomain,
    ]);
    prop_oneof![
        6 => (domain, patches()).prop_map(|(domain, with)| DeviceCall::Fill { domain, with }),
        8 => (0..setups, count, groups, output(), prop::bool::weighted(0.2))
            .prop_map(|(setup, count, groups, output, is_bare)| {
                DeviceCall::Make { setup, count, groups, output, is_bare }
            }),
        10 => (0..8_usize, 1..4_usize, then)
            .prop_map(|(first, count, then)| DeviceCall::Run { first, count, then }),
        2 => Just(DeviceCall::Late),
        1 => (0..8_usize).prop_map(|batch| DeviceCall::Forget { batch }),
        1 => any::<bool>().prop_map(|is_low| DeviceCall::Limit { is_low }),
        1 => (0..setups, patches()).prop_map(|(setup, with)| DeviceCall::Whole { setup, with }),
        1 => (0..setups, wrong).prop_map(|(setup, wrong)| DeviceCall::Refused { setup, wrong }),
    ]
}
