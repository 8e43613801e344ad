//! Writing vector files whose results come from the model.

use super::{Header, Kind, Listing, PatchRow, Sizes};
use crate::case::Case;
use std::io::{self, Write};

/// Writes a file of the kind `patches`: a row of counts and digests for each case.
///
/// # Errors
/// Those of the writer.
pub fn write_patches(
    out: &mut dyn Write,
    header: &Header,
    cases: impl Iterator<Item = Case>,
) -> io::Result<()> {
    let header = Header { kind: Kind::Patches, ..header.clone() };
    writeln!(out, "{header}\n{}", Kind::Patches.columns().unwrap_or_default().join(","))?;
    for case in cases {
        let output = Sizes::of(&case.patch().tessellate());
        writeln!(out, "{}", PatchRow { case, output })?;
    }
    Ok(())
}

/// Writes a file of the kind `listings`: every point and primitive of each case.
///
/// # Errors
/// Those of the writer.
pub fn write_listings(
    out: &mut dyn Write,
    header: &Header,
    cases: impl Iterator<Item = Case>,
) -> io::Result<()> {
    let header = Header { kind: Kind::Listings, ..header.clone() };
    writeln!(out, "{header}")?;
    for case in cases {
        write!(out, "{}", Listing::of_model(case))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is written decides the kind, whatever the header says.
    #[test]
    fn files_are_of_the_kind_that_is_written() {
        let line = "case tri integer triangle_cw ruler 3f800000 3f800000 3f800000 3f800000";
        let case: Case = line.parse().expect("a case");
        for kind in [Kind::Patches, Kind::Listings] {
            let header = Header { kind, count: Some(1), source: "test".into(), notes: Vec::new() };
            let [mut rows, mut listings] = [Vec::new(), Vec::new()];
            write_patches(&mut rows, &header, [case].into_iter()).expect("vectors grow");
            write_listings(&mut listings, &header, [case].into_iter()).expect("vectors grow");
            assert!(rows.starts_with(b"# tess-vectors 1 kind=patches count=1 "), "{kind:?}");
            assert!(listings.starts_with(b"# tess-vectors 1 kind=listings count=1 "), "{kind:?}");
        }
    }
}
