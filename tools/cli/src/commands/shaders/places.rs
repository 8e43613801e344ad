//! The places of resources in a language other than WGSL.

use naga::ResourceBinding;

/// The places of an entry point's resources.
pub(super) struct Places {
    pub(super) of: Vec<(ResourceBinding, Place)>,
    /// Metal's buffer slot in which the host passes the lengths of others.
    pub(super) sizes: Option<u32>,
    /// The constants of HLSL in which the host passes the number of workgroups.
    pub(super) workgroups: Option<Place>,
}

/// The place of a resource: its descriptor set and binding, or space and register.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Place {
    pub(super) set: u32,
    pub(super) binding: u32,
    pub(super) metal: Metal,
}

/// The place of a resource in Metal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Metal {
    Buffer(u32),
    Texture(u32),
    Sampler(u32),
}
