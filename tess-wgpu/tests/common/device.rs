//! Runs batches into poisoned, guarded buffers, and compares them with the golden model.

use super::expected::Expected;
use std::sync::LazyLock;
use tess_core::PatchFactors;
use tess_gpu::layout::{DrawIndexed, Status, factor_words};
use tess_gpu::{IndexType, Limits, Numbering, PointFormat, Setup, Stage};
use tess_testkit::wgsl_faults;
use tess_wgpu::{Batch, Gpu, Outputs, Tessellator};
use wgpu::BufferUsages as Usage;

/// No point and no index has these bits, so "not written" differs from anything written.
pub(crate) const POISON: u32 = 0xFFFF_FFFF;
/// The words after the output that must not change, a whole number of points and primitives.
const GUARD: u32 = 6 * 128;

/// The device that the tests run on.
#[derive(Debug)]
pub(crate) struct Machine {
    pub(crate) gpu: Gpu,
    pub(crate) tessellator: Tessellator,
}

/// The content of a batch's buffers after its run.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Written {
    pub(crate) status: Status,
    pub(crate) draw: DrawIndexed,
    pub(crate) points: Vec<u32>,
    pub(crate) indices: Vec<u32>,
}

/// A device of this instance, with these limits.
pub(crate) fn device_of(instance: &wgpu::Instance, required_limits: wgpu::Limits) -> Gpu {
    pollster::block_on(async {
        let adapter = instance.request_adapter(&Default::default()).await.expect("an adapter");
        let descriptor = wgpu::DeviceDescriptor { required_limits, ..Default::default() };
        let (device, queue) = adapter.request_device(&descriptor).await.expect("a device");
        Gpu { device, queue, info: adapter.get_info() }
    })
}

/// The same, on an instance of its own.
pub(crate) fn limited(limits: wgpu::Limits) -> Gpu {
    let descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    device_of(&wgpu::Instance::new(descriptor), limits)
}

/// The machine of [`Machine::open`], so that a process makes the pipelines of a setup once.
static SHARED: LazyLock<Machine> = LazyLock::new(|| {
    Machine::on(pollster::block_on(Gpu::open()).unwrap_or_else(|error| panic!("{error}")))
});

impl Machine {
    /// Opens an adapter with WebGPU's default limits, the same for all tests of a process. If there
    /// is none, the test fails, and is not skipped.
    pub(crate) fn open() -> Self {
        let Self { gpu, tessellator } = &*SHARED;
        Self { gpu: gpu.clone(), tessellator: tessellator.clone() }
    }

    /// This device, with new pipelines.
    pub(crate) fn on(gpu: Gpu) -> Self {
        let tessellator = Tessellator::new(&gpu.device);
        Self { gpu, tessellator }
    }

    /// Plants a fault in the shaders, at least one of which must have its text.
    pub(crate) fn plant(&mut self, setup: Setup, name: &str) {
        let fault = wgsl_faults::named(name);
        let sources = Stage::ALL.map(|stage| stage.source(setup));
        let takes_it = |source: &String| fault.planted(source).is_some();
        assert!(sources.iter().any(takes_it), "{name}: no shader has its text");
        let edit = move |_, source: String| fault.planted(&source).unwrap_or(source);
        self.tessellator = Tessellator::with_edit(&self.gpu.device, edit);
    }

    /// Plants each fault by itself. Asserts that the output equals the model's without the fault,
    /// and differs with it.
    pub(crate) fn assert_noticed(
        &mut self,
        setup: Setup,
        patches: &[PatchFactors],
        faults: &[&str],
    ) {
        let expected = Expected::new(setup, patches);
        let (points, indices) = expected.words();
        let sound = self.tessellator.clone();
        let written = self.write(setup, patches, points, indices);
        assert_eq!(expected.compare(&written), Ok(()), "{setup:?} without a fault");
        for fault in faults {
            self.plant(setup, fault);
            let written = self.write(setup, patches, points, indices);
            let difference = expected.compare(&written);
            assert!(difference.is_err(), "{setup:?}: {fault} went unnoticed");
        }
        self.tessellator = sound;
    }

    /// Limits all batches that are made later. The pipelines stay.
    pub(crate) fn limit(&mut self, limits: Limits) {
        self.tessellator = self.tessellator.clone().limited(limits);
    }

    /// A buffer of factors.
    pub(crate) fn factors(&self, patches: &[PatchFactors]) -> wgpu::Buffer {
        let words = factor_words(patches);
        self.upload(&words, Usage::STORAGE)
    }

    /// A buffer of these words.
    pub(crate) fn upload(&self, words: &[u32], usage: Usage) -> wgpu::Buffer {
        let bytes = bytemuck::cast_slice(words);
        self.gpu.upload("a test's words", bytes, usage).expect("the device has room")
    }

    /// Submits a batch and waits.
    pub(crate) fn run(&self, batch: &Batch) {
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        batch.encode(&mut encoder);
        self.gpu.run(encoder).expect("the device finishes");
    }

    /// The words of a whole buffer.
    pub(crate) fn words(&self, buffer: &wgpu::Buffer) -> Vec<u32> {
        let bytes = self.gpu.read(buffer, buffer.size()).expect("the device answers");
        bytemuck::pod_collect_to_vec(&bytes)
    }

    /// The status and draw arguments that a batch left.
    pub(crate) fn status(&self, batch: &Batch) -> (Status, DrawIndexed) {
        self.left([batch.status(), batch.draw_arguments()])
    }

    /// The status and draw arguments in these buffers.
    pub(crate) fn left(&self, [status, arguments]: [&wgpu::Buffer; 2]) -> (Status, DrawIndexed) {
        let status = self.gpu.read(status, 32).expect("the device answers");
        let draw = self.gpu.read(arguments, 20).expect("the device answers");
        (bytemuck::pod_read_unaligned(&status), bytemuck::pod_read_unaligned(&draw))
    }

    /// A batch that counts these patches, after it has run.
    pub(crate) fn counted(&mut self, setup: Setup, patches: &[PatchFactors]) -> Batch {
        let count = u32::try_from(patches.len()).expect("a test's patches");
        let factors = self.factors(patches);
        let batch = self.tessellator.batch(setup, count, &factors, Outputs::CountOnly);
        let batch = batch.expect("the factors are there");
        self.run(&batch);
        batch
    }

    /// A batch that writes to poisoned buffers of these numbers of words, and the buffers.
    pub(crate) fn batch(
        &mut self,
        setup: Setup,
        patches: &[PatchFactors],
        words: [u32; 2],
    ) -> (Batch, [wgpu::Buffer; 2]) {
        let usage = Usage::STORAGE | Usage::COPY_SRC;
        let outputs = words.map(|words| self.upload(&vec![POISON; words as usize], usage));
        let [points, indices] = &outputs;
        let count = u32::try_from(patches.len()).expect("a test's patches");
        let (factors, into) = (self.factors(patches), Outputs::Buffers { points, indices });
        let batch = self.tessellator.batch(setup, count, &factors, into).expect("buffers fit");
        (batch, outputs)
    }

    /// The buffers after a batch, with its points and indices.
    pub(crate) fn written(&self, batch: &Batch, outputs: &[wgpu::Buffer; 2]) -> Written {
        let (status, draw) = self.status(batch);
        let [points, indices] = outputs.each_ref().map(|buffer| self.words(buffer));
        Written { status, draw, points, indices }
    }

    /// Tessellates into poisoned buffers of these numbers of words.
    pub(crate) fn write(
        &mut self,
        setup: Setup,
        patches: &[PatchFactors],
        point_words: u32,
        index_words: u32,
    ) -> Written {
        let (batch, outputs) = self.batch(setup, patches, [point_words, index_words]);
        self.run(&batch);
        self.written(&batch, &outputs)
    }

    /// Compares everything that a batch writes with the golden model, and that nothing else is.
    pub(crate) fn assert_equal(&mut self, setup: Setup, patches: &[PatchFactors]) {
        let expected = Expected::new(setup, patches);
        let (point_words, index_words) = expected.words();
        let written = self.write(setup, patches, point_words + GUARD, index_words + GUARD);
        if let Err(difference) = expected.compare(&written) {
            panic!("{setup:?}: {difference}");
        }
    }

    /// The same with points in each format, indices in each numbering, and 16-bit indices.
    pub(crate) fn assert_equal_in_every_format(&mut self, setup: Setup, patches: &[PatchFactors]) {
        for point_format in [PointFormat::Packed, PointFormat::F32] {
            for numbering in [Numbering::PerBatch, Numbering::PerPatch] {
                self.assert_equal(Setup { point_format, numbering, ..setup }, patches);
            }
        }
        let (numbering, index_type) = (Numbering::PerPatch, IndexType::U16);
        self.assert_equal(Setup { numbering, index_type, ..setup }, patches);
    }
}
