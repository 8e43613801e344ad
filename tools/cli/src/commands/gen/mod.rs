//! `tess gen`: test vectors with expected results from the model.

mod images;
mod stages;

use crate::args::{SelectionArgs, name_of};
use crate::campaign::cases::CaseSet;
use crate::campaign::report::ReportPart;
use crate::campaign::{Invocation, Placed, Recorder, ReportArgs};
use crate::coverage_file::{self, CoverageFile};
use crate::failure::{Exit, Failure};
use crate::output::{NewFolder, OutputArgs, Role, note, progress, refuse_shared, refuse_stdout};
use clap::ValueEnum;
use indicatif::ProgressBar;
use stages::StageBlock;
use std::fs::File;
use std::io::{self, BufWriter, IsTerminal, Write};
use std::path::{Path, PathBuf};
use tess_core::SplitOrder;
use tess_verify::Case;
use tess_verify::cover::{Coverage, Exclusions};
use tess_verify::generate::{GenLevel, Selection, Shard, configurations_among};
use tess_verify::vectors::{Header, Kind, write_cases};

/// Generate test vectors with expected results; equal arguments give equal bytes
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Level 1 has every boundary once and hits every coverage bin of the selected configurations; level 2 has every boundary in every position; level 3 is random. Each ends with --count random cases (500, 20000 and 1000000 by default).

--rules generates patches for `tess check --rules`: every number of segments and every class of value in every role and spacing, every number on an edge with every number inside, in each split order, and their relatives: pairs that differ in one level, exchanged levels, other outputs. A shard separates some families.

Examples:
  tess gen --level 1 | tess check - --backend simd
  tess gen --level 1 --domain tri --format listing -o level1.txt
  tess gen --level 1 --partitioning integer --output triangle_cw --split ruler --format listing
  tess gen --level 3 --seed 7 --count 1000 --format readmemh -o vectors/
  tess gen --rules --split ruler --format listing | ./my-device | tess check - --rules vulkan
  tess gen --stage place --format readmemh -o place.memh
  tess gen --level 1 --coverage
  tess gen --level 2 --shard 1/8 --coverage coverage.xml
  tess gen --level 2 --shard 1/8 -o vectors-1.csv --report report-1.jsonl")]
pub(crate) struct GenCommand {
    #[command(flatten)]
    selection: SelectionArgs,
    /// Instead of a level: families of patches that the rules of the standards compare, and --count
    /// random ones
    #[arg(long, conflicts_with = "level")]
    rules: bool,
    /// Only this split order
    #[arg(long, value_name = "NAME", value_parser = name_of::<SplitOrder>())]
    split: Option<SplitOrder>,
    /// Instead of patches: the inputs and outputs of one stage for them (factors, context, place or
    /// stitch)
    ///
    /// For testing a block of a circuit. Each distinct row is written once, as CSV or, with
    /// --format readmemh, as one image.
    #[arg(long, value_name = "NAME", value_parser = name_of::<StageBlock>(), conflicts_with = "coverage")]
    stage: Option<StageBlock>,
    /// Format of the vectors
    #[arg(long, value_name = "NAME", default_value = "csv")]
    format: VectorFormat,
    /// Instead of vectors: report which coverage bins they hit
    ///
    /// Bins that no selected configuration can hit are excluded. With a FILE, the hits are added to
    /// that file of UCIS XML, and the sum is reported. Shards may add to one file, even at the same
    /// time.
    #[arg(long, value_name = "FILE", num_args = 0..=1, conflicts_with = "format")]
    coverage: Option<Option<PathBuf>>,
    #[command(flatten)]
    report: ReportArgs,
    #[command(flatten)]
    output: OutputArgs,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum VectorFormat {
    /// Counts and digests, as in golden/patches.csv
    Csv,
    /// Whole outputs, as in golden/cases.txt
    Listing,
    /// Images for Verilog's $readmemh, in a folder
    Readmemh,
}

/// Runs the command. Errors: a selection without cases; an output that cannot be written.
pub(crate) fn run(args: &GenCommand, invocation: &Invocation) -> Result<Exit, Failure> {
    refuse_shared(&args.roles()?)?;
    args.report.record(invocation, &[], |recorder| generate(args, recorder))
}

fn generate(args: &GenCommand, recorder: &Recorder) -> Result<Exit, Failure> {
    let placed = args.selection.shard.place()?;
    recorder.place(placed);
    recorder.asks(Some(CaseSet::of(&args.selection())));
    let all = args.all();
    let count = placed.shard.items(all);
    if count == 0 && all > 0 {
        note(&format!("no case in shard {placed}"));
    }
    if all == 0 {
        return Err(Failure::bad_input(
            "these arguments select no case; give --level 1 or 2, or a --count",
        ));
    }
    if let Some(file) = &args.coverage {
        return args.report_coverage(file.clone(), count, placed, recorder);
    }
    if let Some(block) = args.stage {
        return args.stage(block, count, placed, recorder);
    }
    let header = args.header(count, placed);
    let bar = args.progress(count);
    let cases = bar.wrap_iter(args.cases(placed, recorder));
    let written = match args.format {
        VectorFormat::Csv | VectorFormat::Listing => {
            args.output.stream(|out| write_cases(out, &header, cases))
        }
        VectorFormat::Readmemh => write_folder(&args.output.file, cases),
    };
    bar.finish_and_clear();
    written?;
    recorder.update(|report| report.add_part(part(count)));
    Ok(Exit::Done)
}

/// The report's entry about the generated vectors.
fn part(cases: u64) -> ReportPart {
    ReportPart { name: "vectors".to_owned(), cases, ..ReportPart::default() }
}

impl GenCommand {
    /// The files of the command. Errors: the path cannot be that of a coverage file.
    fn roles(&self) -> Result<Vec<Role<'_>>, Failure> {
        let coverage = self.coverage.iter().flatten().map(|path| coverage_file::role(path));
        let coverage: Vec<_> = coverage.collect::<Result<_, _>>()?;
        Ok(coverage.into_iter().chain([self.output.role()]).chain(self.report.roles()).collect())
    }

    fn selection(&self) -> Selection {
        let selection = self.selection.selection();
        let level = if self.rules { GenLevel::Rules } else { selection.level };
        Selection { split: self.split, level, ..selection }
    }

    fn cases(&self, placed: Placed, recorder: &Recorder) -> impl Iterator<Item = Case> {
        let numbered = (0..).zip(self.selection().cases());
        let own = numbered.filter(move |(i, _)| placed.shard.has(*i)).map(|(_, case)| case);
        own.inspect(|case| recorder.saw([case]))
    }

    /// Writes the vectors of one stage.
    fn stage(
        &self,
        block: StageBlock,
        count: u64,
        placed: Placed,
        recorder: &Recorder,
    ) -> Result<Exit, Failure> {
        let write = match self.format {
            VectorFormat::Csv => stages::write_csv,
            VectorFormat::Readmemh => stages::write_memh,
            VectorFormat::Listing => {
                return Err(Failure::bad_input("a stage has no listing: --format csv or readmemh"));
            }
        };
        let bar = self.progress(count);
        let rows = stages::rows(block, bar.wrap_iter(self.cases(placed, recorder)));
        bar.finish_and_clear();
        self.output.stream(|out| write(out, block, &rows))?;
        recorder.update(|report| report.add_part(part(count)));
        Ok(Exit::Done)
    }

    /// Reports the coverage of the cases, added to the contents of a file if one is given.
    fn report_coverage(
        &self,
        file: Option<PathBuf>,
        count: u64,
        placed: Placed,
        recorder: &Recorder,
    ) -> Result<Exit, Failure> {
        let mut file = file.map(CoverageFile::open).transpose()?;
        let mut alone = Coverage::default();
        let coverage = file.as_mut().map_or(&mut alone, |file| &mut file.coverage);
        let bar = self.progress(count);
        coverage.record_stream(None, bar.wrap_iter(self.cases(placed, recorder)));
        bar.finish_and_clear();
        recorder.update(|report| report.add_part(part(count)));
        // The file may also have hits of other configurations.
        let Selection { domain, partitioning, output, split, .. } = self.selection();
        let outside = Exclusions::outside(configurations_among(
            &Vec::from_iter(domain),
            &Vec::from_iter(partitioning),
            &Vec::from_iter(output),
            &Vec::from_iter(split),
        ));
        let report =
            |sum: &Coverage| self.output.write(sum.report(&outside.not_hit(sum)).as_bytes());
        match file {
            Some(file) => file.add(report)?,
            None => report(&alone)?,
        }
        Ok(Exit::Done)
    }

    /// The number of cases in all shards.
    fn all(&self) -> u64 {
        let selection = self.selection();
        let systematic = Selection { random: Some(0), ..selection }.cases().count() as u64;
        systematic.saturating_add(selection.random_count())
    }

    /// A progress bar for this many cases; hidden if vectors go to the same terminal.
    fn progress(&self, count: u64) -> ProgressBar {
        if self.output.is_stdout() && io::stdout().is_terminal() {
            return ProgressBar::hidden();
        }
        progress(count, "cases")
    }

    /// The first line of the output, with the arguments on which the cases depend as notes.
    fn header(&self, count: u64, placed: Placed) -> Header {
        let mut notes = CaseSet::of(&self.selection()).notes();
        if placed.shard != Shard::WHOLE {
            let shard = format!("{}/{}", placed.shard.part + 1, placed.shard.of);
            notes.push(("shard".to_owned(), shard));
        }
        let source = "tess-core".to_owned();
        let kind =
            if self.format == VectorFormat::Listing { Kind::Listings } else { Kind::Patches };
        Header { kind, count: Some(count), source, notes }
    }
}

/// Writes the memory images into a new folder.
fn write_folder(folder: &Path, cases: impl Iterator<Item = Case>) -> Result<(), Failure> {
    refuse_stdout(folder, "readmemh writes several files")?;
    let write = || {
        let new = NewFolder::create(folder)?;
        write_images(new.path(), cases)?;
        new.finish()
    };
    write().map_err(|error| Failure::write(folder, error))
}

fn write_images(folder: &Path, cases: impl Iterator<Item = Case>) -> io::Result<()> {
    let create = |name| File::create(folder.join(name)).map(BufWriter::new);
    let [a, b, c, d, e] = images::FILES;
    let mut files = [create(a)?, create(b)?, create(c)?, create(d)?, create(e)?];
    images::write_images(&mut files.each_mut().map(|file| file as &mut dyn Write), cases)?;
    files.iter_mut().try_for_each(Write::flush)
}
