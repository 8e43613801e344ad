//! Compares a device under test with the model: reads what was captured from it, in a format of its
//! own, and turns that into cases and outputs.
//!
//! The capture has a line `draw DOMAIN PARTITIONING OUTPUT SPLIT FACTOR...` for each patch, then what
//! the device gave for it: `at U V` for each domain point, as the floats that a domain shader saw, and
//! `prim I...` for each primitive.
#![expect(clippy::print_stdout, reason = "an example prints")]

use std::error::Error;
use tess_core::fixed_point::ONE;
use tess_core::{DomainPoint, Tessellation};
use tess_verify::case::Case;
use tess_verify::checker::{Report, check_device};
use tess_verify::strength::{Order, Strength};

fn main() -> Result<(), Box<dyn Error>> {
    let default = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/device.capture").to_owned();
    let path = std::env::args().nth(1).unwrap_or(default);
    let report = compare(&std::fs::read_to_string(&path)?)?;
    for difference in &report.differences {
        println!("{difference}");
    }
    println!("{report}");
    if report.mismatches == 0 { Ok(()) } else { Err("the device differs".into()) }
}

/// Compares a capture with the model. This device numbers points and primitives in its own order.
pub(crate) fn compare(capture: &str) -> Result<Report, Box<dyn Error>> {
    let strength = Strength { order: Order::Any, ..Strength::default() };
    let patches = patches(capture)?;
    if patches.is_empty() {
        return Err("the capture has no patches".into());
    }
    Ok(check_device(patches, strength))
}

/// The patches of a capture: what was drawn, and what the device made of it.
fn patches(capture: &str) -> Result<Vec<(Case, Tessellation)>, Box<dyn Error>> {
    let mut patches: Vec<(Case, Tessellation)> = Vec::new();
    for (number, line) in (1..).zip(capture.lines()) {
        read_line(&mut patches, line).map_err(|error| format!("line {number}: {error}"))?;
    }
    Ok(patches)
}

fn read_line(patches: &mut Vec<(Case, Tessellation)>, line: &str) -> Result<(), Box<dyn Error>> {
    let (word, rest) = line.split_once(' ').unwrap_or((line, ""));
    match (word, patches.last_mut()) {
        ("" | "#", _) => {}
        ("draw", _) => {
            let case: Case = format!("case {rest}").parse()?;
            patches.push((case, Tessellation::default()));
        }
        ("at", Some((_, output))) => output.points.push(point(rest)?),
        ("prim", Some((_, output))) => {
            for index in rest.split(' ') {
                output.indices.push(index.parse()?);
            }
        }
        _ => return Err("expected `draw`, then `at` and `prim`".into()),
    }
    Ok(())
}

/// A domain point from its coordinates as floats, which represent 16.16 numbers exactly.
fn point(text: &str) -> Result<DomainPoint, Box<dyn Error>> {
    let (u, v) = text.split_once(' ').ok_or("expected `at U V`")?;
    Ok(DomainPoint::from_bits(coordinate(u.parse()?)?, coordinate(v.parse()?)?))
}

#[expect(
    clippy::float_arithmetic,
    clippy::float_cmp,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "checked to be exact: nothing is rounded, so no difference is lost"
)]
fn coordinate(value: f32) -> Result<u32, Box<dyn Error>> {
    let scaled = f64::from(value) * f64::from(ONE);
    if scaled != scaled.trunc() || !(0.0..=f64::from(ONE)).contains(&scaled) {
        return Err(format!("{value} is no multiple of 2^-16 in 0..1").into());
    }
    Ok(scaled as u32)
}
