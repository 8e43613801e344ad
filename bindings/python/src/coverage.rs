//! Functional coverage as an object.

use crate::errors::{argument, file_format};
use crate::names::{named, whole};
use crate::patch::Patch;
use crate::signals::{self, Watched};
use crate::{stages, values};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyType};
use std::fs::File;
use std::io::{ErrorKind, Write};
use std::path::PathBuf;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use tess_verify::cover::Exclusions;
use tess_verify::generate::configurations_among;
use tess_verify::{Case, Named};

/// The number of patches that are taken from the interpreter before they are counted.
const RECORDED_TOGETHER: usize = 4096;

/// Counts of how often each of the specification's cases was hit.
///
/// A bin is a path such as ``middle/ruler/oddxeven``; its first part is its group. All bins are
/// declared, so that each missed one has a name. Any number of threads may record patches. Coverage
/// can be pickled and copied.
///
/// >>> from tess_model import Coverage, Patch
/// >>> coverage = Coverage()
/// >>> coverage.record(Patch("quad", [3, 4, 5, 6], [4, 7]))  # bins hit for the first time
/// 23
/// >>> coverage.bins["middle/ruler/oddxodd"], coverage.groups["middle"]
/// (2, Group(hit=2, bins=8))
#[pyclass(frozen, module = "tess_model")]
#[derive(Default)]
pub(crate) struct Coverage(Arc<Mutex<tess_verify::cover::Coverage>>, Arc<Mutex<Option<Case>>>);

/// The pickled state: UCIS XML, and the line of the case that was recorded last.
type CoverageState = (String, Option<String>);

#[pymethods]
impl Coverage {
    #[new]
    fn new() -> Self {
        Self::default()
    }

    /// Records the bins that one or several patches hit. Returns the number of bins that were hit
    /// for the first time, so that a bench can choose the patches that are worth simulating.
    fn record(&self, py: Python<'_>, patches: &Bound<'_, PyAny>) -> PyResult<usize> {
        if let Ok(patch) = patches.cast::<Patch>() {
            return Ok(self.record_cases(&[patch.get().case]));
        }
        let mut fresh = 0;
        let mut patches = patches.try_iter()?;
        loop {
            let some = patches.by_ref().take(RECORDED_TOGETHER);
            let cases: Vec<Case> = some
                .map(|patch| Ok(patch?.cast::<Patch>()?.get().case))
                .collect::<PyResult<_>>()?;
            if cases.is_empty() {
                return Ok(fresh);
            }
            py.check_signals()?;
            fresh += py.detach(|| self.record_cases(&cases));
        }
    }

    /// Records the bins of one factor's context, in the groups ``context`` and ``exceptional``, for
    /// the bench of a stage that does not see patches. The arguments are those of :func:`context`.
    #[pyo3(signature = (factor, parity, split_order = "ruler"))]
    fn record_context(
        &self,
        #[pyo3(from_py_with = whole)] factor: u32,
        parity: &str,
        split_order: &str,
    ) -> PyResult<()> {
        let (split, context) = stages::factor_context(factor, parity, split_order)?;
        self.lock().record_context(split, &context);
        Ok(())
    }

    /// Adds ``hits`` to the hits of one bin.
    #[pyo3(signature = (bin, hits = 1))]
    fn add(&self, bin: &str, #[pyo3(from_py_with = whole)] hits: u64) -> PyResult<()> {
        let found = self.lock().add(bin, hits);
        if found { Ok(()) } else { Err(argument(format!("there is no bin {bin:?}"))) }
    }

    /// Adds the hits of another coverage, such as that of another shard.
    fn merge(&self, other: &Self) {
        let other = other.lock().clone();
        self.lock().merge(&other);
    }

    /// Every bin with its hits, in alphabetical order.
    #[getter]
    fn bins<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let bins = PyDict::new(py);
        self.lock().bins().try_for_each(|(bin, hits)| bins.set_item(bin, hits))?;
        Ok(bins)
    }

    /// Every group with the number of its bins that were hit, :class:`Group`.
    #[getter]
    fn groups<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let groups = PyDict::new(py);
        for group in self.lock().groups() {
            groups.set_item(group.name, values::value(py, "Group", (group.hit, group.bins))?)?;
        }
        Ok(groups)
    }

    /// The bins that were never hit, in alphabetical order.
    #[getter]
    fn missed(&self) -> Vec<String> {
        self.lock().missed().map(str::to_owned).collect()
    }

    /// The bins that were never hit and are not excluded, in alphabetical order.
    ///
    /// Args:
    ///     exclude: Patterns of bins that cannot be hit, such as the result of :func:`exclusions`.
    ///         A pattern is a bin's path or its first parts, each of which may be ``*``. It may be
    ///         a line of a file: the text after a ``#`` is ignored.
    #[pyo3(signature = (exclude = None))]
    fn holes(&self, exclude: Option<&Bound<'_, PyAny>>) -> PyResult<Vec<String>> {
        let exclusions = patterns(exclude)?;
        Ok(self.lock().holes(&exclusions).map(str::to_owned).collect())
    }

    /// The text report of ``tess coverage``: a line for each group, by stage of the specification,
    /// then every hole. ``exclude`` is that of :meth:`holes`.
    #[pyo3(signature = (exclude = None))]
    fn report(&self, exclude: Option<&Bound<'_, PyAny>>) -> PyResult<String> {
        let exclusions = patterns(exclude)?;
        Ok(self.lock().report(&exclusions))
    }

    /// The coverage as UCIS XML. Equal coverage gives equal text.
    fn to_ucis(&self) -> String {
        self.lock().to_ucis()
    }

    /// Reads the text of :meth:`to_ucis` or of a coverage file.
    #[staticmethod]
    fn from_ucis(text: &str) -> PyResult<Self> {
        let read = tess_verify::cover::Coverage::read_ucis(text.as_bytes());
        read.map(|coverage| Self(Arc::new(Mutex::new(coverage)), Arc::default()))
            .map_err(file_format)
    }

    /// Writes a coverage file: UCIS XML.
    fn write(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let text = self.to_ucis();
        let written = signals::interruptible(py, move |stop| {
            Watched::new(File::create(path)?, stop).write_all(text.as_bytes())
        });
        Ok(written??)
    }

    /// Reads a coverage file.
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let from = path.clone();
        let read = signals::interruptible(py, move |stop| {
            let file = Watched::new(File::open(from)?, stop);
            tess_verify::cover::Coverage::read_ucis(file)
        })?;
        read.map(|coverage| Self(Arc::new(Mutex::new(coverage)), Arc::default())).map_err(|error| {
            match error.kind() {
                ErrorKind::InvalidData => file_format(format!("{}: {error}", path.display())),
                _ => error.into(),
            }
        })
    }

    fn __eq__(&self, other: &Self) -> bool {
        let other = other.lock().clone();
        *self.lock() == other
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> (Bound<'py, PyType>, (), CoverageState) {
        let last = *self.1.lock().unwrap_or_else(PoisonError::into_inner);
        (py.get_type::<Self>(), (), (self.to_ucis(), last.map(|case| case.to_string())))
    }

    fn __setstate__(&self, state: CoverageState) -> PyResult<()> {
        let (ucis, last) = state;
        let coverage = tess_verify::cover::Coverage::read_ucis(ucis.as_bytes());
        let last = last.map(|line| line.parse().map_err(argument)).transpose()?;
        *self.lock() = coverage.map_err(file_format)?;
        *self.1.lock().unwrap_or_else(PoisonError::into_inner) = last;
        Ok(())
    }

    fn __repr__(&self) -> String {
        let groups = self.lock().groups();
        let (hit, bins) = groups.iter().fold((0, 0), |(h, b), g| (h + g.hit, b + g.bins));
        format!("<Coverage: {hit} of {bins} bins hit>")
    }
}

/// The bins that no patch of a device's configurations can hit, for ``exclude`` of
/// :meth:`Coverage.report`.
///
/// Args:
///     domain, partitioning, output, split: The device's configurations: one name, several names,
///         or ``None`` for all.
///
/// >>> import tess_model
/// >>> bins = tess_model.exclusions(domain=["tri", "quad"], partitioning="integer")
/// >>> "configuration/isoline/pow2/line/ruler" in bins, "middle/ruler/oddxeven" in bins
/// (True, False)
#[pyfunction]
#[pyo3(signature = (*, domain = None, partitioning = None, output = None, split = None))]
pub(crate) fn exclusions(
    domain: Option<&Bound<'_, PyAny>>,
    partitioning: Option<&Bound<'_, PyAny>>,
    output: Option<&Bound<'_, PyAny>>,
    split: Option<&Bound<'_, PyAny>>,
) -> PyResult<Vec<String>> {
    let (domains, partitionings) = (names(domain)?, names(partitioning)?);
    let (outputs, splits) = (names(output)?, names(split)?);
    let has = configurations_among(&domains, &partitionings, &outputs, &splits);
    Ok(Exclusions::outside(has).bins().map(str::to_owned).collect())
}

/// The values of one or several names; an empty list for `None`.
fn names<T: Named>(argument: Option<&Bound<'_, PyAny>>) -> PyResult<Vec<T>> {
    let Some(argument) = argument else { return Ok(Vec::new()) };
    strings(argument)?.iter().map(|name| named(name)).collect()
}

/// One text, or the texts of an iterable.
fn strings(argument: &Bound<'_, PyAny>) -> PyResult<Vec<String>> {
    if let Ok(one) = argument.extract::<String>() {
        return Ok(vec![one]);
    }
    argument.try_iter()?.map(|one| one?.extract()).collect()
}

/// The bins of patterns.
fn patterns(exclude: Option<&Bound<'_, PyAny>>) -> PyResult<Exclusions> {
    let Some(exclude) = exclude else { return Ok(Exclusions::default()) };
    let lines: Vec<String> = strings(exclude)?;
    Exclusions::read(&lines.join("\n")).map_err(argument)
}

impl Coverage {
    /// The same coverage, for another thread.
    pub(crate) fn shared(&self) -> Self {
        Self(Arc::clone(&self.0), Arc::clone(&self.1))
    }

    /// Records the bins that patches hit, which follow the patch that was recorded last. Returns
    /// the number of bins that were hit for the first time.
    fn record_cases(&self, cases: &[Case]) -> usize {
        let mut coverage = self.lock();
        let mut before = self.1.lock().unwrap_or_else(PoisonError::into_inner);
        let missed = coverage.missed().count();
        coverage.record_stream(*before, cases.iter().copied());
        *before = cases.last().copied().or(*before);
        missed - coverage.missed().count()
    }

    /// Locks the coverage. The holder never waits for the interpreter.
    pub(crate) fn lock(&self) -> MutexGuard<'_, tess_verify::cover::Coverage> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
