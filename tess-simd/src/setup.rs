//! What a tessellator is made for.

use crate::level::Level;
use crate::stitch::Stitches;
use tess_core::Config;
use tess_core::Order;

/// A configuration, the tables that follow from it, the order of triangles, and the CPU level to run at.
#[derive(Clone, Debug)]
pub(crate) struct Setup {
    pub(crate) config: Config,
    pub(crate) order: Order,
    pub(crate) level: Level,
    pub(crate) stitches: Stitches,
}

impl Setup {
    /// Makes the tables. The level is one that this machine can run.
    pub(crate) fn new(config: Config, level: Level) -> Self {
        let order = Order::Specification;
        Self { config, order, level, stitches: Stitches::new(config) }
    }
}
