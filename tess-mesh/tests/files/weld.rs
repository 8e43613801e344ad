//! Gaps: which corners are moved onto which, which edges are split, and what the new corners have.

use crate::edges::CUBE;
use crate::support::{Triangles, floats_of, has_note, obj, obj_with, tessellated, written};
use serde_json::Value;
use tess_mesh::tess_surface::Style;
use tess_mesh::tess_surface::glam::Vec3;
use tess_mesh::{LoadOptions, Loaded, Weld};

fn welded(text: &str, reach: Option<f32>) -> Loaded {
    let flat =
        LoadOptions { style: Some(Style::Flat), weld: Weld::UpTo(reach), ..Default::default() };
    obj_with(text, &flat).expect("it is read")
}

/// Triangles with one corner each at these places along x, and the others far away.
fn corners_at(places: &[f32]) -> String {
    let others = ["5 0", "0 5", "-5 0", "0 -5"].into_iter().zip(["5 2", "-2 5", "-5 -2", "2 -5"]);
    let triangle = |(at, (b, c))| format!("v {at} 0 0\nv {at} {b}\nv {at} {c}\nf -3 -2 -1\n");
    places.iter().zip(others).map(triangle).collect()
}

fn places_near_0(loaded: &Loaded) -> Vec<f32> {
    let mesh = loaded.model.mesh().expect("polygons");
    mesh.faces.iter().map(|face| mesh.corners(face).as_slice()[0].x).collect()
}

/// A corner moves onto the first within reach that does not move itself.
#[test]
fn corners_move_onto_the_first_that_stays() {
    for (places, expected) in [
        (&[0.0, 0.08, 0.16][..], &[0.0, 0.0, 0.16][..]),
        (&[0.0, 0.16, 0.08], &[0.0, 0.16, 0.0]),
        (&[0.16, 0.0, 0.08], &[0.16, 0.0, 0.16]),
        (&[0.0, 0.15, 0.3], &[0.0, 0.15, 0.3]),
        (&[0.0, 0.08, 0.05, 0.02], &[0.0; 4]),
    ] {
        let found = places_near_0(&welded(&corners_at(places), Some(0.1)));
        assert_eq!(found, expected, "{places:?}");
    }
}

/// Without a width: gaps of 1e-6 of the diagonal, and of four units in the last place.
#[test]
fn gaps_that_rounding_causes() {
    let gap = |from: f32, width: f32| {
        let near = from + width;
        format!(
            "s off\nv {from} 0 0\nv {from} 1 0\nv {from} 0 1\nv {near} 0 0\nv {from} -1 0\nv {from} 0 -1\n\
             f 1 2 3\nf 4 5 6\n"
        )
    };
    for (from, width, is_gap) in
        [(0.0, 2e-6, true), (0.0, 4e-6, false), (1000.0, 2.5e-4, true), (1000.0, 1e-3, false)]
    {
        let noted = obj(&gap(from, width)).notes.iter().any(|note| note.contains("may open"));
        assert_eq!(noted, is_gap, "{width} at {from}");
        let moved =
            welded(&gap(from, width), None).notes.iter().any(|n| n.contains("moved onto it"));
        assert_eq!(moved, is_gap, "{width} at {from}, welded");
    }
}

/// Faces with details that are smaller than the reach keep them.
#[test]
fn details_are_no_gaps() {
    for text in [
        // A short edge; a low triangle; a corner beside an edge, a little too far away.
        "v 0 0 0\nv 0.05 0 0\nv 3 4 0\nf 1 2 3\n",
        "v 0 0 0\nv 4 0 0\nv 2 0.05 0\nf 1 2 3\n",
        "v 0 0 0\nv 4 0 0\nv 2 4 0\nv 2 -0.15 0\nv 4 -4 0\nv 0 -4 0\nf 1 2 3\nf 4 5 6\n",
    ] {
        let loaded = welded(text, Some(0.1));
        assert_eq!(loaded.notes, [""; 0], "{text}");
    }
    let near = "v 0 0 0\nv 4 0 0\nv 2 4 0\nv 2 -0.09 0\nv 4 -4 0\nv 0 -4 0\nf 1 2 3\nf 4 5 6\n";
    has_note(&welded(near, Some(0.1)), "1 corner on another face's edge: the edge is split there");
}

/// Two corners of one quad move to the same place: it becomes a triangle.
#[test]
fn faces_that_moves_narrow() {
    let text =
        "v 0 0 0\nv 5 5 5\nv 5 0 5\nv 0.06 0 0\nv 0 0.06 0\nv 0 4 0\nv 4 0 0\nf 1 2 3\nf 4 5 6 7\n";
    let loaded = welded(text, Some(0.08));
    has_note(&loaded, "2 corners within 8.0e-2 of another: moved onto it");
    has_note(&loaded, "1 quad with corners in the same place: made triangles");
}

/// The ends of a seam are no open corners: here two boxes have one wall in common.
#[test]
fn closed_boxes_with_a_wall_have_no_gaps() {
    let text = format!(
        "{CUBE}v 2 0 0\nv 2 1 0\nv 2 0 1\nv 2 1 1\nv 0.5 -0.5 -0.5\nv 1.5 0.5 0.5\nv 3 -1 -5\n\
         f 2 4 10 9\nf 6 11 12 8\nf 2 9 11 6\nf 4 8 12 10\nf 9 10 12 11\nf 13 14 15\n"
    );
    let gaps = obj(&text).notes.iter().any(|note| note.contains("may open"));
    assert!(!gaps, "{:#?}", obj(&text).notes);
}

#[test]
fn the_first_face_that_is_turned_over() {
    let turned = CUBE.replace("f 1 3 4 2", "f 2 4 3 1").replace("f 1 5 7 3", "f 3 7 5 1");
    has_note(&obj(&turned), "6 edges along which both faces run the same way");
    has_note(&obj(&turned), "(first: line 9)");
    let turned = CUBE.replace("f 1 5 7 3", "f 3 7 5 1");
    has_note(&obj(&turned), "(first: line 9)");
}

/// The place in space of a place in a square.
type Space = fn(f32, f32) -> Vec3;

/// A square of 8 by 8, divided into rectangles in a way that depends on `seed`. Corners have
/// texture coordinates and colours that are linear in their place. Every rectangle has positions of
/// its own, and `place` puts them into space.
fn mosaic(seed: u32, place: Space) -> String {
    let mut state = seed;
    let mut next = |most: u32| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 16) % most
    };
    let mut whole = vec![[0u32, 0, 8, 8]];
    let mut text = String::new();
    while let Some([left, low, right, high]) = whole.pop() {
        let (width, height) = (right - left, high - low);
        let splits_width = width > 1 && (height == 1 || next(2) == 0);
        if (width * height > 16 || next(3) > 0) && splits_width {
            let at = left + 1 + next(width - 1);
            whole.extend([[left, low, at, high], [at, low, right, high]]);
        } else if (width * height > 16 || next(3) > 0) && height > 1 {
            let at = low + 1 + next(height - 1);
            whole.extend([[left, low, right, at], [left, at, right, high]]);
        } else {
            for (x, y) in [(left, low), (right, low), (right, high), (left, high)] {
                let [u, v] = [x, y].map(|k| k as f32);
                let at = place(u, v);
                text += &format!("v {} {} {} {} {} 0.5\n", at.x, at.y, at.z, u / 8.0, v / 8.0);
                text += &format!("vt {} {}\n", u / 8.0, v / 8.0);
            }
            text += "f -4/-4 -3/-3 -2/-2 -1/-1\n";
        }
    }
    text
}

/// The number of places on the outline of the square.
fn outline(triangles: &Triangles, on_outline: impl Fn(Vec3) -> bool) -> usize {
    let corners = triangles.corners.as_flattened().iter().filter(|&&at| on_outline(at));
    let places = corners.map(|at| (*at + Vec3::ZERO).to_array().map(f32::to_bits));
    places.collect::<std::collections::BTreeSet<_>>().len()
}

/// Rectangles whose corners hang on each other's edges, in every direction of space: welded, they
/// have the square's outline and area, and the values of new corners are those of their places.
#[test]
fn mosaics_close() {
    let spaces: [(Space, f32); 4] = [
        (|x, y| Vec3::new(x, y, 0.0), 64.0),
        (|x, y| Vec3::new(0.0, x, y), 64.0),
        (|x, y| Vec3::new(y, 0.0, x), 64.0),
        (|x, y| Vec3::new(x, y - x, x + 2.0 * y), 64.0 * 3.741_657_5),
    ];
    for seed in 0..12 {
        for (place, area) in spaces {
            let loaded = welded(&mosaic(seed, place), None);
            assert!(!loaded.notes.iter().any(|note| note.contains("open")), "{:?}", loaded.notes);
            let triangles = tessellated(&loaded, 1.0);
            let borders = [0.0f32, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]
                .map(|k| [place(k, 0.0), place(k, 8.0), place(0.0, k), place(8.0, k)]);
            let expected = outline(&triangles, |at| borders.as_flattened().contains(&at));
            assert_eq!(triangles.open_edges(), expected, "seed {seed}: only the outline is open");
            let found = triangles.area();
            assert!((found / area - 1.0).abs() < 1e-4, "seed {seed}: {found} of {area}");
            values_are_linear(&written(&loaded, 1.0), place, seed);
        }
    }
}

fn values_are_linear((document, bytes): &(Value, Vec<u8>), place: Space, seed: u32) {
    let attributes = &document["meshes"][0]["primitives"][0]["attributes"];
    let values = |name: &str| floats_of(document, bytes, &attributes[name]);
    let others = values("TEXCOORD_0").into_iter().zip(values("COLOR_0"));
    for (at, (texcoord, color)) in values("POSITION").iter().zip(others) {
        let [u, v] = [texcoord[0], 1.0 - texcoord[1]];
        let expected = place(8.0 * u, 8.0 * v);
        assert!(Vec3::from_slice(at).distance(expected) < 1e-4, "seed {seed}: {at:?}, ({u}, {v})");
        let near = (color[0] - u).abs() < 1e-5 && (color[1] - v).abs() < 1e-5;
        assert!(near, "seed {seed}: {at:?}: {color:?}, ({u}, {v})");
    }
}

/// A corner 0.09 beside a long edge splits it. One of the halves is then within reach of another
/// corner, which was 0.13 beside the whole edge.
#[test]
fn edges_that_a_split_brings_near() {
    let text = "v 0 0 0\nv 2 -2 0\nv 4 0 0\nv 1 0.13 0\nv 2 0.09 0\nv 0.5 2 0\nv 1.5 2 0\nv 3 2 0\n\
        f 1 2 3\nf 1 4 6\nf 4 5 7\nf 5 3 8\n";
    let loaded = welded(text, Some(0.1));
    has_note(&loaded, "1 corner on another face's edge: the edge is split there");
    // The long edge is three now, each with a neighbour; two edges of each triangle have none.
    assert_eq!(tessellated(&loaded, 1.0).open_edges(), 8, "{:?}", loaded.notes);
}

/// A new corner's normal is between those of the ends, whatever their lengths.
#[test]
fn normals_of_new_corners() {
    let text = "v 0 0 0\nv 4 0 0\nv 2 4 0\nv 2 0 0\nv 4 -4 0\nv 0 -4 0\n\
        vn 0 0 100\nvn 1 0 0\nvn 0 0 1\nf 1//1 2//2 3//3\nf 4//3 5//3 6//3\n";
    let options = LoadOptions { weld: Weld::UpTo(None), ..Default::default() };
    let loaded = obj_with(text, &options).expect("read");
    let mesh = loaded.model.mesh().expect("polygons");
    let half = Vec3::new(1.0, 0.0, 1.0).normalize();
    let is_half = |normal: &Vec3| normal.normalize().distance(half) < 1e-6;
    assert_eq!(
        mesh.normals.iter().filter(|normal| is_half(normal)).count(),
        1,
        "{:?}",
        mesh.normals
    );
}
