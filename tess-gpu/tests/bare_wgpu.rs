//! Runs the example `bare_wgpu` over the recorded cases: every word that it leaves must equal the
//! record, `tess-core` and `tess-simd`. The README must quote its lines.

#[allow(dead_code, reason = "the tests call what `main` calls")]
#[path = "../examples/bare_wgpu.rs"]
mod bare_wgpu;

use std::fs::File;
use std::io::BufReader;
use std::process::ExitCode;
use tess_core::{Config, Domain, DomainPoint, OutputPrimitive, Partitioning, Patch, PatchFactors};
use tess_gpu::layout::PackedPoint;
use tess_gpu::{Capacity, Resource, Setup};
use tess_simd::{Numbering, Output, Tessellator};
use tess_verify::vectors::{Listing, Record, VectorFile};

type Gpu = (wgpu::Device, wgpu::Queue);

/// A batch's points with the number of their patch, and its indices.
type Words = (Vec<[u32; 2]>, Vec<u32>);

/// A missing adapter is a failure, not a reason to skip.
fn open() -> Gpu {
    let backends = wgpu::Backends::from_env().unwrap_or_default();
    bare_wgpu::open(backends).unwrap_or_else(|reason| panic!("{reason}"))
}

/// The cases of golden/cases.txt: those of one domain and configuration form a batch.
fn batches() -> Vec<(Setup, Vec<Listing>)> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../golden/cases.txt");
    let reader = BufReader::new(File::open(path).expect(path));
    let file = VectorFile::new("cases.txt", reader).unwrap_or_else(|error| panic!("{error}"));
    let mut batches: Vec<(Setup, Vec<Listing>)> = Vec::new();
    for record in file {
        let Record::Listing(listing) = record.unwrap_or_else(|error| panic!("{error}")) else {
            panic!("cases.txt has listings");
        };
        let setup = Setup::new(listing.case.domain(), listing.case.config);
        match batches.iter_mut().find(|(other, _)| *other == setup) {
            Some((_, listings)) => listings.push(listing),
            None => batches.push((setup, vec![listing])),
        }
    }
    batches
}

/// Patches one after another: points with their patch's number, and indices that count from the
/// first point of the batch.
fn joined(patches: impl Iterator<Item = (Vec<DomainPoint>, Vec<u32>)>) -> Words {
    let (mut points, mut indices) = (Vec::new(), Vec::new());
    for (number, (own_points, own_indices)) in (0..).zip(patches) {
        let base = u32::try_from(points.len()).expect("below 2^32");
        points.extend(own_points.iter().map(|&point| PackedPoint::new(point, number).0));
        indices.extend(own_indices.iter().map(|index| base + index));
    }
    (points, indices)
}

fn of_core(setup: Setup, patches: &[PatchFactors]) -> Words {
    joined(patches.iter().map(|&raw| {
        let whole = Patch::new(setup.config, raw).tessellate();
        (whole.points, whole.indices)
    }))
}

fn of_simd(setup: Setup, patches: &[PatchFactors]) -> Words {
    let mut output = Output::<DomainPoint, u32>::new();
    let numbering = Numbering::PerBatch { base_vertex: 0 };
    Tessellator::new(setup.config).tessellate(patches, numbering, &mut output).expect("it fits");
    let numbered = (0..).zip(output.ranges()).flat_map(|(number, range)| {
        let own = &output.points()[range.first_point as usize..][..range.points as usize];
        own.iter().map(move |&point| PackedPoint::new(point, number).0)
    });
    (numbered.collect(), output.indices().to_vec())
}

/// The first word in which the example's buffers differ from the expected contents: output, totals
/// and draw arguments.
fn compare(
    gpu: &Gpu,
    setup: Setup,
    patches: &[PatchFactors],
    expected: &Words,
) -> Result<(), String> {
    let (points, indices) = expected;
    let count = |elements: usize| u32::try_from(elements).expect("below 2^32");
    let draw = [count(indices.len()), 1, 0, 0, 0];
    let primitives = draw[0] / setup.indices_per_primitive();
    // Exact room, but no buffer may be empty.
    let room = Capacity { points: count(points.len()).max(1), primitives: primitives.max(1) };
    let buffers = bare_wgpu::tessellate(gpu, setup, patches, room);
    let status = [count(points.len()), 0, primitives, 0, 0];
    for (resource, expected) in [
        (Resource::Status, status.as_slice()),
        (Resource::Arguments, &draw),
        (Resource::Points, points.as_flattened()),
        (Resource::Indices, indices),
    ] {
        let found = bare_wgpu::read(gpu, &buffers[resource as usize]);
        if let Some(word) =
            (0..expected.len()).find(|&word| found.get(word) != Some(&expected[word]))
        {
            let (found, expected) = (found.get(word), expected[word]);
            let found = found.map(|word| format!("{word} {word:#010x}"));
            return Err(format!(
                "{setup:?}: {resource:?} word {word}: {found:?} instead of {expected} {expected:#010x}"
            ));
        }
    }
    Ok(())
}

#[test]
fn recorded_cases_are_those_of_core_and_simd() {
    let gpu = open();
    let mut cases = 0;
    for (setup, listings) in batches() {
        cases += listings.len();
        let patches: Vec<_> = listings.iter().map(|listing| listing.case.factors).collect();
        let recorded = joined(listings.into_iter().map(|it| (it.output.points, it.output.indices)));
        assert!(of_core(setup, &patches) == recorded, "tess-core, {setup:?}");
        assert!(of_simd(setup, &patches) == recorded, "tess-simd, {setup:?}");
        compare(&gpu, setup, &patches, &recorded)
            .unwrap_or_else(|difference| panic!("{difference}"));
    }
    assert_eq!(cases, 51, "all of golden/cases.txt");
}

/// The patches in another order, and a factor that is larger by 2^-10.
#[test]
fn differences_are_seen() {
    let gpu = open();
    let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
    let setup = Setup::new(Domain::Quad, config);
    let patches = |factors: [f32; 2]| factors.map(|it| PatchFactors::uniform(Domain::Quad, it));
    let expected = of_core(setup, &patches([2.5, 5.25]));
    assert_eq!(compare(&gpu, setup, &patches([2.5, 5.25]), &expected), Ok(()), "the same");
    let larger = f32::from_bits(2.5_f32.to_bits() + (1 << 12));
    for factors in [[5.25, 2.5], [larger, 5.25]] {
        let seen = compare(&gpu, setup, &patches(factors), &expected);
        let is_named = seen.as_ref().is_err_and(|seen| seen.contains("Points word 2:"));
        assert!(is_named, "{factors:?}: {seen:?}");
    }
}

#[test]
fn no_adapter_is_said_and_ends_with_3() {
    let code = |backends| format!("{:?}", bare_wgpu::run(backends));
    let nothing = wgpu::Backends::empty();
    assert_eq!(code(nothing), format!("{:?}", ExitCode::from(3)), "no adapter");
    let backends = wgpu::Backends::from_env().unwrap_or_default();
    assert_eq!(code(backends), format!("{:?}", ExitCode::SUCCESS), "an adapter");
    let error = bare_wgpu::open(nothing).expect_err("there is no such adapter");
    assert!(error.starts_with("no adapter: "), "{error}");
}

/// Every block of the README that is not itself an example occurs in the example.
#[test]
fn the_readme_quotes_the_example() {
    let readme = include_str!("../README.md");
    let example = include_str!("../examples/bare_wgpu.rs");
    let trimmed = |text: &str| text.lines().map(str::trim).collect::<Vec<_>>().join("\n");
    let example = trimmed(example);
    let quotes: Vec<_> = readme.split("```rs\n").skip(1).collect();
    assert!(!quotes.is_empty(), "the README shows the example");
    for quote in quotes {
        let quote = quote.split("```").next().expect("it ends");
        assert!(example.contains(&trimmed(quote)), "examples/bare_wgpu.rs lacks\n{quote}");
    }
}
