#![doc = include_str!("../README.md")]

mod bench;
mod capture;
mod cases;
mod digests;
mod draws;
mod error;
mod info;
mod judge;
mod modes;
mod probe;
mod report;
mod rules;
mod shaders;
mod verdict;
mod vulkan;

pub use bench::{BenchTimes, bench};
pub use capture::{Captured, Method, Prober};
pub use cases::{asked, cases, rule_cases};
pub use digests::Digests;
pub use draws::DRAW_VERTICES;
pub use error::Error;
pub use info::Info;
pub use judge::Judge;
pub use probe::{probe, probe_known};
pub use report::{ExplainedBy, First, ProbeReport, ProbeRow, Unexplained};
pub use rules::rules;
pub use tess_verify::check::Explanation;
pub use vulkan::{Spirv, list};
