//! The invariants of every output (spec section 12), whichever implementation made it.
//!
//! Each function takes a case and an implementation's output for it, and describes the first
//! violation. None uses the coordinates or the connectivity that the model gives for the case; the
//! numbers of points along each edge come from the model's factor contexts.

mod boundary;
mod mesh;

pub use boundary::crack_free;
pub use mesh::{area, manifold};

use std::fmt;
use tess_core::fixed_point::ONE;
use tess_core::{
    Config, Domain, FactorContext, OutputPrimitive, Parity, Partitioning, Patch, PatchFactors,
    ProcessedFactor, ProcessedPatch, Tessellation,
};
use tess_verify::{Case, Named};

/// A violated invariant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Violation {
    /// Its name in spec section 12.
    pub invariant: &'static str,
    /// The fault.
    pub message: String,
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.invariant, self.message)
    }
}

impl std::error::Error for Violation {}

/// Returns a [`Violation`] unless `holds`.
pub(crate) fn ensure(
    holds: bool,
    invariant: &'static str,
    message: impl FnOnce() -> String,
) -> Result<(), Violation> {
    if holds { Ok(()) } else { Err(Violation { invariant, message: message() }) }
}

/// Checks every invariant of one output except [`winding`], which takes two.
///
/// # Errors
/// The first violation.
pub fn all(case: &Case, output: &Tessellation) -> Result<(), Violation> {
    range(case, output)?;
    counts(case, output)?;
    area(case, output)?;
    manifold(case, output)?;
    crack_free(case, output)?;
    separability(case, output)
}

/// 12.1: coordinates are in 0..=1, and on triangles u + v too.
///
/// # Errors
/// The first point outside.
pub fn range(case: &Case, output: &Tessellation) -> Result<(), Violation> {
    let inside = |&(u, v): &(u32, u32)| {
        let sum = u64::from(u) + u64::from(v);
        u <= ONE && v <= ONE && (case.domain() != Domain::Triangle || sum <= u64::from(ONE))
    };
    let points = output.points.iter().map(|point| (point.u.to_bits(), point.v.to_bits()));
    let outside = points.enumerate().find(|(_, point)| !inside(point));
    outside.map_or(Ok(()), |(i, (u, v))| {
        ensure(false, "range", || format!("point {i} is (0x{u:05x}, 0x{v:05x})"))
    })
}

/// 12.2: one minus the locations of an edge are the same locations in reverse.
///
/// # Errors
/// The first location that is not.
pub fn symmetry(locations: &[u32]) -> Result<(), Violation> {
    let mirrored = locations.iter().rev();
    let wrong = locations.iter().zip(mirrored).position(|(a, b)| a.checked_add(*b) != Some(ONE));
    wrong
        .map_or(Ok(()), |p| ensure(false, "symmetry", || format!("location {p} of {locations:x?}")))
}

/// 12.6: numbers of points and indices; no index out of range; every point is used.
///
/// # Errors
/// The wrong number, the index out of range or the unused point.
pub fn counts(case: &Case, output: &Tessellation) -> Result<(), Violation> {
    let (points, indices) = expected_counts(case);
    let (got_points, got_indices) = (output.points.len(), output.indices.len());
    ensure(got_points == points, "counts", || format!("{got_points} points, not {points}"))?;
    ensure(got_indices == indices, "counts", || format!("{got_indices} indices, not {indices}"))?;
    let mut used = vec![false; points];
    for &index in &output.indices {
        match used.get_mut(index as usize) {
            Some(used) => *used = true,
            None => ensure(false, "counts", || format!("index {index} of {points} points"))?,
        }
    }
    let unused = used.iter().position(|used| !used);
    ensure(unused.is_none(), "counts", || format!("point {} is unused", unused.unwrap_or(0)))
}

/// The formulas of spec section 12.6.
fn expected_counts(case: &Case) -> (usize, usize) {
    let (points, triangles) = match case.patch().processed() {
        ProcessedPatch::Culled => return (0, 0),
        ProcessedPatch::Minimum(factors) => match factors.domain() {
            Domain::Quad => (4, 2),
            _ => (3, 1),
        },
        ProcessedPatch::Regular(PatchFactors::Isoline(factors)) => {
            let lines = factors.density.context.points - 1;
            let n = factors.detail.context.points;
            let points = (lines * n) as usize;
            let is_points = case.config.output == OutputPrimitive::Point;
            return (points, if is_points { points } else { 2 * (lines * (n - 1)) as usize });
        }
        ProcessedPatch::Regular(PatchFactors::Triangle(factors)) => {
            let (n, h) = (factors.inside.context.points, factors.inside.context.points / 2);
            let even = n.is_multiple_of(2);
            with_boundary(
                &factors.outer(),
                if even { 3 * (h - 1).pow(2) } else { 3 * h * (h - 1) + 1 },
            )
        }
        ProcessedPatch::Regular(PatchFactors::Quad(factors)) => {
            let [u, v] = factors.inside().map(|factor| factor.context.points);
            with_boundary(&factors.outer(), (u - 2) * (v - 2))
        }
    };
    let indices = match case.config.output {
        OutputPrimitive::Point => points,
        OutputPrimitive::Line => 2 * (points - 1),
        OutputPrimitive::TriangleCw | OutputPrimitive::TriangleCcw => 3 * triangles,
    };
    (points as usize, indices as usize)
}

/// Points and triangles of a patch with this many interior points.
fn with_boundary(outer: &[ProcessedFactor], interior: u32) -> (u32, u32) {
    let boundary: u32 = outer.iter().map(|factor| factor.context.points - 1).sum();
    let points = boundary + interior;
    (points, 2 * points - 2 - boundary)
}

/// 12.7: `ccw` is `cw` with the last two vertices of each triangle swapped.
///
/// # Errors
/// The first triangle that is not.
pub fn winding(cw: &Tessellation, ccw: &Tessellation) -> Result<(), Violation> {
    ensure(cw.points == ccw.points, "winding", || "the points differ".into())?;
    let lengths = (cw.indices.len(), ccw.indices.len());
    ensure(lengths.0 == lengths.1, "winding", || format!("{lengths:?} indices"))?;
    let swapped = |cw: &[u32], ccw: &[u32]| match (cw, ccw) {
        ([a, b, c], [x, y, z]) => a == x && b == z && c == y,
        _ => false,
    };
    let mut pairs = cw.indices.chunks(3).zip(ccw.indices.chunks(3));
    let wrong = pairs.position(|(cw, ccw)| !swapped(cw, ccw));
    wrong.map_or(Ok(()), |t| ensure(false, "winding", || format!("triangle {t}")))
}

/// 12.8: the indices are those of the integer factors with the same half points and parities.
///
/// # Errors
/// The first index that is not.
pub fn separability(case: &Case, output: &Tessellation) -> Result<(), Violation> {
    let ProcessedPatch::Regular(factors) = *case.patch().processed() else { return Ok(()) };
    let integers = factors.map(|factor| integer(&factor.context));
    let config = Config { partitioning: Partitioning::Integer, ..case.config };
    let expected = Patch::new(config, integers).tessellate().indices;
    let equal = expected == output.indices;
    ensure(equal, "separability", || {
        let at = expected.iter().zip(&output.indices).position(|(a, b)| a != b);
        let name = case.domain().name();
        format!("{name}: indices differ from those of integer factors, first at {at:?}")
    })
}

/// The integer factor with the half points and the parity of a context.
fn integer(context: &FactorContext) -> f32 {
    let factor = match context.parity {
        Parity::Even => 2 * context.half_points,
        Parity::Odd => 2 * context.half_points - 1,
    };
    u16::try_from(factor).map_or(0.0, f32::from)
}

/// Whether an output consists of triangles.
pub(crate) fn has_triangles(case: &Case) -> bool {
    let triangles =
        matches!(case.config.output, OutputPrimitive::TriangleCw | OutputPrimitive::TriangleCcw);
    triangles && case.domain() != Domain::Isoline
}
