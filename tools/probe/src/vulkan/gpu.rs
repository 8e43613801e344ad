//! One device with a queue.

use crate::error::Error;
use crate::info::Info;
use ash::{ext, vk};
use std::ffi::CStr;
use std::fmt;

/// A device that can tessellate, with its name and abilities.
pub(crate) struct Gpu {
    pub(crate) device: ash::Device,
    pub(crate) queue: vk::Queue,
    pub(crate) family: u32,
    pub(crate) memory: vk::PhysicalDeviceMemoryProperties,
    pub(crate) limits: vk::PhysicalDeviceLimits,
    pub(crate) feedback: Option<ext::transform_feedback::Device>,
    pub(crate) info: Info,
    _instance: Instance,
}

impl fmt::Debug for Gpu {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Gpu").field("info", &self.info).finish_non_exhaustive()
    }
}

impl Drop for Gpu {
    fn drop(&mut self) {
        // SAFETY: every other object of the device holds an `Arc` of this, so none is left, and
        // nothing runs, because each submission is waited for.
        unsafe { self.device.destroy_device(None) };
    }
}

struct Instance {
    instance: ash::Instance,
    /// The loader, which must outlive everything obtained from it.
    _entry: ash::Entry,
}

impl Drop for Instance {
    fn drop(&mut self) {
        // SAFETY: nothing of the instance is left: its device has been destroyed.
        unsafe { self.instance.destroy_instance(None) };
    }
}

fn instance() -> Result<Instance, Error> {
    // SAFETY: the library is the system's loader, whose initialisers are trusted as in any program
    // that uses Vulkan.
    let entry =
        unsafe { ash::Entry::load() }.map_err(|error| Error::NoLoader(error.to_string()))?;
    let application = vk::ApplicationInfo::default().api_version(vk::API_VERSION_1_1);
    let create = vk::InstanceCreateInfo::default().application_info(&application);
    // SAFETY: the structures live through the call, and `entry` outlives the instance.
    let instance = unsafe { entry.create_instance(&create, None) };
    let instance = instance.map_err(|result| match result {
        vk::Result::ERROR_INCOMPATIBLE_DRIVER => {
            Error::NoLoader("no driver is installed".to_owned())
        }
        // The loader returns this if it cannot read any driver's manifest.
        vk::Result::ERROR_OUT_OF_HOST_MEMORY => Error::NoLoader(
            "the loader cannot begin: a driver's manifest is malformed, or memory is short; \
             VK_LOADER_DEBUG=error says more"
                .to_owned(),
        ),
        other => Error::of("vkCreateInstance")(other),
    })?;
    Ok(Instance { instance, _entry: entry })
}

/// Every device that the system's loader knows, in its order.
///
/// # Errors
/// [`Error::NoLoader`] without Vulkan.
pub fn list() -> Result<Vec<Info>, Error> {
    let owner = instance()?;
    let devices = devices(&owner.instance)?.into_iter().enumerate();
    Ok(devices.map(|(number, device)| info(&owner.instance, device, number)).collect())
}

fn devices(instance: &ash::Instance) -> Result<Vec<vk::PhysicalDevice>, Error> {
    // SAFETY: the instance is alive.
    unsafe { instance.enumerate_physical_devices() }
        .map_err(Error::of("vkEnumeratePhysicalDevices"))
}

fn info(instance: &ash::Instance, physical: vk::PhysicalDevice, number: usize) -> Info {
    let mut driver = vk::PhysicalDeviceDriverProperties::default();
    let mut all = vk::PhysicalDeviceProperties2::default().push_next(&mut driver);
    // SAFETY: the device is of this instance, whose version has this call.
    unsafe { instance.get_physical_device_properties2(physical, &mut all) };
    let properties = all.properties;
    let text = |name: Result<&CStr, _>| name.map_or(String::new(), text_of);
    // SAFETY: as above.
    let features = unsafe { instance.get_physical_device_features(physical) };
    Info {
        number,
        name: text(properties.device_name_as_c_str()),
        driver: text(driver.driver_name_as_c_str()),
        driver_version: text(driver.driver_info_as_c_str()),
        tessellates: features.tessellation_shader == vk::TRUE,
        captures: has_feedback(instance, physical),
        stores: features.vertex_pipeline_stores_and_atomics == vk::TRUE,
        is_software: properties.device_type == vk::PhysicalDeviceType::CPU,
        max_level: properties.limits.max_tessellation_generation_level,
    }
}

fn text_of(text: &CStr) -> String {
    text.to_string_lossy().into_owned()
}

fn has_feedback(instance: &ash::Instance, physical: vk::PhysicalDevice) -> bool {
    // SAFETY: the device is of this instance.
    let extensions = unsafe { instance.enumerate_device_extension_properties(physical) };
    let named = extensions.is_ok_and(|extensions| {
        let mut names = extensions.iter().filter_map(|e| e.extension_name_as_c_str().ok());
        names.any(|name| name == ext::transform_feedback::NAME)
    });
    let mut feedback = vk::PhysicalDeviceTransformFeedbackFeaturesEXT::default();
    let mut all = vk::PhysicalDeviceFeatures2::default().push_next(&mut feedback);
    // SAFETY: the device is of this instance, whose version has this call.
    unsafe { instance.get_physical_device_features2(physical, &mut all) };
    named && feedback.transform_feedback == vk::TRUE
}

impl Gpu {
    /// Opens device `number` of the loader's list.
    pub(crate) fn open(number: usize) -> Result<Self, Error> {
        let owner = instance()?;
        let instance = &owner.instance;
        let devices = devices(instance)?;
        let there = devices.len();
        let physical = *devices.get(number).ok_or(Error::NoDevice { asked: number, there })?;
        let info = info(instance, physical, number);
        if !info.tessellates {
            return Err(Error::Missing("tessellation shaders"));
        }
        if !info.captures && !info.stores {
            return Err(Error::Missing(
                "transform feedback (VK_EXT_transform_feedback), nor stores from vertex stages",
            ));
        }
        let family = family(instance, physical)?;
        let device = device(instance, physical, family, &info)?;
        let feedback = ext::transform_feedback::Device::new(instance, &device);
        let feedback = info.captures.then_some(feedback);
        // SAFETY: the device was made with one queue of this family.
        let queue = unsafe { device.get_device_queue(family, 0) };
        // SAFETY: the device is of this instance.
        let memory = unsafe { instance.get_physical_device_memory_properties(physical) };
        // SAFETY: as above.
        let limits = unsafe { instance.get_physical_device_properties(physical) }.limits;
        Ok(Self { device, queue, family, memory, limits, feedback, info, _instance: owner })
    }
}

/// The first queue family that can draw and compute.
fn family(instance: &ash::Instance, physical: vk::PhysicalDevice) -> Result<u32, Error> {
    // SAFETY: the device is of this instance.
    let families = unsafe { instance.get_physical_device_queue_family_properties(physical) };
    let wanted = vk::QueueFlags::GRAPHICS | vk::QueueFlags::COMPUTE;
    let found = (0..).zip(&families).find(|(_, family)| family.queue_flags.contains(wanted));
    found.map(|(number, _)| number).ok_or(Error::Missing("queue that draws and computes"))
}

fn device(
    instance: &ash::Instance,
    physical: vk::PhysicalDevice,
    family: u32,
    info: &Info,
) -> Result<ash::Device, Error> {
    let queue =
        [vk::DeviceQueueCreateInfo::default().queue_family_index(family).queue_priorities(&[1.0])];
    let features = vk::PhysicalDeviceFeatures::default()
        .tessellation_shader(true)
        .vertex_pipeline_stores_and_atomics(info.stores);
    let mut feedback =
        vk::PhysicalDeviceTransformFeedbackFeaturesEXT::default().transform_feedback(true);
    let names = [ext::transform_feedback::NAME.as_ptr()];
    let mut create =
        vk::DeviceCreateInfo::default().queue_create_infos(&queue).enabled_features(&features);
    if info.captures {
        create = create.enabled_extension_names(&names).push_next(&mut feedback);
    }
    // SAFETY: the device has reported every one of these features and extensions, and the
    // structures live through the call.
    unsafe { instance.create_device(physical, &create, None) }.map_err(Error::of("vkCreateDevice"))
}
