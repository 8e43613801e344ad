//! The factors of a patch in the specification's order: fields, arrays, names and iterators agree.

use tess_core::{Config, Domain, OutputPrimitive, Partitioning, Patch, PatchFactors};
use tess_core::{IsolineFactors, ProcessedPatch, QuadFactors, TriangleFactors};

/// Spec section 1: density, detail; U=0, V=0, W=0, inside; U=0, V=0, U=1, V=1, inside U, V.
#[test]
fn fields_are_in_the_order_of_the_specification() {
    let isoline = IsolineFactors::from([0, 1]);
    assert_eq!((isoline.density, isoline.detail), (0, 1), "isoline");
    let triangle = TriangleFactors::from([0, 1, 2, 3]);
    assert_eq!((triangle.u0, triangle.v0, triangle.w0), (0, 1, 2), "outer factors of a triangle");
    assert_eq!(triangle.inside, 3, "inside factor of a triangle");
    let quad = QuadFactors::from([0, 1, 2, 3, 4, 5]);
    assert_eq!((quad.u0, quad.v0, quad.u1, quad.v1), (0, 1, 2, 3), "outer factors of a quad");
    assert_eq!((quad.inside_u, quad.inside_v), (4, 5), "inside factors of a quad");
}

#[test]
fn every_way_to_make_and_to_read_factors_agrees() {
    for domain in Domain::ALL {
        let count = domain.factors();
        let numbered = PatchFactors::from_fn(domain, |i| i);
        let expected: Vec<usize> = (0..count).collect();
        assert_eq!(numbered.domain(), domain, "{domain:?}: domain");
        assert_eq!(numbered.iter().collect::<Vec<_>>(), expected, "{domain:?}: iter");
        assert_eq!(numbered.iter().len(), count, "{domain:?}: length");
        assert_eq!(
            numbered.outer().chain(numbered.inside()).collect::<Vec<_>>(),
            expected,
            "{domain:?}: outer, then inside"
        );
        assert_eq!(numbered.outer().len(), domain.outer_factors(), "{domain:?}: outer");
        assert_eq!(numbered.inside().len(), domain.inside_factors(), "{domain:?}: inside");
        assert_eq!(PatchFactors::from_slice(domain, &expected), Some(numbered), "{domain:?}");
        assert_eq!(PatchFactors::from_slice(domain, &expected[1..]), None, "{domain:?}: short");
        let mapped: Vec<usize> = numbered.map(|i| 10 * i).iter().collect();
        assert_eq!(mapped, expected.iter().map(|i| 10 * i).collect::<Vec<_>>(), "{domain:?}: map");
        let uniform = PatchFactors::uniform(domain, 7);
        assert_eq!(uniform, PatchFactors::from_fn(domain, |_| 7), "{domain:?}: uniform");
        assert_eq!(domain.factor_names().len(), count, "{domain:?}: names");
    }
    assert_eq!(Domain::Quad.factor_names()[4], "inside_u", "names are those of the fields");
}

#[test]
fn a_patch_takes_the_factors_of_any_domain() {
    let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
    let quad = QuadFactors::uniform(3.0);
    assert_eq!(Patch::new(config, quad), Patch::new(config, PatchFactors::Quad(quad)), "quad");
    let processed = *Patch::new(config, quad).processed();
    let fixed = processed.factors().map(|factors| factors.map(|factor| factor.fixed.to_bits()));
    assert_eq!(fixed, Some(PatchFactors::uniform(Domain::Quad, 3 << 16)), "processed factors");
    let culled = Patch::new(config, QuadFactors { u1: 0.0, ..quad });
    assert_eq!(culled.processed(), &ProcessedPatch::Culled, "an outer factor of zero");
    assert_eq!(culled.processed().factors(), None, "a culled patch has no processed factors");
}
