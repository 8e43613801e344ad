//! Handles that are destroyed when they are dropped.

use super::Gpu;
use crate::error::Error;
use ash::prelude::VkResult;
use ash::vk;
use std::fmt;
use std::ops::Deref;
use std::sync::Arc;

type Callbacks<'a> = Option<&'a vk::AllocationCallbacks<'a>>;

/// The function that makes a handle.
type Create<T, I> = unsafe fn(&ash::Device, &I, Callbacks<'_>) -> VkResult<T>;
/// Its counterpart.
type Destroy<T> = unsafe fn(&ash::Device, T, Callbacks<'_>);

/// A handle of a device. Fields are dropped from the first to the last: what uses a handle stands
/// before it.
pub(crate) struct Owned<T: Copy> {
    handle: T,
    destroy: Destroy<T>,
    gpu: Arc<Gpu>,
}

impl<T: Copy> Owned<T> {
    /// Makes a handle by the function of this name, as `info` says.
    ///
    /// # Safety
    /// `info` is as the function demands; `destroy` is its counterpart; and nothing that runs uses
    /// the handle when it is dropped, which holds as each submission is waited for.
    pub(crate) unsafe fn new<I>(
        gpu: &Arc<Gpu>,
        name: &'static str,
        (create, destroy): (Create<T, I>, Destroy<T>),
        info: &I,
    ) -> Result<Self, Error> {
        // SAFETY: the device is alive, as `gpu` is; `info` is as the caller says.
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
        // SAFETY: as the caller of `new` says.
        unsafe { (self.destroy)(&self.gpu.device, self.handle, None) };
    }
}
