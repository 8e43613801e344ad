//! Everything that the shaders write, compared with the golden model on any adapter.

use crate::common::device::{Machine, Written};
use crate::common::expected::{Expected, by_simd};
use crate::common::patches::{all, covering, random};
use tess_core::{Domain, PatchFactors};
use tess_gpu::Setup;
use tess_verify::Case;
use tess_verify::generate::{GenLevel, Selection, SplitMix64, configurations};

#[test]
fn boundaries_and_random_patches_in_every_pair_of_options() {
    assert_equal_in(covering());
}

#[test]
#[ignore = "slow: all 96 configurations"]
fn boundaries_and_random_patches_in_every_configuration() {
    assert_equal_in(all());
}

/// Random patches of each setup, with every boundary value once and the neighbours of minimum
/// patches, through the whole pipeline.
fn assert_equal_in(setups: Vec<Setup>) {
    let mut machine = Machine::open();
    let mut numbers = SplitMix64::new(1);
    let level = Selection { random: Some(0), ..Selection::level(GenLevel::One, 1) };
    let boundaries: Vec<Case> = level.cases().collect();
    for setup in setups {
        let Setup { domain, config, .. } = setup;
        assert_both_equal(&mut machine, setup, &random(domain, 300, &mut numbers));
        let own = boundaries.iter().filter(|case| (case.domain(), case.config) == (domain, config));
        let mut own: Vec<PatchFactors> = own.map(|case| case.factors).collect();
        assert!(!own.is_empty(), "{setup:?} has no boundary");
        own.extend(beside_minimum(domain));
        assert_both_equal(&mut machine, setup, &own);
    }
}

/// Patches whose factors are 1 except for one.
fn beside_minimum(domain: Domain) -> impl Iterator<Item = PatchFactors> {
    let others = [f32::NAN, f32::NEG_INFINITY, -1.0, 0.0, 0.5, 1.000_02, 2.0, 3.0];
    let with = move |position| {
        move |other| PatchFactors::from_fn(domain, |i| if i == position { other } else { 1.0 })
    };
    (0..domain.factors()).flat_map(move |position| others.map(with(position)))
}

/// Compares with the golden model and, separately, with the CPU backend.
fn assert_both_equal(machine: &mut Machine, setup: Setup, patches: &[PatchFactors]) {
    let expected = Expected::new(setup, patches);
    let (point_words, index_words) = expected.words();
    let written = machine.write(setup, patches, point_words, index_words);
    if let Err(difference) = expected.compare(&written) {
        panic!("{setup:?}, model: {difference}");
    }
    let difference = from_simd(setup, patches, &written);
    assert_eq!(difference, None, "{setup:?}");
}

/// The first word that differs from tess-simd's. Other tests compare the model with tess-simd.
fn from_simd(setup: Setup, patches: &[PatchFactors], written: &Written) -> Option<String> {
    let (points, indices) = by_simd(setup, patches);
    let first = |what, [observed, expected]: [&[u32]; 2]| {
        let at = (0..observed.len().max(expected.len()))
            .find(|&i| observed.get(i) != expected.get(i))?;
        let [is, right] = [observed, expected].map(|words| words.get(at));
        Some(format!("{what} word {at} of {} is {is:x?}, of tess-simd {right:x?}", expected.len()))
    };
    let (all, rest) = written.indices.split_at(indices.len().min(written.indices.len()));
    let behind = || (rest.len() > 1).then(|| format!("{} words behind the indices", rest.len()));
    first("point", [&written.points, &points])
        .or_else(|| first("index", [all, &indices]))
        .or_else(behind)
}

#[test]
fn another_output_is_not_that_of_tess_simd() {
    let mut machine = Machine::open();
    let (domain, config) = configurations().nth(90).expect("there are 96");
    let setup = Setup::new(domain, config);
    let patches = random(domain, 20, &mut SplitMix64::new(9));
    let (point_words, index_words) = Expected::new(setup, &patches).words();
    let written = machine.write(setup, &patches, point_words, index_words);
    assert_eq!(from_simd(setup, &patches, &written), None, "equal");
    for (change, named) in [
        ((|written| written.points[40] ^= 1) as fn(&mut Written), "point word 40 of "),
        (|written| written.indices[30] ^= 1, "index word 30 of "),
        (|written| written.indices.extend([0; 2]), "2 words behind the indices"),
    ] {
        let mut other = machine.write(setup, &patches, point_words, index_words);
        change(&mut other);
        let difference = from_simd(setup, &patches, &other).expect("they differ");
        assert!(difference.starts_with(named), "{named}: {difference}");
    }
}
