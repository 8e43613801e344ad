//! One patch, with everything that the model knows about it.

use crate::errors::{argument, no_such_element};
use crate::names::{bits, case, config, factors, floats, named, whole, whole_or_none};
use crate::{arrays, stages, values};
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use serde_json::Value;
use std::collections::BTreeMap;
use tess_core::{Config, Domain, ProcessedPatch, Tessellation};
use tess_show::{Colours, DrawOptions, Explanation, Part, SignalError, draw, has_rings};
use tess_verify::vectors::Listing;
use tess_verify::{Case, Named};

/// One patch: a configuration and raw factors, and the model's results for them.
///
/// Args:
///     domain: ``isoline``, ``tri`` or ``quad``.
///     outer: The outer factors, floats: density, detail (isoline); u0, v0, w0 (tri); u0, v0, u1,
///         v1 (quad). Each is rounded to the nearest binary32; any value is valid, including NaN.
///     inner: The inside factors: none (isoline), a number or a sequence of one (tri), along u and
///         along v (quad).
///     partitioning: ``integer``, ``pow2``, ``fractional_odd`` or ``fractional_even``.
///     output: ``point``, ``line``, ``triangle_cw`` or ``triangle_ccw``.
///     split: ``ruler`` (the standard) or ``center``.
///
/// Raises:
///     ArgumentError: An unknown name, or a wrong number of factors.
///
/// >>> from tess_model import Patch
/// >>> patch = Patch("tri", outer=[2.5, 3, 1], inner=3.25, partitioning="fractional_odd")
/// >>> patch.counts
/// Counts(points=19, primitives=29, indices=87)
/// >>> patch.point(7), patch.primitive(0)
/// ((13835, 37865), (0, 1, 7))
#[pyclass(frozen, module = "tess_model")]
#[derive(Clone)]
pub(crate) struct Patch {
    pub(crate) case: Case,
}

#[pymethods]
impl Patch {
    #[new]
    #[pyo3(signature = (domain, outer, inner = None, *, partitioning = "integer",
        output = "triangle_cw", split = "ruler"))]
    fn new(
        domain: &str,
        outer: &Bound<'_, PyAny>,
        inner: Option<&Bound<'_, PyAny>>,
        partitioning: &str,
        output: &str,
        split: &str,
    ) -> PyResult<Self> {
        let inner = inner.map_or_else(|| Ok(Vec::new()), floats)?;
        Self::of(domain, &floats(outer)?, &inner, config(partitioning, output, split)?)
    }

    /// Makes a patch from the binary32 bit patterns of its factors: like the constructor, but with
    /// integers below 2**32.
    ///
    /// >>> from tess_model import Patch
    /// >>> Patch.from_bits("isoline", [0x40000000, 0x7fc00000]).kind
    /// 'culled'
    #[staticmethod]
    #[pyo3(signature = (domain, outer, inner = None, *, partitioning = "integer",
        output = "triangle_cw", split = "ruler"))]
    fn from_bits(
        domain: &str,
        outer: &Bound<'_, PyAny>,
        inner: Option<&Bound<'_, PyAny>>,
        partitioning: &str,
        output: &str,
        split: &str,
    ) -> PyResult<Self> {
        let inner = inner.map_or_else(|| Ok(Vec::new()), bits)?;
        Self::of(domain, &bits(outer)?, &inner, config(partitioning, output, split)?)
    }

    /// Makes a patch from a case line, the form of vector files and of :attr:`case`:
    /// ``case DOMAIN PARTITIONING OUTPUT SPLIT FACTOR...``, each factor as the 8 hex digits of its
    /// bits.
    #[staticmethod]
    fn from_case(line: &str) -> PyResult<Self> {
        Ok(Self { case: case(line)? })
    }

    /// The patch as a case line, for :meth:`from_case`.
    #[getter]
    fn case(&self) -> String {
        self.case.to_string()
    }

    /// The shell command that tessellates the same patch.
    #[getter]
    fn command(&self) -> String {
        self.case.command()
    }

    /// ``isoline``, ``tri`` or ``quad``.
    #[getter]
    fn domain(&self) -> &'static str {
        self.case.domain().name()
    }

    /// ``integer``, ``pow2``, ``fractional_odd`` or ``fractional_even``.
    #[getter]
    fn partitioning(&self) -> &'static str {
        self.case.config.partitioning.name()
    }

    /// ``point``, ``line``, ``triangle_cw`` or ``triangle_ccw``.
    #[getter]
    fn output(&self) -> &'static str {
        self.case.config.output.name()
    }

    /// ``ruler`` or ``center``.
    #[getter]
    fn split(&self) -> &'static str {
        self.case.config.split.name()
    }

    /// The raw factors as floats, outer then inside; a NaN may lose its payload.
    #[getter]
    fn factors<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.case.factors.iter().map(f64::from))
    }

    /// The raw factors as binary32 bits, outer then inside.
    #[getter]
    fn factor_bits<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.case.factors.iter().map(f32::to_bits))
    }

    /// ``culled``, ``minimum`` or ``regular``.
    #[getter]
    fn kind(&self) -> &'static str {
        match self.case.patch().processed() {
            ProcessedPatch::Culled => "culled",
            ProcessedPatch::Minimum(_) => "minimum",
            ProcessedPatch::Regular(_) => "regular",
        }
    }

    /// The numbers of points, primitives and indices: :class:`Counts`.
    #[getter]
    fn counts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let counts = self.case.patch().counts();
        values::value(py, "Counts", (counts.points, counts.primitives, counts.indices))
    }

    /// Every factor after factor processing, outer then inside: :class:`ProcessedFactor`. Empty if
    /// the patch is culled.
    #[getter]
    fn processed<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let patch = self.case.patch();
        let processed: Vec<_> =
            patch.processed().factors().map_or_else(Vec::new, |f| f.iter().collect());
        let names = self.case.domain().factor_names().iter();
        let factors = names.zip(self.case.factors.iter()).zip(processed);
        let each = factors.map(|((name, raw), factor)| values::processed(py, name, raw, &factor));
        PyTuple::new(py, each.collect::<PyResult<Vec<_>>>()?)
    }

    /// The domain points: a new uint32 array of shape (points, 2), u and v as 16.16 integers.
    #[getter]
    fn points<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<u32>> {
        arrays::fixed_array(py, &py.detach(|| self.tessellate()).points)
    }

    /// The domain points: a new float32 array of shape (points, 2), exactly the 16.16 coordinates.
    #[getter]
    fn points_f32<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f32>> {
        let points = py.detach(|| self.tessellate()).points;
        arrays::rows_of(py, &points, |point| point.to_f32())
    }

    /// The primitives: a new uint32 array of shape (primitives, 1, 2 or 3), numbers of points.
    #[getter]
    fn indices<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<u32>>> {
        let indices = py.detach(|| self.tessellate()).indices;
        let size = self.case.primitive_size();
        let primitives = indices.len() / size;
        PyArray1::from_vec(py, indices).reshape([primitives, size])
    }

    /// Computes point ``i`` as (u, v), 16.16 integers, in constant time.
    fn point(&self, #[pyo3(from_py_with = whole)] i: u32) -> PyResult<(u32, u32)> {
        let point = self.case.patch().point(i).ok_or_else(|| self.missing(Part::Point(i)))?;
        Ok((point.u.to_bits(), point.v.to_bits()))
    }

    /// Computes the 1, 2 or 3 indices of primitive ``t`` in constant time.
    fn primitive<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = whole)] t: u32,
    ) -> PyResult<Bound<'py, PyTuple>> {
        let found =
            self.case.patch().primitive(t).ok_or_else(|| self.missing(Part::Primitive(t)))?;
        PyTuple::new(py, found.indices())
    }

    /// The origin of point ``i``: :class:`PointOrigin`.
    fn locate_point<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = whole)] i: u32,
    ) -> PyResult<Bound<'py, PyAny>> {
        let origin =
            self.case.patch().locate_point(i).ok_or_else(|| self.missing(Part::Point(i)))?;
        values::point_origin(py, origin)
    }

    /// The origin of primitive ``t``: :class:`PrimitiveOrigin`.
    fn locate_primitive<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = whole)] t: u32,
    ) -> PyResult<Bound<'py, PyAny>> {
        let patch = self.case.patch();
        let origin = patch.locate_primitive(t).ok_or_else(|| self.missing(Part::Primitive(t)))?;
        values::primitive_origin(py, origin)
    }

    /// Computes the location of point ``p`` of an edge with a factor of this patch, with every
    /// step: a :class:`Placement`. ``factor`` is a name as in :attr:`processed`; ``p`` is less than
    /// the ``points`` of its context.
    fn place<'py>(
        &self,
        py: Python<'py>,
        factor: &str,
        #[pyo3(from_py_with = whole)] p: u32,
    ) -> PyResult<Bound<'py, PyAny>> {
        let names = self.case.domain().factor_names();
        let number = names.iter().position(|name| *name == factor).ok_or_else(|| {
            argument(format!("there is no factor {factor:?}; there are {}", names.join(", ")))
        })?;
        let patch = self.case.patch();
        let processed = patch.processed().factors().and_then(|factors| factors.iter().nth(number));
        let processed = processed
            .ok_or_else(|| no_such_element("the patch is culled: its factors place no points"))?;
        values::placement(py, &stages::placed(&processed.context, p)?)
    }

    /// The text of ``tess explain``: every stage of the patch, or the origin of one point or one
    /// primitive, or the processing of one factor.
    #[pyo3(signature = (*, point = None, primitive = None, factor = None))]
    fn explain(
        &self,
        #[pyo3(from_py_with = whole_or_none)] point: Option<u32>,
        #[pyo3(from_py_with = whole_or_none)] primitive: Option<u32>,
        #[pyo3(from_py_with = whole_or_none)] factor: Option<u32>,
    ) -> PyResult<String> {
        Ok(self.report(part(point, primitive, factor)?)?.0)
    }

    /// Compares a circuit's signals with the model, for a point, a primitive, a factor or (without
    /// any of these) the patch's counts. Returns a :class:`SignalDifference` for each signal that
    /// differs, in the order of the data flow. ``observed`` maps signal names, which ``tess
    /// explain --help`` lists, to values.
    ///
    /// >>> from tess_model import Patch
    /// >>> patch = Patch("tri", outer=[2, 2, 2], inner=2)
    /// >>> for difference in patch.differences({"u": 0, "v": 0x8001, "last": False}, point=1):
    /// ...     print(difference)
    /// v of stage points: observed 0x8001, expected 0x8000
    #[pyo3(signature = (observed, *, point = None, primitive = None, factor = None))]
    fn differences<'py>(
        &self,
        py: Python<'py>,
        observed: BTreeMap<String, u32>,
        #[pyo3(from_py_with = whole_or_none)] point: Option<u32>,
        #[pyo3(from_py_with = whole_or_none)] primitive: Option<u32>,
        #[pyo3(from_py_with = whole_or_none)] factor: Option<u32>,
    ) -> PyResult<Bound<'py, PyTuple>> {
        let observed: Vec<(&str, u32)> =
            observed.iter().map(|(signal, value)| (signal.as_str(), *value)).collect();
        let part = part(point, primitive, factor)?;
        let differences = tess_show::compare_signals(&self.case, part, &observed).map_err(
            |error| match error {
                SignalError::NoSuchPart(_) => self.missing(part),
                other => argument(other),
            },
        )?;
        let values = differences.iter().map(|one| values::signal_difference(py, one));
        PyTuple::new(py, values.collect::<PyResult<Vec<_>>>()?)
    }

    /// The output of ``tess explain --json`` as dictionaries and lists.
    ///
    /// >>> from tess_model import Patch
    /// >>> patch = Patch("tri", outer=[2, 2, 2], inner=2)
    /// >>> patch.explanation()["stitches"][0]["steps"]
    /// 'OO'
    /// >>> patch.explanation(point=6)["location"]
    /// 'centre, point 0'
    #[pyo3(signature = (*, point = None, primitive = None, factor = None))]
    fn explanation<'py>(
        &self,
        py: Python<'py>,
        #[pyo3(from_py_with = whole_or_none)] point: Option<u32>,
        #[pyo3(from_py_with = whole_or_none)] primitive: Option<u32>,
        #[pyo3(from_py_with = whole_or_none)] factor: Option<u32>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let json = self.report(part(point, primitive, factor)?)?.1.to_string();
        py.import("json")?.getattr("loads")?.call1((json,))
    }

    /// Draws the patch as an SVG picture.
    ///
    /// Args:
    ///     indices: Whether to number the points.
    ///     colours: ``plain``; ``order``, which also numbers the primitives; or ``rings``.
    ///     size: Width and height in pixels, 64..8192.
    #[pyo3(signature = (*, indices = false, colours = "plain", size = 800))]
    fn to_svg(
        &self,
        py: Python<'_>,
        indices: bool,
        colours: &str,
        #[pyo3(from_py_with = whole)] size: u32,
    ) -> PyResult<String> {
        let colours = match colours {
            "plain" => Colours::Plain,
            "order" => Colours::Order,
            "rings" if has_rings(self.case.domain(), self.case.config.output) => Colours::Rings,
            "rings" => {
                return Err(argument("rings colours the triangles of a tri or quad patch"));
            }
            other => {
                let message = format!("unknown colours {other:?}, expected plain, order or rings");
                return Err(argument(message));
            }
        };
        if !(64..=8192).contains(&size) {
            return Err(argument(format!("a picture has 64 to 8192 pixels a side, not {size}")));
        }
        Ok(py.detach(|| self.draw(&DrawOptions { indices, colours, size })))
    }

    /// The patch as a listing: its case line, all points and all primitives, as in a vector file.
    fn listing(&self) -> String {
        Listing { line: 0, case: self.case, output: self.tessellate() }.to_string()
    }

    fn _repr_svg_(&self, py: Python<'_>) -> String {
        py.detach(|| self.draw(&DrawOptions { size: 400, ..DrawOptions::default() }))
    }

    fn __repr__(&self) -> String {
        format!("Patch.from_case('{}')", self.case)
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.case == other.case
    }

    fn __hash__(&self) -> u64 {
        use std::hash::{DefaultHasher, Hash, Hasher};
        let mut hasher = DefaultHasher::new();
        self.case.hash(&mut hasher);
        hasher.finish()
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (String,))> {
        Ok((py.get_type::<Self>().getattr("from_case")?, (self.case(),)))
    }

    fn __copy__(slf: Py<Self>) -> Py<Self> {
        slf
    }

    fn __deepcopy__(slf: Py<Self>, _memo: &Bound<'_, PyDict>) -> Py<Self> {
        slf
    }
}

impl Patch {
    fn of(domain: &str, outer: &[f32], inner: &[f32], config: Config) -> PyResult<Self> {
        let factors = factors(named::<Domain>(domain)?, outer, inner)?;
        Ok(Self { case: Case { config, factors } })
    }

    pub(crate) fn tessellate(&self) -> Tessellation {
        self.case.patch().tessellate()
    }

    fn draw(&self, options: &DrawOptions) -> String {
        let listing = Listing { line: 0, case: self.case, output: self.tessellate() };
        draw(&listing, options).to_svg()
    }

    fn missing(&self, part: Part) -> PyErr {
        let counts = self.case.patch().counts();
        let (what, number) = match part {
            Part::Point(i) => ("point", i),
            Part::Primitive(t) => ("primitive", t),
            Part::Factor(k) => ("factor", k),
            _ => ("patch", 0),
        };
        no_such_element(format!(
            "there is no {what} {number}: the patch has {} points and {} primitives, from 0",
            counts.points, counts.primitives
        ))
    }

    /// An explanation as text and as JSON.
    fn report(&self, part: Part) -> PyResult<(String, Value)> {
        let report = Explanation::new(&self.case, part).ok_or_else(|| self.missing(part))?;
        Ok((report.to_string(), serde_json::to_value(report).map_err(argument)?))
    }
}

/// The requested element.
fn part(point: Option<u32>, primitive: Option<u32>, factor: Option<u32>) -> PyResult<Part> {
    match (point, primitive, factor) {
        (None, None, None) => Ok(Part::Patch),
        (Some(i), None, None) => Ok(Part::Point(i)),
        (None, Some(t), None) => Ok(Part::Primitive(t)),
        (None, None, Some(k)) => Ok(Part::Factor(k)),
        _ => Err(argument("give a point, a primitive or a factor, one of them")),
    }
}
