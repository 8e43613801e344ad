//! Handles that are destroyed when they are dropped.

use super::Gpu;
use crate::error::Error;
use ash::prelude::VkResult;
use ash::vk;
use std::fmt;
use std::ops::Deref;
use std::sync::Arc;

type Callbacks<'a> = Option<&'a vk::AllocationCallbacks<'a>>;

/// The function that creates a handle.
type Create<T, I> = unsafe fn(&ash::Device, &I, Callbacks<'_>) -> VkResult<T>;
/// The function that destroys it.
type Destroy<T> = unsafe fn(&ash::Device, T, Callbacks<'_>);

/// A handle of a device. Fields are dropped from first to last, so a user of a handle comes before
/// it.
pub(crate) struct Owned<T: Copy> {
    handle: T,
    destroy: Destroy<T>,
    gpu: Arc<Gpu>,
}

impl<T: Copy> Owned<T> {
    /// Creates a handle with `create`, from `info`; `name` is the function's name in errors.
    ///
    /// # Safety
    /// `info` meets the function's demands; `destroy` is the counterpart of `create`; and nothing
    /// running uses the handle when it is dropped, which holds because each submission is waited
    /// for.
    pub(crate) unsafe fn new<I>(
        gpu: &Arc<Gpu>,
        name: &'static str,
        (create, destroy): (Create<T, I>, Destroy<T>),
        info: &I,
    ) -> Result<Self, Error> {
        // SAFETY: the device is alive, because `gpu` is; the caller guarantees `info`.
        let handle = unsafe { create(&gpu.device, info, None) }.map_err(Error::of(name))?;
        Ok(Self { handle, destroy, gpu: Arc::clone(gpu) })
    }
}

impl<T: Copy> Deref for Owned<T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.handle
    }
}

impl<T: Copy + fmt::Debug> fmt::Debug for Owned<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.handle.fmt(f)
    }
}

impl<T: Copy> Drop for Owned<T> {
    fn drop(&mut self) {
        // SAFETY: the caller of `new` guarantees it.
        unsafe { (self.destroy)(&self.gpu.device, self.handle, None) };
    }
}
