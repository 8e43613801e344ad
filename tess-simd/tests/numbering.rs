//! Vertex numbers up to the largest that 32 bits hold. The tests are compiled with overflow checks:
//! arithmetic on vertex numbers must not panic either.

#[path = "common/levels.rs"]
mod levels;
#[path = "common/patches.rs"]
mod patches;

use levels::levels;
use patches::{Patches, compare, configs};
use tess_core::{Domain, DomainPoint, PatchFactors};
use tess_simd::{Numbering, Tessellator};

/// Patches alone and together, so that the last vertex is 2^32 - 1 or near it.
fn compare_at_the_end(tessellator: &mut Tessellator, domain: Domain, patches: &Patches) {
    let expected = patches.expected(tessellator.config());
    let points: usize = expected.iter().map(|patch| patch.points.len()).sum();
    let points = u32::try_from(points).expect("a test's points");
    for spare in [0, 1, 2, 7, 100] {
        let base_vertex = 0_u32.wrapping_sub(points).wrapping_sub(spare);
        let numbering = Numbering::PerBatch { base_vertex };
        let batch = if spare < 2 { patches.structures(domain) } else { patches.columns(domain) };
        compare::<DomainPoint, u32>(tessellator, (patches, batch), &expected, numbering, |point| {
            point
        });
    }
}

/// Small and large patches, regular and minimum ones, with interiors of every kind: a point, a row
/// of points, a strip along u and along v.
fn kinds(domain: Domain) -> Vec<PatchFactors> {
    let insides = [[2.0, 2.0], [3.0, 3.0], [20.0, 31.0], [31.0, 20.0], [21.0, 41.0], [40.0, 40.0]];
    let outers = [1.0, 5.0, 64.0];
    let edges = domain.outer_factors();
    let cut = |outer: f32, inside: [f32; 2]| {
        PatchFactors::from_fn(domain, |i| if i < edges { outer } else { inside[i - edges] })
    };
    let cuts = insides.into_iter().flat_map(|inside| outers.map(|outer| cut(outer, inside)));
    let equal = [1.0, 2.0, 3.0, 19.0, 63.0, 64.0].map(|f| PatchFactors::uniform(domain, f));
    cuts.chain(equal).collect()
}

#[test]
fn up_to_the_largest_vertex() {
    for level in levels() {
        for (seed, config) in (400..).zip(configs()) {
            let mut tessellator = Tessellator::with_level(config, level).expect("available");
            for domain in Domain::ALL {
                for patch in kinds(domain) {
                    compare_at_the_end(&mut tessellator, domain, &Patches::new(vec![patch]));
                }
                compare_at_the_end(&mut tessellator, domain, &Patches::random(seed, domain, 20));
            }
        }
    }
}
