//! The stages of one patch, under the core's names, for one packet of patches or for one patch of
//! it.

pub(crate) mod connect;
pub(crate) mod counts;
pub(crate) mod factor_context;
pub(crate) mod factors;
pub(crate) mod packet;
pub(crate) mod place;
pub(crate) mod points;
pub(crate) mod reciprocal;
pub(crate) mod settings;
pub(crate) mod stitch;
pub(crate) mod template;
