//! A tiny seeded generator: same seed, same numbers, on every machine.

/// A source of random choices.
pub(crate) trait Draw {
    /// Arbitrary 32 bits.
    fn bits(&mut self) -> u32;

    /// A number in `0..bound`; a bound of 0 gives 0.
    fn below(&mut self, bound: u32) -> u32;
}

impl Draw for SplitMix64 {
    fn bits(&mut self) -> u32 {
        self.next_u32()
    }

    fn below(&mut self, bound: u32) -> u32 {
        Self::below(self, bound)
    }
}

/// `SplitMix64`: a counter that grows by a constant, finished by two rounds of multiply and
/// xor-shift (Steele, Lea and Flood, "Fast splittable pseudorandom number generators", 2014).
///
/// ```
/// use tess_verify::generate::SplitMix64;
///
/// let mut random = SplitMix64::new(1234567);
/// assert_eq!(random.next_u64(), 6457827717110365317);
/// assert_eq!(random.next_u64(), 3203168211198807973);
/// ```
#[derive(Clone, Debug)]
pub struct SplitMix64 {
    state: u64,
}

/// Added to the state for each number.
const STEP: u64 = 0x9E37_79B9_7F4A_7C15;

impl SplitMix64 {
    /// The generator of a seed. All seeds are equally good.
    #[must_use]
    pub const fn new(seed: u64) -> Self {
        Self { state: seed }
    }

    /// The generator of a seed after `numbers` calls of [`Self::next_u64`], in constant time.
    pub(crate) const fn after(seed: u64, numbers: u64) -> Self {
        Self { state: seed.wrapping_add(STEP.wrapping_mul(numbers)) }
    }

    /// The next 64 bits.
    pub const fn next_u64(&mut self) -> u64 {
        self.state = self.state.wrapping_add(STEP);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// The next 32 bits: the upper half of [`Self::next_u64`].
    pub const fn next_u32(&mut self) -> u32 {
        (self.next_u64() >> 32) as u32
    }

    /// A number in `0..bound`, scaled from 32 bits, so a few numbers are very slightly likelier
    /// than others. A bound of 0 gives 0.
    pub const fn below(&mut self, bound: u32) -> u32 {
        ((self.next_u32() as u64 * bound as u64) >> 32) as u32
    }
}
