//! The size of the result, which is known before anything is written.

use super::output::{Options, ResultForm};
use crate::failure::Failure;
use crate::output::OutputFile;
use std::path::Path;
use tess_mesh::{Job, Totals, largest_factor};
use tess_surface::FactorRule;

/// The bytes of the shortest lines of an OBJ file: of a vertex, and of a triangle.
const SHORTEST_LINES: [u64; 2] = [24, 18];

/// A limit of the result, and its reason.
struct Limit {
    most: Most,
    why: String,
}

/// The most that a result may have.
enum Most {
    Bytes(u64),
    Vertices(u64),
}

/// Refuses a result that its format cannot hold or that does not fit on the disk, and gives the
/// largest factor that would fit.
pub(super) fn refuse_too_large(
    job: &Job<'_>,
    output: &Path,
    form: ResultForm,
    options: &Options<'_>,
) -> Result<(), Failure> {
    if form == ResultForm::Png {
        return Ok(());
    }
    let limits = limits(free_bytes(output), form);
    let excess = |totals| excess(bytes(form, options, totals), totals, &limits);
    let totals = job.totals().map_err(Failure::bad_input)?;
    let Some((bytes, why)) = excess(totals) else { return Ok(()) };
    let fits = |totals| excess(totals).is_none();
    let advice = match job.rule {
        FactorRule::Uniform(_) => match largest_factor(job.model, job.partitioning, fits) {
            Some(factor) => format!("--factor {factor} would fit"),
            None => "no factor would fit; write another format, or a part of the model".to_owned(),
        },
        _ => "choose coarser triangles".to_owned(),
    };
    let (vertices, triangles) = (totals.vertices, totals.indices / 3);
    Err(Failure::bad_input(format!(
        "{}: {triangles} triangles with up to {vertices} vertices take up to {bytes} bytes, but {why}; \
         {advice}",
        output.display()
    )))
}

/// The number of bytes: the largest for glTF, the smallest for OBJ.
fn bytes(form: ResultForm, options: &Options<'_>, totals: Totals) -> u64 {
    match form {
        ResultForm::Obj => {
            let [vertex, triangle] = SHORTEST_LINES;
            // A vertex may be shared by all triangles around it.
            totals.vertices / 6 * vertex + totals.indices / 3 * triangle
        }
        _ => options.gltf.most_bytes(totals),
    }
}

/// The bytes and the reason why no result of this size can be written; `None` if it can.
fn excess(bytes: u64, totals: Totals, limits: &[Limit]) -> Option<(u64, String)> {
    let is_over = |limit: &&Limit| match limit.most {
        Most::Bytes(most) => bytes > most,
        Most::Vertices(most) => totals.vertices > most,
    };
    limits.iter().find(is_over).map(|limit| (bytes, limit.why.clone()))
}

/// The limits of a format, on a disk that has this much room, if it is known.
fn limits(free_bytes: Option<u64>, form: ResultForm) -> Vec<Limit> {
    let numbers = (form != ResultForm::Obj).then(|| Limit {
        // The largest number of 32 bits restarts primitives.
        most: Most::Vertices(u64::from(u32::MAX)),
        why: "glTF numbers less than 2^32 vertices".to_owned(),
    });
    let glb = (form == ResultForm::Glb).then(|| Limit {
        // The JSON has room beside the binary part.
        most: Most::Bytes(u64::from(u32::MAX) - (16 << 20)),
        why: "a GLB file has at most 4 GiB".to_owned(),
    });
    let disk = free_bytes.map(|bytes| Limit {
        most: Most::Bytes(bytes),
        why: format!("{bytes} bytes are free on the disk"),
    });
    numbers.into_iter().chain(glb).chain(disk).collect()
}

/// The bytes that are free where the output will be, if the system tells.
#[cfg(unix)]
fn free_bytes(output: &Path) -> Option<u64> {
    if !OutputFile::would_be_file(output) {
        return None;
    }
    let folder = output.parent().filter(|parent| !parent.as_os_str().is_empty());
    let found = rustix::fs::statvfs(folder.unwrap_or(Path::new("."))).ok()?;
    // A file system without blocks, such as `/proc`, does not count its room.
    let is_counted = found.f_blocks > 0;
    found.f_bavail.checked_mul(found.f_frsize).filter(|_| is_counted)
}

#[cfg(not(unix))]
const fn free_bytes(_: &Path) -> Option<u64> {
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The reason why a result of this many bytes and vertices cannot be written.
    fn refused(form: ResultForm, free: Option<u64>, bytes: u64, vertices: u64) -> Option<String> {
        let totals = Totals { vertices, ..Totals::default() };
        let (at, why) = excess(bytes, totals, &limits(free, form))?;
        assert_eq!(at, bytes, "the size is said");
        Some(why)
    }

    #[test]
    fn a_disk_that_is_full_to_the_last_byte() {
        for form in [ResultForm::Obj, ResultForm::Gltf, ResultForm::Glb] {
            assert_eq!(refused(form, Some(1000), 1000, 10), None, "{form:?} fits");
            let why = refused(form, Some(1000), 1001, 10).expect("one byte too many");
            assert!(why.contains("1000 bytes are free"), "{form:?}: {why}");
            assert_eq!(refused(form, None, 1 << 31, 10), None, "{form:?}: nothing is known");
        }
    }

    #[test]
    fn a_glb_file_ends_before_4_gib() {
        let most = (1 << 32) - 1 - (16 << 20);
        assert_eq!(refused(ResultForm::Glb, None, most, 10), None, "the largest");
        let why = refused(ResultForm::Glb, None, most + 1, 10).expect("one byte too many");
        assert!(why.contains("4 GiB"), "{why}");
        assert_eq!(refused(ResultForm::Gltf, None, most + 1, 10), None, "separate files");
        assert_eq!(refused(ResultForm::Obj, None, most + 1, 10), None, "text");
    }

    #[test]
    fn gltf_numbers_vertices_with_32_bits() {
        let most = (1 << 32) - 1;
        for form in [ResultForm::Gltf, ResultForm::Glb] {
            assert_eq!(refused(form, None, 1, most), None, "{form:?}: the most");
            let why = refused(form, None, 1, most + 1).expect("one vertex too many");
            assert!(why.contains("2^32 vertices"), "{form:?}: {why}");
        }
        assert_eq!(refused(ResultForm::Obj, None, 1, most + 1), None, "text has no limit");
    }
}
