//! The stage's own bind group of a draw, which follows the user's: the buffers that points are
//! pulled from, and the factors that `tess_factors` reads.
//!
//! Materials of one stage may differ in whether they read factors, so there are up to two groups.
//! Each output has its own, made when a draw first needs it. Layouts and groups are made from the
//! same list ([`bindings`]).

use super::choices::Points;
use super::room::Form;
use super::source::FACTORS_BINDING;
use crate::device::pipeline;
use crate::error::Error;
use crate::{Batch, Tessellator};
use std::sync::OnceLock;
use tess_gpu::layout::Job;
use tess_gpu::{Access, Binding, Pull, Resource, Span};

/// The layout of the own bind group of a material's draws.
#[derive(Clone, Debug)]
pub(super) struct OwnLayout {
    form: Form,
    has_factors: bool,
    layout: wgpu::BindGroupLayout,
}

/// The bind groups of one output: without and with the factors.
#[derive(Debug, Default)]
pub(super) struct OwnGroups([OnceLock<wgpu::BindGroup>; 2]);

impl OwnLayout {
    /// The layout for a material that reads the factors or not; `None` if its draws bind nothing.
    pub(super) fn new(
        tessellator: &Tessellator,
        form: Form,
        has_factors: bool,
    ) -> Result<Option<Self>, Error> {
        let entry = |(number, resource)| {
            let visibility = match resource {
                Resource::Factors => wgpu::ShaderStages::VERTEX_FRAGMENT,
                _ => wgpu::ShaderStages::VERTEX,
            };
            pipeline::entry(number, Binding(resource, Access::Read), visibility)
        };
        let entries: Vec<_> = bindings(form, has_factors).map(entry).collect();
        if entries.is_empty() {
            return Ok(None);
        }
        let layout = tessellator.pipelines().layout("of draws", entries)?;
        Ok(Some(Self { form, has_factors, layout }))
    }

    /// The number of storage buffers that a vertex shader binds.
    pub(super) fn storage_buffers(&self) -> u32 {
        let storage = bindings(self.form, self.has_factors).filter(|one| one.1 != Resource::Job);
        u32::try_from(storage.count()).unwrap_or(u32::MAX)
    }

    pub(super) const fn layout(&self) -> &wgpu::BindGroupLayout {
        &self.layout
    }
}

impl OwnGroups {
    /// The group of this layout over a batch, to which `self` belongs.
    pub(super) fn of(
        &self,
        device: &wgpu::Device,
        of: &OwnLayout,
        batch: &Batch,
    ) -> Result<&wgpu::BindGroup, Error> {
        let OwnLayout { form, has_factors, layout } = of;
        let made = &self.0[usize::from(*has_factors)];
        if let Some(group) = made.get() {
            return Ok(group);
        }
        let bound = |(number, resource)| match resource {
            Resource::Job => {
                let job = Span { offset: 0, size: size_of::<Job>() as u64 };
                (number, batch.buffers().bound(resource, job))
            }
            _ => (number, batch.buffers().of(resource).as_entire_binding()),
        };
        let bindings = bindings(*form, *has_factors).map(bound);
        let group = pipeline::group(device, "of draws", layout, bindings)?;
        Ok(made.get_or_init(|| group))
    }
}

/// The bindings of a draw, by number.
fn bindings(form: Form, has_factors: bool) -> impl Iterator<Item = (u32, Resource)> {
    let pulled = if form.points.are_written() { 0 } else { usize::MAX };
    let pull = Pull { group: 0, first_binding: 0 };
    let factors = has_factors.then_some((FACTORS_BINDING, Resource::Factors));
    pull.bindings(form.setup).take(pulled).chain(factors)
}

/// Whether draws need the stage's own bind group.
pub(super) const fn is_needed(points: Points, has_factors: bool) -> bool {
    !points.are_written() || has_factors
}
