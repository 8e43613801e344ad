//! The program `tess`.
fn main() {}
