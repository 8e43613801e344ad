//! The version of the library.

use std::ffi::c_char;

/// The version as three numbers: `major << 16 | minor << 8 | patch`.
pub const TESS_VERSION: u32 = 0x0000_0100;

/// The version of the linked library, in the form of `TESS_VERSION`.
///
/// It differs from `TESS_VERSION` if the program was compiled with the header of another version.
#[unsafe(no_mangle)]
pub extern "C" fn tess_version() -> u32 {
    TESS_VERSION
}

/// The version of the library as text, `major.minor.patch`.
///
/// Never null; the text lives as long as the program and must not be freed.
#[unsafe(no_mangle)]
pub extern "C" fn tess_version_string() -> *const c_char {
    const TEXT: &str = concat!(env!("CARGO_PKG_VERSION"), "\0");
    TEXT.as_ptr().cast()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::ffi::CStr;

    #[test]
    fn version_is_that_of_the_package() {
        let [major, minor, patch] = [16, 8, 0].map(|shift| (tess_version() >> shift) & 0xFF);
        assert_eq!(format!("{major}.{minor}.{patch}"), env!("CARGO_PKG_VERSION"), "numbers");
        // SAFETY: a text that ends in a zero and lives as long as the program.
        let text = unsafe { CStr::from_ptr(tess_version_string()) };
        assert_eq!(text.to_str(), Ok(env!("CARGO_PKG_VERSION")), "text");
    }
}
