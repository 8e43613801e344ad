//! Workarounds for OpenGL that wgpu leaves to its users.

use super::StageError;
use crate::error::Error;

pub(super) fn is_gl(device: &wgpu::Device) -> bool {
    device.adapter_info().backend == wgpu::Backend::Gl
}

/// The attributes of the stage's vertex buffer.
///
/// On OpenGL the buffer is also bound to every location that has no attribute, although nothing
/// reads it there. wgpu leaves locations enabled that another pipeline used. Once the buffer of
/// such a location is gone, OpenGL ES refuses indirect draws, and draws nothing.
pub(super) fn attributes(
    device: &wgpu::Device,
    own: &[wgpu::VertexAttribute],
) -> Vec<wgpu::VertexAttribute> {
    let count = if is_gl(device) { device.limits().max_vertex_attributes } else { 0 };
    let is_free = |location: &u32| own.iter().all(|one| one.shader_location != *location);
    let format = wgpu::VertexFormat::Uint32x2;
    let unread = (0..count).filter(is_free).map(|shader_location| wgpu::VertexAttribute {
        format,
        offset: 0,
        shader_location,
    });
    own.iter().copied().chain(unread).collect()
}

/// Refuses a vertex shader whose struct `Vertex` has a member that takes the value of a primitive's
/// first vertex, since OpenGL takes the last vertex's.
pub(super) fn check_flat_members(device: &wgpu::Device, shader: &str) -> Result<(), Error> {
    if !is_gl(device) {
        return Ok(());
    }
    match first_vertex_member(shader) {
        Some(member) => Err(StageError::FlatOfFirstVertex { member }.into()),
        None => Ok(()),
    }
}

/// The first member of `Vertex` that is `@interpolate(flat)` or `@interpolate(flat, first)`.
#[cfg(not(target_arch = "wasm32"))]
fn first_vertex_member(shader: &str) -> Option<String> {
    use wgpu::naga::{Binding, Interpolation, Sampling, TypeInner, front::wgsl};
    // wgpu reports a text that does not compile.
    let module = wgsl::parse_str(shader).ok()?;
    let vertex = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some("Vertex"))?.1;
    let TypeInner::Struct { members, .. } = &vertex.inner else { return None };
    let member = members.iter().find(|member| {
        matches!(
            member.binding,
            Some(Binding::Location {
                interpolation: Some(Interpolation::Flat),
                sampling: None | Some(Sampling::First),
                ..
            })
        )
    });
    member?.name.clone()
}

/// Never called: a browser's OpenGL has no compute shaders, so no stage is built.
#[cfg(target_arch = "wasm32")]
fn first_vertex_member(_: &str) -> Option<String> {
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flat_members_of_the_vertex_are_found() {
        for (attribute, is_first) in [
            ("@interpolate(flat)", true),
            ("@interpolate(flat, first)", true),
            ("@interpolate(flat, either)", false),
            ("@interpolate(linear)", false),
            ("", false),
        ] {
            let shader = format!(
                "struct Other {{ @location(0) @interpolate(flat) a: f32 }}\n\
                 struct Vertex {{ @builtin(position) p: vec4<f32>, @location(0) {attribute} b: f32 }}"
            );
            let expected = is_first.then(|| "b".to_owned());
            assert_eq!(first_vertex_member(&shader), expected, "{attribute}");
        }
    }
}
