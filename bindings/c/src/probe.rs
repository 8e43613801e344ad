//! Probes: one number of one stage, for comparing hardware signal by signal.

use crate::boundary;
use crate::context;
use crate::status::{TESS_OUT_OF_RANGE, TessStatus, answer};
use crate::types::{self, TessConfig, TessContext, TessPoint, parity};
use tess_core::place::place;
use tess_core::{FactorContext, FixedFactor, PointOrigin, PrimitiveOrigin, SplitOrder};

/// One primitive: `size` indices into the patch's points.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TessPrimitive {
    /// 1 (point), 2 (line) or 3 (triangle).
    pub size: u32,
    /// The indices; the elements past `size` are 0.
    pub indices: [u32; 3],
}

/// Origin of a point: corner `p` of a minimum patch.
pub const TESS_POINT_ORIGIN_CORNER: u32 = 0;
/// Origin of a point: point `p` of isoline `line`.
pub const TESS_POINT_ORIGIN_LINE: u32 = 1;
/// Origin of a point: point `p` of outer edge `edge`.
pub const TESS_POINT_ORIGIN_OUTER_EDGE: u32 = 2;
/// Origin of a point: point `p` of edge `edge` of interior ring `ring`.
pub const TESS_POINT_ORIGIN_RING: u32 = 3;
/// Origin of a point: point `p` of the centre of an even interior, a single point or a row.
pub const TESS_POINT_ORIGIN_CENTRE: u32 = 4;

/// The origin of a point (specification, section 6). Fields that its kind does not use are 0.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TessPointOrigin {
    /// `TESS_POINT_ORIGIN_...`
    pub kind: u32,
    /// Number of the isoline, from v = 0.
    pub line: u32,
    /// Number of the interior ring, from 1.
    pub ring: u32,
    /// Number of the edge: U=0, V=0, then W=0 or U=1, V=1.
    pub edge: u32,
    /// Number of the point, counted in the direction of the walk.
    pub p: u32,
}

/// Origin of a primitive: number `step` of point output, or of a line through all points in order.
pub const TESS_PRIMITIVE_ORIGIN_SEQUENCE: u32 = 0;
/// Origin of a primitive: segment `step` of isoline `line`.
pub const TESS_PRIMITIVE_ORIGIN_LINE: u32 = 1;
/// Origin of a primitive: triangle `step` of a minimum patch.
pub const TESS_PRIMITIVE_ORIGIN_MINIMUM: u32 = 2;
/// Origin of a primitive: triangle `step` of the transition stitch of edge `edge`.
pub const TESS_PRIMITIVE_ORIGIN_TRANSITION: u32 = 3;
/// Origin of a primitive: triangle `step` of the stitch of edge `edge` to ring `ring`.
pub const TESS_PRIMITIVE_ORIGIN_RING: u32 = 4;
/// Origin of a primitive: triangle `step` inside the innermost ring.
pub const TESS_PRIMITIVE_ORIGIN_CENTRE: u32 = 5;

/// The origin of a primitive (specification, sections 7 and 8). Fields that its kind does not use
/// are 0.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TessPrimitiveOrigin {
    /// `TESS_PRIMITIVE_ORIGIN_...`
    pub kind: u32,
    /// Number of the isoline, from v = 0.
    pub line: u32,
    /// Number of the inner ring of the stitch, from 2.
    pub ring: u32,
    /// Number of the edge: U=0, V=0, then W=0 or U=1, V=1.
    pub edge: u32,
    /// Number of the primitive along its line, stitch, centre or sequence.
    pub step: u32,
}

/// Converts the bits of a binary32 number to an unsigned 15.16 number (specification, section 2).
///
/// Rounds to nearest, ties to even. NaN and negative numbers give 0; 2^15 and larger numbers give
/// 0x7FFFFFFF.
#[unsafe(no_mangle)]
pub extern "C" fn tess_fixed_factor(binary32_bits: u32) -> u32 {
    FixedFactor::from_f32(f32::from_bits(binary32_bits)).to_bits()
}

/// Computes the context of a 15.16 factor (specification, sections 4 and 10).
///
/// `parity_number` is `TESS_PARITY_...`, `split` is `TESS_SPLIT_...`. A factor outside 1..63 (odd)
/// or 1..64 (even) is clamped to that range.
///
/// # Safety
/// - `context`, if not null and aligned, must be valid for writing one structure.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_context(
    fixed_factor: u32,
    parity_number: u32,
    split: u32,
    context: *mut TessContext,
) -> TessStatus {
    answer(|| {
        let split = types::listed(&SplitOrder::ALL, split)?;
        let factor = FixedFactor::from_bits(fixed_factor);
        let value = FactorContext::new(factor, parity(parity_number)?, split);
        // SAFETY: `context` is writable, as the caller promises.
        unsafe { boundary::write(context, value.into()) }
    })
}

/// Computes the location of point `p` along an edge with this context (specification, section 5).
///
/// `location` receives an unsigned 16.16 number, 0..0x10000. Returns `TESS_OUT_OF_RANGE` unless `p`
/// is below the context's `points`, and `TESS_NOT_A_CONTEXT` if no factor has this context.
///
/// # Safety
/// Pointers that are not null and aligned must be valid:
/// - `context` for reading one structure,
/// - `location` for writing one number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_place(
    context: *const TessContext,
    p: u32,
    location: *mut u32,
) -> TessStatus {
    answer(|| {
        // SAFETY: `context` is readable, as the caller promises.
        let context = context::checked(unsafe { boundary::read(context) }?)?;
        if p >= context.points {
            return Err(TESS_OUT_OF_RANGE);
        }
        // SAFETY: `location` is writable, as the caller promises.
        unsafe { boundary::write(location, place(&context, p).to_bits()) }
    })
}

/// Gets point `i` of a patch, in constant time; `TESS_OUT_OF_RANGE` if there is no such point.
///
/// # Safety
/// Pointers that are not null and aligned must be valid:
/// - `config` for reading one configuration,
/// - `factors` for reading `factor_count` floats,
/// - `point` for writing one structure.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_point(
    config: *const TessConfig,
    factors: *const f32,
    factor_count: usize,
    i: u32,
    point: *mut TessPoint,
) -> TessStatus {
    // SAFETY: the requirements are those of this function.
    unsafe { types::of_patch((config, factors, factor_count), point, |patch| patch.point(i)) }
}

/// Gets primitive `t` of a patch, in constant time; `TESS_OUT_OF_RANGE` if there is no such
/// primitive.
///
/// # Safety
/// Pointers that are not null and aligned must be valid:
/// - `config` for reading one configuration,
/// - `factors` for reading `factor_count` floats,
/// - `primitive` for writing one structure.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_primitive(
    config: *const TessConfig,
    factors: *const f32,
    factor_count: usize,
    t: u32,
    primitive: *mut TessPrimitive,
) -> TessStatus {
    // SAFETY: the requirements are those of this function.
    unsafe {
        types::of_patch((config, factors, factor_count), primitive, |patch| patch.primitive(t))
    }
}

/// Gets the origin of point `i` of a patch; `TESS_OUT_OF_RANGE` if there is no such point.
///
/// # Safety
/// Pointers that are not null and aligned must be valid:
/// - `config` for reading one configuration,
/// - `factors` for reading `factor_count` floats,
/// - `origin` for writing one structure.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_locate_point(
    config: *const TessConfig,
    factors: *const f32,
    factor_count: usize,
    i: u32,
    origin: *mut TessPointOrigin,
) -> TessStatus {
    // SAFETY: the requirements are those of this function.
    unsafe {
        types::of_patch((config, factors, factor_count), origin, |patch| patch.locate_point(i))
    }
}

/// Gets the origin of primitive `t` of a patch; `TESS_OUT_OF_RANGE` if there is no such primitive.
///
/// # Safety
/// Pointers that are not null and aligned must be valid:
/// - `config` for reading one configuration,
/// - `factors` for reading `factor_count` floats,
/// - `origin` for writing one structure.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_locate_primitive(
    config: *const TessConfig,
    factors: *const f32,
    factor_count: usize,
    t: u32,
    origin: *mut TessPrimitiveOrigin,
) -> TessStatus {
    // SAFETY: the requirements are those of this function.
    unsafe {
        types::of_patch((config, factors, factor_count), origin, |patch| patch.locate_primitive(t))
    }
}

impl From<tess_core::Primitive> for TessPrimitive {
    fn from(primitive: tess_core::Primitive) -> Self {
        let mut indices = [0; 3];
        for (slot, &index) in indices.iter_mut().zip(primitive.indices()) {
            *slot = index;
        }
        Self { size: primitive.size(), indices }
    }
}

impl From<PointOrigin> for TessPointOrigin {
    fn from(origin: PointOrigin) -> Self {
        let (kind, line, ring, edge, p) = match origin {
            PointOrigin::Corner { corner } => (TESS_POINT_ORIGIN_CORNER, 0, 0, 0, corner),
            PointOrigin::Line { line, p } => (TESS_POINT_ORIGIN_LINE, line, 0, 0, p),
            PointOrigin::OuterEdge { edge, p } => (TESS_POINT_ORIGIN_OUTER_EDGE, 0, 0, edge, p),
            PointOrigin::Ring { ring, edge, p } => (TESS_POINT_ORIGIN_RING, 0, ring, edge, p),
            PointOrigin::Centre { p } => (TESS_POINT_ORIGIN_CENTRE, 0, 0, 0, p),
        };
        Self { kind, line, ring, edge, p }
    }
}

impl From<PrimitiveOrigin> for TessPrimitiveOrigin {
    fn from(origin: PrimitiveOrigin) -> Self {
        use PrimitiveOrigin as Of;
        let (kind, line, ring, edge, step) = match origin {
            Of::Sequence { step } => (TESS_PRIMITIVE_ORIGIN_SEQUENCE, 0, 0, 0, step),
            Of::Line { line, segment } => (TESS_PRIMITIVE_ORIGIN_LINE, line, 0, 0, segment),
            Of::Minimum { step } => (TESS_PRIMITIVE_ORIGIN_MINIMUM, 0, 0, 0, step),
            Of::Transition { edge, step } => (TESS_PRIMITIVE_ORIGIN_TRANSITION, 0, 0, edge, step),
            Of::Ring { ring, edge, step } => (TESS_PRIMITIVE_ORIGIN_RING, 0, ring, edge, step),
            Of::Centre { step } => (TESS_PRIMITIVE_ORIGIN_CENTRE, 0, 0, 0, step),
        };
        Self { kind, line, ring, edge, step }
    }
}
