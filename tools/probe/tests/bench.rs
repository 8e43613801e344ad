//! The bench runs both ways on this machine's device, and detects shaders with another output.

use naga::valid::{Capabilities, ValidationFlags, Validator};
use tess_core::{Config, OutputPrimitive, Partitioning, PatchFactors, QuadFactors};
use tess_gpu::{Setup, Stage};
use tess_probe::{BenchTimes, Error, bench};
use tess_workloads::{Calls, Workload};

fn workload() -> Workload {
    let factors = QuadFactors { u0: 3.0, v0: 4.0, u1: 5.0, v1: 6.0, inside_u: 4.0, inside_v: 7.0 };
    Workload {
        name: "small".to_owned(),
        config: Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw),
        patches: vec![PatchFactors::from(factors); 100],
        groups: Vec::new(),
        calls: Calls::Batch,
    }
}

fn spirv(source: &str) -> Result<Vec<u8>, String> {
    let module = naga::front::wgsl::parse_str(source).map_err(|error| error.to_string())?;
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
    let info = validator.validate(&module).map_err(|error| error.to_string())?;
    let options = naga::back::spv::Options { lang_version: (1, 3), ..Default::default() };
    let words = naga::back::spv::write_vec(&module, &info, &options, None);
    let words = words.map_err(|error| error.to_string())?;
    Ok(words.iter().flat_map(|word| word.to_le_bytes()).collect())
}

fn run(edit: impl Fn(String) -> String) -> Result<BenchTimes, Error> {
    let shaders = |stage: Stage, setup: Setup| spirv(&edit(stage.source(setup)));
    bench(0, &workload(), 2, &shaders)
}

#[test]
fn every_way_takes_time() {
    let times = run(|source| source).expect("the tests have a Vulkan driver");
    assert_eq!(times.triangles, times.patches / 100 * workload().totals().primitives);
    let all = [times.fixed, times.compute, times.fixed_drawn, times.compute_drawn];
    assert!(all.iter().all(|ms| ms.is_finite() && *ms > 0.0), "{times:?}");
}

#[test]
fn wrong_shaders_are_not_timed() {
    let wrong =
        |source: String| source.replace("primitives * INDICES", "primitives * INDICES - 3u");
    let error = run(wrong).expect_err("a triangle is lost");
    assert!(error.to_string().contains("indices, not"), "{error}");
}
