//! `explorer-bindgen INPUT.wasm FOLDER`: the JavaScript module of a WebAssembly file, for browsers.

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use wasm_bindgen_cli_support::Bindgen;

fn main() -> ExitCode {
    let mut arguments = std::env::args_os().skip(1).map(PathBuf::from);
    let (Some(input), Some(folder)) = (arguments.next(), arguments.next()) else {
        eprintln!("usage: explorer-bindgen INPUT.wasm FOLDER");
        return ExitCode::from(2);
    };
    let mut bindgen = Bindgen::new();
    let made = bindgen
        .input_path(&input)
        .typescript(false)
        .remove_name_section(true)
        .remove_producers_section(true)
        .web(true);
    let name = input.with_extension("js").file_name().map(|name| folder.join(name));
    let made = made.and_then(|bindgen| bindgen.generate(&folder));
    match made.and_then(|()| Ok(name.map(|path| without_descriptions(&path)).transpose()?)) {
        Ok(_) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{}: {error:#}", input.display());
            ExitCode::FAILURE
        }
    }
}

/// Removes the functions' descriptions, which would be downloaded for nobody: the Rust has them.
fn without_descriptions(path: &Path) -> std::io::Result<()> {
    let text = std::fs::read_to_string(path)?;
    let mut is_inside = false;
    let stays = |line: &&str| {
        is_inside |= line.trim_start().starts_with("/**");
        let stays = !is_inside;
        is_inside &= !line.trim_end().ends_with("*/");
        stays
    };
    let kept: String = text.split_inclusive('\n').filter(stays).collect();
    std::fs::write(path, kept)
}
