//! One patch as a file: a vector file with one record, or a mesh.

use super::{Header, Kind, Listing, PatchRow, Sizes};
use std::fmt::Write;

impl Listing {
    /// The listing as a vector file of the kind `listings` with one record; `backend` is its
    /// source.
    #[must_use]
    pub fn to_file(&self, backend: &str) -> String {
        format!("{}{self}", header(Kind::Listings, backend).head())
    }

    /// The listing as a vector file of the kind `patches` with one row: its counts and digests.
    #[must_use]
    pub fn to_csv(&self, backend: &str) -> String {
        let row = PatchRow { case: self.case, output: Sizes::of(&self.output) };
        format!("{}{row}\n", header(Kind::Patches, backend).head())
    }

    /// A Wavefront OBJ file of the flat patch: x = u, y = v, z = 0.
    #[must_use]
    pub fn to_obj(&self) -> String {
        let mut text = format!("# {}\n", self.case.command());
        for point in &self.output.points {
            let [u, v] = point.to_f32();
            // Writing to a String does not fail. A 16.16 number is exact with 16 decimals.
            _ = writeln!(text, "v {u} {v} 0");
        }
        let element = ["p", "l", "f"][self.case.primitive_size() - 1];
        for primitive in self.primitives() {
            let number = |&index: &u32| (u64::from(index) + 1).to_string();
            let indices: Vec<_> = primitive.iter().map(number).collect();
            _ = writeln!(text, "{element} {}", indices.join(" "));
        }
        text
    }
}

/// The header of a vector file with one record.
fn header(kind: Kind, backend: &str) -> Header {
    Header { kind, count: Some(1), source: format!("tess-{backend}"), notes: Vec::new() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tess_core::DomainPoint;

    /// Indices in Wavefront files start at 1.
    #[test]
    fn a_patch_as_obj() {
        let line = "case tri integer triangle_cw ruler 3f800000 3f800000 3f800000 3f800000";
        let patch = Listing::of_model(line.parse().expect("a case"));
        let text = patch.to_obj();
        let (comment, rest) = text.split_once('\n').expect("lines");
        assert_eq!(comment, format!("# {}", patch.case.command()));
        assert_eq!(rest, "v 0 1 0\nv 0 0 0\nv 1 0 0\nf 1 2 3\n");
    }

    /// A device's output may have any points and indices.
    #[test]
    fn a_patch_that_is_none_as_obj() {
        let line = "case tri integer triangle_cw ruler 3f800000 3f800000 3f800000 3f800000";
        let mut patch = Listing::of_model(line.parse().expect("a case"));
        patch.output.points = vec![DomainPoint::from_bits(u32::MAX, 0)];
        patch.output.indices = vec![u32::MAX, 0];
        let text = patch.to_obj();
        assert!(text.ends_with("v 65535.996 0 0\nf 4294967296 1\n"), "{text}");
    }
}
