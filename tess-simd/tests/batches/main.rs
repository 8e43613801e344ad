//! Whole batches: bit for bit, on several threads, in memory of every size. They are one program,
//! because each program compiles the kernels again for every pair of formats that it names.

mod buffers;
mod exact;
mod examples;
mod groups;
#[path = "../common/patches.rs"]
mod patches;
#[cfg(feature = "rayon")]
mod threads;
