//! Cases from the bytes that libFuzzer makes.

use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors, SplitOrder};
use tess_verify::case::{Case, factor_bits, factors_from_list};

/// Bytes, taken from the front. Where none are left, zeros come.
#[derive(Clone, Copy, Debug)]
pub struct Bytes<'a>(pub &'a [u8]);

impl Bytes<'_> {
    /// Whether all bytes were taken.
    #[must_use]
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
        let byte = usize::from(self.byte());
        let config = Config {
            partitioning: Partitioning::ALL[byte / 3 % 4],
            output: OutputPrimitive::ALL[byte / 12 % 4],
            split: SplitOrder::ALL[byte / 48 % 2],
        };
        (Domain::ALL[byte % 3], config)
    }

    /// The factors of a patch: four bytes each.
    pub fn factors(&mut self, domain: Domain) -> PatchFactors {
        let values: Vec<f32> =
            (0..factor_count(domain)).map(|_| f32::from_bits(self.word())).collect();
        factors_from_list(domain, &values).expect("as many factors as the domain has")
    }

    /// One case.
    pub fn case(&mut self) -> Case {
        let (domain, config) = self.setting();
        Case { config, factors: self.factors(domain) }
    }

    /// A batch: a setting, then patches as long as there are bytes, at most `most`.
    pub fn batch(&mut self, most: usize) -> (Config, Vec<PatchFactors>) {
        let (domain, config) = self.setting();
        let mut patches = Vec::new();
        while !self.is_empty() && patches.len() < most {
            patches.push(self.factors(domain));
        }
        (config, patches)
    }
}

/// How many factors a patch has.
#[must_use]
pub const fn factor_count(domain: Domain) -> usize {
    match domain {
        Domain::Isoline => 2,
        Domain::Triangle => 4,
        Domain::Quad => 6,
    }
}

/// The bytes that [`Bytes::batch`] reads back as these patches.
#[must_use]
pub fn batch_bytes(domain: Domain, config: Config, patches: &[PatchFactors]) -> Vec<u8> {
    let settings = (0..96u8).find(|&byte| Bytes(&[byte]).setting() == (domain, config));
    let mut bytes = vec![settings.expect("every setting is one byte below 96")];
    for patch in patches {
        bytes.extend(factor_bits(patch).into_iter().flat_map(u32::to_le_bytes));
    }
    bytes
}
