//! Buffers of which only what changes is written.

use bevy::render::render_resource::Buffer;
use bevy::render::renderer::RenderQueue;
use std::ops::Range;

/// A buffer, and the words that are in it.
#[derive(Debug)]
pub(crate) struct Mirror {
    pub(crate) buffer: Buffer,
    words: Vec<u32>,
}

/// Runs with fewer equal words between them are one: a write costs more than these words.
const APART: usize = 64;

impl Mirror {
    /// A buffer with these words.
    pub(crate) const fn new(buffer: Buffer, words: Vec<u32>) -> Self {
        Self { buffer, words }
    }

    /// Writes the words that differ from those before, which are as many.
    pub(crate) fn update(&mut self, words: Vec<u32>, queue: &RenderQueue) {
        for run in changed(&self.words, &words) {
            queue.write_buffer(
                &self.buffer,
                4 * run.start as u64,
                bytemuck::cast_slice(&words[run]),
            );
        }
        self.words = words;
    }
}

fn changed(old: &[u32], new: &[u32]) -> Vec<Range<usize>> {
    let mut runs: Vec<Range<usize>> = Vec::new();
    for at in (0..new.len()).filter(|&at| old[at] != new[at]) {
        match runs.last_mut() {
            Some(run) if at - run.end < APART => run.end = at + 1,
            _ => runs.push(at..at + 1),
        }
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_are_what_differs() {
        let old = vec![7; 200];
        let with = |places: &[usize]| {
            let mut new = old.clone();
            places.iter().for_each(|&at| new[at] = 8);
            changed(&old, &new)
        };
        assert_eq!(with(&[]).len(), 0, "nothing differs");
        assert_eq!(with(&[0, 2, 3]), [0..4], "one word between them");
        assert_eq!(with(&[0, 64]), [0..65], "63 words between them");
        assert_eq!(with(&[0, 65, 199]), [0..1, 65..66, 199..200], "64 words between them");
    }
}
