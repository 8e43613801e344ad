//! Writers of points and indices.

use super::TapInput;
use crate::data::format::{IndexFormat, OutputPoint};
use crate::data::point_writer::PointWriter;
use crate::data::writer::Writer;
use tess_core::fixed_point::ONE;

/// Elements that runs are made from, including those that blocks read past a run.
const SOURCE: usize = 1024;

/// Writes runs of points by every method: see [`crate::Input::numbers`].
#[inline(always)]
pub(crate) fn of_points<W: PointWriter>(work: &TapInput, mut out: W) {
    let source = source();
    let point = |x: u32| W::Point::from_bits(x, ONE - x);
    for &number in &work.numbers {
        let [method, first, length @ ..] = number.to_be_bytes();
        let length = usize::from(u16::from_be_bytes(length));
        let source = &source[usize::from(first)..];
        match method {
            0 => out.map::<_, 8>(length, source, point),
            1 => out.map::<_, 24>(length, source, point),
            #[cfg(target_arch = "x86_64")]
            2 => out.blocks::<_, 8, 32>(length, source, |block| block.map(point)),
            _ => out.put([point(source[0])]),
        }
    }
}

/// Writes runs of indices by every method: see [`crate::Input::numbers`].
#[inline(always)]
pub(crate) fn of_indices<I: IndexFormat>(work: &TapInput, indices: &mut [I]) {
    let (source, mut out) = (source(), Writer::new(indices));
    let index = |x: u32| I::wrapping_from(work.base.wrapping_add(x));
    for &number in &work.numbers {
        let [method, first, length @ ..] = number.to_be_bytes();
        let length = usize::from(u16::from_be_bytes(length));
        let source = &source[usize::from(first)..];
        match method {
            0 => out.map::<_, 32>(length, source, index),
            1 => out.map::<_, 64>(length, source, index),
            2 => out.count::<16>(length, |n| index(source[0].wrapping_add(n))),
            _ => out.put([source[0], source[1], source[2]].map(index)),
        }
    }
}

/// The numbers 0, 64, 128 and so on.
#[inline(always)]
fn source() -> [u32; SOURCE] {
    let mut source = [0; SOURCE];
    let mut next = 0;
    for number in &mut source {
        *number = next;
        next += 64;
    }
    source
}
