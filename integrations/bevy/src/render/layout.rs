//! Bindings of the shaders: types.wgsl and surface.wgsl in Rust.

use super::extract::Item;
use crate::detail::LevelOfDetail;
use crate::eye::View;
use bevy::math::{Mat3, Mat4};
use bevy::pbr::{MeshFlags, MeshTransforms, MeshUniform};
use bevy::render::render_resource::{
    BindGroupLayoutDescriptor, BindGroupLayoutEntry, BindingType, BufferBindingType, ShaderStages,
    encase,
};
use bytemuck::{Pod, Zeroable};

/// `TessView` of types.wgsl.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct GpuView {
    clip_from_world: [[f32; 4]; 4],
    eye: [f32; 3],
    pixels_per_unit: f32,
    is_orthographic: u32,
    reserved: [u32; 3],
    planes: [[f32; 4]; 6],
}

impl From<View> for GpuView {
    fn from(view: View) -> Self {
        Self {
            clip_from_world: view.clip_from_world.to_cols_array_2d(),
            eye: view.eye.to_array(),
            pixels_per_unit: view.pixels_per_unit,
            is_orthographic: view.is_orthographic.into(),
            reserved: [0; 3],
            planes: view.planes.map(|plane| plane.to_array()),
        }
    }
}

/// `TessInstance` of types.wgsl.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct GpuInstance {
    world_from_local: [[f32; 4]; 4],
    normal_from_local: [[f32; 4]; 4],
    previous_from_world: [[f32; 4]; 4],
    rule: [f32; 4],
    first_patch: u32,
    first_word: u32,
    first_value: u32,
    reserved: u32,
}

impl GpuInstance {
    /// The instance of an entity. `firsts` are the numbers of its first patch, word and value.
    pub(crate) fn new(item: &Item, firsts: [u32; 3], is_visible: bool) -> Self {
        let [first_patch, first_word, first_value] = firsts;
        let linear = Mat3::from(item.world_from_local.matrix3);
        Self {
            world_from_local: Mat4::from(item.world_from_local).to_cols_array_2d(),
            normal_from_local: Mat4::from_mat3(linear.inverse().transpose()).to_cols_array_2d(),
            previous_from_world: Mat4::from(item.previous_from_world).to_cols_array_2d(),
            rule: if is_visible { item.rule.words() } else { LevelOfDetail::HIDDEN },
            first_patch,
            first_word,
            first_value,
            reserved: 0,
        }
    }

    /// Marks the instance as one that the camera does not see.
    pub(crate) const fn hide(&mut self) {
        self.rule = LevelOfDetail::HIDDEN;
    }
}

/// The words that Bevy's fragment functions read of each entity.
pub(crate) fn meshes(items: &[&Item]) -> Vec<u32> {
    let of = |item: &&Item| {
        // With this sign, fragments learn which side is in front, even if the transform mirrors the
        // triangles.
        let mut flags = MeshFlags::SIGN_DETERMINANT_MODEL_3X3;
        flags.set(MeshFlags::SHADOW_RECEIVER, item.receives_shadows);
        let world_from_local = item.world_from_local.into();
        let flags = flags.bits();
        let transforms =
            MeshTransforms { world_from_local, previous_world_from_local: world_from_local, flags };
        let slot = item.material.as_ref().map_or(0, |material| material.slot);
        MeshUniform::new(&transforms, 0, slot.into(), None, None, None, None, None)
    };
    let meshes: Vec<_> = items.iter().map(of).collect();
    let mut buffer = encase::StorageBuffer::new(Vec::<u8>::new());
    buffer.write(&meshes).expect("a vector grows");
    bytemuck::pod_collect_to_vec(&buffer.into_inner())
}

/// The layout of the plugin's bind group, in compute and render passes.
pub(crate) fn bind_group_layout() -> BindGroupLayoutDescriptor {
    let entry = |binding, visibility| BindGroupLayoutEntry {
        binding,
        visibility,
        ty: BindingType::Buffer {
            ty: match binding {
                1 => BufferBindingType::Uniform,
                _ => BufferBindingType::Storage { read_only: true },
            },
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    };
    let surface = ShaderStages::COMPUTE | ShaderStages::VERTEX;
    let everywhere = surface | ShaderStages::FRAGMENT;
    let entries = [ShaderStages::FRAGMENT, everywhere, everywhere, surface, surface, surface];
    let mut binding = 0..;
    let entries = entries.map(|visibility| entry(binding.next().unwrap_or(0), visibility));
    BindGroupLayoutDescriptor::new("bevy_tess", &entries)
}
