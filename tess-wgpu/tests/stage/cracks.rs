//! The helpers for hull and domain functions: by exact positions, there are no cracks under moving
//! cameras, and no visible patch is culled.

use crate::ball::{Ball, Placed, View};
use std::collections::BTreeMap;

/// The bits of the positions along an edge of a quad, beginning at the corner with the lower
/// number.
fn along(quad: [u32; 4], points: &[Placed], edge: usize) -> ([u32; 2], Vec<[u32; 4]>) {
    // Along u = 0, v = 0, u = 1, v = 1, with corners at (0,0), (1,0), (1,1), (0,1).
    let [from, to] = [[0, 3], [0, 1], [1, 2], [3, 2]][edge].map(|corner: usize| quad[corner]);
    let (fixed, moving) = (edge % 2, 1 - edge % 2);
    let side = if edge < 2 { 0 } else { 0x10000 };
    let mut found: Vec<(u32, [u32; 4])> = points
        .iter()
        .filter(|point| point.uv[fixed] == side)
        .map(|point| (point.uv[moving], point.clip.map(f32::to_bits)))
        .collect();
    found.sort_unstable();
    if from > to {
        found.reverse();
    }
    ([from.min(to), from.max(to)], found.into_iter().map(|(_, bits)| bits).collect())
}

/// Compares both sides of every edge. Returns the number of compared edges, and the first that
/// differs.
fn compare_sides(quads: &[[u32; 4]], frame: &[Vec<Placed>]) -> (usize, Result<(), String>) {
    let mut sides: BTreeMap<[u32; 2], Vec<Vec<[u32; 4]>>> = BTreeMap::new();
    for (&quad, points) in quads.iter().zip(frame) {
        for edge in (0..4).take_while(|_| !points.is_empty()) {
            let (ends, side) = along(quad, points, edge);
            assert!(side.len() >= 2, "an edge has its ends");
            sides.entry(ends).or_default().push(side);
        }
    }
    let pairs: Vec<_> = sides.into_iter().filter(|(_, sides)| sides.len() == 2).collect();
    let differs = pairs.iter().find(|(_, sides)| sides[0] != sides[1]);
    let result = differs.map_or(Ok(()), |(ends, sides)| {
        Err(format!("edge {ends:?} has {} and {} points", sides[0].len(), sides[1].len()))
    });
    (pairs.len(), result)
}

/// Ten frames from the whole flight; an odd step has frames with and without culling.
#[test]
fn there_are_no_cracks_in_ten_frames() {
    assert_no_cracks((0..100).step_by(11));
}

#[test]
#[ignore = "slow: all frames of the flight"]
fn there_are_no_cracks_in_100_frames() {
    assert_no_cracks(0..100);
}

fn assert_no_cracks(frames: impl Iterator<Item = u16>) {
    let mut ball = Ball::new(str::to_owned);
    let mut most = 0;
    for number in frames {
        let culls = number % 2 == 1;
        let frame = ball.frame(View::flight(number, culls));
        let (edges, result) = compare_sides(&ball.quads, &frame);
        assert_eq!(result, Ok(()), "frame {number}");
        assert!(edges == 2 * ball.quads.len() || culls && edges > 5, "{edges} edges in {number}");
        most = most.max(frame.iter().map(Vec::len).max().unwrap_or(0));
    }
    assert!(most > 100, "a patch has up to {most} points");
}

#[test]
#[ignore = "slow: many pipelines"]
fn planted_cracks_are_seen() {
    for (right, wrong) in [
        (
            "let direction = normalize(tess_on_quad(around, uv).xyz);",
            "let ab = around[0] + (around[1] - around[0]) * uv.x; \
             let dc = around[3] + (around[2] - around[3]) * uv.x; \
             let direction = normalize((ab + (dc - ab) * uv.y).xyz);",
        ),
        ("edge(a, d), edge(a, b)", "edge(a, d) * 1.0001, edge(a, b)"),
        ("let p = normalize(a.xyz);", "let p = normalize(a.xyz + 0.0001 * b.xyz);"),
        ("tess_sample(heights, 0.5", "tess_sample(heights, 0.0001 * uv + 0.5"),
    ] {
        let mut ball = Ball::new(|source| {
            assert_eq!(source.matches(right).count(), 1, "{right}");
            source.replace(right, wrong)
        });
        let is_open = (0..12).any(|number| {
            let frame = ball.frame(View::flight(number, false));
            compare_sides(&ball.quads, &frame).1.is_err()
        });
        assert!(is_open, "{wrong} opens no edge");
    }
}

/// Whether a patch is visible: some vertex is in the frustum and faces the eye, by the ball's
/// normal there.
fn is_seen(points: &[Placed], eye: [f32; 4]) -> bool {
    points.iter().any(|point| {
        let [x, y, z, w] = point.clip;
        let is_inside = x.abs() <= w && y.abs() <= w && z >= 0.0 && z <= w;
        let to_eye: f32 = (0..3).map(|k| (eye[k] - point.world[k]) * point.world[k]).sum();
        is_inside && to_eye > 0.0
    })
}

#[test]
#[ignore = "slow: many pipelines"]
fn what_is_culled_is_not_seen() {
    let mut ball = Ball::new(str::to_owned);
    let mut culled = [0; 2];
    for number in 0..30 {
        let flat = |culls| View { displacement: 0.0, ..View::flight(number, culls) };
        let all = ball.frame(flat(false));
        let some = ball.frame(flat(true));
        for (patch, (all, some)) in all.iter().zip(&some).enumerate() {
            assert!(!all.is_empty(), "nothing is culled unless asked for");
            let is_seen = is_seen(all, flat(true).eye);
            assert!(!is_seen || !some.is_empty(), "patch {patch} of frame {number} is seen");
            culled[usize::from(is_seen)] += usize::from(some.is_empty());
        }
    }
    assert!(culled[0] > 150 && culled[1] == 0, "{culled:?} patches are culled, unseen and seen");
}
