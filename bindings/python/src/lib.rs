//! The Python package `tess-model`: the model, its batches and its verification kit as Python
//! objects.
//!
//! `patch` has one patch, `batch` many patches, and `stages` single numbers of one stage.
//! `vectors`, `rules` and `coverage` are the verification kit. `names` and `arrays` convert
//! arguments to the libraries' types; `values` makes the named tuples of
//! `python/tess_model/values.py`, and `errors` the exceptions. `signals` lets Ctrl-C end long
//! calls.
//!
//! The interpreter's lock is never held during tessellation or comparison.

mod arrays;
mod batch;
mod coverage;
mod errors;
mod names;
mod patch;
mod rules;
mod signals;
mod stages;
mod strength;
mod values;
mod vectors;

use pyo3::prelude::*;

/// The compiled part of `tess_model`.
#[pymodule(gil_used = false)]
fn _native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<patch::Patch>()?;
    module.add_class::<batch::Tessellator>()?;
    module.add_class::<coverage::Coverage>()?;
    module.add_class::<vectors::Cases>()?;
    module.add_class::<vectors::Record>()?;
    module.add_class::<vectors::VectorFile>()?;
    module.add_function(wrap_pyfunction!(stages::context, module)?)?;
    module.add_function(wrap_pyfunction!(stages::place, module)?)?;
    module.add_function(wrap_pyfunction!(stages::process_factor, module)?)?;
    module.add_function(wrap_pyfunction!(coverage::exclusions, module)?)?;
    module.add_function(wrap_pyfunction!(rules::check_rules, module)?)?;
    module.add_function(wrap_pyfunction!(vectors::generate, module)?)?;
    module.add_function(wrap_pyfunction!(vectors::write_vectors, module)?)?;
    module.add_function(wrap_pyfunction!(vectors::check, module)?)?;
    module.add_function(wrap_pyfunction!(vectors::check_device, module)?)
}
