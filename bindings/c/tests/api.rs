//! Every function equals the model, and refuses what it must without touching memory.
#![expect(
    clippy::undocumented_unsafe_blocks,
    clippy::multiple_unsafe_ops_per_block,
    reason = "each test calls with memory of its own, which is as large as it says"
)]

mod api {
    mod batch;
    mod dpi;
    mod fuzz;
    mod hostile;
    mod rules;
    mod samples;
    mod single;
    mod surface;
}
