//! Mistakes: one element of an answer is wrong, missing or too many, or the answer is lost.

use super::family::Family;
use tess_core::{DomainPoint, Tessellation};

pub(super) fn all() -> Vec<Family> {
    [numbers(), lists(), whole()].into_iter().flatten().collect()
}

/// Flips bits of a point's coordinates.
fn flip(point: Option<&mut DomainPoint>, u: u32, v: u32) {
    if let Some(point) = point {
        *point = DomainPoint::from_bits(point.u.to_bits() ^ u, point.v.to_bits() ^ v);
    }
}

fn swap_ends<T>(list: &mut [T]) {
    if let Some(last) = list.len().checked_sub(1) {
        list.swap(0, last);
    }
}

/// A bit of a coordinate, or a number of an index list.
fn numbers() -> Vec<Family> {
    let bit = Family::new("a bit of a point is wrong")
        .answers("the lowest of the first u", |_, output| flip(output.points.first_mut(), 1, 0))
        .answers("the highest of the first v", |_, output| {
            flip(output.points.first_mut(), 0, 1 << 31);
        })
        .answers("the lowest of the last v", |_, output| flip(output.points.last_mut(), 0, 1))
        .answers("the lowest of the middle u", |_, output| {
            let middle = output.points.len() / 2;
            flip(output.points.get_mut(middle), 1, 0);
        });
    let index = Family::new("the last index is one too high").answers("", |_, output| {
        output.indices.last_mut().into_iter().for_each(|index| *index += 1);
    });
    vec![bit, index]
}

/// Elements that are exchanged, missing, or too many.
fn lists() -> Vec<Family> {
    let unused = "a point that no primitive uses is not drawn";
    vec![
        Family::new("the first and the last point are exchanged")
            .answers("", |_, output| swap_ends(&mut output.points)),
        Family::new("the last point is missing").answers("", |_, output| _ = output.points.pop()),
        Family::new("there is a point that no primitive uses")
            .answers("in the domain", |_, output| output.points.push(DomainPoint::default()))
            .answers("outside the domain", |_, output| {
                output.points.push(DomainPoint::from_bits(u32::MAX, 1));
            })
            .vulkan_allows("", unused)
            .d3d11_allows("", unused),
        Family::new("the first and the last index are exchanged")
            .answers("", |_, output| swap_ends(&mut output.indices)),
        Family::new("the last index is missing").answers("", |_, output| _ = output.indices.pop()),
        Family::new("there is an index too many").answers("", |_, output| output.indices.push(0)),
    ]
}

/// Whole answers.
fn whole() -> Vec<Family> {
    let empty = Family::new("a patch has no output")
        .answers("", |_, output| *output = Tessellation::default());
    let repeated = Family::new("the output is that of the patch before")
        .remembers("", |request| request.before);
    vec![empty, repeated]
}
