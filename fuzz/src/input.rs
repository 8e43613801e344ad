//! Cases from libFuzzer's bytes.

use tess_core::{Config, Domain, OutputPrimitive, Partitioning, Patch, PatchFactors, SplitOrder};
use tess_verify::Case;

/// Bytes, taken from the front. After the last one, zeros follow.
#[derive(Clone, Copy, Debug)]
pub struct Bytes<'a>(pub &'a [u8]);

impl Bytes<'_> {
    /// Whether all bytes were taken.
    pub const fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The next byte.
    pub fn byte(&mut self) -> u8 {
        let Some((&first, rest)) = self.0.split_first() else { return 0 };
        self.0 = rest;
        first
    }

    /// The next four bytes, little-endian.
    pub fn word(&mut self) -> u32 {
        u32::from_le_bytes([(); 4].map(|()| self.byte()))
    }

    /// One of these values.
    pub fn one_of<T: Copy, const N: usize>(&mut self, values: [T; N]) -> T {
        values[usize::from(self.byte()) % N]
    }

    /// A domain and a configuration: one byte.
    pub fn setting(&mut self) -> (Domain, Config) {
        setting(self.byte())
    }

    /// The factors of a patch: four bytes each.
    pub fn factors(&mut self, domain: Domain) -> PatchFactors {
        PatchFactors::from_fn(domain, |_| f32::from_bits(self.word()))
    }

    /// One case.
    pub fn case(&mut self) -> Case {
        let (domain, config) = self.setting();
        Case { config, factors: self.factors(domain) }
    }

    /// A batch of at most `most` patches, and of little more than `MOST_POINTS` points.
    ///
    /// A setting below [`SETTINGS`] is followed by patches until the bytes end. A higher one is
    /// followed by the number of patches, a step, and patches that repeat with their bits growing
    /// by the step, so that a short input makes a long batch.
    pub fn batch(&mut self, most: usize) -> (Config, Vec<PatchFactors>) {
        let byte = self.byte();
        let (domain, config) = setting(byte);
        let repeated = byte >= SETTINGS;
        let (count, step) = if repeated { (self.byte().into(), self.word()) } else { (most, 0) };
        let mut given = Vec::new();
        while !self.is_empty() && given.len() < most {
            given.push(self.factors(domain));
        }
        let count = if repeated && !given.is_empty() { count } else { given.len() };
        let grown = |number: usize| {
            let times = u32::try_from(number / given.len()).unwrap_or(u32::MAX);
            let grow = |factor: f32| factor.to_bits().wrapping_add(step.wrapping_mul(times));
            given[number % given.len()].map(|factor| f32::from_bits(grow(factor)))
        };
        let mut points = 0;
        let small = |factors: &PatchFactors| {
            let before = points;
            points += Patch::new(config, *factors).counts().points;
            before < MOST_POINTS
        };
        (config, (0..count.min(most)).map(grown).take_while(small).collect())
    }
}

/// The number of settings.
pub const SETTINGS: u8 = 96;
/// The size at which batches end, because unoptimised kernels run on them at every CPU level.
const MOST_POINTS: u32 = 20_000;

fn setting(byte: u8) -> (Domain, Config) {
    let number = usize::from(byte);
    let config = Config {
        partitioning: Partitioning::ALL[number / 3 % 4],
        output: OutputPrimitive::ALL[number / 12 % 4],
        split: SplitOrder::ALL[number / 48 % 2],
    };
    (Domain::ALL[number % 3], config)
}

/// The bytes that [`Bytes::batch`] reads back as these patches.
pub fn batch_bytes(domain: Domain, config: Config, patches: &[PatchFactors]) -> Vec<u8> {
    let byte = (0..SETTINGS).find(|&byte| setting(byte) == (domain, config));
    let mut bytes = vec![byte.expect("every setting is one byte")];
    for patch in patches {
        bytes.extend(patch.iter().flat_map(|factor| factor.to_bits().to_le_bytes()));
    }
    bytes
}

/// The bytes that [`Bytes::batch`] reads as `count` patches: these repeatedly, with the bits of
/// their factors growing by `step`.
pub fn repeated_bytes(plain: &[u8], count: u8, step: u32) -> Vec<u8> {
    let (setting, patches) = plain.split_at(1);
    [&[setting[0] + SETTINGS, count], &step.to_le_bytes()[..], patches].concat()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_inputs_make_long_batches() {
        let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
        let patches =
            [PatchFactors::uniform(Domain::Quad, 2.5), PatchFactors::uniform(Domain::Quad, 1.0)];
        let plain = batch_bytes(Domain::Quad, config, &patches);
        let (read, same) = Bytes(&plain).batch(200);
        assert_eq!((read, &same[..]), (config, &patches[..]), "as given");
        let (_, many) = Bytes(&repeated_bytes(&plain, 200, 64)).batch(200);
        assert_eq!((many.len(), many[0], many[1]), (200, patches[0], patches[1]), "repeated");
        let third = PatchFactors::uniform(Domain::Quad, f32::from_bits(2.5f32.to_bits() + 64));
        assert_eq!(many[2], third, "grown by the step");
        let large = batch_bytes(Domain::Quad, config, &[PatchFactors::uniform(Domain::Quad, 63.0)]);
        let (_, few) = Bytes(&repeated_bytes(&large, 200, 0)).batch(200);
        assert_eq!(few.len(), 5, "large patches, fewer of them");
    }
}
