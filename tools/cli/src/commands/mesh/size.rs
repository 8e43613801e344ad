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
    bytes: u64,
    why: String,
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
    let limits = limits(output, form);
    let excess = |totals: Totals| {
        let bytes = bytes(form, options, totals);
        let limit = limits.iter().find(|limit| bytes > limit.bytes);
        let numbered = form != ResultForm::Obj && totals.vertices >= u64::from(u32::MAX);
        match limit {
            _ if numbered => Some((bytes, "glTF numbers less than 2^32 vertices".to_owned())),
            limit => limit.map(|limit| (bytes, limit.why.clone())),
        }
    };
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

fn limits(output: &Path, form: ResultForm) -> Vec<Limit> {
    let glb = (form == ResultForm::Glb).then(|| Limit {
        // The JSON has room beside the binary part.
        bytes: u64::from(u32::MAX) - (16 << 20),
        why: "a GLB file has at most 4 GiB".to_owned(),
    });
    let disk = free_bytes(output)
        .map(|bytes| Limit { bytes, why: format!("{bytes} bytes are free on the disk") });
    glb.into_iter().chain(disk).collect()
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
