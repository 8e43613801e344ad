//! No cracks: after positions with equal bits are welded, the open edges of a tessellated model are
//! those of its border, for every model, rule, partitioning and displacement.

use crate::models::{bumps, models, rules};
use crate::weld::{Tamper, complaint, tessellate};
use glam::Vec3;
use tess_core::{Partitioning, PatchFactors};
use tess_surface::{Direction, DisplacedModel, FactorRule, HalfEdge, Model, teapot};

#[test]
fn every_model_and_rule() {
    let bumps = bumps();
    let mut compared = 0;
    for (name, model) in &models() {
        for (rule_name, rule) in &rules() {
            for partitioning in Partitioning::ALL {
                for displacement in [None, Some(&bumps)] {
                    let out = tessellate(model, rule, partitioning, displacement, None);
                    let displaced = displacement.is_some();
                    let what = format!("{name}, {rule_name}, {partitioning:?}, {displaced}");
                    assert_eq!(complaint(&out), None, "{what}");
                    compared += 1;
                }
            }
        }
    }
    assert_eq!(compared, 16 * 6 * 4 * 2, "every combination was compared");
}

#[test]
fn a_changed_factor_is_a_crack() {
    let tamper: Tamper = |number, factors| match factors {
        PatchFactors::Quad(quad) if number == 5 => quad.v0 += 1.0,
        PatchFactors::Triangle(triangle) if number == 5 => triangle.v0 += 1.0,
        _ => {}
    };
    for (name, model) in &models() {
        let rule = FactorRule::Uniform(5.0);
        let out = tessellate(model, &rule, Partitioning::Integer, None, Some(tamper));
        assert!(complaint(&out).is_some(), "{name}: one side's factor was changed");
    }
}

#[test]
fn a_moved_point_is_a_crack() {
    let model = Model::bezier(teapot::patches()).unwrap();
    let rule = FactorRule::Uniform(5.0);
    let mut out = tessellate(&model, &rule, Partitioning::Integer, None, None);
    assert_eq!(complaint(&out), None, "as it is");
    let x = &mut out.triangles[100][1][0];
    *x = x.next_up();
    assert!(complaint(&out).is_some(), "one coordinate was moved by one unit in the last place");
}

/// Both sides of every shared edge give the same bits at many places, with and without
/// displacement. The formulas of the insides differ somewhere, so the edge's own is needed.
#[test]
fn both_sides_give_the_same_bits() {
    let bumps = bumps();
    let (mut compared, mut differ) = (0, 0);
    for (name, model) in &models() {
        let displaced = DisplacedModel::new(model, &bumps);
        for number in 0..model.len() {
            for edge in 0..model.patch(number).edges().as_slice().len() {
                let half = HalfEdge { patch: number, edge };
                let Some(twin) = model.twin(half) else { continue };
                for k in 0..=64u16 {
                    let t = f32::from(k) / 64.0;
                    let (ours, theirs) = (at(model, half, t), at(model, twin, t));
                    let (a, b) = (model.patch(number), model.patch(twin.patch));
                    assert_eq!(bits(a.position(ours)), bits(b.position(theirs)), "{name}");
                    let [c, d] = [(number, ours), (twin.patch, theirs)]
                        .map(|(number, at)| displaced.patch(number).sample(at).position);
                    assert_eq!(bits(c), bits(d), "{name}, displaced, {half:?} at {t}");
                    let [inside_a, inside_b] =
                        [(&a, ours), (&b, theirs)].map(|(p, [u, v])| p.frame(u, v).position);
                    differ += usize::from(inside_a != inside_b);
                    compared += 1;
                }
            }
        }
    }
    assert!(compared > 10_000, "{compared} points were compared");
    assert!(differ > 100, "the formulas of the insides agree by themselves: {differ}");
}

/// The domain point on an edge whose canonical parameter is `t`.
fn at(model: &Model, half: HalfEdge, t: f32) -> [f32; 2] {
    let patch = model.patch(half.patch);
    let t = match patch.edges().as_slice()[half.edge].direction {
        Direction::Against => 1.0 - t,
        Direction::Along | Direction::Symmetric => t,
    };
    match (patch.edges().as_slice().len(), half.edge) {
        (_, 0) => [0.0, t],
        (_, 1) => [t, 0.0],
        (3, _) => [t, 1.0 - t],
        (_, 2) => [1.0, t],
        _ => [t, 1.0],
    }
}

fn bits(position: Vec3) -> [u32; 3] {
    position.to_array().map(f32::to_bits)
}
