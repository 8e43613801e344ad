//! Tests that `tess mesh` begins nothing that is impossible: a result that its format cannot hold
//! is refused before a file is there, with the factor that would fit.

use crate::mesh::{counts, write};
use crate::support::{Folder, directory, tess};
use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;

/// A sheet of quads, `side` along each edge.
fn sheet(folder: &Folder, side: u32) -> PathBuf {
    let mut text = String::new();
    for at in 0..(side + 1) * (side + 1) {
        _ = writeln!(text, "v {} {} 0", at % (side + 1), at / (side + 1));
    }
    for at in 0..side * side {
        let first = at / side * (side + 1) + at % side + 1;
        _ = writeln!(text, "f {first} {} {} {}", first + 1, first + side + 2, first + side + 1);
    }
    write(folder, "sheet.obj", text)
}

/// 40 000 quads of factor 64: 169 million vertices of 32 bytes.
#[test]
fn a_result_of_more_than_4_gib_is_not_begun() {
    let folder = directory("more_than_4_gib");
    let input = sheet(&folder, 200);
    let out = folder.join("out.glb");
    let run = |options: &str| {
        let run = tess(&format!("mesh {} {options} -o {}", input.display(), out.display()));
        run.exits(2).prints_nothing().says("but a GLB file has at most 4 GiB; ");
        let names: Vec<_> = fs::read_dir(&folder).expect("the folder").collect();
        assert_eq!(names.len(), 1, "nothing else is there, hidden or not: {names:?}");
        run
    };
    let largest = run("--factor 64");
    largest.says("327680000 triangles with up to 169000000 vertices take up to ");
    // A quad of factor 43 has 1936 vertices of 32 bytes and 3698 triangles of 12; one of factor 44
    // has 2025 and 3872, and 40 000 of these are more than 2^32 bytes.
    largest.says("--factor 43 would fit");
    run("--factor 44").says("--factor 43 would fit");
    run("--partitioning fractional_odd --factor 63").says("would fit");
    run("--distance 1e9").says("choose coarser triangles");
}

/// Without a factor, the model gets the largest with which viewers open it, and is told which.
#[test]
fn the_default_factor_fits_the_model() {
    let folder = directory("the_default_factor");
    for (side, factor, triangles) in
        [(1, 64, 8192), (10, 38, 288_800), (100, 3, 180_000), (390, 1, 304_200)]
    {
        let (input, out) = (sheet(&folder, side), folder.join("out.glb"));
        let run = tess(&format!("mesh {} -o {}", input.display(), out.display()));
        run.exits(0).says(format!("tess: note: factor {factor}, as none was given (--factor)\n"));
        assert_eq!(counts(&run)[2], triangles, "{side}: {run}");
    }
}
