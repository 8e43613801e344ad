//! The trait of examples, their options and their pictures.

#[path = "target.rs"]
mod target;

use std::error::Error;
pub(crate) use target::{DEPTH, copy_pixels, depth, image, texture, view_of};
use tess_wgpu::Gpu;

/// An example's content.
pub(crate) trait Show: Sized {
    /// The background colour.
    const BACKGROUND: wgpu::Color = BACKGROUND;

    /// Makes the example's objects, for a picture of this format.
    fn new(gpu: &Gpu, format: wgpu::TextureFormat, args: &Args) -> Result<Self, Box<dyn Error>>;

    /// Records the compute passes of a frame.
    fn prepare(&mut self, frame: Frame<'_>) -> Result<(), Box<dyn Error>>;

    /// Draws the frame.
    fn draw(&self, pass: &mut wgpu::RenderPass<'_>) -> Result<(), tess_wgpu::Error>;

    /// Whether a drawn frame is complete. It may wait for the device.
    fn check(&self, _gpu: &Gpu) -> Result<(), Box<dyn Error>> {
        Ok(())
    }

    /// A key was pressed.
    fn press(&mut self, _gpu: &Gpu, _key: &str) -> Result<(), Box<dyn Error>> {
        Ok(())
    }

    /// The window's title.
    fn title(&self) -> String;
}

/// A frame, and the encoder that records it.
pub(crate) struct Frame<'a> {
    pub(crate) gpu: &'a Gpu,
    pub(crate) encoder: &'a mut wgpu::CommandEncoder,
    /// The time since the first frame.
    pub(crate) seconds: f32,
    /// The width and height in pixels.
    pub(crate) size: [u32; 2],
}

/// The options of the command line, as pairs of a name and a value.
#[derive(Clone, Debug, Default)]
pub(crate) struct Args(Vec<(String, String)>);

impl Args {
    pub(crate) fn new(mut all: impl Iterator<Item = String>) -> Result<Self, String> {
        let mut pairs = Vec::new();
        // `cargo example NAME -- --screenshot FILE`: cargo has taken its own `--` already.
        let mut all = all.by_ref().skip_while(|word| word == "--");
        while let Some(name) = all.next() {
            let name = name.strip_prefix("--").ok_or_else(|| {
                format!("{name} is no option; there is --screenshot FILE and --frames COUNT")
            })?;
            let value = all.next().ok_or_else(|| format!("--{name} needs a value"))?;
            pairs.push((name.to_owned(), value));
        }
        Ok(Self(pairs))
    }

    /// The same options with this one, which replaces an earlier value.
    pub(crate) fn with(&self, name: &str, value: &str) -> Self {
        let mut pairs = self.0.clone();
        pairs.insert(0, (name.to_owned(), value.to_owned()));
        Self(pairs)
    }

    /// The same options with this one if it is not among them.
    pub(crate) fn or(&self, name: &str, value: &str) -> Self {
        if self.text(name).is_some() { self.clone() } else { self.with(name, value) }
    }

    /// The value of an option.
    pub(crate) fn text(&self, name: &str) -> Option<&str> {
        self.0.iter().find(|(own, _)| own == name).map(|(_, value)| value.as_str())
    }

    /// The value of an option, or the default.
    pub(crate) fn number<T: std::str::FromStr>(&self, name: &str, or: T) -> Result<T, String> {
        let Some(text) = self.text(name) else { return Ok(or) };
        text.parse().map_err(|_| format!("--{name} {text} is no such number"))
    }
}

/// The third frame of an example, so that the stage has made the room that it needs: RGBA, row by
/// row.
pub(crate) fn picture<S: Show>(
    gpu: &Gpu,
    args: &Args,
    size: [u32; 2],
) -> Result<Vec<u8>, Box<dyn Error>> {
    let format = wgpu::TextureFormat::Rgba8Unorm;
    let mut show = S::new(gpu, format, args)?;
    let color = texture(gpu, format, size);
    let depth = texture(gpu, DEPTH, size);
    let [width, height] = size;
    let usage = wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC;
    let pixels = gpu.buffer("pixels", u64::from(4 * width * height), usage)?;
    for _ in 0..3 {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let seconds = args.number("seconds", 0.0)?;
        show.prepare(Frame { gpu, encoder: &mut encoder, seconds, size })?;
        draw(&show, &mut encoder, [&color, &depth].map(view_of))?;
        copy_pixels(&mut encoder, &color, &pixels);
        gpu.run(encoder)?;
        show.check(gpu)?;
    }
    Ok(gpu.read(&pixels, pixels.size())?)
}

/// The background colour of most examples.
pub(crate) const BACKGROUND: wgpu::Color = wgpu::Color { r: 0.93, g: 0.94, b: 0.96, a: 1.0 };

/// Records the render pass of a frame into a colour and a depth target.
pub(crate) fn draw<S: Show>(
    show: &S,
    encoder: &mut wgpu::CommandEncoder,
    [color, depth]: [wgpu::TextureView; 2],
) -> Result<(), tess_wgpu::Error> {
    let mut pass = target::begin_pass(encoder, [&color, &depth], S::BACKGROUND);
    show.draw(&mut pass)
}
