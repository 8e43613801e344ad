//! Fuzzes a tessellator against the model without a fuzzer: pseudo-random bytes become cases.
//!
//!   cargo run --release --example fuzz --features arbitrary -- [SECONDS [SEED]] [--fault]
//!
//! Ends with the first finding (exit code 1), or with the number of cases per second. `--fault`
//! plants a fault in the device. The target `device` in the repository's folder `fuzz` is the same
//! for cargo-fuzz, which is guided by the code that the bytes reach.
#![expect(clippy::print_stdout, reason = "an example prints")]

pub(crate) mod device;

use arbitrary::{Arbitrary, Unstructured};
use device::Device;
use std::error::Error;
use std::time::{Duration, Instant};
use tess_verify::Case;
use tess_verify::generate::SplitMix64;

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let (flags, numbers): (Vec<_>, Vec<_>) = words.iter().partition(|word| *word == "--fault");
    let number = |at: usize, default| numbers.get(at).map_or(Ok(default), |word| word.parse());
    let (seconds, seed) = (number(0, 5)?, number(1, 1)?);
    let mut device = Device { truncates: !flags.is_empty() };
    let start = Instant::now();
    let mut cases = 0;
    let found = search(&mut device, seed, || {
        cases += 1;
        cases % 1024 != 0 || start.elapsed() < Duration::from_secs(seconds)
    });
    println!("{cases} cases, {} a second", cases * 1000 / start.elapsed().as_millis().max(1));
    match found {
        None => Ok(()),
        Some(message) => {
            println!("{message}");
            Err("the device differs".into())
        }
    }
}

/// Compares cases while `more` returns true; returns the first finding.
pub(crate) fn search(
    device: &mut Device,
    seed: u64,
    mut more: impl FnMut() -> bool,
) -> Option<String> {
    let mut random = SplitMix64::new(seed);
    while more() {
        let bytes: [[u8; 8]; 8] = [(); 8].map(|()| random.next_u64().to_le_bytes());
        let case = Case::arbitrary(&mut Unstructured::new(bytes.as_flattened()));
        if let Ok(case) = case
            && let Err(message) = device::check(device, &case)
        {
            return Some(message);
        }
    }
    None
}
