//! A batch's output by the model.

use super::calls::{Base, Bits};
use tess_capi::batch::TessRange;
use tess_core::{Config, Domain, Order, PatchFactors, Tessellation};
use tess_verify::Case;

/// Where batches are cut off, so that a sequence takes milliseconds.
const MOST_POINTS: usize = 60_000;

/// A batch with its output: runs of equal patches.
pub(crate) struct Model {
    runs: Vec<(usize, Case, Tessellation)>,
}

/// Number of a patch, the patch, its output and its range.
pub(crate) type PlacedPatch<'a> = (usize, &'a Case, &'a Tessellation, TessRange);

impl Model {
    pub(crate) fn new(config: Config, domain: Domain, order: Order, runs: &[(u8, Bits)]) -> Self {
        let mut points = 0;
        let run = |&(times, Bits(bits)): &(u8, Bits)| {
            let factors = PatchFactors::from_fn(domain, |i| f32::from_bits(bits[i]));
            let case = Case { config, factors };
            let output = case.patch().tessellate_in(order);
            let most = (MOST_POINTS - MOST_POINTS.min(points)).div_ceil(output.points.len().max(1));
            let times = usize::from(times).min(most);
            points += times * output.points.len();
            (times, case, output)
        };
        Self { runs: runs.iter().map(run).collect() }
    }

    /// The factors of all patches.
    pub(crate) fn factors(&self) -> Vec<f32> {
        let run = |(times, case, _): &(usize, Case, _)| {
            std::iter::repeat_n(case.factors, *times)
                .flat_map(|factors| factors.iter().collect::<Vec<_>>())
        };
        self.runs.iter().flat_map(run).collect()
    }

    /// Points, indices and patches.
    pub(crate) fn sizes(&self) -> [usize; 3] {
        let sum = |of: fn(&Tessellation) -> usize| {
            self.runs.iter().map(|(times, _, one)| times * of(one)).sum()
        };
        [sum(|one| one.points.len()), sum(|one| one.indices.len()), sum(|_| 1)]
    }

    /// All patches in their order.
    pub(crate) fn parts(&self) -> impl Iterator<Item = PlacedPatch<'_>> {
        let mut next = TessRange::default();
        let all = self
            .runs
            .iter()
            .flat_map(|(times, case, output)| std::iter::repeat_n((case, output), *times));
        all.enumerate().map(move |(number, (case, output))| {
            let small = |count: usize| u32::try_from(count).expect("a small count");
            next.first_point += next.points;
            next.first_index += next.indices;
            (next.points, next.indices) = (small(output.points.len()), small(output.indices.len()));
            (number, case, output, next)
        })
    }

    /// The number of the first point.
    pub(crate) fn base(&self, base: Base, largest: u32) -> u32 {
        let wanted = match base {
            Base::Of(base) => i64::from(base),
            Base::Limit(delta) => {
                let [points, ..] = self.sizes();
                i64::from(largest) + i64::from(delta) + 1 - i64::try_from(points).expect("small")
            }
        };
        u32::try_from(wanted.clamp(0, i64::from(u32::MAX))).expect("clamped")
    }
}
