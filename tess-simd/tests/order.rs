//! The vertex-cache order: what the model has in that order, bit for bit.

#[path = "common/levels.rs"]
mod levels;
#[path = "common/patches.rs"]
mod patches;

use levels::levels;
use patches::{Patches, compare, configs, difference};
use tess_core::{
    Config, Domain, DomainPoint, OutputPrimitive, Partitioning, PatchFactors, QuadFactors,
    Tessellation, TriangleFactors,
};
use tess_simd::{Level, Numbering, Order, Output, Tessellator};

fn tessellator(config: Config, level: Level) -> Tessellator {
    let tessellator = Tessellator::with_level(config, level);
    tessellator.unwrap_or_else(|error| panic!("{error}")).order(Order::VertexCache)
}

/// A batch of one domain, in both index formats.
fn compare_both(tessellator: &mut Tessellator, domain: Domain, patches: &Patches) {
    let expected = patches.expected_in(Order::VertexCache, tessellator.config());
    let (structures, columns) = (patches.structures(domain), patches.columns(domain));
    let numbering = Numbering::PerBatch { base_vertex: 77 };
    compare::<_, u32>(
        tessellator,
        (patches, structures),
        &expected,
        numbering,
        |point: DomainPoint| point,
    );
    compare::<_, u16>(
        tessellator,
        (patches, columns),
        &expected,
        Numbering::PerPatch,
        DomainPoint::to_f32,
    );
}

#[test]
fn every_configuration_at_every_level() {
    for level in levels() {
        for (seed, config) in (0..).zip(configs()) {
            let mut tessellator = tessellator(config, level);
            for domain in Domain::ALL {
                compare_both(&mut tessellator, domain, &Patches::random(seed, domain, 203));
            }
        }
    }
}

/// Templates fill their room, are forgotten and made again.
#[test]
fn large_patches_that_differ() {
    let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
    for level in levels() {
        let mut tessellator = tessellator(config, level);
        let factor = |i: u8| f32::from(40 + i % 25);
        let quad = |i: u8| QuadFactors {
            u0: factor(i),
            v0: factor(i / 2),
            u1: factor(i / 3),
            v1: factor(i / 5),
            inside_u: factor(i / 7),
            inside_v: factor(i + 9),
        };
        let triangle = |i: u8| TriangleFactors {
            u0: factor(i),
            v0: factor(i / 2),
            w0: factor(i / 3),
            inside: factor(i / 5),
        };
        let quads = Patches::new((0..200).map(|i| PatchFactors::from(quad(i / 2))).collect());
        compare_both(&mut tessellator, Domain::Quad, &quads);
        let triangles = Patches::new((0..200).map(|i| triangle(i).into()).collect());
        compare_both(&mut tessellator, Domain::Triangle, &triangles);
    }
}

/// What was kept from batches in one order is not used in another.
#[test]
fn the_order_can_be_changed() {
    let config = Config::new(Partitioning::Pow2, OutputPrimitive::TriangleCcw);
    let patches = Patches::random(5, Domain::Quad, 100);
    let batch = patches.structures(Domain::Quad);
    let (specified, drawn) =
        (patches.expected(config), patches.expected_in(Order::VertexCache, config));
    let mut tessellator = Tessellator::new(config);
    for order in [Order::Specification, Order::VertexCache, Order::Specification] {
        tessellator = tessellator.order(order);
        let mut output = Output::<DomainPoint, u32>::new();
        tessellator.tessellate(batch, Numbering::PerPatch, &mut output).expect("a batch that fits");
        let from = |expected: &[Tessellation]| {
            let patches = (config, &patches.all[..]);
            difference(patches, expected, Numbering::PerPatch, &output, |p| p)
        };
        let (own, other) = match order {
            Order::VertexCache => (&drawn, &specified),
            _ => (&specified, &drawn),
        };
        assert_eq!(from(own), None, "{order:?}");
        assert!(from(other).is_some(), "{order:?} is not the other order");
    }
}
