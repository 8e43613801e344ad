//! Stage taps: the values of a single stage of the shaders, to compare with the golden model's.

use crate::device::pipeline::group;
use crate::error::Error;
use crate::{Gpu, Tessellator};
use tess_gpu::sizes::WORKGROUP;
use tess_gpu::{Setup, Tap};

impl Tessellator {
    /// Runs a tap over `input`, whose length is a multiple of the tap's input, and returns the
    /// output words.
    ///
    /// # Errors
    /// [`Error::DeviceLost`], or an error of size if the input is too large for the device.
    pub fn tap(
        &mut self,
        gpu: &Gpu,
        tap: Tap,
        setup: Setup,
        input: &[u32],
    ) -> Result<Vec<u32>, Error> {
        use wgpu::BufferUsages as Usage;
        let (words_in, words_out) = tap.words();
        let count = input.len() as u64 / u64::from(words_in);
        if count == 0 {
            return Ok(Vec::new());
        }
        let size = 4 * count * u64::from(words_out);
        let output = gpu.buffer("taps", size, Usage::STORAGE | Usage::COPY_SRC)?;
        let buffers = [
            gpu.upload("input", bytemuck::cast_slice(input), Usage::STORAGE)?,
            output.clone(),
            self.pipelines().tables(setup.config.split)?,
        ];
        let pipeline = self.pipelines().tap(tap, setup)?;
        let bindings = (0..).zip(buffers.iter().map(wgpu::Buffer::as_entire_binding));
        let group = group(&gpu.device, "taps", &pipeline.get_bind_group_layout(0), bindings)?;
        let most = self.limits().workgroups;
        // More input than fits a `u32` would not have fitted a buffer.
        let workgroups = u32::try_from(count.div_ceil(u64::from(WORKGROUP))).unwrap_or(u32::MAX);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.dispatch_workgroups(workgroups.min(most), workgroups.div_ceil(most), 1);
        }
        gpu.run(encoder)?;
        Ok(bytemuck::pod_collect_to_vec(&gpu.read(&output, size)?))
    }
}
