//! Compares the fixed-function stage with the compute shaders, timed by the device's own clock.

use crate::draws::words_of;
use crate::error::Error;
use crate::modes::with_modes;
use crate::shaders::{EMPTY_VERT, EVALUATE_TESE, EVALUATE_VERT, FACTORS_TESC, FLAT_FRAG, words};
use crate::vulkan::{
    BoundInterface, Commands, Compute, DeviceBuffer, DrawPass, Gpu, Pipeline, STAGES, Spirv,
    Vertices, pipeline,
};
use ash::vk;
use serde::Serialize;
use std::sync::Arc;
use tess_core::PatchFactors;
use tess_gpu::layout::factor_words;
use tess_gpu::{Capacity, Limits, Order, Plan, Resource, Setup};
use tess_workloads::Workload;

/// The times of one workload; each is the fastest of several runs.
#[derive(Clone, Debug, Serialize)]
#[non_exhaustive]
pub struct BenchTimes {
    /// The workload.
    pub workload: String,
    /// The number of patches, with the workload repeated.
    pub patches: u64,
    /// The number of triangles of all patches.
    pub triangles: u64,
    /// Milliseconds of the fixed-function stage with rasterisation discarded.
    pub fixed: f64,
    /// Milliseconds of the compute shaders.
    pub compute: f64,
    /// Milliseconds of the fixed-function stage and of drawing its output.
    pub fixed_drawn: f64,
    /// Milliseconds of the compute shaders and of drawing their output.
    pub compute_drawn: f64,
    /// Milliseconds of the compute shaders that write triangles in vertex-cache order.
    pub ordered: f64,
    /// Milliseconds of these shaders and of drawing their output.
    pub ordered_drawn: f64,
}

/// The width and height of the picture in pixels.
const PICTURE: u32 = 1024;
/// A workload is repeated until it has this many triangles or patches, except on processors.
const TRIANGLES: u64 = 1 << 23;
const PATCHES: usize = 1 << 20;

/// Times a workload of triangles on device `number`; each way runs `runs` times, in turn with the
/// others. `spirv` provides the compute shaders.
///
/// # Errors
/// The device does not exist or fails, or a shader is not available.
pub fn bench(
    number: usize,
    workload: &Workload,
    runs: u32,
    spirv: Spirv<'_>,
) -> Result<BenchTimes, Error> {
    let gpu = Arc::new(Gpu::open(number)?);
    let totals = workload.totals();
    let by_patches = PATCHES.div_ceil(workload.patches.len());
    let by_triangles = TRIANGLES.div_ceil(totals.primitives.max(1));
    let repeats = by_patches.min(usize::try_from(by_triangles).unwrap_or(1)).max(1);
    let (repeats, runs) = if gpu.info.is_software { (1, runs.min(2)) } else { (repeats, runs) };
    let patches = workload.patches.repeat(repeats);
    let bench = BothWays::new(&gpu, workload, &patches, repeats, spirv)?;
    let mut best = [f64::INFINITY; Way::ALL.len()];
    for _ in 0..runs.max(1) {
        for (best, way) in best.iter_mut().zip(Way::ALL) {
            *best = best.min(bench.time(way)?);
        }
    }
    bench.check(3 * totals.primitives * repeats as u64)?;
    let [fixed, compute, fixed_drawn, compute_drawn, ordered, ordered_drawn] = best;
    Ok(BenchTimes {
        workload: workload.name.clone(),
        patches: patches.len() as u64,
        triangles: totals.primitives * repeats as u64,
        fixed,
        compute,
        fixed_drawn,
        compute_drawn,
        ordered,
        ordered_drawn,
    })
}

#[derive(Clone, Copy)]
enum Way {
    Fixed,
    Compute(Order),
    FixedDrawn,
    ComputeDrawn(Order),
}

impl Way {
    const ALL: [Self; 6] = [
        Self::Fixed,
        Self::Compute(Order::Specification),
        Self::FixedDrawn,
        Self::ComputeDrawn(Order::Specification),
        Self::Compute(Order::VertexCache),
        Self::ComputeDrawn(Order::VertexCache),
    ];
}

/// Both ways, ready to run.
struct BothWays {
    // Fields are dropped in this order, the device last.
    fixed: Pipeline,
    fixed_drawn: Pipeline,
    compute_drawn: Pipeline,
    compute: Compute,
    ordered: Compute,
    discarding: DrawPass,
    drawing: DrawPass,
    program: BoundInterface,
    _factors: DeviceBuffer,
    commands: Commands,
    patches: u32,
    gpu: Arc<Gpu>,
}

impl BothWays {
    fn new(
        gpu: &Arc<Gpu>,
        workload: &Workload,
        patches: &[PatchFactors],
        repeats: usize,
        spirv: Spirv<'_>,
    ) -> Result<Self, Error> {
        let commands = Commands::new(gpu, vk::QueryType::TIMESTAMP, 2)?;
        let config = workload.config;
        let domain = patches[0].domain();
        let factors: Vec<u32> = patches.iter().flat_map(|&p| words_of(config, p)).collect();
        let usage = vk::BufferUsageFlags::STORAGE_BUFFER;
        let factors = DeviceBuffer::uploaded(gpu, &commands, &factors, usage)?;
        let program = BoundInterface::new(gpu, &[&factors])?;
        let (discarding, drawing) =
            (DrawPass::new(gpu, PICTURE, false)?, DrawPass::new(gpu, PICTURE, true)?);
        let [empty, control, vertex, fragment] =
            [EMPTY_VERT, FACTORS_TESC, EVALUATE_VERT, FLAT_FRAG].map(words);
        let evaluation = with_modes(&words(EVALUATE_TESE), domain, config);
        let tessellating = [
            (vk::ShaderStageFlags::VERTEX, &empty[..]),
            (vk::ShaderStageFlags::TESSELLATION_CONTROL, &control),
            (vk::ShaderStageFlags::TESSELLATION_EVALUATION, &evaluation),
            (vk::ShaderStageFlags::FRAGMENT, &fragment),
        ];
        let drawn = [(vk::ShaderStageFlags::VERTEX, &vertex[..]), tessellating[3]];
        let make = |pass: &DrawPass, shaders: &[_], vertices| {
            pipeline(gpu, &program, pass, shaders, vertices)
        };
        let setup = Setup::new(domain, config);
        let plan = plan(gpu, setup, workload, patches.len(), repeats)?;
        let words = factor_words(patches);
        let compute =
            |order| Compute::new(gpu, &commands, Setup { order, ..setup }, &plan, &words, spirv);
        Ok(Self {
            fixed: make(&discarding, &tessellating[..3], Vertices::Patches)?,
            fixed_drawn: make(&drawing, &tessellating, Vertices::Patches)?,
            compute_drawn: make(&drawing, &drawn, Vertices::Points)?,
            compute: compute(Order::Specification)?,
            ordered: compute(Order::VertexCache)?,
            discarding,
            drawing,
            program,
            _factors: factors,
            commands,
            patches: u32::try_from(patches.len()).unwrap_or(u32::MAX),
            gpu: Arc::clone(gpu),
        })
    }

    /// Checks that the compute shaders produced this number of indices.
    fn check(&self, indices: u64) -> Result<(), Error> {
        for compute in [&self.compute, &self.ordered] {
            let given = compute.buffer(Resource::Arguments).download(&self.commands, 1)?[0];
            if u64::from(given) != indices {
                let message = format!("the compute shaders gave {given} indices, not {indices}");
                return Err(Error::Capture(message));
            }
        }
        Ok(())
    }

    /// Milliseconds of one run, by the device's clock.
    #[expect(
        clippy::float_arithmetic,
        clippy::cast_precision_loss,
        reason = "ticks of less than a minute to milliseconds"
    )]
    fn time(&self, way: Way) -> Result<f64, Error> {
        let queries = self.commands.queries();
        let stage = vk::PipelineStageFlags::BOTTOM_OF_PIPE;
        self.commands.run(|device, to| {
            // SAFETY: the command buffer is being recorded, outside of a pass.
            unsafe { device.cmd_write_timestamp(to, stage, queries, 0) };
            self.record(way, device, to);
            // SAFETY: as above.
            unsafe { device.cmd_write_timestamp(to, stage, queries, 1) };
        })?;
        let results = self.commands.results::<1>()?;
        let ticks = results[1][0].saturating_sub(results[0][0]);
        Ok(ticks as f64 * f64::from(self.gpu.limits.timestamp_period) * 1e-6)
    }

    fn record(&self, way: Way, device: &ash::Device, to: vk::CommandBuffer) {
        match way {
            Way::Fixed => self.discarding.record(to, |device| self.draw(device, to, &self.fixed)),
            Way::FixedDrawn => {
                self.drawing.record(to, |device| self.draw(device, to, &self.fixed_drawn));
            }
            Way::Compute(order) => self.compute_in(order).record(device, to),
            Way::ComputeDrawn(order) => {
                let compute = self.compute_in(order);
                compute.record(device, to);
                self.drawing.record(to, |device| self.draw_computed(device, to, compute));
            }
        }
    }

    const fn compute_in(&self, order: Order) -> &Compute {
        match order {
            Order::Specification => &self.compute,
            Order::VertexCache => &self.ordered,
        }
    }

    fn bind(&self, device: &ash::Device, to: vk::CommandBuffer, pipeline: &Pipeline) {
        let in_a_row = self.patches.isqrt() + 1;
        let constants = [0u32.to_le_bytes(), in_a_row.to_le_bytes()].concat();
        let (point, layout) = (vk::PipelineBindPoint::GRAPHICS, self.program.layout());
        // SAFETY: the command buffer is being recorded in a pass for which the pipeline was made.
        unsafe {
            device.cmd_bind_pipeline(to, point, **pipeline);
            device.cmd_bind_descriptor_sets(to, point, layout, 0, &[self.program.set], &[]);
            device.cmd_push_constants(to, layout, STAGES, 0, &constants);
        }
    }

    fn draw(&self, device: &ash::Device, to: vk::CommandBuffer, pipeline: &Pipeline) {
        self.bind(device, to, pipeline);
        // SAFETY: a pipeline is bound, and the buffer of factors has this many patches.
        unsafe { device.cmd_draw(to, self.patches, 1, 0, 0) };
    }

    fn draw_computed(&self, device: &ash::Device, to: vk::CommandBuffer, compute: &Compute) {
        self.bind(device, to, &self.compute_drawn);
        let buffer = |resource| *compute.buffer(resource).handle;
        let (points, indices) = (buffer(Resource::Points), buffer(Resource::Indices));
        // SAFETY: a pipeline is bound; earlier commands, followed by a barrier, wrote the arguments
        // and what they draw.
        unsafe {
            device.cmd_bind_vertex_buffers(to, 0, &[points], &[0]);
            device.cmd_bind_index_buffer(to, indices, 0, vk::IndexType::UINT32);
            device.cmd_draw_indexed_indirect(to, buffer(Resource::Arguments), 0, 1, 20);
        }
    }
}

fn plan(
    gpu: &Gpu,
    setup: Setup,
    workload: &Workload,
    patches: usize,
    repeats: usize,
) -> Result<Plan, Error> {
    let totals = workload.totals();
    let room = |elements: u64| u32::try_from(elements * repeats as u64);
    let (Ok(points), Ok(primitives), Ok(patches)) =
        (room(totals.points), room(totals.primitives), u32::try_from(patches))
    else {
        return Err(Error::OutOfMemory);
    };
    let limits = Limits {
        storage_binding: u64::from(gpu.limits.max_storage_buffer_range),
        workgroups: gpu.limits.max_compute_work_group_count[0],
    };
    Ok(Plan::new(setup, patches, Capacity { points, primitives }, limits))
}
