//! A backend with a planted fault.

use super::{ContextField, Fault};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use tess_core::{
    Config, DomainPoint, FactorContext, FixedFactor, Parity, Partitioning, PatchFactors,
    SplitOrder, Tessellation,
};
use tess_verify::{Answers, Backend};

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

    /// Whether a call whose answers have these faults is the one to damage.
    fn strikes(&mut self, faults: &[Fault]) -> bool {
        let concerned = faults.contains(&self.fault);
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
        if !self.committed.load(Ordering::Relaxed) && self.strikes(&Fault::OF_PATCHES) {
            self.damage(&mut outputs, |outputs, i| match fault {
                Fault::RepeatedPatch => outputs[i.saturating_sub(1)].clone(),
                _ => damaged_patch(&outputs[i], fault),
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
        if self.strikes(&Fault::OF_FACTORS) {
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
        if self.strikes(&Fault::OF_CONTEXTS) {
            self.damage(&mut contexts, |contexts, i| match fault {
                Fault::Context(field) => damaged_context(contexts[i], field),
                _ => contexts[i],
            });
        }
        Ok(contexts)
    }

    fn locations(&mut self, contexts: &[FactorContext]) -> Answers<u32> {
        let mut locations = self.inner.locations(contexts)?;
        if self.strikes(&Fault::OF_LOCATIONS) {
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

fn damaged_patch(patch: &Tessellation, fault: Fault) -> Tessellation {
    let mut patch = patch.clone();
    let Tessellation { points, indices } = &mut patch;
    match fault {
        Fault::PointU => change_point(points.first_mut(), 1, 0),
        Fault::PointV => change_point(points.first_mut(), 0, 1 << 31),
        Fault::LastPoint => change_point(points.last_mut(), 0, 1),
        Fault::SwappedPoints => swap_ends(points),
        Fault::DroppedPoint => _ = points.pop(),
        Fault::ExtraPoint => points.push(DomainPoint::default()),
        Fault::StrayPoint => points.push(DomainPoint::from_bits(u32::MAX, 1)),
        Fault::SwappedIndices => swap_ends(indices),
        Fault::LastIndex => indices.last_mut().into_iter().for_each(|index| *index += 1),
        Fault::DroppedIndex => _ = indices.pop(),
        Fault::ExtraIndex => indices.push(0),
        Fault::EmptyPatch => return Tessellation::default(),
        _ => {}
    }
    patch
}

fn change_point(point: Option<&mut DomainPoint>, u: u32, v: u32) {
    if let Some(point) = point {
        *point = DomainPoint::from_bits(point.u.to_bits() ^ u, point.v.to_bits() ^ v);
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
