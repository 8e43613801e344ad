//! The model of a stage's room and of its growth.

use super::own::{Own, PATIENCE};
use crate::hold::equal;
use crate::scene::PATCHES;
use tess_gpu::Capacity;
use tess_wgpu::Gpu;
use tess_wgpu::stage::Room;

impl Own {
    /// The room that follows `before`, once the stage has the feedback of all frames that ran;
    /// `None` where the budget decides.
    pub(super) fn next_room(&mut self, before: Capacity) -> Option<Capacity> {
        let (Room::Automatic { most_bytes }, Some((frame, needed))) = (self.form.room, self.heard)
        else {
            return Some(before);
        };
        let worst = Capacity::worst_case(self.setup(), PATCHES);
        let ample = |needed: Capacity, least: Capacity| Capacity {
            points: (needed.points * 5 / 2).min(worst.points).max(least.points),
            primitives: (needed.primitives * 5 / 2).min(worst.primitives).max(least.primitives),
        };
        let is_short = |needed, room, worst| room < worst && 8 * needed > 7 * room;
        let is_short = is_short(needed.points, before.points, worst.points)
            || is_short(needed.primitives, before.primitives, worst.primitives);
        let one = self.bytes(Capacity { points: 1, primitives: 1 });
        let is_used = one > 0 && self.bytes(before) + one > most_bytes;
        let wanted = ample(needed, before);
        if is_short && !is_used && wanted != before {
            return (self.bytes(wanted) <= most_bytes).then_some(wanted);
        }
        let (since, most) = self.lull;
        let most = Capacity {
            points: most.points.max(needed.points),
            primitives: most.primitives.max(needed.primitives),
        };
        let is_lull = 5 * most.points <= before.points && 5 * most.primitives <= before.primitives;
        if is_lull && frame < since + PATIENCE {
            self.lull = (since, most);
            return Some(before);
        }
        self.lull = (frame, Capacity::default());
        Some(if is_lull { ample(most, self.first) } else { before })
    }

    /// Checks the room of a frame, after the room `before`.
    pub(super) fn check_room(&mut self, before: Capacity) -> Result<(), String> {
        let now = self.stage.capacity();
        if let Some(expected) = self.next_room(before) {
            return equal("room", now, expected);
        }
        let (Room::Automatic { most_bytes } | Room::Bytes(most_bytes)) = self.form.room else {
            return Err(format!("{:?} has no budget", self.form.room));
        };
        let is_larger = now.points >= before.points && now.primitives >= before.primitives;
        let is_right = is_larger && self.bytes(now) <= most_bytes.max(self.bytes(before));
        if is_right { Ok(()) } else { Err(format!("room {now:?} after {before:?}")) }
    }

    pub(super) fn make_room(&mut self, gpu: &Gpu, count: u32) -> Result<(), String> {
        // Earlier feedback makes room first. If that uses up the budget, nothing is checked.
        let middle = self.next_room(self.stage.capacity());
        let count = count.min(PATCHES);
        self.drawn = None;
        let found = self.stage.make_room(&gpu.queue, count);
        let found = found.map_err(|error| error.to_string())?;
        self.old = self.stage.frame.clone();
        self.groups.clone_from(&self.next_groups);
        self.frame += 1;
        let needed = self.needed(&self.frame_patches(count));
        equal(
            "needed",
            [found.points, found.primitives],
            [needed.points, needed.primitives].map(u64::from),
        )?;
        self.heard = Some((self.frame - 1, needed));
        self.check_room(middle.unwrap_or_else(|| self.stage.capacity()))
    }
}
