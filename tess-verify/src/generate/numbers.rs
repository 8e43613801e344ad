//! Every number of segments in every role, with the relatives that rules compare.

use super::from_fixed;
use crate::case::Case;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors};

/// The level of an inside that is not asked for; small, so that patches are narrow.
const NARROW: f32 = 3.0;
/// The largest level.
const LARGEST: f32 = 64.0;
const BELOW_LARGEST: f32 = 63.0;

/// The numbers of segments of a spacing, ascending.
pub(super) fn segments(partitioning: Partitioning) -> impl Iterator<Item = u32> + Clone {
    let (first, step) = match partitioning {
        Partitioning::Integer | Partitioning::Pow2 => (1, 1),
        Partitioning::FractionalOdd => (1, 2),
        Partitioning::FractionalEven => (2, 2),
    };
    (first..=64).step_by(step)
}

/// Two levels that give a number of segments: one between it and the next lower number, and the
/// number itself. 1, and 2 where it is the lowest, have only themselves.
fn levels(partitioning: Partitioning, n: u32) -> [f32; 2] {
    let whole = from_fixed(n << 16);
    let is_lowest = segments(partitioning).next() == Some(n);
    [if is_lowest { whole } else { from_fixed((n << 16) - 0x9C40) }, whole]
}

/// Each number in each role of a domain.
pub(super) fn numbers(domain: Domain, config: Config, cases: &mut Vec<Case>) {
    let partitioning = config.partitioning;
    let both = segments(partitioning).map(|n| levels(partitioning, n));
    if domain == Domain::Isoline {
        // The density has equal spacing whatever the spacing of the lines.
        (1..=64).for_each(|n| lines(config, [from_fixed(n << 16), 2.5], cases));
        both.flatten().for_each(|detail| lines(config, [2.0, detail], cases));
        return;
    }
    let at = Asked { domain, config };
    for [level, whole] in both.clone() {
        at.outer(level, whole, cases);
        for position in domain.outer_factors()..domain.factors() {
            at.inner(position, level, whole, cases);
        }
        at.within_the_largest(level, cases);
    }
    at.around_the_largest(&both.map(|[level, _]| level).collect::<Vec<_>>(), cases);
}

/// The powers of two in each role, and on all edges.
pub(super) fn powers_of_two(domain: Domain, config: Config, cases: &mut Vec<Case>) {
    for level in [1, 2, 4, 8, 16, 32, 64].map(|n| from_fixed(n << 16)) {
        let outer = domain.outer_factors();
        let on_all_edges = |p| if p < outer { level } else { NARROW };
        cases.push(Case { config, factors: PatchFactors::from_fn(domain, on_all_edges) });
        for position in 0..domain.factors() {
            let at = |p| if p == position { level } else { NARROW };
            let case = Case { config, factors: PatchFactors::from_fn(domain, at) };
            let others = [OutputPrimitive::TriangleCcw, OutputPrimitive::Point];
            cases.extend([case, case]);
            cases.extend(others.map(|output| case.with_output(output)));
        }
    }
}

/// Isolines of a density and a detail: twice, and as points.
fn lines(config: Config, levels: [f32; 2], cases: &mut Vec<Case>) {
    let factors = PatchFactors::from_fn(Domain::Isoline, |p| levels[p]);
    let case = Case { config, factors };
    cases.extend([case, case, case.with_output(OutputPrimitive::Point)]);
}

/// A domain and a configuration in which numbers are asked for.
struct Asked {
    domain: Domain,
    config: Config,
}

impl Asked {
    /// A patch of these outer and inner levels, by number among the outer and among the inner ones.
    fn patch(&self, outer: impl Fn(usize) -> f32, inner: impl Fn(usize) -> f32) -> Case {
        let edges = self.domain.outer_factors();
        let level = |p: usize| if p < edges { outer(p) } else { inner(p - edges) };
        Case { config: self.config, factors: PatchFactors::from_fn(self.domain, level) }
    }

    /// A level on all edges, and on some while the others have another one.
    fn outer(&self, level: f32, whole: f32, cases: &mut Vec<Case>) {
        let inside = |k: usize| [NARROW, 4.5][k];
        let other = if level > 4.0 { 2.5 } else { 6.25 };
        let all = self.patch(|_| level, inside);
        cases.extend([all, all]);
        cases.extend(
            [OutputPrimitive::TriangleCcw, OutputPrimitive::Point]
                .map(|output| all.with_output(output)),
        );
        for parity in [0, 1] {
            cases.push(self.patch(|edge| if edge % 2 == parity { level } else { other }, inside));
        }
        cases.push(self.patch(|_| whole, inside));
    }

    /// A level inside, with two sets of outer levels.
    fn inner(&self, position: usize, level: f32, whole: f32, cases: &mut Vec<Case>) {
        let own = position - self.domain.outer_factors();
        let inside = |level: f32| move |k: usize| if k == own { level } else { NARROW };
        let patch = self.patch(|edge| [3.0, 2.0, 4.5, 1.0][edge], inside(level));
        cases.extend([patch, patch]);
        cases.extend(
            [OutputPrimitive::TriangleCcw, OutputPrimitive::Point]
                .map(|output| patch.with_output(output)),
        );
        cases.push(self.patch(|edge| [4.5, 5.0, 2.0, 3.0][edge], inside(level)));
        cases.push(self.patch(|_| NARROW, inside(whole)));
    }

    /// A level inside, within the largest number on the outline. A row with every position shows
    /// where each point of the other row belongs.
    fn within_the_largest(&self, level: f32, cases: &mut Vec<Case>) {
        for own in 0..self.domain.factors() - self.domain.outer_factors() {
            let inside = |k: usize| if k == own { level } else { NARROW };
            cases.push(self.patch(|_| LARGEST, inside));
        }
    }

    /// Levels on the outline, around the largest numbers inside. A triangle that large is long, so
    /// its edges share one.
    fn around_the_largest(&self, levels: &[f32], cases: &mut Vec<Case>) {
        for largest in [LARGEST, BELOW_LARGEST] {
            if self.domain == Domain::Triangle {
                let on = |some: &[f32]| self.patch(|edge| some[edge % some.len()], |_| largest);
                cases.extend(levels.chunks(3).map(on));
                continue;
            }
            for own in 0..2 {
                let inside = |k: usize| if k == own { largest } else { NARROW };
                cases.extend(levels.iter().map(|&level| self.patch(|_| level, inside)));
            }
        }
    }
}
