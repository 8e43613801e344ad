//! Scaling all factors down, on the device, until their output fits.

use super::passes::{self, Access};
use crate::error::Error;
use crate::gpu;
use tess_gpu::{Capacity, Counting, Setup};
use wgpu::BufferUsages as Usage;

/// Steps of the ladder of scales behind 1. As `LAST_STEP` of fit.wgsl.
const STEPS: u16 = 256;
/// 2^(-6/256): after 256 steps a factor of 64 is 1.
const STEP: f64 = 0.983_885_611_616_587_9;
/// Bytes of the struct `Fit` of fit.wgsl: the step, then 33 sums of four words.
const STATE_BYTES: u64 = 4 * (4 + 4 * 33);

/// The scale at each step, from 1 down to 1/64.
#[expect(
    clippy::float_arithmetic,
    clippy::cast_possible_truncation,
    reason = "any descending ladder would do; it only has to be the same in every pass"
)]
fn ladder() -> Vec<f32> {
    let mut scale = 1.0;
    let mut all = vec![1.0];
    for _ in 1..STEPS {
        scale *= STEP;
        all.push(scale as f32);
    }
    all.push(1.0 / 64.0);
    all
}

/// The WGSL of the passes.
pub(crate) fn source(setup: Setup) -> String {
    Counting { group: 0, binding: 3 }.source(setup) + include_str!("../../shaders/fit.wgsl")
}

/// The passes that scale factors, and their buffers.
#[derive(Debug)]
pub(crate) struct Fit {
    state: wgpu::Buffer,
    arguments: wgpu::Buffer,
    terms: wgpu::Buffer,
    /// The first words of `terms`, copied there in each frame: the encoder of any one frame may be dropped.
    room: wgpu::Buffer,
    bound: wgpu::BindGroup,
    decided: wgpu::BindGroup,
    workgroups: [u32; 2],
    count_whole: wgpu::ComputePipeline,
    decide: wgpu::ComputePipeline,
    if_too_much: [wgpu::ComputePipeline; 3],
}

impl Fit {
    pub(crate) fn new(
        device: &wgpu::Device,
        setup: Setup,
        patches: u32,
        factors: &wgpu::Buffer,
        room: Capacity,
    ) -> Result<Self, Error> {
        let workgroups = passes::workgroups(device, patches);
        let mut words = vec![room.points, room.primitives, workgroups[0], workgroups[1]];
        words.extend(ladder().into_iter().map(f32::to_bits));
        let terms = gpu::filled(
            device,
            "terms",
            bytemuck::cast_slice(&words),
            Usage::STORAGE | Usage::COPY_DST,
        )?;
        let usage = Usage::STORAGE | Usage::COPY_SRC | Usage::COPY_DST;
        let state = gpu::empty(device, "fit", STATE_BYTES, usage)?;
        let usage = Usage::STORAGE | Usage::INDIRECT;
        let arguments = gpu::empty(device, "fit arguments", 12, usage)?;
        let buffers =
            [(factors, Access::ReadWrite), (&state, Access::ReadWrite), (&terms, Access::Read)];
        let (layout, bound) = passes::bind(device, "fit", &buffers)?;
        let (layout_of_decided, decided) =
            passes::bind(device, "fit arguments", &[(&arguments, Access::ReadWrite)])?;
        let module = passes::module(device, "fit", source(setup))?;
        let pipeline = |entry_point| passes::pipeline(device, &module, entry_point, &[&layout]);
        Ok(Self {
            count_whole: pipeline("count_whole")?,
            decide: passes::pipeline(device, &module, "decide", &[&layout, &layout_of_decided])?,
            if_too_much: [
                pipeline("count_coarse")?,
                pipeline("count_fine")?,
                pipeline("scale_factors")?,
            ],
            state,
            arguments,
            terms,
            room: room_words(device, room)?,
            bound,
            decided,
            workgroups,
        })
    }

    /// The room is another from the next frame on.
    pub(crate) fn set_room(&mut self, room: wgpu::Buffer) {
        self.room = room;
    }

    /// Records the passes. They leave factors whose output fits, if there are such.
    pub(crate) fn encode(&self, encoder: &mut wgpu::CommandEncoder) {
        encoder.copy_buffer_to_buffer(&self.room, 0, &self.terms, 0, ROOM_BYTES);
        encoder.clear_buffer(&self.state, 0, None);
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("fit"),
            timestamp_writes: None,
        });
        let [x, y] = self.workgroups;
        pass.set_bind_group(0, &self.bound, &[]);
        pass.set_pipeline(&self.count_whole);
        pass.dispatch_workgroups(x, y, 1);
        pass.set_pipeline(&self.decide);
        pass.set_bind_group(1, &self.decided, &[]);
        pass.dispatch_workgroups(1, 1, 1);
        pass.set_bind_group(1, None, &[]);
        for pipeline in &self.if_too_much {
            pass.set_pipeline(pipeline);
            pass.dispatch_workgroups_indirect(&self.arguments, 0);
        }
    }

    /// What the passes found, as [`Found`] has it.
    pub(crate) const fn state(&self) -> &wgpu::Buffer {
        &self.state
    }
}

/// Bytes of the room in `Terms` of fit.wgsl.
const ROOM_BYTES: u64 = 8;

/// A room as [`Fit::set_room`] takes it.
pub(crate) fn room_words(device: &wgpu::Device, room: Capacity) -> Result<wgpu::Buffer, Error> {
    let words = [room.points, room.primitives];
    gpu::filled(device, "room", bytemuck::bytes_of(&words), Usage::COPY_SRC)
}

/// The first words of the struct `Fit` of fit.wgsl: the step, three reserved, and the sums of the factors as
/// they were.
#[derive(Clone, Copy, Debug, Default, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(crate) struct Found {
    step: u32,
    reserved: [u32; 3],
    points: [u32; 2],
    primitives: [u32; 2],
}

impl Found {
    /// What the factors were scaled by.
    pub(crate) fn scale(&self) -> f32 {
        ladder().get(self.step as usize).copied().unwrap_or(1.0)
    }

    /// Points and primitives that the factors would have given.
    pub(crate) fn needed(&self) -> [u64; 2] {
        [self.points, self.primitives].map(|[low, high]| u64::from(low) | u64::from(high) << 32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ladder_descends_from_1_to_1_64th() {
        let ladder = ladder();
        assert_eq!(ladder.len(), usize::from(STEPS) + 1, "a scale for each step");
        assert_eq!([ladder[0], ladder[256]].map(f32::to_bits), [1.0, 0.015_625].map(f32::to_bits));
        assert!(ladder.windows(2).all(|pair| pair[1] < pair[0]), "each step makes less");
    }
}
