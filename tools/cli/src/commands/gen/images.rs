//! Memory images for Verilog's `$readmemh`.
//!
//! Each is a text with one hex word per line, after a comment that describes the layout of the
//! word.

use super::stages::{number_of, raw_factors};
use std::io::{self, Write};
use tess_core::Config;
use tess_verify::Case;

/// The names of the four images, and of the file that has their sizes as macros.
pub(super) const FILES: [&str; 5] =
    ["cases.memh", "factors.memh", "points.memh", "primitives.memh", "sizes.svh"];

/// The comment lines at the top of each image: the fields of a word from the top bit down.
const LAYOUTS: [&str; 4] = [
    "144 bits: domain 4 (0 isoline, 1 tri, 2 quad), partitioning 4 (0 integer, 1 pow2, \
     2 fractional_odd, 3 fractional_even), output 4 (0 point, 1 line, 2 triangle_cw, \
     3 triangle_ccw), split 4 (0 ruler, 1 center), first point 32, points 32, first primitive 32, \
     primitives 32",
    "192 bits: six binary32 factors in the order of the specification, factor 0 in the top 32 bits \
     (the port patch_factors of rtl/tess_top.sv has it in the lowest), zero where there is none",
    "34 bits: u 17, v 17",
    "48 bits: three indices of 16, the first on top, ffff where there is none \
     (the ports of rtl/tess_top.sv give 0 there)",
];

/// The number of words in each image.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct ImageWords {
    /// The words of `cases.memh`, which are also those of `factors.memh`.
    pub(super) cases: u64,
    /// The words of `points.memh`.
    pub(super) points: u64,
    /// The words of `primitives.memh`.
    pub(super) primitives: u64,
}

/// Writes the five files, in the order of [`FILES`], with results from the model. Errors: those of
/// the writers; [`io::ErrorKind::InvalidInput`] if the number of a point or primitive does not fit
/// in 32 bits.
pub(super) fn write_images(
    files: &mut [&mut dyn Write; 5],
    cases: impl Iterator<Item = Case>,
) -> io::Result<ImageWords> {
    let mut words = ImageWords::default();
    for (file, layout) in files.iter_mut().zip(LAYOUTS) {
        writeln!(file, "// {layout}")?;
    }
    for case in cases {
        write_case(files, &mut words, &case)?;
    }
    let [.., sizes] = files;
    writeln!(sizes, "`define TESS_CASES {}", words.cases)?;
    writeln!(sizes, "`define TESS_POINTS {}", words.points)?;
    writeln!(sizes, "`define TESS_PRIMITIVES {}", words.primitives)?;
    Ok(words)
}

/// Writes the words of one case after the first `words` words.
fn write_case(
    files: &mut [&mut dyn Write; 5],
    words: &mut ImageWords,
    case: &Case,
) -> io::Result<()> {
    let [case_file, factor_file, point_file, primitive_file, _] = files;
    let output = case.patch().tessellate();
    let size = case.primitive_size();
    let [points, primitives] = [output.points.len(), output.indices.len() / size];
    let [first_point, first_primitive] = [number(words.points)?, number(words.primitives)?];
    let configuration = configuration(case);
    writeln!(
        case_file,
        "{configuration}{first_point:08x}{points:08x}{first_primitive:08x}{primitives:08x}"
    )?;
    writeln!(factor_file, "{}", factors(case))?;
    for point in &output.points {
        let word = (u64::from(point.u.to_bits()) << 17) | u64::from(point.v.to_bits());
        writeln!(point_file, "{word:09x}")?;
    }
    for primitive in output.indices.chunks(size) {
        writeln!(primitive_file, "{}", indices(primitive))?;
    }
    words.cases += 1;
    words.points += points as u64;
    words.primitives += primitives as u64;
    Ok(())
}

/// The number of a case's first element, as a field of 32 bits.
fn number(first: u64) -> io::Result<u32> {
    u32::try_from(first).map_err(|_| {
        io::Error::new(
            io::ErrorKind::InvalidInput,
            format!(
                "element {first} of an image does not fit in 32 bits; write fewer cases, or shards"
            ),
        )
    })
}

/// The four digits of a case's configuration: its positions in the lists of the specification.
fn configuration(case: &Case) -> String {
    let Config { partitioning, output, split } = case.config;
    let [domain, partitioning] = [number_of(case.domain()), number_of(partitioning)];
    format!("{domain:x}{partitioning:x}{:x}{:x}", number_of(output), number_of(split))
}

fn factors(case: &Case) -> String {
    raw_factors(case).map(|bits| format!("{bits:08x}")).collect()
}

fn indices(primitive: &[u32]) -> String {
    let index = |i: usize| primitive.get(i).copied().unwrap_or(0xFFFF);
    [0, 1, 2].map(|i| format!("{:04x}", index(i))).concat()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_triangle_word_by_word() {
        let line = "case tri integer triangle_ccw center 3f800000 3f800000 3f800000 7fc00000";
        let case: Case = line.parse().expect("a case");
        let mut texts = [const { Vec::new() }; 5];
        let [a, b, c, d, e] = &mut texts;
        let words = write_images(&mut [a, b, c, d, e], [case, case].into_iter());
        let expected = ImageWords { cases: 2, points: 6, primitives: 2 };
        assert_eq!(words.expect("vectors grow"), expected, "two minimum patches");
        let texts = texts.map(|text| String::from_utf8(text).expect("ASCII"));
        let lines = |i: usize| texts[i].lines().skip(1).map(str::to_owned).collect::<Vec<_>>();
        assert_eq!(
            lines(0),
            ["103100000000000000030000000000000001", "103100000003000000030000000100000001"],
            "cases"
        );
        assert_eq!(lines(1)[1], "3f8000003f8000003f8000007fc000000000000000000000", "factors");
        assert_eq!(lines(2)[..3], ["000010000", "000000000", "200000000"], "points");
        assert_eq!(lines(3), ["000000020001", "000000020001"], "primitives");
        assert!(texts[4].contains("`define TESS_POINTS 6\n"), "sizes: {}", texts[4]);
    }

    /// Fields of `cases.memh` have 32 bits; a longer number would shift its neighbours.
    #[test]
    fn images_end_at_32_bits() {
        let line = "case tri integer triangle_ccw center 3f800000 3f800000 3f800000 7fc00000";
        let case: Case = line.parse().expect("a case");
        let write = |points: u64, primitives: u64| {
            let mut words = ImageWords { cases: 0, points, primitives };
            let mut texts = [const { Vec::new() }; 5];
            let [a, b, c, d, e] = &mut texts;
            let written = write_case(&mut [a, b, c, d, e], &mut words, &case);
            written.map(|()| String::from_utf8(texts[0].clone()).expect("ASCII"))
        };
        let last = u64::from(u32::MAX);
        let text = write(last, last).expect("the last numbers");
        assert_eq!(text, "1031ffffffff00000003ffffffff00000001\n", "36 digits");
        for (points, primitives) in [(last + 1, 0), (0, last + 1)] {
            let error = write(points, primitives).expect_err("no such number").to_string();
            assert!(error.starts_with("element 4294967296 of an image"), "{error}");
        }
    }
}
