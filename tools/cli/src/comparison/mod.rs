//! The parts that commands which judge a device share: the freedoms that they grant, and the
//! verdict by rules.

pub(crate) mod rules;

use crate::args::Choices;
use tess_verify::check::{Conversion, Denormals};

pub(crate) const CONVERSIONS: Choices<Conversion> = &[
    ("exact", Conversion::Exact, "To the nearest, ties to even"),
    ("0.6ulp", Conversion::Within06Ulp, "Either neighbour where the fraction is from 0.4 to 0.6"),
];

pub(crate) const DENORMALS: Choices<Denormals> = &[
    ("keep", Denormals::Keep, "Greater than zero"),
    ("flush", Denormals::Flush, "May be zero, which culls the patch"),
];
