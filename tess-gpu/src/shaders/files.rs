//! The files of `shaders/`, joined so that each file follows the files that it needs.
//!
//! The first line of a file has the paths of the files that it needs: `// needs: layout/setup,
//! {place}`. A name in braces stands for one of several files, and the setup chooses which. Names
//! after a semicolon are bindings that the user of the file must declare.

use crate::setup::{IndexType, Setup};

/// Lists files of `shaders/` by folder: names and texts.
macro_rules! files {
    ($($folder:ident: $($name:ident)*;)*) => {
        [$($(files!(@ concat!(stringify!($folder), "/", stringify!($name))),)*)*]
    };
    (@ $path:expr) => {
        ($path, include_str!(concat!("../../shaders/", $path, ".wgsl")))
    };
}

const FILES: [(&str, &str); 57] = files! {
    entry_points: expand_points expand_primitives expand_short factors groups list partition scan
        short_batch totals;
    layout: packed_context packed_triangle point_format setup topology;
    offered: counting elements;
    shared: alike block catalogue described expand finish offsets point_tile prefix_sum
        primitive_tile search tile tile_size;
    stages: cache_order connect counts d3d_float factor_context factors fixed_point locate place
        points rings stitch;
    taps: contexts factors locations tap;
    variants: indices_u16 indices_u32 listing narrow_tiles no_catalogue no_contexts no_listing
        place_evenly read_catalogue stored_contexts wide_tiles;
};

/// A name in braces and the file that stands for it.
pub(super) type Choice = (&'static str, &'static str);

/// The files that place points. With integer factors a point count is enough; otherwise the file
/// `stored` reads or replaces the contexts.
pub(super) const fn placing(setup: Setup, stored: &'static str) -> [Choice; 2] {
    if setup.has_integer_factors() {
        [("place", "variants/place_evenly"), ("contexts", "variants/place_evenly")]
    } else {
        [("place", "stages/place"), ("contexts", stored)]
    }
}

/// The file that stores indices.
pub(super) const fn indices(setup: Setup) -> Choice {
    let file = match setup.index_type {
        IndexType::U16 => "variants/indices_u16",
        IndexType::U32 => "variants/indices_u32",
    };
    ("indices", file)
}

/// The file that enters topologies into the catalogue, or the one that does not.
pub(super) const fn listing(lists: bool) -> Choice {
    ("listing", if lists { "variants/listing" } else { "variants/no_listing" })
}

/// The files in which the expansions of short and long batches differ: the catalogue and the size
/// of tiles.
pub(super) const fn expanding(is_short: bool) -> [Choice; 2] {
    if is_short {
        [("catalogue", "variants/no_catalogue"), ("elements", "variants/narrow_tiles")]
    } else {
        [("catalogue", "variants/read_catalogue"), ("elements", "variants/wide_tiles")]
    }
}

/// The texts of files, each after all files that it needs, and each once.
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

/// The names in the first line of a file.
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
