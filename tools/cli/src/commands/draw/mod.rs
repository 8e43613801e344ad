//! `tess draw`: a picture of one patch.

use crate::args::{PatchArgs, note_large_factors};
use crate::backends::{BackendArgs, BackendName};
use crate::failure::{Exit, Failure};
use crate::formats::{OnePatch, PictureFormat};
use crate::output::form;
use crate::output::{OutputArgs, Role, counted, note, refuse_shared};
use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use tess_core::{Domain, OutputPrimitive};
use tess_show::{Colours, DrawOptions, Drawing};
use tess_verify::Backend;
use tess_verify::vectors::{Record, VectorFile};

/// Draw one patch as SVG or PNG
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  tess draw quad --outer 3,4,5,6 --inner 4,7 --number-points -o patch.svg
  tess draw tri --outer 17,5,9 --inner 3 --rings -o fan.png
  tess draw quad --outer 8,8,8,8 --inner 8,8 --backend simd --against core -o both.png
  tess draw tri --outer 4,4,4 --inner 4 --overlay device.txt -o differences.png")]
pub(crate) struct DrawCommand {
    #[command(flatten)]
    patch: PatchArgs,
    #[command(flatten)]
    backend: BackendArgs,
    #[command(flatten)]
    options: DrawArgs,
    /// Format of the picture [default: from the file's name, else svg]
    #[arg(long, value_name = "NAME")]
    format: Option<PictureFormat>,
    /// Draw this backend's result, with its differences from the other backend in red; exit code 1
    /// if there are any
    #[arg(long, value_name = "NAME", conflicts_with = "overlay")]
    against: Option<BackendName>,
    /// Draw the model, with the differences of this listing of the same patch in red; a listing by
    /// coordinates is drawn with the model's point numbers
    #[arg(long, value_name = "FILE")]
    overlay: Option<PathBuf>,
    #[command(flatten)]
    output: OutputArgs,
}

/// Additions to a picture, besides the primitives and points themselves.
#[derive(Clone, Copy, Debug, clap::Args)]
struct DrawArgs {
    /// Number the points
    #[arg(long)]
    number_points: bool,
    /// Colour the primitives by their order and number them
    #[arg(long)]
    number_primitives: bool,
    /// Colour the triangles by the ring that they are stitched to
    #[arg(long, conflicts_with = "number_primitives")]
    rings: bool,
    /// Width and height in pixels, 64 to 8192
    #[arg(long, value_name = "PIXELS", default_value_t = 800)]
    #[arg(value_parser = clap::value_parser!(u32).range(64..=8192))]
    size: u32,
}

/// Runs the command. Errors: a wrong number of factors; an unavailable backend; a listing that
/// cannot be read or lacks the patch; an output that cannot be written.
pub(crate) fn run(args: &DrawCommand) -> Result<Exit, Failure> {
    let case = args.patch.case()?;
    let format = form::choose(args.format, &args.output.file)?;
    if format == PictureFormat::Png {
        args.output.refuse_terminal("a PNG picture")?;
    }
    args.options.fit(case.domain(), case.config.output)?;
    if let Some(overlay) = &args.overlay {
        refuse_shared(&[Role::input("--overlay", overlay), args.output.role()])?;
    }
    note_large_factors(&case);
    let patch = OnePatch::tessellate(args.select()?.as_mut(), case)?;
    let pair = match (args.against, &args.overlay) {
        (Some(name), _) => {
            let mut against = args.backend.options.select(name)?;
            Some((OnePatch::tessellate(against.as_mut(), case)?, patch.clone()))
        }
        (None, Some(file)) => Some((patch.clone(), find_listing(file, &patch)?)),
        (None, None) => None,
    };
    let (drawing, exit) = match pair {
        Some((expected, observed)) => draw_overlay(&expected, &observed, &args.options.options()),
        None => (tess_show::draw(&patch.listing, &args.options.options()), Exit::Done),
    };
    report_left_out(&drawing);
    args.output.write(&format.render(&drawing)?)?;
    Ok(exit)
}

impl DrawArgs {
    /// Refuses options that do not suit the patch. Errors: rings without triangles.
    fn fit(&self, domain: Domain, output: OutputPrimitive) -> Result<(), Failure> {
        if self.rings && !tess_show::has_rings(domain, output) {
            return Err(Failure::bad_input(
                "--rings colours the triangles of a tri or quad patch; this one has none",
            ));
        }
        Ok(())
    }

    fn options(&self) -> DrawOptions {
        let colours = match (self.number_primitives, self.rings) {
            (true, _) => Colours::Order,
            (_, true) => Colours::Rings,
            _ => Colours::Plain,
        };
        DrawOptions { indices: self.number_points, colours, size: self.size }
    }
}

impl DrawCommand {
    /// Makes the backend ready whose result is drawn.
    fn select(&self) -> Result<Box<dyn Backend>, Failure> {
        let BackendArgs { backend, options } = self.backend;
        if self.against == Some(backend) {
            return Err(Failure::bad_input(format!(
                "--against {} compares a backend with itself: choose another one with --backend",
                form::name(&backend)
            )));
        }
        let chosen = [Some(backend), self.against];
        options.fit(&chosen.into_iter().flatten().collect::<Vec<_>>())?;
        options.select(backend)
    }
}

fn draw_overlay(
    expected: &OnePatch,
    observed: &OnePatch,
    options: &DrawOptions,
) -> (Drawing, Exit) {
    let (drawing, differences) = tess_show::overlay(&expected.listing, &observed.listing, options);
    let (points, primitives) = (differences.points, differences.primitives);
    note(&format!(
        "differences between {} and {}: {} and {}",
        expected.backend,
        observed.backend,
        counted(points as u64, "point"),
        counted(primitives as u64, "primitive")
    ));
    const SHOWN: usize = 20;
    let words = &differences.in_words;
    words.iter().take(SHOWN).for_each(|line| note(line));
    if words.len() > SHOWN {
        note(&format!("and {} more like these", words.len() - SHOWN));
    }
    let equal = points == 0 && primitives == 0;
    (drawing, if equal { Exit::Done } else { Exit::Different })
}

fn report_left_out(drawing: &Drawing) {
    if drawing.labels_left_out > 0 {
        let count = drawing.labels_left_out;
        let numbers = counted(count as u64, "number");
        note(&format!("{numbers} left out for lack of room; a larger --size shows more"));
    }
}

/// The listing of the same case in a file.
fn find_listing(path: &Path, patch: &OnePatch) -> Result<OnePatch, Failure> {
    let file = File::open(path).map_err(|error| Failure::file("read", path, &error))?;
    let name = path.display().to_string();
    let mut found = None;
    for record in VectorFile::new(name, BufReader::new(file)).map_err(Failure::bad_input)? {
        match record.map_err(Failure::bad_input)? {
            Record::Listing(listing) if listing.case == *patch.case() => found = Some(listing),
            Record::Coordinates(vertices) if vertices.case == *patch.case() => {
                found = Some(vertices.numbered());
            }
            _ => {}
        }
    }
    if let Some(listing) = found {
        return Ok(OnePatch { listing, backend: "the listing" });
    }
    Err(Failure::bad_input(format!(
        "{}: no listing of this patch; it would start with `{}`",
        path.display(),
        patch.case()
    )))
}
