//! Settings of a tessellator.

use crate::stages::stitch::SharedStitches;
use tess_core::Config;
use tess_core::Order;

/// Settings that all patches of a tessellator share: the configuration, the order of triangles, and
/// the stitch tables that follow from the configuration.
#[derive(Clone, Debug)]
pub(crate) struct Settings {
    pub(crate) config: Config,
    pub(crate) order: Order,
    pub(crate) stitches: SharedStitches,
}

impl Settings {
    /// The settings of a configuration. Makes the stitch tables unless they exist.
    pub(crate) fn new(config: Config) -> Self {
        Self { config, order: Order::Specification, stitches: SharedStitches::of(config) }
    }
}
