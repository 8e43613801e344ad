//! One patch for people: every stage of it ([`Explanation`]), a picture ([`draw`]), and a
//! comparison of a circuit's signals with the model's ([`compare_signals`]).

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
pub use part::Part;
pub use signals::{Signal, SignalDifference, SignalError, compare_signals};
