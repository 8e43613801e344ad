//! A device, and transfers to and from it.

use super::open::{self, DeviceLimits};
use crate::error::{Error, StageError, checked};
use futures_channel::oneshot;
use std::fmt;
use std::future::{Future, poll_fn};
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::pin::pin;
use std::task::{Context, Poll, Waker};

/// A device with its queue and the description of its adapter. The fields are public: fill them
/// with your own device, or call [`Gpu::open`].
#[derive(Clone, Debug)]
pub struct Gpu {
    /// The device.
    pub device: wgpu::Device,
    /// The device's queue.
    pub queue: wgpu::Queue,
    /// The adapter's name, driver and kind.
    pub info: wgpu::AdapterInfo,
}

impl Gpu {
    /// Opens the first adapter with WebGPU's default limits.
    ///
    /// As in other programs that use wgpu, the environment variable `WGPU_BACKEND` decides the
    /// choice: `vulkan`, `metal`, `dx12`, `gl`, or several separated by commas. OpenGL, in builds
    /// that have it (the feature `gles`), is used only if the variable or [`Self::open_on`] asks
    /// for it, and after all others.
    ///
    /// # Errors
    /// [`Error::NoDevice`] if no adapter gives a device.
    pub async fn open() -> Result<Self, Error> {
        Self::open_with(DeviceLimits::Default, wgpu::Features::empty()).await
    }

    /// Opens the first adapter with these limits, and with those of the optional features that it
    /// has.
    ///
    /// # Errors
    /// [`Error::NoDevice`] if no adapter gives a device.
    pub async fn open_with(wanted: DeviceLimits, optional: wgpu::Features) -> Result<Self, Error> {
        open::first(None, wanted, optional).await
    }

    /// Opens the first adapter of these backends, whatever the environment says. If OpenGL is among
    /// them, it is used only if no other gives a device: `wgpu::Backends::all()` falls back to it.
    ///
    /// # Errors
    /// [`Error::NoDevice`] if no adapter gives a device.
    pub async fn open_on(
        backends: wgpu::Backends,
        wanted: DeviceLimits,
        optional: wgpu::Features,
    ) -> Result<Self, Error> {
        open::first(Some(backends), wanted, optional).await
    }

    /// The name and driver of the adapter, for messages.
    #[must_use]
    pub fn name(&self) -> String {
        open::name(&self.info)
    }

    /// Makes a buffer with these bytes.
    ///
    /// # Errors
    /// [`Error::BufferTooLarge`], [`Error::OutOfMemory`] or [`Error::Refused`].
    pub fn upload(
        &self,
        label: &str,
        bytes: &[u8],
        usage: wgpu::BufferUsages,
    ) -> Result<wgpu::Buffer, Error> {
        filled(&self.device, label, bytes, usage)
    }

    /// Makes a buffer of `size` bytes, at least 4, rounded up to a multiple of 4.
    ///
    /// # Errors
    /// [`Error::BufferTooLarge`], [`Error::OutOfMemory`] or [`Error::Refused`].
    pub fn buffer(
        &self,
        label: &str,
        size: u64,
        usage: wgpu::BufferUsages,
    ) -> Result<wgpu::Buffer, Error> {
        empty(&self.device, label, size, usage)
    }

    /// Submits the commands and waits until they have run.
    ///
    /// # Errors
    /// [`Error::DeviceLost`], or [`Error::Refused`] for commands that are not valid.
    pub fn run(&self, encoder: wgpu::CommandEncoder) -> Result<(), Error> {
        self.submit(encoder)?;
        self.wait()
    }

    /// Reads the first `size` bytes of a buffer with the usage `COPY_SRC`.
    ///
    /// # Errors
    /// [`Error::DeviceLost`]; or [`Error::Refused`], for example for more bytes than the buffer
    /// has.
    pub fn read(&self, buffer: &wgpu::Buffer, size: u64) -> Result<Vec<u8>, Error> {
        self.finish(self.read_async(buffer, size))
    }

    /// Does the same as [`Self::read`] without blocking: for browsers, and for programs that do
    /// other work meanwhile.
    ///
    /// Natively, the device must be polled until it is done. The future does that whenever it is
    /// polled, and asks to be polled again at once. In a browser the device notifies the future.
    ///
    /// # Errors
    /// Those of [`Gpu::read`].
    pub async fn read_async(&self, buffer: &wgpu::Buffer, size: u64) -> Result<Vec<u8>, Error> {
        if size == 0 {
            return Ok(Vec::new());
        }
        let usage = wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST;
        let staging = self.buffer("read back", size, usage)?;
        let mut encoder = self.device.create_command_encoder(&Default::default());
        encoder.copy_buffer_to_buffer(buffer, 0, &staging, 0, size);
        self.submit(encoder)?;
        let (sender, mut receiver) = oneshot::channel();
        checked(&self.device, || {
            staging.map_async(wgpu::MapMode::Read, .., move |result| _ = sender.send(result));
        })?;
        let answer = poll_fn(|context| {
            if let Err(error) = poll(&self.device, wgpu::PollType::Poll) {
                return Poll::Ready(Err(error));
            }
            let answer = pin!(&mut receiver).poll(context);
            if cfg!(not(target_arch = "wasm32")) && answer.is_pending() {
                context.waker().wake_by_ref();
            }
            answer.map(Ok)
        });
        let answer = answer.await?.map_err(|_| lost(&"it never answered"))?;
        answer.map_err(|error| lost(&error))?;
        let view = staging.get_mapped_range(..).map_err(|error| lost(&error))?;
        Ok(view.to_vec())
    }

    /// Polls a future until it is done, for work that waits only for this device.
    pub(crate) fn finish<T>(
        &self,
        work: impl Future<Output = Result<T, Error>>,
    ) -> Result<T, Error> {
        let mut work = pin!(work);
        loop {
            match work.as_mut().poll(&mut Context::from_waker(Waker::noop())) {
                Poll::Ready(done) => return done,
                Poll::Pending if cfg!(target_arch = "wasm32") => {
                    let reason = "a browser answers later; use the async form".to_owned();
                    return Err(Error::Refused { reason });
                }
                Poll::Pending => self.wait()?,
            }
        }
    }

    /// Submits the commands.
    pub(crate) fn submit(&self, encoder: wgpu::CommandEncoder) -> Result<(), Error> {
        check_alive(&self.device)?;
        checked(&self.device, || self.queue.submit([encoder.finish()])).map(drop)
    }

    /// Waits until all submitted commands have run.
    fn wait(&self) -> Result<(), Error> {
        poll(&self.device, wgpu::PollType::wait_indefinitely())?;
        check_alive(&self.device)
    }
}

pub(crate) fn empty(
    device: &wgpu::Device,
    label: &str,
    size: u64,
    usage: wgpu::BufferUsages,
) -> Result<wgpu::Buffer, Error> {
    let size = size.max(4).next_multiple_of(4);
    check_size(device, label, size)?;
    let label = Some(label);
    checked(device, || {
        let mapped_at_creation = false;
        device.create_buffer(&wgpu::BufferDescriptor { label, size, usage, mapped_at_creation })
    })
}

pub(crate) fn filled(
    device: &wgpu::Device,
    label: &str,
    bytes: &[u8],
    usage: wgpu::BufferUsages,
) -> Result<wgpu::Buffer, Error> {
    let size = (bytes.len() as u64).max(4).next_multiple_of(4);
    check_size(device, label, size)?;
    let label = Some(label);
    checked(device, || {
        let mapped_at_creation = true;
        let descriptor = wgpu::BufferDescriptor { label, size, usage, mapped_at_creation };
        let buffer = device.create_buffer(&descriptor);
        let mut view = buffer.get_mapped_range_mut(..).map_err(|error| lost(&error))?;
        view.slice(..bytes.len()).copy_from_slice(bytes);
        drop(view);
        buffer.unmap();
        Ok(buffer)
    })?
}

/// Polls the device. wgpu panics in this call if the driver has lost the device; such a panic
/// becomes an error.
pub(crate) fn poll(device: &wgpu::Device, kind: wgpu::PollType) -> Result<(), Error> {
    match catch_unwind(AssertUnwindSafe(|| device.poll(kind))) {
        Ok(polled) => polled.map(drop).map_err(|error| lost(&error)),
        Err(panic) => {
            check_alive(device)?;
            resume_unwind(panic)
        }
    }
}

/// Records commands. wgpu panics if the encoder belongs to another instance, which does not know
/// the buffers; here that becomes an error. If the encoder belongs to another device of the same
/// instance, wgpu reports that when the encoder is finished.
pub(crate) fn recorded(device: &wgpu::Device, record: impl FnOnce()) -> Result<(), Error> {
    if catch_unwind(AssertUnwindSafe(record)).is_ok() {
        return Ok(());
    }
    check_alive(device)?;
    Err(StageError::OtherDevice.into())
}

/// Returns an error if the device is lost. wgpu does not report this when it makes objects or
/// accepts commands, but it cannot map a buffer.
fn check_alive(device: &wgpu::Device) -> Result<(), Error> {
    filled(device, "is the device alive", &[0; 4], wgpu::BufferUsages::COPY_SRC).map(drop)
}

fn lost(error: &dyn fmt::Display) -> Error {
    Error::DeviceLost { reason: error.to_string() }
}

/// Refuses a buffer that is too large, before wgpu reports it in its own words.
fn check_size(device: &wgpu::Device, label: &str, needed: u64) -> Result<(), Error> {
    let limit = device.limits().max_buffer_size;
    if needed <= limit {
        return Ok(());
    }
    Err(Error::BufferTooLarge { buffer: label.to_owned(), needed, limit })
}
