//! If the needs rise slowly, the room grows before a frame is coarse. Room that frames no longer
//! need is given back.

use std::collections::VecDeque;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, Patch, PatchFactors};
use tess_gpu::Capacity;
use tess_wgpu::stage::{Factors, Room};
use tess_wgpu::{Gpu, TessellationStage};

const PATCHES: u16 = 96;

/// The number of frames by which the device is behind the host.
const IN_FLIGHT: usize = 2;

fn config() -> Config {
    Config::new(Partitioning::FractionalEven, OutputPrimitive::TriangleCw)
}

/// Factors that differ from patch to patch.
fn patches(size: f32) -> Vec<PatchFactors> {
    let of = |number: u16| size * (0.75 + f32::from(number) / 192.0);
    (0..PATCHES).map(|number| PatchFactors::uniform(Domain::Quad, of(number))).collect()
}

fn primitives(patches: &[PatchFactors]) -> f64 {
    patches.iter().map(|&one| f64::from(Patch::new(config(), one).counts().primitives)).sum()
}

/// The least of these factors that give this many primitives.
fn giving(wanted: f64) -> Vec<PatchFactors> {
    let (mut low, mut high) = (1.0_f32, 60.0_f32);
    for _ in 0..16 {
        let middle = 0.5 * (low + high);
        if primitives(&patches(middle)) < wanted { low = middle } else { high = middle }
    }
    patches(high)
}

fn stage(gpu: &Gpu, room: Room) -> TessellationStage {
    let source = "struct Vertex { @builtin(position) position: vec4f }\n\
                  fn domain(number: u32, uv: vec2f) -> Vertex { return Vertex(vec4f(uv, 0.0, 1.0)); }";
    TessellationStage::builder(source, Domain::Quad, config(), PATCHES.into())
        .factors(Factors::Host)
        .room(room)
        .build(&gpu.device)
        .unwrap_or_else(|error| panic!("{error}"))
}

/// Runs frames of these factors, each submitted after two more were recorded. Returns the rooms and
/// the coarse frames.
fn run(
    gpu: &Gpu,
    stage: &mut TessellationStage,
    frames: impl Iterator<Item = Vec<PatchFactors>>,
) -> (Vec<Capacity>, u32) {
    let (mut rooms, mut coarse, mut waiting) = (vec![stage.capacity()], 0, VecDeque::new());
    let mut submit = |stage: &TessellationStage, waiting: &mut VecDeque<wgpu::CommandEncoder>| {
        gpu.run(waiting.pop_front().expect("one waits")).expect("the device finishes");
        let heard = stage.feedback().expect("it ran");
        coarse += u32::from(heard.scale < 1.0);
        heard
    };
    for patches in frames {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        stage.set_factors(&mut encoder, &patches).expect("they are the stage's");
        stage.prepare(&mut encoder, u32::from(PATCHES)).expect("it is prepared");
        waiting.push_back(encoder);
        if stage.capacity() != *rooms.last().expect("the first") {
            rooms.push(stage.capacity());
        }
        if waiting.len() > IN_FLIGHT {
            submit(stage, &mut waiting);
        }
    }
    while !waiting.is_empty() {
        submit(stage, &mut waiting);
    }
    (rooms, coarse)
}

#[test]
#[ignore = "slow: long sequences of frames"]
fn demand_that_rises_is_met_ahead() {
    let gpu = pollster::block_on(Gpu::open()).unwrap_or_else(|error| panic!("{error}"));
    for (rates, most) in [(&[1.01, 1.02, 1.03, 1.04][..], 4), (&[1.01], 1), (&[1.04], 5)] {
        let mut stage = stage(&gpu, Room::Automatic { most_bytes: 256 << 20 });
        let mut wanted = 96.0 * 50.0;
        give(&gpu, &mut stage, &giving(wanted));
        stage.make_room(&gpu.queue, u32::from(PATCHES)).expect("the device answers");
        let frames = (0..111).map(|frame| {
            wanted *= rates[frame % rates.len()];
            giving(wanted)
        });
        let (rooms, coarse) = run(&gpu, &mut stage, frames);
        assert_eq!(coarse, 0, "frames are coarse that rise by {rates:?}: {rooms:?}");
        assert!((1..=most).contains(&(rooms.len() - 1)), "{rates:?}: {rooms:?}");
        for pair in rooms.windows(2) {
            assert!(
                pair[1].points >= 2 * pair[0].points
                    || pair[1].primitives >= 2 * pair[0].primitives,
                "{pair:?}"
            );
        }
    }
}

#[test]
#[ignore = "slow: long sequences of frames"]
fn room_is_given_back_after_a_long_lull() {
    let gpu = pollster::block_on(Gpu::open()).unwrap_or_else(|error| panic!("{error}"));
    let mut stage = stage(&gpu, Room::Automatic { most_bytes: 256 << 20 });
    let first = stage.capacity();
    let frames = |size, count| std::iter::repeat_n(patches(size), count);
    let (rooms, _) = run(&gpu, &mut stage, frames(20.0, 4));
    assert_eq!(rooms.len(), 2, "it grows: {rooms:?}");
    let (rooms, coarse) = run(&gpu, &mut stage, frames(1.0, 1024));
    assert_eq!((rooms.len(), coarse), (1, 0), "the last of these is not heard of yet: {rooms:?}");
    let (rooms, coarse) = run(&gpu, &mut stage, frames(1.0, 8));
    assert_eq!((rooms.len(), coarse, stage.capacity()), (2, 0, first), "{rooms:?}");
}

/// Gives the patches factors from the host.
fn give(gpu: &Gpu, stage: &mut TessellationStage, patches: &[PatchFactors]) {
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    stage.set_factors(&mut encoder, patches).expect("they are the stage's");
    gpu.run(encoder).expect("the device finishes");
}
