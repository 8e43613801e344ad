//! Reads back what frames needed, some frames later and without waiting.

use super::fit::{Fit, Found};
use crate::device::gpu;
use crate::error::{Error, checked};
use crate::{Batch, Gpu};
use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};
use tess_gpu::layout::Status;
use wgpu::BufferUsages as Usage;

/// The output that a frame needed, and what it drew.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Feedback {
    /// Number of the frame: the first call of `prepare` is frame 0.
    pub frame: u64,
    /// Points that the unscaled factors give.
    pub points: u64,
    /// Primitives that the unscaled factors give.
    pub primitives: u64,
    /// Primitives that were drawn: fewer if they did not fit.
    pub drawn: u64,
    /// The scale of the factors that made the output fit; 1 if it fitted, and always with
    /// [`Overflow::DrawNothing`](super::Overflow::DrawNothing).
    pub scale: f32,
}

/// The most read-backs that are under way at once. Frames that exceed it are not read back.
const MOST: usize = 4;
/// The frames after which a read-back is given up if its encoder is kept and was never submitted.
const PATIENCE: u64 = 64;

const WAITING: u8 = 0;
const DONE: u8 = 1;
const FAILED: u8 = 2;

/// A frame's numbers on their way to the host.
#[derive(Debug)]
struct UnderWay {
    frame: u64,
    staging: wgpu::Buffer,
    state: Arc<AtomicU8>,
}

/// The read-backs under way, and the latest result.
#[derive(Debug, Default)]
pub(crate) struct Feedbacks {
    under_way: Vec<UnderWay>,
    idle: Vec<wgpu::Buffer>,
    last: Option<Feedback>,
}

impl Feedbacks {
    /// The latest frame whose numbers have arrived.
    pub(crate) const fn last(&self) -> Option<Feedback> {
        self.last
    }

    /// Takes what has arrived.
    pub(crate) fn take(&mut self, device: &wgpu::Device, frame: u64) -> Result<(), Error> {
        gpu::poll(device, wgpu::PollType::Poll)?;
        for mut one in std::mem::take(&mut self.under_way) {
            // The encoder owns the other reference until the answer arrives, or until it is
            // dropped.
            let has_encoder = Arc::get_mut(&mut one.state).is_none();
            match one.state.load(Ordering::Acquire) {
                DONE => {
                    self.arrived(read(&one.staging, one.frame));
                    // A lost device has unmapped the buffer already, and wgpu ends the program if
                    // it is unmapped again.
                    if checked(device, || one.staging.unmap()).is_ok() {
                        self.idle.push(one.staging);
                    }
                }
                WAITING if !has_encoder => self.idle.push(one.staging),
                WAITING if frame.saturating_sub(one.frame) < PATIENCE => self.under_way.push(one),
                _ => {}
            }
        }
        Ok(())
    }

    /// Keeps the numbers of the latest frame. Frames arrive in the order in which they were
    /// submitted.
    pub(crate) fn arrived(&mut self, new: Option<Feedback>) {
        let latest = self.last.map_or(0, |last| last.frame);
        self.last = new.filter(|new| new.frame >= latest).or(self.last);
    }

    /// Makes the buffer that [`Self::record`] needs, unless one is idle.
    pub(crate) fn reserve(&mut self, device: &wgpu::Device) -> Result<(), Error> {
        if self.under_way.len() < MOST && self.idle.is_empty() {
            let usage = Usage::MAP_READ | Usage::COPY_DST;
            self.idle.push(gpu::empty(device, "feedback", BYTES, usage)?);
        }
        Ok(())
    }

    /// Records the copies of a frame's numbers, if a buffer was reserved. They arrive after
    /// `encoder` was submitted.
    pub(crate) fn record(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        (batch, fit): (&Batch, Option<&Fit>),
        frame: u64,
    ) {
        if self.under_way.len() >= MOST {
            return;
        }
        let Some(staging) = self.idle.pop() else { return };
        encoder.copy_buffer_to_buffer(batch.status(), 0, &staging, 0, STATUS_BYTES);
        match fit {
            Some(fit) => {
                let size = size_of::<Found>() as u64;
                encoder.copy_buffer_to_buffer(fit.state(), 0, &staging, STATUS_BYTES, size);
            }
            None => encoder.clear_buffer(&staging, STATUS_BYTES, None),
        }
        let state = Arc::new(AtomicU8::new(WAITING));
        let done = Arc::clone(&state);
        encoder.map_buffer_on_submit(&staging, wgpu::MapMode::Read, .., move |result| {
            done.store(if result.is_ok() { DONE } else { FAILED }, Ordering::Release);
        });
        self.under_way.push(UnderWay { frame, staging, state });
    }
}

const STATUS_BYTES: u64 = size_of::<Status>() as u64;
const BYTES: u64 = STATUS_BYTES + size_of::<Found>() as u64;

/// The numbers in a mapped buffer.
fn read(staging: &wgpu::Buffer, frame: u64) -> Option<Feedback> {
    let view = staging.get_mapped_range(..).ok()?;
    let (status, found) = view.split_at_checked(size_of::<Status>())?;
    Some(of_frame(frame, status, found))
}

/// Waits for the numbers of a submitted frame.
pub(crate) async fn wait(
    gpu: &Gpu,
    (batch, fit): (&Batch, Option<&Fit>),
    frame: u64,
) -> Result<Feedback, Error> {
    let status = gpu.read_async(batch.status(), STATUS_BYTES).await?;
    let found = match fit {
        Some(fit) => gpu.read_async(fit.state(), size_of::<Found>() as u64).await?,
        None => vec![0; size_of::<Found>()],
    };
    Ok(of_frame(frame, &status, &found))
}

/// The feedback in the bytes of a [`Status`] and of a [`Found`].
fn of_frame(frame: u64, status: &[u8], found: &[u8]) -> Feedback {
    let status: Status = bytemuck::pod_read_unaligned(status);
    let found: Found = bytemuck::pod_read_unaligned(found);
    // Without the passes of `fit` these are zero, and the batch's own numbers are the needs.
    let needed = match found.needed() {
        [0, 0] => [status.points(), status.primitives()],
        needed => needed,
    };
    let drawn = if status.fits() { status.primitives() } else { 0 };
    let [points, primitives] = needed;
    Feedback { frame, points, primitives, drawn, scale: found.scale() }
}
