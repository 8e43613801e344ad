//! The first device, which is lavapipe in continuous integration. It is exact except for denormals,
//! and a wrong evaluation shader is found and explained.

#![expect(clippy::print_stderr, reason = "a test that cannot run says so")]

use std::process::Command;
use tess_core::{Domain, Partitioning};
use tess_probe::{ProbeReport, Prober, cases, list, probe};
use tess_verify::Case;
use tess_verify::check::{Denormals, ListOrder, Strength};
use tess_verify::generate::{GenLevel, Selection, Shard};

const SHADERS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/shaders");

fn some(count: u64) -> Vec<Case> {
    let selection = Selection { random: Some(count), ..Selection::level(GenLevel::Three, 5) };
    cases(selection, Shard::WHOLE)
}

fn is_lavapipe(prober: &Prober) -> bool {
    prober.info().name.starts_with("llvmpipe")
}

fn in_any_order() -> Strength {
    Strength { order: ListOrder::Any, denormals: Denormals::Flush, ..Strength::default() }
}

fn report(prober: &mut Prober, cases: &[Case], strength: Strength) -> ProbeReport {
    let report = probe(prober, cases, strength, |_| {}).expect("the device works");
    assert_eq!(report.patches, cases.len() as u64, "every patch is compared");
    report
}

#[test]
fn devices_are_listed() {
    let devices = list().expect("the tests have a Vulkan driver");
    assert!(!devices.is_empty() && devices[0].number == 0, "{devices:?}");
    let text = devices[0].to_string();
    assert!(text.starts_with("0: ") && text.contains(&devices[0].driver), "{text}");
}

#[test]
fn the_device_is_exact() {
    let mut prober = Prober::open(0).expect("the tests have a Vulkan driver");
    let order = if is_lavapipe(&prober) { ListOrder::Sequence } else { ListOrder::Any };
    let strength = Strength { order, ..in_any_order() };
    let report = report(&mut prober, &some(1500), strength);
    assert_eq!((report.different, report.unexplained.patches), (0, 0), "{report}");
    assert_eq!(report.rows.len(), 4 * (2 + 3 + 3), "every configuration of Vulkan");
}

/// Shards are disjoint, and together they are everything.
#[test]
fn shards_are_parts() {
    let selection = Selection { random: Some(100), ..Selection::level(GenLevel::Three, 5) };
    let part = |part| cases(selection, Shard { part, of: 3 });
    let all: usize = (0..3).map(|i| part(i).len()).sum();
    assert_eq!(all, cases(selection, Shard::WHOLE).len());
    assert!(part(0).iter().all(|case| !part(1).contains(case)), "no case is in two");
}

#[test]
fn domain_points_alone_are_exact() {
    let mut prober = Prober::open_for_points(0).expect("it stores from vertex stages");
    let report = report(&mut prober, &some(600), in_any_order());
    assert_eq!((report.method, report.different), ("points", 0), "{report}");
}

/// The evaluation shader moves domain points by one unit of 2^-16.
#[test]
fn a_wrong_shader_is_found_and_explained() {
    let text = std::fs::read_to_string(format!("{SHADERS}/capture.tese")).expect("it is there");
    let right = "floatBitsToUint(gl_TessCoord)";
    let wrong = "floatBitsToUint(gl_TessCoord + vec3(gl_TessCoord.x < 0.5 ? 0.0000152587890625 : 0.0, 0.0, 0.0))";
    assert!(text.contains(right), "{text}");
    let Some(spirv) = compiled("capture.tese", &text.replace(right, wrong)) else { return };
    let mut prober =
        Prober::open(0).expect("the tests have a Vulkan driver").with_evaluation(&spirv);
    let selection = Selection {
        domain: Some(Domain::Quad),
        partitioning: Some(Partitioning::FractionalEven),
        random: Some(40),
        ..Selection::level(GenLevel::Three, 5)
    };
    let report = report(&mut prober, &cases(selection, Shard::WHOLE), in_any_order());
    assert!(report.different > 20, "{report}");
    assert!(report.rows.iter().all(|row| row.coordinates == 0 || row.max_units == 1), "{report}");
    let first = report.unexplained.first.as_ref().expect("no freedom moves points");
    assert_eq!(first.stage, "location", "{report}");
    assert!(report.to_string().contains(&first.command), "{report}");
}

/// The SPIR-V next to each shader is what its GLSL compiles to.
#[test]
fn shaders_are_as_compiled() {
    let entries = std::fs::read_dir(SHADERS).expect("it is there").filter_map(Result::ok);
    let names = entries.filter_map(|entry| entry.file_name().into_string().ok());
    let mut compared = 0;
    for name in names.filter(|name| !name.ends_with(".spv") && !name.ends_with(".glsl")) {
        let text = std::fs::read_to_string(format!("{SHADERS}/{name}")).expect("it is there");
        let Some(anew) = compiled(&name, &text) else { return };
        let kept = std::fs::read(format!("{SHADERS}/{name}.spv")).expect("it is there");
        let again = "glslangValidator -V --target-env vulkan1.1 FILE -o FILE.spv makes it again";
        assert!(anew == kept, "{name}.spv is not what {name} compiles to; {again}");
        compared += 1;
    }
    assert!(compared >= 7, "{compared} shaders");
}

/// A compiled shader. Without a compiler it is `None`, with a note on stderr, except in continuous
/// integration.
fn compiled(name: &str, text: &str) -> Option<Vec<u8>> {
    let stage = name.rsplit_once('.').map_or(name, |(_, stage)| stage);
    // Other processes may run the same test.
    let folder = tempfile::tempdir_in(env!("CARGO_TARGET_TMPDIR")).expect("a folder");
    let (source, binary) = (folder.path().join(name), folder.path().join("compiled.spv"));
    std::fs::write(&source, text).expect("the folder can be written");
    let mut compiler = Command::new("glslangValidator");
    compiler.args(["-V", "--target-env", "vulkan1.1", "-S", stage]).arg(format!("-I{SHADERS}"));
    let output = match compiler.arg(&source).arg("-o").arg(&binary).output() {
        Ok(output) => output,
        Err(error) => {
            assert!(std::env::var_os("CI").is_none(), "glslangValidator: {error}");
            eprintln!("not run, missing: glslangValidator");
            return None;
        }
    };
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stdout));
    Some(std::fs::read(binary).expect("it was written"))
}
