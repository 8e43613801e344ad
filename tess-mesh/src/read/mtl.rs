//! Material libraries of OBJ files (MTL): base colours and their images, as glTF has them.
//!
//! ```text
//! newmtl oak                     {"name": "oak", "pbrMetallicRoughness": {
//! Kd 0.8 0.5 0.2                     "baseColorFactor": [0.8, 0.5, 0.2, 0.9],
//! d 0.9                              "baseColorTexture": {"index": 0}, "metallicFactor": 0},
//! map_Kd -clamp on oak.png       "alphaMode": "BLEND"}
//! Ks 1 1 1                       a note: glTF does not get it
//! ```
//! Only glTF needs the libraries, so no fault in one refuses a file: each is a note.

use crate::budget::Budget;
use crate::parts::Parts;
use crate::read::beside;
use crate::read::text::{TextLines, without_mark, words};
use crate::repair::tally::Tally;
use crate::uri::uri_of;
use serde_json::{Map, Value, json};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Component, Path, PathBuf};

/// A material.
#[derive(Clone, Debug)]
struct Material {
    color: [f64; 3],
    opacity: f64,
    image: Option<Image>,
}

/// An image that colours a material.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Image {
    uri: String,
    is_clamped: bool,
}

impl Default for Material {
    fn default() -> Self {
        Self { color: [1.0; 3], opacity: 1.0, image: None }
    }
}

/// What glTF does not get of the libraries.
#[derive(Debug, Default)]
struct Losses {
    libraries: Tally,
    images: Tally,
    options: Tally,
    lines: Tally,
}

impl Losses {
    fn notes(&self) -> Vec<String> {
        let colors = "glTF gets base colours and their images only";
        let notes = [
            self.libraries.note("material library", "", "not read, so glTF lacks its materials"),
            self.images.note("image", " of a material", "glTF does not get it"),
            self.options.note("option", " of an image", "glTF does not get it"),
            self.lines.note("line", " of material libraries", colors),
        ];
        notes.into_iter().flatten().collect()
    }
}

/// Reads the material libraries of an OBJ file in `folder`, and describes its materials as glTF
/// does. Returns the files that were read.
pub(crate) fn read(parts: &mut Parts, folder: Option<&Path>, budget: &Budget) -> Vec<PathBuf> {
    let mut losses = Losses::default();
    let mut found: BTreeMap<String, Material> = BTreeMap::new();
    let mut files = Vec::new();
    for library in names(&parts.materials.libraries, folder) {
        match open(&library, folder, budget) {
            Ok((path, bytes)) => {
                let mut reader = Reader { library: &library, folder, losses: &mut losses };
                reader.library(&bytes, &mut found);
                files.push(path);
            }
            Err(why) => losses.libraries.add(|| why),
        }
    }
    if !found.is_empty() {
        describe(parts, &found);
    }
    parts.materials.losses = losses.notes();
    files
}

/// The names of the libraries, each once. A line may have one name with blanks or several names.
fn names(lines: &[String], folder: Option<&Path>) -> Vec<String> {
    let (mut names, mut known) = (Vec::new(), BTreeSet::new());
    for line in lines {
        let is_one = beside::path(folder, Path::new(line)).is_ok_and(|path| path.is_file());
        let own: Vec<&str> = if is_one { vec![line] } else { line.split_whitespace().collect() };
        for name in own {
            if known.insert(name) {
                names.push(name.to_owned());
            }
        }
    }
    names
}

/// The path and the contents of a library. Errors: it cannot be read.
fn open(name: &str, folder: Option<&Path>, budget: &Budget) -> Result<(PathBuf, Vec<u8>), String> {
    let relative = PathBuf::from(name.replace('\\', "/"));
    if !beside::is_below(&relative) {
        return Err(format!("`{name}` is not a file in the model's folder or below it"));
    }
    let path = beside::path(folder, &relative)?;
    let length = path.metadata().map_or(0, |found| found.len());
    budget.charge(length, 4, "bytes of a material library")?;
    let bytes = beside::read(&path, folder.unwrap_or(Path::new("")), length)?;
    Ok((path, bytes))
}

/// Reads one library.
struct Reader<'a> {
    library: &'a str,
    folder: Option<&'a Path>,
    losses: &'a mut Losses,
}

impl Reader<'_> {
    /// Adds the materials of a library; a name that is known keeps its material.
    fn library(&mut self, bytes: &[u8], found: &mut BTreeMap<String, Material>) {
        let mut current: Option<(String, Material)> = None;
        for (at, line) in (1..).zip(TextLines(without_mark(bytes))) {
            let mut rest = words(line);
            let Some(keyword) = rest.next() else { continue };
            let after = line.trim_ascii_start().get(keyword.len()..).unwrap_or_default();
            let after = String::from_utf8_lossy(after.trim_ascii()).into_owned();
            if keyword.eq_ignore_ascii_case(b"newmtl") {
                keep(found, current.replace((after, Material::default())));
                continue;
            }
            let Some((_, material)) = &mut current else { continue };
            if !self.line(at, keyword, &after, material) && !keyword.starts_with(b"#") {
                let keyword = String::from_utf8_lossy(keyword);
                self.losses.lines.add(|| format!("`{keyword}`, line {at} of {}", self.library));
            }
        }
        keep(found, current);
    }

    /// Reads a line of a material. Returns false if it is not read.
    fn line(&mut self, at: u64, keyword: &[u8], after: &str, material: &mut Material) -> bool {
        let numbers: Vec<f64> = after.split_whitespace().map_while(number).collect();
        match (&*keyword.to_ascii_lowercase(), &numbers[..]) {
            (b"kd", [r, g, b]) => material.color = [*r, *g, *b],
            // One number is a grey.
            (b"kd", [grey]) => material.color = [*grey; 3],
            (b"d", [opacity]) => material.opacity = *opacity,
            (b"tr", [transparency]) => material.opacity = 1.0 - transparency,
            (b"map_kd", _) => material.image = self.image(at, after),
            _ => return false,
        }
        true
    }

    /// The image of a `map_Kd` line: options, and the name of the file, which may have blanks.
    fn image(&mut self, at: u64, text: &str) -> Option<Image> {
        let mut is_clamped = false;
        let mut rest = text;
        while let Some((option, values)) = rest.strip_prefix('-').and_then(first_word) {
            let (values, after) = arguments(option, values);
            match (option, values) {
                ("clamp", value) => is_clamped = value.trim() == "on",
                _ => {
                    let library = self.library;
                    self.losses.options.add(|| format!("`-{option}`, line {at} of {library}"));
                }
            }
            rest = after;
        }
        match self.uri(rest) {
            Ok(uri) => Some(Image { uri, is_clamped }),
            Err(why) => {
                let library = self.library;
                self.losses.images.add(|| format!("`{rest}`, line {at} of {library}: {why}"));
                None
            }
        }
    }

    /// The reference to an image, from the folder of the model. Errors: glTF cannot refer to it.
    fn uri(&self, name: &str) -> Result<String, &'static str> {
        let name = PathBuf::from(name.replace('\\', "/"));
        let kind = name.extension().map(|kind| kind.to_string_lossy().to_ascii_lowercase());
        if !kind.is_some_and(|kind| ["png", "jpg", "jpeg"].contains(&&*kind)) {
            return Err("images of glTF are PNG or JPEG");
        }
        let library = PathBuf::from(self.library.replace('\\', "/"));
        let path = library.parent().unwrap_or(Path::new("")).join(name);
        let has_drive = path.to_string_lossy().contains(':');
        if path.is_absolute() || has_drive {
            return Err("it is not a relative path");
        }
        if !beside::path(self.folder, &path).is_ok_and(|path| path.is_file()) {
            return Err("there is no such file");
        }
        let parts = path.components().filter_map(|part| match part {
            Component::Normal(name) => Some(uri_of(Path::new(name))),
            Component::ParentDir => Some("..".to_owned()),
            _ => None,
        });
        Ok(parts.collect::<Vec<_>>().join("/"))
    }
}

fn keep(found: &mut BTreeMap<String, Material>, read: Option<(String, Material)>) {
    if let Some((name, material)) = read {
        found.entry(name).or_insert(material);
    }
}

fn number(word: &str) -> Option<f64> {
    word.parse().ok().filter(|number: &f64| number.is_finite())
}

/// The first word of a text, and the rest.
fn first_word(text: &str) -> Option<(&str, &str)> {
    let text = text.trim_start();
    let end = text.find(char::is_whitespace).unwrap_or(text.len());
    (end > 0).then(|| (&text[..end], text[end..].trim_start()))
}

/// The values of an option, and what follows them.
fn arguments<'a>(option: &str, text: &'a str) -> (&'a str, &'a str) {
    let (least, most) = match option {
        "o" | "s" | "t" => (1, 3),
        "mm" => (2, 2),
        _ => (1, 1),
    };
    let mut end = text;
    for count in 0..most {
        let Some((word, rest)) = first_word(end) else { break };
        // Up to three numbers: the name of the file comes after them.
        if count >= least && number(word).is_none() {
            break;
        }
        end = rest;
    }
    (&text[..text.len() - end.len()], end)
}

/// Describes the materials that were found. Faces without texture coordinates have materials of
/// their own, without an image, because glTF demands coordinates for each image.
fn describe(parts: &mut Parts, found: &BTreeMap<String, Material>) {
    let mut bare: BTreeMap<usize, usize> = BTreeMap::new();
    let materials = &mut parts.materials;
    let has_image = |name: &Option<String>| {
        let found = name.as_ref().and_then(|name| found.get(name));
        found.is_some_and(|material| material.image.is_some())
    };
    let named = materials.names.len();
    for part in parts.list.iter_mut().filter(|part| !part.has_texcoords) {
        let Some(own) = part.material.filter(|&own| has_image(&materials.names[own])) else {
            continue;
        };
        part.material = Some(*bare.entry(own).or_insert_with(|| {
            materials.names.push(materials.names[own].clone());
            materials.names.len() - 1
        }));
    }
    let mut images = Images::default();
    let of = |(number, name): (usize, &Option<String>)| {
        let own = name.as_ref().and_then(|name| found.get(name));
        own.map_or_else(
            || name.as_ref().map_or_else(|| json!({}), |name| json!({ "name": name })),
            |own| images.material(name.as_deref(), own, number < named),
        )
    };
    let list: Vec<Value> = materials.names.iter().enumerate().map(of).collect();
    let mut document = images.document();
    document.insert("materials".to_owned(), list.into());
    materials.document = document;
}

/// The images of a document, each once.
#[derive(Default)]
struct Images {
    /// The number of the texture of each.
    numbers: BTreeMap<Image, usize>,
}

impl Images {
    fn material(&mut self, name: Option<&str>, own: &Material, has_image: bool) -> Value {
        let [r, g, b] = own.color.map(|number| number.clamp(0.0, 1.0));
        let opacity = own.opacity.clamp(0.0, 1.0);
        let mut surface = json!({ "baseColorFactor": [r, g, b, opacity], "metallicFactor": 0 });
        if let Some(image) = own.image.as_ref().filter(|_| has_image) {
            let next = self.numbers.len();
            let number = *self.numbers.entry(image.clone()).or_insert(next);
            surface["baseColorTexture"] = json!({ "index": number });
        }
        let mut material = json!({ "name": name, "pbrMetallicRoughness": surface });
        if opacity < 1.0 {
            material["alphaMode"] = "BLEND".into();
        }
        material
    }

    /// The lists that the materials refer to.
    fn document(&self) -> Map<String, Value> {
        let mut images: Vec<&Image> = self.numbers.keys().collect();
        images.sort_by_key(|image| self.numbers[image]);
        let mut document = Map::new();
        if images.is_empty() {
            return document;
        }
        let uris: Vec<Value> = images.iter().map(|image| json!({ "uri": image.uri })).collect();
        let textures = images.iter().enumerate().map(|(number, image)| {
            // Images repeat without a sampler.
            let mut texture = json!({ "source": number });
            if image.is_clamped {
                texture["sampler"] = 0.into();
            }
            texture
        });
        document.insert("textures".to_owned(), textures.collect());
        document.insert("images".to_owned(), uris.into());
        if images.iter().any(|image| image.is_clamped) {
            let clamp = json!([{ "wrapS": 33071, "wrapT": 33071 }]);
            document.insert("samplers".to_owned(), clamp);
        }
        document
    }
}
