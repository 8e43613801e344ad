//! Steps of an engine before tessellation: factors that open no cracks, and tests that cull
//! patches.
//!
//! The factor of an edge depends only on data that both patches of the edge share, and has the same
//! bits whichever end comes first. All factors are in 1..=64; NaN gives 1. `tess-surface` documents
//! the formulas and their sources.

use tess_surface::glam::{Mat4, Vec3};
use tess_surface::{PnCorner, culling, factors};

/// A point or a direction.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct TessVec3 {
    /// First coordinate.
    pub x: f32,
    /// Second coordinate.
    pub y: f32,
    /// Third coordinate.
    pub z: f32,
}

/// A matrix, by columns: `columns[4 * c + r]` is in row r of column c.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct TessMat4 {
    /// Four columns of four numbers.
    pub columns: [f32; 16],
}

/// A corner of a point-normal triangle or quad.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct TessCorner {
    /// Its position.
    pub position: TessVec3,
    /// Its normal, of length 1.
    pub normal: TessVec3,
}

impl From<TessVec3> for Vec3 {
    fn from(TessVec3 { x, y, z }: TessVec3) -> Self {
        Self::new(x, y, z)
    }
}

impl From<TessCorner> for PnCorner {
    fn from(TessCorner { position, normal }: TessCorner) -> Self {
        Self { position: position.into(), normal: normal.into() }
    }
}

/// A factor for segments of `segment` pixels on the straight edge from `a` to `b`.
/// `pixels_per_unit` is the number of pixels that a length of 1 covers at distance 1: for a picture
/// of height h and field of view f, h / (2 tan(f / 2)).
#[unsafe(no_mangle)]
pub extern "C" fn tess_edge_by_screen_size(
    a: TessVec3,
    b: TessVec3,
    eye: TessVec3,
    pixels_per_unit: f32,
    segment: f32,
) -> f32 {
    factors::edge_by_screen_size([a.into(), b.into()], eye.into(), pixels_per_unit, segment)
}

/// A factor for segments of `segment` pixels on the straight edge from `a` to `b`, under a camera
/// without perspective: a length of 1 covers `pixels_per_unit` pixels at any distance.
#[unsafe(no_mangle)]
pub extern "C" fn tess_edge_by_length(
    a: TessVec3,
    b: TessVec3,
    pixels_per_unit: f32,
    segment: f32,
) -> f32 {
    factors::edge_by_length([a.into(), b.into()], pixels_per_unit, segment)
}

/// The factor of an edge next to two edges of half its length, from the factor that a rule gives
/// the whole edge. The result is a power of two in 2..=64, at least the rule's factor. Give the two
/// short edges half of it: both sides then have the same points under integer and power-of-two
/// partitioning. Neighbours must compute both factors from the whole edge.
#[unsafe(no_mangle)]
pub extern "C" fn tess_edge_beside_halves(factor: f32) -> f32 {
    let [whole, _] = factors::edge_beside_halves(factor);
    whole
}

/// A factor of at most `most`, like HLSL's `maxtessfactor`. A factor that culls (0, negative or
/// NaN) still culls if `most` is positive.
#[unsafe(no_mangle)]
pub extern "C" fn tess_at_most(factor: f32, most: f32) -> f32 {
    factors::at_most(factor, most)
}

/// `scale` divided by the distance from the eye to the middle of the straight edge from `a` to `b`.
#[unsafe(no_mangle)]
pub extern "C" fn tess_edge_by_distance(
    a: TessVec3,
    b: TessVec3,
    eye: TessVec3,
    scale: f32,
) -> f32 {
    factors::edge_by_distance([a.into(), b.into()], eye.into(), scale)
}

/// A factor that keeps equal segments within `tolerance`, in units of the positions, of the
/// point-normal edge between two corners.
#[unsafe(no_mangle)]
pub extern "C" fn tess_edge_by_curvature(a: TessCorner, b: TessCorner, tolerance: f32) -> f32 {
    factors::edge_by_curvature([a.into(), b.into()], tolerance)
}

/// The inside factor of a triangle with these factors on its edges: their mean.
#[unsafe(no_mangle)]
pub extern "C" fn tess_inside_triangle(u0: f32, v0: f32, w0: f32) -> f32 {
    factors::inside_triangle([u0, v0, w0])
}

/// An inside factor of a quad with these factors on the two edges that run the same way: their
/// mean. Inside factor U is the mean of the edges V=0 and V=1, inside factor V the mean of the
/// edges U=0 and U=1.
#[unsafe(no_mangle)]
pub extern "C" fn tess_inside_quad(one: f32, other: f32) -> f32 {
    let [inside, _] = factors::inside_quad([0.0, one, 0.0, other]);
    inside
}

/// Whether a ball is wholly outside one of the six planes of a projection with z from 0 to w, as in
/// Direct3D, Vulkan, Metal and WebGPU: 1 or 0. The ball must contain the whole patch, including its
/// displacement. If the result is 1, give the patch factors of 0.
#[unsafe(no_mangle)]
pub extern "C" fn tess_is_outside(clip_from_world: TessMat4, center: TessVec3, radius: f32) -> u32 {
    let matrix = Mat4::from_cols_array(&clip_from_world.columns);
    u32::from(culling::is_outside(&matrix, center.into(), radius))
}

/// Whether all of a surface faces away from the eye: 1 or 0. The surface is inside a ball, and its
/// normals are within an angle of less than 90 degrees of the unit vector `axis`; `sine` is the
/// sine of that angle.
#[unsafe(no_mangle)]
pub extern "C" fn tess_faces_away(
    center: TessVec3,
    radius: f32,
    axis: TessVec3,
    sine: f32,
    eye: TessVec3,
) -> u32 {
    u32::from(culling::faces_away(center.into(), radius, axis.into(), sine, eye.into()))
}
