//! Computes every number in `docs/tour-cpu.md`.

use crate::data::lanes::{LANES, MAX_FACTORS};
use crate::data::writer::Writer;
use crate::stages::packet::PacketPatch;
use crate::stages::points::{CompactPoints, Lookup};
use crate::tour::{CONFIG, QUAD, all_codes, packet};
use std::fmt::Write as _;
use tess_core::place::{place, placement};
use tess_core::{Domain, Patch, PatchFactors, ProcessedFactor, QuadFactors};
use tess_simd::{Numbering, Output, PatchRange, Tessellator};

const NAMES: [&str; 6] = ["u0", "v0", "u1", "v1", "inside_u", "inside_v"];

/// A line of text for each factor.
fn each_factor(line: impl Fn(&ProcessedFactor) -> String) -> String {
    let patch = Patch::new(CONFIG, QUAD);
    let factors = patch.processed().factors().expect("no factor culls it");
    NAMES.iter().zip(factors.iter()).fold(String::new(), |mut text, (name, factor)| {
        let _ = writeln!(text, "{name:<9}{}", line(&factor));
        text
    })
}

/// One line for each chunk of `items`, which begins with the number of its first item.
fn numbered<T>(items: &[T], a_line: usize, text: impl Fn(&T) -> String) -> String {
    let mut all = String::new();
    for (line, items) in items.chunks(a_line).enumerate() {
        let items: Vec<String> = items.iter().map(&text).collect();
        let _ = writeln!(all, "{:>3}  {}", line * a_line, items.join("  "));
    }
    all
}

fn raw() -> String {
    let each = NAMES.iter().zip(PatchFactors::Quad(QUAD).iter());
    each.fold(String::new(), |mut text, (name, factor)| {
        let _ = writeln!(text, "{name:<9}{factor:<5}{:#010X}", factor.to_bits());
        text
    })
}

fn factors() -> String {
    each_factor(|factor| format!("{:#07X}", factor.fixed.to_bits()))
}

fn contexts() -> String {
    let head = "         inv_floor inv_ceil fraction half_points split points\n";
    let lines = each_factor(|factor| {
        let c = factor.context;
        format!(
            "{:>9} {:>8} {:>8} {:>11} {:>5} {:>6}",
            c.inv_floor, c.inv_ceil, c.fraction, c.half_points, c.split_position, c.points
        )
    });
    head.to_string() + &lines
}

fn places() -> String {
    let patch = Patch::new(CONFIG, QUAD);
    let factors = patch.processed().factors().expect("no factor culls it");
    let context = factors.iter().nth(1).expect("six factors").context;
    let mut text = String::from("point  position  coarse   fine  half_location  location\n");
    for p in 0..context.points {
        let steps = placement(&context, p);
        let blend = steps.blend.map_or_else(
            || "     -      -".to_string(),
            |blend| format!("{:>6} {:>6}", blend.coarse, blend.fine),
        );
        let (half, location) = (steps.half_location, steps.location.to_bits());
        let _ = writeln!(text, "{p:>5}  {:>8}  {blend}  {half:>13}  {location:>8}", steps.position);
    }
    text
}

fn locations() -> String {
    each_factor(|factor| {
        let all = 0..factor.context.points;
        all.map(|p| format!("{:>5X}", place(&factor.context, p).to_bits()))
            .collect::<Vec<_>>()
            .join(" ")
    })
}

fn counts() -> String {
    let counts = Patch::new(CONFIG, QUAD).counts();
    format!(
        "points {}\nprimitives {}\nindices {}\n",
        counts.points, counts.primitives, counts.indices
    )
}

fn points() -> String {
    let all: Vec<_> = Patch::new(CONFIG, QUAD).points().collect();
    numbered(&all, 6, |point| format!("{:>5X},{:>5X}", point.u.to_bits(), point.v.to_bits()))
}

fn stitches() -> String {
    let mut text = String::from("outer row               inner row               kind\n");
    Patch::new(CONFIG, QUAD).stitches(|stitch| {
        let row = |row: &tess_core::row::Row, points: u32| {
            let indices: Vec<_> = (0..points).map(|k| row.index(k).to_string()).collect();
            indices.join(" ")
        };
        let _ = writeln!(
            text,
            "{:<22}  {:<22}  {:?}",
            row(&stitch.outer, stitch.outer_points),
            row(&stitch.inner, stitch.inner_points),
            stitch.kind
        );
    });
    text
}

fn triangles() -> String {
    let indices = Patch::new(CONFIG, QUAD).tessellate().indices;
    let triangles: Vec<_> = indices.chunks(3).collect();
    numbered(&triangles, 6, |t| format!("{:>2} {:>2} {:>2}", t[0], t[1], t[2]))
}

/// A line for each factor of the patch in lane 0 of its packet.
fn packet_lines() -> String {
    let packet = packet();
    let patch: PacketPatch<'_> = packet.patch(0);
    let mut text = String::from("element  points split       step        lag\n");
    for factor in 0..MAX_FACTORS {
        let s = patch.fractional_spacing(factor);
        let _ = writeln!(
            text,
            "{:>7}  {:>6} {:>5} {:#010X} {:#010X}",
            factor * LANES,
            s.points,
            s.split_position,
            s.step,
            s.lag
        );
    }
    let _ = writeln!(text, "topology {:#X}, compact {}", patch.topology(), patch.is_compact());
    text
}

fn code_lines() -> String {
    numbered(&all_codes(), 6, |[u, v]| format!("{u:04X},{v:04X}"))
}

fn entries() -> String {
    let stored = |code| <Lookup as CompactPoints<Writer<'_, [f32; 2]>>>::stored(Domain::Quad, code);
    numbered(&all_codes(), 8, |&[u, v]| format!("{:>2},{:>2}", stored(u), stored(v)))
}

fn tessellated(patches: &[QuadFactors]) -> Output<[f32; 2], u32> {
    let mut output = Output::new();
    let numbering = Numbering::PerBatch { base_vertex: 100 };
    let result = Tessellator::new(CONFIG).tessellate(patches, numbering, &mut output);
    result.expect("a small batch");
    output
}

fn output() -> String {
    let output = tessellated(&[QUAD]);
    let point = |[u, v]: &[f32; 2]| format!("{:08X},{:08X}", u.to_bits(), v.to_bits());
    let index = |index: &u32| index.to_string();
    let points = numbered(&output.points()[..9], 3, point);
    points + &numbered(&output.indices()[..24], 12, index)
}

/// The document's fenced block whose opening line ends with `text` and this name.
fn block<'a>(document: &'a str, name: &str) -> Option<&'a str> {
    let (_, rest) = document.split_once(&format!("```text {name}\n"))?;
    rest.split_once("```").map(|(block, _)| block)
}

#[test]
fn every_number_of_the_tour() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/tour-cpu.md");
    let document = std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{path}: {error}"));
    let blocks = [
        ("raw", raw()),
        ("factors", factors()),
        ("contexts", contexts()),
        ("places", places()),
        ("locations", locations()),
        ("counts", counts()),
        ("points", points()),
        ("stitches", stitches()),
        ("triangles", triangles()),
        ("packet", packet_lines()),
        ("codes", code_lines()),
        ("entries", entries()),
        ("output", output()),
    ];
    let mut wrong = String::new();
    for (name, computed) in &blocks {
        if block(&document, name) != Some(computed) {
            let _ = write!(wrong, "```text {name}\n{computed}```\n\n");
        }
    }
    assert!(wrong.is_empty(), "docs/tour-cpu.md should have these blocks:\n\n{wrong}");
    assert_eq!(document.matches("```text ").count(), blocks.len(), "no block goes unchecked");
}

/// The numbers at the head of `kernels/emit.rs`.
#[test]
fn the_worked_packet() {
    let culled = QuadFactors { u0: 0.0, ..QUAD };
    let output = tessellated(&[QUAD, culled, QUAD]);
    let range = |first_point, points, first_index, indices| PatchRange {
        first_point,
        points,
        first_index,
        indices,
    };
    let expected = [range(0, 43, 0, 186), range(43, 0, 186, 0), range(43, 43, 186, 186)];
    assert_eq!(output.ranges(), expected, "ranges");
    assert_eq!((output.indices()[0], output.indices()[186]), (100, 143), "bases");
}
