//! `tess check --rules`: judges a device's listings by the demands of a standard.

use super::asked::{AskedCases, Source};
use super::{NO_VERDICT, record, so_far};
use crate::campaign::Recorder;
use crate::campaign::report::ReportPart;
use crate::comparison::rules::{conclude, print};
use crate::failure::{Exit, Failure};
use crate::input::Reader;
use crate::output::progress;
use indicatif::ProgressBar;
use std::sync::{Mutex, PoisonError};
use tess_core::Tessellation;
use tess_verify::check::{self, Known, ListOrder, Strength, Tested};
use tess_verify::rules::{Checker, Specification};
use tess_verify::vectors::{Kind, Record, VectorFile};
use tess_verify::{Backend, Case, CoreBackend, Named};

/// Judges every listing of a file. Prints the verdicts, and those `asked` cases that the file does
/// not answer.
///
/// # Errors
/// The file is malformed, truncated or too long, or has no listings; or the asked cases cannot be
/// read.
pub(super) fn run(
    file: VectorFile<Reader>,
    (mut asked, source): (Option<AskedCases<'_>>, Source),
    specification: Specification,
    known: &Known,
    recorder: &Recorder,
) -> Result<Exit, Failure> {
    let kind = file.header().kind;
    if kind != Kind::Listings {
        return Err(Failure::bad_input(format!(
            "--rules judges listings; this file's kind is {}: write them with --format listing",
            kind.name()
        )));
    }
    let bar = file.header().count.map_or_else(ProgressBar::hidden, |n| progress(n, "records"));
    let judges = Mutex::new((Checker::new(specification), [0; 3]));
    // There is one thread, so that records come in their order.
    let mut model: [Box<dyn Backend>; 1] = [Box::new(CoreBackend)];
    let answered = asked.as_mut().map(|asked| asked as _);
    let answers =
        check::check_asked(file, answered, known, &mut model, Tested::Answers, &|checked| {
            source.see(checked, recorder);
            let mut judges = judges.lock().unwrap_or_else(PoisonError::into_inner);
            let (checker, beside) = &mut *judges;
            let mut judge = |case: &Case, output: &Tessellation| {
                checker.add(case, output);
                beside[beside_model(case, output)] += 1;
            };
            for record in checked.records {
                match record {
                    Record::Listing(listing) => judge(&listing.case, &listing.output),
                    Record::Coordinates(vertices) => judge(&vertices.case, &vertices.output()),
                    _ => {}
                }
            }
            bar.inc(checked.records.len() as u64);
        });
    bar.finish_and_clear();
    let (answers, malformed) = so_far(answers)?;
    let (checker, beside) = judges.into_inner().unwrap_or_else(PoisonError::into_inner);
    if asked.is_some() {
        let (cases, mismatches) = (answers.cases, answers.mismatches);
        let first = answers.differences.first().map(record::first);
        let name = "listings answers".to_owned();
        recorder.update(|record| record.add_part(ReportPart { name, cases, mismatches, first }));
        answers.differences.iter().try_for_each(|difference| print(&format!("{difference}\n")))?;
        print(&format!("{answers} of answers\n"))?;
        source.explain(&answers);
    }
    let ended = conclude("listings", &checker.report(), known, recorder)?;
    let [equal, reordered, different] = beside;
    print(&format!(
        "patches beside the model: {equal} equal, {reordered} in another order, {different} different\n"
    ))?;
    if let Some(error) = malformed {
        print(&format!("{} records{NO_VERDICT}\n", equal + reordered + different))?;
        return Err(Failure::bad_input(error));
    }
    Ok(if answers.mismatches > 0 { Exit::Different } else { ended })
}

/// The comparison of a patch with the model, vertex by vertex: equal (0), in another order (1), or
/// different (2). Only Direct3D demands the model's order.
fn beside_model(case: &Case, observed: &Tessellation) -> usize {
    let expected = case.patch().tessellate();
    let is_equal =
        |order| Strength { order, ..Strength::default() }.equal(case, observed, &expected);
    [ListOrder::Sequence, ListOrder::Any].into_iter().position(is_equal).unwrap_or(2)
}
