//! Vectors of single stages, for blocks of a circuit: the inputs of a stage, and the model's
//! outputs.

use std::collections::BTreeSet;
use std::io::{self, Write};
use tess_core::place::place;
use tess_core::stitch::Diagonals;
use tess_core::{FactorContext, FixedFactor, Parity, ProcessedPatch, Side, Step, StitchKind};
use tess_verify::Case;
use tess_verify::Named;

/// A stage that may be a block of a circuit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum StageBlock {
    /// Factor processing of a patch (spec section 3).
    Factors,
    /// The context of a processed factor (spec section 4).
    Context,
    /// The location of a point of a factor (spec section 5).
    Place,
    /// The steps of a stitch (spec section 7).
    Stitch,
}

impl Named for StageBlock {
    const WHAT: &'static str = "stage";
    const NAMES: &'static [(&'static str, Self)] = &[
        ("factors", Self::Factors),
        ("context", Self::Context),
        ("place", Self::Place),
        ("stitch", Self::Stitch),
    ];
}

/// The columns of a stage's rows with their widths in bits: first the inputs, then the outputs.
const FACTORS: &str = "domain 2, partitioning 2, raw0 32, raw1 32, raw2 32, raw3 32, raw4 32, raw5 32, \
    outcome 2, fixed0 23, odd0 1, fixed1 23, odd1 1, fixed2 23, odd2 1, fixed3 23, odd3 1, \
    fixed4 23, odd4 1, fixed5 23, odd5 1";
const CONTEXT: &str = "split_order 1, odd 1, fixed 23, inv_floor 17, inv_ceil 17, fraction 16, \
    half_points 6, split 6, points 7";
const PLACE: &str = "split_order 1, odd 1, fixed 23, p 7, location 17";
const STITCH: &str = "split_order 1, kind 2, middle_turned 1, outer_points 7, inner_points 6, step 7, \
    outer 6, inner 6, advances_outer 1, begins_outer 1, last 1";

impl StageBlock {
    const fn layout(self) -> &'static str {
        match self {
            Self::Factors => FACTORS,
            Self::Context => CONTEXT,
            Self::Place => PLACE,
            Self::Stitch => STITCH,
        }
    }

    /// The name and width of each column.
    fn columns(self) -> impl Iterator<Item = (&'static str, usize)> {
        let columns = self.layout().split(", ").filter_map(|column| column.split_once(' '));
        columns.filter_map(|(name, bits)| Some((name, bits.parse().ok()?)))
    }

    /// The meaning of the numbers in the columns.
    pub(super) const fn meaning(self) -> &'static str {
        match self {
            Self::Factors => {
                "domain 0 isoline, 1 tri, 2 quad; partitioning 0 integer, 1 pow2, 2 fractional_odd, \
                 3 fractional_even; raw: binary32; outcome 0 culled, 1 minimum, 2 regular; fixed: 15.16; \
                 0 where there is none"
            }
            Self::Context => "split_order 0 ruler, 1 center; fixed: 15.16",
            Self::Place => "split_order 0 ruler, 1 center; fixed: 15.16; location: 16.16",
            Self::Stitch => {
                "split_order 0 ruler, 1 center; kind 0 transition, 1 ring, 2 centre; middle_turned: a centre whose \
                 middle quad has the other diagonal; outer, inner: entries before the step"
            }
        }
    }
}

/// The distinct rows of a stage in the model for some cases, ascending.
pub(super) fn rows(block: StageBlock, cases: impl Iterator<Item = Case>) -> BTreeSet<Vec<u32>> {
    let mut rows = BTreeSet::new();
    for case in cases {
        match block {
            StageBlock::Factors => {
                rows.insert(factors(&case));
            }
            StageBlock::Context => rows.extend(contexts(&case).map(|(input, c)| {
                let lengths = [c.inv_floor, c.inv_ceil, c.fraction];
                [&input[..], &lengths, &[c.half_points, c.split_position, c.points]].concat()
            })),
            StageBlock::Place => rows.extend(contexts(&case).flat_map(|(input, context)| {
                let row = move |p| [&input[..], &[p, place(&context, p).to_bits()]].concat();
                (0..context.points).map(row)
            })),
            StageBlock::Stitch => stitches(&case, &mut rows),
        }
    }
    rows
}

/// The number of a value in the list of the specification.
pub(super) fn number_of<T: Named>(value: T) -> u32 {
    let found = T::NAMES.iter().zip(0..).find(|((_, named), _)| *named == value);
    found.map_or(0, |(_, number)| number)
}

/// The bits of six factors; those that the domain lacks are 0.
pub(super) fn raw_factors(case: &Case) -> impl Iterator<Item = u32> {
    case.factors.iter().map(f32::to_bits).chain([0; 6]).take(6)
}

fn factors(case: &Case) -> Vec<u32> {
    let patch = case.patch();
    let outcome = match patch.processed() {
        ProcessedPatch::Culled => 0,
        ProcessedPatch::Minimum(_) => 1,
        ProcessedPatch::Regular(_) => 2,
    };
    let mut row = vec![number_of(case.domain()), number_of(case.config.partitioning)];
    row.extend(raw_factors(case));
    row.push(outcome);
    let processed = patch.processed().factors().into_iter().flat_map(|all| all.iter());
    let numbers = processed.flat_map(|one| [one.fixed.to_bits(), one.context.parity.odd()]);
    row.extend(numbers.chain([0; 12]).take(12));
    row
}

/// The split order, parity and processed factor of each factor, with its context.
fn contexts(case: &Case) -> impl Iterator<Item = ([u32; 3], FactorContext)> {
    let patch = case.patch();
    let all: Vec<(FixedFactor, Parity)> = patch
        .processed()
        .factors()
        .into_iter()
        .flat_map(|all| all.iter())
        .map(|one| (one.fixed, one.context.parity))
        .collect();
    let split = case.config.split;
    all.into_iter().map(move |(fixed, parity)| {
        let input = [number_of(split), parity.odd(), fixed.to_bits()];
        (input, FactorContext::new(fixed, parity, split))
    })
}

fn stitches(case: &Case, rows: &mut BTreeSet<Vec<u32>>) {
    let split = case.config.split;
    case.patch().stitches(|stitch| {
        let (kind, middle_turned) = match stitch.kind {
            StitchKind::Transition { .. } => (0, 0),
            StitchKind::Ring { .. } => (1, 0),
            StitchKind::Centre(Diagonals::Forward) => (2, 0),
            StitchKind::Centre(Diagonals::ForwardExceptMiddle) => (2, 1),
            StitchKind::CentreTriangle => return, // the circuit's stitcher is not asked for it
        };
        let mut steps: Vec<Step> = Vec::new();
        stitch.steps(split, |step| steps.push(step));
        let last = steps.len().saturating_sub(1);
        for ((number, step), at) in (0..).zip(&steps).zip(0..) {
            let input = [number_of(split), kind, middle_turned];
            let points = [stitch.outer_points, stitch.inner_points, number];
            let Step { outer, inner, advances, begins } = *step;
            let side = |side: Side| u32::from(side == Side::Outer);
            let ends = u32::from(at == last);
            let output = [outer, inner, side(advances), side(begins), ends];
            rows.insert([&input[..], &points, &output].concat());
        }
    });
}

/// Writes rows as CSV: a comment that explains the numbers, the columns' names, and the numbers in
/// hex. Errors: those of the writer.
pub(super) fn write_csv(
    out: &mut dyn Write,
    block: StageBlock,
    rows: &BTreeSet<Vec<u32>>,
) -> io::Result<()> {
    let names: Vec<&str> = block.columns().map(|(name, _)| name).collect();
    writeln!(
        out,
        "# tess-stage 1 stage={} count={}: {}",
        block.name(),
        rows.len(),
        block.meaning()
    )?;
    writeln!(out, "{}", names.join(","))?;
    rows.iter().try_for_each(|row| {
        let digits = block.columns().zip(row).map(|((_, bits), number)| {
            let digits = bits.div_ceil(4);
            format!("{number:0digits$x}")
        });
        writeln!(out, "{}", digits.collect::<Vec<_>>().join(","))
    })
}

/// Writes rows as an image for `$readmemh`: a comment with the layout from the top bit down, then
/// one word per row. Errors: those of the writer.
pub(super) fn write_memh(
    out: &mut dyn Write,
    block: StageBlock,
    rows: &BTreeSet<Vec<u32>>,
) -> io::Result<()> {
    let bits: usize = block.columns().map(|(_, bits)| bits).sum();
    writeln!(out, "// {} words of {bits} bits: {}", rows.len(), block.layout())?;
    writeln!(out, "// {}", block.meaning())?;
    rows.iter().try_for_each(|row| writeln!(out, "{}", word(block, row)))
}

/// The numbers of a row joined into one number in hex.
fn word(block: StageBlock, row: &[u32]) -> String {
    let columns = block.columns().zip(row);
    let bits: String = columns.map(|((_, bits), number)| format!("{number:0bits$b}")).collect();
    let padded = "0".repeat(bits.len().next_multiple_of(4) - bits.len()) + &bits;
    let digit =
        |four: &[u8]| four.iter().fold(0, |digit, bit| digit << 1 | u32::from(*bit == b'1'));
    padded.as_bytes().chunks(4).filter_map(|four| char::from_digit(digit(four), 16)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use tess_core::{Domain, Partitioning, SplitOrder};
    use tess_verify::generate::{GenLevel, Selection};

    type RowWriter = fn(&mut dyn Write, StageBlock, &BTreeSet<Vec<u32>>) -> io::Result<()>;

    fn all(block: StageBlock) -> BTreeSet<Vec<u32>> {
        rows(block, Selection::level(GenLevel::One, 1).cases().step_by(3))
    }

    /// The split order, parity and factor, then the six numbers. Detail 2.5 is odd and has 4
    /// points.
    #[test]
    fn a_context_number_by_number() {
        let line = "case isoline fractional_odd line ruler 3f800000 40200000";
        let contexts = rows(StageBlock::Context, [line.parse().expect("a case")].into_iter());
        assert!(contexts.contains(&vec![0, 1, 0x28000, 0x10000, 0x5555, 0xc000, 2, 0, 4]));
    }

    /// Every number fits its column, and in each column some number needs the whole width.
    #[test]
    fn widths() {
        for &(name, block) in StageBlock::NAMES {
            let rows = all(block);
            assert!(rows.len() > 100, "{name}: {} rows", rows.len());
            for (at, (column, bits)) in block.columns().enumerate() {
                let most = rows.iter().map(|row| row[at]).max().expect("rows");
                let needed = 32 - most.leading_zeros();
                assert_eq!(needed.max(1) as usize, bits, "{name}.{column}: at most {most}");
            }
        }
    }

    /// A stitch has one step per triangle: the entries advance by one per step, up to the rows'
    /// ends.
    #[test]
    fn steps_walk_both_rows() {
        let rows: Vec<Vec<u32>> = all(StageBlock::Stitch).into_iter().collect();
        for pair in rows.windows(2) {
            let [one, two] = pair else { continue };
            let [outer, inner, advances] = [one[6], one[7], one[8]];
            if one[10] == 1 {
                assert_eq!(two[5], 0, "behind the last step another stitch begins: {two:?}");
                assert_eq!(outer + advances, one[3] - 1, "the outer row's end: {one:?}");
                assert_eq!(inner + 1 - advances, one[4] - 1, "the inner row's end: {one:?}");
            } else {
                assert_eq!(two[5], one[5] + 1, "the next step: {two:?}");
                assert_eq!([two[6], two[7]], [outer + advances, inner + 1 - advances], "{two:?}");
            }
        }
    }

    #[test]
    fn a_row_in_both_forms() {
        let case =
            "case isoline fractional_odd line ruler 3f800000 40200000".parse().expect("a case");
        let rows: BTreeSet<_> = rows(StageBlock::Place, [case].into_iter())
            .into_iter()
            .filter(|row| row[3] == 1)
            .collect();
        let row = vec![0, 1, 0x28000, 1, 0x4000];
        assert!(rows.contains(&row), "point 1 of 2.5: {rows:x?}");
        let text = |write: RowWriter| {
            let mut text = Vec::new();
            write(&mut text, StageBlock::Place, &[row.clone()].into()).expect("vectors grow");
            String::from_utf8(text).expect("ASCII")
        };
        let csv = text(write_csv);
        assert!(csv.ends_with("split_order,odd,fixed,p,location\n0,1,028000,01,04000\n"), "{csv}");
        // 0 | 1 | 23 bits of 028000 | 7 bits of 01 | 17 bits of 04000, in 49 bits.
        let word = 1u64 << 47 | 0x28000 << 24 | 1 << 17 | 0x4000;
        assert!(text(write_memh).ends_with(&format!("\n{word:013x}\n")), "{}", text(write_memh));
    }

    /// The comments of files number the names in the order in which the rows use them.
    #[test]
    fn heads_name_the_numbers() {
        fn numbered<T: Named>() -> String {
            let numbers = T::NAMES.iter().map(|&(name, _)| name).enumerate();
            numbers.map(|(number, name)| format!("{number} {name}")).collect::<Vec<_>>().join(", ")
        }
        let split = format!("split_order {}", numbered::<SplitOrder>());
        let domain = format!("domain {}", numbered::<Domain>());
        let partitioning = format!("partitioning {}", numbered::<Partitioning>());
        for &(name, block) in StageBlock::NAMES {
            for write in [write_csv, write_memh] {
                let mut text = Vec::new();
                write(&mut text, block, &BTreeSet::new()).expect("vectors grow");
                let text = String::from_utf8(text).expect("ASCII");
                let heads = [&split, &domain, &partitioning].map(|head| text.contains(head));
                let is_factors = block == StageBlock::Factors;
                assert_eq!(heads, [!is_factors, is_factors, is_factors], "{name}: {text}");
            }
        }
    }
}
