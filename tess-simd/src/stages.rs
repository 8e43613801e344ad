//! The stages of a patch, named as in the core. They run over a packet of patches, or over one
//! patch of a packet.

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
