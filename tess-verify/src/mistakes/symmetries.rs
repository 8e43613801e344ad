//! Mistakes: the symmetries of the domains, with the order of a triangle's vertices kept or turned.

use super::family::Family;
use super::places::{move_all, turn_all};
use tess_core::Domain;
use tess_core::fixed_point::ONE;

/// A symmetry of some domains; `None` in others.
type Symmetry = fn(Domain, [u32; 2]) -> Option<[u32; 2]>;

const fn is_triangle(domain: Domain) -> bool {
    matches!(domain, Domain::Triangle)
}

const fn is_quad(domain: Domain) -> bool {
    matches!(domain, Domain::Quad)
}

/// The third coordinate. Points outside of the domain have one too.
const fn w([u, v]: [u32; 2]) -> u32 {
    ONE.wrapping_sub(u).wrapping_sub(v)
}

const fn mirror(x: u32) -> u32 {
    ONE.wrapping_sub(x)
}

/// The five symmetries of a triangle and the seven of a quad, apart from the identity.
pub(super) fn all() -> Vec<Family> {
    let direction = "the order of a segment's vertices is implementation-dependent (22.8)";
    let families = [
        symmetry("u and v are exchanged", |_, [u, v]| Some([v, u])),
        symmetry("v and w are exchanged", |domain, uv| is_triangle(domain).then(|| [uv[0], w(uv)])),
        symmetry("u and w are exchanged", |domain, uv| is_triangle(domain).then(|| [w(uv), uv[1]])),
        symmetry("u, v and w are rotated", |domain, uv| {
            is_triangle(domain).then(|| [uv[1], w(uv)])
        }),
        symmetry("w, v and u are rotated", |domain, uv| {
            is_triangle(domain).then(|| [w(uv), uv[0]])
        }),
        symmetry("u is mirrored", |domain, [u, v]| {
            (!is_triangle(domain)).then_some([mirror(u), v])
        })
        .vulkan_allows("isoline", direction),
        symmetry("v is mirrored", |domain, [u, v]| {
            (!is_triangle(domain)).then_some([u, mirror(v)])
        }),
        symmetry("u and v are mirrored", |domain, [u, v]| {
            (!is_triangle(domain)).then_some([mirror(u), mirror(v)])
        }),
        symmetry("the domain is turned by a quarter", |domain, [u, v]| {
            is_quad(domain).then_some([v, mirror(u)])
        }),
        symmetry("the domain is turned back by a quarter", |domain, [u, v]| {
            is_quad(domain).then_some([mirror(v), u])
        }),
        symmetry("u and v are exchanged and mirrored", |domain, [u, v]| {
            is_quad(domain).then_some([mirror(v), mirror(u)])
        }),
    ];
    families.into()
}

/// The moved output, once with the order of each triangle's vertices kept, once reversed. A mirror
/// image with the order kept has triangles that turn the other way.
fn symmetry(name: &'static str, symmetry: Symmetry) -> Family {
    let variants = [("order of vertices reversed", true), ("order of vertices kept", false)];
    variants.into_iter().fold(Family::new(name), |family, (variant, is_reversed)| {
        family.answers(variant, move |case, output| {
            let domain = case.domain();
            if symmetry(domain, [0, 0]).is_none() {
                return;
            }
            move_all(output, |place| symmetry(domain, place).unwrap_or(place));
            if is_reversed {
                turn_all(case, output);
            }
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Case;
    use crate::mistakes::Mistake;
    use std::collections::BTreeSet;

    /// Each domain's symmetries, with the identity, are a group: none twice and none missing. A
    /// point without symmetry goes to as many places.
    #[test]
    fn domains_have_all_of_their_symmetries() {
        for (domain, line, order) in [
            ("tri", "case tri fractional_odd point ruler 40300000 40500000 40900000 40b00000", 6),
            (
                "quad",
                "case quad fractional_odd point ruler 40300000 40500000 40900000 40b00000 40b00000 40d00000",
                8,
            ),
        ] {
            let case: Case = line.parse().expect("a case");
            let right = case.patch().tessellate();
            let families = all().into_iter().flat_map(Family::mistakes);
            let kept = families.filter(|mistake| mistake.variant() == "order of vertices kept");
            let spoiled = |mistake: Mistake| {
                let mut output = right.clone();
                let request = crate::mistakes::requests([case]).next().expect("one");
                mistake.spoil(&request, &mut output);
                output.points.iter().map(|p| (p.u.to_bits(), p.v.to_bits())).collect::<Vec<_>>()
            };
            let identity = right.points.iter().map(|p| (p.u.to_bits(), p.v.to_bits())).collect();
            let images: BTreeSet<Vec<(u32, u32)>> = kept.map(spoiled).chain([identity]).collect();
            assert_eq!(images.len(), order, "{domain}");
        }
    }
}
