//! How much room a stage has for its output.
//!
//! A stage's buffers of points and indices are made before anybody knows how much its frames give. This file decides
//! their sizes: once when the stage is made ([`Form::initial`]), and for [`Room::Automatic`] again when a frame
//! needed more ([`Form::grown`]), which the stage learns from its feedback.
//!
//! # The data
//!
//! ```text
//! budget in bytes (Room::Bytes, Room::Automatic)
//! |<------------- least ------------->|<--------- beyond --------->| rest, less than one of each
//! | points x 8 B | primitives x 12 B  | points x 8 B | primitives  |
//!
//! initial:  least = all patches at factor 1     beyond = up to factor 4 (Automatic), in the proportion of 8 (Bytes)
//! grown:    least = the room that there is      beyond = up to 5/4 of what the frame needed
//! ```
//!
//! A point takes 8 bytes, or none where the vertex shader computes it. A primitive takes 4 bytes for each of its
//! corners, or none without an index buffer.
//!
//! # One stage
//!
//! Ten quads, `Automatic` with a budget of 100 000 bytes. At factor 4 they give 250 points and 320 triangles, which
//! take 5840 bytes: that is the first room. A frame needs 300 points, so the next room is 375 points and, for 5/4 of
//! 320, 400 triangles. Then a frame needs 40 000 points and 80 000 triangles, 1.3 MB: what is left of the budget is
//! divided as 5/4 of these are, and from then on the room stays. The test
//! `automatic_room_grows_to_what_was_needed_and_no_further` computes this.
//!
//! # What must hold
//!
//! - Room never shrinks in either dimension: what fitted once fits for ever.
//! - Room grows by a quarter at least in the dimension that was short, or to the end of the budget. So buffers are made
//!   a logarithmic number of times; a room that followed every frame's proportion was replaced in 59 of 60 frames.
//! - Once the budget is used, nothing grows.
//! - If the budget holds all patches at factor 1, the room does. [`Overflow::Coarser`](super::Overflow::Coarser) scales
//!   factors down to 1, so every frame is drawn then.
//! - No buffer exceeds the device's limit. An index buffer is a multiple of 8 bytes long, so the limit is rounded
//!   down to one.

use super::choices::{Points, Room};
use tess_gpu::{Capacity, Setup};

/// What the bytes of an output depend on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Form {
    pub(crate) setup: Setup,
    pub(crate) points: Points,
    /// The most patches.
    pub(crate) patches: u32,
    /// The most bytes of a buffer.
    pub(crate) buffer_limit: u64,
}

impl Form {
    /// The room before the first frame.
    pub(crate) fn initial(self, room: Room) -> Capacity {
        let uniform = |factor| Capacity::uniform(self.setup, self.patches, factor);
        match room {
            Room::WorstCase => uniform(64.0),
            Room::Exactly(capacity) => capacity,
            Room::Bytes(_) if self.element_bytes() == [0, 0] => uniform(64.0),
            Room::Bytes(bytes) => self.largest(bytes, uniform(1.0), uniform(8.0)),
            Room::Automatic { most_bytes } => {
                self.at_most(most_bytes, uniform(1.0), self.possible(uniform(4.0)))
            }
        }
    }

    /// The room for frames that need this many points and primitives, if it is another.
    pub(crate) fn grown(self, room: Room, now: Capacity, needed: [u64; 2]) -> Option<Capacity> {
        let Room::Automatic { most_bytes } = room else { return None };
        let [points, primitives] = needed;
        let fits = points <= u64::from(now.points) && primitives <= u64::from(now.primitives);
        if fits || self.uses(most_bytes, now) {
            return None;
        }
        let more = |needed: u64| u32::try_from(needed.saturating_mul(5) / 4).unwrap_or(u32::MAX);
        let wanted = self.possible(Capacity { points: more(points), primitives: more(primitives) });
        let grown = self.at_most(most_bytes, now, wanted);
        (grown != now).then_some(grown)
    }

    /// Whether a room leaves less of a budget than one point and one primitive take.
    fn uses(self, budget: u64, room: Capacity) -> bool {
        let [point, primitive] = self.element_bytes().map(u128::from);
        self.bytes(room) + point + primitive > u128::from(budget) && self.element_bytes() != [0, 0]
    }

    /// The greater of `least` and `wanted` in each dimension, or as much of it as a budget holds.
    fn at_most(self, budget: u64, least: Capacity, wanted: Capacity) -> Capacity {
        let whole = Capacity {
            points: least.points.max(wanted.points),
            primitives: least.primitives.max(wanted.primitives),
        };
        if self.bytes(whole) <= u128::from(budget) {
            return whole;
        }
        self.largest(budget, least, whole)
    }

    /// The room that fills a budget: `least`, and beyond it in the proportion in which `shape` exceeds `least`. A
    /// budget that does not hold `least` gives a part of `least`.
    fn largest(self, budget: u64, least: Capacity, shape: Capacity) -> Capacity {
        let (budget, fixed) = (u128::from(budget), self.bytes(least));
        let (base, free, shape) = match budget.checked_sub(fixed) {
            None => (Capacity::default(), budget, least),
            Some(free) => (least, free, shape),
        };
        let beyond = Capacity {
            points: shape.points.saturating_sub(base.points),
            primitives: shape.primitives.saturating_sub(base.primitives),
        };
        // At least 1, as nobody fills a budget without storing anything.
        let whole = self.bytes(beyond).max(1);
        let sum = |base: u32, beyond: u32| {
            let sum = u128::from(base) + u128::from(beyond) * free / whole;
            u32::try_from(sum).unwrap_or(u32::MAX)
        };
        self.possible(Capacity {
            points: sum(base.points, beyond.points),
            primitives: sum(base.primitives, beyond.primitives),
        })
    }

    /// As much of it as can ever be needed and as buffers can have.
    fn possible(self, room: Capacity) -> Capacity {
        let worst = Capacity::worst_case(self.setup, self.patches);
        let of = |each: u32| match u64::from(each) {
            0 => u32::MAX,
            each => u32::try_from((self.buffer_limit - self.buffer_limit % 8) / each)
                .unwrap_or(u32::MAX),
        };
        let [point_bytes, primitive_bytes] = self.element_bytes();
        Capacity {
            points: room.points.min(worst.points).min(of(point_bytes)),
            primitives: room.primitives.min(worst.primitives).min(of(primitive_bytes)),
        }
    }

    /// Bytes of the raw factors of all patches.
    pub(crate) fn factor_bytes(self) -> u64 {
        4 * u64::from(self.setup.factors()) * u64::from(self.patches)
    }

    /// Bytes that are stored of a point and of a primitive.
    fn element_bytes(self) -> [u32; 2] {
        let is_indexed = self.points != Points::PullWithoutIndices;
        [
            if self.points == Points::Stored { 8 } else { 0 },
            if is_indexed { self.setup.primitive_bytes() } else { 0 },
        ]
    }

    /// Bytes of the buffers of points and indices.
    fn bytes(self, room: Capacity) -> u128 {
        let [points, primitives] = self.element_bytes().map(u128::from);
        u128::from(room.points) * points + u128::from(room.primitives) * primitives
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tess_core::{Config, Domain, OutputPrimitive, Partitioning};

    fn form(points: Points) -> Form {
        let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
        Form { setup: Setup::new(Domain::Quad, config), points, patches: 10, buffer_limit: 1 << 30 }
    }

    #[test]
    fn a_budget_is_kept_and_used() {
        for bytes in [0, 100, 5000, 12_345] {
            let room = form(Points::Stored).initial(Room::Bytes(bytes));
            let used = 8 * u64::from(room.points) + 12 * u64::from(room.primitives);
            assert!(used <= bytes && used + 20 > bytes, "{room:?} for {bytes} bytes");
        }
        let worst = form(Points::Stored).initial(Room::WorstCase);
        assert_eq!(form(Points::Stored).initial(Room::Bytes(u64::MAX)), worst, "no more than that");
        let pulled = form(Points::PullWithoutIndices).initial(Room::Bytes(1));
        assert_eq!(pulled, worst, "nothing is stored");
    }

    #[test]
    fn automatic_room_grows_to_what_was_needed_and_no_further() {
        let form = form(Points::Stored);
        let room = Room::Automatic { most_bytes: 100_000 };
        let first = form.initial(room);
        assert_eq!(first, Capacity { points: 250, primitives: 320 }, "factor 4");
        assert_eq!(form.grown(room, first, [250, 320]), None, "it fits");
        let more = form.grown(room, first, [300, 320]).expect("it does not fit");
        assert_eq!(more, Capacity { points: 375, primitives: 400 }, "a quarter more");
        let one = form.grown(room, more, [10, 1000]).expect("primitives do not fit");
        assert_eq!(one, Capacity { points: 375, primitives: 1250 }, "room never shrinks");
        let other = form.grown(room, one, [3000, 10]).expect("points do not fit");
        assert_eq!(
            other,
            Capacity { points: 3750, primitives: 1250 },
            "nor in the other dimension"
        );
        let most = form.grown(room, more, [40_000, 80_000]).expect("nor does this");
        let used = 8 * u64::from(most.points) + 12 * u64::from(most.primitives);
        assert!(used <= 100_000 && used + 20 > 100_000, "{most:?}");
        assert_eq!(form.grown(room, most, [40_000, 80_000]), None, "there is no more");
        assert_eq!(form.grown(Room::Bytes(9), first, [300, 320]), None, "only if asked for");
    }

    #[test]
    fn a_budget_is_used_when_less_is_left_than_a_point_and_a_primitive() {
        let form = form(Points::Stored);
        for (left, expected) in [(19, None), (20, Some(Capacity { points: 251, primitives: 320 }))]
        {
            let room = Room::Automatic { most_bytes: 5840 + left };
            let first = form.initial(room);
            assert_eq!(first, Capacity { points: 250, primitives: 320 }, "5840 bytes");
            assert_eq!(form.grown(room, first, [300, 320]), expected, "{left} bytes are left");
        }
    }

    #[test]
    fn room_that_uses_its_budget_stays() {
        for points in [Points::Stored, Points::Pull] {
            let form = form(points);
            let room = Room::Automatic { most_bytes: 20_000 };
            let mut now = form.initial(room);
            let mut changes = 0;
            for frame in 0..60_u64 {
                let needed = [3000 + 411 * (frame % 7), 4000 + 773 * (frame % 5)];
                if let Some(grown) = form.grown(room, now, needed) {
                    assert!(grown.points >= now.points && grown.primitives >= now.primitives);
                    now = grown;
                    changes += 1;
                }
            }
            assert_eq!(changes, 1, "{points:?}: the budget is used at once");
        }
    }

    #[test]
    fn all_patches_fit_at_factor_1_where_the_budget_allows() {
        for points in [Points::Stored, Points::Pull, Points::PullWithoutIndices] {
            for domain in Domain::ALL {
                for partitioning in Partitioning::ALL {
                    let config = Config::new(partitioning, OutputPrimitive::TriangleCw);
                    let form = Form { setup: Setup::new(domain, config), ..form(points) };
                    let least = Capacity::uniform(form.setup, 10, 1.0);
                    let bytes = u64::try_from(form.bytes(least)).expect("few");
                    for bytes in [bytes, bytes + 1, bytes + 500, 2 * bytes + 100] {
                        let automatic = Room::Automatic { most_bytes: bytes };
                        let first = form.initial(automatic);
                        let grown = form.grown(automatic, first, [90, 90_000]).unwrap_or(first);
                        for room in [form.initial(Room::Bytes(bytes)), first, grown] {
                            let fits =
                                room.points >= least.points && room.primitives >= least.primitives;
                            assert!(fits, "{room:?} of {bytes} bytes for {least:?}");
                            assert!(
                                form.bytes(room) <= u128::from(bytes)
                                    || points == Points::PullWithoutIndices
                            );
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn a_budget_is_divided_as_patches_of_factor_8_would() {
        let form = form(Points::Stored);
        let eight = Capacity::uniform(form.setup, 10, 8.0);
        let bytes = u64::try_from(form.bytes(eight)).expect("few");
        assert_eq!(form.initial(Room::Bytes(bytes)), eight, "exactly theirs");
        let pulled = Form { points: Points::Pull, ..form };
        let triangles = 12 * u64::from(eight.primitives);
        assert_eq!(pulled.initial(Room::Bytes(triangles)), eight, "points take nothing");
        // 40 points and 20 triangles take 560 bytes; patches of factor 8 take 770 points and 1260 triangles more.
        let part = form.initial(Room::Bytes(560 + 7_090));
        assert_eq!(
            part,
            Capacity { points: 40 + 256, primitives: 20 + 419 },
            "a third of the rest"
        );
    }

    #[test]
    fn buffers_keep_within_the_limit_in_whole_8_bytes() {
        for limit in 984..1024 {
            let form = Form { buffer_limit: limit, ..form(Points::Stored) };
            let room = form.initial(Room::Bytes(1 << 30));
            let bytes = (12 * u64::from(room.primitives)).next_multiple_of(8);
            assert!(bytes <= limit && bytes + 16 > limit, "{bytes} of {limit}");
            assert!(8 * u64::from(room.points) <= limit, "{room:?}");
        }
    }
}
