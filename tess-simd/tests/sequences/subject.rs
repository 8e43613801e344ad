//! A tessellator on which calls are made, each compared with the core.

use crate::buffers::{Outcome, Writer, equal, of_batch, of_patch, write};
use crate::calls::{Call, Factors, From, Layout, Patches, Room, Start, To};
use crate::expected::Expected;
use crate::kept::{Asked, Outputs};
use crate::patches;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::sync::LazyLock;
use std::sync::atomic::{AtomicUsize, Ordering};
use tess_core::{Domain, PatchFactors};
use tess_simd::{Batch, Error, Order, Tessellator};

/// Threads in which calls are made.
static POOL: LazyLock<ThreadPool> =
    LazyLock::new(|| ThreadPoolBuilder::new().num_threads(4).build().expect("four threads"));

/// Makes calls on a new tessellator until one differs from the core.
///
/// # Errors
/// The call, and the first element that differs.
pub(crate) fn replay(start: &Start, calls: &[Call]) -> Outcome {
    replay_counted(start, calls, &AtomicUsize::new(0))
}

/// [`replay`], which adds 1 to `begun` for each call.
pub(crate) fn replay_counted(start: &Start, calls: &[Call], begun: &AtomicUsize) -> Outcome {
    let all = || {
        let mut subject = Subject::new(start);
        calls.iter().enumerate().try_for_each(|(number, call)| {
            begun.fetch_add(1, Ordering::SeqCst);
            subject.call(call).map_err(|what| format!("call {number}, {call:?}: {what}"))
        })
    };
    if start.in_pool { POOL.install(all) } else { all() }
}

/// A tessellator and the facts known about it.
#[derive(Debug)]
struct Subject {
    tessellator: Tessellator,
    order: Order,
    outputs: Outputs,
    /// Its memory, if all of it is reserved.
    reserved: Option<usize>,
}

impl Subject {
    fn new(start: &Start) -> Self {
        let tessellator = Tessellator::with_level(start.config, start.level);
        let tessellator = tessellator.expect("a level that is there");
        let tessellator = tessellator.with_order(start.order).with_threads(start.threads);
        Self { tessellator, order: start.order, outputs: Outputs::default(), reserved: None }
    }

    /// Makes a call and compares.
    fn call(&mut self, call: &Call) -> Outcome {
        match call {
            Call::Write(patches, to) => {
                self.asked(patches, |subject, (batch, expected, refused)| {
                    write(Writer::Batch(&mut subject.tessellator, batch), to, &expected, refused)
                })
            }
            Call::Count(patches, all) => {
                self.asked(patches, |subject, asked| subject.count(asked, &all.0))
            }
            &Call::Tessellate(ref patches, format, width, from, ref groups) => {
                self.asked(patches, |Self { tessellator, outputs, .. }, asked| {
                    outputs.tessellate(tessellator, asked, (format, width, from), &groups.0)
                })
            }
            &Call::Patch(Factors(patch), room) => {
                let expected = self.expected(vec![patch]);
                write(Writer::Patch(&mut self.tessellator, patch), &alone(room), &expected, None)
            }
            Call::CountPatch(patch, rooms) => self.count_patch(patch.0, &rooms.0),
            _ => self.change(call),
        }?;
        match self.reserved {
            Some(bytes) => equal("memory", self.tessellator.memory(), bytes),
            None => Ok(()),
        }
    }

    /// Calls that write nothing.
    fn change(&mut self, call: &Call) -> Outcome {
        let mut tessellator = self.tessellator.clone();
        match *call {
            Call::SetOrder(order) => {
                self.order = order;
                tessellator.set_order(order);
            }
            Call::SetThreads(threads) => tessellator.set_threads(threads),
            Call::Reserve => {
                tessellator.reserve();
                self.reserved = Some(0);
            }
            _ => {}
        }
        self.reserved = self.reserved.map(|_| tessellator.memory());
        self.tessellator = tessellator;
        Ok(())
    }

    fn expected(&self, patches: Vec<PatchFactors>) -> Expected {
        Expected::new(self.tessellator.config(), self.order, patches)
    }

    /// Lays out patches as a batch, with the error if it must be refused.
    fn asked(
        &mut self,
        patches: &Patches,
        call: impl FnOnce(&mut Self, Asked<'_>) -> Outcome,
    ) -> Outcome {
        let (domain, mut all) = (patches.domain, patches.all());
        let (expected, end) = (self.expected(all.clone()), all.len());
        let layout = if end > 0 { patches.layout } else { Layout::Structures };
        if layout == Layout::Mixed {
            all.push(PatchFactors::uniform(other(domain), 1.0));
        }
        let laid = patches::Patches::new(all);
        let (batch, refused) = match layout {
            Layout::Structures => (laid.structures(domain), None),
            Layout::Columns => (laid.columns(domain), None),
            Layout::AnyDomain => (Batch::from(&laid.all), None),
            Layout::Uneven => {
                let error = Error::UnevenColumns { lengths: [end - 1, end] };
                (uneven(laid.columns(domain)), Some(error))
            }
            Layout::Mixed => {
                let (found, expected) = (other(domain), domain);
                let error = Error::MixedDomains { patch: end, found, expected };
                (Batch::from(&laid.all), Some(error))
            }
        };
        call(self, (batch, expected, refused))
    }

    fn count(&mut self, (batch, expected, refused): Asked<'_>, all: &[To]) -> Outcome {
        let mut counted = match self.tessellator.count(batch) {
            Ok(counted) => counted,
            Err(error) => return equal("count", Some(error), refused),
        };
        equal("refused", None, refused)?;
        equal("counts", of_batch(counted.counts()), expected.sizes())?;
        let getters = [counted.points(), counted.indices(), counted.patches()];
        equal("sizes", getters, expected.sizes())?;
        all.iter().try_for_each(|to| write(Writer::Counted(&mut counted), to, &expected, None))
    }

    fn count_patch(&mut self, patch: PatchFactors, rooms: &[Room]) -> Outcome {
        let expected = self.expected(vec![patch]);
        let mut counted = self.tessellator.count_patch(patch);
        equal("counts", of_patch(counted.counts()), expected.sizes())?;
        rooms.iter().try_for_each(|&room| {
            write(Writer::CountedPatch(&mut counted), &alone(room), &expected, None)
        })
    }
}

/// Buffers of one patch.
const fn alone(room: Room) -> To {
    To { room, from: From::EachPatch, ranges: None }
}

/// A different domain.
fn other(domain: Domain) -> Domain {
    if domain == Domain::Quad { Domain::Isoline } else { Domain::Quad }
}

/// Columns, the last of which lacks a factor.
fn uneven(batch: Batch<'_>) -> Batch<'_> {
    let Batch::Columns(columns) = batch else { panic!("columns are wanted: {batch:?}") };
    let mut factor = 0;
    Batch::Columns(columns.map(|column| {
        factor += 1;
        &column[..column.len() - usize::from(factor == columns.domain().factors())]
    }))
}
