//! Times frames that draw one tessellation in one or four passes: `domain` in each, or evaluated
//! once.

use crate::Result;
use crate::timing::device_time;
use std::cell::RefCell;
use std::time::Duration;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning};
use tess_wgpu::stage::{Frame, Material, Points, Room};
use tess_wgpu::{DeviceLimits, Gpu, Stopwatch, TessellationStage};

/// The time for which each frame is repeated.
const LONG_ENOUGH: Duration = Duration::from_millis(250);
/// The width and height of a target in pixels.
const SIZE: u32 = 1024;
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// Octaves of noise in `domain`, each of about 40 instructions.
const OCTAVES: [u32; 3] = [1, 4, 32];

/// Prints the device's times in microseconds: of `prepare` alone, and of whole frames.
pub(crate) fn run() -> Result<()> {
    let gpu = pollster::block_on(Gpu::open_with(DeviceLimits::Highest, Stopwatch::FEATURES))?;
    let stopwatch = Stopwatch::new(&gpu)?;
    let targets = [FORMAT, DEPTH].map(|format| target(&gpu, format));
    println!("{}", gpu.name());
    println!("                                   stored us        evaluated us");
    println!("factor patches octaves passes  prepare    frame  prepare    frame  quotient");
    // Two million triangles each.
    for (factor, side) in [(4_u32, 256_u32), (16, 64), (64, 16)] {
        for octaves in OCTAVES {
            let text = include_str!("evaluated.wgsl")
                .replace("FACTOR", &format!("{factor}.0"))
                .replace("SIDE", &format!("{side}u"))
                .replace("OCTAVES", &octaves.to_string());
            for passes in [1, 4] {
                let time = |points| {
                    let scene = Scene::new(&gpu, (&text, points), side * side, passes)?;
                    scene.times(&gpu, &stopwatch, &targets)
                };
                let [stored, evaluated] = [time(Points::Stored)?, time(Points::Evaluated)?];
                print_row([factor, side * side, octaves, passes], stored, evaluated);
            }
        }
    }
    Ok(())
}

#[expect(clippy::float_arithmetic, reason = "a quotient of times")]
fn print_row(row: [u32; 4], stored: [f64; 2], evaluated: [f64; 2]) {
    let [factor, patches, octaves, passes] = row;
    let ([a, b], [c, d]) = (stored, evaluated);
    let quotient = d / b;
    println!(
        "{factor:6} {patches:7} {octaves:7} {passes:6} {a:8.1} {b:8.1} {c:8.1} {d:8.1} {quotient:9.3}"
    );
}

/// A stage, and the materials that draw its frames for several cameras.
struct Scene {
    stage: RefCell<TessellationStage>,
    first: Material,
    others: Vec<Material>,
    patches: u32,
}

impl Scene {
    fn new(gpu: &Gpu, (text, points): (&str, Points), patches: u32, passes: u32) -> Result<Self> {
        let config = Config::new(Partitioning::FractionalEven, OutputPrimitive::TriangleCw);
        let stage = TessellationStage::builder(text, Domain::Quad, config, patches)
            .points(points)
            .room(Room::Automatic { most_bytes: 1 << 30 })
            .build(&gpu.device)?;
        let depth = wgpu::DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Less),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        };
        let pass = |camera| stage.material(text).project(camera).depth(depth.clone());
        let first = pass("camera_0").target(FORMAT).build()?;
        // Only depth, as in shadow maps.
        let others = ["camera_1", "camera_2", "camera_3"].into_iter().take(passes as usize - 1);
        let others = others.map(|camera| pass(camera).build());
        let others = others.collect::<std::result::Result<_, _>>()?;
        Ok(Self { stage: RefCell::new(stage), first, others, patches })
    }

    /// The times of `prepare` alone and of a frame: one `prepare`, and a pass for each camera.
    fn times(
        &self,
        gpu: &Gpu,
        stopwatch: &Stopwatch,
        [colour, depth]: &[wgpu::TextureView; 2],
    ) -> Result<[f64; 2]> {
        self.stage.borrow_mut().make_room(&gpu.queue, self.patches)?;
        let prepared = |encoder: &mut wgpu::CommandEncoder| -> Frame {
            let frame = self.stage.borrow_mut().prepare(encoder, self.patches);
            frame.expect("the device works and the number is the stage's")
        };
        let prepare = |encoder: &mut wgpu::CommandEncoder| drop(prepared(encoder));
        let frame = |encoder: &mut wgpu::CommandEncoder| {
            let frame = prepared(encoder);
            let draw = |material: &Material, mut pass: wgpu::RenderPass<'_>| {
                material.draw(&mut pass, &frame).expect("it is the last frame");
            };
            draw(&self.first, begin(encoder, Some(colour), depth));
            for other in &self.others {
                draw(other, begin(encoder, None, depth));
            }
        };
        let time = |work: &dyn Fn(&mut wgpu::CommandEncoder)| {
            device_time(gpu, stopwatch, LONG_ENOUGH, work)
        };
        // The first frames grow the room.
        time(&frame)?;
        Ok([time(&prepare)?, time(&frame)?])
    }
}

fn begin<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    colour: Option<&wgpu::TextureView>,
    depth: &wgpu::TextureView,
) -> wgpu::RenderPass<'a> {
    let colour = colour.map(|view| wgpu::RenderPassColorAttachment {
        view,
        depth_slice: None,
        resolve_target: None,
        ops: wgpu::Operations::default(),
    });
    let colours = [colour];
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        color_attachments: if colours[0].is_some() { &colours } else { &[] },
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: depth,
            depth_ops: Some(wgpu::Operations {
                load: wgpu::LoadOp::Clear(1.0),
                store: wgpu::StoreOp::Store,
            }),
            stencil_ops: None,
        }),
        ..Default::default()
    })
}

fn target(gpu: &Gpu, format: wgpu::TextureFormat) -> wgpu::TextureView {
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width: SIZE, height: SIZE, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
        view_formats: &[],
    });
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}
