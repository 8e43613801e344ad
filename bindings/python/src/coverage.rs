//! Functional coverage as an object.

use crate::errors::{argument, file_format};
use crate::names::whole;
use crate::patch::Patch;
use crate::{stages, values};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::io::ErrorKind;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use tess_verify::case::Case;

/// How many patches are taken from the interpreter before they are counted.
const RECORDED_TOGETHER: usize = 4096;

/// Which of the specification's cases were hit, and how often.
///
/// A bin is a path such as ``middle/oddxeven``; its first part is its group. All bins are declared, so
/// that what was missed has a name. Any number of threads may count.
///
/// >>> from tess_model import Coverage, Patch
/// >>> coverage = Coverage()
/// >>> coverage.record(Patch("quad", [3, 4, 5, 6], [4, 7]))
/// >>> coverage.bins["middle/oddxodd"], coverage.groups["middle"]
/// (2, Group(hit=2, bins=4))
#[pyclass(frozen, module = "tess_model")]
#[derive(Default)]
pub(crate) struct Coverage(Arc<Mutex<tess_verify::coverage::Coverage>>);

#[pymethods]
impl Coverage {
    #[new]
    fn new() -> Self {
        Self::default()
    }

    /// Counts the bins that one patch or several patches hit.
    fn record(&self, py: Python<'_>, patches: &Bound<'_, PyAny>) -> PyResult<()> {
        if let Ok(patch) = patches.cast::<Patch>() {
            self.lock().record(&patch.get().case);
            return Ok(());
        }
        let mut patches = patches.try_iter()?;
        loop {
            let some = patches.by_ref().take(RECORDED_TOGETHER);
            let cases: Vec<Case> = some
                .map(|patch| Ok(patch?.cast::<Patch>()?.get().case))
                .collect::<PyResult<_>>()?;
            if cases.is_empty() {
                return Ok(());
            }
            py.check_signals()?;
            py.detach(|| {
                let mut coverage = self.lock();
                cases.iter().for_each(|case| coverage.record(case));
            });
        }
    }

    /// Counts the bins of one factor's context, for the bench of a stage that sees no patch: those of
    /// the groups ``context`` and ``exceptional``. The arguments are those of :func:`context`.
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

    /// Adds to the hits of one bin.
    #[pyo3(signature = (bin, hits = 1))]
    fn add(&self, bin: &str, #[pyo3(from_py_with = whole)] hits: u64) -> PyResult<()> {
        let found = self.lock().add(bin, hits);
        if found { Ok(()) } else { Err(argument(format!("there is no bin {bin:?}"))) }
    }

    /// Adds the hits of another coverage, such as another shard's.
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

    /// Every group with how many of its bins were hit, :class:`Group`.
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

    /// The text report of ``tess gen --coverage``: a line for each group, then every missed bin.
    fn report(&self) -> String {
        self.lock().to_string()
    }

    /// The coverage as UCIS XML. Equal coverage gives equal text.
    fn to_ucis(&self) -> String {
        self.lock().to_ucis()
    }

    /// Reads what :meth:`to_ucis` gave, or ``tess gen --coverage FILE`` wrote.
    #[staticmethod]
    fn from_ucis(text: &str) -> PyResult<Self> {
        let read = tess_verify::coverage::Coverage::from_ucis(text);
        read.map(|coverage| Self(Arc::new(Mutex::new(coverage)))).map_err(file_format)
    }

    /// Writes a coverage file: UCIS XML.
    fn write(&self, path: PathBuf) -> PyResult<()> {
        Ok(std::fs::write(path, self.to_ucis())?)
    }

    /// Reads a coverage file.
    #[staticmethod]
    fn read(path: PathBuf) -> PyResult<Self> {
        let read = tess_verify::coverage::Coverage::read_ucis(std::fs::File::open(&path)?);
        read.map(|coverage| Self(Arc::new(Mutex::new(coverage)))).map_err(|error| {
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

    fn __repr__(&self) -> String {
        let groups = self.lock().groups();
        let (hit, bins) = groups.iter().fold((0, 0), |(h, b), g| (h + g.hit, b + g.bins));
        format!("<Coverage: {hit} of {bins} bins hit>")
    }
}

impl Coverage {
    /// The same coverage, for another thread.
    pub(crate) fn shared(&self) -> Self {
        Self(Arc::clone(&self.0))
    }

    /// The coverage, alone; nothing waits for the interpreter while it holds this.
    pub(crate) fn lock(&self) -> MutexGuard<'_, tess_verify::coverage::Coverage> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
