//! A device to run on, and moving bytes to and from it.

use std::fmt;
use std::sync::mpsc;

/// A device with its queue, and what it is.
#[derive(Clone, Debug)]
pub struct Gpu {
    /// The device.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
    /// The adapter that it was made from.
    pub info: wgpu::AdapterInfo,
}

/// There is no device to run on.
#[derive(Clone, Debug)]
pub struct Unavailable(String);

impl fmt::Display for Unavailable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "no graphics adapter could be used ({}); install a Vulkan driver \
             (in software: Debian's mesa-vulkan-drivers)",
            self.0
        )
    }
}

impl std::error::Error for Unavailable {}

/// Which limits to ask a device for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// WebGPU's defaults, whatever the device has.
    Defaults,
    /// All that the device has.
    Everything,
}

impl Gpu {
    /// The first adapter that there is, with WebGPU's default limits.
    ///
    /// # Errors
    /// [`Unavailable`] if there is none, or it gives no device.
    pub async fn open() -> Result<Self, Unavailable> {
        Self::open_with(Wanted::Defaults, wgpu::Features::empty()).await
    }

    /// The first adapter that there is, with the limits that are wanted and those of the optional
    /// features that it has.
    ///
    /// # Errors
    /// [`Unavailable`] if there is none, or it gives no device.
    pub async fn open_with(wanted: Wanted, optional: wgpu::Features) -> Result<Self, Unavailable> {
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
        // The shaders write no dispatch sizes beyond the limits; checking costs dispatches more.
        descriptor.flags.remove(wgpu::InstanceFlags::VALIDATION_INDIRECT_CALL);
        let instance = wgpu::Instance::new(descriptor);
        let options = wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            ..Default::default()
        };
        let unavailable = |error: &dyn fmt::Display| Unavailable(error.to_string());
        let adapter =
            instance.request_adapter(&options).await.map_err(|error| unavailable(&error))?;
        let required_limits = match wanted {
            Wanted::Defaults => wgpu::Limits::default(),
            Wanted::Everything => adapter.limits(),
        };
        let descriptor = wgpu::DeviceDescriptor {
            required_features: adapter.features() & optional,
            required_limits,
            ..Default::default()
        };
        let (device, queue) =
            adapter.request_device(&descriptor).await.map_err(|error| unavailable(&error))?;
        Ok(Self { device, queue, info: adapter.get_info() })
    }

    /// Name and driver of the adapter.
    #[must_use]
    pub fn name(&self) -> String {
        let wgpu::AdapterInfo { name, driver_info, backend, .. } = &self.info;
        format!("{name} ({backend}, {driver_info})")
    }

    /// A buffer with these bytes.
    #[must_use]
    pub fn upload(&self, label: &str, bytes: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
        filled(&self.device, label, bytes, usage)
    }

    /// A buffer of `size` bytes, at least 4.
    #[must_use]
    pub fn buffer(&self, label: &str, size: u64, usage: wgpu::BufferUsages) -> wgpu::Buffer {
        empty(&self.device, label, size, usage)
    }

    /// Submits the commands and waits until they have run.
    ///
    /// # Errors
    /// A message if the device was lost.
    pub fn run(&self, encoder: wgpu::CommandEncoder) -> Result<(), String> {
        self.queue.submit([encoder.finish()]);
        let waited = self.device.poll(wgpu::PollType::wait_indefinitely());
        waited.map(drop).map_err(|error| format!("the device did not finish: {error}"))
    }

    /// The first `size` bytes of a buffer, which has the usage `COPY_SRC`.
    ///
    /// # Errors
    /// A message if the device was lost.
    pub fn read(&self, buffer: &wgpu::Buffer, size: u64) -> Result<Vec<u8>, String> {
        if size == 0 {
            return Ok(Vec::new());
        }
        let usage = wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST;
        let staging = self.buffer("read back", size, usage);
        let mut encoder = self.device.create_command_encoder(&Default::default());
        encoder.copy_buffer_to_buffer(buffer, 0, &staging, 0, size);
        self.queue.submit([encoder.finish()]);
        let (sender, receiver) = mpsc::channel();
        staging.map_async(wgpu::MapMode::Read, .., move |result| {
            // The receiver lives until the wait below is over.
            let _ = sender.send(result);
        });
        self.device
            .poll(wgpu::PollType::wait_indefinitely())
            .map_err(|error| format!("the device did not finish: {error}"))?;
        let mapped = receiver.recv().map_err(|error| error.to_string())?;
        mapped.map_err(|error| format!("reading back failed: {error}"))?;
        let view = staging.get_mapped_range(..).map_err(|error| error.to_string())?;
        Ok(view.to_vec())
    }
}

pub(crate) fn empty(
    device: &wgpu::Device,
    label: &str,
    size: u64,
    usage: wgpu::BufferUsages,
) -> wgpu::Buffer {
    device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size: size.max(4).next_multiple_of(4),
        usage,
        mapped_at_creation: false,
    })
}

pub(crate) fn filled(
    device: &wgpu::Device,
    label: &str,
    bytes: &[u8],
    usage: wgpu::BufferUsages,
) -> wgpu::Buffer {
    use wgpu::util::{BufferInitDescriptor, DeviceExt};
    let contents: &[u8] = if bytes.is_empty() { &[0; 4] } else { bytes };
    device.create_buffer_init(&BufferInitDescriptor { label: Some(label), contents, usage })
}
