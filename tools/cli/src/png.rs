//! A picture as PNG.

use crate::failure::Failure;
use tess_verify::picture::Picture;

/// The picture as a PNG file.
///
/// # Errors
/// A size of 0, or one that memory does not hold.
pub(crate) fn render(picture: &Picture) -> Result<Vec<u8>, Failure> {
    picture.to_png().map_err(|error| Failure::bad_input(error.to_string()))
}
