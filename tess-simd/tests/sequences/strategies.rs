//! Random sequences of calls.

use crate::calls::{
    Call, Factors, Format, From, Layout, List, Patches, Room, Start, To, Width, isoline, quad,
    triangle,
};
use crate::patches::configs;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;
use proptest_state_machine::ReferenceStateMachine;
use tess_core::{Config, Domain, DomainPoint, OutputPrimitive, Partitioning, Patch, PatchFactors};
use tess_simd::{Level, Order};

/// The calls drawn so far, which decide the next one.
#[derive(Clone, Debug)]
pub(crate) struct Drawn {
    pub(crate) start: Start,
    patch: Option<Factors>,
    patches: Option<Patches>,
}

impl ReferenceStateMachine for Drawn {
    type State = Self;
    type Transition = Call;

    /// A tessellator; [`at_level`] says at which level.
    fn init_state() -> BoxedStrategy<Self> {
        let configs = select(configs().collect::<Vec<_>>());
        let start = (configs, orders(), 1..=4_usize, any::<bool>());
        let level = Level::Baseline;
        start
            .prop_map(move |(config, order, threads, in_pool)| {
                let start = Start { config, level, order, threads, in_pool };
                Self { start, patch: None, patches: None }
            })
            .boxed()
    }

    fn transitions(state: &Self) -> BoxedStrategy<Call> {
        let patches = again(state.patches.clone(), patches());
        let near = state.patch.map_or_else(|| any_factors().boxed(), |patch| near(patch).boxed());
        let factors = again(state.patch, prop_oneof![3 => any_factors(), 1 => near]);
        let lists = |most| vec(buffers(), 0..=most).prop_map(List);
        let rooms = vec(room(), 0..=2_usize).prop_map(List);
        let kept = (patches.clone(), formats(), widths(), from(), groups());
        prop_oneof![
            4 => (patches.clone(), buffers()).prop_map(|(patches, to)| Call::Write(patches, to)),
            3 => (patches, lists(2)).prop_map(|(patches, all)| Call::Count(patches, all)),
            3 => kept.prop_map(|(p, f, w, from, groups)| Call::Tessellate(p, f, w, from, groups)),
            4 => (factors.clone(), room()).prop_map(|(patch, room)| Call::Patch(patch, room)),
            2 => (factors, rooms).prop_map(|(patch, rooms)| Call::CountPatch(patch, rooms)),
            1 => prop_oneof![
                Just(Call::Reserve),
                Just(Call::Copy),
                orders().prop_map(Call::SetOrder),
                (1..=4_usize).prop_map(Call::SetThreads),
            ],
        ]
        .boxed()
    }

    fn apply(mut state: Self, call: &Call) -> Self {
        match call {
            Call::Write(patches, _) | Call::Count(patches, _) | Call::Tessellate(patches, ..) => {
                state.patches = Some(patches.clone());
                state.patch = patches.runs.0.last().map(|run| run.1).or(state.patch);
            }
            Call::Patch(patch, _) | Call::CountPatch(patch, _) => state.patch = Some(*patch),
            _ => {}
        }
        state
    }
}

/// A patch that differs in one factor.
fn near(Factors(patch): Factors) -> impl Strategy<Value = Factors> {
    (0..patch.domain().factors(), raw()).prop_map(move |(changed, factor)| {
        let all: Vec<f32> = patch.iter().collect();
        let of = |i| if i == changed { factor } else { all[i] };
        Factors(PatchFactors::from_fn(patch.domain(), of))
    })
}

/// The previous value again, or another.
fn again<T: Clone + std::fmt::Debug + 'static>(
    before: Option<T>,
    other: impl Strategy<Value = T> + 'static,
) -> BoxedStrategy<T> {
    match before {
        Some(before) => prop_oneof![2 => other, 1 => Just(before)].boxed(),
        None => other.boxed(),
    }
}

fn orders() -> impl Strategy<Value = Order> + Clone {
    select(vec![Order::Specification, Order::VertexCache])
}

fn formats() -> impl Strategy<Value = Format> + Clone {
    select(vec![Format::Float, Format::Fixed, Format::Apart])
}

fn widths() -> impl Strategy<Value = Width> + Clone {
    select(vec![Width::Bits16, Width::Bits32])
}

fn from() -> impl Strategy<Value = From> + Clone {
    prop_oneof![
        3 => Just(From::EachPatch),
        2 => (0..1000_u32).prop_map(From::Base),
        1 => (0..20_u32).prop_map(|below| From::Base(u32::MAX - below)),
        2 => (-3..=1_i64).prop_map(From::Limit),
    ]
}

/// Elements beyond those needed.
fn spare() -> impl Strategy<Value = isize> + Clone {
    prop_oneof![8 => Just(0), 4 => 1..70_isize, 2 => 70..400_isize, 1 => Just(-1)]
}

fn room() -> impl Strategy<Value = Room> + Clone {
    (formats(), widths(), spare(), spare(), spare()).prop_map(
        |(format, width, points, second, indices)| Room { format, width, points, second, indices },
    )
}

fn buffers() -> impl Strategy<Value = To> + Clone {
    (room(), from(), proptest::option::of(spare())).prop_map(|(room, from, ranges)| To {
        room,
        from,
        ranges,
    })
}

fn groups() -> impl Strategy<Value = List<u32>> {
    (vec(0..40_u32, 0..5_usize), any::<bool>()).prop_map(|(mut starts, sorted)| {
        if sorted {
            starts.sort_unstable();
        }
        List(starts)
    })
}

/// One raw factor.
fn raw() -> impl Strategy<Value = f32> + Clone {
    const SPECIAL: [f32; 10] = [
        0.0,
        -0.0,
        -1.0,
        f32::NAN,
        f32::INFINITY,
        f32::NEG_INFINITY,
        1e-40,
        64.0,
        65.0,
        3.000_000_2,
    ];
    prop_oneof![
        8 => (1..=6_u8).prop_map(f32::from),
        4 => (8..64_u32).prop_map(|eighths| DomainPoint::from_bits(eighths << 13, 0).to_f32()[0]),
        2 => 1.0..20.0_f32,
        1 => 1.0..64.0_f32,
        1 => select(SPECIAL.to_vec()),
    ]
}

/// Factors of a patch: a few that recur often, equal ones, any.
fn factors(domain: Domain) -> impl Strategy<Value = Factors> + Clone {
    let uniform = move |factor| Factors(PatchFactors::uniform(domain, factor));
    let often = match domain {
        Domain::Isoline => vec![isoline([3.0, 2.0]), isoline([1.0, 9.5]), isoline([64.0; 2])],
        Domain::Triangle => vec![triangle([3.0, 2.0, 4.0, 5.0]), triangle([1.0, 1.0, 1.0, 2.5])],
        Domain::Quad => {
            vec![quad([3.0, 4.5, 5.0, 6.0, 4.0, 7.0]), quad([2.0, 1.0, 2.0, 3.0, 1.0, 1.0])]
        }
    };
    prop_oneof![
        3 => select(often),
        2 => select(vec![1.0, 2.0, 2.5, 3.0, 16.0, 0.0]).prop_map(uniform),
        2 => raw().prop_map(uniform),
        3 => vec(raw(), 6).prop_map(move |raw| Factors(PatchFactors::from_fn(domain, |i| raw[i]))),
        1 => select(vec![17.0, 18.0, 33.5, 64.0]).prop_map(uniform),
    ]
}

fn domains() -> impl Strategy<Value = Domain> + Clone {
    select(Domain::ALL.to_vec())
}

fn any_factors() -> impl Strategy<Value = Factors> {
    domains().prop_flat_map(factors)
}

fn layouts() -> impl Strategy<Value = Layout> + Clone {
    prop_oneof![
        4 => Just(Layout::Structures),
        4 => Just(Layout::Columns),
        4 => Just(Layout::AnyDomain),
        1 => Just(Layout::Uneven),
        1 => Just(Layout::Mixed),
    ]
}

/// The largest number of patches of a batch: around packets, chunks and the number counted at once,
/// or any.
fn lengths() -> impl Strategy<Value = usize> {
    let around = [1, 4, 8, 16, 32, 64, 128, 256].map(|length| length - 1..=length + 1);
    prop_oneof![1 => select(around.into_iter().flatten().collect::<Vec<_>>()), 2 => Just(10_000)]
}

/// A batch of runs.
fn patches() -> impl Strategy<Value = Patches> {
    let all = move |domain| (layouts(), Just(domain), runs(domain), lengths());
    domains().prop_flat_map(all).prop_map(|(layout, domain, mut runs, mut length)| {
        for (times, _) in &mut runs {
            *times = length.min(*times);
            length -= *times;
        }
        runs.retain(|&(times, _)| times > 0);
        Patches { layout, domain, runs: List(runs) }
    })
}

/// Runs with little output, some with enough patches and output for several threads, and some of
/// patches that all have different topologies, so that templates need all their room.
fn runs(domain: Domain) -> impl Strategy<Value = Vec<(usize, Factors)>> + Clone {
    let times = prop_oneof![6 => Just(1), 5 => 2..=10_usize, 3 => 11..=100_usize];
    let runs = vec((times, factors(domain)), 0..14_usize);
    let middling = vec(9..=17_u8, domain.factors()).prop_map(move |raw| {
        (1, Factors(PatchFactors::from_fn(domain, |factor| f32::from(raw[factor]))))
    });
    prop_oneof![
        24 => runs.clone().prop_map(|runs| cut(runs, 1, 3000)),
        2 => runs.prop_map(|runs| cut(runs, 8, 60_000)),
        1 => vec(middling, 100..160_usize),
    ]
}

/// Runs that are `longer` times as long, but end when they have this many points in total.
fn cut(runs: Vec<(usize, Factors)>, longer: usize, points: usize) -> Vec<(usize, Factors)> {
    let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
    let mut left = points;
    let cut = |(times, patch): (usize, Factors)| {
        let one = Patch::new(config, patch.0).counts().points.max(1) as usize;
        let times = (times * longer).min(left.div_ceil(one));
        left = left.saturating_sub(times * one);
        (times > 0).then_some((times, patch))
    };
    runs.into_iter().filter_map(cut).collect()
}
