//! Faces without area: whatever the order of their corners, what was closed stays closed.

use crate::edges::CUBE;
use crate::support::{Triangles, has_note, obj, obj_with, tessellated};
use tess_mesh::tess_surface::{DisplacedModel, Displacement, FactorRule, HeightMap, Style};
use tess_mesh::{Job, LoadOptions, Loaded, Weld};

/// The cube, with a corner in the middle of an edge and a face without area there.
fn box_with_sliver(sliver: &str) -> String {
    let faces = CUBE.replace("f 5 6 8 7\n", "f 5 9 8\nf 9 6 8\nf 5 8 7\n");
    let at = faces.find("f ").expect("faces");
    format!("{}v 0.5 0 1\n{}{sliver}\n", &faces[..at], &faces[at..])
}

#[test]
fn closed_stays_closed() {
    for sliver in ["f 5 6 9", "f 6 9 5", "f 9 5 6"] {
        let loaded = obj(&box_with_sliver(sliver));
        has_note(
            &loaded,
            "1 face with all corners on one line: left out, as they have no area; their neighbours meet",
        );
        let triangles = tessellated(&loaded, 4.0);
        assert_eq!(triangles.open_edges(), 0, "{sliver}");
        assert!((triangles.volume() - 1.0).abs() < 1e-5, "{sliver}: {}", triangles.volume());
    }
}

/// Displacement moves the corner, so that a gap would be seen.
#[test]
fn closed_when_displaced() {
    let loaded = obj(&box_with_sliver("f 5 6 9"));
    let map = HeightMap::new(2, 2, vec![0.0, 0.3, 0.6, 0.9]).expect("an image");
    let displacement = Displacement::new(map, 0.2).expect("heights");
    let displaced = DisplacedModel::new(&loaded.model, &displacement);
    let mut triangles = Triangles::default();
    let rule = FactorRule::Uniform(5.0);
    let job = Job { displaced: Some(&displaced), ..Job::new(&loaded.model, rule) };
    job.run(&mut triangles, &mut ()).expect("a sink without faults");
    assert_eq!(triangles.open_edges(), 0, "closed");
}

/// Two slivers side by side, which share their longest edge: each gets the other's corner.
#[test]
fn slivers_next_to_each_other() {
    let text = "v 0 0 0\nv 4 0 0\nv 1 0 0\nv 3 0 0\nv 2 2 0\nv 2 -2 0\nv 2 0 1\n\
        f 1 3 5\nf 3 2 5\nf 2 4 6\nf 4 1 6\nf 1 2 3\nf 1 4 2\n";
    let flat = LoadOptions { style: Some(Style::Flat), ..LoadOptions::default() };
    let triangles = tessellated(&obj_with(text, &flat).expect("read"), 3.0);
    // The outline of the two triangles, each of whose outer edges has three segments.
    assert_eq!(triangles.open_edges(), 4 * 3, "only the outline is open");
    assert!((triangles.area() - 8.0).abs() < 1e-5, "{}", triangles.area());
}

fn needle(order: [usize; 3]) -> Loaded {
    let [a, b, c] = order;
    obj(&format!(
        "v 0 0 0\nv 1000 0 0\nv 1000 0.0001 0\nv 0 0 5\nv 1 0 5\nv 0 1 5\nf 4 5 6\nf {a} {b} {c}\n"
    ))
}

/// A triangle is long or is nothing, whichever corner comes first.
#[test]
fn needles_in_any_order() {
    let orders = [[1, 2, 3], [2, 3, 1], [3, 1, 2], [1, 3, 2], [3, 2, 1], [2, 1, 3]];
    let patches = orders.map(|order| needle(order).model.len());
    assert_eq!(patches, [1; 6], "left out in every order");
}

/// Corners that hang on an edge which has neighbours on both sides.
#[test]
fn corners_on_edges_with_neighbours() {
    // Two quads meet at x = 1; a fin stands on their edge, and its foot is in the middle.
    let text = "v 0 0 0\nv 1 0 0\nv 1 2 0\nv 0 2 0\nv 2 0 0\nv 2 2 0\nv 1 1 0\nv 1 2 1\n\
        f 1 2 3 4\nf 2 5 6 3\nf 7 3 8\n";
    has_note(&obj(text), "1 corner on another face's edge");
    let options = LoadOptions { weld: Weld::UpTo(None), ..LoadOptions::default() };
    let welded = obj_with(text, &options).expect("read");
    has_note(&welded, "1 corner on another face's edge: the edge is split there");
    assert!(welded.model.len() > 3, "the quads are cut");
    let is_noted = |loaded: &Loaded| loaded.notes.iter().any(|note| note.contains("may open"));
    assert!(!is_noted(&welded), "{:?}", welded.notes);
}

/// Faces are cut, dropped and cut again; places are those of the file all the same.
#[test]
fn places_after_repairs() {
    let text = "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 3 1 0\nv 2 0 0\nv 1e17 0 0\n\
        f 1 2 3 4 4\nf 1 2 5 3\nf 1 1 2\nf 1 6 2\nf 1 6 2 3 4\nf 1 2 7\n";
    let message = obj_with(text, &LoadOptions::default()).expect_err("too large").to_string();
    assert!(message.starts_with("line 13: a position is too large"), "{message}");
    let right = text.replace("1e17", "9");
    let notes = obj(&right).notes;
    for (start, line) in [
        ("1 concave quad", 9),
        ("1 face with corners in the same place", 10),
        ("2 faces with all corners on one line", 11),
    ] {
        let note = notes.iter().find(|note| note.starts_with(start));
        assert!(note.is_some_and(|note| note.contains(&format!("line {line})"))), "{notes:#?}");
    }
}

/// All ways to cut the row of corners from `first` to `last` into faces without area.
fn cuts(first: usize, last: usize) -> Vec<Vec<Vec<usize>>> {
    let mut all = Vec::new();
    if last - first < 2 {
        return vec![Vec::new()];
    }
    // The face at the edge from the first corner to the last has one or two corners between.
    for a in first + 1..last {
        for (before, after) in pairs(&cuts(first, a), &cuts(a, last)) {
            all.push([vec![vec![first, a, last]], before, after].concat());
        }
        for b in a + 1..last {
            for (before, rest) in pairs(&cuts(first, a), &cuts(a, b)) {
                for after in cuts(b, last) {
                    let rest = [before.clone(), rest.clone(), after].concat();
                    all.push([vec![vec![first, a, b, last]], rest].concat());
                }
            }
        }
    }
    all
}

fn pairs<T: Clone>(one: &[T], other: &[T]) -> Vec<(T, T)> {
    one.iter().flat_map(|a| other.iter().map(|b| (a.clone(), b.clone()))).collect()
}

/// A box with three corners in one edge, of which one of the edge's faces knows nothing: the faces
/// between have no area. However these are cut and turned, and in whichever order they come, the
/// box stays closed, and texture coordinates stay with their places.
#[test]
fn every_row_of_slivers() {
    // The top face of the cube has the corners 9, 10 and 11 on its edge 5-6.
    let points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n\
        v 0.25 0 1\nv 0.5 0 1\nv 0.75 0 1\n";
    let row = [5, 9, 10, 11, 6];
    let top = [[5, 9, 7], [9, 10, 7], [10, 11, 8], [11, 6, 8], [10, 8, 7]];
    let sides = [[1, 3, 4, 2], [1, 2, 6, 5], [3, 7, 8, 4], [1, 5, 7, 3], [2, 4, 8, 6]];
    let all = cuts(0, 4);
    assert_eq!(all.len(), 10, "five of triangles, five with a quad");
    for (number, cut) in all.iter().enumerate() {
        for turn in 0..8 {
            let slivers = cut.iter().map(|sliver| {
                let mut sliver: Vec<usize> = sliver.iter().map(|&at| row[at]).collect();
                let count = sliver.len();
                sliver.rotate_left((turn + number) % count);
                if turn % 2 == 1 {
                    sliver.reverse();
                }
                sliver
            });
            let whole = top.iter().map(|f| f.to_vec()).chain(sides.iter().map(|f| f.to_vec()));
            let mut faces: Vec<Vec<usize>> = whole.chain(slivers).collect();
            match turn / 2 {
                0 => {}
                1 => faces.reverse(),
                2 => faces[10..].reverse(),
                _ => faces.rotate_right(3),
            }
            stays_closed(points, &faces);
        }
    }
}

fn stays_closed(points: &str, faces: &[Vec<usize>]) {
    let corner = |at: &usize| format!(" {at}/{at}");
    let lines =
        faces.iter().map(|face| format!("f{}\n", face.iter().map(corner).collect::<String>()));
    let coordinates = points.replace("v ", "vt ");
    let text = format!("s off\n{points}{coordinates}{}", lines.collect::<String>());
    let loaded = obj(&text);
    let triangles = tessellated(&loaded, 3.0);
    assert_eq!(triangles.open_edges(), 0, "{text}");
    assert!((triangles.volume() - 1.0).abs() < 1e-5, "{text}: {}", triangles.volume());
    let mesh = loaded.model.mesh().expect("polygons");
    for face in &mesh.faces {
        let places = mesh.corners(face);
        let texcoords = face.texcoords.expect("they stay").map(|at| mesh.texcoords[at as usize]);
        for (place, texcoord) in places.as_slice().iter().zip(texcoords.as_slice()) {
            assert!(texcoord.distance(place.truncate()) < 1e-6, "{place}: {texcoord}: {text}");
        }
    }
}

/// A quad with two corners in one place becomes a triangle with the values that it has.
#[test]
fn quads_that_become_triangles() {
    let points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0.6 0.8\n";
    for face in ["1 1 2 3", "1 2 2 3", "1 2 3 3", "1 2 3 1"] {
        let corners = face.split(' ').map(|at| format!(" {at}/{at}/1")).collect::<String>();
        let loaded = obj(&format!("{points}f{corners}\n"));
        has_note(&loaded, "1 quad with corners in the same place: made triangles");
        let mesh = loaded.model.mesh().expect("polygons");
        let [face] = &mesh.faces[..] else { panic!("one face") };
        assert_eq!(face.normals.map(|at| at.as_slice().to_vec()), Some(vec![0; 3]), "its normal");
        let texcoords = face.texcoords.expect("it has some");
        assert_eq!(texcoords, face.positions, "its texture coordinates");
    }
}

/// A normal of zero is no normal.
#[test]
fn normals_that_are_none() {
    for normal in ["0 0 0", "nan 0 1", "inf 0 0"] {
        let loaded = obj(&format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn {normal}\nf 1//1 2//1 3//1\n"));
        has_note(&loaded, "1 face with a normal that is zero, NaN or infinite");
    }
}
