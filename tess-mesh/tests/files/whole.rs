//! Every format holds what was made: written and read again, block by block and part by part. And
//! whichever write fails, the error is told.

use crate::support::{Gltf, Memory, floats_of, numbers_of, obj, obj_with, written};
use serde_json::{Value, json};
use std::io::{self, Write};
use std::sync::atomic::{AtomicUsize, Ordering};
use tess_mesh::tess_surface::glam::{Quat, Vec3};
use tess_mesh::tess_surface::{FactorRule, Style};
use tess_mesh::write::{Block, Glb, GltfOptions, IndexWidth, Obj, Sink, WriteAt};
use tess_mesh::{Job, LoadOptions, Loaded, Totals, largest_factor, teapot};

/// The corners of the triangles of each part: position, normal and texture coordinates.
type Corners = Vec<Vec<Vec<f32>>>;

/// Keeps the corners, as they were made.
#[derive(Default)]
struct Made {
    parts: Corners,
    blocks: usize,
    totals: Totals,
}

impl Sink for Made {
    fn begin(&mut self, parts: &[Totals]) -> io::Result<()> {
        self.parts = vec![Vec::new(); parts.len()];
        self.totals.vertices = parts.iter().map(|part| part.vertices).sum();
        self.totals.indices = parts.iter().map(|part| part.indices).sum();
        Ok(())
    }

    fn block(&mut self, block: &Block<'_>) -> io::Result<()> {
        self.blocks += 1;
        let lengths = block.channels.iter().map(Vec::len);
        assert!(lengths.into_iter().all(|n| n == block.vertices.len()), "a value for each vertex");
        self.parts[block.part].extend(block.indices.iter().map(|&index| {
            let vertex = &block.vertices[index as usize];
            let mut corner = vertex.position.to_array().to_vec();
            corner.extend(vertex.normal.to_array());
            if block.has_texcoords {
                corner.extend(vertex.texcoord.to_array());
            }
            corner
        }));
        Ok(())
    }
}

fn job(loaded: &Loaded, factor: f32) -> Job<'_> {
    Job { parts: Some(&loaded.parts), ..Job::new(&loaded.model, FactorRule::Uniform(factor)) }
}

fn options(loaded: &Loaded, indices: IndexWidth) -> GltfOptions<'_> {
    GltfOptions { up: loaded.up, indices, parts: Some(&loaded.parts), image_prefix: "" }
}

fn made(loaded: &Loaded, factor: f32) -> Made {
    let mut made = Made::default();
    job(loaded, factor).run(&mut made, &mut ()).expect("a sink without faults");
    made
}

/// The same corners from a GLB file, whose views and accessors keep the rules.
fn from_glb(loaded: &Loaded, factor: f32, indices: IndexWidth, totals: Totals) -> Corners {
    let mut glb = Glb::new(Memory::default(), options(loaded, indices));
    job(loaded, factor).run(&mut glb, &mut ()).expect("it is written");
    let (document, bytes) = glb.finish().expect("it is whole").glb();
    assert!(bytes.len() as u64 <= options(loaded, indices).most_bytes(totals), "at most as long");
    let meshes = document["meshes"].as_array().expect("meshes");
    let primitives = meshes.iter().flat_map(|mesh| mesh["primitives"].as_array().expect("a list"));
    primitives.map(|primitive| corners_of(&document, &bytes, primitive)).collect()
}

fn corners_of(document: &Value, bytes: &[u8], primitive: &Value) -> Vec<Vec<f32>> {
    let attributes = &primitive["attributes"];
    let values = |name: &str| floats_of(document, bytes, &attributes[name]);
    let mut vertices = values("POSITION");
    let bound = |k: usize, pick: fn(f32, f32) -> f32| {
        vertices.iter().map(|at| at[k]).reduce(pick).expect("a vertex")
    };
    let positions = &document["accessors"][attributes["POSITION"].as_u64().expect("n") as usize];
    for k in 0..3 {
        let [low, high] = ["min", "max"].map(|name| positions[name][k].as_f64().expect("a number"));
        let expected = vec![bound(k, f32::min), bound(k, f32::max)];
        assert_eq!(vec![low as f32, high as f32], expected, "the bounds of {primitive}");
    }
    let mut add = |name: &str, with: fn(Vec<f32>) -> Vec<f32>| {
        let more = values(name).into_iter().map(with);
        vertices.iter_mut().zip(more).for_each(|(vertex, more)| vertex.extend(more));
    };
    add("NORMAL", |normal| normal);
    if attributes.get("TEXCOORD_0").is_some() {
        add("TEXCOORD_0", |st| st);
    }
    let indices = numbers_of(document, bytes, &primitive["indices"]);
    indices.into_iter().map(|index| vertices[index].clone()).collect()
}

/// The same corners from an OBJ file.
fn from_obj(loaded: &Loaded, factor: f32) -> Vec<Vec<f32>> {
    let mut obj = Obj::new(Vec::new()).with_parts(&loaded.parts, "");
    job(loaded, factor).run(&mut obj, &mut ()).expect("it is written");
    let text = String::from_utf8(obj.finish().expect("whole")).expect("text");
    let values = |start: &str| -> Vec<Vec<f32>> {
        let lines = text.lines().filter_map(|line| line.strip_prefix(start));
        lines.map(|line| line.split(' ').map(|n| n.parse().expect("a number")).collect()).collect()
    };
    let lists = [values("v "), values("vn "), values("vt ")];
    let faces = text.lines().filter_map(|line| line.strip_prefix("f "));
    let corner = |word: &str| {
        let numbers: Vec<&str> = word.split('/').collect();
        let value = |list: usize, at: usize| {
            let number: Option<usize> = numbers[at].parse().ok();
            number.map_or(Vec::new(), |number| lists[list][number - 1].clone())
        };
        let position = value(0, 0)[..3].to_vec();
        [position, value(1, 2), value(2, 1)].concat()
    };
    faces.flat_map(|face| face.split(' ').map(corner).collect::<Vec<_>>()).collect()
}

/// Whether GLB files have the corners that were made.
fn check_glb(loaded: &Loaded, factor: f32, widths: &[IndexWidth]) -> Made {
    let made = made(loaded, factor);
    let mut flipped = made.parts.clone();
    for corner in flipped.iter_mut().flatten().filter(|corner| corner.len() == 8) {
        // glTF has (0, 0) at the upper left of the image.
        corner[7] = 1.0 - corner[7];
    }
    for &width in widths {
        assert!(from_glb(loaded, factor, width, made.totals) == flipped, "{width:?}, {factor}");
    }
    made
}

/// Parts with and without texture coordinates, triangles and quads, in every order; the odd numbers
/// of indices do not fill four bytes.
#[test]
fn parts_and_blocks_are_written_whole() {
    let points =
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 -0\nv 2 0 1\nv 2 1 3\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
    let parts = [
        "g a\nf 1/1 2/2 3/3\nf 2/1 5/2 6/3 3/4\n",
        "g b\nf 1 3 4\n",
        "g c\nf 4/1 3/2 6/3\nf 1/1 4/2 6/4\n",
        "g d\nf 2 5 6 3\nf 1 2 5\nf 4 3 6\n",
    ];
    for turn in 0..4 {
        let mut parts = parts;
        parts.rotate_left(turn);
        let loaded = obj(&format!("s 1\n{points}{}", parts.concat()));
        assert_eq!(loaded.parts.list.len(), 4, "a part for each group");
        for factor in [1.0, 2.0, 5.0] {
            let made = check_glb(&loaded, factor, &[IndexWidth::Auto, IndexWidth::Bits32]);
            assert_eq!(made.blocks, 6, "triangles and quads of each part");
            assert!(from_obj(&loaded, factor) == made.parts.concat(), "OBJ, {factor}");
        }
    }
}

/// More vertices than one block has, and than 16 bits number.
#[test]
fn large_results_are_written_whole() {
    let mut text = String::from("s off\n");
    for k in 0..240 {
        text += &format!("v {k} 0 0\nv {k} 1 0\nv {k} 1 1\nv {k} 0 1\nf -4 -3 -2 -1\n");
    }
    let flat = LoadOptions { style: Some(Style::Flat), ..LoadOptions::default() };
    let loaded = obj_with(&text, &flat).expect("it is read");
    let blocks = check_glb(&loaded, 64.0, &[IndexWidth::Auto]).blocks;
    assert!(blocks > 1, "several blocks");
}

#[test]
fn the_last_vertex_that_a_width_numbers() {
    let loaded = obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let begin = |indices: IndexWidth, vertices: u64| {
        let mut glb = Glb::new(Memory::default(), options(&loaded, indices));
        let begun = glb.begin(&[Totals { vertices, indices: 3 }]).map_err(|e| e.to_string());
        begun.map(|()| glb.finish().expect("an empty file").glb().0)
    };
    let kind = |document: Value| document["accessors"][0]["componentType"].as_u64();
    assert_eq!(begin(IndexWidth::Bits16, 65535).map(kind), Ok(Some(5123)), "the last");
    let message = begin(IndexWidth::Bits16, 65536).expect_err("the next");
    assert!(message.starts_with("more than 65535 vertices"), "{message}");
    assert_eq!(begin(IndexWidth::Auto, 65535).map(kind), Ok(Some(5123)), "narrow");
    assert_eq!(begin(IndexWidth::Auto, 65536).map(kind), Ok(Some(5125)), "wide");
    assert_eq!(begin(IndexWidth::Auto, 0xFFFF_FFFE).map(kind), Ok(Some(5125)), "the last of 32");
    let message = begin(IndexWidth::Auto, 0xFFFF_FFFF).expect_err("one more");
    assert!(message.starts_with("more than 2^32 - 2 vertices"), "{message}");
}

/// Of triangles, too: those on a slanted edge are shared, and each factor that fits is found.
#[test]
fn triangles_share_their_edges() {
    let text =
        "s 1\nv 1 1 1\nv 1 -1 -1\nv -1 1 -1\nv -1 -1 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n";
    let loaded = obj(text);
    for (factor, faces) in [(2.0, 24), (4.0, 96)] {
        let mut glb = Glb::new(Memory::default(), options(&loaded, IndexWidth::Auto));
        job(&loaded, factor).run(&mut glb, &mut ()).expect("it is written");
        let document = glb.finish().expect("whole").glb().0;
        // Euler: V = 2 + E - F, and E = 3/2 F.
        assert_eq!(document["accessors"][1]["count"], json!(2 + faces / 2), "factor {factor}");
    }
    let mixed = obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nf 1 2 3 4\nf 2 5 3\n");
    for factor in (1u8..=64).map(f32::from) {
        let job = job(&mixed, factor);
        let totals = job.totals().expect("few");
        for fits in [
            &(|found: Totals| found.vertices <= totals.vertices) as &dyn Fn(Totals) -> bool,
            &|found: Totals| found.indices <= totals.indices,
        ] {
            assert_eq!(
                largest_factor(&mixed.model, job.partitioning, fits),
                Some(factor),
                "largest"
            );
        }
    }
}

/// Colours stay where they are on quads, tangents keep their side, and differences are seams.
#[test]
fn further_values_on_quads() {
    let corner = |at: &str, color: &str| format!("v {at} {color}\n");
    let square =
        [("0 0 0", "0 0 0.5"), ("1 0 0", "1 0 0.5"), ("1 1 0", "1 1 0.5"), ("0 1 0", "0 1 0.5")];
    let text: String = square.iter().map(|(at, color)| corner(at, color)).collect();
    let loaded = obj(&format!("{text}f 1 2 3 4\n"));
    let (document, bytes) = written(&loaded, 4.0);
    let attributes = &document["meshes"][0]["primitives"][0]["attributes"];
    let values = |name: &str| floats_of(&document, &bytes, &attributes[name]);
    for (at, color) in values("POSITION").iter().zip(values("COLOR_0")) {
        let near = Vec3::from_slice(&color).distance(Vec3::new(at[0], at[1], 0.5)) < 1e-6;
        assert!(near && color.len() == 4, "{color:?} at {at:?}");
    }
    // The same places in other colours.
    let other: String = square.iter().map(|(at, _)| corner(at, "1 1 1")).collect();
    let seam = obj(&format!("{text}{other}v 2 0 0 1 1 1\nv 2 1 0 1 1 1\nf 1 2 3 4\nf 6 9 10 7\n"));
    let (document, _) = written(&seam, 1.0);
    assert_eq!(document["accessors"][1]["count"], json!(8), "a seam of colours");
    let mut gltf = Gltf::triangle();
    let tangents = gltf.floats(&[1., 0., 0., -1.].repeat(3), "VEC4", 3);
    gltf.attribute("TANGENT", tangents);
    let (document, bytes) = written(&gltf.loaded(), 3.0);
    let tangent = &document["meshes"][0]["primitives"][0]["attributes"]["TANGENT"];
    for tangent in floats_of(&document, &bytes, tangent) {
        assert_eq!(tangent, [1.0, 0.0, 0.0, -1.0], "along x, and its side");
    }
}

#[test]
fn what_is_up_in_a_teapot_is_up_in_gltf() {
    let (document, _) = written(&teapot(&LoadOptions::default()).expect("it"), 1.0);
    let numbers = document["nodes"][0]["rotation"].as_array().expect("a rotation").iter();
    let numbers: Vec<f32> = numbers.map(|n| n.as_f64().expect("a number") as f32).collect();
    let up = Quat::from_slice(&numbers) * Vec3::Z;
    assert!(up.distance(Vec3::Y) < 1e-6, "{up}");
}

/// References to images that are not files stay as they are.
#[test]
fn references_that_are_no_files() {
    let mut gltf = Gltf::triangle();
    gltf.primitive()["material"] = json!(0);
    gltf.document["materials"] =
        json!([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]);
    gltf.document["textures"] = json!([{"source": 0}]);
    let images =
        json!([{"uri": "data:image/png;base64,AAAA"}, {"uri": "https://example.com/a.png"}]);
    gltf.document["images"] = images.clone();
    assert_eq!(written(&gltf.loaded(), 1.0).0["images"], images, "as they were");
}

/// A place where one operation fails, counted over all that write to it.
#[derive(Default)]
struct Full {
    done: AtomicUsize,
    failing: usize,
}

impl Full {
    fn step<T>(&self, result: T) -> io::Result<T> {
        match self.done.fetch_add(1, Ordering::Relaxed) == self.failing {
            true => Err(io::Error::other("the disk is full")),
            false => Ok(result),
        }
    }
}

impl WriteAt for &Full {
    fn write_at(&self, _: &[u8], _: u64) -> io::Result<()> {
        self.step(())
    }
}

impl Write for &Full {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.step(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.step(())
    }
}

/// Has every operation fail once, and checks that each error is told. Returns their number.
fn each_error_is_told(write: impl Fn(&Full) -> io::Result<()>) -> usize {
    let all = Full { failing: usize::MAX, ..Full::default() };
    write(&all).expect("nothing fails");
    let operations = all.done.into_inner();
    for failing in 0..operations {
        let told = write(&Full { failing, ..Full::default() });
        let message = told.map_err(|error| error.to_string());
        assert_eq!(message, Err("the disk is full".to_owned()), "operation {failing}");
    }
    operations
}

#[test]
fn write_errors_of_every_format_are_told() {
    let text = "mtllib a.mtl\no a\ng b\nusemtl c\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nvt 0 0\n\
        f 1/1 2/1 3/1\no d\nf 1 3 2\n";
    let loaded = obj(text);
    let lines = each_error_is_told(|full| {
        let mut obj = Obj::new(full).with_parts(&loaded.parts, "");
        job(&loaded, 1.0).run(&mut obj, &mut ())?;
        obj.finish().map(drop)
    });
    assert!(lines > 12, "{lines} operations: each line takes one");
    let pieces = each_error_is_told(|full| {
        let options = options(&loaded, IndexWidth::Auto);
        let uri = "a.bin".to_owned();
        let mut gltf = tess_mesh::write::Gltf::new(full, full, uri, options);
        job(&loaded, 1.0).run(&mut gltf, &mut ())?;
        gltf.finish().map(drop)
    });
    assert!(pieces > 3, "{pieces} operations: of the binary file, and of the JSON");
    // With an image, and vertices in several pieces.
    let mut image = Gltf::triangle();
    image.primitive()["material"] = json!(0);
    image.document["materials"] =
        json!([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]);
    image.document["textures"] = json!([{"source": 0}]);
    let view = image.view(b"no PNG");
    image.document["images"] = json!([{"bufferView": view, "mimeType": "image/png"}]);
    let image = image.loaded();
    let image_pieces = each_error_is_told(|full| {
        let mut glb = Glb::new(full, options(&image, IndexWidth::Auto));
        job(&image, 60.0).run(&mut glb, &mut ())?;
        glb.finish().map(drop)
    });
    // Vertices in two parts, indices, the image, the padding, and the header with the JSON.
    assert_eq!(image_pieces, 6, "operations of a GLB file");
}
