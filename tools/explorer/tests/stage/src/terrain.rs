//! The frames of the terrain, their picture, and the model's verdict.

use crate::{StageReport, config};
use tess_core::{Patch, PatchFactors};
use tess_gpu::layout::PackedPoint;
use tess_wgpu::stage::{Feedback, Material};
use tess_wgpu::{Error, Gpu, TessellationStage};
use wgpu::BufferUsages as Usage;

pub(crate) const WGSL: &str = include_str!("terrain.wgsl");
pub(crate) const PATCHES: u32 = 16;
pub(crate) const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// Pixels across and down.
const SIZE: u32 = 256;
/// More frames than the stage needs to learn of a lack of room.
const MOST_FRAMES: u32 = 60;

/// The factors that `hull` gives.
#[expect(clippy::float_arithmetic, clippy::cast_precision_loss, reason = "as in the WGSL, exactly")]
fn factors(number: u32) -> PatchFactors {
    let first = 1.5 + 0.75 * (number % 8) as f32;
    let [u0, v0, u1, v1] = [first, first + 2.0, first + 9.25, first + 1.0];
    PatchFactors::Quad([u0, v0, u1, v1, 0.5 * (v0 + v1), 0.5 * (u0 + u1)].into())
}

pub(crate) async fn draw(
    gpu: &Gpu,
    (mut stage, material): (TessellationStage, Material),
    is_wrong: bool,
) -> Result<StageReport, Error> {
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("picture"),
        size: wgpu::Extent3d { width: SIZE, height: SIZE, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: FORMAT,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    let pixels =
        gpu.buffer("pixels", u64::from(4 * SIZE * SIZE), Usage::COPY_SRC | Usage::COPY_DST)?;
    let (mut first, mut frames) = (None, 0);
    let last = loop {
        frame(gpu, (&mut stage, &material), &texture, &pixels)?;
        frames += 1;
        // Waiting for the pixels lets the browser answer the stage, too.
        let picture = gpu.read_async(&pixels, pixels.size()).await?;
        let feedback = stage.feedback();
        first = first.or(feedback);
        match feedback {
            Some(last) if last.frame > 0 && last.drawn == last.primitives && last.scale >= 1.0 => {
                break (last, picture);
            }
            _ if frames == MOST_FRAMES => {
                let reason = format!("the last of {frames} frames did not fit: {feedback:?}");
                return Err(Error::Refused { reason });
            }
            _ => {}
        }
    };
    let (Feedback { points, primitives, .. }, picture) = last;
    let difference = difference(gpu, &stage, points, primitives, is_wrong).await?;
    Ok(StageReport {
        frames,
        first_scale: first.map_or(0.0, |first| first.scale),
        points: u32::try_from(points).unwrap_or(u32::MAX),
        triangles: u32::try_from(primitives).unwrap_or(u32::MAX),
        difference: difference.unwrap_or_default(),
        pixels: picture,
    })
}

/// Records and submits a frame, and a copy of its picture.
fn frame(
    gpu: &Gpu,
    (stage, material): (&mut TessellationStage, &Material),
    texture: &wgpu::Texture,
    pixels: &wgpu::Buffer,
) -> Result<(), Error> {
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let frame = stage.prepare(&mut encoder, PATCHES)?;
    let view = texture.create_view(&Default::default());
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations::default(),
        })],
        ..Default::default()
    });
    material.draw(&mut pass, &frame)?;
    drop(pass);
    let layout = wgpu::TexelCopyBufferLayout {
        offset: 0,
        bytes_per_row: Some(4 * SIZE),
        rows_per_image: None,
    };
    let copy = wgpu::TexelCopyBufferInfo { buffer: pixels, layout };
    encoder.copy_texture_to_buffer(texture.as_image_copy(), copy, texture.size());
    gpu.queue.submit([encoder.finish()]);
    Ok(())
}

/// The first difference between the stage's points and indices and the model's.
async fn difference(
    gpu: &Gpu,
    stage: &TessellationStage,
    points: u64,
    primitives: u64,
    is_wrong: bool,
) -> Result<Option<String>, Error> {
    let (mut expected_points, mut expected_indices) = (Vec::new(), Vec::<u32>::new());
    let mut base = 0;
    for number in 0..PATCHES {
        let asked = number + u32::from(is_wrong && number + 1 == PATCHES);
        let whole = Patch::new(config(), factors(asked)).tessellate();
        expected_indices.extend(whole.indices.into_iter().map(|index| base + index));
        base += Patch::new(config(), factors(asked)).counts().points;
        expected_points.extend(whole.points.into_iter().map(|point| (number, point)));
    }
    let (_, [Some(point_buffer), Some(index_buffer)]) = stage.inside() else {
        return Ok(Some("the stage stores no points".to_owned()));
    };
    let observed = gpu.read_async(&point_buffer, 8 * points).await?;
    let observed: Vec<[u32; 2]> = bytemuck::pod_collect_to_vec(&observed);
    let observed = observed.into_iter().map(PackedPoint);
    let observed = observed.map(|packed| (packed.patch(), packed.point()));
    let observed_indices = gpu.read_async(&index_buffer, 12 * primitives).await?;
    let observed_indices: Vec<u32> = bytemuck::pod_collect_to_vec(&observed_indices);
    Ok(first_difference("point", &observed.collect::<Vec<_>>(), &expected_points)
        .or_else(|| first_difference("index", &observed_indices, &expected_indices)))
}

fn first_difference<T: PartialEq + std::fmt::Debug>(
    what: &str,
    observed: &[T],
    expected: &[T],
) -> Option<String> {
    if let Some(at) = observed.iter().zip(expected).position(|(one, other)| one != other) {
        return Some(format!("{what} {at}: {:?}, expected {:?}", observed[at], expected[at]));
    }
    let (got, wanted) = (observed.len(), expected.len());
    (got != wanted).then(|| format!("{what} list of {got}, expected {wanted}"))
}
