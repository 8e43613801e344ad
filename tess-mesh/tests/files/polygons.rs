//! Polygons: with holes, crossed, and of four corners.

use crate::support::{has_note, obj_with, tessellated};
use tess_mesh::LoadOptions;
use tess_mesh::tess_surface::Style;

fn flat(text: &str) -> tess_mesh::Loaded {
    let flat = LoadOptions { style: Some(Style::Flat), ..LoadOptions::default() };
    obj_with(text, &flat).expect("it is read")
}

#[test]
fn a_hole_s_edge_that_is_passed_three_times() {
    let text = "v 0 0 0\nv 10 0 0\nv 10 4 0\nv 0 4 0\nv 1 1 0\nv 3 1 0\nv 3 3 0\nv 1 3 0\n\
        v 6 1 0\nv 8 1 0\nv 8 3 0\nv 6 3 0\nf 1 2 3 4 1 5 8 7 6 5 6 9 12 11 10 9 6 5\n";
    let loaded = flat(text);
    let area = tessellated(&loaded, 2.0).area();
    assert!((area - 32.0).abs() < 1e-4, "{area}");
    has_note(&loaded, "1 polygon of more than four corners: cut into triangles (first: line 13)");
}

#[test]
fn polygons_and_quads_that_cross_themselves() {
    let points = "v 0 0 0\nv 2 2 0\nv 2 0 0\nv 0 2 0\nv -1 1 0\nv 0 3 0\n";
    for (face, note) in [
        ("f 1 2 3 4", "1 quad that crosses itself: cut into two triangles, as it has no inside"),
        ("f 1 2 3 6", "1 quad that crosses itself: cut into two triangles"),
        (
            "f 1 2 3 4 5",
            "1 polygon that crosses itself: cut into triangles around its first corner",
        ),
        ("f 1 2 3 6 5", "1 polygon that crosses itself"),
    ] {
        let loaded = flat(&format!("{points}{face}\n"));
        has_note(&loaded, note);
        let on_line = loaded.notes.iter().any(|note| note.contains("on one line"));
        assert!(!on_line, "{face}: {:?}", loaded.notes);
    }
}
