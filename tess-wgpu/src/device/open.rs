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

/// Opens the first adapter of the backends that are `asked` for, or else of the environment's, or
/// else of any except OpenGL, unless this program has no other. OpenGL is tried last, because wgpu
/// would prefer an old GPU with an insufficient OpenGL to a Vulkan driver in software.
pub(crate) async fn first(
    asked: Option<Backends>,
    wanted: DeviceLimits,
    optional: wgpu::Features,
) -> Result<Gpu, Error> {
    let from_env = if asked.is_none() { Backends::from_env() } else { None };
    let built_in = wgpu::Instance::enabled_backend_features();
    let backends = asked.or(from_env).map_or_else(|| without_gl(built_in), |all| all & built_in);
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
    let more = match (from_env, reasons.is_empty()) {
        (Some(_), true) => {
            "WGPU_BACKEND names none of vulkan, metal, dx12, gl that this program has"
        }
        (Some(_), false) => "WGPU_BACKEND allows no other",
        (None, true) => "this program has none of these backends of wgpu built in",
        (None, false) if asked.is_none() && backends != built_in => {
            "OpenGL is used only if WGPU_BACKEND=gl or Gpu::open_on asks for it"
        }
        (None, false) => "",
    };
    reasons.extend((!more.is_empty()).then(|| more.to_owned()));
    Err(Error::NoDevice { reason: reasons.join("; ") })
}

/// These backends without OpenGL, unless there is no other.
fn without_gl(backends: Backends) -> Backends {
    let others = backends - Backends::GL;
    if others.is_empty() { backends } else { others }
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
