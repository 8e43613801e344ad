//! Errors.

mod stage;

pub use stage::StageError;

use std::pin::pin;
use std::task::{Context, Poll, Waker};
use tess_core::Domain;
use tess_gpu::Resource;

/// The reason why a device, a buffer, a batch or a stage cannot be made or used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// No adapter gives a device. Install a Vulkan driver; Debian's `mesa-vulkan-drivers` has one
    /// that runs in software. OpenGL 4.3 or ES 3.1 or later also works, with the feature `gles`. In
    /// a browser: it has no WebGPU, or the page is neither from https nor from localhost.
    #[error("no graphics adapter could be used ({reason}); {}", remedy())]
    NoDevice {
        /// wgpu's reason for each adapter or backend that was tried, and whether `WGPU_BACKEND`
        /// restricts them.
        reason: String,
    },
    /// The device was lost. Open another one and make all objects again.
    #[error("the graphics device was lost: {reason}")]
    DeviceLost {
        /// wgpu's message.
        reason: String,
    },
    /// The device has too little memory left. Free some, or tessellate fewer patches at a time.
    #[error("the graphics device is out of memory")]
    OutOfMemory,
    /// A limit of the device is too low for any batch. Open the device with WebGPU's default limits
    /// or higher ones; WebGL, and OpenGL without compute shaders, cannot tessellate.
    #[error(
        "the device's limit {limit} is {got}, but {needed} is needed; open it with WebGPU's \
         default limits or higher ones (WebGL has no compute shaders, so it cannot tessellate)"
    )]
    LimitTooLow {
        /// The limit, a member of `wgpu::Limits`.
        limit: &'static str,
        /// The least that is needed.
        needed: u64,
        /// The device's limit.
        got: u64,
    },
    /// A buffer would be larger than the device allows. Tessellate fewer patches at a time, or open
    /// the device with higher limits ([`crate::DeviceLimits::Highest`]).
    #[error(
        "the buffer `{buffer}` needs {needed} bytes, but the device allows only {limit}; \
         tessellate fewer patches at a time"
    )]
    BufferTooLarge {
        /// Label of the buffer.
        buffer: String,
        /// Bytes that the buffer needs.
        needed: u64,
        /// The device's limit, `max_buffer_size`.
        limit: u64,
    },
    /// The buffer of factors is too short. Make it longer, or ask for fewer patches.
    #[error("the patches have {needed} bytes of factors, but their buffer has only {got}")]
    FactorsTooShort {
        /// Bytes that the patches need.
        needed: u64,
        /// Bytes that the buffer has.
        got: u64,
    },
    /// The caller's buffer lacks the usage `STORAGE`. Create it with that usage.
    #[error("the buffer of {} lacks the usage STORAGE", name(*.buffer))]
    NotStorage {
        /// Factors, points or indices.
        buffer: Resource,
    },
    /// One buffer serves two purposes. Use different buffers for factors, points and indices.
    #[error("one buffer is given for {} and for {}; use two", name(.buffers[0]), name(.buffers[1]))]
    SharedBuffer {
        /// The two purposes.
        buffers: [Resource; 2],
    },
    /// A patch has factors of another domain than the setup. Tessellate the patches of each domain
    /// separately.
    #[error("patch {patch} has {got:?} factors, but the setup is for the {expected:?} domain")]
    WrongDomain {
        /// Number of the first such patch.
        patch: usize,
        /// Domain of the setup.
        expected: Domain,
        /// Domain of the patch.
        got: Domain,
    },
    /// A batch has at most 2^30 patches.
    #[error("{got} patches are more than a batch can have, 2^30")]
    TooManyPatches {
        /// Patches of the batch.
        got: usize,
    },
    /// A group begins before its predecessor or past the end of the batch. Put the groups in
    /// ascending order.
    #[error(
        "group {group} begins at patch {begin}; it must begin at one of {} to {}, as groups ascend and lie within \
         the batch",
        .range[0],
        .range[1]
    )]
    MisplacedGroup {
        /// Number of the group.
        group: usize,
        /// The patch that it begins with.
        begin: u32,
        /// The least and the greatest number that it could begin with.
        range: [u32; 2],
    },
    /// A batch has at most 2^32 - 1 groups.
    #[error("{got} groups are more than a batch can have, 2^32 - 1")]
    TooManyGroups {
        /// Groups of the batch.
        got: usize,
    },
    /// The output of a batch has more than 2^32 - 1 points or primitives, or more points than
    /// 16-bit indices can number. Tessellate fewer patches at a time.
    #[error(
        "{points} points and {primitives} primitives are more than the indices can number; \
         tessellate fewer patches at a time"
    )]
    OutputTooLarge {
        /// Points of the batch.
        points: u64,
        /// Primitives of the batch.
        primitives: u64,
    },
    /// A batch whose points are computed in the vertex shader has too many patches for one binding.
    /// Tessellate fewer at a time, or store the points.
    #[error(
        "{got} patches without a point buffer are more than one binding holds, {most}; \
         make fewer at a time, or store the points"
    )]
    TooManyToPull {
        /// Patches of the batch.
        got: u32,
        /// The most that the device's `max_storage_buffer_binding_size` allows.
        most: u32,
    },
    /// The device lacks features. Ask for them when you open it, for example with
    /// [`crate::Gpu::open_with`].
    #[error(
        "the device lacks {missing}; ask for it when the device is opened, if the adapter has it"
    )]
    MissingFeatures {
        /// The missing features.
        missing: wgpu::Features,
    },
    /// A tessellation stage cannot be made or used like this.
    #[error(transparent)]
    Stage(#[from] StageError),
    /// wgpu refused an object or a command, for example a read past the end of a buffer.
    #[error("wgpu refused: {reason}")]
    Refused {
        /// wgpu's message.
        reason: String,
    },
}

/// The advice for a system without a device.
fn remedy() -> &'static str {
    if cfg!(target_arch = "wasm32") {
        "use a browser that has WebGPU, and a page from https or localhost"
    } else if wgpu::Instance::enabled_backend_features().contains(wgpu::Backends::GL) {
        "install a driver of Vulkan (in software: Debian's mesa-vulkan-drivers), or of OpenGL 4.3 or ES 3.1"
    } else {
        "install a Vulkan driver (in software: Debian's mesa-vulkan-drivers), or build with the feature \
         `gles` for a driver of OpenGL 4.3 or ES 3.1"
    }
}

const fn name(buffer: Resource) -> &'static str {
    match buffer {
        Resource::Factors => "factors",
        Resource::Points => "points",
        Resource::Indices => "indices",
        _ => "the batch",
    }
}

/// Does `work` and returns wgpu's error, for which wgpu would otherwise end the program.
///
/// Natively wgpu reports errors at once. A browser reports them later, in its console.
pub(crate) fn checked<T>(device: &wgpu::Device, work: impl FnOnce() -> T) -> Result<T, Error> {
    let filters = [
        wgpu::ErrorFilter::Internal,
        wgpu::ErrorFilter::OutOfMemory,
        wgpu::ErrorFilter::Validation,
    ];
    let scopes = filters.map(|filter| device.push_error_scope(filter));
    let done = work();
    let mut found = None;
    for scope in scopes.into_iter().rev() {
        let answer = pin!(scope.pop()).poll(&mut Context::from_waker(Waker::noop()));
        if let Poll::Ready(Some(error)) = answer {
            found = Some(error);
        }
    }
    match found {
        None => Ok(done),
        Some(wgpu::Error::OutOfMemory { .. }) => Err(Error::OutOfMemory),
        Some(error) => Err(Error::Refused { reason: error.to_string() }),
    }
}
