//! The Newell teapot: 32 bicubic patches.
//!
//! Martin Newell's numbers of 1975 (M. E. Newell, *The Utilization of Procedure Models in Digital
//! Image Synthesis*, University of Utah), with the height scaled as has been usual since J. Blinn,
//! and with the bottom that F. C. Crow added (*The Origins of the Teapot*, IEEE Computer Graphics
//! and Applications 7(1), 1987). z is up; the spout points to +x.

mod data;

use crate::bezier::BezierPatch;
use alloc::vec::Vec;
use glam::Vec3;

/// The patches: rim 4, body 8, handle 4, spout 4, lid 8, bottom 4. Normals point outwards.
#[must_use]
pub fn patches() -> Vec<BezierPatch> {
    let point = |number: u16| Vec3::from_array(data::POINTS[usize::from(number) - 1]);
    let patch = |numbers: &[u16; 16]| {
        let row = |j: usize| core::array::from_fn(|i| point(numbers[4 * j + i]));
        BezierPatch::polynomial(core::array::from_fn(row))
    };
    data::PATCHES.iter().map(patch).collect()
}
