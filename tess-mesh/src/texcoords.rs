//! The range of a model's texture coordinates, from which it follows how an image continues.

use crate::repair::polygon::{Place, place};
use crate::repair::tally::Tally;
use glam::Vec2;
use std::collections::HashMap;
use tess_surface::{Address, PolygonMesh};

/// The differences between texture coordinates that count as rounding.
const ROUNDING: f32 = 1e-4;

/// The range of texture coordinates, and where they are missing.
#[derive(Debug)]
pub(crate) struct Range {
    /// Whether an image must repeat along u and along v.
    repeats: [bool; 2],
    /// The faces without texture coordinates.
    pub(crate) missing: Tally,
}

impl Range {
    /// The range of a mesh's texture coordinates; faces are located by `at`.
    pub(crate) fn of(mesh: &PolygonMesh, at: impl Fn(usize) -> String) -> Self {
        let mut range = Self { repeats: [false; 2], missing: Tally::default() };
        let mut firsts: HashMap<Place, Vec2> = HashMap::new();
        for (number, face) in mesh.faces.iter().enumerate() {
            let Some(texcoords) = &face.texcoords else {
                range.missing.add(|| at(number));
                continue;
            };
            for (&position, &index) in face.positions.as_slice().iter().zip(texcoords.as_slice()) {
                let texcoord = mesh.texcoords[index as usize];
                let key = place(mesh.positions[position as usize]);
                let first = *firsts.entry(key).or_insert(texcoord);
                range.add(texcoord, texcoord - first);
            }
        }
        range
    }

    /// Adds texture coordinates, and their difference from others at the same place.
    fn add(&mut self, texcoord: Vec2, difference: Vec2) {
        for axis in 0..2 {
            let is_inside = (-ROUNDING..=1.0 + ROUNDING).contains(&texcoord[axis]);
            // The surface closes: it goes on where the image begins again.
            let turns = difference[axis];
            let is_whole = (turns - turns.round()).abs() < ROUNDING && turns.abs() > 0.5;
            let closes = is_whole && difference[1 - axis].abs() < ROUNDING;
            self.repeats[axis] |= !is_inside || closes;
        }
    }

    /// How an image continues along u and v.
    pub(crate) fn address(&self) -> [Address; 2] {
        self.repeats.map(|repeats| if repeats { Address::Repeat } else { Address::Clamp })
    }
}

/// The note on faces without texture coordinates.
pub(crate) fn note(missing: &Tally, noun: &str) -> Option<String> {
    missing.note(noun, " without texture coordinates", "each gets the whole height image")
}
