//! Everything that the shaders write against the golden model, on whatever adapter there is.

mod common;

use common::device::{Machine, Written};
use common::expected::{Expected, point_words};
use common::{all_configs, patches::random};
use tess_check::random::SplitMix64;
use tess_core::{DomainPoint, PatchFactors};
use tess_gpu::Setup;
use tess_simd::{Batch, Numbering, Output, Tessellator};

/// Random patches of each configuration, through the whole pipeline.
#[test]
fn random_patches_in_every_configuration() {
    let mut machine = Machine::open();
    let mut numbers = SplitMix64::new(1);
    for (domain, config) in all_configs() {
        assert_both_equal(
            &mut machine,
            Setup::new(domain, config),
            &random(domain, 300, &mut numbers),
        );
    }
}

/// Compares with the golden model and, on its own, with the CPU backend.
fn assert_both_equal(machine: &mut Machine, setup: Setup, patches: &[PatchFactors]) {
    let expected = Expected::new(setup, patches);
    let (point_words, index_words) = expected.words();
    let written = machine.write(setup, patches, point_words, index_words);
    if let Err(difference) = expected.compare(&written) {
        panic!("{setup:?}, model: {difference}");
    }
    assert!(is_simd(setup, patches, &written), "{setup:?}: differs from tess-simd");
}

/// Whether tess-simd tessellates the patches to this.
fn is_simd(setup: Setup, patches: &[PatchFactors], written: &Written) -> bool {
    let (mut isolines, mut triangles, mut quads) = (Vec::new(), Vec::new(), Vec::new());
    for patch in patches {
        match *patch {
            PatchFactors::Isoline(factors) => isolines.push(factors),
            PatchFactors::Triangle(factors) => triangles.push(factors),
            PatchFactors::Quad(factors) => quads.push(factors),
        }
    }
    let batch = match patches.first() {
        Some(PatchFactors::Isoline(_)) => Batch::Isolines(&isolines),
        Some(PatchFactors::Triangle(_)) => Batch::Triangles(&triangles),
        _ => Batch::Quads(&quads),
    };
    let mut output = Output::<DomainPoint, u32>::new();
    let mut tessellator = Tessellator::new(setup.config);
    let numbering = Numbering::Batch { base_vertex: 0 };
    tessellator.tessellate(batch, numbering, &mut output).expect("it fits");
    let mut points = Vec::new();
    for (number, range) in (0..).zip(output.ranges()) {
        let own = &output.points()[range.first_point as usize..][..range.points as usize];
        let words = |&point: &DomainPoint| point_words(setup.point_format, point, number);
        points.extend(own.iter().flat_map(words));
    }
    let indices = output.indices();
    let (all, rest) = written.indices.split_at(indices.len().min(written.indices.len()));
    points == written.points && indices == all && rest.len() < 2
}

#[test]
fn another_output_is_not_that_of_tess_simd() {
    let mut machine = Machine::open();
    let (domain, config) = all_configs()[90];
    let setup = Setup::new(domain, config);
    let patches = random(domain, 20, &mut SplitMix64::new(9));
    let (point_words, index_words) = Expected::new(setup, &patches).words();
    let written = machine.write(setup, &patches, point_words, index_words);
    assert!(is_simd(setup, &patches, &written), "equal");
    for change in [
        |written: &mut Written| written.points[40] ^= 1,
        |written: &mut Written| written.indices[30] ^= 1,
    ] {
        let mut other = machine.write(setup, &patches, point_words, index_words);
        change(&mut other);
        assert!(!is_simd(setup, &patches, &other), "one bit differs");
    }
}
