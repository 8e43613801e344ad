//! The lowest limits with which a device can run batches. A batch adapts to higher ones.

use crate::error::Error;

/// The most storage buffers that a shader binds.
const STORAGE_BUFFERS: u32 = 8;
/// Threads of the largest workgroup, all along x.
const WORKGROUP: u32 = 256;

/// Refuses a device that cannot run the shaders, before wgpu reports it in its own words.
pub(crate) fn check(device: &wgpu::Device) -> Result<(), Error> {
    let limits = device.limits();
    for (limit, needed, got) in [
        ("max_compute_workgroups_per_dimension", 1, limits.max_compute_workgroups_per_dimension),
        (
            "max_storage_buffers_per_shader_stage",
            STORAGE_BUFFERS,
            limits.max_storage_buffers_per_shader_stage,
        ),
        (
            "max_compute_invocations_per_workgroup",
            WORKGROUP,
            limits.max_compute_invocations_per_workgroup,
        ),
        ("max_compute_workgroup_size_x", WORKGROUP, limits.max_compute_workgroup_size_x),
    ] {
        at_least(limit, needed.into(), got.into())?;
    }
    Ok(())
}

/// Refuses a limit that is too low.
pub(crate) const fn at_least(limit: &'static str, needed: u64, got: u64) -> Result<(), Error> {
    if got < needed { Err(Error::LimitTooLow { limit, needed, got }) } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tess_gpu::{Resource, Stage};

    #[test]
    fn no_shader_binds_more() {
        let storage = |stage: Stage| {
            let bindings = stage.bindings().iter();
            bindings.filter(|binding| binding.0 != Resource::Job).count()
        };
        let most = Stage::ALL.into_iter().map(storage).max();
        assert_eq!(most, Some(STORAGE_BUFFERS as usize), "of all shaders");
    }
}
