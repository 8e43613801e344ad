//! Factor rules.

use crate::models::models;
use glam::Vec3;
use tess_core::Partitioning;
use tess_surface::{Curve, Edge, FactorRule};

const X_AXIS: Curve = Curve::Line([Vec3::ZERO, Vec3::new(2.0, 0.0, 0.0)]);

#[test]
fn values() {
    let eye = Vec3::new(1.0, 0.0, 4.0);
    let distance = FactorRule::Distance { eye, scale: 20.0 };
    assert_eq!(distance.edge(&X_AXIS, 0.0), 5.0, "20 / 4");
    let screen = FactorRule::ScreenSpace { eye, pixels_per_unit: 100.0, segment: 5.0 };
    assert_eq!(screen.edge(&X_AXIS, 0.0), 10.0, "2 units at distance 4: 50 pixels");
    // Second derivative 8 along one axis: n segments deviate by 8 / (8 n^2).
    let flat = FactorRule::Flatness { tolerance: 0.02 };
    assert_eq!(flat.edge(&X_AXIS, 8.0), 16.0, "the power of two from sqrt(8 / 0.08)");
}

#[test]
fn factors_stay_in_range() {
    let at_eye = FactorRule::Distance { eye: Vec3::X, scale: 20.0 };
    assert_eq!(at_eye.edge(&X_AXIS, 0.0), 64.0, "infinity");
    let point = Curve::Line([Vec3::X; 2]);
    let nothing = FactorRule::ScreenSpace { eye: Vec3::X, pixels_per_unit: 1.0, segment: 1.0 };
    assert_eq!(nothing.edge(&point, 0.0), 1.0, "0 / 0");
    for (factor, expected) in [(f32::NAN, 1.0), (-1.0, 1.0), (0.0, 1.0), (65.0, 64.0), (2.5, 2.5)] {
        assert_eq!(FactorRule::Uniform(factor).edge(&X_AXIS, 0.0), expected, "{factor}");
    }
}

/// A rule sees the canonical curve, so the direction in which a patch walks it is no matter.
#[test]
fn direction_is_no_matter() {
    let curve = Curve::cubic(
        [[0.1, 0.2, 0.3], [0.7, 0.1, 0.4], [0.3, 0.9, 0.2], [0.5, 0.5, 0.6]].map(Vec3::from_array),
    );
    let rule = FactorRule::ScreenSpace { eye: Vec3::ONE, pixels_per_unit: 77.7, segment: 3.3 };
    let [ours, theirs] = [curve, curve.reversed()].map(|curve| Edge::new(curve).curve);
    assert_eq!(rule.edge(&ours, 0.0).to_bits(), rule.edge(&theirs, 0.0).to_bits(), "one edge");
    assert_ne!(Edge::new(curve).direction, Edge::new(curve.reversed()).direction, "two directions");
}

#[test]
fn powers_of_two() {
    for (name, model) in &models() {
        let factors = FactorRule::Uniform(5.0).factors(model, 0, Partitioning::Pow2);
        assert!(factors.iter().all(|factor| factor == 8.0), "{name}: {factors:?}");
    }
}
