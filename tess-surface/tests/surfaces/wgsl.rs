//! The WGSL modules are valid, alone or joined, and have the functions that their users call.

use naga::valid::{Capabilities, ValidationFlags, Validator};
use tess_surface::shaders::{
    BEZIER, BEZIER_FACTORS, CULLING, DISPLACEMENT, FACTORS, FLAT, HEIGHT, HELPERS, PN_EDGE,
    PN_TRIANGLE, POINT_NORMAL,
};

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
