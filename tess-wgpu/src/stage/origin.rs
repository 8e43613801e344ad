//! Where the factors of a frame come from: the pass that writes them.

use super::builder::StageBuilder;
use super::choices::Factors;
use super::passes;
use super::room::Form;
use super::{modules, source};
use crate::error::Error;
use crate::gpu;
use tess_gpu::{Access, Resource};
use wgpu::BufferUsages as Usage;

/// The pass that writes the raw factors of a frame.
#[derive(Debug)]
pub(super) struct Origin {
    pipeline: wgpu::ComputePipeline,
    /// Its own bindings and their group.
    own: wgpu::BindGroup,
    own_group: u32,
    workgroups: [u32; 2],
    /// The factors from the host, if that is where they come from.
    pub(super) host: Option<wgpu::Buffer>,
}

/// Refuses a buffer that does not hold the factors.
pub(super) fn check(given: &wgpu::Buffer, needed: u64) -> Result<(), Error> {
    if given.size() < needed {
        return Err(Error::FactorsTooShort { needed, got: given.size() });
    }
    if !given.usage().contains(Usage::STORAGE) {
        return Err(Error::NotStorage { buffer: Resource::Factors });
    }
    Ok(())
}

impl Origin {
    /// `factors` and `count` are the stage's: the pass reads the number of patches and writes the factors.
    pub(super) async fn new(
        builder: &StageBuilder<'_>,
        form: Form,
        device: &wgpu::Device,
        [factors, count]: [&wgpu::Buffer; 2],
    ) -> Result<Self, Error> {
        let StageBuilder { source: user, patches, layouts, .. } = builder;
        let setup = form.setup;
        let mut own = vec![(factors, Access::ReadWrite), (count, Access::Read)];
        let workgroups = passes::workgroups(device, *patches);
        let given = match builder.factors {
            Factors::Hull => {
                let own_group = builder.own_group();
                let joined = source::of_hull(user, setup.domain, own_group);
                let module = modules::user_module(device, "hull", user, joined).await?;
                let (layout, own) = passes::bind(device, "hull", &own)?;
                let layouts: Vec<_> = layouts.iter().chain([&layout]).collect();
                let pipeline = passes::pipeline(device, &module, "tess_hull", &layouts)?;
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
        let (layout, own) = passes::bind(device, "copy factors", &own)?;
        let source = include_str!("../../shaders/copy_factors.wgsl")
            .replace("FACTORS", &format!("{}u", setup.factors()));
        let module = passes::module(device, "copy factors", source)?;
        let pipeline = passes::pipeline(device, &module, "copy_factors", &[&layout])?;
        let host = matches!(builder.factors, Factors::Host).then_some(given);
        Ok(Self { pipeline, own, own_group: 0, workgroups, host })
    }

    /// Records the pass; `user` are the user's bind groups.
    pub(super) fn encode(&self, encoder: &mut wgpu::CommandEncoder, user: &[wgpu::BindGroup]) {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("factors"),
            timestamp_writes: None,
        });
        pass.set_pipeline(&self.pipeline);
        for (number, group) in (0..self.own_group).zip(user) {
            pass.set_bind_group(number, group, &[]);
        }
        pass.set_bind_group(self.own_group, &self.own, &[]);
        pass.dispatch_workgroups(self.workgroups[0], self.workgroups[1], 1);
    }
}
