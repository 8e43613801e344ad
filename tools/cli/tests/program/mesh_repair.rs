//! Tests of `tess mesh` on models with problematic faces: each is repaired or kept, and a note says
//! which, how many, and where the first one is.
#![expect(clippy::float_arithmetic, reason = "triangles are made of floats")]

use crate::mesh::{CUBE, counts, mesh, open_edges, write};
use crate::mesh_input::refused;
use crate::support::{Run, directory, tess};
use std::fs;
use std::path::Path;

/// The numbers of the lines that begin with `keyword`.
fn triples(obj: &Path, keyword: &str) -> Vec<[f32; 3]> {
    let text = fs::read_to_string(obj).expect("the OBJ is there");
    let lines = text.lines().filter_map(|line| line.strip_prefix(keyword));
    let numbers = lines.map(|line| line.split(' ').map(|word| word.parse().expect("a number")));
    numbers.map(|numbers| numbers.collect::<Vec<_>>().try_into().expect("three")).collect()
}

/// The number of triangles of an OBJ file whose normal points down, in a model that should face up.
fn overturned(obj: &Path) -> usize {
    let positions = triples(obj, "v ");
    let text = fs::read_to_string(obj).expect("the OBJ is there");
    let faces = text.lines().filter_map(|line| line.strip_prefix("f "));
    let is_down = |face: &&str| {
        let number = |word: &str| word.split('/').next()?.parse::<usize>().ok();
        let corners: Vec<_> =
            face.split(' ').filter_map(number).map(|n| positions[n - 1]).collect();
        let [[ax, ay, _], [bx, by, _], [cx, cy, _]] = corners[..] else { panic!("{face}") };
        (bx - ax) * (cy - ay) < (by - ay) * (cx - ax)
    };
    faces.filter(is_down).count()
}

fn note(run: &Run, text: &str) {
    run.says(format!("tess: note: {text}"));
}

fn no_note(run: &Run) {
    assert!(!run.stderr.contains("note"), "{run}");
}

#[test]
fn both_sides_of_a_sheet() {
    let folder = directory("mesh_two_sided");
    let sheet = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 1 1 0\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n\
                 f 2 1 5\nf 3 2 5\nf 4 3 5\nf 1 4 5\n";
    let out = folder.join("out.obj");
    let run = mesh(&write(&folder, "sheet.obj", sheet), "--factor 2", &out);
    note(&run, "4 edges of more than two faces: the faces are neighbours in pairs");
    let normals = triples(&out, "vn ");
    let half = normals.len() / 2;
    let expected = [vec![[0.0, 0.0, 1.0]; half], vec![[0.0, 0.0, -1.0]; half]].concat();
    assert_eq!(normals, expected, "the fronts look up, the backs look down");
    assert_eq!(open_edges(&out), 0, "the sides meet at the border");
}

#[test]
fn fins() {
    let folder = directory("mesh_fin");
    let fin = write(&folder, "fin.obj", format!("{CUBE}v 0 0 5\nf 1 2 9\n"));
    let out = folder.join("out.obj");
    for options in ["--factor 5", "--tolerance 0.01 --surface flat", "--distance 20"] {
        let run = mesh(&fin, options, &out);
        note(
            &run,
            "1 edge of more than two faces: faces there keep their own normals, as there is no \
             single neighbour (first: line 16)",
        );
        let segments = if options == "--factor 5" { 10 } else { 1 };
        assert!(open_edges(&out) >= segments, "{options}: the fin's other edges are open");
    }
}

#[test]
fn polygons_are_cut() {
    let folder = directory("mesh_polygons");
    let out = folder.join("out.obj");
    let points = "v 0 0 0\nv 2 0 0\nv 3 2 0\nv 1 3 0\nv -1 2 0\nv 1 1 0\nv 1 0 0\n";
    for (face, triangles, what) in [
        ("f 1 2 3 4 5", 3, "a pentagon"),
        ("f 1 2 6 3 4 5", 4, "with a corner that points inwards"),
        ("f 1 7 2 3 4 5", 4, "with a corner on a straight edge"),
        ("f -7/1 2/1 3/1 4/1 -3/1", 3, "with texture coordinates"),
    ] {
        let input = write(&folder, "polygon.obj", format!("{points}vt 0 0\n{face}\n"));
        let run = mesh(&input, "--factor 2 --surface flat", &out);
        note(&run, "1 polygon of more than four corners: cut into triangles (first: line 9)");
        assert_eq!(counts(&run)[0], triangles, "{what}: {run}");
        assert_eq!(overturned(&out), 0, "{what}");
    }
    let missing = write(&folder, "missing.obj", format!("{points}f 1 2 3 4 5 99\n"));
    refused(&missing, "", "missing.obj: line 8: position index 99 is out of range: there are 7");
    // A polygon is cut using all its corners, so that it meets its neighbours.
    let wall = format!("{points}v 0 -1 0\nv 2 -1 0\nf 1 7 2 3 4 5\nf 8 7 1\nf 8 9 2 7\n");
    let run = mesh(&write(&folder, "wall.obj", wall), "--factor 1 --surface flat", &out);
    assert!(!run.stderr.contains("on another face's edge"), "{run}");
}

#[test]
fn concave_quads_are_cut() {
    let folder = directory("mesh_concave");
    let out = folder.join("out.obj");
    let points = "v 0 0 0\nv 2 0 0\nv 0.4 0.4 0\nv 0 2 0\n";
    for face in ["f 1 2 3 4", "f 2 3 4 1", "f 3 4 1 2", "f 4 1 2 3"] {
        let input = write(&folder, "concave.obj", format!("{points}{face}\n"));
        for surface in ["flat", "pn"] {
            let run = mesh(&input, &format!("--factor 4 --surface {surface}"), &out);
            note(&run, "1 concave quad: cut into two triangles (first: line 5)");
            assert_eq!((counts(&run)[0], overturned(&out)), (2, 0), "{face}, {surface}");
        }
    }
}

#[test]
fn normals_without_a_direction() {
    let folder = directory("mesh_bad_normals");
    let out = folder.join("out.obj");
    let face = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for bad in ["0 0 0", "nan nan nan", "0 inf 0", "1e39 0 0", "-nan 0 1"] {
        let used = format!("{face}vn 0 0 -1\nvn {bad}\nf 1//1 2//1 3//2\n");
        let used = write(&folder, "used.obj", used);
        let run = mesh(&used, "--factor 1", &out);
        let says = "1 face with a normal that is zero, NaN or infinite: they get smooth normals (first: line 6)";
        note(&run, says);
        assert_eq!(triples(&out, "vn "), [[0.0, 0.0, 1.0]; 3], "{bad}: the face's own normal");
        no_note(&mesh(&used, "--factor 1 --surface flat", &out));
        let unused = write(&folder, "unused.obj", format!("{face}vn {bad}\nf 1 2 3\n"));
        no_note(&mesh(&unused, "--factor 1", &out));
    }
}

/// One large quad next to two small ones: the corner that the small ones share is on the large
/// one's edge.
const HANGING: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0.5 0\nv 2 0 0\nv 2 0.5 0\nv 2 1 0\n\
    vt 0 0\nvt .5 0\nvt .5 1\nvt 0 1\nvt .5 .5\nvt 1 0\nvt 1 .5\nvt 1 1\n\
    f 1/1 2/2 3/3 4/4\nf 2/2 6/6 7/7 5/5\nf 5/5 7/7 8/8 3/3\n";

#[test]
fn hanging_corners() {
    let folder = directory("mesh_hanging");
    let out = folder.join("out.obj");
    let input = write(&folder, "hanging.obj", HANGING);
    let open = mesh(&input, "--factor 6 --surface flat", &out);
    note(
        &open,
        "1 corner on another face's edge: a crack may open there, --weld splits the edge \
         (first: (1, 0.5, 0) on an edge at line 17)",
    );
    assert_eq!(open_edges(&out), 7 * 6 + 3 * 6, "7 edges of the border, 3 in the middle");
    let image = write_ramp(&folder);
    let displace = format!("--displace {} --height 0.3", image.display());
    for options in ["--surface flat", "", &displace] {
        let closed = mesh(&input, &format!("--factor 6 --weld {options}"), &out);
        note(&closed, "1 corner on another face's edge: the edge is split there");
        assert_eq!(counts(&closed)[0], 5, "the large quad is three triangles");
        assert_eq!(open_edges(&out), 7 * 6, "{options}: the border, of 7 edges");
    }
    // The split edge has the large quad's texture coordinates there.
    let texcoords = fs::read_to_string(&out).expect("it was written");
    assert!(texcoords.lines().any(|line| line == "vt 0.5 0.5"), "half of the edge");
}

/// Two corners are on one edge; the corner in the middle of the small quads is on no edge.
#[test]
fn several_hanging_corners() {
    let folder = directory("mesh_hanging_more");
    let out = folder.join("out.obj");
    let mut obj = "v 0 0 0\nv 0 3 1\nv -3 0 0\n".to_owned();
    for y in 0..4u8 {
        obj += &format!("v 0 {y} {}\nv 1 {y} 0\n", f32::from(y) / 3.0);
    }
    obj += "f 1 2 3\nf 4 5 7 6\nf 6 7 9 8\nf 8 9 11 10\n";
    let input = write(&folder, "more.obj", obj);
    note(&mesh(&input, "--factor 1", &out), "2 corners on another face's edge: a crack may open");
    mesh(&input, "--factor 4 --weld", &out);
    assert_eq!(open_edges(&out), (2 + 1 + 3 + 1) * 4, "only the border is open");
}

#[test]
fn seams_that_differ_in_the_last_digits() {
    let folder = directory("mesh_seam");
    let out = folder.join("out.obj");
    let seam = |low: &str, high: &str| {
        let points = "v -1 0 0\nv 0 0 0\nv 0 1 0\nv -1 1 0\n";
        format!("{points}v {low} 0 0\nv 1 0 0\nv 1 1 0\nv {high} 1 0\nf 1 2 3 4\nf 5 6 7 8\n")
    };
    let near = write(&folder, "near.obj", seam("1e-9", "-1e-9"));
    let run = mesh(&near, "--factor 4", &out);
    note(
        &run,
        "2 corners within 2.2e-6 of another: a crack may open there, --weld joins them (first: (0.000000001, 0, 0) at line 10)",
    );
    assert_eq!(open_edges(&out), 8 * 4, "the seam is open on both sides");
    let run = mesh(&near, "--factor 4 --weld", &out);
    note(
        &run,
        "2 corners within 2.2e-6 of another: moved onto it (first: (0.000000001, 0, 0) at line 10)",
    );
    assert_eq!(open_edges(&out), 6 * 4, "the border");
    let apart = write(&folder, "apart.obj", seam("0.01", "0.015"));
    no_note(&mesh(&apart, "--factor 4", &out));
    no_note(&mesh(&apart, "--factor 4 --weld", &out));
    mesh(&apart, "--factor 4 --weld=0.02", &out);
    assert_eq!(open_edges(&out), 6 * 4, "a wider gap");
    let (apart, out) = (apart.display(), out.display());
    tess(&format!("mesh {apart} --weld=0 -o {out}")).exits(2).says("greater than zero");
    tess(&format!("mesh --weld -o {out}")).exits(2).says("--weld is for triangles and quads");
}

/// Writes a height image of eight columns from black to white.
fn write_ramp(folder: &Path) -> std::path::PathBuf {
    let path = folder.join("ramp.png");
    let mut encoder = png::Encoder::new(fs::File::create(&path).expect("the test's file"), 8, 1);
    encoder.set_color(png::ColorType::Grayscale);
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(&[0, 36, 73, 109, 146, 182, 219, 255]).expect("pixels");
    path
}

/// The heights at the left and right ends of a flat strip with these texture coordinates.
#[test]
fn heights_beyond_the_image() {
    let folder = directory("mesh_wrap");
    let image = write_ramp(&folder);
    let out = folder.join("out.obj");
    let heights = |texcoords: &str, wrap: &str| {
        let [left, right] = texcoords.split_once(' ').map(|(l, r)| [l, r]).expect("two");
        let vt = format!("vt {left} 0\nvt {right} 0\nvt {right} 1\nvt {left} 1\n");
        let quad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
        let strip = write(&folder, "strip.obj", format!("{quad}{vt}f 1/1 2/2 3/3 4/4\n"));
        let displace = format!("--displace {} --height 1 --surface flat", image.display());
        let run = mesh(&strip, &format!("--factor 1 {displace} {wrap}"), &out);
        no_note(&run);
        let mut corners = triples(&out, "v ");
        corners.sort_by(|a, b| a[0].total_cmp(&b[0]));
        vec![corners[0][2], corners[3][2]]
    };
    for (texcoords, wrap, expected) in [
        ("0 1", "", [0.0, 1.0]),
        ("0 1", "--wrap clamp", [0.0, 1.0]),
        ("0 1", "--wrap repeat", [0.5, 0.5]),
        ("0 1", "--wrap mirror", [0.0, 1.0]),
        ("0 1.0625", "", [0.5, 0.0]), // above 1, so it repeats: the middle of the first column
        ("0 1.0625", "--wrap clamp", [0.0, 1.0]),
        ("-0.9375 2", "--wrap mirror", [1.0, 0.0]),
    ] {
        assert_eq!(heights(texcoords, wrap), expected.to_vec(), "{texcoords}, {wrap}");
    }
    let cube = write(&folder, "cube.obj", CUBE);
    let displace = format!("--factor 1 --displace {}", image.display());
    note(
        &mesh(&cube, &displace, &out),
        "6 faces without texture coordinates: each gets the whole height image (first: line 9)",
    );
    let run = mesh(Path::new(""), &displace, &out);
    note(&run, "32 Bezier patches without texture coordinates: each gets the whole height image");
    let (cube, out) = (cube.display(), out.display());
    tess(&format!("mesh {cube} --wrap clamp -o {out}")).exits(2).says("--displace");
}
