//! OBJ files, and a reader that takes every line as it is.

use super::{mesh_words, models, names_a_line, without_mark, words_of};
use tess_mesh::tess_surface::glam::{Vec2, Vec3};
use tess_mesh::tess_surface::{Face, PolygonMesh, Sides};
use tess_mesh::{Format, raw};

/// Compares one file. Errors: the first difference, or a message that names no line.
pub(crate) fn check(data: &[u8]) -> Result<(), String> {
    let read = raw::obj(data).map_err(|error| error.to_string());
    models(data, Format::Obj)?;
    // The triangles of a polygon are not compared: other tests measure their areas.
    let words = |mesh: &PolygonMesh| match has_polygons(data) {
        true => mesh_words(&PolygonMesh { faces: Vec::new(), ..mesh.clone() }),
        false => mesh_words(mesh),
    };
    super::check(read, words, |message| names_a_line(message, data), || Some(naive(data)))
}

/// Whether a face has more than four corners.
fn has_polygons(data: &[u8]) -> bool {
    lines(data).iter().any(|words| words.len() > 5 && words[0] == "f")
}

/// The words of each line, without comments. A line that ends with a backslash goes on.
fn lines(data: &[u8]) -> Vec<Vec<String>> {
    let mut lines: Vec<Vec<u8>> = Vec::new();
    let mut goes_on = false;
    for line in without_mark(data).split(|&byte| byte == b'\n') {
        match lines.last_mut().filter(|_| goes_on) {
            Some(last) => last.extend(line),
            None => lines.push(line.to_vec()),
        }
        let last = lines.last_mut().expect("it was pushed");
        let has_comment = words_of(last).iter().any(|word| word.starts_with('#'));
        let before = last.trim_ascii_end().strip_suffix(b"\\").map(<[u8]>::to_vec);
        goes_on = before.is_some() && !has_comment;
        if let Some(before) = before.filter(|_| goes_on) {
            *last = [&before[..], b" "].concat();
        }
    }
    let words = lines.iter().map(|line| {
        let mut words = words_of(line);
        // The first word is the keyword, whatever it begins with.
        let comment = words.iter().skip(1).position(|word| word.starts_with('#'));
        words.truncate(comment.map_or(words.len(), |at| at + 1));
        words
    });
    words.collect()
}

/// The numbers of a line: NaN for all if one is wrong or fewer than `least` are there.
fn values(words: &[String], least: usize) -> [f32; 3] {
    let numbers = words.iter().skip(1).take(3).map(|word| word.parse().ok());
    match numbers.collect::<Option<Vec<f32>>>() {
        Some(numbers) if numbers.len() >= least => {
            std::array::from_fn(|k| numbers.get(k).copied().unwrap_or(0.0))
        }
        _ => [f32::NAN; 3],
    }
}

fn naive(data: &[u8]) -> PolygonMesh {
    let mut mesh = PolygonMesh::default();
    for words in lines(data) {
        let number = |k: usize| {
            let number = words.get(k).and_then(|word| word.parse::<f32>().ok());
            number.filter(|number| number.is_finite()).unwrap_or(f32::NAN)
        };
        match words.first().map(String::as_str) {
            Some("v") => mesh.positions.push(Vec3::new(number(1), number(2), number(3))),
            Some("vn") => mesh.normals.push(Vec3::from_array(values(&words, 3))),
            Some("vt") => {
                let [u, v, _] = values(&words, 1);
                mesh.texcoords.push(Vec2::new(u, v));
            }
            Some("f") if (4..=5).contains(&words.len()) => {
                let counts = [&mesh.positions.len(), &mesh.texcoords.len(), &mesh.normals.len()];
                let [positions, texcoords, normals] =
                    [0, 1, 2].map(|place| indices(&words[1..], place, *counts[place]));
                if let Some(positions) = positions {
                    mesh.faces.push(Face { positions, normals, texcoords });
                }
            }
            _ => {}
        }
    }
    mesh
}

/// The indices at one place of every corner, the largest number where there is none; `None` if no
/// corner has one.
fn indices(corners: &[String], place: usize, count: usize) -> Option<Sides<u32>> {
    let part = |corner: &String| corner.split('/').nth(place).unwrap_or_default().to_owned();
    let parts: Vec<String> = corners.iter().map(part).collect();
    if parts.iter().all(String::is_empty) {
        return None;
    }
    let resolve = |part: &String| {
        let number = part.parse::<i64>().ok().filter(|&number| number != 0)?;
        let index = if number < 0 { number + count as i64 } else { number - 1 };
        u32::try_from(index).ok()
    };
    let indices: Vec<u32> = parts.iter().map(|part| resolve(part).unwrap_or(u32::MAX)).collect();
    match indices[..] {
        [a, b, c] => Some(Sides::Triangle([a, b, c])),
        [a, b, c, d] => Some(Sides::Quad([a, b, c, d])),
        _ => None,
    }
}
