//! The header and the example, in C and C++.

use super::tools::{build_folder, crate_folder, libraries, output, run, text};
use libtest_mimic::Failed;
use std::path::{Path, PathBuf};
use std::process::Command;
use tess_verify::Case;

pub(crate) const STRICT: &[&str] = &["-Wall", "-Wextra", "-pedantic", "-Werror"];
/// System libraries that a Rust static library needs.
pub(crate) const SYSTEM_LIBRARIES: &[&str] = &["-lpthread", "-ldl", "-lm"];

pub(crate) fn header_is_c99() -> Result<(), Failed> {
    header_compiles("cc", "-std=c99", "c")
}

pub(crate) fn header_is_cpp() -> Result<(), Failed> {
    header_compiles("c++", "-std=c++11", "c++")
}

/// Includes the header twice and calls a function, which the example is too long for in C++.
fn header_compiles(compiler: &str, standard: &str, language: &str) -> Result<(), Failed> {
    let source = build_folder().join(format!("header-{compiler}.c"));
    let call = "int main(void) { return tess_version() != TESS_VERSION; }\n";
    std::fs::write(&source, format!("#include \"tess.h\"\n#include \"tess.h\"\n{call}"))?;
    let program = build_folder().join(format!("header-{compiler}"));
    let mut command = Command::new(compiler);
    command.arg(standard).args(STRICT).arg("-I").arg(crate_folder().join("include"));
    command.args(["-x", language]).arg(source).args(["-x", "none"]).arg(libraries()?.archive);
    run(command.args(SYSTEM_LIBRARIES).arg("-o").arg(&program))?;
    // The linked library has the version that the header was made for.
    run(&mut Command::new(program))?;
    Ok(())
}

/// The program in the README compiles and prints what the README says.
pub(crate) fn readme_program_runs() -> Result<(), Failed> {
    let readme = std::fs::read_to_string(crate_folder().join("README.md"))?;
    let (_, rest) = readme.split_once("```c\n").ok_or("the README has a program")?;
    let (program, rest) = rest.split_once("```\n").ok_or("the program ends")?;
    let source = build_folder().join("readme.c");
    std::fs::write(&source, program)?;
    let target = build_folder().join("readme");
    let mut command = Command::new("cc");
    command.arg("-std=c99").args(STRICT).arg("-I").arg(crate_folder().join("include"));
    command.arg(&source).arg(libraries()?.archive).args(SYSTEM_LIBRARIES);
    run(command.arg("-o").arg(&target))?;
    let printed = run(&mut Command::new(target))?;
    match rest.contains(&format!("\n{printed}")) {
        true => Ok(()),
        false => Err(format!("the README does not say that it prints {printed}").into()),
    }
}

pub(crate) fn example_equals_golden_static() -> Result<(), Failed> {
    equals_golden(&static_example("patch-static")?)
}

pub(crate) fn example_equals_golden_shared() -> Result<(), Failed> {
    let library = libraries()?.shared;
    let folder = library.parent().ok_or("a library lies in a folder")?;
    let program = build_folder().join("patch-shared");
    let mut command = compile_example();
    command.arg(&library).arg("-o").arg(&program);
    run(command.arg(format!("-Wl,-rpath,{}", folder.display())))?;
    equals_golden(&program)
}

fn compile_example() -> Command {
    let mut command = Command::new("cc");
    command.arg("-std=c99").args(STRICT).arg("-I").arg(crate_folder().join("include"));
    command.arg(crate_folder().join("examples/patch.c"));
    command
}

fn static_example(name: &str) -> Result<PathBuf, String> {
    let program = build_folder().join(name);
    let mut command = compile_example();
    command.arg(libraries()?.archive).args(SYSTEM_LIBRARIES);
    run(command.arg("-o").arg(&program))?;
    Ok(program)
}

/// Every listing of golden/cases.txt comes out of the program, to the letter.
fn equals_golden(program: &Path) -> Result<(), Failed> {
    golden_listings(|arguments| {
        let mut command = Command::new(program);
        command.args(arguments.split(' '));
        Some(command)
    })?;
    Ok(())
}

/// Compares each listing of golden/cases.txt with what a command prints; gives the number of those
/// that have one.
pub(crate) fn golden_listings(command: impl Fn(&str) -> Option<Command>) -> Result<usize, String> {
    let golden = crate_folder().join("../../golden/cases.txt");
    let golden = std::fs::read_to_string(golden).map_err(|error| error.to_string())?;
    let (header, cases) = golden.split_once('\n').ok_or("golden/cases.txt is empty")?;
    let cases: Vec<&str> = cases.split_inclusive("\nend\n").collect();
    if !header.contains(&format!("count={} ", cases.len())) {
        return Err(format!("{} cases, but golden/cases.txt starts: {header}", cases.len()));
    }
    let mut compared = 0;
    for case in cases {
        let (line, expected) = case.split_once('\n').ok_or("a case has lines")?;
        let arguments = line.strip_prefix("case ").ok_or("a case line starts with `case`")?;
        let Some(mut command) = command(arguments) else { continue };
        if let Some(difference) = first_difference(&run(&mut command)?, expected) {
            return Err(format!("{line}\n{difference}"));
        }
        compared += 1;
    }
    Ok(compared)
}

fn first_difference(observed: &str, expected: &str) -> Option<String> {
    let pairs = observed.lines().zip(expected.lines()).enumerate();
    for (number, (observed, expected)) in pairs {
        if observed != expected {
            return Some(format!("line {}: {observed}, expected {expected}", number + 1));
        }
    }
    let (observed, expected) = (observed.lines().count(), expected.lines().count());
    (observed != expected).then(|| format!("{observed} lines, expected {expected}"))
}

pub(crate) fn cpp_names_small_buffers() -> Result<(), Failed> {
    let program = build_folder().join("refusals");
    let mut command = Command::new("c++");
    command.arg("-std=c++17").args(STRICT).arg("-I").arg(crate_folder().join("include"));
    command.arg(crate_folder().join("tests/foreign/refusals.cpp")).arg(libraries()?.archive);
    run(command.args(SYSTEM_LIBRARIES).arg("-o").arg(&program))?;
    run(&mut Command::new(program))?;
    Ok(())
}

/// `tests/foreign/threads.c`.
fn threads_program(name: &str) -> Result<Command, String> {
    let program = build_folder().join(name);
    let mut command = Command::new("cc");
    command.arg("-std=c99").args(STRICT).arg("-I").arg(crate_folder().join("include"));
    command.arg(crate_folder().join("tests/foreign/threads.c")).arg(libraries()?.archive);
    run(command.args(SYSTEM_LIBRARIES).arg("-o").arg(&program))?;
    Ok(Command::new(program))
}

pub(crate) fn forked_children_have_threads() -> Result<(), Failed> {
    run(threads_program("threads-fork")?.arg("fork").env("RAYON_NUM_THREADS", "3"))?;
    Ok(())
}

/// No thread has a stack of 64 TiB.
pub(crate) fn no_threads_is_a_status() -> Result<(), Failed> {
    let stack = (1_u64 << 46).to_string();
    run(threads_program("threads-none")?.arg("none").env("RUST_MIN_STACK", stack))?;
    Ok(())
}

/// The fuzz example, with the `main` that runs it without a fuzzer.
fn compile_fuzz(compiler: &str, flags: &[&str], name: &str) -> Result<PathBuf, String> {
    let program = build_folder().join(name);
    let mut command = Command::new(compiler);
    command.args(flags).args(STRICT).args(["-O2", "-DTESS_FUZZ_MAIN"]);
    command.arg("-I").arg(crate_folder().join("include"));
    command.arg(crate_folder().join("examples/fuzz.c")).args(["-x", "none"]);
    command.arg(libraries()?.archive).args(SYSTEM_LIBRARIES).arg("-o").arg(&program);
    run(&mut command).map(|_| program)
}

pub(crate) fn fuzz_finds_a_planted_fault() -> Result<(), Failed> {
    let program = compile_fuzz("cc", &["-std=c99"], "fuzz")?;
    let printed = run(Command::new(&program).arg("20000"))?;
    if printed != "20000 inputs, no findings\n" {
        return Err(format!("the device without a fault: {printed}").into());
    }
    let output = output(Command::new(&program).arg("20000").env("TESS_FUZZ_FAULT", "1"))?;
    let found = text(&output.stderr);
    let line = found.lines().find(|line| line.starts_with("case "));
    let case = line.ok_or_else(|| format!("{}, no case line: {found}", output.status))?;
    let case: Case = case.parse().map_err(|error| format!("{case}: {error}"))?;
    let patch = case.patch();
    let moved = patch.point(100).ok_or_else(|| format!("{case} has no point 100"))?;
    let moved =
        format!("observed 0x{:05x}, expected 0x{:05x}", moved.u.to_bits() ^ 1, moved.u.to_bits());
    if output.status.success() || !found.contains("point 100 u") || !found.contains(&moved) {
        return Err(format!("{}, not point 100 with {moved}: {found}", output.status).into());
    }
    Ok(())
}

pub(crate) fn fuzz_entry_is_cpp() -> Result<(), Failed> {
    let program = compile_fuzz("c++", &["-std=c++11", "-x", "c++"], "fuzz-cpp")?;
    run(Command::new(program).arg("1000"))?;
    Ok(())
}

/// The example prints what `tess verify --backend core --rules vulkan` does, and ends with 1.
pub(crate) fn rules_example_judges_the_model() -> Result<(), Failed> {
    let program = build_folder().join("rules");
    let mut command = Command::new("cc");
    command.arg("-std=c99").args(STRICT).arg("-I").arg(crate_folder().join("include"));
    command.arg(crate_folder().join("examples/rules.c"));
    command.arg(libraries()?.archive).args(SYSTEM_LIBRARIES).arg("-o").arg(&program);
    run(&mut command)?;
    let judged = output(&mut Command::new(&program))?;
    let report = text(&judged.stdout);
    let summary = "28455 patches, vulkan: 11 rules held, 0 held as far as asked, 10 broken, \
                   0 not exercised\n";
    if judged.status.code() != Some(1) || !report.ends_with(summary) {
        return Err(format!("{}: {report}", judged.status).into());
    }
    Ok(())
}

pub(crate) fn example_refuses_bad_usage() -> Result<(), Failed> {
    let program = static_example("patch-usage")?;
    for (arguments, complaint) in [
        ("", "usage: patch"),
        ("cube integer point ruler 3f800000 3f800000", "unknown name: cube"),
        ("isoline integer point ruler 3f800000 1x", "not the bits of a factor: 1x"),
        ("isoline integer point ruler 3f800000 123456789", "not the bits of a factor"),
        ("quad integer point ruler 3f800000 3f800000", "number of factors"),
    ] {
        let output = output(Command::new(&program).args(arguments.split_whitespace()))?;
        let said = text(&output.stderr);
        if output.status.code() != Some(2) || !said.contains(complaint) {
            let status = output.status;
            return Err(format!("`patch {arguments}` ended with {status} and said: {said}").into());
        }
    }
    Ok(())
}
