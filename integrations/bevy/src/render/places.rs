//! The places of a program's entities in its buffers. An entity keeps its place as long as it
//! exists.

use super::extract::Item;
use super::mirror::{Gpu, Growing, changed};
use crate::shape::Shape;
use bevy::log::error;
use bevy::platform::collections::{HashMap, HashSet};
use bevy::render::sync_world::MainEntity;
use std::collections::BTreeMap;
use std::mem::{replace, take};
use std::sync::Arc;

/// The first number of a run, and its length.
type Run = [u32; 2];

/// The numbers below `end` that are free.
#[derive(Debug, Default)]
struct FreeRuns {
    free: BTreeMap<u32, u32>,
    end: u32,
}

impl FreeRuns {
    /// Replaces a run if its length is to change.
    fn resize(&mut self, run: &mut Run, length: usize) -> Result<(), String> {
        if run[1] as usize == length {
            return Ok(());
        }
        self.give(take(run));
        let beyond = || "there are more than 2^32 patches or words".to_owned();
        let length = u32::try_from(length).map_err(|_| beyond())?;
        let found = self.free.iter().find(|&(_, &free)| free >= length);
        let Some((&first, &free)) = found else {
            let end = self.end.checked_add(length).ok_or_else(beyond)?;
            *run = [replace(&mut self.end, end), length];
            return Ok(());
        };
        self.free.remove(&first);
        if free > length {
            self.free.insert(first + length, free - length);
        }
        *run = [first, length];
        Ok(())
    }

    fn give(&mut self, [mut first, length]: Run) {
        if length == 0 {
            return;
        }
        let mut end = first + length;
        end += self.free.remove(&end).unwrap_or(0);
        let before = self.free.range(..first).next_back();
        if let Some((&before, _)) = before.filter(|&(before, free)| before + free == first) {
            self.free.remove(&before);
            first = before;
        }
        if end == self.end {
            self.end = first;
        } else {
            self.free.insert(first, end - first);
        }
    }
}

/// The place of an entity. It has no words if there was no room for it.
#[derive(Debug)]
struct Place {
    shape: Arc<dyn Shape>,
    /// The number of its instance.
    slot: Run,
    patches: Run,
    /// The number of values, followed by the values.
    values: Run,
    words: Option<Run>,
}

/// The entities of a program.
#[derive(Debug, Default)]
pub(crate) struct Places {
    all: HashMap<MainEntity, Place>,
    /// The words of shapes, by the shape's address, and the number of entities that use each.
    words: HashMap<usize, (Run, u32)>,
    slots: FreeRuns,
    patches: FreeRuns,
    values: FreeRuns,
    free_words: FreeRuns,
    /// The instance of each patch.
    pub(crate) owners: Growing,
    /// The words of all shapes.
    pub(crate) shapes: Growing,
    pub(crate) groups: HashMap<MainEntity, u32>,
    /// The first patch of each group. Free patches form groups too, and empty groups follow at the
    /// end.
    pub(crate) begins: Vec<u32>,
    /// The number of times that entities came, went or changed.
    pub(crate) changes: u64,
}

fn address(shape: &Arc<dyn Shape>) -> usize {
    Arc::as_ptr(shape).addr()
}

impl Places {
    pub(crate) const fn patches(&self) -> u32 {
        self.patches.end
    }

    /// The numbers of instances and of values, including free ones.
    pub(crate) const fn sizes(&self) -> [usize; 2] {
        [self.slots.end as usize, self.values.end as usize]
    }

    /// The number of an entity's instance, and its first patch, word and value.
    pub(crate) fn of(&self, entity: MainEntity) -> Option<(usize, [u32; 3])> {
        let place = self.all.get(&entity)?;
        Some((place.slot[0] as usize, [place.patches[0], place.words?[0], place.values[0]]))
    }

    /// Takes the entities of a frame, and uploads the new ones.
    pub(crate) fn refresh(&mut self, items: &[&Item], gpu: &Gpu<'_>) {
        let is_kept = |item: &&&Item| {
            self.all.get(&item.entity).is_some_and(|own| {
                let values = own.values[1] as usize;
                Arc::ptr_eq(&own.shape, &item.shape) && values == 1 + item.values.len()
            })
        };
        let kept: HashSet<_> = items.iter().filter(is_kept).map(|item| item.entity).collect();
        if kept.len() == items.len() && kept.len() == self.all.len() {
            return;
        }
        self.changes += 1;
        let mut left: HashMap<_, _> =
            self.all.extract_if(|entity, _| !kept.contains(entity)).collect();
        for place in left.values().filter(|place| place.words.is_some()) {
            self.words.entry(address(&place.shape)).and_modify(|(_, users)| *users -= 1);
        }
        let there: HashSet<_> = items.iter().map(|item| item.entity).collect();
        for (_, place) in left.extract_if(|entity, _| !there.contains(entity)) {
            self.slots.give(place.slot);
            self.patches.give(place.patches);
            self.values.give(place.values);
        }
        // An entity's new shape may take over the words of its old one.
        self.free_words(&left.values().map(|place| address(&place.shape)).collect());
        for item in items.iter().filter(|item| !kept.contains(&item.entity)) {
            let place = self.place(item, left.remove(&item.entity), gpu);
            self.all.insert(item.entity, place);
        }
        self.free_words(&HashSet::default());
        self.group();
    }

    /// Frees the words of shapes that no entity uses, except those of the `wanted` ones.
    fn free_words(&mut self, wanted: &HashSet<usize>) {
        self.words.retain(|address, (run, users)| {
            let stays = *users > 0 || wanted.contains(address);
            if !stays {
                self.free_words.give(*run);
            }
            stays
        });
    }

    fn place(&mut self, item: &Item, before: Option<Place>, gpu: &Gpu<'_>) -> Place {
        let none = Run::default();
        let shape = Arc::clone(&item.shape);
        let mut place = before.unwrap_or_else(|| Place {
            shape: Arc::clone(&shape),
            slot: none,
            patches: none,
            values: none,
            words: None,
        });
        if let Err(problem) = self.fill(&mut place, item, gpu) {
            error!("a surface cannot be tessellated: {problem}");
            self.patches.give(take(&mut place.patches));
        }
        Place { shape, ..place }
    }

    fn fill(&mut self, place: &mut Place, item: &Item, gpu: &Gpu<'_>) -> Result<(), String> {
        place.words = None;
        let before = (place.slot, place.patches);
        let count = item.shape.patches() as usize;
        self.slots.resize(&mut place.slot, 1)?;
        self.values.resize(&mut place.values, 1 + item.values.len())?;
        self.patches.resize(&mut place.patches, count)?;
        if before != (place.slot, place.patches) {
            self.owners.write(place.patches[0], &vec![place.slot[0]; count], gpu)?;
        }
        // A binding is never empty.
        self.shapes.write(0, &[], gpu)?;
        place.words = Some(self.words_of(&item.shape, &place.shape, gpu)?);
        Ok(())
    }

    /// The words of a shape, which may take the place of the entity's previous one.
    fn words_of(
        &mut self,
        shape: &Arc<dyn Shape>,
        before: &Arc<dyn Shape>,
        gpu: &Gpu<'_>,
    ) -> Result<Run, String> {
        if let Some((run, users)) = self.words.get_mut(&address(shape)) {
            *users += 1;
            return Ok(*run);
        }
        let words = shape.words();
        let fits = |&(run, users): &(Run, u32)| users == 0 && run[1] as usize == words.len();
        let mut run = Run::default();
        let old = match self.words.get(&address(before)).copied().filter(fits) {
            Some((same, _)) => {
                self.words.remove(&address(before));
                run = same;
                before.words()
            }
            None => {
                self.free_words.resize(&mut run, words.len())?;
                Vec::new()
            }
        };
        for part in changed(&old, &words) {
            let at = run[0] + part.start as u32;
            if let Err(problem) = self.shapes.write(at, &words[part], gpu) {
                self.free_words.give(run);
                return Err(problem);
            }
        }
        self.words.insert(address(shape), (run, 1));
        Ok(run)
    }

    fn group(&mut self) {
        let drawn = self.all.iter().filter(|(_, place)| place.patches[1] > 0);
        let mut runs: Vec<_> = drawn.map(|(&entity, place)| (place.patches, entity)).collect();
        runs.sort_unstable_by_key(|(run, _)| *run);
        let groups = self.begins.len();
        self.begins.clear();
        self.groups.clear();
        let mut end = 0;
        for ([first, length], entity) in runs {
            if first > end {
                self.begins.push(end);
            }
            self.groups.insert(entity, self.begins.len() as u32);
            self.begins.push(first);
            end = first + length;
        }
        self.begins.push(end);
        let groups = groups.max(self.begins.len().next_power_of_two());
        self.begins.resize(groups, end);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn freed_runs_are_used_again() {
        let mut runs = FreeRuns::default();
        let take = |runs: &mut FreeRuns, length| {
            let mut run = Run::default();
            runs.resize(&mut run, length).expect("there is room");
            run
        };
        let all = [3, 5, 2, 4].map(|length| take(&mut runs, length));
        assert_eq!(all, [[0, 3], [3, 5], [8, 2], [10, 4]], "one behind another");
        runs.give(all[0]);
        runs.give(all[2]);
        assert_eq!(take(&mut runs, 2), [0, 2], "the first that is long enough");
        runs.give(all[1]);
        assert_eq!(take(&mut runs, 8), [2, 8], "neighbours are one");
        runs.give([10, 4]);
        assert_eq!((runs.free.len(), runs.end), (0, 10), "the last is no gap");
        assert_eq!(take(&mut runs, 0), [0, 0], "nothing is nowhere");
        let mut run = [0, 2];
        assert!(runs.resize(&mut run, 1 << 32).is_err(), "too long");
        assert_eq!((run, take(&mut runs, 2)), ([0, 0], [0, 2]), "it is free then");
    }
}
