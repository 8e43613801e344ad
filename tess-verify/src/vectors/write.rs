//! Writes vector files with results from the model.

use super::{Header, Kind, Listing, PatchRow, Sizes};
use crate::case::Case;
use crate::names::Named;
use std::io::{self, Write};

/// Writes a vector file of the header's kind: a row of counts and digests for each case
/// (`patches`), or every point and primitive (`listings`).
///
/// # Errors
/// Those of the writer, and [`io::ErrorKind::InvalidInput`] for any other kind.
pub fn write_cases(
    out: &mut dyn Write,
    header: &Header,
    mut cases: impl Iterator<Item = Case>,
) -> io::Result<()> {
    let is_listings = match header.kind {
        Kind::Patches => false,
        Kind::Listings => true,
        other => {
            let message =
                format!("cases cannot be written as {}; use patches or listings", other.name());
            return Err(io::Error::new(io::ErrorKind::InvalidInput, message));
        }
    };
    out.write_all(header.head().as_bytes())?;
    cases.try_for_each(|case| {
        let listing = Listing::of_model(case);
        if is_listings {
            return write!(out, "{listing}");
        }
        writeln!(out, "{}", PatchRow { case, output: Sizes::of(&listing.output) })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_of_the_kind_of_their_header() {
        let line = "case tri integer triangle_cw ruler 3f800000 3f800000 3f800000 3f800000";
        let case: Case = line.parse().expect("a case");
        let write = |kind| {
            let header = Header { kind, count: Some(1), source: "test".into(), notes: Vec::new() };
            let mut text = Vec::new();
            write_cases(&mut text, &header, [case].into_iter())?;
            Ok::<_, io::Error>(String::from_utf8(text).expect("ASCII"))
        };
        let rows = write(Kind::Patches).expect("vectors grow");
        assert_eq!(rows.lines().count(), 3, "head, columns and row: {rows}");
        let listing = write(Kind::Listings).expect("vectors grow");
        assert!(listing.contains(&format!("\n{line}\npoints 3")), "{listing}");
        assert!(write(Kind::Sweep).is_err(), "rows that are no cases");
    }
}
