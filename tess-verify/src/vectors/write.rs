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
        write!(out, "{}", Listing { line: 0, case, output: case.patch().tessellate() })?;
    }
    Ok(())
}
