//! Tests of `tess mesh` on OBJ, Bezier patch and PNG files that are hostile or careless.

use crate::mesh::{CUBE, counts, mesh, open_edges, write};
use crate::support::{Run, directory, tess};
use std::fs;
use std::path::Path;

/// Runs `tess mesh` on bad input: exit code 2, a message that contains the file's name and
/// `message`, and no output.
pub(crate) fn refused(input: &Path, options: &str, message: &str) {
    let out = input.with_file_name("refused.out.obj");
    let run = tess(&format!("mesh {} {options} -o {}", input.display(), out.display()));
    let name = input.file_name().unwrap_or_default().to_string_lossy();
    run.exits(2);
    let names_both = run.stderr.contains(message) && run.stderr.contains(&*name);
    assert!(names_both, "{name}: `{message}` is not in `{}`", run.stderr);
    assert!(!out.exists(), "{name}: no output");
}

/// A link may lead to a device, which may have no end.
#[cfg(unix)]
#[test]
fn devices_are_not_models() {
    let folder = directory("mesh_devices");
    for name in ["model.obj", "model.gltf", "model.glb", "model.bpt"] {
        let model = folder.join(name);
        std::os::unix::fs::symlink("/dev/zero", &model).expect("a link");
        refused(&model, "--factor 1", "it is not an ordinary file");
    }
    let large = folder.join("large.obj");
    let file = fs::File::create(&large).expect("a file");
    file.set_len((1 << 32) + 1).expect("a sparse file");
    refused(&large, "--factor 1", "it is larger than 4 GiB");
}

#[test]
fn obj_lines_that_are_no_obj_are_named() {
    let folder = directory("mesh_obj_lines");
    for (line, message) in [
        ("f 1 2 0", "corner `0`: indices begin at 1"),
        ("f 1 2 -9", "corner `-9`: position index -9 is out of range: there are 8 so far"),
        ("f 1 2 99", "position index 99 is out of range: there are 8"),
        ("f 1 2 99999999999999999999", "is not a position index"),
        ("f /1 2 3", "corner `/1`: `` is not a position index"),
        ("f 1/1/1/1 2 3", "it has more than three indices"),
        ("f 5 6 7 x", "`f 5 6 7 x`: corner `x`: `x` is not a position index"),
    ] {
        let number = 14 + line.lines().count();
        let input = write(&folder, "line.obj", format!("{CUBE}{line}\n# the end\n"));
        refused(&input, "", message);
        refused(&input, "", &format!("line.obj: line {number}: "));
    }
    let mut bytes = CUBE.as_bytes().to_vec();
    bytes.extend(b"v 1 \xFC 2\nf 1 2 9\n");
    refused(
        &write(&folder, "latin.obj", bytes),
        "",
        "line 15: `v 1 \u{fffd} 2`: `\u{fffd}` is not",
    );
}

/// Lines that other programs write for the same cube.
#[test]
fn obj_files_that_say_the_same() {
    let folder = directory("mesh_obj_same");
    let whole = |name: &str, content: &[u8]| {
        let out = folder.join("out.obj");
        let run = mesh(&write(&folder, name, content), "--factor 2", &out);
        (run, fs::read(out).expect("it was written"))
    };
    let (_, expected) = whole("cube.obj", CUBE.as_bytes());
    let mut comments = b"# caf\xE9 \xFF\xFE\ng caf\xE9\nusemtl na\xEFf\n".to_vec();
    comments.extend(CUBE.replace("f 5", "s 1\nf 5").replace('\n', " # x\r\n").bytes());
    let extended: String = CUBE
        .lines()
        .map(|l| if l.starts_with('v') { format!("{l} 1\n") } else { format!("{l}\n") })
        .collect();
    let backwards = CUBE.replace("f 1 4 3 2", "f -8 -5 -6 -7");
    let faces = CUBE.find("f ").expect("there are faces");
    let faces_first = format!("{}{}", &CUBE[faces..], &CUBE[..faces]);
    for (name, content) in [
        ("mark.obj", [b"\xEF\xBB\xBF", CUBE.as_bytes()].concat()),
        ("comments.obj", comments),
        ("weights.obj", extended.into_bytes()),
        ("backwards.obj", backwards.into_bytes()),
        ("first.obj", faces_first.into_bytes()),
        ("slash.obj", CUBE.replace("f 1 4 3 2", "f 1/ 4/ 3/ 2/").into_bytes()),
        ("slashes.obj", CUBE.replace("f 1 4 3 2", "f 1// 4// 3// 2//").into_bytes()),
        ("no-end.obj", CUBE.trim_end().as_bytes().to_vec()),
    ] {
        let (run, written) = whole(name, &content);
        // Names are kept.
        let lines = written.split_inclusive(|&byte| byte == b'\n');
        let unnamed = lines.filter(|line| !line.starts_with(b"g ") && !line.starts_with(b"us"));
        assert!(unnamed.collect::<Vec<_>>().concat() == expected, "{name} is the same cube");
        assert!(!run.stderr.contains("note"), "{name}: {}", run.stderr);
    }
    let (run, written) = whole("others.obj", format!("{CUBE}l 1 2 3\np 1\n").as_bytes());
    assert!(written == expected, "lines and points change nothing");
    run.says("2 `l` or `p` lines: left out, as points and lines have no surface (first: line 15)");
}

#[test]
fn collapsed_faces_are_left_out() {
    let folder = directory("mesh_collapsed");
    let out = folder.join("out.obj");
    // A cube whose upper face is a point: four quads become triangles, and one has no area.
    let roof = CUBE.replace("v -1 1", "v 0 1").replace("v 1 1", "v 0 1");
    let pyramid = roof.replace("0 1 -1", "0 1 0").replace("0 1 1", "0 1 0");
    let run = mesh(&write(&folder, "pyramid.obj", &pyramid), "--factor 3", &out);
    let place = "with corners in the same place";
    run.says(format!(
        "tess: note: 1 face {place}: left out, as they have no area (first: line 13)"
    ));
    run.says(format!("tess: note: 4 quads {place}: made triangles (first: line 9)"));
    assert_eq!((counts(&run)[0], open_edges(&out)), (5, 0), "patches, open edges");
    // Lines are counted in the file, not among the remaining faces.
    let later = format!("{pyramid}v 0 1e17 0\nf 1 2 9\n");
    refused(&write(&folder, "later.obj", later), "", "later.obj: line 16: a position is too large");
    let straight = format!("{CUBE}v 0 9 0\nv 0 8 0\nv 0 7 0\nf 9 10 11\n");
    let run = mesh(&write(&folder, "straight.obj", straight), "--factor 3", &out);
    run.says(
        "tess: note: 1 face with all corners on one line: left out, as they have no area; their \
         neighbours meet there (first: line 18)",
    );
    assert_eq!(counts(&run)[0], 6, "the cube is left");
    let all = write(&folder, "all.obj", "v 0 0 0\nv 1 0 0\nf 1 2 2\nf 1 1 1\n");
    refused(&all, "", "all.obj: all faces, 2, have no area");
}

/// The poles of the teapot are triangles with two corners in the same place. At factor 1 the end of
/// the spout lies on one line, and the handle is folded flat at one of its joints.
#[test]
fn the_teapot_reads_back() {
    let folder = directory("mesh_teapot_back");
    let (teapot, again) = (folder.join("teapot.obj"), folder.join("again.obj"));
    for options in [
        "--factor 1",
        "--factor 8",
        "--factor 2.1 --partitioning fractional_odd",
        "--factor 5.01 --partitioning fractional_even",
        "--tolerance 0.01 --partitioning pow2",
        "--distance 40 --partitioning fractional_odd",
    ] {
        let first = mesh(Path::new(""), options, &teapot);
        let second = mesh(&teapot, "--factor 1 --surface flat", &again);
        let notes = second.stderr.lines().filter_map(|line| line.strip_prefix("tess: note: "));
        let left_out = notes.filter(|note| note.contains("left out"));
        let counts_of_notes = left_out.filter_map(|note| note.split(' ').next());
        let dropped: u64 = counts_of_notes.filter_map(|count| count.parse::<u64>().ok()).sum();
        assert!(dropped > 0, "{options}: a note of the poles: {}", second.stderr);
        let (all, kept) = (counts(&first)[2], counts(&second)[0] + dropped);
        // The neighbours of a face without area are cut at its corners.
        let is_joined = second.stderr.contains("their neighbours meet there");
        assert!(if is_joined { all < kept } else { all == kept }, "{options}: {all}, {kept}");
        let folded = second
            .stderr
            .contains("1 edge of more than two faces: the faces are neighbours in pairs");
        assert_eq!(folded, options == "--factor 1", "{options}: {}", second.stderr);
        if !folded {
            assert_eq!(open_edges(&teapot), open_edges(&again), "{options}: open edges");
        }
    }
}

#[test]
fn empty_patch_files_are_named_by_their_first_line() {
    let folder = directory("mesh_bpt_empty");
    let message = "the file is empty; the number of patches is missing";
    for (name, content) in [("empty.bpt", ""), ("blank.bpt", "\n \n\n"), ("mark.bpt", "\u{feff}")] {
        refused(&write(&folder, name, content), "", &format!("{name}: line 1: {message}"));
    }
    refused(&write(&folder, "x.bpt", "1\n3 3\n0 0 inf\n"), "", "line 3: `0 0 inf` is not a point");
    refused(&write(&folder, "many.bpt", "99999999999\n3 3\n"), "", "line 2: the file ends after");
    let latin = write(&folder, "latin.bpt", b"1 \xE9\n");
    refused(
        &latin,
        "",
        "line 1: the number of patches is 1, and 1 words follow; each patch has 50",
    );
}

/// The header of a grey PNG of this size, and nothing else that is correct.
fn header_of(width: u32, height: u32) -> Vec<u8> {
    let mut bytes = Vec::new();
    let encoder = {
        let mut encoder = png::Encoder::new(&mut bytes, width, height);
        encoder.set_color(png::ColorType::Grayscale);
        encoder
    };
    let mut writer = encoder.write_header().expect("a header is written");
    writer.write_chunk(png::chunk::IDAT, &[0x78, 0x9C]).expect("data begins");
    drop(writer);
    bytes
}

fn displaced(cube: &Path, image: &Path, options: &str) -> Run {
    let out = cube.with_file_name("displaced.obj");
    let (cube, image, out) = (cube.display(), image.display(), out.display());
    tess(&format!("mesh {cube} --factor 1 --displace {image} {options} -o {out}"))
}

#[test]
fn images_are_no_larger_than_the_limit() {
    let folder = directory("mesh_png");
    let cube = write(&folder, "cube.obj", CUBE);
    for (width, height) in [(100_000, 100_000), (8001, 8000), (u32::MAX >> 1, 1)] {
        let image = write(&folder, "huge.png", header_of(width, height));
        let run = displaced(&cube, &image, "");
        let message = format!("{width} x {height} are more than 64000000 pixels");
        let refused = run.code == Some(2) && run.stderr.contains(&message);
        assert!(refused && run.stderr.contains("--max-pixels"), "{:?} {}", run.code, run.stderr);
    }
    let small = folder.join("small.png");
    mesh(&cube, "--factor 1 --size 8x8", &small);
    displaced(&cube, &small, "--max-pixels 63").says("8 x 8 are more than 63 pixels");
    displaced(&cube, &small, "--max-pixels 64").exits(0); // 64 are not
    let whole = fs::read(&small).expect("the image is there");
    let cut = write(&folder, "cut.png", &whole[..whole.len() - 12]);
    displaced(&cube, &cut, "").exits(2); // a file without its end
}

/// Palettes that end within a colour, and palettes with no colours or with more than a byte can
/// number.
#[test]
fn palettes_are_whole_colours() {
    let folder = directory("mesh_png_palette");
    let cube = write(&folder, "cube.obj", CUBE);
    let with_palette = |length: usize| {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, 1, 1);
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_palette(vec![7; length]);
        let mut writer = encoder.write_header().expect("a header is written");
        writer.write_image_data(&[0]).expect("one pixel");
        drop(writer);
        displaced(&cube, &write(&folder, "palette.png", bytes), "")
    };
    for length in [4, 5, 53, 767] {
        let run = with_palette(length);
        let message = format!("the palette has {length} bytes; it must be whole colours");
        let refused = run.code == Some(2) && run.stderr.contains(&message);
        assert!(refused, "{length}: {:?} {}", run.code, run.stderr);
    }
    for length in [1, 2, 769, 771] {
        let run = with_palette(length);
        let refused = run.code == Some(2) && run.stderr.contains("PLTE");
        assert!(refused, "{length}: {:?} {}", run.code, run.stderr);
    }
    for length in [3, 6, 768] {
        with_palette(length).exits(0);
    }
}
