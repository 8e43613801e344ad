//! Material libraries of OBJ files: glTF gets base colours, opacity and their images; a note tells
//! the rest.

use crate::support::{folder, written};
use serde_json::{Value, json};
use std::fs;
use std::path::Path;
use tess_mesh::{Format, LoadOptions, Loaded, read};

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n";

fn loaded(folder: &Path, text: &str) -> Loaded {
    let text = format!("{TRIANGLE}{text}");
    read(text.as_bytes(), Format::Obj, Some(folder), &LoadOptions::default()).expect("it is read")
}

/// The materials of the glTF that an OBJ file with this library becomes.
fn materials(folder: &Path, library: &str, text: &str) -> (Loaded, Value) {
    fs::write(folder.join("m.mtl"), library).expect("written");
    let loaded = loaded(folder, &format!("mtllib m.mtl\n{text}"));
    let document = written(&loaded, 1.0).0;
    (loaded, document)
}

#[test]
fn base_colours_and_images() {
    let folder = folder("base_colours_and_images");
    fs::create_dir_all(folder.join("maps")).expect("a folder");
    for image in ["maps/oak a.PNG", "plain.jpg"] {
        fs::write(folder.join(image), "an image").expect("written");
    }
    let library = "# a library\nnewmtl oak\n Kd 0.8 0.5 0.25 # brown\nKs 1 1 1\nmap_Kd -s 2 2 -clamp on maps\\oak a.PNG\n\
        newmtl glass\nKd 2 -1 0.5\nd 0.25\nnewmtl thin\nTr 0.75\nKd 0.5\n\
        newmtl plain\nmap_Kd plain.jpg\nillum 2\n";
    let faces = "usemtl oak\nf 1/1 2/2 3/3\nusemtl glass\nf 1 2 3\nusemtl thin\nf 2 1 3\nusemtl plain\nf 1/1 3/3 2/2\n\
        usemtl none\nf 3 1 2\n";
    let (loaded, document) = materials(&folder, library, faces);
    let [name, surface] = ["name", "pbrMetallicRoughness"];
    assert_eq!(
        document["materials"],
        json!([
            {name: "oak", surface: {"baseColorFactor": [0.8, 0.5, 0.25, 1.0], "metallicFactor": 0,
                "baseColorTexture": {"index": 0}}},
            {name: "glass",
                surface: {"baseColorFactor": [1.0, 0.0, 0.5, 0.25], "metallicFactor": 0},
                "alphaMode": "BLEND"},
            {name: "thin", surface: {"baseColorFactor": [0.5, 0.5, 0.5, 0.25], "metallicFactor": 0},
                "alphaMode": "BLEND"},
            {name: "plain", surface: {"baseColorFactor": [1.0, 1.0, 1.0, 1.0], "metallicFactor": 0,
                "baseColorTexture": {"index": 1}}},
            {name: "none"},
        ])
    );
    assert_eq!(
        document["images"],
        json!([{"uri": "../in/maps/oak%20a.PNG"}, {"uri": "../in/plain.jpg"}])
    );
    assert_eq!(document["textures"], json!([{"source": 0, "sampler": 0}, {"source": 1}]));
    assert_eq!(document["samplers"], json!([{"wrapS": 33071, "wrapT": 33071}]));
    assert_eq!(loaded.files, [folder.join("m.mtl")], "the file that was read");
    assert_eq!(
        loaded.parts.materials.losses,
        [
            "1 option of an image: glTF does not get it (first: `-s`, line 5 of m.mtl)",
            "2 lines of material libraries: glTF gets base colours and their images only (first: `Ks`, \
             line 4 of m.mtl)",
        ]
    );
}

/// An image needs texture coordinates: faces without them have the colour alone.
#[test]
fn faces_without_texture_coordinates() {
    let folder = folder("faces_without_texture_coordinates");
    fs::write(folder.join("a.png"), "an image").expect("written");
    let faces = "usemtl a\nf 1/1 2/2 3/3\nf 1 2 3\nf 3 2 1\n";
    let (_, document) = materials(&folder, "newmtl a\nKd 1 0 0\nmap_Kd a.png\n", faces);
    let primitives = document["meshes"][0]["primitives"].as_array().expect("a list");
    assert_eq!(primitives.len(), 2, "with and without: {primitives:?}");
    for primitive in primitives {
        let number = primitive["material"].as_u64().expect("a number") as usize;
        let material = &document["materials"][number];
        assert_eq!(material["name"], "a", "its name");
        let has_image = material["pbrMetallicRoughness"].get("baseColorTexture").is_some();
        assert_eq!(has_image, primitive["attributes"].get("TEXCOORD_0").is_some(), "{material}");
    }
}

/// Whatever is wrong with a library or an image, the model is read, and a note says what is lost.
#[test]
fn what_cannot_be_had_is_noted() {
    let folder = folder("what_cannot_be_had_is_noted");
    fs::write(folder.join("a.tga"), "an image").expect("written");
    for (line, why) in [
        ("map_Kd a.tga", "`a.tga`, line 3 of m.mtl: images of glTF are PNG or JPEG"),
        ("map_Kd b.png", "`b.png`, line 3 of m.mtl: there is no such file"),
        ("map_Kd C:\\b.png", "it is not a relative path"),
        ("map_Kd /b.png", "it is not a relative path"),
    ] {
        let library = format!("newmtl a\nKd 1 0 0\n{line}\n");
        let (loaded, document) = materials(&folder, &library, "usemtl a\nf 1/1 2/2 3/3\n");
        let losses = &loaded.parts.materials.losses;
        assert!(losses.len() == 1 && losses[0].contains(why), "{why}: {losses:?}");
        assert_eq!(document.get("images"), None, "{line}");
        let color = &document["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"];
        assert_eq!(*color, json!([1.0, 0.0, 0.0, 1.0]), "{line}: the colour stays");
    }
    fs::create_dir_all(folder.join("d.mtl")).expect("a folder");
    for (library, why) in [
        ("mtllib none.mtl", "cannot read "),
        ("mtllib ../m.mtl", "`../m.mtl` is not a file in the model's folder or below it"),
        ("mtllib d.mtl", " is not an ordinary file"),
    ] {
        let loaded = loaded(&folder, &format!("{library}\nusemtl a\nf 1 2 3\n"));
        let losses = &loaded.parts.materials.losses;
        assert!(losses.len() == 1 && losses[0].contains(why), "{why}: {losses:?}");
        let named = json!([{"name": "a"}]);
        assert_eq!(written(&loaded, 1.0).0["materials"], named, "{library}: by name");
    }
}

/// A line may name one library with blanks or several; the first material of a name counts.
#[test]
fn names_of_libraries() {
    let folder = folder("names_of_libraries");
    for (name, color) in [("a b.mtl", "1 0 0"), ("c.mtl", "0 1 0"), ("d.mtl", "0 0 1")] {
        let text = format!("newmtl x\nKd {color}\nnewmtl x\nKd 1 1 1\n");
        fs::write(folder.join(name), text).expect("written");
    }
    for (line, color) in [
        ("mtllib a b.mtl", [1.0, 0.0, 0.0, 1.0]),
        ("mtllib c.mtl d.mtl", [0.0, 1.0, 0.0, 1.0]),
        ("mtllib d.mtl\nmtllib c.mtl", [0.0, 0.0, 1.0, 1.0]),
    ] {
        let loaded = loaded(&folder, &format!("{line}\nusemtl x\nf 1 2 3\n"));
        let document = written(&loaded, 1.0).0;
        let found = &document["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"];
        assert_eq!(*found, json!(color), "{line}");
    }
}
