//! The pass `list`: the points and triangles of each topology that has a slot. Only the places are
//! found by slot; the keys become 0 for the next run.

use super::buffers::{Bound, POINTS, PRIMITIVES, Pass, counts, sum};
use super::catalogue::{Catalogue, patch_of};
use super::described::described_point;
use super::expand_points::format_point;
use tess_core::Patch;
use tess_gpu::Resource::Catalogue as Words;

pub(crate) fn list(pass: &Pass<'_>, b: &mut Bound<'_>) {
    let catalogue = Catalogue::new(pass.setup);
    let mut used = [0, 1].map(|kind| b.word(Words, catalogue.used_at + kind));
    let mut taken = Vec::new();
    for slot in 0..catalogue.slots {
        let key = b.word(Words, slot);
        let at = catalogue.places_at + 2 * slot;
        let patch = (key != 0).then(|| patch_of(pass.setup, key));
        let places = match patch {
            Some(_) => [b.left(Words, at), b.left(Words, at + 1)],
            None => [0, 0],
        };
        b.set(Words, at, places[POINTS]);
        b.set(Words, at + 1, places[PRIMITIVES]);
        b.set(Words, slot, 0);
        if let Some(patch) = patch {
            used = sum(used, counts(&patch));
            taken.push((slot, patch, places));
        }
    }
    (0..2).for_each(|kind| b.set(Words, catalogue.used_at + kind, used[kind as usize]));
    b.refused = refusal(&catalogue, &taken, used);
    if b.refused.is_none() {
        for (_, patch, places) in taken.iter().filter(|(.., places)| *places != [0, 0]) {
            write_patch(&catalogue, patch, *places, b);
        }
    }
}

/// Faults in the places that the device chose. Their order is not defined, but elements of two
/// topologies share no word, and places are within the room. If there is room for all, all have a
/// place, and no word is left between them.
fn refusal(
    catalogue: &Catalogue,
    taken: &[(u32, Patch, [u32; 2])],
    used: [u32; 2],
) -> Option<(tess_gpu::Resource, u32, String)> {
    let has_room = (0..2).all(|kind| used[kind] <= catalogue.elements[kind].1);
    for kind in 0..2 {
        let (first, room, words) = catalogue.elements[kind];
        let mut spans: Vec<_> = taken
            .iter()
            .filter(|(.., places)| has_room || *places != [0, 0])
            .map(|(slot, patch, places)| (places[kind], words * counts(patch)[kind], *slot))
            .collect();
        spans.sort_unstable();
        let mut free = first;
        for (place, size, slot) in spans {
            let is_next = if has_room { place == free } else { place >= free };
            if !is_next || place + size > first + words * room {
                let why =
                    format!("slot {slot} has the place {place}, and {free} is the first free word");
                let word = catalogue.places_at + 2 * slot + u32::from(kind == PRIMITIVES);
                return Some((Words, word, why));
            }
            free = place + size;
        }
    }
    None
}

/// Writes the elements of a topology: integer points are those of every patch that has it, other
/// points are described, and a triangle has 10 bits for each vertex.
fn write_patch(catalogue: &Catalogue, patch: &Patch, places: [u32; 2], b: &mut Bound<'_>) {
    let setup = catalogue.setup;
    for (i, point) in (0..).zip(patch.points()) {
        match setup.has_integer_factors() {
            true => {
                let [low, high] = format_point(setup.point_format, point, 0);
                b.set(Words, places[POINTS] + 2 * i, low);
                b.set(Words, places[POINTS] + 2 * i + 1, high);
            }
            false => b.set(Words, places[POINTS] + i, described_point(patch, i)),
        }
    }
    let triangles = patch.tessellate_in(setup.order).indices;
    for (at, [a, b_, c]) in (places[PRIMITIVES]..).zip(triangles.as_chunks().0) {
        b.set(Words, at, a | b_ << 10 | c << 20);
    }
}
