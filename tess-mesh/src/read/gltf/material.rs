//! What a document says about materials: kept as it is, for the glTF that is written.

use super::accessor::Data;
use super::document::Document;
use crate::parts::Materials;
use serde_json::{Map, Value};
use std::collections::BTreeSet;
use tess_surface::Address;

/// The materials of a document, with the contents of images that are in its buffers. An image that
/// cannot be read keeps its reference.
pub(crate) fn materials(data: &Data<'_>) -> Materials {
    let lists = &data.document.materials;
    let mut kept = Map::new();
    for (name, list) in [
        ("materials", &lists.materials),
        ("textures", &lists.textures),
        ("samplers", &lists.samplers),
        ("images", &lists.images),
    ] {
        if !list.is_empty() && !lists.materials.is_empty() {
            kept.insert(name.to_owned(), Value::Array(list.clone()));
        }
    }
    let mut used = BTreeSet::new();
    kept.values().for_each(|list| collect_extensions(list, &mut used));
    let required: Vec<&str> =
        used.iter().map(String::as_str).filter(|name| data.document.requires(name)).collect();
    if !required.is_empty() {
        kept.insert("extensionsRequired".to_owned(), required.into());
    }
    if !used.is_empty() {
        kept.insert("extensionsUsed".to_owned(), used.iter().map(String::as_str).collect());
    }
    let images = lists.images.iter().enumerate().filter_map(|(number, image)| {
        let view = usize::try_from(image["bufferView"].as_u64()?).ok()?;
        Some((number, data.bytes(view, 0).ok()?.to_vec()))
    });
    let images = if kept.contains_key("images") { images.collect() } else { Vec::new() };
    let names = lists.materials.iter().map(|material| material["name"].as_str());
    let names = names.map(|name| name.map(str::to_owned)).collect();
    Materials { names, document: kept, images, ..Materials::default() }
}

/// The names of the extensions in a value.
fn collect_extensions(value: &Value, names: &mut BTreeSet<String>) {
    match value {
        Value::Array(values) => values.iter().for_each(|value| collect_extensions(value, names)),
        Value::Object(members) => {
            if let Some(Value::Object(extensions)) = members.get("extensions") {
                names.extend(extensions.keys().cloned());
            }
            members.values().for_each(|value| collect_extensions(value, names));
        }
        _ => {}
    }
}

/// The continuation of the first texture that one of these materials has, as its sampler says.
pub(crate) fn address(
    document: &Document,
    materials: impl Iterator<Item = usize>,
) -> Option<[Address; 2]> {
    let lists = &document.materials;
    let texture_of = |material: usize| {
        let material = lists.materials.get(material)?;
        let textures = [
            &material["pbrMetallicRoughness"]["baseColorTexture"],
            &material["normalTexture"],
            &material["occlusionTexture"],
            &material["emissiveTexture"],
        ];
        textures.into_iter().find_map(|texture| usize::try_from(texture["index"].as_u64()?).ok())
    };
    let texture = lists.textures.get({ materials }.find_map(texture_of)?)?;
    let sampler = texture["sampler"].as_u64().and_then(|number| usize::try_from(number).ok());
    let sampler = sampler.and_then(|number| lists.samplers.get(number));
    // Without a sampler, and where it says nothing, images repeat.
    let mode = |name: &str| match sampler.and_then(|sampler| sampler[name].as_u64()) {
        Some(33071) => Address::Clamp,
        Some(33648) => Address::Mirror,
        _ => Address::Repeat,
    };
    Some([mode("wrapS"), mode("wrapT")])
}
