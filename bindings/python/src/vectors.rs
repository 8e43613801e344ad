//! Test vectors: generated, read, written and checked.

use crate::arrays::{copied, exact_words, fixed_array};
use crate::coverage::Coverage;
use crate::errors::{self, argument, file_format};
use crate::names::{named, whole, whole_or_none};
use crate::patch::Patch;
use crate::signals::{self, Raised, Watch, Watched};
use crate::strength::{one_of, strength};
use crate::values;
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use std::fs::File;
use std::io::{BufReader, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use tess_core::{DomainPoint, Tessellation};
use tess_verify::check::{CheckError, Known, Report, Strength, Tested, check_asked};
use tess_verify::generate::{GenLevel, Selection, Shard};
use tess_verify::vectors::{Header, Kind, Listing, write_cases};
use tess_verify::{Backend, Case, CoreBackend, Named};

/// Cases; `None` for each one that belongs to another shard.
type CaseSource = Box<dyn Iterator<Item = Option<Case>> + Send>;

/// An iterator over generated patches, the result of :func:`generate`.
#[pyclass(frozen, module = "tess_model")]
pub(crate) struct Cases {
    source: Mutex<CaseSource>,
    /// Number of patches returned. `list` takes them without a step of the interpreter in between.
    given: AtomicU32,
}

#[pymethods]
impl Cases {
    fn __iter__(slf: Py<Self>) -> Py<Self> {
        slf
    }

    fn __next__(&self, py: Python<'_>) -> PyResult<Option<Patch>> {
        if self.given.fetch_add(1, Ordering::Relaxed).is_multiple_of(signals::STEPS) {
            py.check_signals()?;
        }
        let mut watch = Watch::default();
        // Any number of other shards' patches may separate two patches of this shard.
        let next = py.detach(|| {
            let mut cases = self.source.lock().unwrap_or_else(PoisonError::into_inner);
            cases.by_ref().take_while(|_| watch.goes_on()).find_map(|case| case)
        });
        watch.finish().map(|()| next.map(|case| Patch { case }))
    }
}

/// Generates test patches, in the order of ``tess gen``. The same arguments give the same patches.
///
/// Args:
///     level: 1: every boundary once, which hits every coverage bin; 2: every boundary in every
///         position; 3: only random patches.
///     seed: Seed of everything random.
///     count: Number of random patches at the end; ``None``: 500, 20000 or 1000000 by level.
///     domain, partitioning, output, split: One name; ``None``: all.
///     shard: ``(i, n)``, i in 1..n: one of n disjoint parts; ``None``: all patches.
///     rules: Whether to generate families of patches that :func:`check_rules` compares, instead
///         of a level.
///
/// >>> import tess_model
/// >>> len(list(tess_model.generate(level=3, count=10, domain="tri")))
/// 10
#[pyfunction]
#[pyo3(signature = (level = 1, *, seed = 1, count = None, domain = None, partitioning = None,
    output = None, split = None, shard = None, rules = false))]
#[expect(clippy::too_many_arguments, reason = "they are named in Python")]
pub(crate) fn generate(
    #[pyo3(from_py_with = whole)] level: u8,
    #[pyo3(from_py_with = whole)] seed: u64,
    #[pyo3(from_py_with = whole_or_none)] count: Option<u64>,
    domain: Option<&str>,
    partitioning: Option<&str>,
    output: Option<&str>,
    split: Option<&str>,
    #[pyo3(from_py_with = part_of_all)] shard: Option<(u64, u64)>,
    rules: bool,
) -> PyResult<Cases> {
    let level = match level {
        1 if rules => GenLevel::Rules,
        other if rules => return Err(argument(format!("rules have no level {other}"))),
        1 => GenLevel::One,
        2 => GenLevel::Two,
        3 => GenLevel::Three,
        other => return Err(argument(format!("the levels are 1, 2 and 3, not {other}"))),
    };
    let (part, of) = shard.unwrap_or((1, 1));
    if !(1..=of).contains(&part) {
        return Err(argument(format!("a shard is (i, n) with i from 1 to n, not ({part}, {of})")));
    }
    let shard = Shard { part: part - 1, of };
    let domain = domain.map(named).transpose()?;
    let partitioning = partitioning.map(named).transpose()?;
    let (output, split) = (output.map(named).transpose()?, split.map(named).transpose()?);
    let all = Selection::level(level, seed);
    let cases = Selection { random: count, domain, partitioning, output, split, ..all }.cases();
    let numbered = (0..).zip(cases);
    let chosen = numbered.map(move |(i, case)| shard.has(i).then_some(case));
    Ok(Cases { source: Mutex::new(Box::new(chosen)), given: AtomicU32::new(0) })
}

/// The argument `shard`: two whole numbers, or `None`.
fn part_of_all(shard: &Bound<'_, PyAny>) -> PyResult<Option<(u64, u64)>> {
    shard.extract().map_err(|_| argument("a shard is (i, n) with i from 1 to n"))
}

/// Writes a vector file with the model's results, as ``tess gen`` does.
///
/// Args:
///     path: The file.
///     patches: The patches, at least one.
///     form: ``patches``, a row of counts and digests per patch, or ``listings``, whole outputs.
#[pyfunction]
#[pyo3(signature = (path, patches, *, form = "patches"))]
pub(crate) fn write_vectors(
    py: Python<'_>,
    path: PathBuf,
    patches: &Bound<'_, PyAny>,
    form: &str,
) -> PyResult<()> {
    let kind = one_of("form", form, &[("patches", Kind::Patches), ("listings", Kind::Listings)])?;
    let cases = patches_of(patches)?;
    let source = "tess-core".to_owned();
    let header = Header { kind, count: Some(cases.len() as u64), source, notes: Vec::new() };
    let written = signals::interruptible(py, move |stop| {
        let file = Watched::new(File::create(path)?, Arc::clone(&stop));
        let mut file = BufWriter::new(file);
        let cases = cases.into_iter().take_while(|_| !stop.load(Ordering::Relaxed));
        write_cases(&mut file, &header, cases)?;
        file.flush()
    });
    Ok(written??)
}

/// The cases of an iterable of patches, at least one.
fn patches_of(patches: &Bound<'_, PyAny>) -> PyResult<Vec<Case>> {
    let case = |patch: &Bound<'_, PyAny>| Ok(patch.cast::<Patch>()?.get().case);
    all_of(patches, case, "at least one patch is needed")
}

/// The results of `each` for the elements of an iterable. Errors: the message `none` if the
/// iterable is empty; signals.
fn all_of<T>(
    iterable: &Bound<'_, PyAny>,
    each: impl Fn(&Bound<'_, PyAny>) -> PyResult<T>,
    none: &str,
) -> PyResult<Vec<T>> {
    let mut watch = Watch::default();
    let elements = iterable.try_iter()?.take_while(|_| watch.goes_on());
    let all: Vec<T> = elements.map(|element| each(&element?)).collect::<PyResult<_>>()?;
    watch.finish()?;
    if all.is_empty() { Err(argument(none)) } else { Ok(all) }
}

/// A vector file: an iterator over its :class:`Record` s. The reader is strict; a file that is
/// truncated, too long or malformed raises :class:`FileFormatError`.
#[pyclass(frozen, module = "tess_model")]
pub(crate) struct VectorFile {
    /// Kind of the records: ``listings``, ``patches``, ``sweep``, ...
    #[pyo3(get)]
    kind: &'static str,
    /// The number of records; ``None`` if the file marks its end instead.
    #[pyo3(get)]
    count: Option<u64>,
    /// The source of the results, a name for readers.
    #[pyo3(get)]
    source: String,
    records: Mutex<Reader>,
    raised: Raised,
}

#[pymethods]
impl VectorFile {
    #[new]
    fn new(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let (file, raised) = signals::interruptible(py, move |stop| open(&path, stop))??;
        let header = file.header();
        let (kind, count, source) = (header.kind.name(), header.count, header.source.clone());
        Ok(Self { kind, count, source, records: Mutex::new(file), raised })
    }

    fn __iter__(slf: Py<Self>) -> Py<Self> {
        slf
    }

    fn __next__(&self, py: Python<'_>) -> PyResult<Option<Record>> {
        py.check_signals()?;
        let next = py.detach(|| self.records.lock().unwrap_or_else(PoisonError::into_inner).next());
        if let Some(error) = self.raised.lock().unwrap_or_else(PoisonError::into_inner).take() {
            return Err(error);
        }
        next.transpose().map(|record| record.map(Record)).map_err(file_format)
    }

    fn __repr__(&self) -> String {
        let count = self.count.map_or(String::new(), |count| format!("{count} "));
        format!("<VectorFile: {count}{} from {}>", self.kind, self.source)
    }
}

/// A vector file whose reader can be interrupted.
pub(crate) type Reader = tess_verify::vectors::VectorFile<BufReader<Watched>>;

/// Opens a vector file and reads its first line.
pub(crate) fn open(path: &Path, stop: Arc<AtomicBool>) -> PyResult<(Reader, Raised)> {
    let file = Watched::new(File::open(path)?, stop);
    let raised = file.raised();
    let name = path.display().to_string();
    let reader = tess_verify::vectors::VectorFile::new(name, BufReader::new(file));
    reader.map(|reader| (reader, raised)).map_err(file_format)
}

/// One record of a vector file.
#[pyclass(frozen, module = "tess_model")]
pub(crate) struct Record(tess_verify::vectors::Record);

#[pymethods]
impl Record {
    /// The line of the file on which the record starts, from 1.
    #[getter]
    fn line(&self) -> u64 {
        self.0.line()
    }

    /// The row of the file; ``None`` for a listing.
    #[getter]
    fn text(&self) -> Option<&str> {
        self.0.text()
    }

    /// Its patch; ``None`` for a row of digests over many patches.
    #[getter]
    fn patch(&self) -> Option<Patch> {
        self.0.case().map(|case| Patch { case })
    }

    /// The recorded points of a listing, uint32 of shape (points, 2), 16.16; else ``None``.
    #[getter]
    fn points<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray2<u32>>> {
        Some(fixed_array(py, &self.listing()?.output.points))
    }

    /// The recorded indices of a listing, uint32 of shape (indices,); else ``None``.
    #[getter]
    fn indices<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray1<u32>>> {
        Some(PyArray1::from_slice(py, &self.listing()?.output.indices))
    }

    fn __repr__(&self) -> String {
        let text = self.text().map(str::to_owned);
        let what = text.or_else(|| self.0.case().map(|case| case.to_string()));
        format!("<Record at line {}: {}>", self.0.line(), what.unwrap_or_default())
    }
}

impl Record {
    fn listing(&self) -> Option<&Listing> {
        match &self.0 {
            tess_verify::vectors::Record::Listing(listing) => Some(listing),
            _ => None,
        }
    }
}

/// Checks a vector file, as ``tess check`` does. A file of listings holds a device's answers, which
/// are compared with the model. A file of any other kind, or any file with ``tested="model"``, is
/// taken as correct, and the model is tested against it.
///
/// ``order``, ``elements``, ``conversion`` and ``denormals`` set the strength of a comparison with
/// a device (docs/verification.md). They are refused if the model is tested.
///
/// Args:
///     path: The file.
///     tested: ``auto`` or ``model``.
///     order: ``exact``; ``sequence``, the model's order, with points identified by their
///         coordinates; or ``any``.
///     elements: ``primitives``, or ``points`` to compare only the points.
///     conversion: ``exact`` or ``0.6ulp``.
///     denormals: ``keep`` or ``flush``.
///     coverage: A :class:`Coverage` that records the bins that the file's patches hit.
///     cases: The patches that the device was asked for. The file must answer each of them, in
///         order.
///
/// Returns:
///     A :class:`Report`.
#[pyfunction]
#[pyo3(signature = (path, *, tested = "auto", order = "exact", elements = "primitives",
    conversion = "exact", denormals = "keep", coverage = None, cases = None))]
#[expect(clippy::too_many_arguments, reason = "they are named in Python")]
pub(crate) fn check<'py>(
    py: Python<'py>,
    path: PathBuf,
    tested: &str,
    order: &str,
    elements: &str,
    conversion: &str,
    denormals: &str,
    coverage: Option<&Bound<'py, Coverage>>,
    cases: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let strength = strength(order, elements, conversion, denormals)?;
    let asked = cases.map(patches_of).transpose()?;
    let model = one_of("tested", tested, &[("auto", false), ("model", true)])?;
    let coverage = coverage.map(|coverage| coverage.get().shared());
    let report = signals::interruptible(py, move |stop| {
        let (file, _) = open(&path, stop)?;
        let tested = if file.header().kind == Kind::Listings && !model {
            Tested::Listings(strength)
        } else if strength == Strength::default() {
            Tested::Backend
        } else {
            return Err(argument(
                "order, elements, conversion and denormals are for listings of a device",
            ));
        };
        run_check(file, tested, asked, coverage.as_ref()).map_err(errors::check)
    })?;
    values::report(py, &report?)
}

/// Checks on all processors.
fn run_check(
    file: Reader,
    tested: Tested,
    asked: Option<Vec<Case>>,
    coverage: Option<&Coverage>,
) -> Result<Report, CheckError> {
    let mut asked = asked.map(|asked| asked.into_iter().map(Ok));
    let asked = asked.as_mut().map(|asked| asked as _);
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let mut backends: Vec<Box<dyn Backend>> =
        (0..threads).map(|_| Box::new(CoreBackend) as Box<dyn Backend>).collect();
    check_asked(file, asked, &Known::default(), &mut backends, tested, &|checked| {
        if let Some(coverage) = coverage {
            let mut coverage = coverage.lock();
            let cases = checked.records.iter().filter_map(tess_verify::vectors::Record::case);
            coverage.record_stream(checked.before, cases);
        }
    })
}

/// Compares a device's answers with the model.
///
/// Args:
///     answers: Tuples (patch, points, indices): a :class:`Patch`, integers of shape (points, 2) in
///         16.16, and integers of any shape whose elements in order are the indices. At least one.
///         Arrays of uint32 are the fastest; arrays of other integer types and lists are accepted
///         if every element is in 0..2**32 - 1.
///     order, elements, conversion, denormals: As for :func:`check`.
///     cases: The patches that the device was asked for. Answers for other patches, too few or too
///         many raise :class:`ArgumentError`.
///
/// >>> from tess_model import Patch, check_device
/// >>> patch = Patch("tri", outer=[2, 2, 2], inner=2)
/// >>> points, indices = patch.points, patch.indices
/// >>> check_device([(patch, points, indices)]).equal
/// True
/// >>> points[3, 0] += 1
/// >>> print(check_device([(patch, points, indices)]).differences[0].text)
/// record 1: case tri integer triangle_cw ruler 40000000 40000000 40000000 40000000
///   point 3 u: observed 0x08001, expected 0x08000 (stage: location)
#[pyfunction]
#[pyo3(signature = (answers, *, order = "exact", elements = "primitives", conversion = "exact",
    denormals = "keep", cases = None))]
pub(crate) fn check_device<'py>(
    py: Python<'py>,
    answers: &Bound<'py, PyAny>,
    order: &str,
    elements: &str,
    conversion: &str,
    denormals: &str,
    cases: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let strength = strength(order, elements, conversion, denormals)?;
    let answers = device_answers(answers)?;
    if let Some(cases) = cases {
        require_answers(&patches_of(cases)?, &answers)?;
    }
    let mut watch = Watch::default();
    let answers = answers.into_iter().take_while(|_| watch.goes_on());
    let report = py.detach(|| tess_verify::check::check_device(answers, strength));
    watch.finish()?;
    values::report(py, &report)
}

/// Answers of a device, at least one.
pub(crate) fn device_answers(answers: &Bound<'_, PyAny>) -> PyResult<Vec<(Case, Tessellation)>> {
    all_of(answers, device_answer, "there is no answer to check")
}

/// Refuses answers for cases other than the requested ones.
fn require_answers(asked: &[Case], answers: &[(Case, Tessellation)]) -> PyResult<()> {
    let pairs = asked.iter().zip(answers).enumerate();
    for (number, (asked, (answered, _))) in pairs {
        if asked != answered {
            let number = number + 1;
            return Err(argument(format!("answer {number} is for {answered}; asked was {asked}")));
        }
    }
    let (asked, answers) = (asked.len(), answers.len());
    let message = format!("{answers} answers for {asked} cases");
    if asked == answers { Ok(()) } else { Err(argument(message)) }
}

fn device_answer(answer: &Bound<'_, PyAny>) -> PyResult<(Case, Tessellation)> {
    let (patch, points, indices): (Bound<'_, Patch>, Bound<'_, PyAny>, Bound<'_, PyAny>) = answer
        .extract()
        .map_err(|_| argument("an answer is (patch, points, indices): a Patch and two arrays"))?;
    let points = exact_words("points of shape (.., 2)", &points)?;
    let rows = points.try_readonly().map_err(argument)?;
    let rows = rows.as_array();
    let points = match rows.shape() {
        [_, 2] => {
            copied(rows.rows().into_iter().map(|row| DomainPoint::from_bits(row[0], row[1])))?
        }
        _ if rows.is_empty() => Vec::new(),
        _ => {
            return Err(argument(format!(
                "points must be of shape (.., 2), not {:?}",
                rows.shape()
            )));
        }
    };
    let flat = exact_words("indices", &indices)?;
    let indices = copied(flat.try_readonly().map_err(argument)?.as_array().iter().copied())?;
    Ok((patch.get().case, Tessellation { points, indices }))
}
