//! `tess check`: runs the cases of a vector file and compares the results.

mod asked;
mod failures;
mod record;
mod rules;
mod strength;

use crate::args::name_of;
use crate::backends::{BackendName, BackendOptions};
use crate::campaign::report::{PASSES_ALONE, period_text};
use crate::campaign::{Invocation, KnownArgs, Recorder, ReportArgs, ShardArgs};
use crate::coverage_file::{self, CoverageFile};
use crate::failure::{Exit, Failure};
use crate::input::{self, Reader};
use crate::output::{Role, Trusted, counted, progress, refuse_shared, stdout};
use asked::{AskedCases, Source};
use failures::Failures;
use indicatif::ProgressBar;
use std::collections::HashSet;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::thread::available_parallelism;
use strength::StrengthArgs;
use tess_verify::check::{
    self, CheckError, Checked, Difference, Known, MAX_DIFFERENCES, Report, Tested,
};
use tess_verify::rules::Specification;
use tess_verify::vectors::{Cases, Kind, Record, VectorError, VectorFile};
use tess_verify::{Backend, Case, Named};

/// Compare a file of test vectors, or the listings of a device under test, with a backend
#[derive(Debug, clap::Args)]
#[command(after_help = "\
The first differences and a summary line go to stdout. Each difference shows the case, the first wrong element with the observed and the right value in hex, the stage of the specification that it points to, and commands that reproduce it.

With --backend, that backend is tested, and the file is right. Without it, a file of listings has the answers of a device under test, and the model is right; with a file of any other kind, the model is tested. Only the command line decides this, not the contents of the file.

Listings of a device are compared at a strength: --order, --points, --conversion and --denormals grant freedoms of the public specification (docs/verification.md).

With --cases, the file must answer those cases, one for one and in their order. They are a vector file, or lines that begin with `case`. Without it, the file must answer the cases of `tess gen` that the notes in its first line describe (level, seed and so on); a file without such notes is compared record by record. A case without an answer is one difference (`record 9 is missing`), and so is an answer to another case; the explanation with the fewest differences counts.

A file may be one shard of a campaign (docs/campaigns.md). Its number comes from --shard, from the batch system, or from the note shard=I/N in the first line of --cases or FILE; they may not contradict each other.

If one mistake explains every difference (such as u and v exchanged, or levels rounded to binary16) and no right record refutes it, a line names it, and only the first difference is shown. The line ends with the conditions under which the mistake shows, such as a domain, if there are some; of several mistakes the shortest is named (docs/rules.md, Mistakes). If a freedom that was not granted explains them (--order any, --denormals flush, --conversion 0.6ulp), a line names its option. More than 20 differences are counted in a table by stage and configuration, with the smallest case of each.

With --rules, listings are judged by the demands of a standard, without the model: each rule with its section, how many patches it judged and how many broke it, the smallest patches that break it, and the levels that were not asked: a rule is `held` only if none is missing, else `held as far as asked`. --cases and --known apply too. `tess gen --rules` makes patches that exercise every rule (docs/rules.md). The last line counts the patches that equal the model's, in its order or in another: Direct3D 11 demands that order, Vulkan and OpenGL do not. They also leave some triangles and places to the device, so a different patch need not break a rule. The line does not change the exit code.

Exit code 0: all equal, or no rule broken; 1: differences; 2: malformed, truncated or empty file, whose differences before that place are shown; 3: the backend is not available.

Examples:
  tess check golden/cases.txt
  tess check golden/place.csv --backend simd
  tess check golden/cases.txt --backend gpu --index-type u16
  tess patch tri --outer 3,4,5 --inner 4 | tess check -
  ./my-device | tess check - --order any --conversion 0.6ulp
  tess check device.txt --cases asked.txt --failures failing.txt
  tess check device.txt --rules vulkan --cases asked.txt --known baseline.txt
  tess check device.txt --known deviations.txt
  tess check device-3.txt --cases asked-3.txt --report report-3.jsonl --junit junit-3.xml")]
pub(crate) struct CheckCommand {
    /// Vector file; - is stdin
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Backend to test; without it, a device's listings, or the model
    #[arg(long, value_name = "NAME")]
    backend: Option<BackendName>,
    #[command(flatten)]
    options: BackendOptions,
    #[command(flatten)]
    strength: StrengthArgs,
    /// Judge listings by the rules of this standard: vulkan, opengl or d3d11
    #[arg(long, value_name = "NAME", value_parser = name_of::<Specification>())]
    #[arg(conflicts_with_all = [
        "backend", "cpu_level", "index_type", "order", "points", "conversion",
        "denormals", "failures", "coverage",
    ])]
    rules: Option<Specification>,
    /// Cases that were asked; missing, extra and other answers are differences
    #[arg(long, value_name = "FILE")]
    cases: Option<PathBuf>,
    /// Write the records that differ to this file, in their order; `tess check` can read it
    #[arg(long, value_name = "FILE")]
    failures: Option<PathBuf>,
    /// Add the coverage bins that the file's patches hit to this file of UCIS XML
    #[arg(long, value_name = "FILE")]
    coverage: Option<PathBuf>,
    #[command(flatten)]
    shard: ShardArgs,
    #[command(flatten)]
    known: KnownArgs,
    #[command(flatten)]
    report: ReportArgs,
}

/// Runs the command.
///
/// # Errors
/// Malformed, short or empty input; an unavailable backend.
pub(crate) fn run(args: &CheckCommand, invocation: &Invocation) -> Result<Exit, Failure> {
    refuse_shared(&args.roles()?)?;
    args.known.refuse_judged("the file to check", &Role::input("FILE", &args.file))?;
    if let Some(cases) = &args.cases {
        args.known.refuse_judged("what is asked", &Role::input("--cases", cases))?;
    }
    args.strength.tested(Kind::Listings, args.backend)?;
    let failures = args.failures.as_deref().map(Trusted::failures);
    let others: Vec<_> = failures.into_iter().collect();
    args.report.record(invocation, &others, |recorder| check(args, recorder))
}

fn check(args: &CheckCommand, recorder: &Recorder) -> Result<Exit, Failure> {
    // The backends are opened before stdin is read, which may take long.
    let backends = backends(args);
    let file =
        VectorFile::new(args.name(), input::reader(&args.file)?).map_err(|e| failure(e.into()))?;
    let given = args.asked(file.header().kind)?;
    let asked_header = given.as_ref().and_then(Cases::header);
    let placed = record::place(args.shard, file.header(), asked_header)?;
    recorder.place(placed);
    let known = args.known.read(args.rules)?;
    known.note(recorder);
    let (asked, source) = asked::asked(given, file.header(), placed.shard, recorder);
    let exit = match args.rules {
        Some(specification) => {
            rules::run(file, (asked, source), specification, &known.known, recorder)?
        }
        None => compare(args, file, (asked, source), &known.known, backends?, recorder)?,
    };
    Ok(known.conclude(recorder, placed, exit))
}

/// Compares the records of a file.
fn compare(
    args: &CheckCommand,
    file: VectorFile<Reader>,
    (mut asked, source): (Option<AskedCases<'_>>, Source),
    known: &Known,
    mut backends: Vec<Box<dyn Backend>>,
    recorder: &Recorder,
) -> Result<Exit, Failure> {
    let tested = args.strength.tested(file.header().kind, args.backend)?;
    let coverage = args.coverage(file.header().kind)?;
    let failures = args.failures.as_deref().map(|path| Failures::new(path, file.header()));
    let failures = failures.transpose()?;
    let bar = file.header().count.map_or_else(ProgressBar::hidden, |n| progress(n, "records"));
    let asked = asked.as_mut().map(|asked| asked as _);
    let right = Mutex::new(HashSet::new());
    let report = check::check_asked(file, asked, known, &mut backends, tested, &|checked| {
        bar.inc(checked.records.len() as u64);
        source.see(checked, recorder);
        note_right(&mut right.lock().unwrap_or_else(PoisonError::into_inner), checked);
        recorder.update(|report| record::add(report, checked));
        if let Some(failures) = &failures {
            failures.add(checked);
        }
        if let Some(coverage) = &coverage {
            let coverage = &mut coverage.lock().unwrap_or_else(PoisonError::into_inner).coverage;
            let cases = checked.records.iter().filter_map(Record::case);
            coverage.record_stream(checked.before, cases);
        }
    });
    bar.finish_and_clear();
    let (mut report, malformed) = so_far(report)?;
    let right = right.into_inner().unwrap_or_else(PoisonError::into_inner);
    for difference in &mut report.differences {
        difference.passes_alone |= difference.case.is_some_and(|case| right.contains(&case));
    }
    recorder.update(|record| record::finish(record, &report));
    source.explain(&report);
    let backend = backends.first().map_or("core", |backend| backend.name());
    let name = args.name();
    let sides = match tested {
        Tested::Listings(_) => format!("tested: {name}; right: the model"),
        _ => format!("tested: the backend {backend}; right: {name}"),
    };
    let backend = args.options.words(backend);
    let show = |end| {
        show(&report, &sides, &backend, &right, end)
            .map_err(|error| Failure::write(Path::new("-"), error))
    };
    if let Some(error) = malformed {
        show(NO_VERDICT)?;
        return Err(Failure::bad_input(error));
    }
    if let Some(coverage) = coverage {
        let coverage = coverage.into_inner().unwrap_or_else(PoisonError::into_inner);
        coverage.add(|_| Ok(()))?;
    }
    if let Some(failures) = failures {
        failures.finish(&report)?;
    }
    show("")?;
    Ok(if report.mismatches == 0 { Exit::Done } else { Exit::Different })
}

impl CheckCommand {
    /// The files of the command.
    ///
    /// # Errors
    /// The path cannot be that of a coverage file.
    fn roles(&self) -> Result<Vec<Role<'_>>, Failure> {
        let cases = self.cases.as_deref().map(|path| Role::input("--cases", path));
        let failures = self.failures.as_deref().map(|path| Role::output("--failures", path));
        let coverage = self.coverage.as_deref().map(coverage_file::role).transpose()?;
        let others = [cases, failures, coverage, self.known.role()].into_iter().flatten();
        let others = others.chain(self.report.roles());
        Ok([Role::input("FILE", &self.file), Role::stdout()].into_iter().chain(others).collect())
    }

    /// The file's name in messages.
    fn name(&self) -> String {
        input::name(&self.file)
    }

    /// The coverage file, if one is given.
    ///
    /// # Errors
    /// It cannot be read, or the file to check has no patches to count.
    fn coverage(&self, kind: Kind) -> Result<Option<Mutex<CoverageFile>>, Failure> {
        let Some(path) = &self.coverage else { return Ok(None) };
        if !kind.has_cases() {
            return Err(Failure::bad_input(format!(
                "--coverage counts single patches: the kinds listings, patches and preparation have \
                 them; this file's kind is {}",
                kind.name()
            )));
        }
        CoverageFile::open(path.clone()).map(|file| Some(Mutex::new(file)))
    }

    /// The asked cases, if they are given.
    ///
    /// # Errors
    /// They cannot be read, or the file to check has no patches that could answer them.
    fn asked(&self, kind: Kind) -> Result<Option<Cases<Reader>>, Failure> {
        let Some(path) = &self.cases else { return Ok(None) };
        if !kind.has_cases() {
            let kind = kind.name();
            return Err(Failure::bad_input(format!(
                "--cases is for records that are single patches; this file's kind is {kind}"
            )));
        }
        if Role::input("--cases", path).is_same_file(&Role::input("FILE", &self.file)) {
            return Err(Failure::bad_input("--cases is the file to check itself"));
        }
        input::cases(path).map(Some)
    }
}

/// One backend per thread. The model runs on every processor; the other backends use several by
/// themselves.
fn backends(args: &CheckCommand) -> Result<Vec<Box<dyn Backend>>, Failure> {
    let name = args.backend.unwrap_or(BackendName::Core);
    args.options.fit(&[name])?;
    let threads = match name {
        BackendName::Core => available_parallelism().map_or(1, usize::from),
        BackendName::Simd | BackendName::Gpu => 1,
    };
    (0..threads).map(|_| args.options.select(name)).collect()
}

/// Prints a report. Its last line has the numbers, followed by `end`.
fn show(
    report: &Report,
    sides: &str,
    backend: &str,
    right: &HashSet<Case>,
    end: &str,
) -> io::Result<()> {
    let mut out = stdout();
    if report.mismatches > 0 {
        writeln!(out, "{sides}")?;
    }
    let mistake = report.mistake();
    if let Some(mistake) = mistake {
        let all = counted(report.mismatches, "difference");
        writeln!(out, "one mistake explains all {all}: {}", mistake.words())?;
    }
    let groups = report.groups();
    let is_long = mistake.is_none() && report.mismatches > report.differences.len() as u64;
    if is_long {
        groups.iter().try_for_each(|group| writeln!(out, "{group}"))?;
    }
    let all: Vec<&Difference> = if is_long {
        groups.iter().map(|group| &group.smallest).take(MAX_DIFFERENCES).collect()
    } else {
        report
            .differences
            .iter()
            .take(if mistake.is_some() { 1 } else { MAX_DIFFERENCES })
            .collect()
    };
    for difference in &all {
        show_one(&mut out, difference, backend)?;
        let is_right = |case| right.contains(&case);
        if difference.passes_alone || difference.case.is_some_and(is_right) {
            writeln!(out, "  {PASSES_ALONE}")?;
        }
    }
    let hidden = report.mismatches - all.len() as u64;
    if hidden > 0 {
        writeln!(out, "and {hidden} more")?;
    }
    if let Some(freedoms) = report.freedoms() {
        let all = counted(report.mismatches, "difference");
        writeln!(out, "{} would accept all {all}: {}", freedoms.options(), freedoms.words())?;
    }
    if let Some(period) = report.period() {
        writeln!(out, "{}", period_text(period))?;
    }
    writeln!(out, "{report}{end}")?;
    out.flush()
}

/// Remembers cases that are right, from at most the first million records. If such a case differs
/// elsewhere, the result depends on earlier work of the device.
fn note_right(right: &mut HashSet<Case>, checked: Checked<'_>) {
    const MOST: usize = 1 << 20;
    let pairs = checked.records.iter().zip(checked.different);
    let cases = pairs.filter(|(_, different)| !**different).filter_map(|(one, _)| one.case());
    right.extend(cases.take(MOST.saturating_sub(right.len())));
}

/// Prints a difference, the origin of its first wrong element in the model, and the commands that
/// reproduce it.
fn show_one(out: &mut impl Write, difference: &Difference, backend: &str) -> io::Result<()> {
    writeln!(out, "{difference}")?;
    for line in tess_show::origin(difference).unwrap_or_default().lines() {
        writeln!(out, "  model: {line}")?;
    }
    difference.commands(backend).iter().try_for_each(|command| writeln!(out, "  again: {command}"))
}

/// The end of the summary line for the records before a malformed one.
const NO_VERDICT: &str = " before the malformed record; there is no verdict";

/// Separates a complete report from one of the records before a malformed record: that one is
/// shown, but is not a verdict.
///
/// # Errors
/// Any other failure.
fn so_far(report: Result<Report, CheckError>) -> Result<(Report, Option<VectorError>), Failure> {
    match report {
        Ok(report) => Ok((report, None)),
        Err(CheckError::Malformed { error, before }) => Ok((*before, Some(error))),
        Err(error) => Err(failure(error)),
    }
}

fn failure(error: CheckError) -> Failure {
    match error {
        CheckError::Backend(error) => error.into(),
        error => Failure::bad_input(error),
    }
}
