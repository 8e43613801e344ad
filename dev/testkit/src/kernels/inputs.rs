//! Inputs of kernels: random in even rounds, extreme in odd ones.

use tess_core::{
    Config, Domain, OutputPrimitive, Parity, Partitioning, Patch, PatchFactors, ProcessedPatch,
};
use tess_verify::generate::SplitMix64;

/// The source of inputs.
pub(crate) struct Draw {
    random: SplitMix64,
    extreme: bool,
    pub(crate) config: Config,
    pub(crate) parity: Parity,
}

impl Draw {
    pub(crate) const fn new(seed: u64, round: u32) -> Self {
        Self {
            random: SplitMix64::new(seed.wrapping_add(round as u64)),
            extreme: round % 2 == 1,
            config: Config::new(Partitioning::Integer, OutputPrimitive::Point),
            parity: Parity::Even,
        }
    }

    pub(crate) const fn below(&mut self, bound: u32) -> u32 {
        self.random.below(bound)
    }

    fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[self.random.below(u32::try_from(from.len()).unwrap_or(1)) as usize]
    }

    /// A raw factor up to about `most`: usually in range, or at a boundary.
    fn factor(&mut self, most: u32) -> f32 {
        let whole = 1 + self.below(most);
        let [integer, largest] = [whole, most].map(|n| from_fixed(n << 16));
        let near = |this: &mut Self| f32::from_bits(integer.to_bits() - 80 + this.below(160));
        if !self.extreme {
            return match self.below(4) {
                0 => integer,
                1 => near(self),
                _ => from_fixed((whole << 16) - self.below(0x1_0000)).max(1.0),
            };
        }
        match self.below(16) {
            0..=3 => 1.0,
            4..=6 => largest,
            7 => largest.next_up(),
            8 => 1.0_f32.next_up(),
            9 => f32::from_bits(0x3F80_003F + self.below(3)),
            10 => integer,
            11 => from_fixed((whole << 16) - 0x8000),
            12 => self.pick(&[f32::INFINITY, 64.0, 65.0, 1e30, 63.0]).min(largest),
            13 => self.pick(&[f32::from_bits(1), 0.5, 2.0, 3.0]),
            _ => near(self),
        }
    }

    /// A factor that may cull its patch.
    fn any_factor(&mut self) -> f32 {
        match self.below(if self.extreme { 24 } else { 80 }) {
            0 => self.pick(&[0.0, -0.0, f32::NAN, -1.0, f32::NEG_INFINITY, f32::from_bits(!0)]),
            1 => f32::from_bits(self.random.next_u32()),
            2 => self.pick(&[f32::INFINITY, f32::MAX, 65.0, 1e30]),
            _ => self.factor(64),
        }
    }
}

/// A number in 16.16 as a binary32.
#[expect(clippy::float_arithmetic, clippy::cast_precision_loss, reason = "exact below 2^24")]
fn from_fixed(bits: u32) -> f32 {
    bits as f32 / 65536.0
}

/// Which patches an entry takes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Patches {
    pub(crate) domains: &'static [Domain],
    pub(crate) class: Class,
    /// The outputs that are drawn from.
    pub(crate) outputs: &'static [OutputPrimitive],
}

/// A property that all patches of an input have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Class {
    Any,
    /// Neither culled nor minimum patches.
    Regular,
    /// At most 289 points, neither culled nor minimum patches.
    Small,
    /// So few points that `stages/template, compact` takes them; not culled.
    Compact,
    CompactRegular,
    /// Compact patches of a fractional partitioning.
    CompactFractional,
}

pub(crate) const TRIANGLES: &[OutputPrimitive] =
    &[OutputPrimitive::TriangleCw, OutputPrimitive::TriangleCcw];

impl Patches {
    /// The round's configuration, or the next one that the entry takes.
    pub(crate) fn config(&self, config: Config) -> Config {
        let at = OutputPrimitive::ALL.iter().position(|output| *output == config.output);
        let output = self.outputs[at.unwrap_or(0) % self.outputs.len()];
        let partitioning = match config.partitioning {
            Partitioning::Integer if self.class == Class::CompactFractional => {
                Partitioning::FractionalOdd
            }
            Partitioning::Pow2 if self.class == Class::CompactFractional => {
                Partitioning::FractionalEven
            }
            partitioning => partitioning,
        };
        Config { partitioning, output, ..config }
    }

    /// Patches of one domain, up to 64 and about 8000 points, some of them several times in a row.
    pub(crate) fn draw(&self, draw: &mut Draw, config: Config) -> Vec<PatchFactors> {
        let domain = draw.pick(self.domains);
        let most = draw.pick(&[1, 3, 4, 5, 16, 17, 48, 64, 64, 64]);
        let (mut all, mut points) = (Vec::new(), 0);
        while all.len() < most && points < 8000 {
            let factors = match all.last() {
                Some(last) if draw.below(8) == 0 => self.other(draw, last),
                _ => self.one(draw, domain),
            };
            let patch = Patch::new(config, factors);
            if !self.class.has(&patch, domain) {
                continue;
            }
            // Counting looks for a run at the beginning of a batch.
            let one_in = if all.is_empty() { 2 } else { 8 };
            let times = if draw.below(one_in) == 0 { 1 + draw.below(12) } else { 1 };
            for _ in 0..times {
                all.push(factors);
                points += patch.counts().points;
            }
        }
        all.truncate(most);
        all
    }

    /// A patch that differs in one factor.
    fn other(&self, draw: &mut Draw, last: &PatchFactors) -> PatchFactors {
        let (domain, mut factors) = (last.domain(), last.iter());
        let (one, at) = (self.one(draw, domain), draw.below(6) as usize % domain.factors());
        let mut ones = one.iter();
        PatchFactors::from_fn(domain, |i| {
            let both = [factors.next(), ones.next()];
            both[usize::from(i == at)].unwrap_or(1.0)
        })
    }

    fn one(&self, draw: &mut Draw, domain: Domain) -> PatchFactors {
        let most = match self.class {
            Class::Any | Class::Regular => draw.pick(&[4, 8, 16, 64]),
            Class::Small => 17,
            _ => 15,
        };
        let equal = draw.below(8) == 0;
        let frame = draw.extreme && draw.below(8) == 0;
        // A minimum patch has only ones.
        let one = if draw.below(4) == 0 { 1.0 } else { draw.factor(most) };
        PatchFactors::from_fn(domain, |_| match self.class {
            _ if equal => one,
            // Around the smallest factor that needs a picture frame.
            _ if frame => f32::from_bits(0x3F80_0000 + (draw.below(4) << 6) + draw.below(3)),
            Class::Any if draw.below(3) == 0 => draw.any_factor(),
            _ => draw.factor(most),
        })
    }
}

impl Class {
    fn has(self, patch: &Patch, domain: Domain) -> bool {
        let points = patch.counts().points;
        let regular = matches!(patch.processed(), ProcessedPatch::Regular(_));
        match self {
            Self::Any => true,
            Self::Regular => regular,
            Self::Small => regular && points <= 289,
            Self::Compact | Self::CompactFractional => points != 0 && is_compact(patch, domain),
            Self::CompactRegular => regular && is_compact(patch, domain),
        }
    }
}

/// Whether no edge has more than 16 points, and no triangle's inside more than 13.
pub(crate) fn is_compact(patch: &Patch, domain: Domain) -> bool {
    let fits = |factors: &PatchFactors<tess_core::ProcessedFactor>| {
        let inside = if domain == Domain::Triangle { 13 } else { 16 };
        factors.outer().all(|factor| factor.context.points <= 16)
            && factors.inside().all(|factor| factor.context.points <= inside)
    };
    domain != Domain::Isoline && patch.processed().factors().is_some_and(fits)
}

/// Inputs that are numbers.
pub(crate) mod numbers {
    use super::{Draw, from_fixed};
    use tess_core::fixed_point::ONE;
    use tess_core::{Parity, Partitioning};

    /// 1 to 64.
    pub(crate) fn divisors(_: &mut Draw) -> Vec<u32> {
        (1..=64).collect()
    }

    /// The bits of raw factors of every kind.
    pub(crate) fn raw(draw: &mut Draw) -> Vec<u32> {
        let one = |draw: &mut Draw| match draw.below(3) {
            0 => draw.any_factor().to_bits(),
            1 => draw.factor(64).to_bits(),
            _ => draw.random.next_u32(),
        };
        (0..1 << 14).map(|_| one(draw)).collect()
    }

    /// The bits of binary32 numbers in 1..=64; extreme ones are around multiples of 2^-17.
    pub(crate) fn in_range(draw: &mut Draw) -> Vec<u32> {
        let one = |draw: &mut Draw| {
            let number = if draw.extreme {
                let bits = match draw.below(3) {
                    0 => draw.below(63) << 16,
                    _ => draw.below(63 << 16),
                };
                let tie = from_fixed(ONE + bits).to_bits() + (draw.below(2) << 6);
                f32::from_bits((tie + draw.below(5)).saturating_sub(2))
            } else {
                f32::from_bits(0x3F80_0000 + draw.below(0x0300_0001))
            };
            number.clamp(1.0, 64.0).to_bits()
        };
        (0..1 << 14).map(|_| one(draw)).collect()
    }

    /// Fixed-point factors of the parity, in range; extreme ones are around integers.
    pub(crate) fn fixed(draw: &mut Draw) -> Vec<u32> {
        (0..1 << 14).map(|_| one_fixed(draw)).collect()
    }

    /// Fewer of them, because each has up to 65 points.
    pub(crate) fn few_fixed(draw: &mut Draw) -> Vec<u32> {
        (0..256).map(|_| one_fixed(draw)).collect()
    }

    fn one_fixed(draw: &mut Draw) -> u32 {
        let odd = draw.parity == Parity::Odd;
        let (low, high) = if odd { (ONE, 63 * ONE) } else { (2 * ONE, 64 * ONE) };
        let bits = if draw.extreme {
            ((1 + draw.below(64)) << 16) + draw.below(80) - 40
        } else {
            low + draw.below(high - low)
        };
        if !odd && draw.below(64) == 0 { ONE } else { bits.clamp(low, high) }
    }

    /// 16.16 numbers in 0..=ONE.
    pub(crate) fn coordinates(draw: &mut Draw) -> Vec<u32> {
        let extreme = [0, 1, 0x5555, 0x8000, 0xFFFF, ONE];
        let one = |draw: &mut Draw| {
            if draw.extreme { draw.pick(&extreme) } else { draw.below(ONE + 1) }
        };
        (0..1 << 14).map(|_| one(draw)).collect()
    }

    /// Runs for writers, of lengths around the lengths of blocks.
    pub(crate) fn runs(draw: &mut Draw) -> Vec<u32> {
        let lengths = [0, 1, 7, 8, 9, 16, 23, 24, 25, 31, 32, 33, 63, 64, 65, 128, 129];
        let one = |draw: &mut Draw| {
            let method = draw.below(4);
            let length = if draw.extreme { draw.pick(&lengths) } else { draw.below(200) };
            (method << 24) | (draw.below(256) << 16) | length
        };
        (0..32).map(|_| one(draw)).collect()
    }

    /// Points, indices and times of periods.
    pub(crate) fn periods(draw: &mut Draw) -> Vec<u32> {
        let lengths = [1, 3, 4, 16, 17, 600];
        let mut all = Vec::new();
        for _ in 0..4 {
            let [points, indices] =
                [0; 2].map(|_| if draw.extreme { draw.pick(&lengths) } else { 1 + draw.below(90) });
            all.extend([points, indices, 1 + draw.below(24)]);
        }
        all
    }

    /// Numbers of stitches that the partitioning can ask for.
    pub(crate) fn stitches(draw: &mut Draw) -> Vec<u32> {
        (0..160).map(|_| stitch(draw)).collect()
    }

    fn stitch(draw: &mut Draw) -> u32 {
        let step = u32::from(!draw.config.partitioning.has_integer_factors()) + 1;
        let least = if draw.config.partitioning == Partitioning::FractionalEven { 3 } else { 2 };
        let [outer, inside] = [0; 2].map(|_| {
            let extreme = draw.pick(&[0, 1, 30, 31, 61, 62, 63]);
            let more = if draw.extreme { extreme } else { draw.below(63) };
            least + (more / step * step)
        });
        // Ring 1 has two points less than the inside factor, which has at least three.
        let inside = if inside < 3 { 4 } else { inside };
        match draw.below(6) {
            0 => (1 << 24) | ((1 + draw.below(61)) << 8),
            1 => (2 << 24) | ((1 + draw.below(63)) << 8),
            2 => (3 << 24) | ((1 + draw.below(63)) << 8),
            _ => (outer << 16) | (inside << 8),
        }
    }

    /// Stitches and the rows that they join.
    pub(crate) fn rows(draw: &mut Draw) -> Vec<u32> {
        let mut all = Vec::new();
        for _ in 0..64 {
            let bases = [0, 7, 0xFFFF, 0x1_0000, u32::MAX, draw.random.next_u32()];
            let stitch = stitch(draw);
            let [outer, inner, other, another] = [0; 4].map(|_| draw.pick(&bases));
            let plain = u32::from(draw.below(3) == 0);
            let [at_outer, at_inner] = [0; 2].map(|_| draw.pick(&[255, 0, 1, 5, 30]));
            let how = (plain << 24) | (at_outer << 16) | (at_inner << 8) | draw.below(2);
            all.extend([stitch, outer, inner, how, other, another]);
        }
        all
    }
}
