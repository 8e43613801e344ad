//! Repairs of a mesh between its file and the model.

pub(crate) mod collapsed;
pub(crate) mod draft;
pub(crate) mod faces;
pub(crate) mod polygon;
pub(crate) mod tally;
pub(crate) mod weld;
