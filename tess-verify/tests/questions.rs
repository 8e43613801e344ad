//! Tests of what `tess gen --rules` asks, counted from its lines with arithmetic of their own, and
//! of devices that are wrong in one number, one fraction or one role.

#![expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::float_arithmetic,
    clippy::float_cmp,
    reason = "levels are counted in binary64, which holds them and their fractions exactly"
)]

use std::collections::{BTreeMap, BTreeSet};
use tess_core::{PatchFactors, SplitOrder, Tessellation};
use tess_verify::Case;
use tess_verify::generate::{GenLevel, Selection};
use tess_verify::rules::{Checker, Specification};

/// The role of a level: domain, spacing, split order and position.
type Role = (String, String, String, usize);

/// A case line, taken apart without the library: the role of each level, and its value.
fn levels(line: &str) -> Vec<(Role, f32)> {
    let words: Vec<&str> = line.split(' ').collect();
    let bits = words[5..].iter().map(|word| u32::from_str_radix(word, 16).expect("hex digits"));
    let role = |position| (words[1].into(), words[2].into(), words[4].into(), position);
    bits.enumerate().map(|(position, bits)| (role(position), f32::from_bits(bits))).collect()
}

fn outer_levels(domain: &str) -> usize {
    match domain {
        "isoline" => 2,
        "tri" => 3,
        "quad" => 4,
        other => panic!("{other} is no domain"),
    }
}

/// The number of segments that a level gives in a role.
fn segments((domain, spacing, _, position): &Role, level: f32) -> u32 {
    let is_density = domain == "isoline" && *position == 0;
    let is_inner = *position >= outer_levels(domain);
    let up = f64::from(level).clamp(1.0, 64.0).ceil() as u32;
    let up = if is_inner { up.max(2) } else { up };
    match spacing.as_str() {
        "fractional_odd" if !is_density => (up + (up + 1) % 2).min(63),
        "fractional_even" if !is_density => up + up % 2,
        _ => up,
    }
}

/// What a value is, in words of this test.
fn classes(level: f32) -> Vec<String> {
    let value = f64::from(level);
    let mut found = Vec::new();
    let mut note = |is: bool, name: &str| found.extend(is.then(|| name.to_owned()));
    note(level.is_nan(), "nan");
    note(value == f64::INFINITY, "infinity");
    note(value == f64::NEG_INFINITY, "-infinity");
    note(level.is_subnormal() && value > 0.0, "denormal");
    note(level.is_subnormal() && value < 0.0, "negative denormal");
    note(value < -0.5 && level.is_finite(), "negative");
    note(level.to_bits() == 0, "0");
    note(level.to_bits() == 1 << 31, "-0");
    note(level.is_normal() && value > 0.0 && value < 1.0, "below 1");
    note(value == 64.0, "64");
    note(value > 64.0 && value <= 128.0, "up to 128");
    note(value > 1e6 && level.is_finite(), "far above");
    if !(1.0..64.0).contains(&value) {
        return found;
    }
    let binade = (level.to_bits() >> 23) - 127;
    let units = value * 65536.0;
    let (above, part) = (value.fract(), units.fract());
    for (is, name) in [
        (above == 0.0, "integer"),
        (above == 1.0 / 65536.0, "one unit"),
        (level.next_down().fract() == 0.0, "next number"),
        (level.next_up().fract() == 0.0, "number before"),
        (0.15 < above && above < 0.3, "a fifth"),
        (0.45 < above && above < 0.55, "a half"),
        (0.65 < above && above < 0.75, "seven tenths"),
        (0.98 < above && above < 0.995, "0.99"),
        (0.1 < part && part < 0.4, "a part of a unit"),
        (0.4 < part && part < 0.5, "below half a unit"),
        (part == 0.5, "half a unit"),
        (0.5 < part && part < 0.6, "above half a unit"),
        (0.6 < part && part < 0.7, "above 0.6 of a unit"),
        (0.7 < part && part < 1.0, "most of a unit"),
    ] {
        if is {
            found.push(format!("{name} in binade {binade}"));
        }
    }
    found
}

fn cases(split: Option<SplitOrder>) -> Vec<Case> {
    Selection { split, ..Selection::level(GenLevel::Rules, 1) }.cases().collect()
}

/// The classes that a role must have. From 16, a unit has too few numbers for two of them, and from
/// 32 for three.
fn wanted_classes() -> BTreeSet<String> {
    let unusual = "nan,infinity,-infinity,denormal,negative denormal,negative,0,-0,below 1,64,\
                   up to 128,far above";
    let fractions = "integer,one unit,next number,number before,a fifth,a half,seven tenths,0.99,\
                     a part of a unit,below half a unit,half a unit,above half a unit,\
                     above 0.6 of a unit,most of a unit";
    let mut all: BTreeSet<String> = unusual.split(',').map(str::to_owned).collect();
    for binade in 0..6 {
        all.extend(fractions.split(',').map(|name| format!("{name} in binade {binade}")));
    }
    for name in ["below half a unit", "above half a unit"] {
        all.retain(|own| own.strip_prefix(name).is_none_or(|rest| !rest.ends_with(['4', '5'])));
    }
    all.remove("above 0.6 of a unit in binade 5");
    all
}

/// Every number of segments and every class of value is asked in each role of each domain and
/// spacing, in each split order that is asked for.
#[test]
fn every_number_and_class_is_asked_in_every_role() {
    for (split, orders) in [(None, 2), (Some(SplitOrder::Ruler), 1), (Some(SplitOrder::Centre), 1)]
    {
        let mut numbers: BTreeMap<Role, BTreeSet<u32>> = BTreeMap::new();
        let mut values: BTreeMap<Role, BTreeSet<String>> = BTreeMap::new();
        for case in cases(split) {
            let line = case.to_string();
            let levels = levels(&line);
            let is_drawn = levels.iter().all(|((domain, _, _, position), level)| {
                *position >= outer_levels(domain) || *level > 0.0
            });
            let is_one = levels.iter().all(|(_, level)| level.is_nan() || *level <= 1.0);
            for (role, level) in &levels {
                values.entry(role.clone()).or_default().extend(classes(*level));
                let is_inner = role.3 >= outer_levels(&role.0);
                if is_drawn && !level.is_nan() && !(is_inner && is_one) {
                    numbers.entry(role.clone()).or_default().insert(segments(role, *level));
                }
            }
        }
        assert_eq!(numbers.len(), orders * 4 * (2 + 4 + 6), "roles, with pow2: {split:?}");
        let (classes, mut without_pow2) = (wanted_classes(), 0);
        for (role, found) in &numbers {
            let (domain, spacing, _, position) = role;
            let is_inner = *position >= outer_levels(domain);
            let is_density = domain == "isoline" && *position == 0;
            let wanted: BTreeSet<u32> = match spacing.as_str() {
                "pow2" => [1, 2, 4, 8, 16, 32, 64].into(),
                _ if is_density => (1..=64).collect(),
                "integer" => (1..=64).collect(),
                "fractional_odd" => (1..=63).step_by(2).collect(),
                _ => (2..=64).step_by(2).collect(),
            };
            let wanted = wanted.into_iter().filter(|n| !is_inner || *n > 1);
            let missing: Vec<_> = wanted.filter(|n| !found.contains(n)).collect();
            assert!(missing.is_empty(), "{role:?}: {missing:?} segments");
            if spacing != "pow2" {
                without_pow2 += 1;
                let missing: Vec<_> = classes.difference(&values[role]).collect();
                assert!(missing.is_empty(), "{role:?}: {missing:?}");
            }
        }
        assert_eq!(without_pow2, orders * 3 * (2 + 4 + 6), "roles with every class: {split:?}");
    }
}

/// The same case with another level in a position.
fn with_level(case: &Case, position: usize, level: f32) -> Case {
    let own: Vec<f32> = case.factors.iter().collect();
    let at = |p: usize| if p == position { level } else { own[p] };
    Case { factors: PatchFactors::from_fn(case.domain(), at), ..*case }
}

/// Whether a device breaks a rule of a standard more often than the model does.
fn is_broken<'a>(
    specification: Specification,
    cases: impl IntoIterator<Item = &'a Case>,
    device: impl Fn(&Case) -> Tessellation,
) -> bool {
    let mut checkers = [Checker::new(specification), Checker::new(specification)];
    for case in cases {
        checkers[0].add(case, &device(case));
        checkers[1].add(case, &case.patch().tessellate());
    }
    let [device, model] = checkers.map(|checker| checker.broken().map(|(_, n)| n).sum::<u64>());
    device > model
}

/// The cases that have a level for which `is_it` is true, by role.
fn by_role<K: Ord>(
    cases: &[Case],
    kind: impl Fn(&Role, f32) -> Option<K>,
) -> BTreeMap<(Role, K), Vec<Case>> {
    let mut found: BTreeMap<(Role, K), Vec<Case>> = BTreeMap::new();
    for case in cases {
        for (role, level) in levels(&case.to_string()) {
            if let Some(kind) = kind(&role, level) {
                found.entry((role, kind)).or_default().push(*case);
            }
        }
    }
    found
}

/// A device that gives another number of segments for one number, in one role of one domain and
/// spacing, is seen by Vulkan's rules and by Direct3D's.
#[test]
#[ignore = "slow: a device for each number of each role"]
fn one_wrong_number_is_seen() {
    let cases = cases(Some(SplitOrder::Ruler));
    let roles = by_role(&cases, |role, level| (level > 0.0).then(|| segments(role, level)));
    let mut planted = 0;
    for ((role, n), cases) in roles {
        let (domain, spacing, _, position) = &role;
        // The next number of the spacing, or the one before.
        let step = if spacing.starts_with("fractional") { 2 } else { 1 };
        let level = if n + step <= 64 { n + step } else { n - step };
        let wrong = f32::from(u16::try_from(level).expect("at most 64"));
        let is_wrong = |case: &Case| {
            let own = levels(&case.to_string()).swap_remove(*position).1;
            own > 0.0 && segments(&role, own) == n
        };
        let device = |case: &Case| match is_wrong(case) {
            true => with_level(case, *position, wrong).patch().tessellate(),
            false => case.patch().tessellate(),
        };
        let shows = |case: &&Case| device(case) != case.patch().tessellate();
        let few: Vec<Case> = cases.iter().filter(shows).take(6).copied().collect();
        let name = format!("{domain} {spacing} {position}, {n} segments as {level}");
        assert!(!few.is_empty(), "{name}: no case shows it");
        assert!(is_broken(Specification::D3d11, &few, device), "{name}: Direct3D's rules hold");
        if spacing != "pow2" {
            assert!(is_broken(Specification::Vulkan, &few, device), "{name}: Vulkan's rules hold");
        }
        planted += 1;
    }
    assert!(planted > 1500, "{planted} devices");
}

/// A device that truncates when it converts to 16 fraction bits is off by one unit, where Direct3D
/// allows 0.6. It is seen in each role, also if it does so in one binade only.
#[test]
fn a_conversion_that_truncates_is_seen() {
    let cases = cases(Some(SplitOrder::Ruler));
    let binade = |role: &Role, level: f32| {
        let is_density = role.0 == "isoline" && role.3 == 0;
        let is_fractional = role.1.starts_with("fractional") && !is_density;
        let part = (f64::from(level) * 65536.0).fract();
        let is_moved = is_fractional && (1.0..64.0).contains(&level) && part > 0.6;
        is_moved.then(|| level.to_bits() >> 23)
    };
    let mut planted = 0;
    for ((role, binade), cases) in by_role(&cases, binade) {
        let position = role.3;
        let truncated = |case: &Case| {
            let level = levels(&case.to_string()).swap_remove(position).1;
            let units = (f64::from(level) * 65536.0).floor();
            with_level(case, position, (units / 65536.0) as f32).patch().tessellate()
        };
        let shows = |case: &&Case| truncated(case) != case.patch().tessellate();
        let few: Vec<Case> = cases.iter().filter(shows).take(3).copied().collect();
        let is_low = role.1 == "fractional_even" && binade == 127;
        if is_low {
            continue; // Levels below 2 count as 2.
        }
        assert!(!few.is_empty(), "{role:?}, binade {binade}: no case shows it");
        assert!(is_broken(Specification::D3d11, &few, truncated), "{role:?}, binade {binade}");
        planted += 1;
    }
    assert_eq!(planted, (6 + 5) * (1 + 4 + 6), "each binade of each role and spacing");
}

/// A device that keeps outer factors in four registers, and tests all of them before it culls.
fn culled_by_registers(cases: &[Case]) -> Vec<(Case, Tessellation)> {
    let mut registers = [1f32; 4];
    let mut answer = |case: &Case| {
        case.factors.outer().zip(&mut registers).for_each(|(factor, own)| *own = factor);
        match registers.iter().all(|factor| *factor > 0.0) {
            true => case.patch().tessellate(),
            false => Tessellation::default(),
        }
    };
    cases.iter().map(|case| (*case, answer(case))).collect()
}

#[test]
#[ignore = "slow: every question"]
fn a_value_left_in_a_register_is_seen() {
    let judged = |cases: &[Case]| {
        let mut checker = Checker::new(Specification::Vulkan);
        let discard = |checker: &Checker| {
            let mut rules = checker.broken();
            rules.find(|(rule, _)| tess_verify::Named::name(*rule) == "discard").expect("a rule").1
        };
        for (case, output) in culled_by_registers(cases) {
            checker.add(&case, &output);
        }
        discard(&checker)
    };
    let cases = cases(Some(SplitOrder::Ruler));
    // Each value that discards: of a quad's third factor before isolines, of its fourth before
    // isolines and a triangle, and of a triangle's third before isolines.
    let discards = [0.0, -0.0, -1.0, f32::NEG_INFINITY, f32::NAN].len() as u64;
    assert_eq!(judged(&cases), discards * (1 + 2 + 1), "patches culled by what another left");
    let one: Vec<Case> =
        Selection { random: Some(0), ..Selection::level(GenLevel::One, 1) }.cases().collect();
    let different = culled_by_registers(&one).into_iter();
    let different = different.filter(|(case, answer)| *answer != case.patch().tessellate());
    assert!(different.count() > 10, "level 1 shows it without its random cases");
}

/// Every number on an edge is asked with every number inside, of triangles and of quads, and quads
/// are asked for each number in both directions, in each split order that is asked for.
#[test]
fn every_pair_of_numbers_is_asked_at_an_edge() {
    for (split, orders) in [(None, 2), (Some(SplitOrder::Ruler), 1), (Some(SplitOrder::Centre), 1)]
    {
        let mut pairs: BTreeMap<(String, String), BTreeSet<[u32; 2]>> = BTreeMap::new();
        let mut squares = BTreeSet::new();
        for case in cases(split) {
            let levels = levels(&case.to_string());
            let (domain, _, order, _) = levels[0].0.clone();
            let edges = outer_levels(&domain);
            let is_drawn = levels[..edges].iter().all(|(_, level)| *level > 0.0);
            let has_inside = levels.iter().all(|(_, level)| !level.is_nan())
                && levels.iter().any(|(_, level)| *level > 1.0);
            if domain == "isoline" || !is_drawn || !has_inside || case.primitive_size() != 3 {
                continue;
            }
            let numbers: Vec<u32> = levels.iter().map(|(role, own)| segments(role, *own)).collect();
            let own = pairs.entry((domain.clone(), order.clone())).or_default();
            // A quad's edges u = 0 and u = 1 run along v, the others along u.
            let inside = |edge: usize| match domain.as_str() {
                "tri" => numbers[3],
                _ => numbers[5 - edge % 2],
            };
            own.extend((0..edges).map(|edge| [numbers[edge], inside(edge)]));
            if domain == "quad" && numbers[4] == numbers[5] {
                squares.insert((order, numbers[4]));
            }
        }
        assert_eq!(pairs.len(), 2 * orders, "{split:?}");
        for (place, found) in pairs {
            assert_eq!(found.len(), 64 * 63, "{place:?}: edges from 1, insides from 2");
        }
        assert_eq!(squares.len(), orders * 63, "{split:?}");
    }
}
