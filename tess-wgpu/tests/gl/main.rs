//! wgpu's OpenGL backend has the results of the other backends: batches that equal the model's, the
//! stage's triangles, and errors if OpenGL lacks something.
//!
//! If no OpenGL gives a device, the tests are reported as ignored, with the reason; if the
//! environment variable `CI` is set, they fail.

#![expect(clippy::float_arithmetic, reason = "pixels and factors are floats")]

mod batches;
#[path = "../stage/both.rs"]
mod both;
mod choice;
#[path = "../common/mod.rs"]
mod common;
#[allow(dead_code, reason = "every pixel is compared")]
#[path = "../stage/model.rs"]
mod model;
mod pictures;
#[allow(dead_code, reason = "the other devices' scenes are not drawn")]
#[path = "../stage/scene.rs"]
mod scene;

use libtest_mimic::{Arguments, Failed, Trial};
use tess_wgpu::Gpu;

const LARGE_BATCH: &str = "a_large_batch_equals_the_model";
const PICTURES: &str = "the_stage_draws_the_models_triangles";

type Test = fn(Gpu);

const TESTS: &[(&str, Test)] = &[
    ("small_batches_equal_the_model", batches::small_ones_equal_the_model),
    (LARGE_BATCH, batches::a_large_one_equals_the_model),
    ("planted_faults_are_seen", batches::planted_faults_are_seen),
    (PICTURES, pictures::every_way_to_draw),
    ("flat_members_of_the_first_vertex_are_refused", pictures::flat_members_are_refused),
];

/// The tests that need another environment, in processes of their own. Mesa can be asked to offer
/// less than it has.
const OF_MESA: &[(&str, fn())] = &[
    ("opengl_is_the_last_choice", choice::opengl_is_last),
    ("what_is_lacking_is_said", choice::what_is_lacking_is_said),
    ("opengl_es_equals_the_model", choice::opengl_es_equals_the_model),
];

fn main() {
    if choice::is_asked() {
        return choice::answer();
    }
    let opened = pollster::block_on(open());
    let is_mesa = opened.as_ref().is_ok_and(|gpu| gpu.info.driver_info.contains("Mesa"));
    let lacking = opened.err();
    let all = TESTS.iter().map(|&(name, test)| {
        trial(name, lacking.clone(), move || test(pollster::block_on(open()).expect("as before")))
    });
    let lacking = lacking.clone().or((!is_mesa).then(|| "the driver is not Mesa".to_owned()));
    let of_mesa = OF_MESA.iter().map(|&(name, test)| trial(name, lacking.clone(), test));
    // One after the other: Mesa does not promise that contexts in several threads are safe.
    let arguments = Arguments { test_threads: Some(1), ..Arguments::from_args() };
    libtest_mimic::run(&arguments, all.chain(of_mesa).collect()).exit();
}

/// A test, or the report that something is lacking for it.
fn trial(name: &str, lacking: Option<String>, test: impl FnOnce() + Send + 'static) -> Trial {
    let Some(lacking) = lacking else {
        return Trial::test(name, move || {
            test();
            Ok(())
        });
    };
    let failure = Failed::from(&lacking);
    Trial::test(name, move || Err(failure))
        .with_kind(format!("not run: {lacking}"))
        .with_ignored_flag(std::env::var_os("CI").is_none())
}

/// A device of OpenGL, made as by a program that does not use tess-wgpu to open it.
async fn open() -> Result<Gpu, String> {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = wgpu::Backends::GL;
    let instance = wgpu::Instance::new(descriptor);
    let adapter = instance.request_adapter(&Default::default()).await;
    let adapter = adapter.map_err(|error| error.to_string())?;
    let opened = adapter.request_device(&Default::default()).await;
    let (device, queue) = opened.map_err(|error| error.to_string())?;
    Ok(Gpu { device, queue, info: adapter.get_info() })
}
