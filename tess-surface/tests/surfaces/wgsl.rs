//! The WGSL modules are valid, alone or joined, and have the functions that their users call.

use naga::valid::{Capabilities, ValidationFlags, Validator};
use tess_surface::shaders::{BEZIER, FACTORS, FLAT, PN_TRIANGLE, POINT_NORMAL};

/// The names of a module's functions, if it is valid.
fn functions(text: &str) -> Result<Vec<String>, String> {
    let module = naga::front::wgsl::parse_str(text).map_err(|e| e.emit_to_string(text))?;
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
    validator.validate(&module).map_err(|e| e.emit_to_string(text))?;
    Ok(module.functions.iter().filter_map(|(_, function)| function.name.clone()).collect())
}

#[test]
fn modules_are_valid() {
    let joined = [BEZIER, FACTORS, POINT_NORMAL, PN_TRIANGLE, FLAT].join("\n");
    for (text, expected) in [
        (BEZIER, &["bezier_patch", "bezier_patch_position", "bezier_patch_normal"][..]),
        (POINT_NORMAL, &["pn_triangle_position", "pn_triangle_normal", "pn_quad_normal"]),
        (FLAT, &["flat_triangle", "flat_quad", "displaced_position", "displaced_normal"]),
        (&joined, &["factor_by_distance", "factor_by_screen_space", "factor_by_flatness"]),
        (&joined, &["pn_triangle_point"]),
    ] {
        let names = functions(text).unwrap_or_else(|error| panic!("{error}"));
        let has = |name: &&str| names.iter().any(|known| known == name);
        assert!(expected.iter().all(has), "{expected:?} are among {names:?}");
    }
}

#[test]
fn a_broken_module_is_told() {
    let broken = BEZIER.replacen("return", "retrun", 1);
    assert!(functions(&broken).is_err(), "a misspelt keyword");
    let broken = FLAT.replacen("-> vec3f", "-> f32", 1);
    assert!(functions(&broken).is_err(), "a wrong type");
}
