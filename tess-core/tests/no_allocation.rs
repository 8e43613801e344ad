//! Only vectors of results allocate.

use allocation_counter::measure;
use tess_core::prepare::{QuadAxes, Reduction, Request, prepare};
use tess_core::{
    Config, Counter, DomainPoint, MAX_INDICES, MAX_POINTS, OutputPrimitive, Partitioning, Patch,
    PatchFactors, QuadFactors, TriangleFactors,
};

const TRIANGLE: TriangleFactors = TriangleFactors { u0: 7.5, v0: 64.0, w0: 1.0, inside: 9.25 };
const QUAD: QuadFactors =
    QuadFactors { u0: 64.0, v0: 64.0, u1: 64.0, v1: 64.0, inside_u: 64.0, inside_v: 64.0 };

fn allocations(f: impl FnOnce()) -> u64 {
    measure(f).count_total
}

#[test]
fn the_counter_counts() {
    let vector = allocations(|| drop(std::hint::black_box(vec![0u8; 16])));
    assert_eq!(vector, 1, "a vector is one allocation");
    let patch = Patch::new(
        Config::new(Partitioning::Integer, OutputPrimitive::Line),
        PatchFactors::Triangle(TRIANGLE),
    );
    let whole = allocations(|| drop(std::hint::black_box(patch.tessellate())));
    assert_eq!(whole, 2, "a tessellation in vectors is one of points and one of indices");
}

#[test]
fn tessellation_allocates_nothing() {
    let mut points = vec![DomainPoint::default(); MAX_POINTS];
    let mut indices = vec![0; MAX_INDICES];
    for partitioning in Partitioning::ALL {
        for output in OutputPrimitive::ALL {
            for factors in [PatchFactors::Triangle(TRIANGLE), PatchFactors::Quad(QUAD)] {
                let mut elements = 0;
                let count = allocations(|| {
                    let patch = Patch::new(Config::new(partitioning, output), factors);
                    let counts = patch.write(&mut points, &mut indices).expect("room for any");
                    patch.emit(&mut Counter::default());
                    elements += (0..counts.points).filter_map(|i| patch.point(i)).count();
                    elements += (0..counts.primitives).filter_map(|t| patch.primitive(t)).count();
                    elements += patch.points().count() + patch.primitives().count();
                });
                assert_eq!(count, 0, "{partitioning:?} {output:?}");
                assert!(elements > 100, "something was tessellated: {elements}");
            }
        }
    }
}

#[test]
fn errors_allocate_nothing() {
    let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
    let count = allocations(|| {
        let patch = Patch::new(config, PatchFactors::Quad(QUAD));
        assert!(patch.write(&mut [], &mut []).is_err(), "no room");
    });
    assert_eq!(count, 0, "a buffer that is too small");
}

#[test]
fn preparation_allocates_nothing() {
    for partitioning in Partitioning::ALL {
        for reduction in [Reduction::Min, Reduction::Max, Reduction::Average] {
            let count = allocations(|| {
                for request in [
                    Request::from_record(PatchFactors::Triangle(TRIANGLE), QuadAxes::One),
                    Request::from_record(PatchFactors::Quad(QUAD), QuadAxes::One),
                    Request::from_record(PatchFactors::Quad(QUAD), QuadAxes::Two),
                ] {
                    std::hint::black_box(prepare(partitioning, reduction, request));
                }
            });
            assert_eq!(count, 0, "{partitioning:?} {reduction:?}");
        }
    }
}
