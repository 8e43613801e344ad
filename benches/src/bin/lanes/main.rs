//! The stages of the front end as `tess-simd` has them, over arrays, beside the same formulas over the
//! vectors of `wide`.
//!
//! `wide` chooses its instructions when it is compiled, so `benches/lanes.py` builds and runs this program
//! for each target. Both forms are compared bit for bit before they are timed. Each line that is printed is
//! a row of the record `lanes-xeon`.
//!
//! `lanes STAGE FORM TIMES` runs one form of a stage and prints nothing: for counting instructions.
#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a program that prints its results")]

// The sources of `tess-simd`, compiled for what the program is compiled for.
#[allow(
    dead_code,
    unexpected_cfgs,
    reason = "the program needs a part of them, and has no features"
)]
#[path = "../../../../tess-simd/src"]
mod arrays {
    pub(crate) mod data {
        pub(crate) mod lanes;
    }
    pub(crate) mod stages {
        pub(crate) mod factor_context;
        pub(crate) mod factors;
        pub(crate) mod place;
        pub(crate) mod reciprocal;
    }
}

mod by_wide;
mod compare;
mod levels;
mod timing;
mod work;

use arrays::{data, stages};
use std::process::ExitCode;
use tess_simd::Level;
use work::{Form, Stage, Work};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let result = match arguments[..] {
        [] => measure(),
        [stage, form, times] => repeat(stage, form, times),
        _ => Err("usage: lanes [STAGE FORM TIMES]".into()),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("lanes: {error}");
            ExitCode::from(2)
        }
    }
}

/// Compares both forms and times them, at each level that the build may choose when it runs.
fn measure() -> Result<(), String> {
    compare::many()?;
    for level in Level::ALL.into_iter().filter(|&level| is_measured(level)) {
        for stage in Stage::TIMED {
            let mut work = Work::at_random(level);
            work.run_both(stage);
            compare::same(&work, stage)?;
            println!("{}", timing::row(&mut work, stage));
        }
    }
    Ok(())
}

/// A build for AVX2 or AVX-512 runs the same instructions at every level.
fn is_measured(level: Level) -> bool {
    level.is_available() && (level == Level::Baseline || !cfg!(target_feature = "avx2"))
}

/// Runs one form of a stage, at the level `baseline`, as often as asked.
fn repeat(stage: &str, form: &str, times: &str) -> Result<(), String> {
    let stage = Stage::TIMED.into_iter().find(|known| known.name() == stage);
    let stage = stage.ok_or("STAGE: there is none of this name")?;
    let form = match form {
        "arrays" => Form::Arrays,
        "wide" => Form::Wide,
        _ => return Err(format!("`{form}`: FORM is `arrays` or `wide`")),
    };
    let times: usize = times.parse().map_err(|error| format!("`{times}`: {error}"))?;
    let mut work = Work::at_random(Level::Baseline);
    for _ in 0..times {
        work.run(stage, form);
    }
    Ok(())
}
