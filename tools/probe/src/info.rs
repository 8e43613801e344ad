//! The name and abilities of a device.

use serde::Serialize;
use std::fmt;

/// A Vulkan device.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct Info {
    /// Its number in the loader's list.
    pub number: usize,
    /// Its name.
    pub name: String,
    /// The name of its driver.
    pub driver: String,
    /// The driver's version, in the driver's own words.
    pub driver_version: String,
    /// Whether it has tessellation shaders.
    pub tessellates: bool,
    /// Whether it captures primitives (`VK_EXT_transform_feedback`).
    pub captures: bool,
    /// Whether its tessellation stages can write to buffers.
    pub stores: bool,
    /// Whether it is a processor, not a graphics device.
    pub is_software: bool,
    /// The largest factor, `maxTessellationGenerationLevel`.
    pub max_level: u32,
}

impl Info {
    /// A device of this name that captures primitives, for captures that do not come from Vulkan.
    #[must_use]
    pub fn named(name: &str, max_level: u32) -> Self {
        Self {
            number: 0,
            name: name.to_owned(),
            driver: String::new(),
            driver_version: String::new(),
            tessellates: true,
            captures: true,
            stores: false,
            is_software: false,
            max_level,
        }
    }
}

impl fmt::Display for Info {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { number, name, driver, driver_version, .. } = self;
        write!(f, "{number}: {name}, driver {driver} {driver_version}")?;
        if !self.tessellates {
            f.write_str("; no tessellation")
        } else if !self.captures && !self.stores {
            f.write_str("; neither captures nor stores what it tessellates")
        } else if !self.captures {
            f.write_str("; no transform feedback: only domain points")
        } else {
            Ok(())
        }
    }
}
