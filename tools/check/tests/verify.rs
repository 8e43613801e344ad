//! Verification of backends: it compares what it says, in any number of shards, and sees faults.

use tess_check::backend::{Backend, BackendError};
use tess_check::core_backend::CoreBackend;
use tess_check::generate::Shard;
use tess_check::verify::{Plan, Row, Subject, units, verify};
use tess_core::{
    Config, FactorContext, FixedFactor, Parity, Partitioning, PatchFactors, SplitOrder,
    Tessellation,
};

/// The model with the last bit of one result per call wrong.
struct LastBitWrong;

impl Backend for LastBitWrong {
    fn name(&self) -> &'static str {
        "faulty"
    }

    fn device(&self) -> String {
        "nowhere".into()
    }

    fn tessellate(
        &mut self,
        config: Config,
        patches: &[PatchFactors],
    ) -> Result<Vec<Tessellation>, BackendError> {
        let mut results = CoreBackend.tessellate(config, patches)?;
        if let Some(index) = results.iter_mut().rev().find_map(|t| t.indices.last_mut()) {
            *index ^= 1;
        }
        Ok(results)
    }

    fn fixed_factors(
        &mut self,
        partitioning: Partitioning,
        values: &[f32],
    ) -> Result<Vec<[FixedFactor; 2]>, BackendError> {
        let mut results = CoreBackend.fixed_factors(partitioning, values)?;
        if let Some([_, inside]) = results.last_mut() {
            *inside = FixedFactor::from_bits(inside.to_bits() ^ 1);
        }
        Ok(results)
    }

    fn contexts(
        &mut self,
        split: SplitOrder,
        parity: Parity,
        factors: &[FixedFactor],
    ) -> Result<Vec<FactorContext>, BackendError> {
        CoreBackend.contexts(split, parity, factors)
    }

    fn locations(&mut self, contexts: &[FactorContext]) -> Result<Vec<u32>, BackendError> {
        let mut results = CoreBackend.locations(contexts)?;
        if let Some(location) = results.last_mut() {
            *location ^= 1;
        }
        Ok(results)
    }
}

/// One part in 61 of every subject (and far less of the largest).
fn small_plan() -> Plan {
    Plan { shard: Shard { part: 3, of: 61 }, ..Plan::exhaustive() }
}

fn run(workers: &mut [Vec<Box<dyn Backend>>], plan: &Plan) -> Vec<Row> {
    verify(workers, plan, &|_, _, _| {}).expect("the backends run")
}

fn without_factors(mut plan: Plan) -> Plan {
    plan.subjects.retain(|subject| *subject != Subject::Factors);
    plan
}

#[test]
fn the_model_equals_itself_on_any_number_of_threads() {
    let plan = without_factors(small_plan());
    let one = run(&mut [vec![Box::new(CoreBackend)]], &plan);
    assert_eq!(one.len(), plan.subjects.len(), "a row for each subject");
    for row in &one {
        assert!(row.compared > 0, "{row:?} compared something");
        assert_eq!(row.first, None, "{row:?}");
    }
    let two = run(&mut [vec![Box::new(CoreBackend)], vec![Box::new(CoreBackend)]], &plan);
    assert_eq!(one, two, "threads change nothing");
}

#[test]
fn every_subject_sees_a_wrong_bit() {
    let factors = Plan { subjects: vec![Subject::Factors], shard: Shard { part: 1000, of: 16384 } };
    for plan in [without_factors(small_plan()), factors] {
        for row in run(&mut [vec![Box::new(LastBitWrong)]], &plan) {
            assert!(row.mismatches > 0 && row.first.is_some(), "{row:?} sees it");
        }
    }
}

#[test]
fn factors_cover_every_binary32() {
    assert_eq!(units(Subject::Factors).len(), 4 * 4096, "2^20 each, four partitionings");
    assert_eq!(units(Subject::Locations).len(), 252, "as many as golden/place.csv has rows");
}

#[test]
fn no_backend_is_an_error() {
    assert!(verify(&mut [], &Plan::levels(), &|_, _, _| {}).is_err(), "no worker");
    assert!(verify(&mut [vec![]], &Plan::levels(), &|_, _, _| {}).is_err(), "no backend");
}
