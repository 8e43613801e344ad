//! The render pipeline and bind groups that draw a stage's frames.

mod build;
mod builder;

pub use builder::MaterialBuilder;

use super::frame::{Frame, WeakCount};
use super::own_group::OwnLayout;
use super::user_groups::UserGroups;
use super::vertex::Load;
use super::{StageError, TessellationStage};
use crate::device::gpu;
use crate::error::Error;
use std::sync::Arc;

/// Draws the frames of a stage: with a fragment shader, as a shadow map, as a depth prepass.
///
/// Any number of materials can draw one frame. Each has WGSL of its own, which declares the stage's
/// `struct Vertex` and, unless points are evaluated, a function `domain`
/// ([`TessellationStage::material`]).
#[derive(Debug)]
pub struct Material {
    device: wgpu::Device,
    /// The better way comes first; the last one is for every frame.
    ways: Vec<Way>,
    bind_groups: UserGroups,
    stage: WeakCount,
    /// Held as long as the material lives, for [`StageError::ProjectForgotten`].
    _kind: Option<Arc<()>>,
}

/// A way to draw a frame.
#[derive(Debug)]
struct Way {
    load: Load,
    /// The most bytes of evaluated vertices that a frame may have.
    most_bytes: u64,
    pipeline: Arc<wgpu::RenderPipeline>,
    /// The layout of the stage's own bind group, if the draws need one.
    own: Option<OwnLayout>,
}

impl TessellationStage {
    /// Returns a builder for a material with this WGSL. It can be the text that the stage was made
    /// with, or another with the same `struct Vertex`.
    pub fn material<'a>(&'a self, source: &'a str) -> MaterialBuilder<'a> {
        MaterialBuilder::new(self, source)
    }
}

impl Material {
    /// Draws all patches of a frame.
    ///
    /// No method draws in a render bundle, because a bundle would keep buffers that
    /// [`TessellationStage::prepare`] may replace.
    ///
    /// # Errors
    /// [`StageError::OtherStage`], [`StageError::OldFrame`] or [`StageError::StageGone`] for this
    /// frame; [`StageError::OtherDevice`] for a pass of another instance; [`Error::OutOfMemory`].
    /// On an error nothing is drawn.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, frame: &Frame) -> Result<(), Error> {
        self.draw_as(pass, frame, None)
    }

    /// Draws one group of a frame's patches. To give the group its own textures, call
    /// [`Self::set_bind_group`] first, or make a material for it.
    ///
    /// # Errors
    /// [`StageError::NoSuchGroup`], and the errors of [`Self::draw`].
    pub fn draw_group(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        frame: &Frame,
        group: u32,
    ) -> Result<(), Error> {
        let groups = frame.output.groups();
        if group >= groups {
            return Err(StageError::NoSuchGroup { group, groups: groups as usize }.into());
        }
        self.draw_as(pass, frame, Some(group))
    }

    fn draw_as(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        frame: &Frame,
        group: Option<u32>,
    ) -> Result<(), Error> {
        frame.check(&self.stage)?;
        let bytes = frame.output.vertex_bytes();
        let fits = |way: &&Way| bytes <= way.most_bytes;
        let way = self.ways.iter().find(fits).or(self.ways.last());
        let Some(Way { load, pipeline, own, .. }) = way else { return Ok(()) };
        let own = own.as_ref().map(|layout| frame.output.own(&self.device, layout)).transpose()?;
        gpu::recorded(&self.device, || {
            pass.set_pipeline(pipeline);
            let mut next = 0;
            for (number, group, offsets) in self.bind_groups.iter() {
                pass.set_bind_group(number, group, offsets);
                next = number + 1;
            }
            if let Some(own) = own {
                pass.set_bind_group(next, own, &[]);
            }
            frame.output.draw(pass, *load, group);
        })
    }

    /// Replaces one of the user's bind groups, by its number. The next draw uses it.
    ///
    /// If the group's layout differs from the one that the builder got, wgpu reports an error when
    /// the frame's encoder is finished. The error names the group's number and the binding.
    ///
    /// # Errors
    /// [`StageError::NoSuchBindGroup`]. On an error the bind groups stay as they were.
    pub fn set_bind_group(&mut self, number: u32, group: &wgpu::BindGroup) -> Result<(), Error> {
        Ok(self.bind_groups.set(number, group)?)
    }

    /// Sets the dynamic offsets of one of the user's bind groups, in bytes and in the order of its
    /// bindings. The next draw uses them; at first there are none. If there are too many or too
    /// few, wgpu reports an error when the frame's encoder is finished.
    ///
    /// # Errors
    /// [`StageError::NoSuchBindGroup`]. On an error the offsets stay as they were.
    pub fn set_dynamic_offsets(&mut self, number: u32, offsets: &[u32]) -> Result<(), Error> {
        Ok(self.bind_groups.set_offsets(number, offsets)?)
    }
}
