//! Writes the seed corpus of every fuzz target.

use std::path::Path;

fn main() -> std::io::Result<()> {
    let fuzz = Path::new(env!("CARGO_MANIFEST_DIR"));
    let count = tess_fuzz::seeds::write(&fuzz.join("corpus"), &fuzz.join("../golden"))?;
    println!("{count} seeds in fuzz/corpus");
    Ok(())
}
