//! Arguments that may be wrong, and the answers that are allowed then.

use crate::input::Bytes;
use crate::repeatable;
use tess_capi::status::{
    TESS_MISALIGNED, TESS_NULL_POINTER, TESS_OK, TESS_UNKNOWN_VALUE, TESS_WRONG_FACTOR_COUNT,
    TessStatus,
};
use tess_capi::types::{TessConfig, TessPoint};
use tess_verify::Case;

/// The words that buffers hold before a call.
pub(super) const CANARY: u32 = 0xC0DE_C0DE;
/// A point of such words.
pub(super) const NO_POINT: TessPoint = TessPoint { u: CANARY, v: CANARY };

/// Statuses that explain a refusal of a call.
#[derive(Debug, Default)]
pub(super) struct Wrongs(Vec<TessStatus>);

impl Wrongs {
    pub(super) fn add_if(&mut self, wrong: bool, status: TessStatus) {
        if wrong {
            self.0.push(status);
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Whether an answer is right.
    pub(super) fn judge(&self, call: &str, case: &Case, status: TessStatus) -> Result<(), String> {
        let explained = if self.is_empty() { status == TESS_OK } else { self.0.contains(&status) };
        if explained && !crate::fault_is_planted() {
            return Ok(());
        }
        let wrongs = &self.0;
        let message = format!("{call} answered {status}; wrong with the call: {wrongs:?}");
        Err(repeatable(case, &message))
    }

    /// Sometimes null or one byte off.
    pub(super) fn pointer<T>(&mut self, bytes: &mut Bytes<'_>, good: *mut T) -> *mut T {
        match bytes.byte() {
            254 => {
                self.0.push(TESS_NULL_POINTER);
                std::ptr::null_mut()
            }
            255 if align_of::<T>() > 1 => {
                self.0.push(TESS_MISALIGNED);
                good.wrapping_byte_add(1)
            }
            _ => good,
        }
    }

    /// The pointer of an output buffer with a capacity. If the capacity is 0, the pointer may be
    /// anything.
    pub(super) fn room<T>(
        &mut self,
        bytes: &mut Bytes<'_>,
        good: *mut T,
        capacity: usize,
    ) -> *mut T {
        let mut ignored = Self::default();
        if capacity == 0 { ignored.pointer(bytes, good) } else { self.pointer(bytes, good) }
    }

    /// A number that is sometimes not one of the first `listed`.
    fn number(&mut self, bytes: &mut Bytes<'_>, good: u32, listed: u32) -> u32 {
        if bytes.byte() < 250 {
            return good;
        }
        let any = bytes.word();
        self.add_if(any >= listed, TESS_UNKNOWN_VALUE);
        any
    }
}

/// A patch as C describes it, sometimes wrongly, and as the model has it if it is right.
pub(super) struct Hostile {
    pub(super) case: Case,
    pub(super) config: TessConfig,
    pub(super) factors: Vec<f32>,
    pub(super) factor_count: usize,
}

impl Hostile {
    pub(super) fn new(bytes: &mut Bytes<'_>, wrongs: &mut Wrongs) -> Self {
        let mut case = bytes.case();
        let settings = [
            (case.domain() as u32, 3),
            (case.config.partitioning as u32, 4),
            (case.config.output as u32, 4),
            (case.config.split as u32, 2),
        ];
        let [domain, partitioning, output, split] =
            settings.map(|(good, listed)| wrongs.number(bytes, good, listed));
        let config = TessConfig { domain, partitioning, output, split };
        if wrongs.is_empty() {
            case = expected_case(case, config);
        }
        let factors = case.factors.iter().collect();
        let right = case.domain().factors();
        let count = match bytes.byte() {
            250 => 0,
            251 => right - 1,
            252 => right + 1,
            253 => usize::MAX / 4 + 1,
            254 => usize::MAX / right * right,
            255 => usize::MAX,
            _ => right,
        };
        wrongs.add_if(count != right, TESS_WRONG_FACTOR_COUNT);
        Self { case, config, factors, factor_count: count }
    }
}

/// The case that these numbers describe; if the domain is another, all factors are 3.
fn expected_case(case: Case, config: TessConfig) -> Case {
    use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors, SplitOrder};
    let domain = Domain::ALL[config.domain as usize];
    let others = PatchFactors::uniform(domain, 3.0);
    let factors = if domain == case.domain() { case.factors } else { others };
    let config = Config {
        partitioning: Partitioning::ALL[config.partitioning as usize],
        output: OutputPrimitive::ALL[config.output as usize],
        split: SplitOrder::ALL[config.split as usize],
    };
    Case { config, factors }
}
