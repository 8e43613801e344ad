//! The pass that writes a frame's raw factors: it runs the user's `hull`, or copies factors of the
//! host or of a buffer.

use super::builder::StageBuilder;
use super::choices::Factors;
use super::passes;
use super::room::Form;
use super::user_groups::UserGroups;
use super::{mistakes, modules, source, wgsl};
use crate::Tessellator;
use crate::device::pipelines::PipelineKey;
use crate::device::{gpu, pipeline};
use crate::error::Error;
use std::sync::Arc;
use tess_gpu::{Access, Resource, Setup};
use wgpu::BufferUsages as Usage;

/// The pass's pipeline and its bindings.
#[derive(Debug)]
pub(super) struct FactorPass {
    pipeline: Arc<wgpu::ComputePipeline>,
    /// The bind group of the stage's own buffers.
    own: wgpu::BindGroup,
    own_group: u32,
    workgroups: [u32; 2],
    /// The factors from the host, with [`Factors::Host`].
    pub(super) host: Option<wgpu::Buffer>,
}

/// Refuses a buffer that cannot hold the factors.
pub(super) fn check(given: &wgpu::Buffer, needed: u64) -> Result<(), Error> {
    if given.size() < needed {
        return Err(Error::FactorsTooShort { needed, got: given.size() });
    }
    if !given.usage().contains(Usage::STORAGE) {
        return Err(Error::NotStorage { buffer: Resource::Factors });
    }
    Ok(())
}

impl FactorPass {
    /// `factors` and `count` are the stage's: the pass reads the number of patches and writes the
    /// factors.
    pub(super) async fn new(
        builder: &StageBuilder<'_>,
        (form, tessellator): (Form, &Tessellator),
        [factors, count]: [&wgpu::Buffer; 2],
    ) -> Result<Self, Error> {
        let (setup, device) = (form.setup, tessellator.device());
        let mut own = vec![(factors, Access::ReadWrite), (count, Access::Read)];
        let workgroups = passes::workgroups(device, builder.patches);
        let given = match builder.factors {
            Factors::Hull => {
                let (layout, own) = passes::bind(tessellator, "hull", &own)?;
                let pipeline = hull(builder, setup, tessellator, layout).await?;
                let own_group = builder.program.own_group();
                return Ok(Self { pipeline, own, own_group, workgroups, host: None });
            }
            Factors::Host => {
                let size = form.factor_bytes();
                let usage = Usage::STORAGE | Usage::COPY_DST;
                gpu::empty(device, "factors from the host", size, usage)?
            }
            Factors::Buffer(given) => given.clone(),
        };
        own.push((&given, Access::Read));
        let (layout, own) = passes::bind(tessellator, "copy factors", &own)?;
        let text = source::of_copying(setup);
        let (layouts, constants) = (vec![layout], Vec::new());
        let key = PipelineKey { text, entry_point: "copy_factors", layouts, constants };
        let text = key.text.clone();
        let pipeline =
            passes::pipeline(tessellator, key, || pipeline::module(device, "copy factors", text))?;
        let host = matches!(builder.factors, Factors::Host).then_some(given);
        Ok(Self { pipeline, own, own_group: 0, workgroups, host })
    }

    /// Records the pass; `user` are the user's bind groups.
    pub(super) fn encode(&self, encoder: &mut wgpu::CommandEncoder, user: &UserGroups) {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("factors"),
            timestamp_writes: None,
        });
        pass.set_pipeline(&self.pipeline);
        for (number, group, offsets) in user.iter().take(self.own_group as usize) {
            pass.set_bind_group(number, group, offsets);
        }
        pass.set_bind_group(self.own_group, &self.own, &[]);
        pass.dispatch_workgroups(self.workgroups[0], self.workgroups[1], 1);
    }
}

/// The pipeline of the user's function `hull`. Stages of one tessellator share it if their texts
/// differ only in parts that the function does not reach.
async fn hull(
    builder: &StageBuilder<'_>,
    setup: Setup,
    tessellator: &Tessellator,
    layout: wgpu::BindGroupLayout,
) -> Result<Arc<wgpu::ComputePipeline>, Error> {
    let program = &builder.program;
    let (user, own_group) = (program.source, program.own_group());
    let declared = wgsl::declarations(user);
    let reached = wgsl::reached(&declared, &["hull"]).into_iter().map(|one| one.text);
    let text = |user: &str| source::of_hull(user, setup.domain, own_group);
    let key = program.key(text(&reached.collect::<String>()), "tess_hull", Some(&layout));
    if let Some(pipeline) = tessellator.pipelines().passes.find(&key) {
        return Ok(pipeline);
    }
    let module = modules::user_module(tessellator.device(), "hull", user, text(user)).await?;
    passes::pipeline(tessellator, key, || Ok(module))
        .map_err(|error| mistakes::counted(error, "hull", 2))
        .map_err(|error| mistakes::explained(error, user, "COMPUTE"))
}
