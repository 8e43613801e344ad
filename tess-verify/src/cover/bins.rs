//! Every bin, and which of them a configuration can hit.

use super::boundary;
use super::observe::{quad_centre, sequence_values, triangle_centre};
use crate::generate::configurations;
use crate::names::Named;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;
use tess_core::{Config, Domain, Parity, Partitioning, SplitOrder};

/// The paths of all bins, in alphabetical order.
pub(super) fn all() -> &'static [String] {
    static ALL: LazyLock<Vec<String>> = LazyLock::new(|| of(configurations()));
    &ALL
}

/// The paths of exactly those bins that patches of these configurations can hit, in alphabetical
/// order.
pub(super) fn of(configurations: impl IntoIterator<Item = (Domain, Config)>) -> Vec<String> {
    let mut bins = Vec::new();
    let mut stitched = Vec::new();
    // The values that each field can have in the patches of a stream.
    let mut values: BTreeMap<&str, BTreeSet<String>> = BTreeMap::new();
    for (domain, config) in configurations {
        bins.extend(of_settings(domain, config));
        let ways: &[&str] = if can_be_minimum(domain, config) {
            &["culled", "minimum", "regular"]
        } else {
            &["culled", "regular"]
        };
        for way in ways {
            for (field, value) in sequence_values(domain, config, way) {
                values.entry(field).or_default().insert(value);
            }
        }
        let of = (domain, config.partitioning, config.split);
        if !stitched.contains(&of) {
            stitched.push(of);
            bins.extend(of_stitches(domain, config.partitioning, config.split));
        }
    }
    for (field, values) in &values {
        for before in values {
            bins.extend(values.iter().map(|value| format!("sequence/{field}/{before}/{value}")));
        }
    }
    bins.sort_unstable();
    bins.dedup();
    bins
}

/// Whether a patch can be minimum. Factors of `fractional_even` are at least 2.
fn can_be_minimum(domain: Domain, config: Config) -> bool {
    domain != Domain::Isoline && config.partitioning != Partitioning::FractionalEven
}

/// The bins of a patch's settings and of single factors.
fn of_settings(domain: Domain, config: Config) -> Vec<String> {
    let mut bins = Vec::new();
    configuration(&mut bins, domain, config);
    cull(&mut bins, domain);
    bins.extend(boundary::bins(domain, config.partitioning));
    for (role, partitioning) in roles(domain, config.partitioning) {
        factors(&mut bins, role, partitioning);
        contexts(&mut bins, config, partitioning);
    }
    bins
}

/// The bins of rings, transitions and centres, which are most of the bins. They do not depend on
/// the output.
fn of_stitches(domain: Domain, partitioning: Partitioning, split: SplitOrder) -> Vec<String> {
    let mut bins = Vec::new();
    if domain != Domain::Isoline {
        stitches(&mut bins, domain.name(), partitioning, split.name());
        centres(&mut bins, domain, parities(partitioning));
    }
    bins
}

/// The roles of factors, each with the partitioning by which it is processed. An isoline's density
/// is always an integer.
fn roles(domain: Domain, partitioning: Partitioning) -> [(&'static str, Partitioning); 2] {
    match domain {
        Domain::Isoline => [("outer", Partitioning::Integer), ("outer", partitioning)],
        Domain::Triangle | Domain::Quad => [("outer", partitioning), ("inside", partitioning)],
    }
}

/// The parities that a partitioning can give a factor.
fn parities(partitioning: Partitioning) -> &'static [Parity] {
    match partitioning {
        Partitioning::Integer | Partitioning::Pow2 => &[Parity::Even, Parity::Odd],
        Partitioning::FractionalOdd => &[Parity::Odd],
        Partitioning::FractionalEven => &[Parity::Even],
    }
}

/// Every pair of an outer and an inside parity.
fn pairs(of: &[Parity]) -> impl Iterator<Item = (Parity, Parity)> {
    of.iter().flat_map(|&outer| of.iter().map(move |&inside| (outer, inside)))
}

fn configuration(bins: &mut Vec<String>, domain: Domain, config: Config) {
    let [output, split] = [config.output.name(), config.split.name()];
    let [domain_name, partitioning] = [domain.name(), config.partitioning.name()];
    bins.push(format!("configuration/{domain_name}/{partitioning}/{output}/{split}"));
    if can_be_minimum(domain, config) {
        bins.push(format!("minimum/{domain_name}/{partitioning}/{output}/{split}"));
    }
    if domain != Domain::Isoline && config.partitioning == Partitioning::FractionalOdd {
        let how = ["raised", "all_one", "already_above"];
        bins.extend(how.map(|how| format!("picture_frame/{how}")));
    }
}

fn cull(bins: &mut Vec<String>, domain: Domain) {
    for factor in &domain.factor_names()[..domain.outer_factors()] {
        for why in ["zero", "negative", "nan"] {
            bins.push(format!("cull/{}/{factor}/{why}", domain.name()));
        }
        bins.push(format!("denormal/{}/{factor}", domain.name()));
    }
}

fn factors(bins: &mut Vec<String>, role: &str, partitioning: Partitioning) {
    let name = partitioning.name();
    let clamps = ["below", "within", "above"];
    bins.extend(clamps.map(|clamp| format!("clamp/{name}/{role}/{clamp}")));
    if role == "inside" {
        bins.push(format!("clamp/{name}/inside/nan"));
    }
    bins.push(format!("conversion/{role}/exact"));
    if partitioning.has_integer_factors() {
        bins.extend(["exact", "up"].map(|how| format!("round/{name}/{role}/{how}")));
    } else {
        let inexact = ["down", "up", "tie_down", "tie_up"];
        bins.extend(inexact.map(|how| format!("conversion/{role}/{how}")));
    }
}

/// The bins of contexts of factors that this partitioning produces.
fn contexts(bins: &mut Vec<String>, config: Config, partitioning: Partitioning) {
    let split = config.split.name();
    let has_fractions = !partitioning.has_integer_factors();
    for parity in parities(partitioning) {
        let name = parity.name();
        for half_points in 1..=32 {
            bins.push(format!("context/{split}/{name}/{half_points}/whole"));
            if has_fractions && half_points > 1 {
                bins.push(format!("context/{split}/{name}/{half_points}/split"));
            }
        }
        if has_fractions {
            bins.push(format!("exceptional/{split}/{name}/equal_neighbours"));
        }
        if has_fractions && *parity == Parity::Even {
            bins.push(format!("exceptional/{split}/even/backwards"));
        }
    }
}

fn stitches(bins: &mut Vec<String>, domain: &str, partitioning: Partitioning, split: &str) {
    for (outer, inside) in pairs(parities(partitioning)) {
        let parities = format!("{}x{}", outer.name(), inside.name());
        bins.push(format!("parities/{split}/{domain}/{}/{parities}", partitioning.name()));
        bins.push(format!("middle/{split}/{parities}"));
        for outer in points(outer) {
            // An inside row belongs to a picture frame, so it has at least three points.
            let inside = points(inside).filter(|inside| *inside >= 3);
            bins.extend(inside.map(|inside| format!("transition/{split}/{outer}x{inside}")));
        }
    }
}

/// The possible numbers of points on an edge. An edge of even parity has a point in its middle.
fn points(parity: Parity) -> impl Iterator<Item = u32> {
    let first = if parity == Parity::Even { 3 } else { 2 };
    (first..=65).step_by(2)
}

/// The bins of the number of rings, and of the shape at the centre of a patch.
fn centres(bins: &mut Vec<String>, domain: Domain, parities: &[Parity]) {
    let name = domain.name();
    let mut add = |points: u32, centre: &str| {
        bins.push(format!("rings/{name}/{}/{centre}", points.div_ceil(2) - 1));
        bins.push(format!("centre/{name}/{centre}"));
    };
    let counts = |parity| points(parity).filter(|points| *points >= 3);
    for (a, b) in pairs(parities) {
        for u in counts(a) {
            match domain {
                Domain::Quad => counts(b).for_each(|v| add(u.min(v), &quad_centre((u, a), (v, b)))),
                _ => add(u, triangle_centre(a)),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Case;
    use crate::cover::observe::{observe, sequence_values_of};
    use crate::generate::{GenLevel, Selection, boundary_factors, thresholds};
    use tess_core::{OutputPrimitive, PatchFactors};

    /// Factors that hit everything that a domain's patches can hit: each boundary in each position,
    /// every pair of an outer and an inside number of points, and the interiors of level 1.
    fn witnesses(domain: Domain) -> Vec<PatchFactors> {
        let mut all = Vec::new();
        let values = boundary_factors();
        for value in values {
            all.push(PatchFactors::uniform(domain, value));
            for at in 0..domain.factors() {
                let others = [3.0, 1.0, 4.5, 2.0, 7.25, 5.0];
                all.push(PatchFactors::from_fn(
                    domain,
                    |i| if i == at { value } else { others[i] },
                ));
            }
        }
        for inside in (1..=64u8).map(f32::from) {
            for group in 0..16u8 {
                let outer = |i| f32::from(group * 4 + [0, 1, 2, 3][i % 4] + 1);
                let is_outer = |i| i < domain.outer_factors();
                let pairs = |turn: usize| {
                    let at = |i: usize| if is_outer(i) { outer(i + turn) } else { inside };
                    PatchFactors::from_fn(domain, at)
                };
                all.extend([pairs(0), pairs(1)]);
            }
        }
        let level = Selection { random: Some(0), ..Selection::level(GenLevel::One, 1) };
        let of_domain = level.cases().filter(|case| case.domain() == domain);
        all.extend(of_domain.step_by(7).map(|case| case.factors));
        let fit = Selection { domain: Some(domain), ..level };
        let wanted = thresholds()
            .into_iter()
            .filter(|(side, case)| case.domain() == domain || side.starts_with("location/"));
        all.extend(wanted.map(|(_, case)| fit.fit(&case).factors));
        all
    }

    /// The values that the fields of a stream's patches have.
    fn values_of(cases: impl Iterator<Item = Case>) -> BTreeMap<&'static str, BTreeSet<String>> {
        let mut values: BTreeMap<_, BTreeSet<String>> = BTreeMap::new();
        for (field, value) in cases.flat_map(|case| sequence_values_of(&case)) {
            values.entry(field).or_default().insert(value);
        }
        values
    }

    /// Each configuration hits exactly the bins declared for it: none is beyond reach, and none is
    /// undeclared.
    #[test]
    fn configurations_hit_these_bins_and_no_others() {
        for domain in Domain::ALL {
            let witnesses = witnesses(domain);
            for (partitioning, split) in
                Partitioning::ALL.into_iter().flat_map(|p| SplitOrder::ALL.map(|split| (p, split)))
            {
                let config = Config { partitioning, output: OutputPrimitive::Line, split };
                let mut hit = BTreeSet::new();
                let cases = witnesses.iter().map(|&factors| Case { config, factors });
                cases.clone().for_each(|case| observe(&case, |bin| _ = hit.insert(bin)));
                for (field, values) in values_of(cases) {
                    for before in &values {
                        let after = values.iter();
                        hit.extend(after.map(|value| format!("sequence/{field}/{before}/{value}")));
                    }
                }
                let declared: BTreeSet<String> = of([(domain, config)]).into_iter().collect();
                let beyond: Vec<_> = hit.difference(&declared).collect();
                let never: Vec<_> = declared.difference(&hit).collect();
                assert!(beyond.is_empty(), "{domain:?} {config:?} also hit {beyond:?}");
                assert!(never.is_empty(), "{domain:?} {config:?} never hit {never:?}");
            }
        }
    }

    /// The output changes only the bins that name it.
    #[test]
    fn outputs_differ_in_their_own_bins_alone() {
        for (domain, config) in configurations() {
            let line = Config { output: OutputPrimitive::Line, ..config };
            let name = format!("/{}", config.output.name());
            let renamed = of([(domain, line)]).into_iter().map(|bin| bin.replace("/line", &name));
            // The set restores the alphabetical order.
            let renamed: BTreeSet<String> = renamed.collect();
            let own: BTreeSet<String> = of([(domain, config)]).into_iter().collect();
            assert_eq!(own, renamed, "{domain:?} {config:?}");
        }
    }
}
