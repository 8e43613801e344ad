//! The stages of the front end, formula by formula, over vectors of `wide` instead of arrays; functions have
//! the names that they have in `tess-simd`.

use crate::data::lanes::{Column, LANES, Lanes, MAX_FACTORS};
use crate::stages::factors::Processed;
use crate::stages::place::Spacing;
use crate::stages::reciprocal::{MANTISSA, TWO_POW_23};
use bytemuck::must_cast;
use tess_core::fixed_point::{HALF, ONE};
use tess_core::{Domain, Partitioning, SplitOrder};

pub(crate) use vectors::VECTOR;
use vectors::{F, I, U, WIDTH};

/// Vectors of one register of what the build is for.
#[cfg(target_feature = "avx512f")]
mod vectors {
    pub(super) use wide::{f32x16 as F, i32x16 as I, u32x16 as U};
    pub(crate) const VECTOR: &str = "u32x16";
    pub(super) const WIDTH: usize = 16;
}
#[cfg(all(target_feature = "avx2", not(target_feature = "avx512f")))]
mod vectors {
    pub(super) use wide::{f32x8 as F, i32x8 as I, u32x8 as U};
    pub(crate) const VECTOR: &str = "u32x8";
    pub(super) const WIDTH: usize = 8;
}
#[cfg(not(target_feature = "avx2"))]
mod vectors {
    pub(super) use wide::{f32x4 as F, i32x4 as I, u32x4 as U};
    pub(crate) const VECTOR: &str = "u32x4";
    pub(super) const WIDTH: usize = 4;
}

/// What the build is for.
pub(crate) const BUILD: &str = if cfg!(target_feature = "avx512f") {
    "x86-64, AVX-512"
} else if cfg!(target_feature = "avx2") {
    "x86-64, AVX2"
} else if cfg!(target_feature = "sse2") {
    "x86-64, SSE2"
} else if cfg!(target_feature = "neon") {
    "aarch64, NEON"
} else if cfg!(target_feature = "simd128") {
    "wasm32, SIMD128"
} else {
    "no vectors"
};

/// Whether converting to integers is fewer instructions than adding 2^23. WebAssembly's conversions have
/// results for all numbers, which takes several instructions of x86.
const CONVERTS: bool = !cfg!(target_arch = "wasm32");

/// The elements of a column from `i` on.
#[inline(always)]
fn load<T: Copy, V: From<[T; WIDTH]>>(elements: &[T], i: usize) -> V {
    V::from(*elements[i..].first_chunk().expect("whole vectors"))
}

#[inline(always)]
fn store(elements: &mut [u32], i: usize, vector: U) {
    elements[i..i + WIDTH].copy_from_slice(vector.as_array());
}

/// 1 where a mask is set.
#[inline(always)]
fn bit(mask: I) -> U {
    must_cast::<I, U>(mask) & U::ONE
}

/// Factor processing of quads: [`crate::stages::factors::process`]. Written in place, as a result is copied.
#[inline(always)]
pub(crate) fn process(partitioning: Partitioning, raw: &Column<f32>, processed: &mut Processed) {
    for first in (0..LANES).step_by(WIDTH) {
        let mut vectors = [I::ZERO; MAX_FACTORS];
        for (factor, vector) in vectors.iter_mut().enumerate() {
            *vector = must_cast(load::<_, F>(raw, factor * LANES + first));
        }
        process_vectors(partitioning, vectors, first, processed);
    }
}

/// Processes the factors of the lanes from `first` on.
#[inline(always)]
fn process_vectors(
    partitioning: Partitioning,
    raw: [I; MAX_FACTORS],
    first: usize,
    processed: &mut Processed,
) {
    const OUTER: usize = Domain::Quad.outer_factors();
    let (low, high) = partitioning.range();
    let inside_low = inside_low(partitioning, &raw);
    let (mut alive, mut minimum) = (U::ONE, U::ONE);
    for (factor, raw) in raw.into_iter().enumerate() {
        let is_outer = factor < OUTER;
        if is_outer {
            alive &= bit(is_greater(raw, 0.0));
        }
        let low = if is_outer { I::splat(bits(low)) } else { inside_low };
        let clamped = must_cast(clamp(raw, low, high));
        let (fixed, odd) = match partitioning {
            Partitioning::Integer | Partitioning::Pow2 => {
                let integer = ceil(clamped);
                let fixed: U = integer << 16;
                let odd = integer & U::ONE;
                let one = fixed.simd_eq(U::splat(ONE));
                (fixed, if is_outer { odd } else { odd & !one })
            }
            Partitioning::FractionalOdd => (to_fixed(clamped), U::ONE),
            Partitioning::FractionalEven => (to_fixed(clamped), U::ZERO),
        };
        minimum &= fixed.simd_eq(U::splat(ONE)) & U::ONE;
        store(&mut processed.fixed, factor * LANES + first, fixed);
        store(&mut processed.odd, factor * LANES + first, odd);
    }
    store(&mut processed.alive, first, alive);
    store(&mut processed.minimum, first, minimum);
}

#[inline(always)]
const fn bits(x: f32) -> i32 {
    x.to_bits().cast_signed()
}

const INFINITY: i32 = bits(f32::INFINITY);

#[inline(always)]
fn is_greater(x: I, low: f32) -> I {
    x.simd_gt(I::splat(bits(low))) & !x.simd_gt(I::splat(INFINITY))
}

#[inline(always)]
fn clamp(x: I, low: I, high: f32) -> I {
    let bits_or_zero = x & !x.simd_gt(I::splat(INFINITY));
    bits_or_zero.max(low).min(I::splat(bits(high)))
}

#[inline(always)]
fn inside_low(partitioning: Partitioning, raw: &[I; MAX_FACTORS]) -> I {
    const ONE_PLUS_2_POW_MINUS_17: f32 = f32::from_bits(0x3F80_0040);
    const ONE_PLUS_2_POW_MINUS_16: f32 = f32::from_bits(0x3F80_0080);
    let low = I::splat(bits(partitioning.range().0));
    if partitioning != Partitioning::FractionalOdd {
        return low;
    }
    let mut above = I::ZERO;
    for &raw in raw {
        above |= is_greater(raw, ONE_PLUS_2_POW_MINUS_17);
    }
    above.select(I::splat(bits(ONE_PLUS_2_POW_MINUS_16)), low)
}

#[inline(always)]
fn ceil(x: F) -> U {
    if CONVERTS {
        let integer = x.fast_trunc_int();
        let below: I = must_cast(integer.round_float().simd_lt(x));
        must_cast(integer - below)
    } else {
        let sum = x + F::splat(TWO_POW_23);
        let below: U = must_cast((sum - F::splat(TWO_POW_23)).simd_lt(x));
        (must_cast::<F, U>(sum) & U::splat(MANTISSA)) - below
    }
}

#[inline(always)]
fn to_fixed(x: F) -> U {
    round(x * F::splat(65536.0))
}

/// The nearest integer, of a number below 2^23.
#[inline(always)]
fn round(x: F) -> U {
    if CONVERTS {
        must_cast(x.fast_round_int())
    } else {
        must_cast::<F, U>(x + F::splat(TWO_POW_23)) & U::splat(MANTISSA)
    }
}

/// The contexts of as many factors: [`crate::stages::factor_context::Context`].
#[derive(Clone, Copy, Debug)]
struct Context {
    inv_floor: U,
    inv_ceil: U,
    fraction: U,
    split: U,
    points: U,
}

impl Context {
    #[inline(always)]
    fn new(fixed: U, odd: U, order: SplitOrder) -> Self {
        let half: U = ((fixed + U::ONE) >> 1) + (odd << 15);
        let half: U = must_cast(signed(half).max(signed(U::splat(ONE))));
        let floor: U = half >> 16;
        let ceil: U = (half + U::splat(0xFFFF)) >> 16;
        let split = match order {
            SplitOrder::Ruler => {
                let points = floor - odd;
                let is_first = points.simd_eq(U::ZERO);
                (drop_most_significant_bit(points) << 1) + U::ONE + is_first
            }
            SplitOrder::Center => ceil - U::ONE - odd,
        };
        Self {
            inv_floor: reciprocal((floor << 1) - odd),
            inv_ceil: reciprocal((ceil << 1) - odd),
            fraction: half & U::splat(0xFFFF),
            split: floor.simd_eq(ceil).select(ceil + U::ONE, split),
            points: (ceil << 1) + U::ONE - odd,
        }
    }
}

#[inline(always)]
fn drop_most_significant_bit(x: U) -> U {
    let x1 = x | (x >> 1);
    let x2 = x1 | (x1 >> 2);
    let below = (x2 | (x2 >> 4)) >> 1;
    x & below
}

#[inline(always)]
fn reciprocal(n: U) -> U {
    round(F::splat(65536.0) / signed(n).round_float())
}

/// The spacings of a block of fractional factors: [`crate::stages::place::Spacings`] and the point counts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spacings {
    pub(crate) points: Column,
    split: Column,
    step: Column,
    lag: Column,
}

impl Spacings {
    pub(crate) const NONE: Self = {
        const NONE: Column = [0; LANES * MAX_FACTORS];
        Self { points: NONE, split: NONE, step: NONE, lag: NONE }
    };

    #[inline(always)]
    pub(crate) fn fill(&mut self, fixed: &Column, odd: &Column, order: SplitOrder) {
        for i in (0..fixed.len()).step_by(WIDTH) {
            let context = Context::new(load(fixed, i), load(odd, i), order);
            let Context { inv_floor, inv_ceil, fraction, split, points, .. } = context;
            let lag = inv_floor * (U::splat(ONE) - fraction);
            store(&mut self.points, i, points);
            store(&mut self.split, i, split);
            store(&mut self.step, i, lag + inv_ceil * fraction);
            store(&mut self.lag, i, lag);
        }
    }

    pub(crate) const fn get(&self, i: usize) -> Spacing {
        let Self { points, split, step, lag } = self;
        Spacing { points: points[i], split: split[i], step: step[i], lag: lag[i] }
    }
}

/// The locations of an edge: [`crate::stages::place::Locations`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Locations(pub(crate) [u32; 112]);

impl Locations {
    pub(crate) const EMPTY: Self = Self([0; _]);

    #[inline(always)]
    pub(crate) fn fill(&mut self, spacing: &Spacing) {
        const FIRST: Lanes = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];
        let mut start = 0;
        for chunk in self.0.as_chunks_mut::<LANES>().0 {
            for i in (0..LANES).step_by(WIDTH) {
                store(chunk, i, place(spacing, load::<_, U>(&FIRST, i) + U::splat(start)));
            }
            start += 16;
            if start >= spacing.points {
                break;
            }
        }
    }
}

#[inline(always)]
fn place(spacing: &Spacing, p: U) -> U {
    let Spacing { points, split, step, lag } = *spacing;
    let (p, mirrored) = (signed(p), signed(U::splat(points) - U::ONE - p));
    let is_mirrored = p.simd_gt(mirrored);
    let position = p.min(mirrored);
    let is_behind = must_cast::<I, U>(position.simd_gt(signed(U::splat(split))));
    let sum = must_cast::<I, U>(position) * U::splat(step) - (is_behind & U::splat(lag));
    let x = (sum + U::splat(HALF)) >> 16;
    let x = must_cast::<I, U>(is_mirrored).select(U::splat(ONE) - x, x);
    must_cast::<I, U>(p.simd_eq(mirrored)).select(U::splat(HALF), x)
}

#[inline(always)]
fn signed(x: U) -> I {
    must_cast(x)
}
