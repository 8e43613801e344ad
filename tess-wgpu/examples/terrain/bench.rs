//! Measures the times of `prepare` and `draw` for a number of triangles, by the device's
//! timestamps.

use crate::app::{self, Args, Frame, Show};
use crate::terrain::Terrain;
use std::error::Error;
use std::time::Instant;
use tess_wgpu::{DeviceLimits, Gpu, Stopwatch};

/// The picture's width and height in pixels.
const SIZE: [u32; 2] = [960, 720];

/// Runs `--bench FRAMES`, with `--triangles N,N,...`, `--points stored,pull,none` and `--grid N`:
/// prints the median of that number of frames for each combination.
pub(crate) fn run(args: &Args) -> Result<(), Box<dyn Error>> {
    let frames: usize = args.number("bench", 20)?;
    let gpu = pollster::block_on(Gpu::open_with(DeviceLimits::Highest, Stopwatch::FEATURES))?;
    let watch = Stopwatch::new(&gpu).ok();
    let clock = if watch.is_some() { "the device's timestamps" } else { "the host's clock" };
    println!("{} by {clock}, {} x {} pixels", gpu.name(), SIZE[0], SIZE[1]);
    println!("points  triangles  prepare us  draw us  G triangles/s together");
    for word in args.text("points").unwrap_or("stored,pull,none").split(',') {
        for goal in args.text("triangles").unwrap_or("1000000,10000000,50000000").split(',') {
            let goal: f32 = goal.parse()?;
            let own = args.with("points", word).with("bytes", "8000000000");
            let mut bench = Bench::new(&gpu, watch.as_ref(), &own)?;
            let drawn = bench.reach(goal)?;
            let [prepare, draw] = bench.medians(frames.max(1))?;
            let together = drawn as f64 / (prepare + draw);
            let [prepare, draw] = [prepare, draw].map(|time| time / 1e3);
            println!("{word:6} {drawn:10} {prepare:11.0} {draw:8.0} {together:8.3}");
        }
    }
    Ok(())
}

struct Bench<'a> {
    gpu: &'a Gpu,
    watch: Option<&'a Stopwatch>,
    terrain: Terrain,
    color: wgpu::TextureView,
    depth: wgpu::TextureView,
}

impl<'a> Bench<'a> {
    fn new(
        gpu: &'a Gpu,
        watch: Option<&'a Stopwatch>,
        args: &Args,
    ) -> Result<Self, Box<dyn Error>> {
        let format = wgpu::TextureFormat::Rgba8Unorm;
        let terrain = Terrain::new(gpu, format, &args.or("grid", "256"))?;
        let color = app::view_of(&app::texture(gpu, format, SIZE));
        let depth = app::view_of(&app::texture(gpu, app::DEPTH, SIZE));
        Ok(Self { gpu, watch, terrain, color, depth })
    }

    /// Changes the size of segments until this many triangles are drawn, within two percent or as
    /// near as the grid allows.
    fn reach(&mut self, goal: f32) -> Result<u64, Box<dyn Error>> {
        let mut drawn = 0;
        for _ in 0..60 {
            for _ in 0..6 {
                self.frame()?;
            }
            let feedback = self.terrain.stage().feedback().ok_or("the device never answered")?;
            drawn = feedback.drawn;
            let has = feedback.primitives.max(1) as f32 / goal;
            if (0.98..1.02).contains(&has) && feedback.scale >= 1.0 {
                break;
            }
            self.terrain.segment = (self.terrain.segment * has.sqrt()).clamp(0.01, 1000.0);
        }
        Ok(drawn)
    }

    /// The median nanoseconds of `prepare` and of `draw`.
    fn medians(&mut self, frames: usize) -> Result<[f64; 2], Box<dyn Error>> {
        let mut times = [Vec::new(), Vec::new()];
        for _ in 0..frames {
            for (all, time) in times.iter_mut().zip(self.frame()?) {
                all.push(time);
            }
        }
        Ok(times.map(|mut all| {
            all.sort_unstable();
            all[all.len() / 2] as f64
        }))
    }

    /// Draws a frame: the nanoseconds of its two halves.
    fn frame(&mut self) -> Result<[u64; 2], Box<dyn Error>> {
        let Self { gpu, watch, terrain, color, depth } = self;
        let mut outcome = Ok(());
        let prepare = timed(gpu, *watch, |encoder| {
            outcome = terrain.prepare(Frame { gpu, encoder, seconds: 0.0, size: SIZE });
        })?;
        outcome?;
        let targets = [color.clone(), depth.clone()];
        let mut outcome = Ok(());
        let draw = timed(gpu, *watch, |encoder| {
            outcome = app::draw(&*terrain, encoder, targets);
        })?;
        outcome?;
        Ok([prepare, draw])
    }
}

/// The nanoseconds of the commands that `work` records: by the device's timestamps if it has them,
/// or else until they are done.
fn timed(
    gpu: &Gpu,
    watch: Option<&Stopwatch>,
    work: impl FnOnce(&mut wgpu::CommandEncoder),
) -> Result<u64, tess_wgpu::Error> {
    if let Some(watch) = watch {
        return watch.time(gpu, work);
    }
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    work(&mut encoder);
    let begin = Instant::now();
    gpu.run(encoder)?;
    Ok(u64::try_from(begin.elapsed().as_nanos()).unwrap_or(u64::MAX))
}
