#![doc = include_str!("../README.md")]

mod drawing;
mod explanation;
mod origin;
mod part;
mod picture;
mod signals;

pub use drawing::{
    Colours, Differences, DrawOptions, Drawing, differing, draw, has_rings, overlay,
};
pub use explanation::Explanation;
use explanation::{PointReport, PrimitiveReport};
pub use origin::origin;
pub use part::Part;
pub use signals::{Signal, SignalDifference, SignalError, compare_signals};
