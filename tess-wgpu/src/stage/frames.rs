//! Records frames, and changes the room between them.

use super::feedback::{self, Feedback};
use super::output::{StageOutput, Stored};
use super::{Frame, PatchCount, Room, StageError, TessellationStage, fit, locked};
use crate::Gpu;
use crate::device::gpu;
use crate::error::Error;
use tess_gpu::{Capacity, Resource};
use wgpu::BufferUsages as Usage;

/// Bytes of a draw's arguments before the number of its instances.
const INSTANCES_AT: u64 = 4;

impl TessellationStage {
    /// Records the compute passes of a frame: factors, tessellation and, with
    /// [`Points::Evaluated`](super::Points), the vertices. Returns the frame for
    /// [`Material::draw`](super::Material::draw). Call it before the render passes that draw the
    /// frame, with the same encoder or with one that is submitted earlier. The passes' time depends
    /// on what is drawn and, a little, on the most patches that the stage was made for.
    ///
    /// The encoder may be dropped instead of submitted; later frames do not depend on it. It must
    /// belong to the stage's device. An encoder of another device is refused here if it also
    /// belongs to another instance, and otherwise when it is finished.
    ///
    /// # Errors
    /// [`StageError::TooManyPatches`] or [`StageError::BadPatchCount`] for this number of patches;
    /// [`StageError::OtherDevice`]; [`Error::OutOfMemory`] or [`Error::DeviceLost`]. On an error
    /// nothing is recorded, and the last prepared frame can still be drawn.
    pub fn prepare<'a>(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        patches: impl Into<PatchCount<'a>>,
    ) -> Result<Frame, Error> {
        locked(&self.feedback).take(self.device(), self.frames.get())?;
        self.record(encoder, patches.into())
    }

    fn record(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        patches: PatchCount<'_>,
    ) -> Result<Frame, Error> {
        let (count, offset) = self.count_words(patches)?;
        locked(&self.feedback).reserve(self.device())?;
        self.adapt()?;
        self.regroup()?;
        gpu::recorded(self.device(), || {
            encoder.copy_buffer_to_buffer(&count, offset, &self.passes.count, 0, 4);
            self.encode(encoder);
        })?;
        let (number, stage) = (self.frames.next(), self.frames.downgrade());
        Ok(Frame { number, output: self.output.clone(), stage })
    }

    /// Makes what a device's first frame would wait for: the memory that feedback is read from, and
    /// whatever wgpu and the driver make when commands are first recorded. The commands are
    /// dropped.
    pub(super) fn warm_up(&self) -> Result<(), Error> {
        locked(&self.feedback).reserve(self.device())?;
        let mut encoder = self.device().create_command_encoder(&Default::default());
        gpu::recorded(self.device(), || self.encode(&mut encoder))
    }

    /// Records a frame's passes, for the number of patches in `count`.
    fn encode(&self, encoder: &mut wgpu::CommandEncoder) {
        let passes = &self.passes;
        passes.write.encode(encoder, &self.bind_groups);
        if let Some(fit) = &passes.fit {
            fit.encode(encoder);
        }
        let StageOutput { batch, windows, .. } = &self.output;
        if let Some(begins) = &self.begins {
            let groups = batch.buffers().of(Resource::Groups);
            encoder.copy_buffer_to_buffer(begins, 0, groups, 0, begins.size());
        }
        batch.encode(encoder);
        if let Some(instances) = &self.instances {
            let all = (batch.draw_arguments(), 0);
            let groups = 0..u64::from(self.output.groups());
            let groups = groups.map(|group| (batch.group_arguments(), Self::GROUP_BYTES * group));
            for (arguments, at) in [all].into_iter().chain(groups) {
                encoder.copy_buffer_to_buffer(instances, 0, arguments, at + INSTANCES_AT, 4);
            }
        }
        if let Some(evaluation) = &passes.evaluation {
            evaluation.encode(encoder, &self.bind_groups, windows);
        }
        let of = (&**batch, passes.fit.as_ref());
        locked(&self.feedback).record(encoder, of, self.frames.get());
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
        let device = self.device().clone();
        let info = device.adapter_info();
        Gpu { device, queue: queue.clone(), info }
    }

    /// Runs a frame, waits for its numbers and makes room for it.
    async fn run_once(&mut self, gpu: &Gpu, patches: PatchCount<'_>) -> Result<Feedback, Error> {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let Frame { number, output, .. } = self.record(&mut encoder, patches)?;
        gpu.submit(encoder)?;
        let of = (&*output.batch, self.passes.fit.as_ref());
        let found = feedback::wait(gpu, of, number).await?;
        locked(&self.feedback).arrived(Some(found));
        self.adapt()?;
        Ok(found)
    }

    /// An output whose batch writes these buffers, with the groups that were set last.
    fn new_output(&mut self, room: Capacity, stored: Stored) -> Result<StageOutput, Error> {
        let of_batch = (&self.passes.factors, &self.groups[..]);
        let evaluation = self.passes.evaluation.as_ref();
        StageOutput::new(&mut self.tessellator, self.form, (room, stored), of_batch, evaluation)
    }

    /// Makes an output with the groups that were set last, if the present one has another number of
    /// groups. The room stays.
    fn regroup(&mut self) -> Result<(), Error> {
        if self.output.groups() as usize != self.groups.len() {
            let StageOutput { room, stored, .. } = self.output.clone();
            self.output = self.new_output(room, stored)?;
        }
        Ok(())
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
        let words = fit::room_words(self.device(), room)?;
        let stored = Stored::new(self.device(), self.form, room)?;
        self.output = self.new_output(room, stored)?;
        self.begins = None;
        if let Some(fit) = &mut self.passes.fit {
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
                Ok((gpu::filled(self.device(), "patches", &bytes, Usage::COPY_SRC)?, 0))
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
