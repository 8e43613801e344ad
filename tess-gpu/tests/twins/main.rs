//! Twins of the passes: each file of `shaders/entry_points` has a function that computes the
//! contents of the buffers after the pass from those before it. Read the twin first; the shader
//! shows how threads do it together.
//!
//! ```text
//! pass                twin                      writes
//! factors             factors.rs, block.rs      Topologies, Contexts, Offsets (patches, blocks), keys of the Catalogue
//! scan                scan.rs                   Offsets (blocks, sections)
//! totals              totals.rs, finish.rs      Offsets (sections), Status, Arguments
//! list                list.rs, described.rs     places and elements of the Catalogue
//! groups              groups.rs                 Draws
//! partition           partition.rs              Tiles
//! expand_points       expand_points.rs          Points
//! expand_primitives   expand_primitives.rs      Indices
//! short_batch         short_batch.rs, block.rs  what the first three and `partition` write
//! expand_short        expand_short.rs           Points, Indices
//! ```
//!
//! Contexts, counts, points and triangles are those of `tess-core`. A batch runs pass by pass on
//! wgpu, with the host code of `examples/bare_wgpu.rs`; after each pass, every word of every buffer
//! that it may write is compared. Some results are not defined, and so taken from the device after
//! a check: the slot of each key, the order of the places in the catalogue, and the points of a
//! culled topology.

#[allow(dead_code, reason = "the tests run the passes one by one")]
#[path = "../../examples/bare_wgpu.rs"]
mod bare_wgpu;
mod block;
mod buffers;
mod cases;
mod catalogue;
mod compare;
mod described;
mod expand_points;
mod expand_primitives;
mod expand_short;
mod factors;
mod faults;
mod finish;
mod groups;
mod list;
mod partition;
mod run;
mod scan;
mod short_batch;
mod totals;

use buffers::{Bound, Pass};
use tess_gpu::Stage;

/// Gives the buffers their expected contents after the pass.
fn twin(pass: &Pass<'_>, bound: &mut Bound<'_>) {
    let twin = match pass.stage {
        Stage::Short => short_batch::short_batch,
        Stage::Factors => factors::factors,
        Stage::Scan => scan::scan,
        Stage::Totals => totals::totals,
        Stage::List => list::list,
        Stage::Partition => partition::partition,
        Stage::Groups => groups::groups,
        Stage::ExpandPoints => expand_points::expand_points,
        Stage::ExpandPrimitives => expand_primitives::expand_primitives,
        Stage::ExpandShort => expand_short::expand_short,
    };
    twin(pass, bound);
}

/// The twin of `entry_points/NAME.wgsl` is `NAME.rs`.
#[test]
fn every_entry_point_has_a_twin_of_its_name() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let shaders = root.join("shaders/entry_points");
    let names = std::fs::read_dir(&shaders)
        .expect("the shaders")
        .map(|entry| entry.expect("a shader").path().file_stem().expect("a name").to_owned());
    let twin = |name: &std::ffi::OsString| root.join("tests/twins").join(name).with_extension("rs");
    let lacking: Vec<_> = names.filter(|name| !twin(name).is_file()).collect();
    assert!(lacking.is_empty(), "there is no twin of {lacking:?}");
}
