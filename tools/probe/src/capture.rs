//! A device's output for patches: `gl_TessCoord` of each vertex, bit for bit.

use crate::cases::groups;
use crate::draws::{DRAW_VERTICES, DrawRange, draws, words_of};
use crate::error::Error;
use crate::info::Info;
use crate::modes::with_modes;
use crate::shaders::{CAPTURE_TESE, EMPTY_VERT, FACTORS_TESC, POINTS_TESE, words};
use crate::vulkan::{
    BoundInterface, Commands, DeviceBuffer, DrawPass, Gpu, Pipeline, STAGES, Vertices, pipeline,
};
use ash::vk;
use std::collections::HashMap;
use std::ptr::null;
use std::sync::Arc;
use tess_core::{Config, Domain, DomainPoint, PatchFactors, SplitOrder, Tessellation};
use tess_verify::Case;
use tess_verify::check::Elements;
use tess_verify::vectors::fixed;

/// The elements that are captured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Method {
    /// Every primitive, in the device's order.
    Primitives,
    /// Every domain point that the device evaluates, in any order and possibly several times.
    Points,
}

impl Method {
    /// The elements that can be compared.
    pub(crate) const fn elements(self) -> Elements {
        match self {
            Self::Primitives => Elements::Primitives,
            Self::Points => Elements::Points,
        }
    }
}

/// A device's output for one patch.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Captured {
    /// `gl_TessCoord` of each vertex as the bits of binary32 numbers, primitive by primitive. If no
    /// primitives are captured, that of each evaluated point.
    pub vertices: Vec<[u32; 3]>,
}

impl Captured {
    /// The capture as an output: each vertex is a separate point, in the order of the primitives.
    /// `None` if a coordinate is not a 16.16 number in 0..=1.
    #[must_use]
    pub fn output(&self) -> Option<Tessellation> {
        let point = |&[u, v, _]: &[u32; 3]| Some(DomainPoint::from_bits(fixed(u)?, fixed(v)?));
        let points: Vec<_> = self.vertices.iter().map(point).collect::<Option<_>>()?;
        let indices = (0..).take(points.len()).collect();
        Some(Tessellation { points, indices })
    }
}

/// A device whose tessellator is probed.
#[derive(Debug)]
pub struct Prober {
    // Fields are dropped in this order, the device last.
    pipelines: HashMap<(Domain, Config), Pipeline>,
    buffers: Option<CaptureBuffers>,
    pass: DrawPass,
    commands: Commands,
    evaluation: Vec<u32>,
    method: Method,
    draw_vertices: usize,
    gpu: Arc<Gpu>,
}

/// The buffers of a submission. They grow when a submission needs more.
#[derive(Debug)]
struct CaptureBuffers {
    program: BoundInterface,
    factors: DeviceBuffer,
    output: DeviceBuffer,
}

/// The number of words before the stored points.
const COUNT_WORDS: usize = 4;
/// The largest number of vertices in a submission.
const SUBMISSION_VERTICES: usize = 1 << 20;
/// The largest number of patches in a submission.
const SUBMISSION_PATCHES: usize = 4096;

impl Prober {
    /// Opens device `number` of [`list`](crate::list).
    ///
    /// # Errors
    /// The device does not exist, or it cannot tessellate or be captured.
    pub fn open(number: usize) -> Result<Self, Error> {
        let gpu = Arc::new(Gpu::open(number)?);
        let (method, evaluation) = match gpu.feedback {
            Some(_) => (Method::Primitives, CAPTURE_TESE),
            None => (Method::Points, POINTS_TESE),
        };
        Self::with(gpu, method, words(evaluation))
    }

    /// Opens a device to capture only domain points, as on devices without transform feedback.
    ///
    /// # Errors
    /// As for [`Self::open`]; or the device's tessellation stages cannot store.
    pub fn open_for_points(number: usize) -> Result<Self, Error> {
        let gpu = Arc::new(Gpu::open(number)?);
        if !gpu.info.stores {
            return Err(Error::Missing("stores from vertex stages"));
        }
        Self::with(gpu, Method::Points, words(POINTS_TESE))
    }

    /// Uses another evaluation shader in SPIR-V, for tests that plant faults.
    #[must_use]
    pub fn with_evaluation(mut self, spirv: &[u8]) -> Self {
        self.evaluation = words(spirv);
        self.pipelines.clear();
        self
    }

    /// Limits draws to `most` vertices, as the model predicts them, instead of [`DRAW_VERTICES`]. A
    /// patch with more is a draw by itself.
    #[must_use]
    pub const fn with_draw_vertices(mut self, most: usize) -> Self {
        self.draw_vertices = most;
        self
    }

    fn with(gpu: Arc<Gpu>, method: Method, evaluation: Vec<u32>) -> Result<Self, Error> {
        let queries = match method {
            Method::Primitives => vk::QueryType::TRANSFORM_FEEDBACK_STREAM_EXT,
            Method::Points => vk::QueryType::OCCLUSION,
        };
        let commands = Commands::new(&gpu, queries, 1)?;
        let pass = DrawPass::new(&gpu, 1, false)?;
        Ok(Self {
            pipelines: HashMap::new(),
            buffers: None,
            pass,
            commands,
            evaluation,
            method,
            draw_vertices: DRAW_VERTICES,
            gpu,
        })
    }

    /// The device's name and abilities.
    #[must_use]
    pub fn info(&self) -> &Info {
        &self.gpu.info
    }

    /// The elements that are captured.
    #[must_use]
    pub const fn method(&self) -> Method {
        self.method
    }

    /// Passes the device's output for each case to `take`; `progress` gets the number of cases
    /// passed since its last call.
    pub(crate) fn each(
        &mut self,
        cases: &[Case],
        progress: &mut dyn FnMut(u64),
        mut take: impl FnMut(&Case, &Captured) -> Result<(), Error>,
    ) -> Result<(), Error> {
        for group in groups(cases) {
            for part in group.chunks(SUBMISSION_PATCHES) {
                let factors: Vec<PatchFactors> = part.iter().map(|case| case.factors).collect();
                let captured = self.capture(part[0].domain(), part[0].config, &factors)?;
                part.iter().zip(&captured).try_for_each(|(case, one)| take(case, one))?;
                progress(part.len() as u64);
            }
        }
        Ok(())
    }

    /// The device's output for patches of one domain, in order.
    ///
    /// # Errors
    /// The device fails, or returns something that no tessellator can produce.
    pub fn capture(
        &mut self,
        domain: Domain,
        config: Config,
        patches: &[PatchFactors],
    ) -> Result<Vec<Captured>, Error> {
        let expected = |factors: &PatchFactors| {
            let counts = Case { config, factors: *factors }.patch().counts();
            counts.points.max(counts.indices) as usize
        };
        let expected: Vec<usize> = patches.iter().map(expected).collect();
        let mut captured = Vec::with_capacity(patches.len());
        let mut begin = 0;
        while begin < patches.len() {
            let (mut end, mut vertices) = (begin, 0);
            while end < patches.len()
                && (end == begin || vertices + expected[end] <= SUBMISSION_VERTICES)
                && end - begin < SUBMISSION_PATCHES
            {
                vertices += expected[end];
                end += 1;
            }
            let (own, room) = (&patches[begin..end], &expected[begin..end]);
            captured.extend(self.submission(domain, config, own, room)?);
            begin = end;
        }
        Ok(captured)
    }

    /// Captures patches whose output, as the model predicts it, fits a submission. If a device
    /// returns more, it gets more room.
    fn submission(
        &mut self,
        domain: Domain,
        config: Config,
        patches: &[PatchFactors],
        expected: &[usize],
    ) -> Result<Vec<Captured>, Error> {
        let draws = draws(expected, self.draw_vertices);
        let factors: Vec<u32> = patches.iter().flat_map(|patch| words_of(config, *patch)).collect();
        let factor = PatchFactors::uniform(domain, 1.0);
        let size = match self.method {
            Method::Primitives => Case { config, factors: factor }.primitive_size(),
            Method::Points => 1,
        };
        let mut room = 4 * expected.iter().sum::<usize>() + 4096;
        loop {
            let needed = self.run(domain, config, &factors, &draws, room)?;
            let needed_vertices = needed * size;
            if needed_vertices <= room {
                return self.read(patches.len(), needed_vertices, size);
            }
            if needed_vertices > 64 * SUBMISSION_VERTICES {
                return Err(Error::Capture(format!(
                    "{} patches have {needed_vertices} vertices",
                    patches.len()
                )));
            }
            room = needed_vertices;
        }
    }

    /// Draws, and returns the device's number of primitives or points, whether or not they fit.
    fn run(
        &mut self,
        domain: Domain,
        config: Config,
        factors: &[u32],
        draws: &[DrawRange],
        room: usize,
    ) -> Result<usize, Error> {
        self.make_buffers(factors.len(), room)?;
        self.make_pipeline(domain, config)?;
        let Some(buffers) = &self.buffers else { return Err(Error::OutOfMemory) };
        let pipeline = &self.pipelines[&(domain, relevant(config))];
        buffers.factors.write(factors)?;
        if self.method == Method::Points {
            buffers.output.write(&[0; COUNT_WORDS])?;
        }
        self.commands.run(|_, commands| {
            self.pass.record(commands, |_| self.record(commands, buffers, pipeline, draws));
            self.make_visible(commands);
        })?;
        let needed = match self.method {
            Method::Primitives => self.commands.results::<2>()?[0][1],
            Method::Points => u64::from(buffers.output.read(1)?[0]),
        };
        Ok(usize::try_from(needed).unwrap_or(usize::MAX))
    }

    fn record(
        &self,
        commands: vk::CommandBuffer,
        buffers: &CaptureBuffers,
        pipeline: &Pipeline,
        draws: &[DrawRange],
    ) {
        let device = &self.gpu.device;
        let program = &buffers.program;
        let point = vk::PipelineBindPoint::GRAPHICS;
        // SAFETY: the command buffer is being recorded inside of a pass for which the pipeline was
        // made; the pipeline, the set and the buffers outlive the submission, which is waited for.
        unsafe {
            device.cmd_bind_pipeline(commands, point, **pipeline);
            device.cmd_bind_descriptor_sets(
                commands,
                point,
                program.layout(),
                0,
                &[program.set],
                &[],
            );
            if let Some(feedback) = self.feedback() {
                let output = &buffers.output;
                let (handles, sizes) = ([*output.handle], [output.bytes]);
                let (bind, begin) = (
                    feedback.fp().cmd_bind_transform_feedback_buffers_ext,
                    feedback.fp().cmd_begin_transform_feedback_ext,
                );
                bind(commands, 0, 1, handles.as_ptr(), [0].as_ptr(), sizes.as_ptr());
                let flags = vk::QueryControlFlags::empty();
                device.cmd_begin_query(commands, self.commands.queries(), 0, flags);
                begin(commands, 0, 0, null(), null());
            }
            for &(first, count) in draws {
                let first = first.to_le_bytes();
                device.cmd_push_constants(commands, program.layout(), STAGES, 0, &first);
                device.cmd_draw(commands, count, 1, 0, 0);
            }
            if let Some(feedback) = self.feedback() {
                let end = feedback.fp().cmd_end_transform_feedback_ext;
                end(commands, 0, 0, null(), null());
                device.cmd_end_query(commands, self.commands.queries(), 0);
            }
        }
    }

    fn feedback(&self) -> Option<&ash::ext::transform_feedback::Device> {
        self.gpu.feedback.as_ref().filter(|_| self.method == Method::Primitives)
    }

    /// Makes the device's writes visible to the host.
    fn make_visible(&self, commands: vk::CommandBuffer) {
        let (stage, access) = match self.method {
            Method::Primitives => (
                vk::PipelineStageFlags::TRANSFORM_FEEDBACK_EXT,
                vk::AccessFlags::TRANSFORM_FEEDBACK_WRITE_EXT,
            ),
            Method::Points => (vk::PipelineStageFlags::ALL_GRAPHICS, vk::AccessFlags::SHADER_WRITE),
        };
        let barrier = vk::MemoryBarrier::default()
            .src_access_mask(access)
            .dst_access_mask(vk::AccessFlags::HOST_READ);
        let host = vk::PipelineStageFlags::HOST;
        let none = vk::DependencyFlags::empty();
        let device = &self.gpu.device;
        // SAFETY: the command buffer is being recorded, outside of a pass.
        unsafe { device.cmd_pipeline_barrier(commands, stage, host, none, &[barrier], &[], &[]) };
    }

    fn make_buffers(&mut self, factors: usize, room: usize) -> Result<(), Error> {
        let factors = 4 * factors as u64;
        let output = 4 * (4 * room + COUNT_WORDS) as u64;
        let fit = |b: &CaptureBuffers| b.factors.bytes >= factors && b.output.bytes >= output;
        if self.buffers.as_ref().is_some_and(fit) {
            return Ok(());
        }
        self.buffers = None;
        let storage = vk::BufferUsageFlags::STORAGE_BUFFER;
        let factors = DeviceBuffer::shared(&self.gpu, factors, storage)?;
        let usage = match self.method {
            Method::Primitives => vk::BufferUsageFlags::TRANSFORM_FEEDBACK_BUFFER_EXT,
            Method::Points => storage,
        };
        let output = DeviceBuffer::shared(&self.gpu, output, usage)?;
        let program = match self.method {
            Method::Primitives => BoundInterface::new(&self.gpu, &[&factors])?,
            Method::Points => BoundInterface::new(&self.gpu, &[&factors, &output])?,
        };
        // The layouts are equal, but pipelines belong to their own one.
        self.pipelines.clear();
        self.buffers = Some(CaptureBuffers { program, factors, output });
        Ok(())
    }

    fn make_pipeline(&mut self, domain: Domain, config: Config) -> Result<(), Error> {
        let key = (domain, relevant(config));
        let Some(buffers) = self.buffers.as_ref().filter(|_| !self.pipelines.contains_key(&key))
        else {
            return Ok(());
        };
        let evaluation = with_modes(&self.evaluation, domain, config);
        let shaders = [
            (vk::ShaderStageFlags::VERTEX, &words(EMPTY_VERT)[..]),
            (vk::ShaderStageFlags::TESSELLATION_CONTROL, &words(FACTORS_TESC)),
            (vk::ShaderStageFlags::TESSELLATION_EVALUATION, &evaluation),
        ];
        let (program, pass) = (&buffers.program, &self.pass);
        let pipeline = pipeline(&self.gpu, program, pass, &shaders, Vertices::Patches)?;
        self.pipelines.insert(key, pipeline);
        Ok(())
    }

    /// The captured vertices, patch by patch.
    fn read(&self, patches: usize, vertices: usize, size: usize) -> Result<Vec<Captured>, Error> {
        let Some(buffers) = &self.buffers else { return Err(Error::OutOfMemory) };
        let skipped = match self.method {
            Method::Primitives => 0,
            Method::Points => COUNT_WORDS,
        };
        let words = buffers.output.read(skipped + 4 * vertices)?;
        let vertices = words[skipped..].as_chunks::<4>().0;
        let mut captured = vec![Captured::default(); patches];
        for primitive in vertices.chunks(size) {
            let number = primitive[0][3];
            let own = captured.get_mut(number as usize);
            let is_whole = primitive.len() == size && primitive.iter().all(|v| v[3] == number);
            let Some(own) = own.filter(|_| is_whole) else {
                return Err(Error::Capture(format!(
                    "a primitive says that its vertices are of patches {:?}, of {patches}",
                    primitive.iter().map(|vertex| vertex[3]).collect::<Vec<_>>()
                )));
            };
            own.vertices.extend(primitive.iter().map(|&[u, v, w, _]| [u, v, w]));
        }
        Ok(captured)
    }
}

/// The part of a configuration that distinguishes pipelines. Vulkan has one split order.
fn relevant(config: Config) -> Config {
    Config { split: SplitOrder::Ruler, ..config }
}
