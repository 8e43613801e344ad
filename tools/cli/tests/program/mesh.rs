//! Tests of `tess mesh`.

use crate::support::{Run, directory, tess};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

pub(crate) const CUBE: &str = "\
v -1 -1 -1
v 1 -1 -1
v 1 1 -1
v -1 1 -1
v -1 -1 1
v 1 -1 1
v 1 1 1
v -1 1 1
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
";

pub(crate) fn write(folder: &Path, name: &str, content: impl AsRef<[u8]>) -> PathBuf {
    let path = folder.join(name);
    fs::write(&path, content).expect("the test's file is written");
    path
}

/// Runs `tess mesh IN [options] -o OUT`, which must succeed and print nothing. All edges are smooth
/// where the file says nothing, so that there is no note about hard ones.
pub(crate) fn mesh(input: &Path, options: &str, output: &Path) -> Run {
    let run =
        tess(&format!("mesh {} --crease 180 {options} -o {}", input.display(), output.display()));
    run.exits(0).prints_nothing();
    run
}

/// The numbers in the line of counts, which comes after the notes.
pub(crate) fn counts(run: &Run) -> Vec<u64> {
    let mut lines = run.stderr.lines().skip_while(|line| line.starts_with("tess: note: "));
    let line = lines.next().unwrap_or_default();
    line.split_whitespace().filter_map(|word| word.parse().ok()).collect()
}

/// The edges that belong to one triangle only, after vertices with identically written positions
/// are merged.
pub(crate) fn open_edges(obj: &Path) -> usize {
    let text = fs::read_to_string(obj).expect("the OBJ is there");
    let positions: Vec<&str> = text.lines().filter_map(|line| line.strip_prefix("v ")).collect();
    let mut uses: BTreeMap<[&str; 2], u32> = BTreeMap::new();
    for face in text.lines().filter_map(|line| line.strip_prefix("f ")) {
        let number = |word: &str| word.split('/').next()?.parse::<usize>().ok();
        let corners: Vec<&str> =
            face.split(' ').filter_map(number).map(|n| positions[n - 1]).collect();
        let [a, b, c] = corners[..] else { panic!("triangles: {face}") };
        if a != b && b != c && c != a {
            for [from, to] in [[a, b], [b, c], [c, a]] {
                *uses.entry(if from < to { [from, to] } else { [to, from] }).or_default() += 1;
            }
        }
    }
    uses.values().filter(|&&count| count == 1).count()
}

#[test]
fn the_teapot_in_every_form() {
    let folder = directory("mesh_forms");
    for name in ["teapot.obj", "teapot.gltf", "teapot.glb", "teapot.png"] {
        let out = folder.join(name);
        let size = if name.ends_with("png") { "--size 120x90" } else { "" };
        let run = mesh(Path::new(""), &format!("--factor 4 {size}"), &out);
        assert_eq!(counts(&run), [32, 800, 1024], "patches, vertices, triangles of {name}");
        assert!(out.metadata().is_ok_and(|file| file.len() > 1000), "{name} is there");
    }
    let names = fs::read_dir(&folder).unwrap().count();
    assert_eq!(names, 5, "the four and teapot.bin, nothing half-written");
    // The border is 16 open curves of 4 segments each.
    assert_eq!(open_edges(&folder.join("teapot.obj")), 64, "open edges");
}

/// A cube has no border, so its tessellation has none.
#[test]
fn no_cracks_in_files() {
    let folder = directory("mesh_cracks");
    let cube = write(&folder, "cube.obj", CUBE);
    let image = folder.join("height.png");
    mesh(Path::new(""), "--factor 2 --size 32x24", &image);
    let displace = format!("--displace {} --height 0.2", image.display());
    let out = folder.join("out.obj");
    for options in [
        "--factor 5".to_owned(),
        "--surface flat --distance 20 --partitioning fractional_odd".to_owned(),
        "--pixels 9 --partitioning fractional_even".to_owned(),
        format!("--tolerance 0.01 {displace}"),
        format!("--distance 30 {displace}"),
    ] {
        mesh(&cube, &options, &out);
        assert_eq!(open_edges(&out), 0, "{options}");
    }
    let cut = fs::read_to_string(&out).unwrap().replacen("\nf ", "\n# ", 1);
    fs::write(&out, cut).unwrap();
    assert_eq!(open_edges(&out), 3, "a missing triangle leaves three open edges");
}

/// Outputs can be read back: meshes as quads and triangles, with the counts that were stated.
#[test]
fn outputs_are_inputs() {
    let folder = directory("mesh_round");
    let cube = write(&folder, "cube.obj", CUBE);
    for (name, width) in [("a.obj", "auto"), ("a.gltf", "16"), ("a.glb", "16"), ("b.glb", "32")] {
        let out = folder.join(name);
        mesh(&cube, &format!("--factor 3 --indices {width}"), &out);
        let again = mesh(&out, "--factor 1", &folder.join("again.obj"));
        assert_eq!(counts(&again), [108, 324, 108], "6 quads of 18 triangles, from {name}");
        assert_eq!(open_edges(&folder.join("again.obj")), 0, "{name}");
    }
    // Three 16-bit indices leave two bytes of padding.
    let triangle = write(&folder, "t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    mesh(&triangle, "--factor 1 --indices 16", &folder.join("t.glb"));
    for name in ["a.glb", "t.glb"] {
        let glb = fs::read(folder.join(name)).unwrap();
        let length = u32::from_le_bytes(glb[8..12].try_into().unwrap());
        assert_eq!(length as usize, glb.len(), "the length in the header of {name}");
    }
}

#[test]
fn bezier_patch_files() {
    let folder = directory("mesh_bpt");
    let rows = |z: &str| (0..16).map(|k| format!("{} {} {z}\n", k % 4, k / 4)).collect::<String>();
    let plane = write(&folder, "plane.bpt", format!("1\n3 3\n{}", rows("0")));
    let run = mesh(&plane, "--factor 2", &folder.join("plane.obj"));
    assert_eq!(counts(&run), [1, 9, 8], "patches, vertices, triangles");
    let rational = write(&folder, "rational.bpt", format!("1\n3 3\n{}", rows("0 2")));
    mesh(&rational, "--factor 2", &folder.join("rational.obj"));
    let [a, b] = ["plane.obj", "rational.obj"].map(|name| fs::read(folder.join(name)).unwrap());
    assert_eq!(a, b, "a weight common to all points changes nothing");
}

/// Files that are refused, each with text from the message.
fn bad_files() -> Vec<(&'static str, String, &'static str)> {
    let patch = format!("3 3\n{}", "0 0 0\n1 0 0\n2 1 0\n3 0 0\n".repeat(4));
    Vec::from([
        ("empty.obj", String::new(), "there is no face"),
        ("count.bpt", "many\n".to_owned(), "line 1: `many` is not a number of patches"),
        (
            "cut.bpt",
            format!("2\n{patch}"),
            "line 18: the file ends after this line; patch 2 of 2 is missing",
        ),
        ("degree.bpt", "1\n2 3\n".to_owned(), "line 2: the degrees of patch 1 are `2 3`"),
        (
            "point.bpt",
            format!("1\n{}", patch.replacen("2 1 0", "2 1", 1)),
            "line 5: `2 1` is not a point",
        ),
        (
            "more.bpt",
            format!("1\n{patch}0 0 0\n"),
            "line 19: `0 0 0` follows the last of 1 patches",
        ),
        ("text.gltf", "{".to_owned(), "text.gltf: "),
        ("model.stl", "solid".to_owned(), "models are .obj, .gltf, .glb or .bpt"),
    ])
}

/// Every kind of bad input: exit code 2, the file and line, and an unchanged output file.
#[test]
fn bad_input_is_told() {
    let folder = directory("mesh_bad");
    let out = write(&folder, "out.obj", "as it was");
    for (name, content, message) in bad_files() {
        let input = write(&folder, name, content);
        let run = tess(&format!("mesh {} -o {}", input.display(), out.display()));
        run.exits(2);
        let told = run.stderr.contains(message) && run.stderr.contains(name);
        assert!(told, "{name}: `{message}` is not in `{}`", run.stderr);
        assert_eq!(fs::read(&out).unwrap(), b"as it was", "{name}");
    }
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 9, "nothing half-written stays");
}

/// Numbers that would have become `null` in the JSON text of glTF.
#[test]
fn positions_that_overflow_are_refused() {
    let folder = directory("mesh_huge");
    let out = write(&folder, "out.gltf", "as it was");
    let input = write(&folder, "huge.obj", CUBE.replace("v 1 1 1", "v 1 1.2e38 1"));
    let run = tess(&format!("mesh {} -o {}", input.display(), out.display()));
    let message = "huge.obj: line 10: a position is too large to be evaluated: coordinates must \
                   lie within 1e16 of 0";
    run.exits(2).says(message);
    assert_eq!(fs::read(&out).expect("it is still there"), b"as it was", "nothing was written");
}

#[test]
fn bad_usage_is_told() {
    let folder = directory("mesh_usage");
    let cube = write(&folder, "cube.obj", CUBE);
    let image = folder.join("height.png");
    mesh(&cube, "--factor 1 --size 8x8", &image);
    let (cube, image, out) = (cube.display(), image.display(), folder.join("out.glb"));
    let out = out.display();
    for (words, message) in [
        (format!("mesh missing.obj -o {out}"), "cannot read missing.obj"),
        (format!("mesh {cube} -o {out}.xyz"), "cannot tell what to write"),
        (format!("mesh {cube} -o no/such/folder/out.glb"), "cannot write no/such/folder/out.glb"),
        (format!("mesh {cube}"), "-o"),
        (format!("mesh {cube} --factor 0 -o {out}"), "greater than zero"),
        (format!("mesh {cube} --factor 2 --pixels 3 -o {out}"), "cannot be used with"),
        (format!("mesh {cube} --size 0x5 -o {out}"), "a size is such as 800x600"),
        (format!("mesh {cube} --height 1 -o {out}"), "--displace"),
        (format!("mesh {cube} --displace {cube} -o {out}"), "cannot read"),
        (format!("mesh {cube} --displace {image} --height 1e17 -o {out}"), "--height is too large"),
        (format!("mesh --surface flat -o {out}"), "the teapot is made of Bezier patches"),
        (format!("mesh --indices 16 -o {out}"), "more than 65535 vertices"),
    ] {
        tess(&words).exits(2).says(message);
    }
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 2, "no output was written");
}

/// The default camera shows the whole model, and not much more.
#[test]
fn the_default_camera() {
    let folder = directory("mesh_camera");
    let cube = write(&folder, "cube.obj", CUBE);
    let plane = write(&folder, "plane.obj", "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nf 1 4 3 2\n");
    let height = write_grey(&folder, 255);
    let displace = format!("--displace {} --height 0.5", height.display());
    for model in [Path::new(""), &cube, &plane] {
        for size in ["160x120", "80x160"] {
            for options in ["", "--fov 90", &displace] {
                let out = folder.join("out.png");
                mesh(model, &format!("--factor 8 --size {size} {options}"), &out);
                let (margin, filled) = margin_and_filled(&out);
                assert!(margin >= 1, "{} {size} {options}: cut off", model.display());
                assert!(filled >= 50, "{} {size} {options}: {filled} %", model.display());
            }
        }
    }
}

/// A height image of one pixel.
fn write_grey(folder: &Path, grey: u8) -> PathBuf {
    let path = folder.join("height.png");
    let file = fs::File::create(&path).expect("the test's file");
    let mut encoder = png::Encoder::new(file, 1, 1);
    encoder.set_color(png::ColorType::Grayscale);
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(&[grey]).expect("a pixel");
    path
}

/// The number of pixels between the picture's border and what is drawn, and how much of the width
/// or of the height is filled, whichever is more, in percent.
fn margin_and_filled(path: &Path) -> (usize, usize) {
    let file = std::io::BufReader::new(fs::File::open(path).expect("the picture"));
    let mut reader = png::Decoder::new(file).read_info().expect("a PNG");
    let mut bytes = vec![0; reader.output_buffer_size().expect("a size")];
    let info = reader.next_frame(&mut bytes).expect("pixels");
    let (width, height) = (info.width as usize, info.height as usize);
    let background = bytes[..3].to_vec();
    let drawn = |x: usize, y: usize| bytes[(y * width + x) * 3..][..3] != background[..];
    let all =
        || (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).filter(|&(x, y)| drawn(x, y));
    let low =
        (all().map(|(x, _)| x).min().expect("drawn"), all().map(|(_, y)| y).min().expect("drawn"));
    let high =
        (all().map(|(x, _)| x).max().expect("drawn"), all().map(|(_, y)| y).max().expect("drawn"));
    let margin = low.0.min(low.1).min(width - 1 - high.0).min(height - 1 - high.1);
    let part = |low: usize, high: usize, of: usize| 100 * (high - low + 1) / of;
    (margin, part(low.0, high.0, width).max(part(low.1, high.1, height)))
}
