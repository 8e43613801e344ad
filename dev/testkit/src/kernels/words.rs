//! The words of an output, with a name for each, and the first one that differs.

use super::Case;
use std::fmt;
use tess_core::DomainPoint;
use tess_verify::Case as Line;

/// The model's answer: words, and what each of them is.
#[derive(Debug, Default)]
pub struct Words {
    values: Vec<u32>,
    marks: Vec<Mark>,
    points: usize,
    indices: usize,
}

/// Consecutive words of one input.
#[derive(Debug)]
struct Mark {
    end: usize,
    /// The input that determines them; if `None`, each is determined by the input at its place.
    input: Option<usize>,
    /// The names of the words of an element.
    names: &'static [&'static str],
}

impl Words {
    /// Adds the elements of one input, each as many words as there are names.
    pub(crate) fn add(
        &mut self,
        input: usize,
        names: &'static [&'static str],
        values: impl IntoIterator<Item = u32>,
    ) {
        self.values.extend(values);
        self.marks.push(Mark { end: self.values.len(), input: Some(input), names });
    }

    /// Adds one word for each input.
    pub(crate) fn each(
        &mut self,
        names: &'static [&'static str; 1],
        values: impl IntoIterator<Item = u32>,
    ) {
        self.values.extend(values);
        self.marks.push(Mark { end: self.values.len(), input: None, names });
    }

    /// Adds points of one input, as two words each.
    pub(crate) fn points(&mut self, input: usize, points: impl IntoIterator<Item = [u32; 2]>) {
        let before = self.values.len();
        self.add(input, &["u of point", "v of point"], points.into_iter().flatten());
        self.points += (self.values.len() - before) / 2;
    }

    /// Adds indices of one input.
    pub(crate) fn indices(&mut self, input: usize, indices: impl IntoIterator<Item = u32>) {
        let before = self.values.len();
        self.add(input, &["index"], indices);
        self.indices += self.values.len() - before;
    }

    /// The numbers of points and indices.
    pub(crate) const fn sizes(&self) -> [usize; 2] {
        [self.points, self.indices]
    }

    /// The number of words.
    pub fn count(&self) -> usize {
        self.values.len()
    }

    /// The number of elements that a stage makes: points and indices, or if there are none,
    /// locations, patches or numbers.
    pub fn elements(&self) -> usize {
        match (self.points + self.indices, self.marks.last()) {
            (0, Some(Mark { input: None, .. })) => self.marks[0].end,
            (0, Some(Mark { names: [_], .. })) => self.values.len(),
            (0, Some(Mark { input: Some(last), .. })) => last + 1,
            (sizes, _) => sizes,
        }
    }

    /// Changes one bit of a word.
    pub fn spoil(&mut self, word: usize) {
        self.values[word] ^= 1;
    }

    /// Compares an output with the words.
    ///
    /// # Errors
    /// The first difference.
    pub(crate) fn compare(&self, case: &Case, got: &[u32]) -> Result<(), Difference> {
        let different = |i: &usize| self.values.get(*i) != got.get(*i);
        let Some(word) = (0..self.values.len().max(got.len())).find(different) else {
            return Ok(());
        };
        let number = self.marks.partition_point(|mark| mark.end <= word);
        let start = number.checked_sub(1).map_or(0, |before| self.marks[before].end);
        let (what, input) = match self.marks.get(number) {
            None => ("a word behind the output".to_owned(), None),
            Some(&Mark { input: None, names: [name], .. }) => {
                ((*name).to_owned(), Some(word - start))
            }
            Some(Mark { input, names, .. }) => {
                let at = word - start;
                (format!("{} {}", names[at % names.len()], at / names.len()), *input)
            }
        };
        let input = input.map_or_else(|| "none".to_owned(), |input| shown(case, input));
        let [expected, got] = [self.values.get(word).copied(), got.get(word).copied()];
        Err(Difference { what, input, expected, got })
    }
}

/// An input of a case, in the form that repeats it.
fn shown(case: &Case, input: usize) -> String {
    if let Some(&factors) = case.input.patches.get(input) {
        let line = Line { config: case.input.config, factors };
        return format!("patch {input} of {}: {line}", case.patches.len());
    }
    let numbers = &case.input.numbers;
    match numbers.get(input) {
        Some(number) => format!("input {input}: {}", bits(Some(*number))),
        None => format!("input {input}"),
    }
}

/// The first difference between an output and the model's.
#[derive(Debug)]
pub struct Difference {
    what: String,
    input: String,
    expected: Option<u32>,
    got: Option<u32>,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { what, input, expected, got } = self;
        write!(f, "{what}: expected {}, got {}\n    {input}", bits(*expected), bits(*got))
    }
}

/// A word in decimal, in bits, and as a binary32 if it can be one.
fn bits(word: Option<u32>) -> String {
    let Some(word) = word else { return "nothing".to_owned() };
    let float = f32::from_bits(word);
    let is_float = (1e-6..1e6).contains(&float.abs());
    format!(
        "{word} = {word:#010x}{}",
        if is_float { format!(" ({float:?})") } else { String::new() }
    )
}

/// The coordinates of a point.
pub(crate) const fn coordinates(point: DomainPoint) -> [u32; 2] {
    [point.u.to_bits(), point.v.to_bits()]
}
