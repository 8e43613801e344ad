//! The format of a file: the requested one, or the one that its name implies. The two must agree.

use crate::failure::Failure;
use clap::ValueEnum;
use std::path::Path;

/// A format of files; its names on the command line are file extensions.
pub(crate) trait FileForm: ValueEnum + PartialEq {
    /// The format of a file whose name implies none; `None` if a format must then be requested.
    const DEFAULT: Option<Self>;

    /// Extensions that belong to [`Self::DEFAULT`], but that files of other formats may have too.
    const COMMON_EXTENSIONS: &'static [&'static str] = &[];
}

/// The requested format, or the one that the file's name implies, or the default. Errors: the name
/// implies another format than the requested one, or an unknown one.
pub(crate) fn choose<F: FileForm>(asked: Option<F>, file: &Path) -> Result<F, Failure> {
    let extension = file.extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
    let extension = extension.unwrap_or_default();
    let is_common =
        extension.is_empty() || F::COMMON_EXTENSIONS.iter().any(|common| extension == *common);
    let named = F::from_str(&extension, true).ok();
    match (asked, named, F::DEFAULT) {
        (Some(asked), Some(named), _) if asked != named => Err(Failure::bad_input(format!(
            "--format {} does not go with the name {}",
            name(&asked),
            file.display()
        ))),
        (Some(form), _, _) | (None, Some(form), _) => Ok(form),
        (None, None, Some(form)) if is_common || is_no_name(file) => Ok(form),
        (None, None, _) => Err(Failure::bad_input(format!(
            "cannot tell what to write to {}: name it .{}, or use --format",
            file.display(),
            names::<F>().join(", .")
        ))),
    }
}

/// Whether the path is that of stdout, a pipe or a device, whose name implies no format.
fn is_no_name(file: &Path) -> bool {
    file.starts_with("/dev") || file.starts_with("/proc")
}

/// The name of a value on the command line.
pub(crate) fn name(value: &impl ValueEnum) -> String {
    value.to_possible_value().map(|value| value.get_name().to_owned()).unwrap_or_default()
}

fn names<F: FileForm>() -> Vec<String> {
    F::value_variants().iter().map(name).collect()
}
