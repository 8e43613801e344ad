//! The readers of mesh files, on any bytes: they refuse a file and name the place of the fault, or
//! their result equals that of an independent reader, which is as simple as possible.
//!
//! The fuzz targets use these modules too. `crate::fault_is_planted` is theirs or the test's.

pub(crate) mod bpt;
pub(crate) mod gltf;
pub(crate) mod obj;
pub(crate) mod seeds;

use crate::fault_is_planted;
use tess_mesh::tess_surface::{FaceError, PolygonMesh, Style};
use tess_mesh::{Format, LoadOptions};

/// Checks one file: `names_a_place` judges the message of a refusal, and `independent` reads the
/// file again.
pub(crate) fn check<T>(
    read: Result<T, String>,
    words: impl Fn(&T) -> Vec<u32>,
    names_a_place: impl Fn(&str) -> bool,
    independent: impl FnOnce() -> Option<T>,
) -> Result<(), String> {
    let planted = fault_is_planted();
    let read = match read {
        Ok(read) => read,
        Err(message) if names_a_place(&message) && !planted => return Ok(()),
        Err(message) => return Err(format!("an error that names no place: `{message}`")),
    };
    let again = independent().ok_or("it was read, but there is no independent reading")?;
    let (mut observed, expected) = (words(&read), words(&again));
    if let Some(last) = observed.last_mut().filter(|_| planted) {
        *last ^= 1;
    }
    let counts = (observed.len(), expected.len());
    let differs = observed.iter().zip(&expected).position(|(a, b)| a != b);
    match differs {
        None if counts.0 == counts.1 => Ok(()),
        None => Err(format!("{} words, {} in the independent reading", counts.0, counts.1)),
        Some(at) => Err(format!(
            "word {at} of {} is {:08x}, {:08x} in the independent reading",
            counts.0, observed[at], expected[at]
        )),
    }
}

/// The bits of a float, which are equal if the numbers are: all NaNs are one.
pub(crate) fn bits(number: f32) -> u32 {
    if number.is_nan() { f32::NAN.to_bits() } else { number.to_bits() }
}

/// All contents of a mesh, list after list, each after its length.
fn mesh_words(mesh: &PolygonMesh) -> Vec<u32> {
    let length = |length: usize| u32::try_from(length).unwrap_or(u32::MAX);
    let mut words = vec![length(mesh.positions.len())];
    words.extend(mesh.positions.iter().flat_map(|p| p.to_array()).map(bits));
    words.push(length(mesh.normals.len()));
    words.extend(mesh.normals.iter().flat_map(|n| n.to_array()).map(bits));
    words.push(length(mesh.texcoords.len()));
    words.extend(mesh.texcoords.iter().flat_map(|t| t.to_array()).map(bits));
    for face in &mesh.faces {
        for sides in [Some(face.positions), face.normals, face.texcoords] {
            let indices = sides.as_ref().map_or(&[][..], |sides| sides.as_slice());
            words.push(length(indices.len()));
            words.extend(indices);
        }
    }
    words
}

/// Makes models of a file, as users do; no face may be refused because corners coincide.
fn models(data: &[u8], format: Format) -> Result<(), String> {
    for style in [Style::Flat, Style::PointNormal] {
        let options =
            LoadOptions { style: Some(style), max_memory: 1 << 22, ..LoadOptions::default() };
        if let Err(error) = tess_mesh::read(data, format, None, &options)
            && error.to_string().contains(&FaceError::RepeatedCorner.to_string())
        {
            return Err(format!("{error}, which is repaired"));
        }
    }
    Ok(())
}

/// Whether a message begins with `line N: `, a line of the file.
fn names_a_line(message: &str, data: &[u8]) -> bool {
    let lines = data.split(|&byte| byte == b'\n').count();
    let number = message.strip_prefix("line ").and_then(|rest| rest.split_once(": "));
    let number = number.and_then(|(number, _)| number.parse::<usize>().ok());
    number.is_some_and(|number| (1..=lines).contains(&number))
}

/// The words of a line, as text.
fn words_of(line: &[u8]) -> Vec<String> {
    let words = line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
    words.map(|word| String::from_utf8_lossy(word).into_owned()).collect()
}

fn without_mark(data: &[u8]) -> &[u8] {
    data.strip_prefix("\u{feff}".as_bytes()).unwrap_or(data)
}
