//! How much room a stage has for its output.

use super::builder::Points;
use tess_gpu::{Capacity, Setup};

/// How much room a stage has for points and indices.
///
/// A stage that stores neither ([`Points::PullWithoutIndices`]) takes 4 bytes for each 2048 of
/// either, so that [`Room::WorstCase`] costs it little.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Room {
    /// For all patches with all factors at their greatest: everything always fits.
    WorstCase,
    /// For as much as fits so many bytes of points and indices together, in the proportion of patches of
    /// factor 8.
    Bytes(u64),
    /// For exactly this.
    Exactly(Capacity),
    /// For patches of factor 4 at first. When a frame needs more, a later one has it: the stage learns what
    /// was needed without waiting and makes larger buffers, up to so many bytes.
    Automatic {
        /// The most bytes of points and indices together.
        most_bytes: u64,
    },
}

/// What becomes of a frame whose output does not fit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Overflow {
    /// All factors are scaled down by one number, on the device, until everything fits. Edges stay closed. If even
    /// factors of 1 give too much, nothing is drawn.
    #[default]
    Coarser,
    /// Nothing is drawn.
    DrawNothing,
}

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
            Room::Bytes(bytes) => self.largest(bytes, uniform(8.0)),
            Room::Automatic { most_bytes } => self.at_most(most_bytes, uniform(4.0)),
        }
    }

    /// The room for frames that need so many points and primitives, if it is another.
    pub(crate) fn grown(self, room: Room, now: Capacity, needed: [u64; 2]) -> Option<Capacity> {
        let Room::Automatic { most_bytes } = room else { return None };
        let [points, primitives] = needed;
        if points <= u64::from(now.points) && primitives <= u64::from(now.primitives) {
            return None;
        }
        let more = |needed: u64| u32::try_from(needed.saturating_mul(5) / 4).unwrap_or(u32::MAX);
        let wanted = Capacity { points: more(points), primitives: more(primitives) };
        let least = Capacity {
            points: wanted.points.max(now.points),
            primitives: wanted.primitives.max(now.primitives),
        };
        let grown = self.at_most(most_bytes, self.possible(least));
        (grown != now).then_some(grown)
    }

    /// This room, or in the same proportion as much as so many bytes hold.
    fn at_most(self, bytes: u64, wanted: Capacity) -> Capacity {
        if self.bytes(wanted) <= u128::from(bytes) { wanted } else { self.largest(bytes, wanted) }
    }

    /// The room that so many bytes hold, in the proportion of `shape`.
    fn largest(self, bytes: u64, shape: Capacity) -> Capacity {
        let whole = self.bytes(shape);
        if whole == 0 {
            return Capacity::worst_case(self.setup, self.patches);
        }
        let part = |elements: u32| {
            u32::try_from(u128::from(elements) * u128::from(bytes) / whole).unwrap_or(u32::MAX)
        };
        self.possible(Capacity { points: part(shape.points), primitives: part(shape.primitives) })
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
        let most = form.grown(room, more, [40_000, 80_000]).expect("nor does this");
        let used = 8 * u64::from(most.points) + 12 * u64::from(most.primitives);
        assert!(used <= 100_000 && used + 20 > 100_000, "{most:?}");
        assert_eq!(form.grown(room, most, [40_000, 80_000]), None, "there is no more");
        assert_eq!(form.grown(Room::Bytes(9), first, [300, 320]), None, "only if asked for");
    }
}
