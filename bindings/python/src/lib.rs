//! The Python package `tess-model`: the model, its batches and its verification kit as Python
//! objects.
//!
//! `patch` is one patch, `batch` many; `stages` single numbers of one stage; `vectors`, `rules` and
//! `coverage` the verification kit. `names` and `arrays` turn arguments into the libraries' types,
//! `values` makes the named tuples of `python/tess_model/values.py`, `errors` the exceptions;
//! `signals` lets Ctrl-C end what takes long.
//!
//! Nothing here holds the interpreter's lock while it tessellates or compares.

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
