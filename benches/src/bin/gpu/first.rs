//! Times the first frames of a stage on the host.

use crate::Result;
use std::time::{Duration, Instant};
use tess_core::{Config, Domain, OutputPrimitive, Partitioning};
use tess_wgpu::{DeviceLimits, Gpu, TessellationStage};

const WGSL: &str = "
struct Vertex { @builtin(position) position: vec4f }
fn hull(number: u32) -> QuadFactors { return tess_quad_factors(vec4f(4.0)); }
fn domain(number: u32, uv: vec2f) -> Vertex { return Vertex(vec4f(uv, 0.0, 1.0)); }
";

const PATCHES: u32 = 1000;

/// Prints the host's times in microseconds: of opening a device and building a stage, and of the
/// calls of its first frames. The second device shows what only the process's first one waits for.
pub(crate) fn run() -> Result<()> {
    for device in ["first", "second"] {
        let (gpu, opened) = timed(|| {
            let features = wgpu::Features::empty();
            pollster::block_on(Gpu::open_with(DeviceLimits::Default, features))
        });
        let gpu = gpu?;
        let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
        let builder = TessellationStage::builder(WGSL, Domain::Quad, config, PATCHES);
        let (stage, built) = timed(|| builder.build(&gpu.device));
        let mut stage = stage?;
        let [opened, built] = [opened, built].map(|time| time.as_micros());
        println!("{}, {device} device: open {opened} us, build {built} us", gpu.name());
        println!("frame  prepare   finish   submit");
        for frame in 0..4 {
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            let (prepared, a) = timed(|| stage.prepare(&mut encoder, PATCHES));
            prepared?;
            let (commands, b) = timed(|| encoder.finish());
            let (_, c) = timed(|| gpu.queue.submit([commands]));
            gpu.device.poll(wgpu::PollType::wait_indefinitely())?;
            let [a, b, c] = [a, b, c].map(|time| time.as_micros());
            println!("{frame:5} {a:8} {b:8} {c:8}");
        }
    }
    Ok(())
}

fn timed<T>(work: impl FnOnce() -> T) -> (T, Duration) {
    let start = Instant::now();
    let done = work();
    (done, start.elapsed())
}
