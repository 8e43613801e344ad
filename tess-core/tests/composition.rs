//! The composition of a patch from its parts, which `docs/proof.md` needs.
//!
//! The parts are functions of few numbers, and are compared for all of them elsewhere. Here they
//! are joined a second time, by functions whose arguments are everything that the output may depend
//! on: factors from their own bits, role and settings; stitches from point counts; points from
//! locations. Patches are compared with these for each class that the joining distinguishes. Slow
//! tests do it for all classes: `cargo xtask test all` runs them, and so does `cargo xtask prove`.

#![expect(clippy::print_stdout, reason = "the number of classes, for a reader of the proof")]

use tess_core::fixed_point::{HALF, ONE, ONE_THIRD, TWO_THIRDS};
use tess_core::place::place;
use tess_core::row::Row;
use tess_core::stitch::Diagonals;
use tess_core::{
    Config, Domain, DomainPoint, FactorContext, FixedFactor, OutputPrimitive, Parity, Partitioning,
    Patch, PatchFactors, ProcessedPatch, SplitOrder, Stitch, StitchKind,
};

const TRIANGLES: OutputPrimitive = OutputPrimitive::TriangleCw;

fn config(partitioning: Partitioning, split: SplitOrder) -> Config {
    Config { partitioning, output: TRIANGLES, split }
}

// Factors

/// The role of a factor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Role {
    Edge,
    Inside,
}

/// Spec section 3, steps 2 to 7, for one factor that nothing else influences, except that a factor
/// of its patch may ask for a picture frame.
fn alone(
    role: Role,
    partitioning: Partitioning,
    split: SplitOrder,
    framed: bool,
    bits: u32,
) -> (FixedFactor, FactorContext) {
    let (low, high) = partitioning.range();
    let low = if framed && role == Role::Inside { 0x3F80_0080 } else { low.to_bits() };
    let is_number = bits <= f32::INFINITY.to_bits();
    let clamped = if is_number { bits.clamp(low, high.to_bits()) } else { low };
    let clamped = f32::from_bits(clamped);
    let rounded = if partitioning.has_integer_factors() { clamped.ceil() } else { clamped };
    let fixed = FixedFactor::from_f32(rounded);
    let is_odd = match partitioning {
        Partitioning::FractionalOdd => true,
        Partitioning::FractionalEven => false,
        _ => (fixed.to_bits() >> 16) % 2 == 1 && (role == Role::Edge || rounded > 1.0),
    };
    let parity = if is_odd { Parity::Odd } else { Parity::Even };
    (fixed, FactorContext::new(fixed, parity, split))
}

/// Factors on both sides of every comparison that a patch's factors go through.
const FACTORS: [u32; 19] = [
    0x0000_0001, // culls nothing
    0x3F00_0000, // 0.5
    0x3F7F_FFFF, // below 1
    0x3F80_0000, // 1
    0x3F80_0040, // 1 + 2^-17: no picture frame
    0x3F80_0041, // a picture frame
    0x3F80_0080, // 1 + 2^-16
    0x3FFF_FFFF, // below 2
    0x4000_0000, // 2
    0x4000_0001, // above 2
    0x4040_0000, // 3
    0x4090_0000, // 4.5
    0x427C_0000, // 63
    0x427C_0001, // above 63
    0x4280_0000, // 64
    0x4280_0001, // above 64
    0x7F7F_FFFF, // the largest number
    0x7F80_0000, // infinity
    0x7FC0_0000, // NaN, which culls as an outer factor
];

/// Factors that cull a patch, if outer: all that are not greater than zero.
fn culls(bits: u32) -> bool {
    bits == 0 || bits > f32::INFINITY.to_bits()
}

/// Compares a patch's processed factors with those of each factor alone.
fn check_factors(config: Config, raw: PatchFactors) {
    let processed = *Patch::new(config, raw).processed();
    if raw.outer().any(|factor| culls(factor.to_bits())) {
        assert_eq!(processed, ProcessedPatch::Culled, "{config:?}, {raw:?}");
        return;
    }
    let framed = config.partitioning == Partitioning::FractionalOdd
        && raw.iter().any(|factor| (0x3F80_0041..=0x7F80_0000).contains(&factor.to_bits()));
    let is_isoline = raw.domain() == Domain::Isoline;
    let factors = processed.factors().expect("not culled");
    let mut ones = !is_isoline;
    for (number, (raw, processed)) in raw.iter().zip(factors.iter()).enumerate() {
        let is_inside = number >= factors.domain().outer_factors();
        let role = if is_inside { Role::Inside } else { Role::Edge };
        let is_density = is_isoline && number == 0;
        let own = if is_density { Partitioning::Integer } else { config.partitioning };
        let (fixed, context) = alone(role, own, config.split, framed, raw.to_bits());
        let found = (processed.fixed, processed.context);
        assert_eq!(found, (fixed, context), "{config:?}, factor {number} of {raw:?}");
        ones &= fixed == FixedFactor::ONE;
    }
    let is_minimum = matches!(processed, ProcessedPatch::Minimum(_));
    assert_eq!(is_minimum, ones, "{config:?}, {raw:?}: a minimum patch has all factors 1");
}

/// Each pair of these factors, in each two positions of each domain, under every setting. The other
/// positions have factor 3 or 1.
fn check_all_factors(pairs: impl Iterator<Item = [u32; 2]> + Clone) -> u64 {
    let mut patches = 0;
    for domain in Domain::ALL {
        let places = (0..domain.factors()).flat_map(|a| (0..domain.factors()).map(move |b| [a, b]));
        for ([a, b], pair) in
            places.flat_map(|places| pairs.clone().map(move |pair| (places, pair)))
        {
            for rest in [1.0, 3.0] {
                let factors = PatchFactors::from_fn(domain, |place| match place {
                    place if place == a => f32::from_bits(pair[0]),
                    place if place == b => f32::from_bits(pair[1]),
                    _ => rest,
                });
                for (partitioning, split) in settings() {
                    check_factors(config(partitioning, split), factors);
                    patches += 1;
                }
            }
        }
    }
    patches
}

fn settings() -> impl Iterator<Item = (Partitioning, SplitOrder)> {
    let splits = |partitioning| SplitOrder::ALL.map(|split| (partitioning, split));
    Partitioning::ALL.into_iter().flat_map(splits)
}

fn pairs_of(step: usize) -> impl Iterator<Item = [u32; 2]> + Clone {
    FACTORS.into_iter().flat_map(|a| FACTORS.map(|b| [a, b])).step_by(step)
}

#[test]
fn factors_are_processed_alone() {
    check_all_factors(pairs_of(5));
}

#[test]
#[ignore = "slow: all pairs of factors"]
fn factors_are_processed_alone_in_every_class() {
    let patches = check_all_factors(pairs_of(1));
    println!(
        "classes: {patches} patches, each two factors of {} in each two places",
        FACTORS.len()
    );
}

// Stitches

/// Point counts of the factors of a triangle or quad, outer first.
type Counts = [u32; 6];

/// The counts that a patch's stitches are made of: the outer edges', and for each edge those of the
/// inside factor along it and of the one across it.
struct Edges {
    outer: Vec<u32>,
    along: Vec<u32>,
    across: Vec<u32>,
}

impl Edges {
    fn of(domain: Domain, counts: Counts) -> Self {
        let [a, b, c, d, u, v] = counts;
        match domain {
            Domain::Quad => {
                Self { outer: vec![a, b, c, d], along: vec![v, u, v, u], across: vec![u, v, u, v] }
            }
            _ => Self { outer: vec![a, b, c], along: vec![d; 3], across: vec![d; 3] },
        }
    }
}

/// All stitches of a patch from its point counts (spec sections 7.1 and 7.4), each at a place that
/// is the sum of the counts before it.
fn stitches(domain: Domain, counts: Counts) -> Vec<Stitch> {
    let Edges { outer, along, across } = Edges::of(domain, counts);
    let rings = along.iter().min().expect("edges").div_ceil(2);
    let last = outer.len() - 1;
    let mut all = Vec::new();
    let (mut at_outer, mut at_inner) = (0, outer.iter().map(|points| points - 1).sum());
    for ring in 1..rings {
        let first = (at_outer, at_inner);
        for (edge, number) in (0..=last).zip(0..) {
            let inner_points = along[edge] - 2 * ring;
            let outer_points = if ring == 1 { outer[edge] } else { inner_points + 2 };
            // The ring is a row of points along this edge, and the edge walks it back.
            let is_row = across[edge] % 2 == 1 && ring == across[edge] / 2;
            let back = domain == Domain::Quad && edge >= 2 && is_row;
            let mut outer_row = Row::ascending(at_outer);
            let mut inner = if back { Row::descending(at_inner) } else { Row::ascending(at_inner) };
            if edge == last {
                outer_row = outer_row.with(outer_points - 1, first.0);
                if !back {
                    inner = inner.with(inner_points - 1, first.1);
                }
            }
            let kind = match ring {
                1 => StitchKind::Transition { edge: number },
                _ => StitchKind::Ring { ring, edge: number },
            };
            all.push(Stitch { kind, outer: outer_row, outer_points, inner, inner_points });
            at_outer += outer_points - 1;
            at_inner += inner_points - 1;
        }
    }
    all.extend(centre(domain, counts, at_outer));
    all
}

/// The centre of an odd interior, whose innermost ring begins at `first`.
fn centre(domain: Domain, [_, _, _, d, u, v]: Counts, first: u32) -> Option<Stitch> {
    let kind = |diagonals| StitchKind::Centre(diagonals);
    let (kind, outer, inner, points) = match domain {
        Domain::Triangle if d.is_multiple_of(2) => {
            let (outer, inner) = (Row::ascending(first), Row::ascending(first + 2));
            let kind = StitchKind::CentreTriangle;
            return Some(Stitch { kind, outer, outer_points: 2, inner, inner_points: 1 });
        }
        Domain::Quad if u > v && v.is_multiple_of(2) => {
            // Row B closes the ring: it begins at the ring's first point.
            let points = u - v + 2;
            let inner = Row::descending(first + 2 * points).with(0, first);
            (kind(Diagonals::Forward), Row::ascending(first + 1), inner, points)
        }
        Domain::Quad if u <= v && u.is_multiple_of(2) => {
            let points = v - u + 2;
            let is_even = !v.is_multiple_of(2);
            let diagonals =
                if is_even { Diagonals::Forward } else { Diagonals::ForwardExceptMiddle };
            let inner = Row::descending(first + 2 * points - 1);
            (kind(diagonals), Row::ascending(first), inner, points)
        }
        _ => return None,
    };
    Some(Stitch { kind, outer, outer_points: points, inner, inner_points: points })
}

/// The integer factor whose context has this many points; 2 to 65.
fn factor_of(points: u32) -> f32 {
    f32::from(u16::try_from(points - 1).expect("at most 64"))
}

fn check_stitches(domain: Domain, counts: Counts) {
    let factors = PatchFactors::from_fn(domain, |number| factor_of(counts[number]));
    let patch = Patch::new(config(Partitioning::Integer, SplitOrder::Ruler), factors);
    let mut expected = stitches(domain, counts).into_iter();
    patch.stitches(|stitch| {
        assert_eq!(Some(stitch), expected.next(), "{domain:?}, {counts:?}");
    });
    assert_eq!(expected.next(), None, "{domain:?}, {counts:?}: a stitch is missing");
}

/// Every pair of inside counts, and on each edge in turn each of these outer counts.
fn check_all_stitches(outer: &[u32]) -> u64 {
    let mut patches = 0;
    let mut check = |domain, counts| {
        check_stitches(domain, counts);
        patches += 1;
    };
    for (&points, edge) in outer.iter().flat_map(|points| (0..4).map(move |edge| (points, edge))) {
        let around = |inside: [u32; 2]| {
            let mut counts = [4, 3, 6, 9, inside[0], inside[1]];
            counts[edge] = points;
            counts
        };
        for u in 3..=65 {
            (3..=65).for_each(|v| check(Domain::Quad, around([u, v])));
            if edge < 3 {
                let [a, b, c, ..] = around([u, u]);
                check(Domain::Triangle, [a, b, c, u, u, u]);
            }
        }
    }
    patches
}

#[test]
fn stitches_are_made_of_counts() {
    check_all_stitches(&[2, 3, 4, 33, 64, 65]);
}

#[test]
#[ignore = "slow: all counts of each edge"]
fn stitches_are_made_of_counts_in_every_class() {
    let every: Vec<u32> = (2..=65).collect();
    let patches = check_all_stitches(&every);
    println!("classes: {patches} patches, each interior with each outer count on each edge");
}

/// A wrong count on any edge is seen.
#[test]
fn a_count_that_differs_is_seen_to_fail() {
    for (domain, factors) in [(Domain::Triangle, 4), (Domain::Quad, 6)] {
        let counts = [4, 5, 6, 7, 8, 9];
        let right = stitches(domain, counts);
        for changed in 0..factors {
            let mut other = counts;
            other[changed] += 1;
            assert_ne!(stitches(domain, other), right, "{domain:?}, count {changed}");
        }
    }
}

// Points

/// The locations along each factor.
type Locations = [Vec<u32>; 6];

/// All points of a triangle or quad from the locations along its factors (spec section 6), whose
/// numbers are the point counts.
fn points(domain: Domain, along: &Locations) -> Vec<DomainPoint> {
    let mut all = Vec::new();
    for (edge, at) in along.iter().take(domain.outer_factors()).enumerate() {
        let count = at.len() - 1;
        all.extend((0..count).map(|p| outer_point(domain, edge, at[p], at[count - p])));
    }
    match domain {
        Domain::Quad => quad_interior(&along[4], &along[5], &mut all),
        _ => triangle_interior(&along[3], &mut all),
    }
    all
}

/// A point on an outer edge from its location, and from that of the point that mirrors it.
fn outer_point(domain: Domain, edge: usize, here: u32, mirrored: u32) -> DomainPoint {
    let (u, v) = match (domain, edge) {
        (_, 0) => (0, mirrored),
        (_, 1) => (here, 0),
        (Domain::Quad, 2) => (ONE, here),
        (Domain::Quad, _) => (mirrored, ONE),
        _ => (mirrored, ONE - mirrored),
    };
    DomainPoint::from_bits(u, v)
}

/// Rings of pairs of locations: a walk round the rectangle of the ring, until it is a row.
fn quad_interior(u: &[u32], v: &[u32], all: &mut Vec<DomainPoint>) {
    let (last_u, last_v) = (u.len() - 1, v.len() - 1);
    for ring in 1..=u.len().min(v.len()) / 2 {
        let (high_u, high_v) = (last_u - ring, last_v - ring);
        let mut to = |i: usize, j: usize| all.push(DomainPoint::from_bits(u[i], v[j]));
        if high_u > ring && high_v > ring {
            (ring + 1..=high_v).rev().for_each(|j| to(ring, j));
            (ring..high_u).for_each(|i| to(i, ring));
            (ring..high_v).for_each(|j| to(high_u, j));
            (ring + 1..=high_u).rev().for_each(|i| to(i, high_v));
        } else if high_v == ring && last_u > last_v {
            (ring..=high_u).for_each(|i| to(i, ring));
        } else if high_u == ring {
            (ring..=high_v).rev().for_each(|j| to(ring, j));
        }
    }
}

/// Rings whose distance from the edges is two thirds of their location.
fn triangle_interior(at: &[u32], all: &mut Vec<DomainPoint>) {
    let last = at.len() - 1;
    for ring in 1..at.len() / 2 {
        let distance = (at[ring] * TWO_THIRDS + HALF) >> 16;
        let moved = |p: usize| at[p] - distance.div_ceil(2);
        let high = last - ring;
        let to = |(u, v)| DomainPoint::from_bits(u, v);
        all.extend((ring + 1..=high).rev().map(|p| to((distance, moved(p)))));
        all.extend((ring..high).map(|p| to((moved(p), distance))));
        all.extend((ring + 1..=high).rev().map(|p| to((moved(p), ONE - moved(p) - distance))));
    }
    if !at.len().is_multiple_of(2) {
        all.push(DomainPoint::from_bits(ONE_THIRD, ONE_THIRD));
    }
}

fn check_points(config: Config, factors: PatchFactors) {
    let patch = Patch::new(config, factors);
    let ProcessedPatch::Regular(processed) = patch.processed() else { return };
    let mut along = Locations::default();
    for (along, factor) in along.iter_mut().zip(processed.iter()) {
        let context = factor.context;
        along.extend((0..context.points).map(|p| place(&context, p).to_bits()));
    }
    let expected = points(factors.domain(), &along);
    let found = patch.tessellate().points;
    let at = found.iter().zip(&expected).position(|(found, expected)| found != expected);
    let equal = (found.len(), at) == (expected.len(), None);
    assert!(equal, "{config:?}, {factors:?}: point {at:?} of {}", found.len());
}

/// Every pair of inside counts of a spacing, by factors whose locations are not evenly spaced.
#[expect(clippy::float_arithmetic, reason = "exact: multiples of an eighth below 65")]
fn check_all_points(step: usize) -> u64 {
    let mut patches = 0;
    let pairs = (1..=64_u8).flat_map(|u| (1..=64_u8).map(move |v| [u, v]));
    for (partitioning, split) in settings() {
        for [u, v] in pairs.clone().step_by(step) {
            let [u, v] = [u, v].map(|factor| f32::from(factor) - 0.375);
            let quad = [2.5, 3.25, 6.75, 5.5, u, v].into();
            check_points(config(partitioning, split), PatchFactors::Quad(quad));
            let triangle = [v, 3.25, 6.75, u].into();
            check_points(config(partitioning, split), PatchFactors::Triangle(triangle));
            patches += 2;
        }
    }
    patches
}

#[test]
fn points_are_made_of_locations() {
    check_all_points(37);
}

#[test]
#[ignore = "slow: all pairs of inside counts"]
fn points_are_made_of_locations_in_every_class() {
    let patches = check_all_points(1);
    println!("classes: {patches} patches, each pair of inside counts under every setting");
}
