//! The Bevy plugin's WGSL is valid with the helpers. Its own tests need Bevy, which continuous
//! integration leaves out.

use tess_gpu::surfaces::{BEZIER, PN_TRIANGLE, POINT_NORMAL};
use tess_wgpu::TessellationStage;
use wgpu::naga::front::wgsl;
use wgpu::naga::valid::{Capabilities, ValidationFlags, Validator};

/// A shader of the plugin.
macro_rules! shader {
    ($name:literal) => {
        include_str!(concat!("../../../integrations/bevy/shaders/", $name))
    };
}

/// The error in a shape's WGSL, joined with the plugin's and the stage's.
fn complaint(shape: &[&str]) -> Option<String> {
    let own = [shader!("types.wgsl"), shader!("surface.wgsl"), shader!("project.wgsl")];
    // The replacements of program.rs and height_field.rs.
    let user =
        [shape, &own].concat().join("\n").replace("TESS_GROUP", "2").replace("HEADER", "20u");
    let source = TessellationStage::joined(&user, "");
    let module = match wgsl::parse_str(&source) {
        Ok(module) => module,
        Err(error) => return Some(error.emit_to_string(&source)),
    };
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
    validator.validate(&module).err().map(|error| error.emit_to_string(&source))
}

#[test]
fn the_wgsl_of_the_bevy_plugin_is_valid() {
    let rounded =
        [BEZIER, POINT_NORMAL, PN_TRIANGLE, shader!("point_normal.wgsl"), shader!("rounded.wgsl")];
    for shape in
        [&[shader!("height_field.wgsl")][..], &[BEZIER, shader!("bezier_patches.wgsl")], &rounded]
    {
        assert_eq!(complaint(shape), None, "the stage takes it");
    }
    let broken = shader!("height_field.wgsl").replace("tess_bilinear", "tess_trilinear");
    assert!(complaint(&[&broken]).is_some(), "a helper that is not there");
}
