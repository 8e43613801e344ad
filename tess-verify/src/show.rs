//! One patch for people: every stage of it ([`Explanation`]), a picture ([`draw`]), and a
//! comparison of a circuit's signals with the model's ([`compare_signals`]).

mod circuit;
mod drawing;
mod explanation;
mod origin;
mod picture;

pub use circuit::{Part, SignalDifference, SignalError, compare_signals};
pub use drawing::{
    Colours, Differences, DrawOptions, Drawing, differing, draw, has_rings, overlay,
};
pub use explanation::Explanation;
use explanation::{PointReport, PrimitiveReport};
