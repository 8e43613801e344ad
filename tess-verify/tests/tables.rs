//! A device made of tables, with one wrong entry of one of them. Each such device is seen by
//! Direct3D's rules over the patches of `tess gen --rules`, and differs at level 1.
//!
//! ```text
//! numbers      domain, spacing, role, number of segments     the next number
//! reciprocals  the same with outer or inside for a role      one unit more
//! splits       domain, spacing, outer or inside, half points the next position
//! locations    domain, outer or inside, number, point        one unit more
//! transitions  domain, points outside, points inside         two steps exchanged
//! rings        domain, points of the inner row               two steps exchanged
//! strips       points of a row, diagonals                    two steps exchanged
//! outputs      domain, output                                triangles turned, or a primitive less
//! ```

use std::collections::{BTreeMap, BTreeSet};
use tess_core::fixed_point::{HALF, ONE, ONE_THIRD, TWO_THIRDS};
use tess_core::place::place;
use tess_core::reciprocal::reciprocal;
use tess_core::stitch::{Diagonals, ring, strip, transition};
use tess_core::{
    Domain, DomainPoint, FactorContext, OutputPrimitive, Parity, Partitioning, PatchFactors,
    ProcessedPatch, Side, SplitOrder, Step, Stitch, StitchKind, Tessellation,
};
use tess_verify::generate::{GenLevel, Selection, SplitMix64};
use tess_verify::rules::{Checker, Specification};
use tess_verify::{Case, Named};

/// One entry of one table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Entry {
    /// A number of segments in a position.
    Number {
        position: usize,
        segments: u32,
    },
    Reciprocal {
        is_inner: bool,
        segments: u32,
    },
    Split {
        is_inner: bool,
        half_points: u32,
    },
    /// A point of a whole number of segments.
    Location {
        is_inner: bool,
        segments: u32,
        point: u32,
    },
    Transition {
        outer: u32,
        inside: u32,
    },
    Ring {
        points: u32,
    },
    Strip {
        points: u32,
        is_forward: bool,
    },
    Output(usize),
}

/// A device with a wrong entry. `spacing` is given for tables that depend on it.
#[derive(Clone, Copy, Debug)]
struct Device {
    domain: Domain,
    spacing: Option<Partitioning>,
    entry: Entry,
}

/// The contexts of a patch that is neither culled nor minimum, by position.
fn contexts(case: &Case) -> Option<Vec<FactorContext>> {
    match case.patch().processed() {
        ProcessedPatch::Regular(factors) => Some(factors.iter().map(|f| f.context).collect()),
        _ => None,
    }
}

/// A case that is neither culled nor minimum, with what its answer depends on.
struct Asked {
    case: Case,
    contexts: Vec<FactorContext>,
    /// The entries of its triangles.
    stitches: BTreeSet<Entry>,
}

impl Asked {
    fn new(case: Case) -> Option<Self> {
        let (contexts, mut stitches) = (contexts(&case)?, BTreeSet::new());
        if case.primitive_size() == 3 {
            case.patch().stitches(|stitch| stitches.extend(Device::entry_of(&stitch)));
        }
        Some(Self { case, contexts, stitches })
    }
}

fn is_inner(case: &Case, position: usize) -> bool {
    position >= case.domain().outer_factors()
}

impl Device {
    /// Whether an answer may show the entry.
    fn may_show(&self, asked: &Asked) -> bool {
        let (case, contexts) = (&asked.case, &asked.contexts);
        if case.domain() != self.domain
            || self.spacing.is_some_and(|own| own != case.config.partitioning)
        {
            return false;
        }
        let mut of_role = contexts.iter().enumerate().map(|(p, c)| (is_inner(case, p), *c));
        match self.entry {
            Entry::Number { position, segments } => contexts[position].points == segments + 1,
            Entry::Reciprocal { .. } | Entry::Split { .. } => {
                of_role.any(|(is_inner, context)| self.context(is_inner, context) != context)
            }
            Entry::Location { is_inner, segments, .. } => of_role
                .any(|(inner, c)| inner == is_inner && c.points == segments + 1 && c.fraction == 0),
            Entry::Output(output) => case.config.output == OutputPrimitive::ALL[output],
            entry => asked.stitches.contains(&entry),
        }
    }

    fn entry_of(stitch: &Stitch) -> Option<Entry> {
        let Stitch { outer_points: outer, inner_points: points, .. } = *stitch;
        match stitch.kind {
            StitchKind::Transition { .. } => Some(Entry::Transition { outer, inside: points + 2 }),
            StitchKind::Ring { .. } => Some(Entry::Ring { points }),
            StitchKind::Centre(diagonals) => {
                Some(Entry::Strip { points, is_forward: diagonals == Diagonals::Forward })
            }
            StitchKind::CentreTriangle => None,
        }
    }

    /// The context that the device has in place of a right one.
    fn context(&self, is_inner: bool, right: FactorContext) -> FactorContext {
        let mut context = right;
        match self.entry {
            Entry::Reciprocal { is_inner: own, segments } if own == is_inner => {
                let right = reciprocal(segments).expect("1 to 64 segments");
                for length in [&mut context.inv_floor, &mut context.inv_ceil] {
                    *length += u32::from(*length == right);
                }
            }
            Entry::Split { is_inner: own, half_points } if own == is_inner => {
                let splits = context.split_position <= context.half_points;
                if splits && context.half_points == half_points {
                    // From the last position on, nothing is before the middle.
                    let is_last = context.split_position + 1 >= half_points;
                    let own = context.split_position;
                    context.split_position = if is_last { own - 1 } else { own + 1 };
                }
            }
            _ => {}
        }
        context
    }

    /// The location of a point along a factor.
    fn place(&self, is_inner: bool, right: FactorContext, point: u32) -> u32 {
        let own = place(&self.context(is_inner, right), point).to_bits();
        let (segments, is_whole) = (right.points - 1, right.fraction == 0);
        let is_wrong = is_whole && self.entry == Entry::Location { is_inner, segments, point };
        own + u32::from(is_wrong)
    }

    fn answer(&self, case: &Case) -> Tessellation {
        let mut output = case.patch().tessellate();
        match self.entry {
            Entry::Number { position, .. } => {
                return self.other_number(case, position).patch().tessellate();
            }
            Entry::Output(_) => spoil_output(case, &mut output),
            Entry::Reciprocal { .. } | Entry::Split { .. } | Entry::Location { .. } => {
                output.points = self.points(case);
            }
            _ => output.indices = self.triangles(case),
        }
        output
    }

    /// The case with the next number of segments in a position, or the one before.
    fn other_number(&self, case: &Case, position: usize) -> Case {
        let segments = contexts(case).map_or(0, |contexts| contexts[position].points - 1);
        let is_density = self.domain == Domain::Isoline && position == 0;
        let step = if case.config.partitioning.has_integer_factors() || is_density { 1 } else { 2 };
        let next = if segments + step <= 64 { segments + step } else { segments - step };
        let own: Vec<f32> = case.factors.iter().collect();
        let level = f32::from(u16::try_from(next).expect("at most 64"));
        let at = |p: usize| if p == position { level } else { own[p] };
        Case { factors: PatchFactors::from_fn(case.domain(), at), ..*case }
    }

    fn triangles(&self, case: &Case) -> Vec<u32> {
        let mut indices = Vec::new();
        case.patch().stitches(|stitch| {
            let mut steps = Vec::new();
            let own = |step| steps.push(step);
            match stitch.kind {
                StitchKind::Transition { .. } => {
                    transition(case.config.split, stitch.outer_points, stitch.inner_points + 2, own)
                }
                StitchKind::Ring { .. } => ring(stitch.inner_points, own),
                StitchKind::Centre(diagonals) => strip(stitch.outer_points - 1, diagonals, own),
                StitchKind::CentreTriangle => stitch.steps(case.config.split, own),
            }
            if Self::entry_of(&stitch) == Some(self.entry) {
                exchange(&mut steps);
            }
            for step in steps {
                let [a, b, c] = step.triangle(&stitch.outer, &stitch.inner);
                let is_clockwise = case.config.output == OutputPrimitive::TriangleCw;
                indices.extend(if is_clockwise { [a, b, c] } else { [a, c, b] });
            }
        });
        indices
    }

    /// The points, as section 6 of the specification lists them.
    fn points(&self, case: &Case) -> Vec<DomainPoint> {
        let contexts = contexts(case).expect("a regular patch");
        let count = |position: usize| contexts[position].points;
        let at = |position, p| self.place(is_inner(case, position), contexts[position], p);
        let domain = case.domain();
        if domain == Domain::Isoline {
            let lines = (0..count(0) - 1).flat_map(|line| (0..count(1)).map(move |p| (line, p)));
            return lines.map(|(line, p)| DomainPoint::from_bits(at(1, p), at(0, line))).collect();
        }
        let mut points = Vec::new();
        for edge in 0..domain.outer_factors() {
            for p in 0..count(edge) - 1 {
                let [forward, back] = [at(edge, p), at(edge, count(edge) - 1 - p)];
                let (u, v) = match (domain, edge) {
                    (_, 0) => (0, back),
                    (_, 1) => (forward, 0),
                    (Domain::Triangle, _) => (back, ONE - back),
                    (_, 2) => (ONE, forward),
                    _ => (back, ONE),
                };
                points.push(DomainPoint::from_bits(u, v));
            }
        }
        match domain {
            Domain::Triangle => rings(contexts[3], |p| at(3, p), &mut points),
            _ => rectangles([contexts[4], contexts[5]], |axis, p| at(4 + axis, p), &mut points),
        }
        points
    }
}

/// The points inside a triangle.
fn rings(inside: FactorContext, at: impl Fn(u32) -> u32, points: &mut Vec<DomainPoint>) {
    let last = inside.points - 1;
    for ring in 1..inside.points / 2 {
        let depth = (at(ring) * TWO_THIRDS + HALF) >> 16;
        for edge in 0..3 {
            for p in ring..last - ring {
                let along = at(if edge == 1 { p } else { last - p }) - depth.div_ceil(2);
                let (u, v) = match edge {
                    0 => (depth, along),
                    1 => (along, depth),
                    _ => (along, ONE - along - depth),
                };
                points.push(DomainPoint::from_bits(u, v));
            }
        }
    }
    if inside.parity == Parity::Even {
        points.push(DomainPoint::from_bits(ONE_THIRD, ONE_THIRD));
    }
}

/// The points inside a quad, by columns and rows.
fn rectangles(
    [u, v]: [FactorContext; 2],
    at: impl Fn(usize, u32) -> u32,
    points: &mut Vec<DomainPoint>,
) {
    let mut push = |column, row| points.push(DomainPoint::from_bits(at(0, column), at(1, row)));
    let [last_u, last_v] = [u.points - 1, v.points - 1];
    let rings = u.points.min(v.points) / 2;
    for ring in 1..rings {
        let [far_u, far_v] = [last_u - ring, last_v - ring];
        (ring..far_v).for_each(|p| push(ring, last_v - p));
        (ring..far_u).for_each(|p| push(p, ring));
        (ring..far_v).for_each(|p| push(far_u, p));
        (ring..far_u).for_each(|p| push(last_u - p, far_v));
    }
    // A single row; its other axis is in the middle.
    if u.points > v.points && v.parity == Parity::Even {
        (rings..=last_u - rings).for_each(|p| push(p, rings));
    } else if u.points <= v.points && u.parity == Parity::Even {
        (rings..=last_v - rings).for_each(|p| push(rings, last_v - p));
    }
}

/// Turns triangles, or drops the last one of other primitives.
fn spoil_output(case: &Case, output: &mut Tessellation) {
    let size = case.primitive_size();
    if size == 3 {
        output.indices.chunks_mut(3).for_each(|triangle| triangle.swap(1, 2));
    } else {
        output.indices.truncate(output.indices.len() - size);
    }
}

/// Exchanges two steps that advance on different rows.
fn exchange(steps: &mut [Step]) {
    let pair = steps.windows(2).position(|pair| pair[0].advances != pair[1].advances);
    let Some(first) = pair else { return };
    steps.swap(first, first + 1);
    let (mut outer, mut inner) = (0, 0);
    for step in steps {
        (step.outer, step.inner) = (outer, inner);
        match step.advances {
            Side::Outer => outer += 1,
            Side::Inner => inner += 1,
        }
    }
}

/// The name of an entry's table.
fn table(entry: Entry) -> &'static str {
    match entry {
        Entry::Number { .. } => "numbers",
        Entry::Reciprocal { .. } => "reciprocals",
        Entry::Split { .. } => "splits",
        Entry::Location { .. } => "locations",
        Entry::Transition { .. } => "transitions",
        Entry::Ring { .. } => "rings",
        Entry::Strip { .. } => "strips",
        Entry::Output(_) => "outputs",
    }
}

/// The numbers of segments of a spacing that are asked: of pow2, the powers of two.
fn numbers(spacing: Partitioning) -> Vec<u32> {
    match spacing {
        Partitioning::Pow2 => (0..7).map(|k| 1 << k).collect(),
        Partitioning::Integer => (1..=64).collect(),
        Partitioning::FractionalOdd => (1..=63).step_by(2).collect(),
        Partitioning::FractionalEven => (2..=64).step_by(2).collect(),
    }
}

/// Every device with a wrong entry.
fn devices() -> Vec<Device> {
    let spacings =
        [Partitioning::Integer, Partitioning::FractionalOdd, Partitioning::FractionalEven];
    let mut devices = Vec::new();
    for domain in Domain::ALL {
        let mut add = |spacing, entry| devices.push(Device { domain, spacing, entry });
        for spacing in Partitioning::ALL {
            for position in 0..domain.factors() {
                let inner = position >= domain.outer_factors();
                let is_density = domain == Domain::Isoline && position == 0;
                let is_whole = is_density && spacing != Partitioning::Pow2;
                let numbers = numbers(if is_whole { Partitioning::Integer } else { spacing });
                for segments in numbers.into_iter().filter(|n| !inner || *n > 1) {
                    add(Some(spacing), Entry::Number { position, segments });
                }
            }
        }
        let roles = if domain == Domain::Isoline { vec![false] } else { vec![false, true] };
        for is_inner in roles {
            for spacing in spacings {
                // One and two segments have no point whose place depends on the entry.
                let numbers = numbers(spacing).into_iter().filter(|n| *n > 2);
                numbers
                    .for_each(|n| add(Some(spacing), Entry::Reciprocal { is_inner, segments: n }));
                let halves = if spacing.has_integer_factors() { 0..0 } else { 3..33 };
                halves.for_each(|n| add(Some(spacing), Entry::Split { is_inner, half_points: n }));
            }
            for segments in 3..=64 {
                // The second half of a line mirrors the first.
                let points = 1..=segments / 2;
                points.for_each(|point| add(None, Entry::Location { is_inner, segments, point }));
            }
        }
        (0..4).for_each(|output| add(None, Entry::Output(output)));
        if domain == Domain::Isoline {
            continue;
        }
        for outer in 2..=65 {
            (4..=65).for_each(|inside| add(None, Entry::Transition { outer, inside }));
        }
        (2..=61).for_each(|points| add(None, Entry::Ring { points }));
        if domain == Domain::Quad {
            // Of two points, or of an odd number of them, a strip has one of both kinds.
            (3..=63).for_each(|points| add(None, Entry::Strip { points, is_forward: true }));
            let even = (2..=62).step_by(2);
            even.for_each(|points| add(None, Entry::Strip { points, is_forward: false }));
        }
    }
    devices
}

fn cases(level: GenLevel) -> Vec<Asked> {
    let split = Some(SplitOrder::Ruler);
    Selection { split, ..Selection::level(level, 1) }.cases().filter_map(Asked::new).collect()
}

/// The cases that show a device's entry, with its answers.
fn shown<'a>(
    device: &'a Device,
    cases: &'a [Asked],
) -> impl Iterator<Item = (Case, Tessellation)> + 'a {
    let answers = cases.iter().filter(|asked| device.may_show(asked));
    let answers = answers.map(|asked| (asked.case, device.answer(&asked.case)));
    answers.filter(|(case, answer)| *answer != case.patch().tessellate())
}

/// Without a wrong entry, the device is the model.
#[test]
fn right_tables_give_the_models_answers() {
    let random = Selection { random: Some(3000), ..Selection::level(GenLevel::Three, 11) };
    let mut compared = BTreeMap::new();
    for case in random.cases() {
        let Some(_) = contexts(&case) else { continue };
        let entry = Entry::Number { position: 0, segments: 0 };
        let device = Device { domain: case.domain(), spacing: None, entry };
        let right = case.patch().tessellate();
        assert_eq!(device.points(&case), right.points, "{case}");
        if case.primitive_size() == 3 {
            assert_eq!(device.triangles(&case), right.indices, "{case}");
        }
        *compared.entry(case.domain().name()).or_insert(0) += 1;
    }
    assert!(compared.values().all(|count| *count > 200), "{compared:?}");
}

/// What is wrong with the questions for a device: nothing, if the rules of Direct3D break, and
/// level 1 has a difference.
fn unseen(device: &Device, rules: &[Asked], level_1: &[Asked]) -> Vec<&'static str> {
    let mut faults = Vec::new();
    let mut checker = Checker::new(Specification::D3d11);
    let mut asked = 0;
    for (case, answer) in shown(device, rules).take(4) {
        checker.add(&case, &answer);
        asked += 1;
    }
    match (asked, checker.broken().map(|(_, broken)| broken).sum::<u64>()) {
        (0, _) => faults.push("not asked by --rules"),
        (_, 0) => faults.push("no rule of Direct3D is broken"),
        _ => {}
    }
    if shown(device, level_1).next().is_none() {
        faults.push("not asked at level 1");
    }
    faults
}

/// Some devices of each table, chosen at random.
#[test]
fn a_wrong_entry_of_a_table_is_seen() {
    judge(|table, all| {
        let mut random = SplitMix64::new(0x7A_B1E5);
        let some = (0..24).map(|_| random.below(u32::try_from(all).expect("few")) as usize);
        if table == "outputs" { (0..all).collect() } else { some.collect() }
    });
}

/// Every device of every table.
#[test]
#[ignore = "slow: every entry"]
fn every_wrong_entry_of_a_table_is_seen() {
    judge(|_, all| (0..all).collect());
}

fn judge(choose: impl Fn(&str, usize) -> Vec<usize>) {
    let (rules, level_1) = (cases(GenLevel::Rules), cases(GenLevel::One));
    let mut by_table: BTreeMap<&str, Vec<Device>> = BTreeMap::new();
    devices().into_iter().for_each(|d| by_table.entry(table(d.entry)).or_default().push(d));
    assert_eq!(by_table.len(), 8, "tables");
    let mut faults: BTreeMap<(&str, &str), Vec<String>> = BTreeMap::new();
    for (table, devices) in &by_table {
        for number in choose(table, devices.len()) {
            for what in unseen(&devices[number], &rules, &level_1) {
                faults.entry((table, what)).or_default().push(format!("{:?}", devices[number]));
            }
        }
    }
    let text = faults.iter().map(|((table, what), own)| {
        format!("{table}: {}: {what}: {:#?}\n", own.len(), &own[..own.len().min(6)])
    });
    assert!(faults.is_empty(), "{}", text.collect::<String>());
}
