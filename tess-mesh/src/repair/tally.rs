//! Notes on changes to a model: what was changed, how often, and where first.

/// A number with its noun, as notes have it: `1 point`, `2 points`, `3 patches`.
#[must_use]
pub fn counted(number: u64, one: &str) -> String {
    let ending = match number {
        1 => "",
        _ if one.ends_with("ch") => "es",
        _ => "s",
    };
    format!("{number} {one}{ending}")
}

/// A count of changes, and the place of the first one.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tally {
    count: u64,
    first: String,
}

impl Tally {
    /// Counts one change at a place, such as `line 12`.
    pub(crate) fn add(&mut self, place: impl FnOnce() -> String) {
        if self.count == 0 {
            self.first = place();
        }
        self.count += 1;
    }

    /// A count of changes; the first one is at this place.
    pub(crate) fn of(count: usize, first: impl FnOnce() -> String) -> Self {
        let first = if count == 0 { String::new() } else { first() };
        Self { count: count as u64, first }
    }

    /// The number of changes.
    pub(crate) const fn count(&self) -> u64 {
        self.count
    }

    /// The note, such as `2 faces without area: left out (first: line 12)`; `None` if the count is
    /// 0.
    pub(crate) fn note(&self, noun: &str, rest: &str, done: &str) -> Option<String> {
        let Self { count, first } = self;
        let things = counted(*count, noun);
        (*count > 0).then(|| format!("{things}{rest}: {done} (first: {first})"))
    }
}
