//! The stage's own bind group of a draw, which follows the user's: the buffers that points are
//! pulled from, the vertices that are loaded from a storage buffer, and the factors that
//! `tess_factors` reads.
//!
//! Materials of one stage may differ in what they read, so there are up to four groups. Each output
//! has its own, made when a draw first needs it. Layouts and groups are made from the same list
//! ([`bindings`]).

use super::choices::Points;
use super::room::Form;
use super::source::FACTORS_BINDING;
use super::vertex::Load;
use crate::device::pipeline;
use crate::error::Error;
use crate::{Batch, Tessellator};
use std::sync::OnceLock;
use tess_gpu::layout::Job;
use tess_gpu::{Access, Binding, Pull, Resource, Span};

/// What the draws of a material read beside the points that are pulled.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reads {
    pub(super) load: Load,
    pub(super) has_factors: bool,
}

/// The layout of the own bind group of a material's draws.
#[derive(Clone, Debug)]
pub(super) struct OwnLayout {
    form: Form,
    reads: Reads,
    layout: wgpu::BindGroupLayout,
}

/// The bind groups of one output, by what the draws read.
#[derive(Debug, Default)]
pub(super) struct OwnGroups([OnceLock<wgpu::BindGroup>; 4]);

impl OwnLayout {
    /// The layout for draws that read this; `None` if they bind nothing.
    pub(super) fn new(
        tessellator: &Tessellator,
        form: Form,
        reads: Reads,
    ) -> Result<Option<Self>, Error> {
        let entry = |(number, resource)| {
            let visibility = match resource {
                Resource::Factors => wgpu::ShaderStages::VERTEX_FRAGMENT,
                _ => wgpu::ShaderStages::VERTEX,
            };
            pipeline::entry(number, Binding(resource, Access::Read), visibility)
        };
        let entries: Vec<_> = bindings(form, reads).map(entry).collect();
        if entries.is_empty() {
            return Ok(None);
        }
        let layout = tessellator.pipelines().layout("of draws", entries)?;
        Ok(Some(Self { form, reads, layout }))
    }

    /// The number of storage buffers that a vertex shader binds.
    pub(super) fn storage_buffers(&self) -> u32 {
        let storage = bindings(self.form, self.reads).filter(|one| one.1 != Resource::Job);
        u32::try_from(storage.count()).unwrap_or(u32::MAX)
    }

    pub(super) const fn layout(&self) -> &wgpu::BindGroupLayout {
        &self.layout
    }
}

impl OwnGroups {
    /// The group of this layout over a batch and its evaluated vertices, to which `self` belongs.
    pub(super) fn of(
        &self,
        device: &wgpu::Device,
        of: &OwnLayout,
        (batch, vertices): (&Batch, Option<&wgpu::Buffer>),
    ) -> Result<&wgpu::BindGroup, Error> {
        let OwnLayout { form, reads, layout } = of;
        let number = 2 * usize::from(reads.load == Load::Storage) + usize::from(reads.has_factors);
        let made = &self.0[number];
        if let Some(group) = made.get() {
            return Ok(group);
        }
        let bound = |(number, resource)| match (resource, vertices) {
            (Resource::Job, _) => {
                let job = Span { offset: 0, size: size_of::<Job>() as u64 };
                (number, batch.buffers().bound(resource, job))
            }
            (Resource::Points, Some(vertices)) => (number, vertices.as_entire_binding()),
            _ => (number, batch.buffers().of(resource).as_entire_binding()),
        };
        let bindings = bindings(*form, *reads).map(bound);
        let group = pipeline::group(device, "of draws", layout, bindings)?;
        Ok(made.get_or_init(|| group))
    }
}

/// The bindings of a draw, by number. No draw binds packed points: [`Resource::Points`] stands for
/// the vertices that were made of them.
fn bindings(form: Form, reads: Reads) -> impl Iterator<Item = (u32, Resource)> {
    let pulled = if form.points.are_written() { 0 } else { usize::MAX };
    let pull = Pull { group: 0, first_binding: 0 };
    let vertices = (reads.load == Load::Storage).then_some((0, Resource::Points));
    let factors = reads.has_factors.then_some((FACTORS_BINDING, Resource::Factors));
    pull.bindings(form.setup).take(pulled).chain(vertices).chain(factors)
}

/// Whether draws need the stage's own bind group.
pub(super) const fn is_needed(points: Points, has_factors: bool) -> bool {
    !points.are_written() || has_factors
}
