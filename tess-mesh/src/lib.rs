#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![expect(clippy::float_arithmetic, reason = "surfaces are made of floats")]

mod budget;
mod error;
pub mod height;
mod load;
pub mod parts;
pub mod raw;
mod read;
mod repair;
mod tessellate;
mod texcoords;
mod uri;
pub mod write;

pub use budget::MAX_MEMORY;
pub use error::{LoadError, LoadErrorKind};
pub use load::{
    CREASE, Format, LoadOptions, Loaded, Progress, Up, Weld, load, load_watched, read, teapot,
};
pub use repair::tally::counted;
pub use tess_surface;
pub use tessellate::{Job, Stage, Watch, largest_factor};
pub use write::Totals;
