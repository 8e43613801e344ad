//! OBJ files, and a reader that trusts every line.

use super::{mesh_words, models, names_a_line, without_mark, words_of};
use glam::{Vec2, Vec3};
use tess_program::fuzzing;
use tess_surface::{Face, PolygonMesh, Sides};

/// Compares one file. Errors: the first difference, or a message that names no line.
pub fn check(data: &[u8]) -> Result<(), String> {
    let read = fuzzing::obj(data);
    if let Ok(mesh) = &read {
        models(mesh.clone())?;
    }
    // The triangles of a polygon are not compared: tests of the program measure their areas.
    let words = |mesh: &PolygonMesh| match has_polygons(data) {
        true => mesh_words(&PolygonMesh { faces: Vec::new(), ..mesh.clone() }),
        false => mesh_words(mesh),
    };
    super::check(read, words, |message| names_a_line(message, data), || naive(data))
}

/// Whether a face has more than four corners.
fn has_polygons(data: &[u8]) -> bool {
    lines(data).any(|words| words.len() > 5 && words[0] == "f")
}

/// The words of each line, without comments.
fn lines(data: &[u8]) -> impl Iterator<Item = Vec<String>> {
    without_mark(data).split(|&byte| byte == b'\n').map(|line| {
        let mut words = words_of(line);
        let comment = words.iter().position(|word| word.starts_with('#'));
        words.truncate(comment.unwrap_or(words.len()));
        words
    })
}

fn naive(data: &[u8]) -> Option<PolygonMesh> {
    let mut mesh = PolygonMesh::default();
    for words in lines(data) {
        let number = |k: usize| words.get(k).map_or(Some(0.0), |word| word.parse::<f32>().ok());
        match words.first().map(String::as_str) {
            Some("v") => mesh.positions.push(Vec3::new(number(1)?, number(2)?, number(3)?)),
            Some("vn") => mesh.normals.push(Vec3::new(number(1)?, number(2)?, number(3)?)),
            Some("vt") => mesh.texcoords.push(Vec2::new(number(1)?, number(2)?)),
            Some("f") if words.len() <= 5 => {
                let face = Face {
                    positions: indices(&words[1..], 0, mesh.positions.len())??,
                    texcoords: indices(&words[1..], 1, mesh.texcoords.len())?,
                    normals: indices(&words[1..], 2, mesh.normals.len())?,
                };
                mesh.faces.push(face);
            }
            _ => {}
        }
    }
    Some(mesh)
}

/// The indices at one place of every corner; `Some(None)` where there are none.
fn indices(corners: &[String], place: usize, count: usize) -> Option<Option<Sides<u32>>> {
    let part = |corner: &String| corner.split('/').nth(place).unwrap_or_default().to_owned();
    let parts: Vec<String> = corners.iter().map(part).collect();
    if parts.iter().all(String::is_empty) {
        return Some(None);
    }
    let resolve = |part: &String| match part.parse::<i64>().ok()? {
        number if number < 0 => u32::try_from(number + count as i64).ok(),
        number => u32::try_from(number - 1).ok(),
    };
    let indices: Option<Vec<u32>> = parts.iter().map(resolve).collect();
    match indices?[..] {
        [a, b, c] => Some(Some(Sides::Triangle([a, b, c]))),
        [a, b, c, d] => Some(Some(Sides::Quad([a, b, c, d]))),
        _ => None,
    }
}
