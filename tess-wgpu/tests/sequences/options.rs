//! Every pair of values of two options of a setup and of a plan, on a device.

use crate::calls::DeviceCall::{Fill, Limit, Make, Run};
use crate::calls::{Destination, Kind, Patches, Then};
use crate::common::device::Machine;
use crate::world::{Kept, World};
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, SplitOrder};
use tess_gpu::{Capacity, Copies, IndexType, Numbering, Order, Plan, PointFormat, Setup};
use tess_testkit::pairs::{Choice, Options};

/// Numbers of patches: one, a short batch, a long one, one with a catalogue, and one of two
/// portions (written as 0).
const COUNTS: [u32; 5] = [1, 300, 1100, 16_384, 0];
const GROUPS: [u32; 3] = [0, 1, 300];
/// The room for points and primitives in excess of the needs.
const ROOMS: [[i32; 2]; 4] = [[0, 0], [-1, 0], [0, -1], [1000, 700]];

/// The options in order, each with the number of its values.
const OPTIONS: [(&str, usize); 14] = [
    ("domain", 3),
    ("partitioning", 4),
    ("output", 4),
    ("split", 2),
    ("point format", 2),
    ("numbering", 2),
    ("index type", 2),
    ("copies", 2),
    ("order", 2),
    ("written: everything, indices, arguments, counts", 4),
    ("patches", COUNTS.len()),
    ("groups", GROUPS.len()),
    ("room", ROOMS.len()),
    ("host: low limits, the device's, a plan in long stages on bare wgpu", 3),
];
const WRITTEN: usize = 9;
const PATCHES: usize = 10;
const HOST: usize = 13;

/// A batch that is pulled binds one portion.
fn excluded(a: Choice, b: Choice) -> bool {
    matches!((a, b), ((WRITTEN, 1 | 2), (PATCHES, 4)))
}

fn options() -> Options<fn(Choice, Choice) -> bool> {
    Options::new(&OPTIONS.map(|(_, values)| values), excluded)
}

fn setup(row: &[usize]) -> Setup {
    let config = Config {
        split: SplitOrder::ALL[row[3]],
        ..Config::new(Partitioning::ALL[row[1]], OutputPrimitive::ALL[row[2]])
    };
    Setup {
        point_format: [PointFormat::Packed, PointFormat::F32][row[4]],
        numbering: [Numbering::PerBatch, Numbering::PerPatch][row[5]],
        index_type: [IndexType::U16, IndexType::U32][row[6]],
        copies: [Copies::WhereAlike, Copies::Never][row[7]],
        order: [Order::Specification, Order::VertexCache][row[8]],
        ..Setup::new(Domain::ALL[row[0]], config)
    }
}

/// The setups of all rows, which contain every pair of their values.
pub(crate) fn setups() -> Vec<Setup> {
    options().rows().iter().map(|row| setup(row)).collect()
}

/// Runs the batch of a row, with the row's room and with the room that it needs, and compares
/// everything. Returns the number of compared words, and of batches with output that fitted.
fn run(machine: &mut Machine, kept: &mut Kept, row: &[usize]) -> Result<[u64; 2], String> {
    let (setup, is_bare) = (setup(row), row[HOST] == 2);
    let plan = Plan::new(setup, u32::MAX, Capacity::default(), crate::world::LOW);
    let is_cut = COUNTS[row[PATCHES]] == 0;
    let count = if is_cut { plan.portion_patches() + 700 } else { COUNTS[row[PATCHES]] };
    // Few enough for 16-bit indices where possible.
    let is_narrow = (row[6], row[5]) == (0, 0);
    let kind = match count {
        0..=300 => Kind::Any,
        301..=2000 if !is_narrow => Kind::Any,
        2001.. if is_narrow => Kind::Sparse,
        _ => Kind::Tiny,
    };
    let output = |[points, primitives]: [i32; 2]| match row[WRITTEN] {
        0 => Destination::Own { points, primitives },
        1 => Destination::Indices { points, primitives },
        2 => Destination::Arguments { points, primitives },
        _ => Destination::Count,
    };
    let (groups, seed) = (GROUPS[row[11]], row.iter().sum::<usize>() as u64);
    let mut world = World::new(machine, kept, std::slice::from_ref(&setup), count);
    let make = |room| Make { setup: 0, count, groups, output: output(room), is_bare };
    for call in [
        Limit { is_low: is_cut || row[HOST] == 0 },
        Fill { domain: setup.domain, with: Patches { kind, count, seed } },
        make(ROOMS[row[12]]),
        Run { first: 0, count: 1, then: Then::Submit },
        make(ROOMS[0]),
        Run { first: 0, count: 2, then: Then::Submit },
    ] {
        world.call(call)?;
    }
    Ok([world.words, world.written as u64])
}

/// The values of a row, by the names of their options.
fn named(row: &[usize]) -> String {
    let values = OPTIONS.iter().zip(row).map(|((name, _), value)| format!("{name}: {value}; "));
    values.collect::<String>() + &format!("{:?}", setup(row))
}

#[test]
#[ignore = "slow: every two options of a batch"]
fn every_two_options_together_give_the_models_words() {
    let (mut machine, mut kept, mut sum) = (Machine::open(), Kept::default(), [0; 2]);
    let rows = options().rows();
    for row in &rows {
        let own = run(&mut machine, &mut kept, row);
        let own = own.unwrap_or_else(|wrong| panic!("{}\n{wrong}", named(row)));
        sum = [sum[0] + own[0], sum[1] + own[1]];
    }
    // In a quarter of the rows, the batch only counts.
    assert!(sum[1] >= rows.len() as u64, "{sum:?} words and batches of {} rows", rows.len());
}

#[test]
fn what_excludes_each_other_is_named() {
    let (mut machine, mut kept) = (Machine::open(), Kept::default());
    let refused = options().refused();
    assert_eq!(refused.len(), 2, "indices or arguments alone, and two portions");
    for (_, mut row) in refused {
        // A plan is given only the number of patches.
        row[HOST] = 1;
        let wrong = run(&mut machine, &mut kept, &row).expect_err(&named(&row));
        let words = "patches without a point buffer are more than one binding holds";
        assert!(wrong.contains(words), "{}\n{wrong}", named(&row));
    }
}
