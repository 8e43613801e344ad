//! `tess probe`: compares a Vulkan device's fixed-function tessellator with the model.

#[cfg(feature = "shaders")]
mod bench;

use crate::args::{Choices, SelectionArgs, choice, name_of};
use crate::campaign::cases::CaseSet;
use crate::campaign::report::{First as FirstOf, PASSES_ALONE, Report, ReportPart};
use crate::campaign::{Invocation, KnownArgs, Placed, Recorder, ReportArgs};
use crate::comparison::{CONVERSIONS, DENORMALS, rules};
use crate::failure::{Exit, Failure};
use crate::formats::PictureFormat;
use crate::output::form;
use crate::output::{OutputArgs, Role, json, note, progress, refuse_shared};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tess_probe::{First, ProbeReport, Prober, cases, list, probe_known};
use tess_show::DrawOptions;
use tess_verify::check::{Conversion, Denormals, Known, ListOrder, Strength};
use tess_verify::generate::{GenLevel, Selection, Shard};
use tess_verify::rules::Specification;
use tess_verify::vectors::Listing;

/// Compare the tessellator of a Vulkan device with the model
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Sends the patches of `tess gen` through the fixed-function tessellator of a device, captures the domain
points of every primitive, and compares them bit by bit. The table counts, for each configuration, the
patches whose primitives are the model's in order, with another leading vertex (leading), in another
order (reorder), with other connections (connected), with other points (points, and by how many units of
2^-16), culled by only one of the two (culling), and with a wrong third coordinate (third). Explanations
of the differences follow, and the first difference that no freedom of the specification explains.

Exit code 0: equal, or equal under the freedoms asked for; 1: different; 2: bad usage; 3: no such device.

Examples:
  tess probe                            is this device exact?
  tess probe --list
  tess probe --device 1 --level 2 --denormals flush
  tess probe --level 3 --seed 7 --count 100000 --shard 1/8
  tess probe --json -o device.json --picture first.png
  tess probe --level 2 --shard 1/8 --report report-1.jsonl --junit junit-1.xml
  tess probe --known deviations.txt
  tess probe --rules vulkan
  tess probe --bench                    is compute faster than the hardware?")]
pub(crate) struct ProbeCommand {
    /// List the devices and end
    #[arg(long)]
    list: bool,
    /// Number of the device in --list
    #[arg(long, value_name = "N", default_value_t = 0)]
    device: usize,
    #[command(flatten)]
    selection: SelectionArgs,
    /// Order of primitives that counts as equal
    #[arg(long, value_name = "NAME", default_value = "any", value_parser = choice(LIST_ORDERS))]
    order: ListOrder,
    /// Conversion of factors that counts as equal
    #[arg(long, value_name = "NAME", default_value = "exact", value_parser = choice(CONVERSIONS))]
    conversion: Conversion,
    /// Treatment of positive denormal outer factors that counts as equal
    #[arg(long, value_name = "NAME", default_value = "keep", value_parser = choice(DENORMALS))]
    denormals: Denormals,
    /// Capture only domain points, as on devices without transform feedback
    #[arg(long)]
    points: bool,
    /// Largest number of vertices in a draw. Drivers whose vertex numbers wrap around give other
    /// results above 65536
    #[arg(long, value_name = "N", default_value_t = tess_probe::DRAW_VERTICES)]
    draw_vertices: usize,
    /// Instead: judge the device by the rules of this standard: vulkan, opengl or d3d11
    /// (docs/rules.md)
    #[arg(long, value_name = "NAME", value_parser = name_of::<Specification>())]
    #[arg(conflicts_with_all = ["level", "given", "points", "picture", "json"])]
    rules: Option<Specification>,
    /// Write the report as JSON (docs/probe.md explains it)
    #[arg(long)]
    json: bool,
    /// Draw the first unexplained patch, the model in grey and the device in red: .svg or .png
    #[arg(long, value_name = "FILE")]
    picture: Option<PathBuf>,
    /// Time the fixed-function stage and the compute shaders, and the drawing of their results
    #[cfg(feature = "shaders")]
    #[arg(long, conflicts_with_all = ["points", "picture", "rules", "known", "report", "junit"])]
    bench: bool,
    /// With --bench: workloads of `tess bench` [default: uniform, terrain and character]
    #[cfg(feature = "shaders")]
    #[arg(long, value_name = "NAME", requires = "bench")]
    workload: Vec<String>,
    /// With --bench: whether the compute shaders check every access and every loop
    #[cfg(feature = "shaders")]
    #[arg(long, value_name = "WHICH", default_value = "full", requires = "bench")]
    checks: super::shaders::Checks,
    #[command(flatten)]
    known: KnownArgs,
    #[command(flatten)]
    report: ReportArgs,
    #[command(flatten)]
    output: OutputArgs,
}

const LIST_ORDERS: Choices<ListOrder> = &[
    ("sequence", ListOrder::Sequence, "The model's"),
    ("any", ListOrder::Any, "Any, and any leading vertex of a triangle"),
];

/// Runs the command. Errors: Vulkan or the device is missing; the device cannot be captured, or
/// fails; there are no cases; an output cannot be written.
pub(crate) fn run(args: &ProbeCommand, invocation: &Invocation) -> Result<Exit, Failure> {
    if args.list {
        return args.list_devices();
    }
    #[cfg(feature = "shaders")]
    if args.bench {
        let ProbeCommand { device, workload, checks, json, output, .. } = args;
        return bench::run(*device, workload, *checks, *json, output).map(|()| Exit::Done);
    }
    let drawn = args.picture.iter().map(|file| Role::output("--picture", file));
    let others = args.known.role().into_iter().chain(args.report.roles());
    refuse_shared(&drawn.chain([args.output.role()]).chain(others).collect::<Vec<_>>())?;
    args.report.record(invocation, &[], |recorder| args.probe(recorder))
}

impl ProbeCommand {
    fn probe(&self, recorder: &Recorder) -> Result<Exit, Failure> {
        let placed = match self.rules {
            Some(_) => self.selection.shard.whole("probe --rules")?,
            None => self.selection.shard.place()?,
        };
        recorder.place(placed);
        let known = self.known.read(self.rules)?;
        known.note(recorder);
        self.output.require_writable()?;
        let picture = self.picture.as_deref().map(FirstPicture::prepare).transpose()?;
        let exit = match self.rules {
            Some(specification) => self.judge(specification, &known.known, recorder)?,
            None => self.compare(placed, picture.as_ref(), &known.known, recorder)?,
        };
        Ok(known.conclude(recorder, placed, exit))
    }

    /// Compares the device with the model.
    fn compare(
        &self,
        placed: Placed,
        picture: Option<&FirstPicture>,
        known: &Arc<Known>,
        recorder: &Recorder,
    ) -> Result<Exit, Failure> {
        let args = self;
        let selection = args.selection.selection();
        let cases = cases(selection, placed.shard);
        if cases.is_empty() && tess_probe::cases(selection, Shard::WHOLE).is_empty() {
            return Err(Failure::bad_input("these arguments select no case"));
        }
        if cases.is_empty() {
            note(&format!("no case in shard {placed}"));
        }
        let open = if args.points { Prober::open_for_points } else { Prober::open };
        let mut prober =
            open(args.device).map_err(Failure::unavailable)?.with_draw_vertices(args.draw_vertices);
        let bar = progress(cases.len() as u64, "patches");
        let strength = args.strength();
        let report = probe_known(&mut prober, &cases, strength, known, |patches| bar.inc(patches));
        bar.finish_and_clear();
        let report = report.map_err(Failure::unavailable)?;
        recorder.asks(Some(CaseSet::of_device(&selection)));
        recorder.saw(&cases);
        recorder.update(|record| note_parts(record, &report));
        if let (Some(picture), Some(first)) = (picture, &report.unexplained.first) {
            picture.draw(first)?;
        }
        let text = if args.json { json(&report) } else { report.to_string() };
        args.output.write(text.as_bytes())?;
        Ok(verdict(&report))
    }

    fn list_devices(&self) -> Result<Exit, Failure> {
        let devices = list().map_err(Failure::unavailable)?;
        if devices.is_empty() {
            return Err(Failure::unavailable("Vulkan is here, but no driver has a device"));
        }
        let lines = devices.iter().map(|device| device.to_string() + "\n");
        let text = if self.json { json(&devices) } else { lines.collect() };
        self.output.write(text.as_bytes())?;
        Ok(Exit::Done)
    }

    /// Judges the device by the rules of a standard.
    fn judge(
        &self,
        specification: Specification,
        known: &Known,
        recorder: &Recorder,
    ) -> Result<Exit, Failure> {
        let mut prober = Prober::open(self.device).map_err(Failure::unavailable)?;
        let selection = Selection { level: GenLevel::Rules, ..self.selection.selection() };
        let bar = progress(selection.cases().count() as u64, "patches");
        let report =
            tess_probe::rules(&mut prober, selection, specification, |patches| bar.inc(patches));
        bar.finish_and_clear();
        note(&prober.info().to_string());
        recorder.asks(Some(CaseSet::of_device(&selection)));
        recorder.saw(tess_probe::rule_cases(selection));
        rules::conclude("device", &report.map_err(Failure::unavailable)?, known, recorder)
    }

    fn strength(&self) -> Strength {
        Strength {
            order: self.order,
            conversion: self.conversion,
            denormals: self.denormals,
            ..Strength::default()
        }
    }
}

/// Notes the result on stderr, and returns the exit code.
fn verdict(report: &ProbeReport) -> Exit {
    let ProbeReport { patches, different, known, .. } = report;
    if *different > 0 {
        note(&format!("different: {different} of {patches} patches"));
        if report.passes_alone {
            note(&format!("the first {PASSES_ALONE}"));
        }
        return Exit::Different;
    }
    if *known > 0 {
        let equal = patches - known;
        note(&format!("equal: {equal} of {patches} patches; the differences of {known} are known"));
    } else if *patches > 0 {
        note(&format!("equal: all {patches} patches, as far as they were compared"));
    }
    Exit::Done
}

/// Adds the configurations, with the first difference of each.
fn note_parts(record: &mut Report, report: &ProbeReport) {
    // Only the first patch of all was repeated by itself.
    let repeated = report.first_different.as_ref().filter(|_| report.passes_alone);
    let first = |(line, difference): &(String, String)| FirstOf {
        case: Some(line.clone()),
        difference: difference.clone(),
        passes_alone: repeated.is_some_and(|first| first.line == *line),
    };
    for row in &report.rows {
        record.add_part(ReportPart {
            name: format!("{} {} {}", row.domain, row.partitioning, row.output),
            cases: row.patches,
            mismatches: row.different,
            first: row.first.as_ref().map(first),
        });
    }
    record.add_stages(report.stages.iter().map(|(stage, more)| (stage, *more)));
}

/// A picture that will be drawn if there is a difference.
struct FirstPicture {
    format: PictureFormat,
    output: OutputArgs,
}

impl FirstPicture {
    /// Determines the format and tries the place, before the device is used. Errors: a name that
    /// implies no format; a place that cannot be written.
    fn prepare(file: &Path) -> Result<Self, Failure> {
        let format = form::choose(None, file)?;
        let output = OutputArgs { file: file.to_owned() };
        output.require_writable()?;
        Ok(Self { format, output })
    }

    /// Draws the model's patch, with the device's output over it.
    fn draw(&self, first: &First) -> Result<(), Failure> {
        let Some(output) = first.captured.output() else {
            note("no picture: a coordinate of the device cannot be drawn");
            return Ok(());
        };
        let case = first.case;
        let listing = |output| Listing { case, output, line: 0 };
        let expected = listing(case.patch().tessellate());
        let options = DrawOptions { size: 800, ..DrawOptions::default() };
        let (drawing, _) = tess_show::overlay(&expected, &listing(output), &options);
        self.output.write(&self.format.render(&drawing)?)
    }
}
