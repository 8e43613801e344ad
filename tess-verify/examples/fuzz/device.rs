//! The tessellator under test, and the check that a fuzzer runs on it. Put yours in place of this
//! one.

use tess_core::{Config, PatchFactors, Tessellation};
use tess_verify::check::{SecondFormulation, Strength, check_case};
use tess_verify::{Answers, Backend, Case};

/// A device: the model by random access, optionally with a fault.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Device {
    /// Whether it keeps only 8 of the 16 bits of a factor's fraction.
    pub(crate) truncates: bool,
}

impl Backend for Device {
    fn name(&self) -> &'static str {
        "device"
    }

    fn device(&self) -> String {
        "in this process".to_owned()
    }

    fn tessellate(&mut self, config: Config, patches: &[PatchFactors]) -> Answers<Tessellation> {
        let cut = |factor| if self.truncates { cut_off(factor) } else { factor };
        let seen: Vec<_> = patches.iter().map(|patch| patch.map(cut)).collect();
        SecondFormulation.tessellate(config, &seen)
    }
}

/// Compares the device's output for one case with the model's. The message of a finding begins with
/// the case as a line, which `tess patch --cases` accepts.
///
/// # Errors
/// The first difference, or the reason why the device could not run.
pub(crate) fn check(device: &mut Device, case: &Case) -> Result<(), String> {
    match check_case(device, case, Strength::default()) {
        Ok(None) => Ok(()),
        Ok(Some(wrong)) => Err(format!("{case}\n{}\n{wrong}", case.command())),
        // A case in a configuration that the device lacks is skipped. `Selection::fit` makes cases
        // in those that it has.
        Err(error) if error.is_unsupported() => Ok(()),
        Err(error) => Err(format!("{case}\n{error}")),
    }
}

#[expect(clippy::float_arithmetic, reason = "exact: scaled by a power of two")]
fn cut_off(factor: f32) -> f32 {
    if (1.0..64.0).contains(&factor) { (factor * 256.0).floor() / 256.0 } else { factor }
}
