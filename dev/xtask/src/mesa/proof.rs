//! The table: what `tess probe` and piglit find on each driver, and how long a frame takes.

use super::piglit::{self, Results};
use super::probe::{self, LONG, QUESTIONS, Row, Times};
use super::release::Release;
use super::{Place, Variant};
use crate::command::{self, cargo};
use crate::setup;

/// What was found of one driver.
struct Found {
    variant: Variant,
    answers: Vec<Row>,
    piglit: Results,
    times: Vec<Times>,
}

/// Asks every driver, prints the table, and judges it.
///
/// # Errors
/// A driver is missing or fails; a patched one is worse than the unpatched one, or draws long draws otherwise than
/// short ones.
pub(super) fn run(place: &Place) -> Result<(), String> {
    for variant in Variant::ALL {
        let manifest = place.manifest(variant);
        if !manifest.exists() {
            let (manifest, version) = (manifest.display(), place.release.version);
            let build = format!("cargo xtask mesa build {version}");
            return Err(format!("{manifest} is missing: `{build}` makes it"));
        }
    }
    let program = command::program()?;
    let frames = probe::frames(&program, place)?;
    let mut found = Vec::new();
    for (variant, times) in Variant::ALL.into_iter().zip(frames) {
        let answers = probe::ask(&program, place, variant)?;
        let piglit = piglit::run(place, variant)?;
        found.push(Found { variant, answers, piglit, times });
    }
    println!("\n{}", table(place.release, &found));
    judge(&found)
}

/// Runs this project's tests of Vulkan and OpenGL devices on the drivers with all patches.
///
/// # Errors
/// A test fails.
pub(super) fn test(place: &Place) -> Result<(), String> {
    // The test of a window needs more than a test that is named sets up.
    setup::run()?;
    let mut tests = cargo("xtask test tess-wgpu/tests tools/probe/tests");
    tests.envs(place.environment(Variant::WholeDraws));
    command::run(&mut tests)
}

/// The table, in Markdown: three parts, each with a row for each driver.
fn table(release: &Release, found: &[Found]) -> String {
    let mut lines = vec![
        format!("Mesa {}; patches by how they compare with the model:", release.version),
        "| driver | asked | patches | in order | leading | reorder | connected | points | culling |".into(),
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- |".into(),
    ];
    for (number, (question, _)) in QUESTIONS.iter().enumerate() {
        for Found { variant, answers, .. } in found {
            let row = answers[number];
            let differing = row.differing().map(|count| count.to_string()).join(" | ");
            let (name, patches, sequence) = (variant.name(), row.patches, row.sequence);
            lines.push(format!("| {name} | {question} | {patches} | {sequence} | {differing} |"));
        }
    }
    lines.push("\n| driver | piglit's tests | pass | fail | crash | skip |".into());
    lines.push("| --- | --- | --- | --- | --- | --- |".into());
    for Found { variant, piglit, .. } in found {
        let given = ["pass", "fail", "crash", "skip"].map(|given| piglit.count(given).to_string());
        let (name, tests) = (variant.name(), piglit.tests());
        lines.push(format!("| {name} | {tests} | {} |", given.join(" | ")));
    }
    lines.push("\n| workload | triangles | driver | discarded, ms | drawn, ms |".into());
    lines.push("| --- | --- | --- | --- | --- |".into());
    for Found { variant, times, .. } in found {
        for Times { workload, triangles, fixed, fixed_drawn } in times {
            let name = variant.name();
            lines.push(format!(
                "| {workload} | {triangles} | {name} | {fixed:.2} | {fixed_drawn:.2} |"
            ));
        }
    }
    lines.join("\n")
}

fn judge(found: &[Found]) -> Result<(), String> {
    let [unpatched, one_patch, whole_draws] = found else {
        return Err(format!("{} drivers were asked, not 3", found.len()));
    };
    for Found { variant, answers, piglit, .. } in [one_patch, whole_draws] {
        let other = piglit.differing(&unpatched.piglit);
        if let Some(first) = other.first() {
            return Err(format!(
                "{}: {} of piglit's tests give something else than unpatched: {first}",
                variant.name(),
                other.len()
            ));
        }
        for (number, (question, _)) in QUESTIONS.iter().enumerate() {
            if !answers[number].is_no_worse_than(unpatched.answers[number]) {
                return Err(format!("{question}: {} is worse than unpatched", variant.name()));
            }
        }
    }
    if whole_draws.answers[LONG] != whole_draws.answers[0] {
        return Err("long draws with all patches differ from short ones".to_owned());
    }
    if unpatched.answers[LONG] == unpatched.answers[0] {
        return Err("long draws are right without patches: the question shows nothing".to_owned());
    }
    println!(
        "\nno patched driver is worse in any column or in any test of piglit; long draws are right with all patches alone"
    );
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(variant: Variant, answers: [Row; 3]) -> Found {
        let piglit = Results::of(&[("a", "pass"), ("b", "fail")]);
        Found { variant, answers: answers.to_vec(), piglit, times: Vec::new() }
    }

    #[test]
    fn worse_drivers_are_refused() {
        let exact = Row { patches: 10, sequence: 10, ..Row::default() };
        let flushing = Row { sequence: 8, culling: 2, ..exact };
        let wrapping = Row { sequence: 5, connectivity: 5, ..exact };
        let unpatched = || found(Variant::Unpatched, [flushing, flushing, wrapping]);
        let one_patch = |answers| found(Variant::OnePatch, answers);
        let whole_draws = |answers| found(Variant::WholeDraws, answers);
        let good = one_patch([exact, flushing, wrapping]);
        assert_eq!(judge(&[unpatched(), good, whole_draws([exact; 3])]), Ok(()), "better");

        let other = Row { sequence: 8, order: 2, ..exact };
        let bad = one_patch([exact, other, wrapping]);
        assert!(judge(&[unpatched(), bad, whole_draws([exact; 3])]).is_err(), "another column");
        let few = Row { patches: 9, sequence: 9, ..exact };
        let bad = one_patch([few, exact, exact]);
        assert!(
            judge(&[unpatched(), bad, whole_draws([exact; 3])]).is_err(),
            "patches are missing"
        );
        let bad = whole_draws([exact, exact, wrapping]);
        assert!(judge(&[unpatched(), one_patch([exact; 3]), bad]).is_err(), "long draws wrap");
        let right = found(Variant::Unpatched, [flushing; 3]);
        let judged = judge(&[right, one_patch([exact; 3]), whole_draws([exact; 3])]);
        assert!(judged.is_err(), "nothing was wrong before");

        for other in [[("a", "pass"), ("b", "pass")].as_slice(), &[("a", "pass")], &[("a", "fail")]]
        {
            let mut bad = one_patch([exact, flushing, wrapping]);
            bad.piglit = Results::of(other);
            let judged = judge(&[unpatched(), bad, whole_draws([exact; 3])]);
            assert!(judged.is_err(), "piglit's tests give {other:?}");
        }
    }
}
