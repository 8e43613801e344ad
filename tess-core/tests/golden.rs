//! Recorded results of the reference model, in both formulations: enough of `golden/` to test the
//! core without other crates. `tess-verify` compares all of it.

mod recorded;
#[path = "common/shown.rs"]
mod shown;

use recorded::{RecordedLines, config, digest, factors, hex_words, text};
use shown::shown;
use tess_core::place::place;
use tess_core::prepare::{QuadAxes, Reduction, Request, prepare};
use tess_core::{DomainPoint, FactorContext, FixedFactor, Parity, Patch, Primitive, SplitOrder};

type Elements = (Vec<DomainPoint>, Vec<u32>);

/// Points and indices, in sequence and by number.
fn both_formulations(patch: &Patch) -> [(Elements, &'static str); 2] {
    let whole = patch.tessellate();
    let indices = |primitive: Primitive| primitive.indices().to_vec();
    let by_number = (patch.points().collect(), patch.primitives().flat_map(indices).collect());
    [((whole.points, whole.indices), "in sequence"), (by_number, "by number")]
}

/// The first point or index that differs, with its origin.
fn first_difference(patch: &Patch, observed: &Elements, expected: &Elements) -> Option<String> {
    let point = |i: usize| patch.locate_point(u32::try_from(i).ok()?);
    let size = patch.primitive(0).map_or(1, |primitive| primitive.size() as usize);
    let primitive = |i: usize| patch.locate_primitive(u32::try_from(i / size).ok()?);
    for i in 0..observed.0.len().max(expected.0.len()) {
        let [is, recorded] = [&observed.0, &expected.0].map(|all| all.get(i).copied());
        if is != recorded {
            let [is, recorded] = [is, recorded].map(|point| point.map_or("none".into(), shown));
            return Some(format!("point {i} ({:?}) is {is}, not {recorded}", point(i)));
        }
    }
    for i in 0..observed.1.len().max(expected.1.len()) {
        let [is, recorded] = [&observed.1, &expected.1].map(|all| all.get(i).copied());
        if is != recorded {
            let t = i / size;
            let from = primitive(i);
            return Some(format!(
                "index {i} of primitive {t} ({from:?}) is {is:?}, not {recorded:?}"
            ));
        }
    }
    None
}

#[test]
fn whole_outputs() {
    let text = text("cases.txt");
    let mut lines = RecordedLines::new(&text);
    let mut cases = 0;
    while let Some(case) = lines.next_starting("case ") {
        let fields: Vec<&str> = case.split(' ').collect();
        let patch = Patch::new(config(&fields[1..4]), factors(fields[0], &fields[4..]));
        let points = lines.next_list("points ", 2, 16);
        let points = points.chunks(2).map(|uv| DomainPoint::from_bits(uv[0], uv[1])).collect();
        let indices = lines.next_list("indices ", 1, 10);
        let recorded = (points, indices);
        for (observed, formulation) in both_formulations(&patch) {
            let difference = first_difference(&patch, &observed, &recorded);
            assert_eq!(difference, None, "{case}, {formulation} against the record");
        }
        cases += 1;
    }
    assert_eq!(cases, 51, "cases in the file");
}

/// Compares the digests of a patch's points and indices.
fn check_digests(row: &str, patch: &Patch, recorded: &[&str]) {
    let counts = patch.counts();
    let [points, indices] = [recorded[0], recorded[1]].map(|n| n.parse::<u32>().expect("a number"));
    assert_eq!((counts.points, counts.indices), (points, indices), "{row}: predicted sizes");
    let both = both_formulations(patch);
    let [(in_sequence, _), (by_number, _)] = &both;
    let between = match first_difference(patch, by_number, in_sequence) {
        Some(difference) => format!("by number against in sequence: {difference}"),
        None => {
            "both formulations agree: factors, contexts, places and rows are what they share".into()
        }
    };
    for ((points, indices), formulation) in &both {
        let words = points.iter().flat_map(|point| [point.u.to_bits(), point.v.to_bits()]);
        let digests = [("points", digest(words)), ("indices", digest(indices.iter().copied()))];
        for ((what, digest), recorded) in digests.into_iter().zip(&recorded[2..]) {
            assert_eq!(digest, *recorded, "{row}\n{what} {formulation}; {between}");
        }
    }
}

fn check_patches(file: &str, step: usize) {
    for row in text(file).lines().skip(2).step_by(step) {
        let fields: Vec<&str> = row.split(',').collect();
        let raw: Vec<&str> = fields[4].split(' ').collect();
        let patch = Patch::new(config(&fields[1..4]), factors(fields[0], &raw));
        check_digests(row, &patch, &fields[5..]);
    }
}

#[test]
fn random_patches() {
    check_patches("patches.csv", 4);
}

#[test]
fn corners() {
    check_patches("corners.csv", 1);
}

/// Contexts and locations of every fraction, for some integer parts.
#[test]
fn contexts_and_locations() {
    for row in text("place.csv").lines().skip(2).step_by(11) {
        let fields: Vec<&str> = row.split(',').collect();
        let split = if fields[0] == "ruler" { SplitOrder::Ruler } else { SplitOrder::Centre };
        let parity = if fields[1] == "odd" { Parity::Odd } else { Parity::Even };
        let first = fields[2].parse::<u32>().expect("an integer part") << 16;
        let highest = (64 - parity.odd()) << 16;
        let contexts = (first..=(first | 0xFFFF).min(highest))
            .map(|bits| FactorContext::new(FixedFactor::from_bits(bits), parity, split));
        let numbers = contexts.clone().flat_map(|c| {
            [c.inv_floor, c.inv_ceil, c.fraction, c.half_points, c.split_position, c.points]
        });
        assert_eq!(digest(numbers), fields[3], "contexts of {row}");
        let locations = contexts.flat_map(|c| (0..c.points).map(move |p| place(&c, p).to_bits()));
        assert_eq!(digest(locations), fields[4], "locations of {row}");
    }
}

#[test]
fn factor_preparation() {
    for row in text("hlsl.csv").lines().skip(2) {
        let fields: Vec<&str> = row.split(',').collect();
        let [domain, partitioning, reduction, axis, output] = fields[..5] else {
            panic!("{row}: five settings")
        };
        let config = config(&[partitioning, output, "ruler"]);
        let reduction = match reduction {
            "min" => Reduction::Min,
            "max" => Reduction::Max,
            _ => Reduction::Average,
        };
        let input: Vec<&str> = fields[5].split(' ').collect();
        let axes = if axis == "1" { QuadAxes::One } else { QuadAxes::Two };
        let request = Request::from_record(factors(domain, &input), axes);
        let prepared = prepare(config.partitioning, reduction, request);
        assert_eq!(hex_words(&prepared.unrounded), fields[6], "{row}: unrounded");
        assert_eq!(hex_words(&prepared.rounded), fields[7], "{row}: rounded");
    }
}
