//! The pass `expand_short`: both outputs of a short batch.

use super::buffers::{Bound, Pass};
use super::expand_points::expand_points;
use super::expand_primitives::expand_primitives;

pub(crate) fn expand_short(pass: &Pass<'_>, b: &mut Bound<'_>) {
    expand_points(pass, b);
    expand_primitives(pass, b);
}
