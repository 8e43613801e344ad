//! Compares a device under test with the model: reads a capture in a format of its own, then shows
//! how closely each patch agrees, and what explains those that do not.
//!
//! The capture has a line `draw DOMAIN PARTITIONING OUTPUT SPLIT FACTOR...` for each patch. The
//! device's output follows: `at U V` for each domain point, as the floats that a domain shader
//! received, and `prim I...` for each primitive.
#![expect(clippy::print_stdout, reason = "an example prints")]

use std::error::Error;
use std::fmt;
use tess_core::{DomainPoint, Tessellation};
use tess_verify::Case;
use tess_verify::check::{ListOrder, Report, Strength, check_device};
use tess_verify::vectors::fixed;

fn main() -> Result<(), Box<dyn Error>> {
    let default = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/device.capture").to_owned();
    let path = std::env::args().nth(1).unwrap_or(default);
    let verdicts = judge(&std::fs::read_to_string(&path)?)?;
    print!("{verdicts}");
    if verdicts.report.mismatches == 0 { Ok(()) } else { Err("the device differs".into()) }
}

/// The findings of a capture.
#[derive(Debug)]
pub(crate) struct Verdicts {
    /// The number of patches whose primitives are the model's in the model's order, and in any
    /// order.
    pub(crate) in_order: usize,
    pub(crate) in_any_order: usize,
    /// The comparison in any order, because this device has its own numbering and order.
    pub(crate) report: Report,
}

impl fmt::Display for Verdicts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { in_order, in_any_order, report } = self;
        writeln!(f, "{report}; in the model's order: {in_order}, in another: {in_any_order}")?;
        report.differences.iter().try_for_each(|difference| writeln!(f, "{difference}"))?;
        for explanation in &report.explanations {
            let allowed = if explanation.is_allowed() { "allowed" } else { "not allowed" };
            writeln!(f, "explained, {allowed}: {}", explanation.words())?;
        }
        Ok(())
    }
}

/// Compares a capture with the model.
pub(crate) fn judge(capture: &str) -> Result<Verdicts, Box<dyn Error>> {
    let patches = patches(capture)?;
    if patches.is_empty() {
        return Err("the capture has no patches".into());
    }
    let strength = |order| Strength { order, ..Strength::default() };
    let (sequence, any) = (strength(ListOrder::Sequence), strength(ListOrder::Any));
    let in_order = patches.iter().filter(|(case, output)| sequence.accepts(case, output)).count();
    let right = patches.iter().filter(|(case, output)| any.accepts(case, output)).count();
    let in_any_order = right - in_order;
    Ok(Verdicts { in_order, in_any_order, report: check_device(patches, any) })
}

/// The patches of a capture: what was drawn, and the device's output.
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

/// A domain point from its coordinates as floats, each of which is exactly a 16.16 number.
fn point(text: &str) -> Result<DomainPoint, Box<dyn Error>> {
    let (u, v) = text.split_once(' ').ok_or("expected `at U V`")?;
    Ok(DomainPoint::from_bits(coordinate(u.parse()?)?, coordinate(v.parse()?)?))
}

fn coordinate(value: f32) -> Result<u32, Box<dyn Error>> {
    let number = fixed(value.to_bits());
    number.ok_or_else(|| format!("{value} is not a multiple of 2^-16 in 0..1").into())
}
