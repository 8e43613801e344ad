//! Shapes: their patches, their WGSL, and its Rust form.

use crate::eye::Eye;
use bevy::asset::Handle;
use bevy::camera::primitives::Aabb;
use bevy::ecs::error::BevyError;
use bevy::image::Image;
use std::borrow::Cow;
use std::fmt::Debug;
use std::sync::Arc;
use tess_core::{Domain, OutputPrimitive, PatchFactors};

/// The default fragment shader: Bevy's lighting of the entity's material.
pub const DEFAULT_FRAGMENT: &str = include_str!("../shaders/default_fragment.wesl");

/// Patches, and the functions that make them a surface.
///
/// Entities whose shapes have the same texts, domain and winding are tessellated in one call.
pub trait Shape: Debug + Send + Sync + 'static {
    /// The domain of the patches: [`Domain::Quad`] or [`Domain::Triangle`].
    fn domain(&self) -> Domain;

    /// The winding of triangles that face outwards: [`OutputPrimitive::TriangleCw`] if the cross
    /// product of the derivatives by u and by v points outwards, [`OutputPrimitive::TriangleCcw`]
    /// if it points inwards.
    fn winding(&self) -> OutputPrimitive {
        OutputPrimitive::TriangleCw
    }

    /// The number of patches.
    fn patches(&self) -> u32;

    /// A box in local space that holds the whole surface, whatever its values.
    fn bounds(&self) -> Aabb;

    /// WGSL with `fn hull(number: u32) -> QuadFactors` (or `TriFactors`) and
    /// `fn domain(number: u32, uv: vec2<f32>) -> Vertex`. It may call the functions in [the crate's
    /// table](crate#functions-of-your-own), and must not declare names that begin with `tess_`.
    fn surface(&self) -> Cow<'static, str>;

    /// WESL with one `@fragment` function of a `Vertex`; it may import from Bevy.
    fn fragment(&self) -> Cow<'static, str> {
        Cow::Borrowed(DEFAULT_FRAGMENT)
    }

    /// The words that `surface` reads with `tess_uint` and `tess_float`. They are uploaded once. To
    /// change a surface, give the entity another shape, or use [`TessValues`](crate::TessValues).
    fn words(&self) -> Vec<u32>;

    /// The image that the shape is made of, and whether the shape already has its contents.
    /// [`Self::of_image`] is called when the image is loaded and whenever it changes.
    fn image(&self) -> Option<(&Handle<Image>, bool)> {
        None
    }

    /// The same shape with the present contents of its image.
    ///
    /// # Errors
    /// The reason why the image cannot be used; the entity then keeps its shape.
    fn of_image(&self, _: &Image) -> Result<Arc<dyn Shape>, BevyError> {
        Err("the shape is not made of an image".into())
    }

    /// The Rust form of `hull` and `domain`, for picking and for devices without compute shaders.
    /// If there is none, the shape is not drawn on such a device, and the log says so.
    fn on_cpu(&self) -> Option<&dyn CpuShape> {
        None
    }
}

/// The Rust form of a shape's functions.
pub trait CpuShape {
    /// `hull` in Rust: the factors of a patch.
    fn factors(&self, patch: u32, eye: &Eye) -> PatchFactors;

    /// `domain` in Rust, in local space: appends a vertex for each of these domain points of a
    /// patch.
    fn vertices(&self, patch: u32, eye: &Eye, points: &[[f32; 2]], vertices: &mut Vec<ShapeVertex>);
}

/// A vertex in local space.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ShapeVertex {
    /// Its position.
    pub position: [f32; 3],
    /// Its normal, of unit length.
    pub normal: [f32; 3],
    /// Its texture coordinates.
    pub uv: [f32; 2],
    /// A linear colour, by which the material's is multiplied.
    pub color: [f32; 4],
}
