//! Errors of a device.

use ash::vk;

/// The reason why a device could not be asked.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// There is no Vulkan loader here; with the system's message.
    #[error("there is no Vulkan here ({0}); install the loader and a driver")]
    NoLoader(String),
    /// No device has this number.
    #[error("there is no Vulkan device {asked}{}", numbers(*.there))]
    NoDevice {
        /// The requested number.
        asked: usize,
        /// The number of devices.
        there: usize,
    },
    /// The device lacks something that a probe needs.
    #[error("this device has no {0}, which a probe needs")]
    Missing(&'static str),
    /// The device stopped answering.
    #[error("the device was lost: its driver ended it while it worked")]
    Lost,
    /// The device or the system has too little memory.
    #[error("the device or the system is out of memory")]
    OutOfMemory,
    /// A call failed for another reason.
    #[error("{call} failed: {result}")]
    Call {
        /// The call.
        call: &'static str,
        /// Its result.
        result: String,
    },
    /// A capture cannot come from a device; the text gives the reason.
    #[error("the capture makes no sense: {0}")]
    Capture(String),
}

impl Error {
    /// The error for a call that returned this result.
    pub(crate) fn of(call: &'static str) -> impl FnOnce(vk::Result) -> Self {
        move |result| match result {
            vk::Result::ERROR_DEVICE_LOST => Self::Lost,
            vk::Result::ERROR_OUT_OF_HOST_MEMORY | vk::Result::ERROR_OUT_OF_DEVICE_MEMORY => {
                Self::OutOfMemory
            }
            other => Self::Call { call, result: format!("{other:?}") },
        }
    }
}

/// The text about existing numbers, after one that does not exist.
fn numbers(there: usize) -> String {
    match there {
        0 => ": no driver has any".to_owned(),
        _ => format!("; they are numbered 0 to {}", there - 1),
    }
}
