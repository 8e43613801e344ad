//! Decides how much room a stage has for points and primitives.
//!
//! A stage's buffers are made before anybody knows how much output its frames have. This file
//! chooses their sizes when the stage is built ([`Form::initial`], [`Form::first`]). With
//! [`Room::Automatic`], `TessellationStage::prepare` asks it again in each frame, with the latest
//! feedback: for more room when a frame needed nearly all of it ([`Form::grown`]), and for less
//! when many frames needed little ([`Lull::shrunk`]).
//!
//! # The data
//!
//! ```text
//! budget in bytes (Room::Bytes, Room::Automatic)
//! |<------------- least ------------->|<--------- beyond --------->| rest, less than one of each
//! | points x 8 B | primitives x 12 B  | points x 8 B | primitives  |
//!
//! initial:  least = all patches at factor 1     beyond = up to factor 4 (Automatic), in the proportion of 8 (Bytes)
//! grown:    least = the present room            beyond = up to 5/2 of what a frame needed
//! shrunk:   least = the initial room            beyond = up to 5/2 of the most that 1024 frames needed
//!
//! share of the room that a frame needs:   up to 1/5   1024 such frames in a row shrink the room
//!                                         2/5         the share right after the room has changed
//!                                         over 7/8    the room grows before the next frame
//! ```
//!
//! A point takes 8 bytes, plus those of a vertex if points are evaluated; it takes none if the
//! vertex shader computes it. A primitive takes 4 bytes for each of its corners, or none without an
//! index buffer.
//!
//! # One stage
//!
//! Ten quads, `Automatic` with a budget of 100 000 bytes:
//!
//! ```text
//! event                                                            points   triangles    bytes
//! first room: ten quads at factor 4                                   250         320    5 840
//! a frame needs 219 points (over 7/8 of 250) and 280 triangles:
//!     room for 5/2 of both                                            547         700   12 776
//! a frame needs 40 000 points and 80 000 triangles, 1.28 MB:
//!     both grow until less than 20 bytes of the budget are left
//! ```
//!
//! What is left of the budget is divided in the proportion of what is missing. After that the room
//! stays until frames need little. The test `automatic_room_grows_ahead_and_no_further` computes
//! these numbers.
//!
//! # What must hold
//!
//! - A frame fits if each frame's output is at most 4 % above the last one's: feedback is up to two
//!   frames late, and 1.04^3 < 8/7.
//! - A dimension that was short at least doubles (5/2 of 7/8 is 2.19), unless the budget or the
//!   most that frames can need ends it. So the number of reallocations is logarithmic.
//! - A dimension that shrinks becomes at most half as large, or as small as the initial room. It
//!   never becomes smaller than that, so small scenes do not reallocate.
//! - A room that uses up its budget does not grow.
//! - If the budget holds all patches at factor 1, the room does too.
//!   [`Overflow::Coarser`](super::Overflow::Coarser) scales factors down to 1, so every frame is
//!   then drawn.
//! - No buffer exceeds the device's limit, rounded down to a multiple of 8, because an index
//!   buffer's length is rounded up to one.

use super::choices::{Points, Room};
use tess_gpu::sizes::SHORT_PATCHES;
use tess_gpu::{Capacity, Setup, Stage};

/// The parameters that determine the sizes of a stage's buffers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Form {
    pub(crate) setup: Setup,
    pub(crate) points: Points,
    /// Bytes of a vertex that is stored; 0 unless points are evaluated.
    pub(crate) vertex_bytes: u32,
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

    /// The initial room; with [`Room::Automatic`] at least `least`, as far as the budget allows.
    pub(crate) fn first(self, room: Room, least: Capacity) -> Capacity {
        match room {
            Room::Automatic { most_bytes } => {
                self.at_most(most_bytes, self.initial(room), self.possible(least))
            }
            _ => self.initial(room),
        }
    }

    /// The larger room to make after a frame that needed this many points and primitives, or `None`
    /// if `now` is large enough or cannot grow.
    pub(crate) fn grown(self, room: Room, now: Capacity, needed: [u64; 2]) -> Option<Capacity> {
        let Room::Automatic { most_bytes } = room else { return None };
        let most = self.possible(Capacity { points: u32::MAX, primitives: u32::MAX });
        let is_short = |needed: u64, now: u32, most: u32| {
            now < most && needed.saturating_mul(8) > u64::from(now) * 7
        };
        let is_short = is_short(needed[0], now.points, most.points)
            || is_short(needed[1], now.primitives, most.primitives);
        if !is_short || self.uses(most_bytes, now) {
            return None;
        }
        let grown = self.at_most(most_bytes, now, self.ample(needed));
        (grown != now).then_some(grown)
    }

    /// A room of which frames with these needs use two fifths, or as much as is possible.
    fn ample(self, needed: [u64; 2]) -> Capacity {
        let more = |needed: u64| u32::try_from(needed.saturating_mul(5) / 2).unwrap_or(u32::MAX);
        self.possible(Capacity { points: more(needed[0]), primitives: more(needed[1]) })
    }

    /// Whether a room uses up a budget: what is left does not hold one point and one primitive.
    fn uses(self, budget: u64, room: Capacity) -> bool {
        let [point, primitive] = self.element_bytes().map(u128::from);
        self.bytes(room) + point + primitive > u128::from(budget) && self.element_bytes() != [0, 0]
    }

    /// The greater of `least` and `wanted` in each dimension, or as much of it as the budget holds.
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

    /// The room that fills a budget: `least`, and the rest divided in the proportion in which
    /// `shape` exceeds `least`. If the budget does not hold `least`, the room is a part of `least`.
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
        // A stage without patches has 0 bytes to divide; 1 keeps the division defined.
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

    /// The part of a room that frames can ever need and that buffers can hold.
    fn possible(self, room: Capacity) -> Capacity {
        let worst = Capacity::worst_case(self.setup, self.patches);
        let of = |each: u32| match u64::from(each) {
            0 => u32::MAX,
            each => u32::try_from((self.buffer_limit - self.buffer_limit % 8) / each)
                .unwrap_or(u32::MAX),
        };
        let (point_bytes, primitive_bytes) = (self.packed_bytes(), self.element_bytes()[1]);
        Capacity {
            points: room.points.min(worst.points).min(of(point_bytes.max(self.vertex_bytes))),
            primitives: room.primitives.min(worst.primitives).min(of(primitive_bytes)),
        }
    }

    /// All shaders that batches of this form may run, with any room and any groups, for this number
    /// of patches or more. They are compiled when the stage is built, so that no frame has to.
    pub(crate) fn stages(self) -> Vec<Stage> {
        use Stage::{
            ExpandPoints, ExpandPrimitives, ExpandShort, Factors, Groups, List, Partition, Scan,
            Short, Totals,
        };
        let mut all = vec![Factors, Scan, Totals, Partition, Groups];
        if self.points.are_written() {
            all.push(ExpandPoints);
        }
        if self.points.has_indices() {
            all.push(ExpandPrimitives);
            all.extend(self.setup.has_triangles().then_some(List));
        }
        if self.points.are_written() && self.patches <= SHORT_PATCHES {
            all.extend([Short, ExpandShort]);
        }
        all
    }

    /// The most bytes of evaluated vertices that a frame with this room can have.
    pub(crate) fn most_vertex_bytes(self, room: Room) -> u64 {
        let of_points = |points: u32| u64::from(points) * u64::from(self.vertex_bytes);
        match room {
            Room::Automatic { most_bytes } => {
                let most = Capacity { points: u32::MAX, primitives: u32::MAX };
                of_points(self.possible(most).points).min(most_bytes)
            }
            _ => of_points(self.initial(room).points),
        }
    }

    /// Bytes of the raw factors of all patches.
    pub(crate) fn factor_bytes(self) -> u64 {
        4 * u64::from(self.setup.factors()) * u64::from(self.patches)
    }

    /// The stored bytes of a point and of a primitive.
    fn element_bytes(self) -> [u32; 2] {
        [
            self.packed_bytes() + self.vertex_bytes,
            if self.points.has_indices() { self.setup.primitive_bytes() } else { 0 },
        ]
    }

    /// Bytes of a packed point.
    const fn packed_bytes(self) -> u32 {
        if self.points.are_written() { 8 } else { 0 }
    }

    /// Bytes of the buffers of points and indices.
    fn bytes(self, room: Capacity) -> u128 {
        let [points, primitives] = self.element_bytes().map(u128::from);
        u128::from(room.points) * points + u128::from(room.primitives) * primitives
    }
}

/// The frames since one last used more than a fifth of the room.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lull {
    /// Frames after which room is given back.
    pub(crate) patience: u64,
    since: u64,
    most: [u64; 2],
}

impl Lull {
    /// 1024 frames are 17 seconds at 60 frames per second.
    pub(crate) const NEW: Self = Self { patience: 1024, since: 0, most: [0; 2] };

    /// The smaller room to make once the lull has lasted long enough, or `None`. `frame` is the
    /// number of the latest frame and `needed` its points and primitives.
    pub(crate) fn shrunk(
        &mut self,
        (form, room, now): (Form, Room, Capacity),
        (frame, needed): (u64, [u64; 2]),
    ) -> Option<Capacity> {
        let Room::Automatic { most_bytes } = room else { return None };
        let most = [self.most[0].max(needed[0]), self.most[1].max(needed[1])];
        let is_little = |needed: u64, now: u32| needed.saturating_mul(5) <= u64::from(now);
        let is_lull = is_little(most[0], now.points) && is_little(most[1], now.primitives);
        self.most = most;
        if is_lull && frame.saturating_sub(self.since) < self.patience {
            return None;
        }
        (self.since, self.most) = (frame, [0; 2]);
        let shrunk = form.at_most(most_bytes, form.initial(room), form.ample(most));
        (is_lull && shrunk != now).then_some(shrunk)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tess_core::{Config, Domain, OutputPrimitive, Partitioning};

    fn form(points: Points) -> Form {
        let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
        let setup = Setup::new(Domain::Quad, config);
        let vertex_bytes = if points == Points::Evaluated { 32 } else { 0 };
        Form { setup, points, vertex_bytes, patches: 10, buffer_limit: 1 << 30 }
    }

    /// Every stage that a plan runs is compiled ahead.
    #[test]
    fn the_stages_are_those_of_every_plan() {
        use std::collections::HashSet;
        use tess_gpu::{Limits, Plan, Written};
        for points in Points::ALL {
            for patches in [1, 10, 1024, 1025, 1 << 14, 1 << 20] {
                let form = Form { patches, ..form(points) };
                let made = form.stages();
                for elements in [100, 1 << 18, 1 << 20, 1 << 24] {
                    let room = Capacity { points: elements, primitives: elements };
                    let limits = Limits::WEBGPU;
                    let plan = match points {
                        Points::Stored | Points::Evaluated => {
                            Plan::new(form.setup, patches, room, limits)
                        }
                        Points::Pull => {
                            Plan::writing(Written::Indices, form.setup, patches, room, limits)
                        }
                        Points::PullWithoutIndices => {
                            Plan::writing(Written::Arguments, form.setup, patches, room, limits)
                        }
                    };
                    let stages = plan.with_groups(3).dispatches().map(|one| one.stage());
                    let missing: HashSet<_> =
                        stages.filter(|stage| !made.contains(stage)).collect();
                    assert!(missing.is_empty(), "{points:?}, {patches}, {elements}: {missing:?}");
                }
            }
        }
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
    fn automatic_room_grows_ahead_and_no_further() {
        let form = form(Points::Stored);
        let room = Room::Automatic { most_bytes: 100_000 };
        let first = form.initial(room);
        assert_eq!(first, Capacity { points: 250, primitives: 320 }, "factor 4");
        let more = Capacity { points: 251, primitives: 9 };
        assert_eq!(form.first(room, more), Capacity { points: 251, ..first }, "another stage's");
        assert_eq!(form.first(Room::Exactly(first), more), first, "if the stage chooses");
        assert_eq!(form.grown(room, first, [218, 280]), None, "7/8 are not exceeded");
        let more = form.grown(room, first, [219, 280]).expect("points are nearly used");
        assert_eq!(more, Capacity { points: 547, primitives: 700 }, "5/2 of what was needed");
        assert_eq!(
            form.grown(room, first, [218, 281]),
            Some(Capacity { points: 545, primitives: 702 })
        );
        let one = form.grown(room, more, [10, 1000]).expect("primitives do not fit");
        assert_eq!(one, Capacity { points: 547, primitives: 2500 }, "no dimension shrinks");
        let other = form.grown(room, one, [3000, 10]).expect("points do not fit");
        assert_eq!(other, Capacity { points: 7500, primitives: 2500 }, "nor the other");
        let most = form.grown(room, more, [40_000, 80_000]).expect("nor does this");
        let used = 8 * u64::from(most.points) + 12 * u64::from(most.primitives);
        assert!(used <= 100_000 && used + 20 > 100_000, "{most:?}");
        assert_eq!(form.grown(room, most, [40_000, 80_000]), None, "there is no more");
        assert_eq!(form.grown(Room::Bytes(9), first, [300, 320]), None, "only if asked for");
    }

    #[test]
    fn a_dimension_that_can_grow_no_further_leaves_the_other_alone() {
        let form = form(Points::Stored);
        let room = Room::Automatic { most_bytes: 1 << 30 };
        let worst = Capacity::worst_case(form.setup, 10);
        let now = Capacity { primitives: 1000, ..worst };
        for primitives in 500..=875 {
            assert_eq!(form.grown(room, now, [worst.points.into(), primitives]), None);
        }
    }

    #[test]
    fn room_shrinks_after_a_long_lull() {
        let form = form(Points::Stored);
        let room = Room::Automatic { most_bytes: 100_000 };
        let first = form.initial(room);
        let now = Capacity { points: 3000, primitives: 4000 };
        let shrunk = |frames: &[(u64, [u64; 2])]| {
            let mut lull = Lull::NEW;
            let all = frames.iter().map(|&frame| lull.shrunk((form, room, now), frame));
            all.last().expect("some frames")
        };
        let half = Capacity { points: 1500, primitives: 2000 };
        assert_eq!(shrunk(&[(3, [600, 10]), (1023, [5, 800])]), None, "too soon");
        assert_eq!(shrunk(&[(3, [600, 10]), (1024, [5, 800])]), Some(half), "the most of each");
        assert_eq!(shrunk(&[(3, [601, 10]), (1026, [5, 800])]), None, "since the third frame");
        let later = Some(Capacity { points: 250, primitives: 2000 });
        assert_eq!(shrunk(&[(3, [601, 10]), (1027, [5, 800])]), later, "which counts no longer");
        assert_eq!(shrunk(&[(3, [10, 801]), (1024, [5, 80])]), None, "nor is this little");
        assert_eq!(shrunk(&[(1024, [0, 0])]), Some(first), "no less than the first room");
        let of_first = |room| {
            let mut lull = Lull::NEW;
            lull.shrunk((form, room, first), (5000, [0, 0]))
        };
        assert_eq!([of_first(room), of_first(Room::WorstCase)], [None; 2], "nothing to give back");
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
        for points in Points::ALL {
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
        // 40 points and 20 triangles take 560 bytes; patches of factor 8 take 770 points and 1260
        // triangles more.
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
            let evaluated = Form { buffer_limit: limit, ..form(Points::Evaluated) };
            let room = evaluated.initial(Room::Bytes(1 << 30));
            let bytes = 32 * u64::from(room.points);
            assert!(bytes <= limit && bytes + 32 > limit, "{bytes} of {limit} are vertices");
            let form = Form { buffer_limit: limit, ..form(Points::Stored) };
            let room = form.initial(Room::Bytes(1 << 30));
            let bytes = (12 * u64::from(room.primitives)).next_multiple_of(8);
            assert!(bytes <= limit && bytes + 16 > limit, "{bytes} of {limit}");
            assert!(8 * u64::from(room.points) <= limit, "{room:?}");
        }
    }

    /// The decisions for a sequence of demands that `bindings/rooms.txt` records, with which the
    /// hosts in JavaScript and C are compared.
    #[expect(clippy::too_many_lines, reason = "half of them are tables")]
    fn recorded_rooms() -> String {
        use Partitioning::{FractionalEven, FractionalOdd, Integer, Pow2};
        let mut text = String::from(
            "# The rooms that stages decide on. stage: patches, bytes of a packed point, of a vertex and of a primitive, budget,\n\
             # most bytes of a buffer. uniform: a factor, and the points and primitives of a patch with it. first: the room\n\
             # before the first frame. frame: number, points and primitives that it needed, room after it.\n",
        );
        for (domain, partitioning, vertex_bytes, patches, most_bytes, buffer_limit) in [
            (Domain::Quad, Integer, 0, 10, 100_000, 1 << 30),
            (Domain::Triangle, FractionalOdd, 32, 1000, 16 << 20, 1 << 27),
            (Domain::Isoline, Pow2, 0, 64, 20_000, 1 << 27),
            (Domain::Quad, FractionalOdd, 48, 400, 256 << 20, 1_000_004),
            (Domain::Quad, FractionalEven, 48, 20_000_000, 64 << 30, 1 << 40),
            (Domain::Triangle, Integer, 0, 5, 150, 1 << 27),
        ] {
            let config = Config::new(partitioning, OutputPrimitive::TriangleCw);
            let setup = Setup::new(domain, config);
            let points = if vertex_bytes > 0 { Points::Evaluated } else { Points::Stored };
            let form = Form { setup, points, vertex_bytes, patches, buffer_limit };
            let (primitive, room) = (setup.primitive_bytes(), Room::Automatic { most_bytes });
            text += &format!(
                "stage {patches} 8 {vertex_bytes} {primitive} {most_bytes} {buffer_limit}\nuniform"
            );
            for factor in [1, 4, 8, 64] {
                let Capacity { points, primitives } =
                    Capacity::uniform(setup, 1, f32::from(u8::try_from(factor).expect("small")));
                text += &format!(" {factor} {points} {primitives}");
            }
            let mut now = form.initial(room);
            text += &format!("\nfirst {} {}\n", now.points, now.primitives);
            let (mut lull, mut frame) = (Lull::NEW, 0);
            // Sixteenths of the room that are needed of points and of primitives, and frames until
            // then.
            for [of_points, of_primitives, more, later] in [
                [14, 14, 0, 0],
                [14, 3, 1, 1],
                [20, 40, 0, 1],
                [14, 14, 1, 1],
                [1000, 3, 7, 1],
                [2, 1000, 3, 1],
                [16, 16, 0, 1],
                [3, 3, 0, 500],
                [1, 2, 0, 523],
                [1, 2, 0, 1],
                [3, 1, 0, 1024],
                [1, 3, 5, 1100],
                [16, 2, 1, 1],
                [3, 3, 0, 1023],
                [3, 3, 0, 1],
                [1_000_000, 1_000_000, 9, 1],
                [14, 16, 0, 2],
                [0, 0, 0, 1025],
                [0, 0, 0, 1025],
            ] {
                frame += later;
                let of = |share: u64, now: u32| u64::from(now) * share / 16 + more;
                let needed = [of(of_points, now.points), of(of_primitives, now.primitives)];
                let grown = form.grown(room, now, needed);
                now = grown
                    .or_else(|| lull.shrunk((form, room, now), (frame, needed)))
                    .unwrap_or(now);
                let [points, primitives] = needed;
                text += &format!(
                    "frame {frame} {points} {primitives} {} {}\n",
                    now.points, now.primitives
                );
            }
        }
        text
    }

    const RECORDED: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../bindings/rooms.txt");

    #[test]
    fn rooms_are_those_that_other_hosts_are_compared_with() {
        let recorded = std::fs::read_to_string(RECORDED).expect("the record");
        assert_eq!(recorded_rooms(), recorded, "see rooms_are_recorded_on_request");
    }

    #[test]
    #[ignore = "writes bindings/rooms.txt: cargo test -p tess-wgpu --lib -- --ignored rooms"]
    fn rooms_are_recorded_on_request() {
        std::fs::write(RECORDED, recorded_rooms()).expect("written");
    }
}
