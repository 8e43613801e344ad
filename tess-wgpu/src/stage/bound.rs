//! The user's bind groups, each tried before a frame uses it.
//!
//! wgpu refuses a bind group that does not go with its layout when an encoder is finished, which is the caller's call
//! and ends the program. So each group is set and used once in an encoder that is never submitted.

use super::{StageError, passes};
use crate::error::{Error, checked};

/// Runs nothing; its pipelines have the layouts that bind groups are tried with.
const NOTHING: &str = "@compute @workgroup_size(1) fn nothing() {}";

/// The user's bind groups, by number.
#[derive(Debug)]
pub(super) struct Bound {
    groups: Vec<wgpu::BindGroup>,
    /// For each group a pipeline with its layout as group 0.
    trials: Vec<wgpu::ComputePipeline>,
}

impl Bound {
    /// Each layout with its group.
    pub(super) fn new(
        device: &wgpu::Device,
        layouts: &[wgpu::BindGroupLayout],
        groups: &[wgpu::BindGroup],
    ) -> Result<Self, Error> {
        let module = passes::module(device, "trial of bind groups", NOTHING.to_owned())?;
        let trial = |layout| passes::pipeline(device, &module, "nothing", &[layout]);
        let trials: Vec<_> = layouts.iter().map(trial).collect::<Result<_, _>>()?;
        for (number, (group, trial)) in (0..).zip(groups.iter().zip(&trials)) {
            check(device, trial, number, group)?;
        }
        Ok(Self { groups: groups.to_vec(), trials })
    }

    pub(super) fn groups(&self) -> &[wgpu::BindGroup] {
        &self.groups
    }

    /// Replaces a group, or leaves everything as it was.
    pub(super) fn set(
        &mut self,
        device: &wgpu::Device,
        number: u32,
        group: &wgpu::BindGroup,
    ) -> Result<(), Error> {
        let own = self.groups.get(number as usize).zip(self.trials.get(number as usize));
        if let Some((own, trial)) = own
            && own != group
        {
            check(device, trial, number, group)?;
        }
        self.set_unchecked(number, group)
    }

    /// Replaces a group that is known to go with its layout.
    pub(super) fn set_unchecked(
        &mut self,
        number: u32,
        group: &wgpu::BindGroup,
    ) -> Result<(), Error> {
        let groups = self.groups.len();
        let own = self.groups.get_mut(number as usize);
        *own.ok_or(StageError::NoSuchBindGroup { number, groups })? = group.clone();
        Ok(())
    }
}

/// Refuses a group that a pipeline with its layout does not take.
fn check(
    device: &wgpu::Device,
    trial: &wgpu::ComputePipeline,
    number: u32,
    group: &wgpu::BindGroup,
) -> Result<(), Error> {
    let tried = checked(device, || {
        let mut encoder = device.create_command_encoder(&Default::default());
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(trial);
        pass.set_bind_group(0, group, &[]);
        pass.dispatch_workgroups(0, 0, 0);
        drop(pass);
        drop(encoder.finish());
    });
    tried.map_err(|error| match error {
        Error::Refused { reason } => StageError::BadBindGroup { number, reason }.into(),
        other => other,
    })
}
