//! Compares the formulas with the plan, and compiles every language with a compiler that is not
//! naga.

use super::formula::{Formula, Term};
use super::languages::Read;
use super::manifest::Kind;
use super::plan::{self, Count, Variant};
use super::translation::{Checks, Layout, Target, Translation};
use super::{Shaders, header};
use std::collections::HashSet;
use std::mem::offset_of;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning};
use tess_gpu::layout::Job;
use tess_gpu::surfaces::MODULES;
use tess_gpu::{Capacity, IndexType, Limits, Numbering, Plan, Setup, Workgroups};
use tess_verify::generate::{SplitMix64, configurations};

fn setups() -> impl Iterator<Item = Setup> {
    configurations().map(|(domain, config)| Setup::new(domain, config))
}

fn small() -> Setup {
    Setup::new(Domain::Quad, Config::new(Partitioning::Pow2, OutputPrimitive::Line))
}

/// The manifest's description of a batch equals the plan's under a device's limits.
#[test]
fn the_manifest_says_what_the_plan_says() {
    let mut random = SplitMix64::new(7);
    for setup in setups() {
        let variants = plan::variants(setup);
        for _ in 0..40 {
            let patches = 1 + random.below(70_000);
            let room = [1 + random.below(200_000), 1 + random.below(200_000)];
            let workgroups = 1 << random.below(17);
            compare(setup, &variants, [patches, room[0], room[1], workgroups]);
        }
    }
}

/// The value of a formula for a batch.
fn value(formula: &Formula, batch: [u32; 4]) -> u64 {
    let term = |term: &Term| term.times * u64::from(batch[term.of as usize].div_ceil(term.per));
    let sum = formula.constant + formula.terms.iter().map(term).sum::<u64>();
    sum.next_multiple_of(formula.multiple)
}

fn compare(setup: Setup, variants: &[Variant], batch: [u32; 4]) {
    let [patches, points, primitives, workgroups] = batch;
    let limits = Limits { storage_binding: 128 << 20, workgroups };
    let room = Capacity { points, primitives };
    let plan = Plan::in_long_stages(setup, patches, room, limits);
    let mut own = variants.iter().filter(|v| (v.min_patches..=v.max_patches).contains(&patches));
    let variant = own.next().expect("every number of patches has a plan");
    assert!(own.next().is_none(), "{patches} patches have one plan");
    for buffer in &variant.buffers {
        let bytes = plan.buffer_size(buffer.resource);
        assert_eq!(value(&buffer.bytes, batch), bytes, "{:?} of {batch:?}", buffer.resource);
    }
    let all: Vec<_> = plan.dispatches().collect();
    assert_eq!(variant.dispatches.len(), all.len(), "dispatches of {batch:?}");
    for (said, dispatch) in variant.dispatches.iter().zip(&all) {
        assert_eq!((said.stage, said.job), (dispatch.stage(), dispatch.job()), "{batch:?}");
        assert_eq!(said.bindings.len(), dispatch.bindings().len(), "{dispatch:?}");
        for (bound, (resource, span)) in said.bindings.iter().zip(dispatch.bindings()) {
            let (offset, bytes) = (value(&bound.offset, batch), value(&bound.bytes, batch));
            assert_eq!((bound.resource, offset, bytes), (resource, span.offset, span.size));
        }
        let count = match &said.workgroups {
            Count::Direct(count) => {
                let count = u32::try_from(value(count, batch)).expect("a number of workgroups");
                let x = count.min(workgroups);
                Workgroups::Direct([x, count.div_ceil(x), 1])
            }
            Count::IndirectAt(at) => Workgroups::Indirect(value(at, batch)),
        };
        assert_eq!(count, dispatch.workgroups(), "{dispatch:?}");
    }
    let jobs = plan.jobs();
    assert_eq!(variant.jobs.len() * 256, jobs.len(), "jobs of {batch:?}");
    for (job, words) in jobs.chunks(256).zip(&variant.jobs) {
        let written = words.iter().map(|word| value(word, batch));
        let read = job.as_chunks().0.iter().map(|bytes| u32::from_le_bytes(*bytes));
        assert_windows(read.zip(written), words.len(), batch);
    }
}

/// The words of a job, without the tiles of a window, which only tell windows apart.
fn assert_windows(pairs: impl Iterator<Item = (u32, u64)>, words: usize, batch: [u32; 4]) {
    const WINDOW_TILES: [usize; 3] = [
        offset_of!(Job, window_tiles) / 4,
        offset_of!(Job, point_window_tiles) / 4,
        offset_of!(Job, primitive_window_tiles) / 4,
    ];
    for (number, (plan, manifest)) in pairs.take(words).enumerate() {
        let plan = u64::from(plan);
        if WINDOW_TILES.contains(&number) {
            assert!(plan == 0 && manifest == 0 || plan > 0 && manifest >= plan, "word {number}");
        } else {
            assert_eq!(plan, manifest, "word {number} of {batch:?}");
        }
    }
}

/// Every language can express every stage of every configuration, and no writer needs constants
/// from the host that the manifest lacks. The result depends only on a stage's source, which many
/// configurations share, so each source is written once.
#[test]
fn every_language_has_words_for_every_stage() {
    let mut sources = HashSet::new();
    for (number, setup) in setups().enumerate() {
        let index_type = if number % 2 == 0 { IndexType::U32 } else { IndexType::U16 };
        let setup = Setup { numbering: Numbering::PerPatch, index_type, ..setup };
        for stage in tess_gpu::Stage::ALL {
            if sources.insert((stage.entry_point(), stage.source(setup))) {
                every_language_has_words(stage, setup);
            }
        }
    }
    assert!(sources.len() > 100, "{} sources", sources.len());
}

fn every_language_has_words(stage: tess_gpu::Stage, setup: Setup) {
    let read = Read::new(stage, setup).expect("it is valid");
    for target in [Target::Glsl, Target::Hlsl, Target::Msl, Target::Spirv] {
        for checks in [Checks::Full, Checks::None] {
            let translation = Translation { target, layout: Layout::Plain, checks };
            let written = translation.write_read(&read).expect("it has words");
            let text = String::from_utf8_lossy(&written.text);
            assert!(!text.contains("NagaConstants"), "{target:?} {stage:?}");
            // HLSL has no number of workgroups; naga would write the workgroup's own number twice.
            let ids = text.matches("SV_GroupID").count();
            assert!(ids <= 1, "{target:?} {stage:?} asks for the number of workgroups");
        }
    }
}

#[test]
fn the_header_has_what_the_manifest_has() {
    let translation =
        Translation { target: Target::Spirv, layout: Layout::Plain, checks: Checks::Full };
    let shaders = Shaders::new(small(), translation).expect("it can be written");
    let text = header::text(&shaders.manifest);
    for stage in &shaders.manifest.stages {
        assert!(text.contains(&format!("\"{}\"", stage.file)), "{}", stage.file);
    }
    for structure in ["struct tess_job {", "struct tess_status {", "struct tess_draw_indexed {"] {
        assert!(text.contains(structure), "{structure}");
    }
    let most_terms = "struct tess_term term[6];";
    assert!(text.contains(most_terms), "the header declares {most_terms}");
    let formulas = shaders.manifest.plans.iter().flat_map(|plan| plan.jobs.iter().flatten());
    assert!(
        formulas.clone().count() > 0 && formulas.into_iter().all(|f| f.terms.len() <= 6),
        "fit"
    );
}

/// The modules for the user's own shaders come with WGSL, and `modules.json` names their files.
#[test]
fn wgsl_comes_with_surfaces() {
    for (target, comes_with) in [(Target::Wgsl, true), (Target::Glsl, false)] {
        let folder = tempfile::tempdir().expect("a folder");
        let translation = Translation { target, layout: Layout::Plain, checks: Checks::Full };
        let shaders = Shaders::new(small(), translation).expect("it can be written");
        shaders.write(folder.path()).expect("written");
        let surfaces = folder.path().join("surfaces");
        assert_eq!(surfaces.exists(), comes_with, "{target:?}");
        if !comes_with {
            continue;
        }
        let read = |name: &str| std::fs::read_to_string(surfaces.join(name)).expect("a file");
        let listed: serde_json::Value = serde_json::from_str(&read("modules.json")).expect("JSON");
        let listed = listed.as_array().expect("a list");
        assert_eq!(listed.len(), MODULES.len(), "every module");
        for (entry, module) in listed.iter().zip(MODULES) {
            assert_eq!(read(entry["file"].as_str().expect("a name")), module.source, "{entry}");
            assert_eq!(
                entry["needs"].as_array().map(Vec::len),
                Some(module.needs.len()),
                "{entry}"
            );
            assert!(read("README.md").contains(&format!("| `{}` |", module.name)), "{entry}");
        }
    }
}

/// What SPIR-V binds: pairs of a set and a binding, in order, from its decorations.
pub(super) fn decorated(bytes: &[u8]) -> Vec<(u32, u32)> {
    let words: Vec<u32> =
        bytes.as_chunks().0.iter().map(|word| u32::from_le_bytes(*word)).collect();
    let (mut at, mut sets, mut bindings) = (5, Vec::new(), Vec::new());
    while at < words.len() {
        let (length, code) = (words[at] >> 16, words[at] & 0xffff);
        // OpDecorate with DescriptorSet or Binding.
        match (code, words.get(at + 2)) {
            (71, Some(34)) => sets.push((words[at + 1], words[at + 3])),
            (71, Some(33)) => bindings.push((words[at + 1], words[at + 3])),
            _ => {}
        }
        at += usize::try_from(length).expect("a length");
    }
    let of = |&(id, set): &(u32, u32)| {
        let (_, binding) = bindings.iter().find(|(other, _)| *other == id)?;
        Some((set, *binding))
    };
    let mut all: Vec<_> = sets.iter().filter_map(of).collect();
    all.sort_unstable();
    all
}

/// With SDL's layout each kind of resource is counted from 0 in its set, in the order of the
/// bindings, and every span is a whole buffer, because SDL binds no parts.
#[test]
fn the_layout_of_sdl_counts_each_kind() {
    let translation =
        Translation { target: Target::Spirv, layout: Layout::Sdl, checks: Checks::Full };
    for setup in setups() {
        let shaders = Shaders::new(setup, translation).expect("it can be written");
        for (number, stage) in shaders.manifest.stages.iter().enumerate() {
            let [mut read, mut written, mut uniform] = [0..8, 0..8, 0..4];
            for binding in &stage.bindings {
                let (set, next) = match (binding.kind, binding.is_written) {
                    (Kind::Uniform, _) => (2, uniform.next()),
                    (Kind::Storage, true) => (1, written.next()),
                    (Kind::Storage, false) => (0, read.next()),
                };
                assert_eq!((binding.set, Some(binding.binding)), (set, next), "{}", stage.name);
            }
            let bound = decorated(&shaders.files[number].1);
            let said = |pair: &(u32, u32)| {
                stage.bindings.iter().any(|one| (one.set, one.binding) == *pair)
            };
            assert!(!bound.is_empty() && bound.iter().all(said), "{}: {bound:?}", stage.name);
        }
        for dispatch in shaders.manifest.plans.iter().flat_map(|plan| &plan.dispatches) {
            let stage = dispatch.stage.entry_point();
            let described = shaders.manifest.stages.iter().find(|one| one.name == stage);
            let bindings = &described.expect("it is described").bindings;
            assert_eq!(bindings.len(), dispatch.bindings.len(), "{stage}: all are declared");
            let partly = |one: &&plan::Bound| one.offset != Formula::from(0);
            let partly: Vec<_> = dispatch.bindings.iter().filter(partly).collect();
            let is_job = |one: &&plan::Bound| one.resource == tess_gpu::Resource::Job;
            assert!(partly.iter().all(is_job), "{stage}: {partly:?}");
        }
    }
}

/// The same places in HLSL and MSL: registers and spaces; uniform buffers, then buffers that are
/// read, then those that are written.
#[test]
fn every_language_has_the_layout_of_sdl() {
    for (target, expected) in [
        (Target::Hlsl, ["(b0, space2)", "(t0)", "(u0, space1)"]),
        (Target::Msl, ["_buffer_sizes [[buffer(1)]]", "[[buffer(0)]]", "[[buffer(2)]]"]),
    ] {
        let translation = Translation { target, layout: Layout::Sdl, checks: Checks::Full };
        let shaders = Shaders::new(small(), translation).expect("it can be written");
        let stages = &shaders.manifest.stages;
        let number = stages.iter().position(|one| one.name == "factors").expect("it runs");
        let text = String::from_utf8_lossy(&shaders.files[number].1);
        assert!(expected.iter().all(|place| text.contains(place)), "{target:?}: {text}");
        let sizes = stages[number].msl_sizes.as_ref().map(|sizes| sizes.buffer);
        assert_eq!(sizes, (target == Target::Msl).then_some(1), "after the job");
    }
}
