//! Many patches at the speed of `tess-simd`.

mod work;

use crate::arrays::{self, Array1, Array2, addresses, described, overlap, refuse_masked, writable};
use crate::errors::{self, argument, output};
use crate::names::{config, named, whole, whole_or_none};
use crate::values;
use numpy::{PyArray, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PySlice, PyTuple, PyType};
use std::sync::{Mutex, PoisonError};
use tess_core::{Config, Domain, IsolineFactors, QuadFactors, TriangleFactors};
use tess_simd::{BatchCounts, Numbering, OutputPoint, PatchRange};
use tess_verify::Named;
use work::{ArrayRoom, BatchSizes, BatchWork, How};

/// A tessellator for batches in one configuration, on the CPU's vector units.
///
/// The first tessellator of a configuration takes about a millisecond to make, later ones a
/// microsecond. A tessellator learns from patches, so keep it. Any number of threads may use it at
/// the same time; each takes up to 1.2 MB of memory. Calls release the interpreter's lock.
///
/// Args:
///     partitioning, output, split: As for :class:`Patch`.
///     threads: The number of threads that write a batch, 1..256. The output does not depend on it.
///         A forked child starts its own threads.
///
/// Raises:
///     ArgumentError: Unknown names, or a number of threads outside 1..256.
///     TessError: The system refused to start threads.
///
/// A tessellator can be pickled and copied: the copy has the same settings and its own memory.
///
/// >>> import numpy as np
/// >>> from tess_model import Tessellator
/// >>> tessellator = Tessellator("fractional_odd")
/// >>> batch = tessellator.tessellate("quad", np.full((10, 6), 2.5, dtype=np.float32))
/// >>> points, indices = batch.patch(9)
/// >>> points.shape, indices.shape
/// ((16, 2), (54,))
#[pyclass(frozen, module = "tess_model")]
pub(crate) struct Tessellator {
    config: Config,
    threads: usize,
    level: tess_simd::Level,
    /// Those that are not in use by a call.
    idle: Mutex<Vec<tess_simd::Tessellator>>,
}

#[pymethods]
impl Tessellator {
    #[new]
    #[pyo3(signature = (partitioning = "integer", output = "triangle_cw", split = "ruler",
        threads = 1))]
    fn new(
        partitioning: &str,
        output: &str,
        split: &str,
        #[pyo3(from_py_with = whole)] threads: usize,
    ) -> PyResult<Self> {
        let config = config(partitioning, output, split)?;
        let most = tess_simd::Tessellator::MAX_THREADS;
        if !(1..=most).contains(&threads) {
            return Err(argument(format!("threads must be 1 to {most}, not {threads}")));
        }
        if threads > 1 {
            tess_simd::Tessellator::start_threads().map_err(errors::threads)?;
        }
        let first = tess_simd::Tessellator::new(config).with_threads(threads);
        Ok(Self { config, threads, level: first.level(), idle: Mutex::new(vec![first]) })
    }

    /// The CPU level in use: ``baseline``, ``avx2`` or ``avx512``. All produce the same bits.
    #[getter]
    fn level(&self) -> &'static str {
        self.level.name()
    }

    /// The number of threads that write a batch.
    #[getter]
    fn threads(&self) -> usize {
        self.threads
    }

    fn __repr__(&self) -> String {
        let Config { partitioning, output, split } = self.config;
        format!(
            "Tessellator('{}', '{}', '{}', threads={})",
            partitioning.name(),
            output.name(),
            split.name(),
            self.threads
        )
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> (Bound<'py, PyType>, TessellatorArguments) {
        let Config { partitioning, output, split } = self.config;
        let arguments = (partitioning.name(), output.name(), split.name(), self.threads);
        (py.get_type::<Self>(), arguments)
    }

    /// Computes the sizes of a batch's output, :class:`BatchCounts`: the room that ``out`` needs.
    fn count<'py>(
        &self,
        py: Python<'py>,
        domain: &str,
        factors: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let batch = owned(named(domain)?, factors)?;
        let counts = self.with(|tessellator| {
            let count = || tessellator.count(batch.batch()).map(|counted| counted.counts());
            py.detach(count).map_err(errors::batch)
        });
        let BatchCounts { patches, points, indices } = counts?;
        values::value(py, "BatchCounts", (patches, points, indices))
    }

    /// Tessellates a batch into a :class:`Batch`.
    ///
    /// Args:
    ///     domain: ``isoline``, ``tri`` or ``quad``.
    ///     factors: Array of shape (patches, k), where k is 2, 4 or 6: raw factors in the order of
    ///         :class:`Patch`, outer then inside. Either float32 (other floats must be exactly
    ///         binary32 numbers), or uint32 bit patterns. Any strides.
    ///     points: ``float32`` or ``fixed`` (uint32, 16.16); both are exact.
    ///     indices: ``uint32`` or ``uint16``. With ``base_vertex``, 16 bits number 65536 points;
    ///         the last index, 65535, restarts primitives in WebGL 2 and wherever primitive restart
    ///         is on.
    ///     base_vertex: ``None`` to count the indices of each patch from its own first point; a
    ///         number to count through the batch, whose first point has that number.
    ///     out: Arrays (points, indices) or (points, indices, ranges) to write to instead of new
    ///         ones: C-contiguous, of shapes (>= points, 2), (>= indices,) and (>= patches, 4).
    ///         Their types are the formats. The result has views of them; elements past the output
    ///         keep their values.
    ///
    /// Raises:
    ///     ArgumentError: Unknown names; factors of another shape or type; indices that do not fit
    ///         16 bits; more than 2**32 - 1 points or indices.
    ///     OutputError: An array of ``out`` cannot be written. Nothing was written.
    ///     KeyboardInterrupt: Or another exception of a signal handler. A part of ``out`` may have
    ///         been written.
    #[pyo3(signature = (domain, factors, *, points = "float32", indices = "uint32",
        base_vertex = None, out = None))]
    #[expect(clippy::too_many_arguments, reason = "they are named in Python")]
    fn tessellate<'py>(
        &self,
        py: Python<'py>,
        domain: &str,
        factors: &Bound<'py, PyAny>,
        points: &str,
        indices: &str,
        #[pyo3(from_py_with = whole_or_none)] base_vertex: Option<u32>,
        out: Option<&Bound<'py, PyTuple>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let batch = owned(named(domain)?, factors)?;
        let numbering = base_vertex
            .map_or(Numbering::PerPatch, |base_vertex| Numbering::PerBatch { base_vertex });
        self.with(|tessellator| {
            let counted = py.detach(|| tessellator.count(batch.batch())).map_err(errors::batch)?;
            let sizes = BatchSizes::of(&counted, numbering);
            let arrays = match out {
                Some(out) => Arrays::given(py, out, sizes.counts)?,
                None => Arrays::new(py, points, indices, sizes.counts)?,
            };
            if sizes.is_small() {
                arrays.write(py, BatchWork { numbering, how: How::AtOnce(counted) })?;
            } else {
                let how = How::Parts { tessellator, batch: batch.batch(), sizes };
                arrays.write(py, BatchWork { numbering, how })?;
            }
            arrays.result(py, sizes.counts)
        })
    }
}

/// The arguments that make a [`Tessellator`].
type TessellatorArguments = (&'static str, &'static str, &'static str, usize);

impl Tessellator {
    /// Lends a tessellator that no other call is using. Errors: those of `borrow`.
    fn with<T>(
        &self,
        borrow: impl FnOnce(&mut tess_simd::Tessellator) -> PyResult<T>,
    ) -> PyResult<T> {
        let idle = || self.idle.lock().unwrap_or_else(PoisonError::into_inner);
        let free = idle().pop();
        let make = || tess_simd::Tessellator::new(self.config).with_threads(self.threads);
        let mut tessellator = free.unwrap_or_else(make);
        let result = borrow(&mut tessellator);
        idle().push(tessellator);
        result
    }
}

/// The patches of an array.
fn owned(domain: Domain, array: &Bound<'_, PyAny>) -> PyResult<BatchPatches> {
    let flat = arrays::factors(domain, array)?;
    Ok(match domain {
        Domain::Isoline => BatchPatches::Isolines(of::<2, _>(&flat)?),
        Domain::Triangle => BatchPatches::Triangles(of::<4, _>(&flat)?),
        Domain::Quad => BatchPatches::Quads(of::<6, _>(&flat)?),
    })
}

fn of<const N: usize, T: From<[f32; N]>>(flat: &[f32]) -> PyResult<Vec<T>> {
    arrays::copied(flat.as_chunks::<N>().0.iter().map(|factors| T::from(*factors)))
}

/// Patches of one domain in the fastest layout.
enum BatchPatches {
    Isolines(Vec<IsolineFactors>),
    Triangles(Vec<TriangleFactors>),
    Quads(Vec<QuadFactors>),
}

impl BatchPatches {
    fn batch(&self) -> tess_simd::Batch<'_> {
        match self {
            Self::Isolines(all) => all.into(),
            Self::Triangles(all) => all.into(),
            Self::Quads(all) => all.into(),
        }
    }
}

/// Points in one of the two formats.
enum Points<'py> {
    Float(Array2<'py, f32>),
    Fixed(Array2<'py, u32>),
}

/// Indices in one of the two formats.
enum Indices<'py> {
    Long(Array1<'py, u32>),
    Short(Array1<'py, u16>),
}

/// Does the same with an array of any format.
macro_rules! each {
    ($value:expr, $kind:ident::{$one:ident, $other:ident}, $array:ident => $work:expr) => {
        match $value {
            $kind::$one($array) => $work,
            $kind::$other($array) => $work,
        }
    };
}

/// The arrays to which a batch is written.
struct Arrays<'py> {
    points: Points<'py>,
    indices: Indices<'py>,
    ranges: Array2<'py, u32>,
}

impl<'py> Arrays<'py> {
    /// New arrays in formats by name.
    fn new(py: Python<'py>, points: &str, indices: &str, counts: BatchCounts) -> PyResult<Self> {
        let unknown = |what: &str, name: &str, known: &str| {
            argument(format!("unknown format of {what} {name:?}, expected {known}"))
        };
        Ok(Self {
            points: match points {
                "float32" => Points::Float(arrays::zeros(py, (counts.points, 2))?),
                "fixed" => Points::Fixed(arrays::zeros(py, (counts.points, 2))?),
                other => return Err(unknown("points", other, "float32 or fixed")),
            },
            indices: match indices {
                "uint32" => Indices::Long(arrays::zeros(py, (counts.indices,))?),
                "uint16" => Indices::Short(arrays::zeros(py, (counts.indices,))?),
                other => return Err(unknown("indices", other, "uint32 or uint16")),
            },
            ranges: arrays::zeros(py, (counts.patches, 4))?,
        })
    }

    /// The caller's arrays.
    fn given(py: Python<'py>, out: &Bound<'py, PyTuple>, counts: BatchCounts) -> PyResult<Self> {
        if !(2..=3).contains(&out.len()) {
            let message = "out must be (points, indices) or (points, indices, ranges), not";
            return Err(output(format!("{message} {} arrays", out.len())));
        }
        let element = |i: usize| out.get_item(i);
        for array in out {
            refuse_masked("out", &array)?;
        }
        let ranges = match out.len() {
            2 => arrays::zeros(py, (counts.patches, 4))?,
            _ => rows::<u32>(&element(2)?, 4)
                .ok_or_else(|| wrong(&element(2), "ranges", "(.., 4), uint32"))?,
        };
        let (points, indices) = (element(0)?, element(1)?);
        let points = rows(&points, 2)
            .map(Points::Float)
            .or_else(|| rows(&points, 2).map(Points::Fixed))
            .ok_or_else(|| wrong(&element(0), "points", "(.., 2), float32 or uint32"))?;
        let indices = indices
            .cast::<PyArray<u32, _>>()
            .map(|array| Indices::Long(array.clone()))
            .or_else(|_| indices.cast::<PyArray<u16, _>>().map(|a| Indices::Short(a.clone())))
            .map_err(|_| wrong(&element(1), "indices", "(..,), uint32 or uint16"))?;
        let arrays = Self { points, indices, ranges };
        arrays.check_overlap()?;
        Ok(arrays)
    }

    /// Refuses arrays that share memory.
    fn check_overlap(&self) -> PyResult<()> {
        let points =
            each!(&self.points, Points::{Float, Fixed}, array => addresses("points", array)?);
        let indices =
            each!(&self.indices, Indices::{Long, Short}, array => addresses("indices", array)?);
        let ranges = addresses("ranges", &self.ranges)?;
        for (one, a, other, b) in [
            ("points", &points, "indices", &indices),
            ("points", &points, "ranges", &ranges),
            ("indices", &indices, "ranges", &ranges),
        ] {
            if overlap(a, b) {
                return Err(output(format!("{one} and {other} of out share memory")));
            }
        }
        Ok(())
    }

    /// Writes the batch.
    fn write(&self, py: Python<'py>, work: BatchWork<'_>) -> PyResult<()> {
        let mut ranges = writable("ranges", &self.ranges)?;
        let ranges = arrays::ranges(ranges.as_slice_mut().map_err(output)?);
        match &self.points {
            Points::Float(points) => {
                let mut points = writable("points", points)?;
                let (points, _) = points.as_slice_mut().map_err(output)?.as_chunks_mut::<2>();
                self.write_indices(py, work, points, ranges)
            }
            Points::Fixed(points) => {
                let mut points = writable("points", points)?;
                let points = arrays::fixed_points(points.as_slice_mut().map_err(output)?);
                self.write_indices(py, work, points, ranges)
            }
        }
    }

    fn write_indices<P: OutputPoint>(
        &self,
        py: Python<'py>,
        work: BatchWork<'_>,
        points: &mut [P],
        ranges: &mut [PatchRange],
    ) -> PyResult<()> {
        each!(&self.indices, Indices::{Long, Short}, indices => {
            let mut indices = writable("indices", indices)?;
            let indices = indices.as_slice_mut().map_err(output)?;
            work.write(py, ArrayRoom { points, indices, ranges })
        })
    }

    /// The written elements, as views if the arrays are larger.
    fn result(self, py: Python<'py>, counts: BatchCounts) -> PyResult<Bound<'py, PyAny>> {
        let points = each!(self.points, Points::{Float, Fixed}, array => array.into_any());
        let indices = each!(self.indices, Indices::{Long, Short}, array => array.into_any());
        let first = |array: &Bound<'py, PyAny>, count: usize| {
            if array.len()? == count {
                return Ok(array.clone());
            }
            array.get_item(PySlice::new(py, 0, count.cast_signed(), 1))
        };
        let views = (
            first(&points, counts.points)?,
            first(&indices, counts.indices)?,
            first(self.ranges.as_any(), counts.patches)?,
        );
        values::value(py, "Batch", views)
    }
}

/// An array of this type with rows of `columns` elements.
fn rows<'py, T: numpy::Element>(
    array: &Bound<'py, PyAny>,
    columns: usize,
) -> Option<Array2<'py, T>> {
    let array = array.cast::<PyArray<T, numpy::Ix2>>().ok()?;
    (array.shape()[1] == columns).then(|| array.clone())
}

/// The error of an array that has another type or shape.
fn wrong(array: &PyResult<Bound<'_, PyAny>>, what: &str, expected: &str) -> PyErr {
    let found = array.as_ref().ok().map(|array| match array.cast::<PyUntypedArray>() {
        Ok(array) => described(array),
        Err(_) => array.get_type().to_string(),
    });
    let found = found.unwrap_or_default();
    output(format!("{what} of out must be a numpy array of shape {expected}, not {found}"))
}
