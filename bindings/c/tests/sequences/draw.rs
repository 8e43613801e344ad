//! Sequences at random.

use super::calls::{Base, Bits, BufferName, Call, PatchRuns, Room, Sequence, Threads, To, Wrong};
use proptest::array::{uniform3, uniform4};
use proptest::collection::vec;
use proptest::prelude::{Just, Strategy, any, prop_oneof};

/// How many batches there are at a time.
pub(crate) const SLOTS: usize = 3;

/// Whole sequences, each of which begins with a batch for each slot.
pub(crate) fn sequences() -> impl Strategy<Value = Sequence> {
    let threads = prop_oneof![
        4 => Just(Threads::One),
        1 => Just(Threads::Alternating),
        1 => Just(Threads::Together),
    ];
    let made = uniform3(right_create());
    (threads, made, vec((0..SLOTS, calls()), 1..24)).prop_map(|(threads, made, others)| {
        let steps = made.into_iter().enumerate().chain(others).collect();
        Sequence { threads, steps }
    })
}

fn calls() -> impl Strategy<Value = Call> {
    prop_oneof![
        12 => (patches(), to(), wrong())
            .prop_map(|(patches, to, wrong)| Call::Run { patches, to, wrong }),
        8 => (factors(), to(), wrong())
            .prop_map(|(factors, to, wrong)| Call::Single { factors, to, wrong }),
        3 => (patches(), wrong()).prop_map(|(patches, wrong)| Call::Count { patches, wrong }),
        2 => uniform3(prop_oneof![0..9u32, 0..200u32]).prop_map(|starts| Call::Groups { starts }),
        2 => right_create(),
        1 => (uniform4(0..5u32), 0..6u32)
            .prop_map(|(config, level)| Call::Create { config, level }),
        1 => Just(Call::Reserve),
        2 => (0..3u32).prop_map(|order| Call::Triangles { order }),
        1 => (0..4u32).prop_map(|threads| Call::Pool { threads }),
        1 => Just(Call::Level),
        1 => Just(Call::Free),
    ]
}

/// A batch that can be made, if the machine has the CPU level.
fn right_create() -> impl Strategy<Value = Call> {
    let level = prop_oneof![2 => Just(0), 1 => 0..4u32];
    (0..3u32, 0..4u32, 0..4u32, 0..2u32, level).prop_map(
        |(domain, partitioning, output, split, level)| Call::Create {
            config: [domain, partitioning, output, split],
            level,
        },
    )
}

fn patches() -> impl Strategy<Value = PatchRuns> {
    let times = prop_oneof![3 => Just(1), 2 => 1..5u8, 2 => 1..100u8];
    vec((times, factors()), 0..7).prop_map(PatchRuns)
}

/// Factors of a patch: alike, or each of its own kind.
fn factors() -> impl Strategy<Value = Bits> {
    prop_oneof![
        3 => factor().prop_map(|bits| Bits([bits; 6])),
        2 => proptest::array::uniform6(factor()).prop_map(Bits),
    ]
}

fn factor() -> impl Strategy<Value = u32> {
    prop_oneof![
        8 => (1..7u8).prop_map(|factor| f32::from(factor).to_bits()),
        8 => (1.0..9.0f32).prop_map(f32::to_bits),
        2 => Just(1.0f32.to_bits()),
        1 => (9.0..70.0f32).prop_map(f32::to_bits),
        1 => prop_oneof![Just(0), Just(1), Just(0xbf80_0000), Just(0x7fc0_0000), Just(0x7f80_0000)],
        1 => any::<u32>(),
    ]
}

fn to() -> impl Strategy<Value = To> {
    let number = |listed: u32| prop_oneof![60 => 0..listed, 1 => listed..listed + 2];
    let base = prop_oneof![
        2 => Just(Base::Of(0)),
        2 => (-2..3i8).prop_map(Base::Limit),
        1 => (0..70_000u32).prop_map(Base::Of),
        1 => any::<u32>().prop_map(Base::Of),
    ];
    let numbers = (number(3), number(2), number(2), base, number(2), any::<bool>());
    (uniform3(room()), numbers).prop_map(
        |(room, (point_format, index_type, numbering, base, memory, keep))| To {
            room,
            point_format,
            index_type,
            numbering,
            base,
            memory,
            keep,
        },
    )
}

fn room() -> impl Strategy<Value = Room> {
    prop_oneof![
        30 => Just(Room::Exact),
        30 => (1..200u8).prop_map(Room::More),
        4 => Just(Room::Short),
        2 => Just(Room::Absent),
        1 => Just(Room::Impossible),
    ]
}

fn part() -> impl Strategy<Value = BufferName> {
    use BufferName::{Counts, Factors, Indices, Output, Points, Ranges};
    proptest::sample::select(vec![Factors, Points, Indices, Ranges, Counts, Output])
}

fn wrong() -> impl Strategy<Value = Wrong> {
    prop_oneof![
        30 => Just(Wrong::Nothing),
        2 => part().prop_map(Wrong::Null),
        2 => part().prop_map(Wrong::Askew),
        3 => (part(), part()).prop_map(|(one, other)| Wrong::Shared(one, other)),
        1 => Just(Wrong::Floats),
    ]
}
