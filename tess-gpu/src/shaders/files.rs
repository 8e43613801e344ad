//! The files of `shaders/`, joined in the order in which they need each other.
//!
//! The first line of a file names the files that it needs: `// needs: state, {place}`. Names in
//! braces stand for one of several files, which the setup chooses. Names behind a semicolon are
//! bindings that whoever needs the file declares.

#[cfg(target_arch = "wasm32")]
use super::bare::{bare, bare_len};
use crate::setup::{IndexType, Setup};

/// Lists files of `shaders/`: their names and texts.
macro_rules! files {
    ($($name:literal),* $(,)?) => {
        [$(($name, downloaded!(include_str!(concat!("../../shaders/", $name, ".wgsl"))))),*]
    };
}

/// The text, as short as it can be read if it is part of a page.
#[cfg(target_arch = "wasm32")]
macro_rules! downloaded {
    ($text:expr) => {{
        const LEFT: &[u8] = &bare::<{ bare_len($text) }>($text);
        match str::from_utf8(LEFT) {
            Ok(text) => text,
            Err(_) => panic!("lines are removed whole"),
        }
    }};
}

#[cfg(not(target_arch = "wasm32"))]
macro_rules! downloaded {
    ($text:expr) => {
        $text
    };
}

const FILES: [(&str, &str); 58] = files![
    "alike",
    "block",
    "catalogue",
    "connect",
    "counted",
    "counts",
    "d3d_float",
    "described",
    "drawing",
    "element",
    "expand",
    "expand_points",
    "expand_primitives",
    "expand_small",
    "factor_context",
    "factors",
    "finish",
    "fixed_point",
    "groups",
    "indices_u16",
    "indices_u32",
    "large_tiles",
    "list",
    "listing",
    "locate",
    "make_context",
    "no_catalogue",
    "no_contexts",
    "no_listing",
    "offsets",
    "packing",
    "partition",
    "place",
    "place_evenly",
    "point_format",
    "point_tile",
    "points",
    "prefix_sum",
    "primitive_tile",
    "probe",
    "probe_contexts",
    "probe_factors",
    "probe_locations",
    "process",
    "pulled_contexts",
    "read_catalogue",
    "rings",
    "scan",
    "search",
    "small",
    "small_tiles",
    "state",
    "stitch",
    "stored_contexts",
    "tile",
    "tile_size",
    "topology",
    "totals",
];

/// A name in braces and the file that stands for it.
pub(super) type Choice = (&'static str, &'static str);

/// How points are placed. With integer factors a number of points says it all; otherwise the file
/// `stored` says where contexts are.
pub(super) const fn placing(setup: Setup, stored: &'static str) -> [Choice; 2] {
    if setup.has_integer_factors() {
        [("place", "place_evenly"), ("contexts", "place_evenly")]
    } else {
        [("place", "place"), ("contexts", stored)]
    }
}

/// How indices are stored.
pub(super) const fn indices(setup: Setup) -> Choice {
    let file = match setup.index_type {
        IndexType::U16 => "indices_u16",
        IndexType::U32 => "indices_u32",
    };
    ("indices", file)
}

/// Whether topologies are entered into the catalogue.
pub(super) const fn listing(lists: bool) -> Choice {
    ("listing", if lists { "listing" } else { "no_listing" })
}

/// What the expansions of a small batch and of a large one have of their own: the catalogue, the size of tiles.
pub(super) const fn expanding(is_small: bool) -> [Choice; 2] {
    if is_small {
        [("catalogue", "no_catalogue"), ("elements", "small_tiles")]
    } else {
        [("catalogue", "read_catalogue"), ("elements", "large_tiles")]
    }
}

/// Files behind all that they need, each once.
pub(super) fn joined(files: &[&'static str], choices: &[Choice]) -> String {
    let mut names = Vec::new();
    for file in files {
        add(file, choices, &mut names);
    }
    names.into_iter().map(text).collect()
}

fn add(file: &'static str, choices: &[Choice], names: &mut Vec<&'static str>) {
    if names.contains(&file) {
        return;
    }
    for need in needs(file) {
        add(chosen(need, choices), choices, names);
    }
    names.push(file);
}

/// The file that a need names.
fn chosen(need: &'static str, choices: &[Choice]) -> &'static str {
    let Some(name) = need.strip_prefix('{').and_then(|rest| rest.strip_suffix('}')) else {
        return need;
    };
    let choice = choices.iter().find(|(choice, _)| *choice == name);
    choice.map(|&(_, file)| file).unwrap_or_else(|| panic!("{need} is not chosen"))
}

/// What the first line of a file names.
fn needs(file: &'static str) -> impl Iterator<Item = &'static str> {
    first_line(file).0.split(", ").filter(|&need| need != "nothing")
}

/// The two halves of a file's first line: the files that it needs, and bindings.
fn first_line(file: &'static str) -> (&'static str, &'static str) {
    let line = text(file).lines().next().and_then(|line| line.strip_prefix("// needs: "));
    let line = line.unwrap_or_else(|| panic!("{file}.wgsl does not say what it needs"));
    line.split_once("; bindings: ").unwrap_or((line, ""))
}

fn text(file: &str) -> &'static str {
    let found = FILES.iter().find(|(name, _)| *name == file);
    found.map(|&(_, text)| text).unwrap_or_else(|| panic!("{file}.wgsl is no file of shaders/"))
}

#[cfg(test)]
mod tests;
