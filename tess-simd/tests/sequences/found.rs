//! Sequences that once failed, as the test of all sequences printed them.

use crate::calls::{Call::*, Format::*, From::*, Layout::*, Width::*, *};
use crate::subject::replay;
use tess_core::{Config, Domain::*, OutputPrimitive::*, Partitioning::*, SplitOrder::*};
use tess_simd::{Level::*, Order::*};

/// A run at the beginning of a chunk, and no ranges.
#[test]
fn a_run_without_ranges() {
    let config = Config { partitioning: Integer, output: TriangleCw, split: Ruler };
    let start = Start { config, level: Baseline, order: Specification, threads: 1, in_pool: false };
    let runs = list([(8, quad([2.0; 6])), (57, quad([3.0; 6]))]);
    let patches = Patches { layout: Structures, domain: Quad, runs };
    let room = Room { format: Float, width: Bits32, points: 0, second: 0, indices: 0 };
    let calls = [Write(patches, To { room, from: EachPatch, ranges: None })];
    assert_eq!(replay(&start, &calls), Ok(()));
}

/// All memory was reserved, and the order or the number of threads changed.
#[test]
fn what_was_reserved_stays_reserved() {
    let config = Config { partitioning: Integer, output: Point, split: Ruler };
    let start = Start { config, level: Baseline, order: Specification, threads: 1, in_pool: false };
    let runs = || list([(8, quad([2.0; 6]))]);
    let patches = || Patches { layout: Structures, domain: Quad, runs: runs() };
    let room = Room { format: Float, width: Bits32, points: 0, second: 0, indices: 0 };
    for change in [SetOrder(Specification), SetThreads(4)] {
        let to = To { room, from: EachPatch, ranges: None };
        let calls = [Reserve, change, Write(patches(), to)];
        assert_eq!(replay(&start, &calls), Ok(()));
    }
}
