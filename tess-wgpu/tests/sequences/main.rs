//! Batches in any order of calls and with all pairs of options, compared with the golden model word
//! for word.

mod bare;
mod calls;
#[path = "../common/mod.rs"]
mod common;
mod options;
mod pulling;
#[path = "../common/sequences.rs"]
mod sequences;
mod world;

use calls::DeviceCall::{self, Fill, Forget, Late, Limit, Make, Run};
use calls::{Destination, Kind, Patches, Then};
use common::device::Machine;

use tess_core::{Config, Domain, OutputPrimitive, Partitioning, SplitOrder};
use tess_gpu::{Copies, IndexType, Numbering, Order, PointFormat, Setup};
use world::{Kept, World};

/// Setups of every domain, partitioning and format, but so few that their pipelines are made
/// quickly.
fn few() -> Vec<Setup> {
    use OutputPrimitive::{Line, Point, TriangleCcw, TriangleCw};
    use Partitioning::{FractionalEven, FractionalOdd, Integer, Pow2};
    let of = |domain, partitioning, output| Setup::new(domain, Config::new(partitioning, output));
    let mut centred = of(Domain::Quad, Integer, TriangleCcw);
    centred.config.split = SplitOrder::Centre;
    let (numbering, index_type) = (Numbering::PerPatch, IndexType::U16);
    let (order, copies, point_format) = (Order::VertexCache, Copies::Never, PointFormat::F32);
    vec![
        Setup { order, ..of(Domain::Quad, FractionalOdd, TriangleCw) },
        Setup { point_format, numbering, index_type, ..centred },
        Setup { index_type, ..of(Domain::Triangle, FractionalEven, TriangleCw) },
        Setup { order, copies, ..of(Domain::Triangle, Pow2, TriangleCcw) },
        Setup { point_format, ..of(Domain::Isoline, FractionalOdd, Line) },
        Setup { numbering, index_type, ..of(Domain::Quad, Integer, Point) },
        Setup { index_type, ..of(Domain::Quad, Pow2, TriangleCw) },
        Setup { index_type, copies, ..of(Domain::Isoline, Integer, Line) },
    ]
}

/// Makes the calls on a new world; returns the number of compared words.
fn replayed(
    machine: &mut Machine,
    kept: &mut Kept,
    setups: &[Setup],
    calls: &[DeviceCall],
) -> Result<u64, String> {
    let mut world = World::new(machine, kept, setups, 16_500);
    for (number, &call) in calls.iter().enumerate() {
        world.call(call).map_err(|what| format!("call {number}, {call:?}: {what}"))?;
    }
    Ok(world.words)
}

/// The setups of this run.
fn setups() -> Vec<Setup> {
    if sequences::long().is_some() { options::setups() } else { few() }
}

/// Runs a sequence that was found. A sequence of the long run needs its variable.
fn replay(calls: &[DeviceCall]) {
    let outcome = replayed(&mut Machine::open(), &mut Kept::default(), &setups(), calls);
    outcome.unwrap_or_else(|difference| panic!("{difference}"));
}

#[test]
fn any_sequence_of_calls_gives_the_models_words() {
    let (mut machine, mut kept) = (Machine::open(), Kept::default());
    let setups = setups();
    let names = "{calls::{DeviceCall::*, Kind::*, Destination::*, Then::*, WrongCall::*}, tess_core::Domain::*}";
    sequences::hold(names, (150, 20), calls::call(setups.len()), |calls| {
        replayed(&mut machine, &mut kept, &setups, calls)
    });
}

/// Batches that share buffers, one of which grows beyond 16-bit indices while its encoder waits.
/// Only draw arguments have room for that.
#[test]
fn a_batch_outgrows_its_indices() {
    let large = Patches { kind: Kind::Large, count: 30, seed: 1 };
    let small = Patches { kind: Kind::Any, count: 30, seed: 2 };
    let output = Destination::Shared { points: 2, indices: 2 };
    let alone = Destination::Arguments { points: 0, primitives: 0 };
    replay(&[
        Fill { domain: Domain::Quad, with: small },
        Make { setup: 6, count: 30, groups: 3, output, is_bare: false },
        Run { first: 0, count: 1, then: Then::Submit },
        Run { first: 0, count: 1, then: Then::Keep },
        Limit { is_low: true },
        Make { setup: 0, count: 25, groups: 0, output, is_bare: true },
        Fill { domain: Domain::Quad, with: large },
        Late,
        Make { setup: 6, count: 30, groups: 2, output: alone, is_bare: false },
        Run { first: 0, count: 3, then: Then::Submit },
        Forget { batch: 0 },
        Run { first: 0, count: 1, then: Then::Submit },
    ]);
}
