//! Surfaces as WGSL text, for shaders that compute factors or evaluate domain points themselves.
//!
//! Each module has functions only: no bindings and no entry points. Join the modules that you need, and those that they
//! need, with your own text, in any order. The formulas are those of [`tess-surface`](https://docs.rs/tess-surface);
//! comments name its files.
//!
//! The tessellation stage of `tess-wgpu` joins [`HELPERS`] to every hull and domain function by itself; leave the modules
//! in it out there. Names that begin with `tess_` are in `HELPERS`, all others are not.
//!
//! Within one pipeline both sides of an edge get the same bits, because they call the same function with the same
//! values. The CPU's results and other devices' may differ in their last bits: WGSL allows devices to fuse operations,
//! and to divide and take roots with errors of some units in the last place.

/// The text of a module.
macro_rules! module {
    ($name:literal) => {
        include_str!(concat!("../shaders/surfaces/", $name, ".wgsl"))
    };
}

/// The modules that the stage of `tess-wgpu` joins to the user's functions: [`FLAT`], [`PN_EDGE`], [`FACTORS`],
/// [`CULLING`], [`HEIGHT`].
pub const HELPERS: &str = concat!(
    module!("flat"),
    "\n",
    module!("pn_edge"),
    "\n",
    module!("factors"),
    "\n",
    module!("culling"),
    "\n",
    module!("height"),
);

/// Lines, bilinear quads and flat triangles, closed along edges.
pub const FLAT: &str = module!("flat");

/// The inner control points of a point-normal edge.
pub const PN_EDGE: &str = module!("pn_edge");

/// Factor rules for edges and insides. Needs [`PN_EDGE`].
pub const FACTORS: &str = module!("factors");

/// Tests that cull patches.
pub const CULLING: &str = module!("culling");

/// Height images.
pub const HEIGHT: &str = module!("height");

/// Curves, edges in canonical direction, bicubic patches and their normals.
pub const BEZIER: &str = module!("bezier");

/// Factor rules for cubic edges. Needs [`BEZIER`], [`FACTORS`] and [`PN_EDGE`].
pub const BEZIER_FACTORS: &str = module!("bezier_factors");

/// Point-normal triangles and quads. Needs [`PN_EDGE`].
pub const POINT_NORMAL: &str = module!("pn");

/// A point-normal triangle at a domain point, closed along its edges. Needs [`BEZIER`], [`POINT_NORMAL`] and
/// [`PN_EDGE`].
pub const PN_TRIANGLE: &str = module!("pn_triangle");

/// Positions and normals of displaced surfaces.
pub const DISPLACEMENT: &str = module!("displacement");

#[cfg(test)]
mod tests {
    use super::*;
    use naga::valid::{Capabilities, ValidationFlags, Validator};

    /// The names of a module's functions, if it is valid.
    fn functions(text: &str) -> Result<Vec<String>, String> {
        let module = naga::front::wgsl::parse_str(text).map_err(|e| e.emit_to_string(text))?;
        let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
        validator.validate(&module).map_err(|e| e.emit_to_string(text))?;
        Ok(module.functions.iter().filter_map(|(_, function)| function.name.clone()).collect())
    }

    /// Every module with those that it needs is valid, and has the functions that its users call.
    #[test]
    fn modules_are_valid() {
        for (module, needs, expected) in [
            (FLAT, &[][..], &["tess_along", "tess_on_quad", "tess_on_triangle"][..]),
            (PN_EDGE, &[], &["tess_pn_edge_point"]),
            (FACTORS, &[PN_EDGE], &["tess_edge_by_distance", "tess_inside_quad"]),
            (CULLING, &[], &["tess_is_outside", "tess_faces_away"]),
            (HEIGHT, &[], &["tess_sample", "tess_bilinear"]),
            (BEZIER, &[], &["bezier_patch", "bezier_patch_position", "bezier_patch_normal"]),
            (BEZIER_FACTORS, &[BEZIER, FACTORS, PN_EDGE], &["bezier_edge_by_distance"]),
            (
                POINT_NORMAL,
                &[PN_EDGE],
                &["pn_triangle_position", "pn_triangle_normal", "pn_quad_normal"],
            ),
            (PN_TRIANGLE, &[BEZIER, POINT_NORMAL, PN_EDGE], &["pn_triangle_point"]),
            (DISPLACEMENT, &[], &["displaced_position", "displaced_normal"]),
            (HELPERS, &[BEZIER, BEZIER_FACTORS, POINT_NORMAL, PN_TRIANGLE, DISPLACEMENT], &[]),
        ] {
            let names = functions(&[&[module], needs].concat().join("\n"))
                .unwrap_or_else(|error| panic!("{error}"));
            let has = |name: &&str| names.iter().any(|known| known == name);
            assert!(expected.iter().all(has), "{expected:?} are among {names:?}");
        }
    }

    /// Users may declare any name without the prefix, and the modules beside them.
    #[test]
    fn helpers_have_the_prefix() {
        let names = functions(HELPERS).unwrap_or_else(|error| panic!("{error}"));
        assert!(names.iter().all(|name| name.starts_with("tess_")), "{names:?}");
        let others = [BEZIER, BEZIER_FACTORS, POINT_NORMAL, PN_TRIANGLE, DISPLACEMENT, HELPERS];
        let all = functions(&others.join("\n")).unwrap_or_else(|error| panic!("{error}"));
        let prefixed = all.iter().filter(|name| name.starts_with("tess_")).count();
        assert_eq!(prefixed, names.len(), "no others have it: {all:?}");
    }

    #[test]
    fn a_broken_module_is_told() {
        let broken = BEZIER.replacen("return", "retrun", 1);
        assert!(functions(&broken).is_err(), "a misspelt keyword");
        let broken = FLAT.replacen("-> vec4<f32>", "-> f32", 1);
        assert!(functions(&broken).is_err(), "a wrong type");
    }
}
