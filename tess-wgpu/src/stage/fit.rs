//! Scales a frame's factors down, on the device, until its output fits the room.
//!
//! A frame's factors may give more points or primitives than the stage's buffers hold, and the host
//! does not know the factors. These passes find the greatest of 257 scales at which everything fits
//! and write the scaled factors back. With [`Overflow::Coarser`](super::Overflow::Coarser),
//! `TessellationStage::prepare` records them after the pass that writes the factors and before the
//! batch that reads them.
//!
//! # The scales
//!
//! Step 0 leaves the factors alone. Each further step multiplies the scale by 2^(-6/256), down to
//! 1/64 at step 256. The scales are called the ladder. A step `s > 0` changes one raw factor `f`
//! like this (`scaled` in fit.wgsl):
//!
//! ```text
//! f <= 1, negative or NaN     stays f
//! 1 < f <= 64                 max(1, f * ladder[s])
//! f > 64 or infinity          max(1, 64 * ladder[s])
//! ```
//!
//! # The data
//!
//! ```text
//! terms: the host writes, the passes read            fit: the passes write, feedback reads words 0 to 7
//! word 0       points that there is room for         word 0         the step that the factors were scaled by
//!      1       primitives                                 1 .. 3    reserved
//!      2, 3    workgroups of a pass, along x and y        4 .. 135  33 sums: points low, high; primitives low, high
//!      4 ..    the ladder: scale of step 0 to 256
//!                                                    sum   0        the unscaled factors (step 0)
//! arguments: `decide` writes, dispatches read              1 .. 16  steps 16, 32, ... 256
//! word 0 .. 2  workgroups; none if step 0 fits            17 .. 32  16 steps, up to the first coarse one that fits
//! ```
//!
//! # The passes
//!
//! 1. `count_whole` counts every patch at step 0.
//! 2. `decide` sets the arguments of the next three passes. If step 0 fits, they get 0 workgroups;
//!    most frames end here.
//! 3. `count_coarse` counts every patch at each 16th step.
//! 4. `count_fine` counts every patch at the 16 steps up to the first coarse step that fits.
//! 5. `scale_factors` scales every factor by the first fine step that fits, and writes the step.
//!
//! # One frame
//!
//! One quad patch with all factors 8 (integer partitioning) gives 81 points and 128 triangles, but
//! there is room for only 50 points and 72 triangles:
//!
//! ```text
//! sum    step   scale   factor   points   triangles
//!  0       0    1       8          81       128      too much, so the passes go on
//!  1      16    0.771   6.17       64        98      too much
//!  2      32    0.595   4.76       36        50      the first coarse step that fits
//! 17      17    0.759   6.07       64        98      too much: 6.07 rounds up to 7
//! 18      18    0.747   5.97       49        72      fits: this step is taken
//! ```
//!
//! The test `the_frame_of_the_head_comment` computes these numbers.
//!
//! # What must hold
//!
//! - A smaller scale never gives more output. Otherwise the first step that fits would not have the
//!   greatest scale that fits.
//! - One step applies to the factors of all patches. Two patches whose factors agree along an edge
//!   then still agree, so no crack opens.
//! - A factor stays on its side of 0, and one above 1 stays at least 1. A culled patch stays culled
//!   and a drawn one stays drawn.
//! - Factors above 64 count as 64 before they are scaled, because the tessellator clamps them.
//!   Otherwise infinity would never become smaller.
//! - A workgroup's sum stays below 2^32 (64 patches of at most 8192 primitives), so only the totals
//!   need two words.
//! - Every frame copies the room into `terms` again. A single copy would be lost with an encoder
//!   that is dropped.
//! - If not even step 256 fits, where no factor is above 1, it is still taken; the batch then draws
//!   nothing.
//!
//! # Simpler forms
//!
//! - One pass over all 257 steps counts each patch 257 times; the two levels count it 33 times.
//! - Bisection counts each patch 9 times, but needs 9 pairs of dependent dispatches in every frame
//!   instead of 5 dispatches.
//! - Reading the counts back would make the host wait, or scale each frame by the needs of an
//!   earlier one.

use super::passes;
use crate::Tessellator;
use crate::device::pipelines::PipelineKey;
use crate::device::{gpu, pipeline};
use crate::error::Error;
use std::sync::Arc;
use tess_gpu::{Access, Capacity, Counting, Setup};
use wgpu::BufferUsages as Usage;

/// The last step of the ladder, which begins with the scale 1 of step 0. It is `LAST_STEP` of
/// fit.wgsl.
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
pub(crate) fn ladder() -> Vec<f32> {
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
    /// The first words of `terms`, copied there in each frame.
    room: wgpu::Buffer,
    bound: wgpu::BindGroup,
    decided: wgpu::BindGroup,
    workgroups: [u32; 2],
    count_whole: Arc<wgpu::ComputePipeline>,
    decide: Arc<wgpu::ComputePipeline>,
    if_too_much: [Arc<wgpu::ComputePipeline>; 3],
}

impl Fit {
    pub(crate) fn new(
        tessellator: &Tessellator,
        setup: Setup,
        patches: u32,
        factors: &wgpu::Buffer,
        room: Capacity,
    ) -> Result<Self, Error> {
        let device = tessellator.device();
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
        let (layout, bound) = passes::bind(tessellator, "fit", &buffers)?;
        let (layout_of_decided, decided) =
            passes::bind(tessellator, "fit arguments", &[(&arguments, Access::ReadWrite)])?;
        let [count_whole, decide, coarse, fine, scale] =
            pipelines(tessellator, setup, layout, layout_of_decided)?;
        Ok(Self {
            count_whole,
            decide,
            if_too_much: [coarse, fine, scale],
            state,
            arguments,
            terms,
            room: room_words(device, room)?,
            bound,
            decided,
            workgroups,
        })
    }

    /// Sets the room, as [`room_words`] makes it. It takes effect in the next frame.
    pub(crate) fn set_room(&mut self, room: wgpu::Buffer) {
        self.room = room;
    }

    /// Records the passes. After them the factors' output fits, unless even the last step gives too
    /// much.
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

    /// The buffer that the passes write; it begins with a [`Found`].
    pub(crate) const fn state(&self) -> &wgpu::Buffer {
        &self.state
    }
}

/// The pipelines of the passes, in order.
fn pipelines(
    tessellator: &Tessellator,
    setup: Setup,
    layout: wgpu::BindGroupLayout,
    of_decided: wgpu::BindGroupLayout,
) -> Result<[Arc<wgpu::ComputePipeline>; 5], Error> {
    let text = source(setup);
    let mut module = None;
    let mut pipeline = |entry_point, layouts| {
        let key = PipelineKey { text: text.clone(), entry_point, layouts, constants: Vec::new() };
        passes::pipeline(tessellator, key, || match &module {
            Some(made) => Ok(wgpu::ShaderModule::clone(made)),
            None => {
                let made = pipeline::module(tessellator.device(), "fit", text.clone())?;
                Ok(module.insert(made).clone())
            }
        })
    };
    let one = vec![layout.clone()];
    Ok([
        pipeline("count_whole", one.clone())?,
        pipeline("decide", vec![layout, of_decided])?,
        pipeline("count_coarse", one.clone())?,
        pipeline("count_fine", one.clone())?,
        pipeline("scale_factors", one)?,
    ])
}

/// Bytes of the room in `Terms` of fit.wgsl.
const ROOM_BYTES: u64 = 8;

/// A room as [`Fit::set_room`] takes it.
pub(crate) fn room_words(device: &wgpu::Device, room: Capacity) -> Result<wgpu::Buffer, Error> {
    let words = [room.points, room.primitives];
    gpu::filled(device, "room", bytemuck::bytes_of(&words), Usage::COPY_SRC)
}

/// The first words of the struct `Fit` of fit.wgsl: the step, three reserved words, and the output
/// of the unscaled factors.
#[derive(Clone, Copy, Debug, Default, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(crate) struct Found {
    step: u32,
    reserved: [u32; 3],
    points: [u32; 2],
    primitives: [u32; 2],
}

impl Found {
    /// The scale by which the factors were multiplied.
    pub(crate) fn scale(&self) -> f32 {
        ladder().get(self.step as usize).copied().unwrap_or(1.0)
    }

    /// The points and primitives that the unscaled factors give.
    pub(crate) fn needed(&self) -> [u64; 2] {
        [self.points, self.primitives].map(|[low, high]| u64::from(low) | u64::from(high) << 32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_frame_of_the_head_comment() {
        use tess_core::{Config, Domain, OutputPrimitive, Partitioning};
        let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
        let setup = Setup::new(Domain::Quad, config);
        let ladder = ladder();
        for (step, scale, points, primitives) in [
            (0, 1.0, 81, 128),
            (16, 0.771, 64, 98),
            (32, 0.595, 36, 50),
            (17, 0.759, 64, 98),
            (18, 0.747, 49, 72),
        ] {
            let found = ladder[step];
            assert!((found - scale).abs() < 0.0006, "step {step}: {found}");
            let counts = Capacity::uniform(setup, 1, 8.0 * found);
            assert_eq!(counts, Capacity { points, primitives }, "step {step}");
        }
    }

    /// Facts that fit.wgsl and this file both state.
    #[test]
    fn constants_and_layouts_are_those_of_the_shader() {
        use tess_core::{Config, Domain, OutputPrimitive, Partitioning};
        use wgpu::naga::{Expression, Literal, TypeInner, front::wgsl};
        let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
        let source = source(Setup::new(Domain::Quad, config));
        let module = wgsl::parse_str(&source).expect("it is valid");
        let constant = |name: &str| {
            let mut all = module.constants.iter();
            let found = all.find(|(_, constant)| constant.name.as_deref() == Some(name));
            match module.global_expressions[found.expect("it is declared").1.init] {
                Expression::Literal(Literal::U32(value)) => u64::from(value),
                ref other => panic!("{name} is {other:?}"),
            }
        };
        let members = |name: &str| {
            let mut all = module.types.iter();
            let found = all.find(|(_, ty)| ty.name.as_deref() == Some(name));
            match &found.expect("it is declared").1.inner {
                TypeInner::Struct { members, span } => {
                    let offsets = members.iter().map(|member| {
                        (member.name.clone().unwrap_or_default(), u64::from(member.offset))
                    });
                    (offsets.collect::<Vec<_>>(), u64::from(*span))
                }
                other => panic!("{name} is {other:?}"),
            }
        };
        assert_eq!(constant("LAST_STEP"), u64::from(STEPS), "the ladder's last step");
        let (fit, bytes) = members("Fit");
        assert_eq!(bytes, STATE_BYTES, "the buffer `fit`");
        let at = |name: &str| fit.iter().find(|(own, _)| own == name).map(|&(_, offset)| offset);
        let found = [std::mem::offset_of!(Found, step), std::mem::offset_of!(Found, points)];
        assert_eq!([at("step"), at("sums")], found.map(|offset| Some(offset as u64)), "`Found`");
        let (terms, _) = members("Terms");
        let names: Vec<_> = terms.iter().map(|(name, offset)| (name.as_str(), *offset)).collect();
        let expected = [("points", 0), ("primitives", 4), ("workgroups", 8), ("ladder", 16)];
        assert_eq!(
            names, expected,
            "`terms` as `Fit::new` fills it; the room is its first {ROOM_BYTES} bytes"
        );
        for entry in &module.entry_points {
            let threads = if entry.name == "decide" { 1 } else { passes::WORKGROUP };
            assert_eq!(entry.workgroup_size, [threads, 1, 1], "{}", entry.name);
        }
    }

    #[test]
    fn the_ladder_descends_from_1_to_1_64th() {
        let ladder = ladder();
        assert_eq!(ladder.len(), usize::from(STEPS) + 1, "a scale for each step");
        assert_eq!([ladder[0], ladder[256]].map(f32::to_bits), [1.0, 0.015_625].map(f32::to_bits));
        assert!(ladder.windows(2).all(|pair| pair[1] < pair[0]), "each step makes less");
    }
}
