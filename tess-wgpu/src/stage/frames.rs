//! Records frames, and changes the room between them.

use super::feedback::{self, Feedback};
use super::output::{StageOutput, Stored};
use super::{PatchCount, Room, StageError, TessellationStage, fit, locked};
use crate::Gpu;
use crate::device::gpu;
use crate::error::Error;
use tess_gpu::{Capacity, Resource};
use wgpu::BufferUsages as Usage;

/// Bytes of a draw's arguments before the number of its instances.
const INSTANCES_AT: u64 = 4;

impl TessellationStage {
    /// Records the compute passes of a frame: factors, tessellation and, with
    /// [`Points::Evaluated`](super::Points), the vertices. Call it before the render pass that
    /// draws the stage, with the same encoder or with one that is submitted earlier. The passes'
    /// time depends on what is drawn and, a little, on the most patches that the stage was made
    /// for.
    ///
    /// The encoder may be dropped instead of submitted; later frames do not depend on it. It must
    /// belong to the stage's device. An encoder of another device is refused here if it also
    /// belongs to another instance, and otherwise when it is finished.
    ///
    /// # Errors
    /// [`StageError::TooManyPatches`] or [`StageError::BadPatchCount`] for this number of patches;
    /// [`StageError::OtherDevice`]; [`StageError::DrawsAnother`] for a stage that draws another's
    /// output; [`Error::OutOfMemory`] or [`Error::DeviceLost`]. On an error nothing is recorded,
    /// and the last prepared frame can still be drawn.
    pub fn prepare<'a>(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        patches: impl Into<PatchCount<'a>>,
    ) -> Result<(), Error> {
        locked(&self.feedback).take(&self.device, self.frame)?;
        self.record(encoder, patches.into())
    }

    fn record(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        patches: PatchCount<'_>,
    ) -> Result<(), Error> {
        if self.factor_pass.is_none() {
            return Err(StageError::DrawsAnother.into());
        }
        let (count, offset) = self.count_words(patches)?;
        locked(&self.feedback).reserve(&self.device)?;
        if let Some((groups, output)) = self.next.take() {
            self.groups = groups;
            *locked(&self.output) = output;
            self.begins = None;
        }
        self.adapt()?;
        gpu::recorded(&self.device, || {
            encoder.copy_buffer_to_buffer(&count, offset, &self.count, 0, 4);
            self.encode(encoder);
        })?;
        self.frame += 1;
        Ok(())
    }

    /// Records a frame's passes, for the number of patches in `self.count`.
    fn encode(&self, encoder: &mut wgpu::CommandEncoder) {
        if let Some(pass) = &self.factor_pass {
            pass.encode(encoder, &self.bind_groups);
        }
        if let Some(fit) = &self.fit {
            fit.encode(encoder);
        }
        let StageOutput { batch, windows, .. } = self.output();
        if let Some(begins) = &self.begins {
            let groups = batch.buffers().of(Resource::Groups);
            encoder.copy_buffer_to_buffer(begins, 0, groups, 0, begins.size());
        }
        batch.encode(encoder);
        if let Some(instances) = &self.instances {
            let all = (batch.draw_arguments(), 0);
            let groups = 0..u64::from(batch.plan().groups());
            let groups = groups.map(|group| (batch.group_arguments(), Self::GROUP_BYTES * group));
            for (arguments, at) in [all].into_iter().chain(groups) {
                encoder.copy_buffer_to_buffer(instances, 0, arguments, at + INSTANCES_AT, 4);
            }
        }
        if let Some(evaluation) = &self.evaluation {
            evaluation.encode(encoder, &self.bind_groups, &windows);
        }
        let of = (&*batch, self.fit.as_ref());
        locked(&self.feedback).record(encoder, of, self.frame);
    }

    /// Makes the room that a frame needs before it is drawn. This runs a frame's compute passes,
    /// waits for their counts, and grows the buffers of [`Room::Automatic`]. A frame with the same
    /// factors is then exact, if the budget allows. Frames with other factors may need more.
    ///
    /// It takes one round trip to the device. Call it once after the stage is built, or before a
    /// picture that is drawn once, when everything that `hull` reads has been written.
    ///
    /// # Errors
    /// As [`Self::prepare`]; and [`Error::Refused`] in a browser, where only
    /// [`Self::make_room_async`] can wait.
    pub fn make_room<'a>(
        &mut self,
        queue: &wgpu::Queue,
        patches: impl Into<PatchCount<'a>>,
    ) -> Result<Feedback, Error> {
        let gpu = self.gpu(queue);
        gpu.finish(self.run_once(&gpu, patches.into()))
    }

    /// Does the same as [`Self::make_room`] without blocking: see [`Gpu::read_async`].
    ///
    /// # Errors
    /// As [`Self::prepare`].
    pub async fn make_room_async<'a>(
        &mut self,
        queue: &wgpu::Queue,
        patches: impl Into<PatchCount<'a>>,
    ) -> Result<Feedback, Error> {
        let gpu = self.gpu(queue);
        self.run_once(&gpu, patches.into()).await
    }

    fn gpu(&self, queue: &wgpu::Queue) -> Gpu {
        let info = self.device.adapter_info();
        Gpu { device: self.device.clone(), queue: queue.clone(), info }
    }

    /// Runs a frame, waits for its numbers and makes room for it.
    async fn run_once(&mut self, gpu: &Gpu, patches: PatchCount<'_>) -> Result<Feedback, Error> {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let frame = self.frame;
        self.record(&mut encoder, patches)?;
        gpu.submit(encoder)?;
        let batch = self.output().batch;
        let found = feedback::wait(gpu, (&batch, self.fit.as_ref()), frame).await?;
        locked(&self.feedback).arrived(Some(found));
        self.adapt()?;
        Ok(found)
    }

    /// An output whose batch has these groups and writes these buffers.
    pub(super) fn new_output(
        &mut self,
        room: Capacity,
        groups: &[u32],
        stored: Stored,
    ) -> Result<StageOutput, Error> {
        let of_batch = (&self.factors, groups);
        let own = self.output().own;
        let more = (self.evaluation.as_ref(), &own);
        StageOutput::new(&mut self.tessellator, self.form, (room, stored), of_batch, more)
    }

    /// Grows the room if the latest frame needed nearly all of it and the budget allows, or shrinks
    /// it after a lull.
    fn adapt(&mut self) -> Result<(), Error> {
        let last = locked(&self.feedback).last();
        let Some(Feedback { frame, points, primitives, .. }) = last else { return Ok(()) };
        let (form, room, now, needed) =
            (self.form, self.room, self.capacity(), [points, primitives]);
        let grown = form.grown(room, now, needed);
        let changed = grown.or_else(|| self.lull.shrunk((form, room, now), (frame, needed)));
        let Some(room) = changed else { return Ok(()) };
        match self.make_output(room) {
            Ok(()) => Ok(()),
            // The present room stays usable; asking again in each frame would not help.
            Err(Error::OutOfMemory) => {
                self.room = Room::Exactly(now);
                Ok(())
            }
            Err(error) => Err(error),
        }
    }

    /// Replaces the output by one with this room. On an error nothing changes.
    fn make_output(&mut self, room: Capacity) -> Result<(), Error> {
        let words = fit::room_words(&self.device, room)?;
        let stored = Stored::new(&self.device, self.form, room)?;
        let groups = self.groups.clone();
        let output = self.new_output(room, &groups, stored)?;
        *locked(&self.output) = output;
        self.begins = None;
        if let Some(fit) = &mut self.fit {
            fit.set_room(words);
        }
        Ok(())
    }

    /// The buffer that holds the number of patches, and the number's offset in it.
    fn count_words(&self, patches: PatchCount<'_>) -> Result<(wgpu::Buffer, u64), Error> {
        match patches {
            PatchCount::Host(got) => {
                let most = self.form.patches;
                if got > most {
                    return Err(StageError::TooManyPatches { got, most }.into());
                }
                let bytes = got.to_le_bytes();
                Ok((gpu::filled(&self.device, "patches", &bytes, Usage::COPY_SRC)?, 0))
            }
            PatchCount::Device(buffer, offset) => {
                let (size, usage) = (buffer.size(), buffer.usage());
                let is_inside = offset.checked_add(4).is_some_and(|end| end <= size);
                if !is_inside || offset % 4 != 0 || !usage.contains(Usage::COPY_SRC) {
                    return Err(StageError::BadPatchCount { offset, size, usage }.into());
                }
                Ok((buffer.clone(), offset))
            }
        }
    }
}
