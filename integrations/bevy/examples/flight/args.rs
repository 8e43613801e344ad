//! The command line.

use bevy::ecs::resource::Resource;
use std::path::PathBuf;

pub(crate) const HELP: &str = "\
Flies over a terrain of 4096 patches with 50 characters, tessellated by their size on the screen.

Options:
  --screenshot FILE  draws into a PNG file, without a window
  --cpu              the CPU tessellates
  --wireframe        edges in place of triangles
  --pixels PIXELS    the length of a segment (8)
  --seconds SECONDS  the moment of a screenshot (0)
  --above            looks straight down on the terrain, which hides a magenta background
  --size WxH         the size of a screenshot (960x600)

Keys: w wireframe, c CPU or GPU, + and - finer and coarser, Escape ends.";

/// Options of the command line.
#[derive(Clone, Debug, Resource)]
pub(crate) struct Args {
    pub(crate) screenshot: Option<PathBuf>,
    pub(crate) cpu: bool,
    pub(crate) wireframe: bool,
    pub(crate) pixels: f32,
    pub(crate) above: bool,
    pub(crate) seconds: f32,
    pub(crate) size: [u32; 2],
}

impl Args {
    /// The arguments; `None` if the user asks for help.
    pub(crate) fn from_command_line() -> Result<Option<Self>, String> {
        let mut args = Self {
            screenshot: None,
            cpu: false,
            wireframe: false,
            pixels: 8.0,
            above: false,
            seconds: 0.0,
            size: [960, 600],
        };
        let mut words = std::env::args().skip(1);
        while let Some(word) = words.next() {
            let mut value = || words.next().ok_or_else(|| format!("{word} needs a value"));
            match word.as_str() {
                "--help" => return Ok(None),
                "--screenshot" => args.screenshot = Some(value()?.into()),
                "--above" => args.above = true,
                "--cpu" => args.cpu = true,
                "--wireframe" => args.wireframe = true,
                "--pixels" => args.pixels = number(&word, &value()?, 0.25..=1000.0)?,
                "--seconds" => args.seconds = number(&word, &value()?, 0.0..=1e6)?,
                "--size" => args.size = size(&value()?)?,
                _ => return Err(format!("{word} is no option; --help lists them")),
            }
        }
        Ok(Some(args))
    }
}

fn number(option: &str, word: &str, range: std::ops::RangeInclusive<f32>) -> Result<f32, String> {
    let valid = word.parse().ok().filter(|number| range.contains(number));
    let (least, most) = (range.start(), range.end());
    valid.ok_or_else(|| format!("{option} {word}: it must be a number from {least} to {most}"))
}

fn size(word: &str) -> Result<[u32; 2], String> {
    let sizes = word.split_once('x').and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    let valid = sizes.filter(|sizes: &[u32; 2]| sizes.iter().all(|size| (1..=8192).contains(size)));
    valid
        .ok_or_else(|| format!("--size {word}: it must be WxH, each from 1 to 8192, as in 960x600"))
}
