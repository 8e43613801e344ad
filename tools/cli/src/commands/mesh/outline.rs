//! Points of a surface that must be in the camera's picture.

use glam::Vec3;
use rayon::prelude::*;
use tess_core::Domain;
use tess_surface::Model;
use tess_surface::patch::Sample;

/// The approximate number of points that is enough.
const POINTS: usize = 1 << 18;

/// Points of every patch: a grid, which is finer if there are fewer patches and always includes the
/// corners. A surface that is displaced by up to `reach` has points on both sides.
pub(super) fn outline(model: &Model, reach: f32) -> Vec<Vec3> {
    let divisions = (POINTS / model.len().max(1)).isqrt().clamp(1, 8);
    let points = (0..model.len()).into_par_iter().flat_map_iter(|number| {
        let patch = model.patch(number);
        grid(patch.domain(), divisions).map(move |point| patch.sample(point))
    });
    let sides = |Sample { position, normal, .. }: Sample| {
        let side = if reach > 0.0 { normal * reach } else { Vec3::ZERO };
        [position + side, position - side]
    };
    points.flat_map_iter(sides).collect()
}

/// Domain points at distances of `1 / divisions`.
fn grid(domain: Domain, divisions: usize) -> impl Iterator<Item = [f32; 2]> {
    let points = (0..=divisions).flat_map(move |i| (0..=divisions).map(move |j| (i, j)));
    points
        .filter(move |(i, j)| domain != Domain::Triangle || i + j <= divisions)
        .map(move |(i, j)| [i, j].map(|k| k as f32 / divisions as f32))
}
