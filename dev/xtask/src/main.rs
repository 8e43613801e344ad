//! Development commands. `cargo xtask` lists them.
//!
//! ```text
//! what a developer runs      test -> setup, suite (builds, selects, one job for each program), tally (runs, counts)
//! what guards a change       ci -> features, fuzz, ports (a file for each system), publish, then test
//! tests that are not Rust    python, explorer, integrations (Bevy), mesa, sdl, models
//! whether tests see faults   mutants (cargo-mutants), mutants/planted (lists in faults/)
//! scripts in Python          script (checks of texts; records of measurements, tables and charts)
//! for users                  install (header, libraries, tess.pc), dist (a release's archives), examples (of tess-wgpu)
//! the circuit                rtl (passes its words on to rtl/dv/rig)
//! what all of them use       command (runs programs, finds folders), packages (cargo metadata), levels (CPU levels); more in dev/commands
//! ```
//!
//! A command is an arm of [`run`], a paragraph of [`USAGE`], and a function of its module that
//! returns `Err(message)` on failure. Programs that it needs are each a `Need` of `setup/needs.rs`,
//! which installs them or tells how to. [`tally`] counts the tests, and fails a job that ran none.
#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a program talks to its user")]

mod ci;
mod command;
mod dist;
mod examples;
mod explorer;
mod features;
mod fuzz;
mod install;
#[cfg(feature = "pictures")]
mod integrations;
mod levels;
mod mesa;
mod models;
mod mutants;
mod packages;
mod ports;
mod prove;
mod publish;
mod python;
mod rtl;
mod satellites;
mod script;
mod sdl;
mod setup;
mod suite;
mod tally;
mod test;

use ports::Extent;
use std::process::ExitCode;

const USAGE: &str = "\
usage: cargo xtask [--yes | --no-install] <command>

  A command that needs programs of the system lists them with their purposes and installs them on Debian and Ubuntu.
  On a terminal it asks first, once; `--yes` answers. With `--no-install` it only lists them, runs what can run, and
  reports the rest as not run. Nothing that is installed is upgraded.

  test [PATH... [WORD...]]
          set up what the tests need, then run the tests of the model, the CPU, the GPU on Vulkan, surfaces, the
          kit, the program and C; or only the tests of a package's folder (tess-core) or file
          (tess-core/tests/golden.rs), and of these only the ones whose names contain one of the words
  test all
          run every test of the product, also the slow ones: of models, OpenGL, a window and benches
  ci      what continuous integration runs: formatting, `traceability`, `public`, lints, documentation; then
          `test all`, so that a run that is stopped has compared; then `satellites`, `features`, `fuzz` on the
          seeds and for seconds, without the GPU, `ports brief` (msrv, s390x, wasm, miri), `publish`, and `deny` if
          cargo-deny is installed
  ci all  the same with every satellite, and the circuit proved and placed
  satellites [NAME...]
          test the satellites that have changed since they last passed, or that use a part of the product that has,
          or these: python, explorer, rtl, and only if they are named bevy, mesa and sdl; records those that pass
          in dev/satellites.tsv
  setup   only set up: drivers for Vulkan and OpenGL, C, C++ and shader compilers, Verilator,
          Icarus Verilog, Python
  example NAME [OPTION...]
          run an example of tess-wgpu; so does `cargo example`
  python [--program PROGRAM]
          build the Python package's wheel, install it in a fresh virtual environment, check its
          types and run its tests, which compare it with `tess` or with PROGRAM.
          PYTHON names another interpreter
  explorer [--serve | --test]
          build the explorer's page in target/explorer; serve it on this machine and print the address; or
          test it in Chromium
  integrations
          build the plugin for Bevy, run its tests and its example, and compare the pictures of its two
          ways to tessellate
  rtl [WORD...]
          check the circuit in `rtl`, which is a workspace of its own: `cargo xtask rtl help` lists the words
  install --prefix FOLDER [--target TARGET]
          build the C library and install headers, both libraries, `tess.pc` and CMake's package there, so that
          `cc program.c $(pkg-config --cflags --libs tess)` works
  mesa [build | compare | test]
          get the sources of Mesa 25.0.7 from Debian, build its drivers lavapipe (Vulkan) and llvmpipe (OpenGL) as
          they are and with this library as their tessellator (in target/mesa, never installed), and compare them:
          docs/hosts/mesa.md. Runs on Debian 12 and 13, and takes 45 minutes on two cores. `test` runs the tests of
          Vulkan and OpenGL on the patched drivers
  sdl     build SDL 3 from the sources of a crate (in target/sdl, unless the system has it), run the terrain of
          bindings/sdl and compare its points and indices with the model; pictures stay in target/sdl
  models [FOLDER...]
          run `tess mesh` on the models in these folders, or on small ones of every kind that a script makes, and
          judge the outputs by other programs: pygltflib, scipy, Khronos' glTF validator
  public  list the public items of the published libraries that nothing outside of them uses
  width   check that lines of Rust have at most 100 columns
  traceability
          check that docs/traceability.md has each section of docs/specification.md and that the evidence it names exists
  features [PACKAGE...]
          check that every published package, or each of these, compiles with no features, each single one, and all
  ports [brief] [NAME...]
          check other compilers, processors and systems: msrv, i686, aarch64, s390x, windows, macos, wasm,
          miri; installs emulators and compilers. `brief` runs the tests that take seconds
  fuzz [SECONDS]
          build every fuzz target and run each, for 10 seconds by default
  mutants PACKAGE [OPTION...]
          plant faults in tess-core, tess-level, tess-simd, tess-gpu, tess-wgpu, tess-surface, tess-mesh, tess-verify or
          tess-show; fails if one survives the tests and dev/faults/survivors.tsv does not list it (needs
          cargo-mutants; takes an hour)
  mutants planted [WORD...]
          plant the faults of dev/faults, or those with one of these words, in a copy of the tree; fails
          if the test named next to a fault does not detect it (each compiles a crate again: hours for all)
  publish [send]
          pack and build every published package as a registry would receive it; without `send`, send nothing
  dist [--try] [PART...]
          pack a release, or these parts of it, into target/dist: tess shaders npm sdl covergroups c deb python crates;
          with `--try` pack twice, compare the bytes, and use each archive as its README says, where nothing else of
          the project is present
  deny [advisories]
          check the licences and sources of dependencies, and known vulnerabilities on request
  semver REVISION
          compare the libraries' interfaces with those of a commit or tag
  records cpu|gpu
          measure everything that docs/performance.md states about this machine's CPU or GPU, in ten minutes: builds
          the programs and writes benches/records, the tables and the charts. `ci` fails if a record is older than
          what it measures
  prove [composition | triangle | exhaustive | circuit]...
          run the checks of docs/proof.md that take long, or these: every class of the composition, a proof by Z3,
          everything finite by the model's second formulation and the CPU backend, the proofs of the circuit; print the
          lemmas with counts, and what is proved and what only tested; `exhaustive` takes most of the time
  study   repeat the study of 2015: measure its inputs on this machine's CPU, and on its GPU if NVIDIA's driver names
          one, compare the sweep in steps of 0.01, and write records, docs/study.md and its chart; two minutes
  performance
          write the tables of docs/performance.md and docs/study.md and the charts from the records";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let is_consent = |word: &&str| [setup::YES, setup::NO_INSTALL].contains(word);
    let (consent, words): (Vec<&str>, Vec<&str>) =
        arguments.iter().map(String::as_str).partition(is_consent);
    setup::consent(consent.last().copied());
    match run(&words) {
        Some(Ok(())) => ExitCode::SUCCESS,
        Some(Err(message)) => {
            eprintln!("xtask: {message}");
            ExitCode::FAILURE
        }
        None => {
            eprintln!("{USAGE}");
            ExitCode::from(2)
        }
    }
}

/// Runs the command; `None` if it does not exist.
fn run(words: &[&str]) -> Option<Result<(), String>> {
    let after_setup =
        |command: &dyn Fn() -> Result<(), String>| setup::run().and_then(|()| command());
    Some(match *words {
        ["test", "all"] => test::run_all().map(drop),
        ["test", ref arguments @ ..] => test::run(arguments),
        ["ci"] => after_setup(&|| ci::run(false)),
        ["ci", "all"] => after_setup(&|| ci::run(true)),
        ["satellites", ref names @ ..] => after_setup(&|| satellites::run(names)),
        ["setup"] => setup::run(),
        ["example", ref words @ ..] => examples::run(words),
        ["models"] => models::of_every_kind(),
        ["models", ref folders @ ..] => models::run(folders),
        ["public" | "traceability" | "width"] => script::run(script::CHECKS, words),
        ["features", ref names @ ..] => features::check(names),
        ["ports", "brief", ref names @ ..] => ports::run(names, Extent::Brief),
        ["ports", ref names @ ..] => ports::run(names, Extent::Whole),
        ["fuzz"] => after_setup(&|| fuzz::run(&["--gpu", "10"])),
        ["fuzz", seconds] => after_setup(&|| fuzz::run(&["--gpu", seconds])),
        ["mutants", "planted", ref words @ ..] => mutants::planted(words),
        ["mutants", package, ref rest @ ..] => mutants::run(package, rest),
        ["publish"] => publish::dry_run(),
        ["publish", "send"] => publish::send(),
        ["python"] => after_setup(&python::run),
        ["python", "--program", program] => python::run_with(program.as_ref()),
        ["explorer"] => explorer::build(),
        ["explorer", "--serve"] => explorer::serve(),
        ["explorer", "--test"] => explorer::test(),
        ["integrations"] => integrations(),
        ["rtl", ref words @ ..] => rtl::run(words),
        ["install", "--prefix", folder] => install::run(folder, None),
        ["install", "--prefix", folder, "--target", target] => install::run(folder, Some(target)),
        ["mesa", ref words @ ..] => mesa::run(words),
        ["sdl"] => sdl::run(),
        ["dist", ref words @ ..] => dist::run(words),
        ["deny"] => publish::deny(false),
        ["deny", "advisories"] => publish::deny(true),
        ["semver", baseline] => publish::semver(baseline),
        ["prove", ref names @ ..] => prove::run(names),
        ["study"] => script::run(script::MEASURE, &["here", "study"]),
        ["records", set] => script::run(script::MEASURE, &["here", set]),
        ["performance"] => script::run(script::RECORDS, words),
        ["help" | "--help" | "-h"] => {
            println!("{USAGE}");
            Ok(())
        }
        _ => return None,
    })
}

/// Checks the integrations, in a process that has the feature `pictures`.
fn integrations() -> Result<(), String> {
    #[cfg(feature = "pictures")]
    return setup::run().and_then(|()| integrations::run());
    #[cfg(not(feature = "pictures"))]
    command::run(&mut command::with_pictures(&["integrations"]))
}
