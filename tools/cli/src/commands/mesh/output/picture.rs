//! PNG pictures: shaded, or with the edges of triangles.

use super::Options;
use super::raster::{Fragment, Raster};
use crate::commands::mesh::view::CameraView;
use crate::failure::Failure;
use crate::output::OutputFile;
use glam::Vec3;
use png::{BitDepth, ColorType, Compression, Encoder};
use std::io::{self, Write};
use std::path::Path;
use tess_mesh::Totals;
use tess_mesh::write::{Block, Sink};

/// The number of samples per pixel along each axis.
const SAMPLES: usize = 3;

/// Half the width of a wireframe's lines, in pixels.
const HALF_LINE: f32 = 0.5;

/// A picture while it is being drawn. It uses no memory besides the picture's.
pub(super) struct PngPicture {
    file: OutputFile,
    raster: Raster,
    light: Light,
    size: (u32, u32),
}

/// The lighting of a surface.
#[derive(Clone, Copy)]
struct Light {
    eye: Vec3,
    towards: Vec3,
    wireframe: bool,
}

impl PngPicture {
    pub(super) fn create(path: &Path, options: &Options<'_>) -> Result<Self, Failure> {
        let CameraView { eye, clip, size, .. } = options.view;
        let samples = (size.0 as usize * SAMPLES, size.1 as usize * SAMPLES);
        let row = |k: usize| clip.row(k).truncate().normalize_or_zero();
        Ok(Self {
            file: OutputFile::create(path)?,
            raster: Raster::new(samples, clip, [250, 250, 252]),
            light: Light {
                eye,
                // The light comes from over the left shoulder.
                towards: (row(1) * 0.8 - row(0) * 0.55 - row(3)).normalize_or(Vec3::Z),
                wireframe: options.wireframe,
            },
            size,
        })
    }

    /// Encodes the picture and moves it into its place.
    pub(super) fn finish(mut self) -> io::Result<()> {
        self.encode()?;
        self.file.finish()
    }

    /// Encodes the picture; each pixel is the mean of its samples.
    fn encode(&mut self) -> io::Result<()> {
        let size = self.size;
        let mut encoder = Encoder::new(&mut self.file, size.0, size.1);
        encoder.set_color(ColorType::Rgb);
        encoder.set_depth(BitDepth::Eight);
        encoder.set_compression(Compression::High);
        let mut writer = encoder.write_header()?;
        let mut stream = writer.stream_writer()?;
        let (width, pixels) = (size.0 as usize * SAMPLES, self.raster.pixels());
        let mut row = Vec::with_capacity(size.0 as usize * 3);
        for y in 0..size.1 as usize {
            row.clear();
            for x in 0..size.0 as usize {
                let first = y * SAMPLES * width + x * SAMPLES;
                let rows = (0..SAMPLES).map(|row| &pixels[first + row * width..][..SAMPLES]);
                row.extend(mean(rows.flatten()));
            }
            stream.write_all(&row)?;
        }
        stream.finish()?;
        writer.finish()?;
        self.file.flush()
    }
}

#[expect(clippy::cast_possible_truncation, reason = "a mean of bytes is a byte")]
fn mean<'a>(samples: impl Iterator<Item = &'a [u8; 3]>) -> [u8; 3] {
    const COUNT: u32 = (SAMPLES * SAMPLES) as u32;
    let add = |sum: [u32; 3], sample: &[u8; 3]| [0, 1, 2].map(|k| sum[k] + u32::from(sample[k]));
    samples.fold([COUNT / 2; 3], add).map(|sum| (sum / COUNT) as u8)
}

impl Light {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to 0..=255"
    )]
    fn shade(&self, fragment: &Fragment) -> [u8; 3] {
        let to_eye = (self.eye - fragment.position).normalize_or(Vec3::Z);
        // On the back of the surface, the normal is reversed for lighting.
        let normal = if fragment.front { fragment.normal } else { -fragment.normal };
        let diffuse = 0.5 + 0.5 * normal.dot(self.towards);
        let shine = normal.dot((self.towards + to_eye).normalize_or(Vec3::Z)).max(0.0);
        // The 48th power, computed in the same way on every machine.
        let shine = (0..4).fold(shine * shine * shine, |power, _| power * power);
        let base = match (fragment.front, self.wireframe) {
            (true, false) => Vec3::new(0.80, 0.47, 0.25),
            (true, true) => Vec3::new(0.93, 0.80, 0.68),
            (false, _) => Vec3::new(0.45, 0.50, 0.58),
        };
        let shine = if self.wireframe { 0.0 } else { 0.35 * shine };
        let lit = base * (0.22 + 0.9 * diffuse * diffuse) + Vec3::splat(shine);
        let line = Vec3::new(0.16, 0.20, 0.30);
        let on_line = self.wireframe && fragment.edge < HALF_LINE * SAMPLES as f32;
        let colour = if on_line { line } else { lit };
        colour.to_array().map(|channel| (channel.clamp(0.0, 1.0) * 255.0) as u8)
    }
}

impl Sink for PngPicture {
    fn begin(&mut self, _: &[Totals]) -> io::Result<()> {
        Ok(())
    }

    fn block(&mut self, block: &Block<'_>) -> io::Result<()> {
        let Self { raster, light, .. } = self;
        for triangle in block.indices.as_chunks::<3>().0 {
            let corners = triangle.map(|index| &block.vertices[index as usize]);
            raster.triangle(corners, |fragment| light.shade(fragment));
        }
        Ok(())
    }
}
