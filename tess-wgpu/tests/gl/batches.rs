//! Batches on OpenGL.

use crate::common::device::Machine;
use crate::common::expected::Expected;
use crate::common::patches::random;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, SplitOrder};
use tess_gpu::sizes::SHORT_PATCHES;
use tess_gpu::{IndexType, Numbering, Order, PointFormat, Setup};
use tess_verify::generate::SplitMix64;
use tess_wgpu::Gpu;

/// Every domain with every partitioning, and every output with each domain and each partitioning;
/// split orders, formats, orders and index types take turns.
pub(crate) fn small_ones_equal_the_model(gpu: Gpu) {
    let mut machine = Machine::on(gpu);
    let mut numbers = SplitMix64::new(1);
    for (row, domain) in Domain::ALL.into_iter().enumerate() {
        for (column, partitioning) in Partitioning::ALL.into_iter().enumerate() {
            let output = OutputPrimitive::ALL[(row + column) % 4];
            let split = SplitOrder::ALL[column % 2];
            let mut setup =
                Setup::new(domain, Config { split, ..Config::new(partitioning, output) });
            match (2 * row + column) % 4 {
                0 => setup.point_format = PointFormat::F32,
                1 => setup.order = Order::VertexCache,
                2 => (setup.numbering, setup.index_type) = (Numbering::PerPatch, IndexType::U16),
                _ => {}
            }
            machine.assert_equal(setup, &random(domain, 100, &mut numbers));
        }
    }
}

/// A batch whose tiles search for their patch.
pub(crate) fn a_large_one_equals_the_model(gpu: Gpu) {
    let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCcw);
    let patches = random(Domain::Quad, SHORT_PATCHES + 40, &mut SplitMix64::new(2));
    Machine::on(gpu).assert_equal(Setup::new(Domain::Quad, config), &patches);
}

pub(crate) fn planted_faults_are_seen(gpu: Gpu) {
    let mut machine = Machine::on(gpu);
    for (domain, partitioning, fault) in [
        (
            Domain::Quad,
            Partitioning::FractionalOdd,
            "centre_stitch: the second row begins one index late",
        ),
        (Domain::Triangle, Partitioning::FractionalEven, "two thirds are a unit too large"),
    ] {
        let setup = Setup::new(domain, Config::new(partitioning, OutputPrimitive::TriangleCw));
        let patches = random(domain, 100, &mut SplitMix64::new(5));
        machine.plant(setup, fault);
        let expected = Expected::new(setup, &patches);
        let (points, indices) = expected.words();
        let written = machine.write(setup, &patches, points, indices);
        assert!(expected.compare(&written).is_err(), "{domain:?}: {fault} went unnoticed");
    }
}
