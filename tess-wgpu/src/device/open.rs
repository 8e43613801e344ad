//! The choice of an adapter.

use crate::Gpu;
use crate::error::Error;
use wgpu::Backends;

/// The limits to open a device with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DeviceLimits {
    /// WebGPU's default limits.
    Default,
    /// The highest limits of the adapter.
    Highest,
}

/// Opens the first adapter that gives a device. OpenGL is tried last, because wgpu would prefer an
/// old GPU with an insufficient OpenGL to a Vulkan driver in software.
pub(crate) async fn first(wanted: DeviceLimits, optional: wgpu::Features) -> Result<Gpu, Error> {
    let asked = Backends::from_env();
    let backends = asked.unwrap_or_else(wgpu::Instance::enabled_backend_features);
    let mut reasons = Vec::new();
    for some in [backends - Backends::GL, backends & Backends::GL] {
        if some.is_empty() {
            continue;
        }
        match of(some, wanted, optional).await {
            Ok(opened) => return Ok(opened),
            Err(reason) => reasons.push(reason),
        }
    }
    match (asked, reasons.is_empty()) {
        (Some(_), true) => {
            reasons.push("WGPU_BACKEND is none of vulkan, metal, dx12, gl".to_owned());
        }
        (Some(_), false) => reasons.push("WGPU_BACKEND allows no other".to_owned()),
        (None, true) => reasons.push("this program has no backend of wgpu built in".to_owned()),
        (None, false) => {}
    }
    Err(Error::NoDevice { reason: reasons.join("; ") })
}

/// Opens the first adapter of these backends, or returns the reason why it cannot be used.
async fn of(
    backends: Backends,
    wanted: DeviceLimits,
    optional: wgpu::Features,
) -> Result<Gpu, String> {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = backends;
    // WGPU_DEBUG=0 leaves debug information out of shaders, which drivers take long to read.
    descriptor.flags = descriptor.flags.with_env();
    // The shaders never write dispatch sizes beyond the limits, and wgpu's check would add
    // dispatches.
    descriptor.flags.remove(wgpu::InstanceFlags::VALIDATION_INDIRECT_CALL);
    let instance = wgpu::Instance::new(descriptor);
    let options = wgpu::RequestAdapterOptions {
        power_preference: wgpu::PowerPreference::HighPerformance,
        ..Default::default()
    };
    let adapter = instance.request_adapter(&options).await.map_err(|error| error.to_string())?;
    let info = adapter.get_info();
    let has = adapter.get_downlevel_capabilities().flags;
    if !has.contains(wgpu::DownlevelFlags::COMPUTE_SHADERS) {
        let name = name(&info);
        return Err(format!("{name} lacks compute shaders, which need OpenGL 4.3 or ES 3.1"));
    }
    let required_limits = match wanted {
        DeviceLimits::Default => wgpu::Limits::default(),
        DeviceLimits::Highest => adapter.limits(),
    };
    let descriptor = wgpu::DeviceDescriptor {
        required_features: adapter.features() & optional,
        required_limits,
        ..Default::default()
    };
    let device = adapter.request_device(&descriptor).await;
    let (device, queue) = device.map_err(|error| format!("{}: {error}", name(&info)))?;
    Ok(Gpu { device, queue, info })
}

/// The name and driver of an adapter.
pub(crate) fn name(info: &wgpu::AdapterInfo) -> String {
    let wgpu::AdapterInfo { name, driver_info, backend, .. } = info;
    format!("{name} ({backend}, {driver_info})")
}
