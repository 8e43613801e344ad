//! shared/described.wgsl: the placement of a point, in one word.

use tess_core::{Patch, PatchFactors, PointOrigin};

/// The ways to make (u, v) from the constant coordinate and the placed one.
const FORM_CORNER: u32 = 3;

/// Point `i` of a patch with fractional factors.
pub(crate) fn described_point(patch: &Patch, i: u32) -> u32 {
    let factors = patch.processed().factors().expect("a culled patch has no slot");
    let is_triangle = matches!(factors, PatchFactors::Triangle(_));
    let outer = if is_triangle { 3 } else { 4 };
    let points: Vec<u32> = factors.iter().map(|factor| factor.context.points).collect();
    // Edges 0 and 2 of a quad run along v, the second inside factor.
    let inside = |edge: u32| if is_triangle || edge % 2 == 1 { outer } else { outer + 1 };
    let shortest = points[outer as usize..].iter().min().expect("there is an inside factor");
    let [ring, edge, p] = match patch.locate_point(i).expect("it has this point") {
        PointOrigin::Corner { corner } => return corner << 6 | FORM_CORNER << 18,
        PointOrigin::OuterEdge { edge, p } => [0, edge, p],
        PointOrigin::Ring { ring, edge, p } => [ring, edge, p],
        // A row in the centre is along the longer axis.
        PointOrigin::Centre { p } => {
            let edge = u32::from(!is_triangle && points[4] > points[5]);
            [shortest / 2, edge, p]
        }
        PointOrigin::Line { .. } => panic!("isolines have no slot"),
    };
    let is_centre = ring == shortest / 2;
    let factor = if ring == 0 { edge } else { inside(edge) };
    let descends = if is_triangle { edge != 1 } else { edge == 0 || edge == 3 };
    let last = points[factor as usize] - 1 - ring;
    let position = if descends { last - p } else { ring + p };
    let form = match is_triangle {
        true if is_centre => FORM_CORNER,
        true => edge,
        false => edge % 2,
    };
    let flags = u32::from(edge >= 2) | u32::from(is_centre) << 1;
    factor | inside(edge + 1) << 3 | position << 6 | ring << 13 | form << 18 | flags << 20
}
