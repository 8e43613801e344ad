//! A backend with a planted fault.

use super::{ContextField, Fault};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use tess_core::{
    Config, FactorContext, FixedFactor, Parity, Partitioning, PatchFactors, SplitOrder,
    Tessellation,
};
use tess_verify::mistakes::{Request, requests};
use tess_verify::{Answers, Backend, Case};

/// A backend that commits one [`Fault`] in one kind of answer.
///
/// In whole patches it damages one answer, once: the last one that the fault changes, in the first
/// call with such an answer after `calls_before` calls. In the other stages it damages the last
/// answer of every call after `calls_before`, so that asking again shows the fault again.
#[derive(Debug)]
pub struct Faulty<B> {
    inner: B,
    fault: Fault,
    calls_before: u32,
    committed: Arc<AtomicBool>,
}

impl<B: Backend> Faulty<B> {
    /// `inner` with a fault after `calls_before` calls of the fault's kind.
    pub fn new(inner: B, fault: Fault, calls_before: u32) -> Self {
        Self { inner, fault, calls_before, committed: Arc::default() }
    }

    /// Whether the fault was committed, so that a test knows that there was something to find. It
    /// can still be read after the backend has been given away.
    #[must_use]
    pub fn committed(&self) -> Arc<AtomicBool> {
        self.committed.clone()
    }

    /// Whether a call is the one to damage, if the fault is of its kind.
    fn strikes(&mut self, concerned: bool) -> bool {
        if concerned && self.calls_before > 0 {
            self.calls_before -= 1;
            return false;
        }
        concerned
    }

    /// Damages the last answer that the fault changes.
    fn damage<T: PartialEq>(&self, answers: &mut Vec<T>, damaged: impl Fn(&[T], usize) -> T) {
        let committed = if self.fault == Fault::ShortAnswer {
            answers.pop().is_some()
        } else {
            let different = |i: &usize| damaged(answers, *i) != answers[*i];
            let last = (0..answers.len()).rev().find(different);
            last.is_some_and(|i| {
                answers[i] = damaged(answers, i);
                true
            })
        };
        self.committed.fetch_or(committed, Ordering::Relaxed);
    }
}

impl<B: Backend> Backend for Faulty<B> {
    fn name(&self) -> &'static str {
        self.inner.name()
    }

    fn device(&self) -> String {
        format!("{}, with a planted fault: {:?}", self.inner.device(), self.fault)
    }

    fn tessellate(&mut self, config: Config, patches: &[PatchFactors]) -> Answers<Tessellation> {
        let mut outputs = self.inner.tessellate(config, patches)?;
        let fault = self.fault;
        if !self.committed.load(Ordering::Relaxed) && self.strikes(fault.is_of_patches()) {
            let cases = patches.iter().map(|&factors| Case { config, factors });
            let requests: Vec<Request> = requests(cases).collect();
            self.damage(&mut outputs, |outputs, i| {
                let wrong = match fault {
                    Fault::Patch(mistake) => mistake.wrong_answer(&requests[i], &outputs[i]),
                    _ => None,
                };
                wrong.unwrap_or_else(|| outputs[i].clone())
            });
        }
        Ok(outputs)
    }

    fn fixed_factors(
        &mut self,
        partitioning: Partitioning,
        values: &[f32],
    ) -> Answers<[FixedFactor; 2]> {
        let mut factors = self.inner.fixed_factors(partitioning, values)?;
        let which = usize::from(self.fault == Fault::InsideFactor);
        if self.strikes(Fault::OF_FACTORS.contains(&self.fault)) {
            self.damage(&mut factors, |factors, i| {
                let mut pair = factors[i];
                pair[which] = FixedFactor::from_bits(pair[which].to_bits() ^ 1);
                pair
            });
        }
        Ok(factors)
    }

    fn contexts(
        &mut self,
        split: SplitOrder,
        parity: Parity,
        factors: &[FixedFactor],
    ) -> Answers<FactorContext> {
        let mut contexts = self.inner.contexts(split, parity, factors)?;
        let fault = self.fault;
        if self.strikes(Fault::OF_CONTEXTS.contains(&self.fault)) {
            self.damage(&mut contexts, |contexts, i| match fault {
                Fault::Context(field) => damaged_context(contexts[i], field),
                _ => contexts[i],
            });
        }
        Ok(contexts)
    }

    fn locations(&mut self, contexts: &[FactorContext]) -> Answers<u32> {
        let mut locations = self.inner.locations(contexts)?;
        if self.strikes(Fault::OF_LOCATIONS.contains(&self.fault)) {
            match self.fault {
                Fault::LastLocation => locations.last_mut().into_iter().for_each(|x| *x ^= 1),
                Fault::SwappedLocations => swap_ends(&mut locations),
                _ => _ = locations.pop(),
            }
            self.committed.store(true, Ordering::Relaxed);
        }
        Ok(locations)
    }
}

fn damaged_context(mut context: FactorContext, field: ContextField) -> FactorContext {
    let number = match field {
        ContextField::Parity => {
            context.parity = match context.parity {
                Parity::Even => Parity::Odd,
                Parity::Odd => Parity::Even,
            };
            return context;
        }
        ContextField::InvFloor => &mut context.inv_floor,
        ContextField::InvCeil => &mut context.inv_ceil,
        ContextField::Fraction => &mut context.fraction,
        ContextField::HalfPoints => &mut context.half_points,
        ContextField::Split => &mut context.split_position,
        ContextField::Points => &mut context.points,
    };
    *number ^= 1;
    context
}

fn swap_ends<T>(list: &mut [T]) {
    if let Some(last) = list.len().checked_sub(1) {
        list.swap(0, last);
    }
}
