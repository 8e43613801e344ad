//! Integrations into engines, which are separate workspaces: builds, tests and runs them, and
//! compares their pictures.

use crate::command::{self, in_file, workspace};
use crate::setup;
use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A pixel differs if one of its channels differs by more than this. The GPU and the CPU round
/// heights, normals and light differently.
const CHANNEL: u8 = 4;
/// The number of pixels in a thousand that may differ: on the edges of triangles either result may
/// occur.
const PER_THOUSAND: usize = 1;

/// Checks the plugin for Bevy.
///
/// # Errors
/// A step fails, the pictures of the GPU and the CPU differ, there is a crack, or the comparison
/// does not detect a planted fault.
pub(crate) fn run() -> Result<(), String> {
    let bevy = Integration::open("integrations/bevy")?;
    bevy.cargo("fmt --all --check")?;
    bevy.cargo("clippy --all-targets -- -D warnings")?;
    bevy.cargo("test")?;
    bevy.cargo("test --examples")?;
    bevy.cargo("build --example flight")?;
    let [gpu, cpu] = [bevy.draw("gpu", "")?, bevy.draw("cpu", "--cpu")?];
    differing(&gpu, &cpu, "by the GPU and by the CPU")?;
    let coarse = bevy.draw("coarse", "--cpu --pixels 60")?;
    if differing(&gpu, &coarse, "by the GPU and, with a planted fault, by the CPU").is_ok() {
        return Err("coarser triangles went unnoticed: the comparison sees nothing".to_owned());
    }
    println!("as it should be");
    for (name, options) in [("gpu-above", "--above"), ("cpu-above", "--above --cpu")] {
        let through = bevy.draw(name, options)?.holes();
        if through > 0 {
            return Err(format!(
                "{name}: the background is seen through {through} pixels of the terrain"
            ));
        }
    }
    println!("no cracks");
    Ok(())
}

/// The workspace of an integration, and the toolchain that it requires.
struct Integration {
    folder: PathBuf,
    channel: String,
}

impl Integration {
    fn open(folder: &str) -> Result<Self, String> {
        command::lock_versions(&workspace(), folder)?;
        let folder = workspace().join(folder);
        let path = folder.join("rust-toolchain.toml");
        let text = command::read(&path)?;
        let channel =
            text.lines().find_map(|line| line.strip_prefix("channel = \"")?.strip_suffix('"'));
        let channel =
            channel.ok_or_else(|| in_file(&path, &"no line `channel = \"...\"`"))?.to_owned();
        setup::toolchain(&channel, &[("component", "clippy"), ("component", "rustfmt")])?;
        Ok(Self { folder, channel })
    }

    fn cargo(&self, arguments: &str) -> Result<(), String> {
        let mut command = Command::new("rustup");
        command.args(["run", &self.channel, "cargo"]).args(arguments.split_whitespace());
        command.current_dir(&self.folder).env("CARGO_TARGET_DIR", self.target());
        command::run(&mut command)
    }

    fn target(&self) -> PathBuf {
        self.folder.join("target")
    }

    /// The example's picture with these options.
    fn draw(&self, name: &str, options: &str) -> Result<Picture, String> {
        let file = self.target().join(format!("{name}.png"));
        let mut command = Command::new(self.target().join("debug/examples/flight"));
        command.args(["--size", "480x300", "--seconds", "3", "--screenshot"]).arg(&file);
        command::run(command.args(options.split_whitespace()))?;
        Picture::read(&file)
    }
}

/// The channels of a picture, four per pixel.
struct Picture(Vec<u8>);

impl Picture {
    fn read(path: &Path) -> Result<Self, String> {
        let file = File::open(path).map_err(|error| in_file(path, &error))?;
        let read = || -> Result<Vec<u8>, png::DecodingError> {
            let mut decoder = png::Decoder::new(BufReader::new(file));
            decoder.set_transformations(png::Transformations::ALPHA);
            let mut reader = decoder.read_info()?;
            let mut bytes = vec![0; reader.output_buffer_size().unwrap_or(0)];
            let info = reader.next_frame(&mut bytes)?;
            bytes.truncate(info.buffer_size());
            Ok(bytes)
        };
        read().map(Self).map_err(|error| in_file(path, &error))
    }

    fn pixels(&self) -> &[[u8; 4]] {
        self.0.as_chunks().0
    }

    /// The number of pixels with any of the magenta that the example shows behind a terrain seen
    /// from above.
    fn holes(&self) -> usize {
        let is_magenta =
            |&&[red, green, blue, _]: &&[u8; 4]| red.min(blue) > green.saturating_add(40);
        self.pixels().iter().filter(is_magenta).count()
    }
}

/// Counts and prints the differing pixels; an error if there are too many.
fn differing(a: &Picture, b: &Picture, what: &str) -> Result<(), String> {
    let [a, b] = [a.pixels(), b.pixels()];
    if a.len() != b.len() || a.is_empty() {
        return Err(format!("pictures {what} have {} and {} pixels", a.len(), b.len()));
    }
    let is_off = |(a, b): &(&[u8; 4], &[u8; 4])| {
        a.iter().zip(*b).any(|(a, b): (&u8, &u8)| a.abs_diff(*b) > CHANNEL)
    };
    let count = a.iter().zip(b).filter(is_off).count();
    let most = a.len() * PER_THOUSAND / 1000;
    println!("pictures {what}: {count} of {} pixels differ, {most} may", a.len());
    if count <= most {
        return Ok(());
    }
    Err(format!("pictures {what}: {count} pixels differ by more than {CHANNEL}, {most} may"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grey(count: usize) -> Picture {
        Picture([100, 100, 100, 255].repeat(count))
    }

    #[test]
    fn a_pixel_in_a_thousand_may_differ() {
        let mut other = grey(1000);
        assert_eq!(differing(&grey(1000), &other, "here"), Ok(()), "none differs");
        other.0[1] = 105;
        assert_eq!(differing(&grey(1000), &other, "here"), Ok(()), "one differs");
        other.0[4] = 96;
        assert_eq!(differing(&grey(1000), &other, "here"), Ok(()), "another one is within 4");
        other.0[4] = 95;
        assert!(differing(&grey(1000), &other, "here").is_err(), "two differ");
        assert!(differing(&grey(1000), &grey(999), "here").is_err(), "another size");
        assert!(differing(&grey(0), &grey(0), "here").is_err(), "nothing to compare");
    }

    #[test]
    fn holes_are_magenta() {
        assert_eq!(grey(10).holes(), 0, "a grey terrain");
        let hole = Picture(vec![255, 0, 255, 255, 150, 100, 160, 255, 130, 100, 150, 255]);
        assert_eq!(hole.holes(), 2, "a whole one and a part, and a reddish grey");
    }
}
