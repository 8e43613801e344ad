//! `tess verify`: compares every backend with the model.

use crate::args::name_of;
use crate::backends::{BackendName, BackendOptions};
use crate::campaign::cases::CaseSet;
use crate::campaign::report::{First, PASSES_ALONE, Report, ReportPart};
use crate::campaign::{Invocation, KnownArgs, Placed, Recorder, ReportArgs, ShardArgs};
use crate::comparison::rules;
use crate::failure::{Exit, Failure};
use crate::output::{Role, note, print, progress, refuse_shared};
use std::fmt::Write;
use std::time::Instant;
use tess_core::SplitOrder;
use tess_verify::check::{Known, SecondFormulation, Subject, SubjectRow, verify};
use tess_verify::generate::{GenLevel, Selection};
use tess_verify::rules::{Specification, check_rules};
use tess_verify::{Backend, Named};

/// Compare every backend with the model, over generated levels or over everything finite
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Without --exhaustive: levels 1 and 2 of `tess gen`; the row level-2 has the cases of level 2 that level 1 does not have. With --exhaustive, also all 2^32 factors in every partitioning, all fixed-point factors with their contexts and locations, all transitions and all interiors. Shards are disjoint and together cover everything, so any batch system can distribute the work. A shard without units of a subject says so on stderr, and counts as equal. The rows of a subject are printed when it is done.

--random N compares N patches of each of the 96 configurations (domain, partitioning, output, split order) instead: all kinds of factors in every position, most of the patches small. The same seed gives the same patches, and a larger N begins with the patches of a smaller one.

--rules NAME judges each backend by the demands of a standard, without the model, over the patches of `tess gen --rules` (docs/rules.md). The backend core is then the model itself.

Exit code 0: all equal, or no rule broken; 1: differences; 3: a backend is not available.

Examples:
  tess verify
  tess verify --backend simd --exhaustive
  tess verify --exhaustive --shard 3/64
  tess verify --backend gpu --random 100000
  tess verify --backend simd --rules d3d11
  tess verify --exhaustive --shard 3/64 --report report-3.jsonl --junit junit-3.xml")]
pub(crate) struct VerifyCommand {
    /// Backend to compare; core is the model's second formulation [default: simd and gpu]
    #[arg(long, value_name = "NAME")]
    backend: Vec<BackendName>,
    #[command(flatten)]
    options: BackendOptions,
    /// Compare everything that is finite
    #[arg(long)]
    exhaustive: bool,
    /// Compare only this subject: level-1, level-2, transitions, interiors, locations or factors
    #[arg(long, value_name = "NAME", value_parser = name_of::<Subject>())]
    subject: Vec<Subject>,
    /// Instead: compare N random patches of each configuration
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    #[arg(conflicts_with_all = ["exhaustive", "subject"])]
    random: Option<u64>,
    /// Instead: judge by the rules of this standard: vulkan, opengl or d3d11
    #[arg(long, value_name = "NAME", value_parser = name_of::<Specification>())]
    #[arg(conflicts_with_all = ["exhaustive", "subject", "random", "given"])]
    rules: Option<Specification>,
    /// Seed of the random patches
    #[arg(long, value_name = "N", default_value_t = 1, requires = "random")]
    seed: u64,
    #[command(flatten)]
    shard: ShardArgs,
    #[command(flatten)]
    known: KnownArgs,
    #[command(flatten)]
    report: ReportArgs,
}

/// Runs the command. Errors: an unavailable backend.
pub(crate) fn run(args: &VerifyCommand, invocation: &Invocation) -> Result<Exit, Failure> {
    args.options.fit(args.backends())?;
    let roles = args.known.role().into_iter().chain([Role::stdout()]).chain(args.report.roles());
    refuse_shared(&roles.collect::<Vec<_>>())?;
    args.report.record(invocation, &[], |recorder| args.verify(recorder))
}

impl VerifyCommand {
    fn verify(&self, recorder: &Recorder) -> Result<Exit, Failure> {
        let placed = match self.rules {
            Some(_) => self.shard.whole("verify --rules")?,
            None => self.shard.place()?,
        };
        recorder.place(placed);
        let known = self.known.read(self.rules)?;
        known.note(recorder);
        let workers = self.workers()?;
        let exit = match self.rules {
            Some(specification) => self.judge(specification, &known.known, recorder)?,
            None => self.compare(workers, placed, &known.known, recorder)?,
        };
        Ok(known.conclude(recorder, placed, exit))
    }

    /// Compares the backends with the model.
    fn compare(
        &self,
        mut workers: Vec<Vec<Box<dyn Backend>>>,
        placed: Placed,
        known: &Known,
        recorder: &Recorder,
    ) -> Result<Exit, Failure> {
        recorder.asks(Some(CaseSet::of_subjects(&self.subjects())));
        let bar = progress(0, "units");
        print(&bar, &heading())?;
        let started = Instant::now();
        let mut all_equal = true;
        for subject in self.subjects() {
            bar.set_message(subject.name());
            let table = verify(&mut workers, subject, placed.shard, known, &|progress| {
                recorder.saw(progress.unit.cases());
                bar.set_length(progress.all);
                bar.set_position(progress.done);
            });
            let table = table.inspect_err(|_| bar.finish_and_clear())?;
            recorder.update(|report| record(report, &table));
            all_equal &= table.iter().all(|row| row.mismatches == 0);
            print(&bar, &lines(&table))?;
            bar.suspend(|| report_empty(&table, placed));
        }
        bar.finish_and_clear();
        print(&bar, &format!("in {} s\n", started.elapsed().as_secs()))?;
        Ok(if all_equal { Exit::Done } else { Exit::Different })
    }

    fn subjects(&self) -> Vec<Subject> {
        match self.random {
            Some(patches) => vec![Subject::Random { patches, seed: self.seed }],
            None if !self.subject.is_empty() => self.subject.clone(),
            None if self.exhaustive => Subject::ALL.to_vec(),
            None => vec![Subject::Level1, Subject::Level2],
        }
    }

    /// Judges each backend by the rules of a standard.
    fn judge(
        &self,
        specification: Specification,
        known: &Known,
        recorder: &Recorder,
    ) -> Result<Exit, Failure> {
        let split = Some(SplitOrder::Ruler);
        let selection = Selection { split, ..Selection::level(GenLevel::Rules, 1) };
        recorder.asks(Some(CaseSet::of(&selection)));
        let cases: Vec<_> = selection.cases().collect();
        let mut exit = Exit::Done;
        for &name in self.backends() {
            let mut backend = self.options.select(name)?;
            let bar = progress(cases.len() as u64, "patches");
            let cases = cases.iter().copied();
            let report =
                check_rules(backend.as_mut(), cases, specification, |n| bar.set_position(n));
            bar.finish_and_clear();
            note(&format!("{}: {}", backend.name(), backend.device()));
            if rules::conclude(backend.name(), &report?, known, recorder)? == Exit::Different {
                exit = Exit::Different;
            }
        }
        recorder.saw(&cases);
        Ok(exit)
    }

    fn backends(&self) -> &[BackendName] {
        match &self.backend[..] {
            [] => &[BackendName::Simd, BackendName::Gpu],
            chosen => chosen,
        }
    }

    /// One list of all requested backends per thread. A GPU is not shared, so there is one thread
    /// then.
    fn workers(&self) -> Result<Vec<Vec<Box<dyn Backend>>>, Failure> {
        let names = self.backends();
        let threads = if names.contains(&BackendName::Gpu) {
            1
        } else {
            std::thread::available_parallelism().map_or(1, usize::from)
        };
        let backend = |&name: &BackendName| -> Result<Box<dyn Backend>, Failure> {
            match name {
                BackendName::Core => Ok(Box::new(SecondFormulation)),
                _ => self.options.select(name),
            }
        };
        let backends = || names.iter().map(backend).collect();
        (0..threads).map(|_| backends()).collect()
    }
}

/// Names the subjects of which the shard has nothing, because they have fewer units than there are
/// shards.
fn report_empty(table: &[SubjectRow], placed: Placed) {
    let mut empty: Vec<&str> =
        table.iter().filter(|row| row.compared == 0).map(|row| row.subject.name()).collect();
    empty.dedup();
    for subject in empty {
        let part = placed.shard.part + 1;
        note(&format!(
            "nothing to compare in shard {placed}: {subject} has fewer than {part} units"
        ));
    }
}

/// Adds the rows of one subject to the report.
fn record(report: &mut Report, table: &[SubjectRow]) {
    for row in table {
        let passes_alone = row.passes_alone;
        let first = row.first.as_ref().map(|text| match text.split_once('\n') {
            Some((case, difference)) => {
                let difference = difference.trim().to_owned();
                First { case: Some(case.to_owned()), difference, passes_alone }
            }
            None => First { case: None, difference: text.clone(), passes_alone },
        });
        let name = format!("{} {}", row.subject.name(), row.backend);
        let (cases, mismatches) = (row.compared, row.mismatches);
        report.add_part(ReportPart { name, cases, mismatches, first });
        report.add_stages(row.stages.iter().map(|(stage, more)| (stage, *more)));
    }
}

fn heading() -> String {
    format!("{:<12} {:<8} {:>15} {:>10}\n", "subject", "backend", "compared", "mismatches")
}

/// The rows of one subject, then the first difference in each.
fn lines(table: &[SubjectRow]) -> String {
    let mut text = String::new();
    for SubjectRow { subject, backend, compared, mismatches, .. } in table {
        let subject = subject.name();
        // Writing to a String does not fail.
        _ = writeln!(text, "{subject:<12} {backend:<8} {compared:>15} {mismatches:>10}");
    }
    for SubjectRow { subject, backend, known, .. } in table.iter().filter(|row| row.known > 0) {
        _ = writeln!(text, "known of {} in {backend}: {known}", subject.name());
    }
    for SubjectRow { subject, backend, first, passes_alone, .. } in table {
        if let Some(first) = first {
            _ = writeln!(text, "first of {} in {backend}: {first}", subject.name());
        }
        if *passes_alone {
            _ = writeln!(text, "  {PASSES_ALONE}");
        }
    }
    text
}
