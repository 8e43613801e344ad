//! How a height image continues beyond its borders, if the file does not say it.

use crate::support::obj;
use tess_mesh::tess_surface::glam::Vec2;
use tess_mesh::tess_surface::{Address, HeightMap};

/// The first `sides` of a square tower's four sides, over which u goes from 0 to `turns`.
fn tower(sides: usize, turns: f32) -> [Address; 2] {
    let mut text = String::from("s off\n");
    for y in 0..2 {
        for (x, z) in [(1, 0), (0, 1), (-1, 0), (0, -1)] {
            text += &format!("v {x} {y} {z}\n");
        }
        for u in [0.0, 0.25, 0.5, 0.75, 1.0] {
            text += &format!("vt {} {y}\n", u * turns);
        }
    }
    for side in 1..=sides {
        let (left, right) = (side, side % 4 + 1);
        let [upper, end] = [left + 4, right + 4];
        text += &format!("f {left}/{side} {upper}/{} ", side + 5);
        text += &format!("{end}/{} {right}/{}\n", side + 6, side + 1);
    }
    obj(&text).address
}

#[test]
fn image_goes_round_where_the_surface_closes() {
    assert_eq!(tower(4, 1.0), [Address::Repeat, Address::Clamp], "closed: as a planet");
    assert_eq!(tower(4, 2.0), [Address::Repeat, Address::Clamp], "closed, and beyond the image");
    assert_eq!(tower(2, 2.5), [Address::Repeat, Address::Clamp], "open, and beyond the image");
    assert_eq!(tower(3, 1.0), [Address::Clamp; 2], "open");
    assert_eq!(tower(4, 0.9), [Address::Clamp; 2], "the ends are different places of the image");
}

/// Texels have their centres half a texel from the border, so at the date line both outermost
/// columns count, each half.
#[test]
#[expect(clippy::float_cmp, reason = "these heights are exact")]
fn no_step_at_the_date_line() {
    let columns = HeightMap::new(4, 1, vec![0.0, 0.25, 0.5, 1.0]).expect("an image");
    let map = columns.clone().with_addresses(tower(4, 1.0));
    for v in [0.0, 0.5, 1.0] {
        assert_eq!(map.sample(Vec2::new(0.0, v)).0, 0.5, "west, v {v}");
        assert_eq!(map.sample(Vec2::new(1.0, v)).0, 0.5, "east, v {v}");
    }
    let step = columns.with_address(Address::Clamp);
    let ends = [0.0, 1.0].map(|u| step.sample(Vec2::new(u, 0.5)).0);
    assert_eq!(ends, [0.0, 1.0], "a clamped image has a step there");
}

/// A surface closes along u only where v goes on.
#[test]
fn a_seam_that_turns_is_not_closed() {
    let text = "s off\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv -1 0 1\nv 0 -1 1\nvt 0 0\nvt 1 0\nvt 0 1\nvt 1 0.5\n\
        f 1/1 2/2 3/3\nf 1/4 4/2 5/3\n";
    assert_eq!(obj(text).address, [Address::Clamp; 2], "one place, half the image apart");
    let closed = text.replace("vt 1 0.5", "vt 1 0");
    assert_eq!(obj(&closed).address, [Address::Repeat, Address::Clamp], "one place, once around");
}
