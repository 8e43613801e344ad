//! The Metal Shading Language, which nothing here compiles: it must stay as recorded.

use crate::{shaders, stages};
use libtest_mimic::Failed;
use std::fs;
use std::path::Path;

const RECORDED: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/shaders/metal");
const OPTIONS: &str = "--target msl --domain quad --partitioning fractional_odd";

pub(crate) fn is_as_recorded() -> Result<(), Failed> {
    let folder = shaders("metal", OPTIONS)?;
    let names = stages(&folder, ".metal")?;
    let again = format!("tess shaders {OPTIONS} -o FOLDER writes them anew");
    if names != stages(Path::new(RECORDED), ".metal")? {
        return Err(format!("the stages are others than in {RECORDED}; {again}").into());
    }
    for name in names {
        let file = format!("{name}.metal");
        let recorded = fs::read_to_string(Path::new(RECORDED).join(&file))?;
        let written = fs::read_to_string(folder.join(&file))?;
        let differ = recorded.lines().zip(written.lines()).position(|(a, b)| a != b);
        if recorded != written {
            let line = differ.map_or(0, |line| line + 1);
            return Err(format!("{file}:{line} is not as recorded in {RECORDED}; {again}").into());
        }
    }
    Ok(())
}
