//! The stage's own bind group of a draw, which follows the user's: the buffers that points are
//! pulled from, and the factors that `tess_factors` reads.
//!
//! A stage and those that draw its output may differ in whether they read factors, so there are up
//! to two groups. They are made again with the batch whenever the room changes.

use super::choices::Points;
use super::room::Form;
use super::source::FACTORS_BINDING;
use crate::device::pipeline;
use crate::error::Error;
use crate::{Batch, Tessellator};
use tess_gpu::layout::Job;
use tess_gpu::{Access, Binding, Pull, Resource, Span};

/// The bind groups without and with the factors, if a stage asked for them ([`OwnGroups::ask`]).
#[derive(Clone, Debug, Default)]
pub(super) struct OwnGroups {
    layouts: [Option<wgpu::BindGroupLayout>; 2],
    groups: [Option<wgpu::BindGroup>; 2],
}

impl OwnGroups {
    /// The layout for a stage that reads the factors or not; `None` if its draws bind nothing.
    pub(super) fn ask(
        &mut self,
        tessellator: &Tessellator,
        form: Form,
        has_factors: bool,
    ) -> Result<Option<wgpu::BindGroupLayout>, Error> {
        let pulled = if form.points.are_written() { 0 } else { usize::MAX };
        let mut bindings: Vec<_> = pull().bindings(form.setup).take(pulled).collect();
        bindings.extend(has_factors.then_some((FACTORS_BINDING, Resource::Factors)));
        if bindings.is_empty() {
            return Ok(None);
        }
        let entry = |(number, resource)| {
            let visibility = match resource {
                Resource::Factors => wgpu::ShaderStages::VERTEX_FRAGMENT,
                _ => wgpu::ShaderStages::VERTEX,
            };
            pipeline::entry(number, Binding(resource, Access::Read), visibility)
        };
        let entries = bindings.into_iter().map(entry).collect();
        let layout = tessellator.pipelines().layout("of draws", entries)?;
        self.layouts[usize::from(has_factors)] = Some(layout.clone());
        Ok(Some(layout))
    }

    /// The same layouts, with bind groups for this batch.
    pub(super) fn with(
        &self,
        tessellator: &Tessellator,
        form: Form,
        (batch, factors): (&Batch, &wgpu::Buffer),
    ) -> Result<Self, Error> {
        let mut made = self.clone();
        let is_pulled = !form.points.are_written();
        for (has_factors, layout) in [false, true].into_iter().zip(&self.layouts) {
            let Some(layout) = layout else { continue };
            let bound = |(number, resource)| match resource {
                Resource::Job => {
                    let job = Span { offset: 0, size: size_of::<Job>() as u64 };
                    (number, batch.buffers().bound(resource, job))
                }
                _ => (number, batch.buffers().of(resource).as_entire_binding()),
            };
            let pulled = pull().bindings(form.setup).filter(|_| is_pulled).map(bound);
            let factors = has_factors.then(|| (FACTORS_BINDING, factors.as_entire_binding()));
            let group =
                pipeline::group(tessellator.device(), "of draws", layout, pulled.chain(factors))?;
            made.groups[usize::from(has_factors)] = Some(group);
        }
        Ok(made)
    }

    /// The group of a stage that reads the factors or not.
    pub(super) const fn of(&self, has_factors: bool) -> Option<&wgpu::BindGroup> {
        self.groups[has_factors as usize].as_ref()
    }
}

const fn pull() -> Pull {
    Pull { group: 0, first_binding: 0 }
}

/// Whether draws need the stage's own bind group.
pub(super) const fn is_needed(points: Points, has_factors: bool) -> bool {
    !points.are_written() || has_factors
}
