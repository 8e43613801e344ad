//! Errors of a device.

use ash::vk;
use std::fmt;

/// Why a device could not be asked.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// There is no Vulkan loader here; what the system says.
    NoLoader(String),
    /// There is no device of this number.
    NoDevice {
        /// The number that was asked for.
        asked: usize,
        /// How many devices there are.
        there: usize,
    },
    /// The device lacks something that a probe needs.
    Missing(&'static str),
    /// The device stopped answering.
    Lost,
    /// The device or the system has too little memory.
    OutOfMemory,
    /// A call failed in another way.
    Call {
        /// The call.
        call: &'static str,
        /// Its answer.
        result: String,
    },
    /// A capture cannot be what a device gives; the text says why.
    Capture(String),
}

impl Error {
    /// The error of a call that gave this result.
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

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoLoader(why) => {
                write!(f, "there is no Vulkan here ({why}); install the loader and a driver")
            }
            Self::NoDevice { asked, there: 0 } => {
                write!(f, "there is no Vulkan device {asked}: no driver has any")
            }
            Self::NoDevice { asked, there } => {
                write!(f, "there is no Vulkan device {asked}; they are numbered 0 to {}", there - 1)
            }
            Self::Missing(what) => write!(f, "this device has no {what}, which a probe needs"),
            Self::Lost => f.write_str("the device was lost: its driver ended it while it worked"),
            Self::OutOfMemory => f.write_str("the device or the system is out of memory"),
            Self::Call { call, result } => write!(f, "{call} failed: {result}"),
            Self::Capture(why) => write!(f, "the capture makes no sense: {why}"),
        }
    }
}

impl std::error::Error for Error {}
