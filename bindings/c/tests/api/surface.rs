//! Factors and culling are the Rust library's, to the bit, with every argument in its place.

use proptest::prelude::{any, prop_assert_eq, proptest};
use tess_capi::surface::{
    TessCorner, TessMat4, TessVec3, tess_at_most, tess_edge_beside_halves, tess_edge_by_curvature,
    tess_edge_by_distance, tess_edge_by_length, tess_edge_by_screen_size, tess_faces_away,
    tess_inside_quad, tess_inside_triangle, tess_is_outside,
};
use tess_surface::glam::{Mat4, Vec3};
use tess_surface::{PnCorner, culling, factors};

fn vec3([x, y, z]: [f32; 3]) -> (TessVec3, Vec3) {
    (TessVec3 { x, y, z }, Vec3::new(x, y, z))
}

fn corner(position: [f32; 3], normal: [f32; 3]) -> (TessCorner, PnCorner) {
    let ((position, p), (normal, n)) = (vec3(position), vec3(normal));
    (TessCorner { position, normal }, PnCorner { position: p, normal: n })
}

type Numbers = [f32; 3];

proptest! {
    #[test]
    fn factors_are_the_library_s(
        a in proptest::array::uniform3(-4.0..4.0f32), b in proptest::array::uniform3(-4.0..4.0f32),
        eye in proptest::array::uniform3(-9.0..9.0f32),
        other in proptest::array::uniform3(-1.0..1.0f32),
        scale in 1.0..900.0f32, segment in 0.01..30.0f32,
    ) {
        let ((a, ra), (b, rb), (eye, reye)) = (vec3(a), vec3(b), vec3(eye));
        let screen = factors::edge_by_screen_size([ra, rb], reye, scale, segment);
        let of_c = tess_edge_by_screen_size(a, b, eye, scale, segment);
        prop_assert_eq!(of_c.to_bits(), screen.to_bits());
        let distance = factors::edge_by_distance([ra, rb], reye, scale);
        prop_assert_eq!(tess_edge_by_distance(a, b, eye, scale).to_bits(), distance.to_bits());
        let length = factors::edge_by_length([ra, rb], scale, segment);
        prop_assert_eq!(tess_edge_by_length(a, b, scale, segment).to_bits(), length.to_bits());
        let most = factors::at_most(scale, segment);
        prop_assert_eq!(tess_at_most(scale, segment).to_bits(), most.to_bits());
        let [whole, _] = factors::edge_beside_halves(segment);
        prop_assert_eq!(tess_edge_beside_halves(segment).to_bits(), whole.to_bits());
        let (one, rone) = corner(ra.to_array(), other);
        let (two, rtwo) = corner(rb.to_array(), reye.normalize_or_zero().to_array());
        let curved = factors::edge_by_curvature([rone, rtwo], segment);
        prop_assert_eq!(tess_edge_by_curvature(one, two, segment).to_bits(), curved.to_bits());
    }

    #[test]
    fn insides_are_the_library_s(bits in proptest::array::uniform4(any::<f32>())) {
        let [u0, v0, u1, v1] = bits;
        let [u, v] = factors::inside_quad(bits);
        prop_assert_eq!(tess_inside_quad(v0, v1).to_bits(), u.to_bits());
        prop_assert_eq!(tess_inside_quad(u0, u1).to_bits(), v.to_bits());
        let inside = factors::inside_triangle([u0, v0, u1]);
        prop_assert_eq!(tess_inside_triangle(u0, v0, u1).to_bits(), inside.to_bits());
    }
}

/// Balls on both sides of each plane, and surfaces on both sides of the horizon: half of the
/// answers are yes.
#[test]
fn culling_is_the_library_s() {
    let matrix = Mat4::from_cols_array(&[
        1.0, 0.2, 0.1, 0.1, -0.3, 1.5, 0.2, 0.2, 0.4, 0.1, 0.5, 0.7, 0.1, -0.2, 1.0, 3.0,
    ]);
    let columns = matrix.to_cols_array();
    let mut yes = [0; 2];
    for i in 0..1000u16 {
        let at = |step: u16| f32::from(i * step % 101) / 10.0 - 5.0;
        let center: Numbers = [at(7), at(11), at(13)];
        let (radius, sine) = (0.02 + at(17).abs() / 4.0, at(3).abs() / 5.0);
        let axis = Vec3::new(at(5), at(19), at(23)).normalize_or_zero();
        let (c, rc) = vec3(center);
        let (axis, raxis) = vec3(axis.to_array());
        let (eye, reye) = vec3([at(29), at(31), at(37)]);
        let answers = [
            (
                tess_is_outside(TessMat4 { columns }, c, radius),
                culling::is_outside(&matrix, rc, radius),
            ),
            (
                tess_faces_away(c, radius, axis, sine, eye),
                culling::faces_away(rc, radius, raxis, sine, reye),
            ),
        ];
        for (yes, (ours, theirs)) in yes.iter_mut().zip(answers) {
            assert_eq!(ours, u32::from(theirs), "ball {i}");
            *yes += ours;
        }
    }
    for yes in yes {
        assert!((100..900).contains(&yes), "{yes} of 1000 answers are yes");
    }
}
