//! The library behind the program `tess`.
