//! Runs a batch pass by pass and compares each pass's results with its twin.

use super::bare_wgpu;
use super::buffers::{Bound, Pass, Words};
use super::compare::{Difference, first_difference};
use super::twin;
use std::collections::HashMap;
use tess_core::{Patch, PatchFactors};
use tess_gpu::layout::Job;
use tess_gpu::sizes::ALIGNMENT;
use tess_gpu::{
    Access, Binding, Capacity, Dispatch, Limits, Plan, Resource, Setup, Stage, Written,
};

/// No output has these bits, so an unwritten word differs from any that was written.
const POISON: u32 = 0xFFFF_FFFF;

/// A device and the pipelines that were made on it, without faults.
pub(crate) struct Machine {
    gpu: (wgpu::Device, wgpu::Queue),
    pipelines: HashMap<(Stage, Setup), wgpu::ComputePipeline>,
}

/// The stages of a batch.
#[derive(Clone, Copy, Debug)]
pub(crate) enum PlanForm {
    /// Those of a short batch if it is one.
    Any,
    /// Those of a long batch.
    Long,
    /// Those of a long batch that does not write everything.
    Writing(Written),
}

/// A batch to run.
#[derive(Clone, Debug)]
pub(crate) struct Batch {
    pub(crate) setup: Setup,
    pub(crate) patches: Vec<PatchFactors>,
    /// The room for output; `None` gives a little more than the batch needs.
    pub(crate) room: Option<Capacity>,
    pub(crate) limits: Limits,
    pub(crate) form: PlanForm,
    /// The first patch of each group.
    pub(crate) groups: Vec<u32>,
}

impl Batch {
    pub(crate) fn new(setup: Setup, patches: Vec<PatchFactors>) -> Self {
        let (room, groups) = (None, Vec::new());
        Self { setup, patches, room, limits: Limits::WEBGPU, form: PlanForm::Any, groups }
    }

    /// The same batch with the stages of a long one.
    pub(crate) fn long(self) -> Self {
        Self { form: PlanForm::Long, ..self }
    }

    fn plan(&self, patches: &[Patch]) -> Plan {
        let total = |of: fn(&Patch) -> u32| patches.iter().map(of).sum::<u32>();
        let needed = Capacity {
            points: total(|patch| patch.counts().points) + 5,
            primitives: total(|patch| patch.counts().primitives) + 5,
        };
        let count = u32::try_from(patches.len()).expect("a test's patches");
        let (setup, room) = (self.setup, self.room.unwrap_or(needed));
        let plan = match self.form {
            PlanForm::Any => Plan::new(setup, count, room, self.limits),
            PlanForm::Long => Plan::in_long_stages(setup, count, room, self.limits),
            PlanForm::Writing(written) => Plan::writing(written, setup, count, room, self.limits),
        };
        plan.with_groups(u32::try_from(self.groups.len()).expect("a test's groups"))
    }
}

/// Everything that a pass of a batch is compared with.
pub(crate) struct Context<'a> {
    pub(crate) batch: &'a Batch,
    pub(crate) plan: Plan,
    pub(crate) patches: Vec<Patch>,
    /// The places at which each patch's points and primitives begin.
    pub(crate) begins: Vec<[u32; 2]>,
    jobs: Vec<u8>,
}

impl<'a> Context<'a> {
    pub(crate) fn new(batch: &'a Batch) -> Self {
        let patches: Vec<_> =
            batch.patches.iter().map(|&raw| Patch::new(batch.setup.config, raw)).collect();
        let mut end = [0; 2];
        let mut begin_of = |patch: &Patch| {
            let begin = end;
            end = super::buffers::sum(begin, super::buffers::counts(patch));
            begin
        };
        let begins = patches.iter().map(&mut begin_of).collect();
        let plan = batch.plan(&patches);
        Self { batch, plan, patches, begins, jobs: plan.jobs() }
    }

    /// The arguments of a dispatch.
    pub(crate) fn pass(&self, dispatch: &Dispatch) -> Pass<'_> {
        let at = usize::try_from(ALIGNMENT).expect("256") * dispatch.job() as usize;
        let job: Job = bytemuck::pod_read_unaligned(&self.jobs[at..][..size_of::<Job>()]);
        let patches = &self.patches[job.first_patch as usize..][..job.patches as usize];
        Pass { setup: self.batch.setup, stage: dispatch.stage(), job, patches }
    }
}

impl Machine {
    /// A missing adapter is a failure, not a reason to skip.
    pub(crate) fn open() -> Self {
        let backends = wgpu::Backends::from_env().unwrap_or_default();
        let gpu = bare_wgpu::open(backends).unwrap_or_else(|reason| panic!("{reason}"));
        Self { gpu, pipelines: HashMap::new() }
    }

    fn pipeline(&mut self, stage: Stage, setup: Setup) -> wgpu::ComputePipeline {
        let relevant = stage.relevant(setup);
        let make = || bare_wgpu::pipeline(&self.gpu.0, stage, &stage.source(relevant));
        self.pipelines.entry((stage, relevant)).or_insert_with(make).clone()
    }

    /// Runs the passes of a batch one by one, all of them twice, and returns their stages.
    pub(crate) fn run(&mut self, batch: &Batch) -> Result<Vec<Stage>, Difference> {
        self.run_with(batch, |_, _| None)
    }

    /// The same with these shaders instead of a stage's own.
    pub(crate) fn run_with(
        &mut self,
        batch: &Batch,
        edit: impl Fn(Stage, &str) -> Option<String>,
    ) -> Result<Vec<Stage>, Difference> {
        let context = Context::new(batch);
        let plan = context.plan;
        let buffers =
            bare_wgpu::buffers(&self.gpu, batch.setup, &plan, &batch.patches, &batch.groups);
        let mut words = self.poisoned(&plan, &buffers);
        let mut stages = Vec::new();
        let mut edited = HashMap::new();
        // Twice, because the next run finds what a run leaves.
        for dispatch in plan.dispatches().chain(plan.dispatches()) {
            let stage = dispatch.stage();
            let pipeline = edited.entry(stage).or_insert_with(|| {
                let source = edit(stage, &stage.source(stage.relevant(batch.setup)));
                match source {
                    Some(source) => bare_wgpu::pipeline(&self.gpu.0, stage, &source),
                    None => self.pipeline(stage, batch.setup),
                }
            });
            let pass = (stages.len(), &dispatch);
            self.compare(&context, pass, pipeline, &buffers, &mut words)?;
            stages.push(stage);
        }
        stages.truncate(stages.len() / 2);
        Ok(stages)
    }

    /// Runs only the first pass of a stage, with other words in one buffer before it.
    pub(crate) fn run_alone(
        &mut self,
        batch: &Batch,
        stage: Stage,
        resource: Resource,
        word: impl FnMut() -> u32,
    ) -> Result<(), Difference> {
        let context = Context::new(batch);
        let (plan, setup) = (context.plan, batch.setup);
        let buffers = bare_wgpu::buffers(&self.gpu, setup, &plan, &batch.patches, &batch.groups);
        let mut words = self.poisoned(&plan, &buffers);
        let buffer = &buffers[resource as usize];
        words[resource as usize].fill_with(word);
        self.gpu.1.write_buffer(buffer, 0, bytemuck::cast_slice(&words[resource as usize]));
        let mut dispatches = plan.dispatches();
        let number = dispatches.position(|it| it.stage() == stage).expect("the batch has it");
        let dispatch = plan.dispatches().nth(number).expect("it was found");
        let pipeline = self.pipeline(stage, setup);
        self.compare(&context, (number, &dispatch), &pipeline, &buffers, &mut words)
    }

    /// Runs a pass and its twin, and compares.
    fn compare(
        &self,
        context: &Context<'_>,
        (number, dispatch): (usize, &Dispatch),
        pipeline: &wgpu::ComputePipeline,
        buffers: &bare_wgpu::Buffers,
        words: &mut Words,
    ) -> Result<(), Difference> {
        self.dispatch(pipeline, dispatch, buffers);
        let left = self.left(dispatch.stage(), buffers);
        let mut bound = Bound::new(dispatch, words, &left);
        twin(&context.pass(dispatch), &mut bound);
        let refused = bound.refused.take();
        first_difference(context, dispatch, (words, &left), refused, number)
    }

    fn dispatch(
        &self,
        pipeline: &wgpu::ComputePipeline,
        dispatch: &Dispatch,
        buffers: &bare_wgpu::Buffers,
    ) {
        let mut encoder = self.gpu.0.create_command_encoder(&Default::default());
        let mut pass = encoder.begin_compute_pass(&Default::default());
        bare_wgpu::encode(&self.gpu.0, &mut pass, pipeline, dispatch, buffers);
        drop(pass);
        self.gpu.1.submit([encoder.finish()]);
    }

    /// Poisons what the batch writes and returns the words of all buffers. A catalogue begins as
    /// zeros.
    fn poisoned(&self, plan: &Plan, buffers: &bare_wgpu::Buffers) -> Words {
        use Resource::{Catalogue, Factors, Groups, Job, Tables};
        Resource::ALL.map(|resource| {
            let buffer = &buffers[resource as usize];
            let is_input = matches!(resource, Job | Factors | Tables | Groups);
            if !is_input && (resource != Catalogue || !plan.has_catalogue()) {
                let poison = vec![POISON; usize::try_from(buffer.size() / 4).expect("in memory")];
                self.gpu.1.write_buffer(buffer, 0, bytemuck::cast_slice(&poison));
            }
            bare_wgpu::read(&self.gpu, buffer)
        })
    }

    /// The words of the buffers that a stage writes.
    fn left(&self, stage: Stage, buffers: &bare_wgpu::Buffers) -> Words {
        Resource::ALL.map(|resource| {
            let is_written = stage.bindings().contains(&Binding(resource, Access::ReadWrite));
            let buffer = &buffers[resource as usize];
            if is_written { bare_wgpu::read(&self.gpu, buffer) } else { Vec::new() }
        })
    }
}
