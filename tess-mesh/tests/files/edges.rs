//! Edges are hard where the file says so, and by their angle where it says nothing.

use crate::support::{Gltf, has_note, obj, obj_with, tessellated};
use tess_mesh::LoadOptions;
use tess_mesh::tess_surface::Style;

/// A cube of volume 1 without normals.
pub(crate) const CUBE: &str = "\
v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n\
f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";

fn volume(text: &str, options: &LoadOptions) -> f32 {
    let loaded = obj_with(text, options).expect("it is read");
    let triangles = tessellated(&loaded, 5.0);
    assert_eq!(triangles.open_edges(), 0, "closed: {text}");
    triangles.volume()
}

fn is_one(volume: f32) -> bool {
    (volume - 1.0).abs() < 1e-5
}

#[test]
fn a_box_stays_a_box() {
    let options = LoadOptions::default();
    for text in [CUBE.to_owned(), format!("s off\n{CUBE}"), format!("s 0\n{CUBE}")] {
        let found = volume(&text, &options);
        assert!(is_one(found), "{found}: {text}");
    }
    has_note(&obj(CUBE), "12 edges of faces without normals: kept hard");
    assert_eq!(obj(&format!("s off\n{CUBE}")).notes, [""; 0], "the file says it");
    // One smoothing group, or no crease: a pillow.
    for (text, crease) in [(format!("s 1\n{CUBE}"), 30.0), (CUBE.to_owned(), 91.0)] {
        let found = volume(&text, &LoadOptions { crease, ..options });
        assert!(found > 1.2, "{found}: {text}");
    }
    // Groups of their own for each face: hard edges again.
    let mut groups = 0;
    let lines = CUBE.lines().map(|line| {
        groups += i32::from(line.starts_with('f'));
        if line.starts_with('f') { format!("s {groups}\n{line}\n") } else { format!("{line}\n") }
    });
    assert!(is_one(volume(&lines.collect::<String>(), &options)), "six groups");
    let flat = LoadOptions { style: Some(Style::Flat), ..options };
    assert_eq!(obj_with(CUBE, &flat).expect("read").notes, [""; 0], "flat faces have no creases");
}

/// A ball of rings and segments of 15 degrees.
fn ball() -> String {
    let (rings, segments) = (12u16, 24u16);
    let mut text = String::new();
    for ring in 0..=rings {
        for segment in 0..segments {
            let (v, u) =
                (f32::from(ring) / f32::from(rings), f32::from(segment) / f32::from(segments));
            let (v, u) = (v * std::f32::consts::PI, u * std::f32::consts::TAU);
            let radius = if ring == 0 || ring == rings { 0.0 } else { libm::sinf(v) };
            let [x, y, z] = [radius * libm::cosf(u), libm::cosf(v), -radius * libm::sinf(u)];
            text += &format!("v {x} {y} {z}\n");
        }
    }
    for ring in 0..rings {
        for segment in 0..segments {
            let next = (segment + 1) % segments;
            let at = |ring: u16, segment: u16| ring * segments + segment + 1;
            let [a, b, c, d] =
                [at(ring, segment), at(ring + 1, segment), at(ring + 1, next), at(ring, next)];
            text += &format!("f {a} {b} {c} {d}\n");
        }
    }
    text
}

#[test]
fn a_ball_becomes_round() {
    let loaded = obj(&ball());
    assert!(!loaded.notes.iter().any(|note| note.contains("hard")), "{:?}", loaded.notes);
    let triangles = tessellated(&loaded, 6.0);
    let round = 4.0 / 3.0 * std::f32::consts::PI;
    assert!((triangles.volume() / round - 1.0).abs() < 5e-3, "{}", triangles.volume());
    assert_eq!(triangles.open_edges(), 0, "closed");
    // With a smaller angle the same ball keeps its edges.
    let hard = obj_with(&ball(), &LoadOptions { crease: 10.0, ..LoadOptions::default() });
    let flat = tessellated(&hard.expect("read"), 6.0).volume();
    assert!(flat < 0.98 * round, "{flat}");
}

/// A file may say it for some faces only. A flat face next to smooth ones keeps its plane.
#[test]
fn some_faces_are_flat() {
    let halves = ball();
    let at = halves.find("f 145 ").expect("the seventh ring begins");
    let mixed = format!("s 1\n{}s off\n{}", &halves[..at], &halves[at..]);
    let (smooth, flat) =
        (tessellated(&obj(&format!("s 1\n{halves}")), 4.0), tessellated(&obj(&mixed), 4.0));
    assert_eq!(flat.open_edges(), 0, "closed");
    let (smooth, half) = (smooth.volume(), flat.volume());
    let all_flat = tessellated(&obj(&format!("s off\n{halves}")), 4.0).volume();
    assert!(all_flat < half && half < smooth, "{all_flat} < {half} < {smooth}");
}

/// glTF 2.0, section 3.7.2.1: without normals, triangles are flat.
#[test]
fn gltf_without_normals_is_flat() {
    let mut gltf = Gltf::triangle();
    let corners = [0., 0., 0., 1., 0., 0., 0., 1., 0., 0., 0., 1.];
    let positions = gltf.floats(&corners, "VEC3", 4);
    gltf.attribute("POSITION", positions);
    let indices = gltf.accessor(&[0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3], 5121, "SCALAR", 12);
    gltf.primitive()["indices"] = indices.into();
    let loaded = gltf.loaded();
    assert_eq!(loaded.notes, [""; 0], "the format says it");
    let volume = tessellated(&loaded, 7.0).volume();
    assert!((volume - 1.0 / 6.0).abs() < 1e-6, "{volume}");
}

#[test]
fn faces_that_are_turned_over_are_noted() {
    let turned = CUBE.replace("f 1 3 4 2", "f 2 4 3 1");
    has_note(&obj(&turned), "4 edges along which both faces run the same way");
}

/// Angles above 90 degrees: the normals of a tetrahedron's faces are 109.5 degrees apart.
#[test]
fn creases_of_more_than_a_right_angle() {
    let text = "v 1 1 1\nv 1 -1 -1\nv -1 1 -1\nv -1 -1 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n";
    for (crease, hard) in [(100.0, 6), (109.0, 6), (110.0, 0), (180.0, 0)] {
        let options = LoadOptions { crease, ..LoadOptions::default() };
        let found = obj_with(text, &options).expect("read").model.creases().len();
        assert_eq!(found, hard, "{crease} degrees");
    }
}
