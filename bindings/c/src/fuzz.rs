//! Differential fuzzing of a tessellator, given as a function pointer, against the model.

use crate::boundary;
use crate::device::{Asked, TessDevice, ask, write};
use crate::status::{TESS_DIFFERENT, TESS_LEFT_OUT, TessStatus, answer};
use crate::types::listed;
use arbitrary::{Arbitrary, Unstructured};
use std::ffi::{c_char, c_void};
use tess_core::{Domain, OutputPrimitive, Partitioning, SplitOrder};
use tess_verify::Case;
use tess_verify::check::{Conversion, Denormals, ListOrder, Strength, check_device};
use tess_verify::generate::{GenLevel, Selection};

/// Order: the model's, index for index.
pub const TESS_ORDER_EXACT: u32 = 0;
/// Order: the model's order of primitives and of their vertices, which are identified by their
/// coordinates.
pub const TESS_ORDER_SEQUENCE: u32 = 1;
/// Order: any order of primitives, and any leading vertex of a triangle.
pub const TESS_ORDER_ANY: u32 = 2;

/// Denormals: a positive denormal outer factor is greater than zero.
pub const TESS_DENORMALS_KEEP: u32 = 0;
/// Denormals: a positive denormal outer factor may count as zero, which culls the patch.
pub const TESS_DENORMALS_FLUSH: u32 = 1;

/// Conversion of factors to 16 fraction bits: to the nearest, ties to even.
pub const TESS_CONVERSION_EXACT: u32 = 0;
/// Conversion: to either neighbour if the fraction is between 0.4 and 0.6.
pub const TESS_CONVERSION_WITHIN_0_6_ULP: u32 = 1;

/// A configuration's field: any value.
pub const TESS_ANY: u32 = 0xFFFF_FFFF;

const ORDERS: [ListOrder; 3] = [ListOrder::Exact, ListOrder::Sequence, ListOrder::Any];
const DENORMALS: [Denormals; 2] = [Denormals::Keep, Denormals::Flush];
const CONVERSIONS: [Conversion; 2] = [Conversion::Exact, Conversion::Within06Ulp];

/// Strength of the comparison, and the configurations to test.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TessFuzzOptions {
    /// `TESS_ORDER_...`
    pub order: u32,
    /// `TESS_DENORMALS_...`
    pub denormals: u32,
    /// `TESS_CONVERSION_...`
    pub conversion: u32,
    /// `TESS_DOMAIN_...`, or `TESS_ANY`.
    pub domain: u32,
    /// `TESS_PARTITIONING_...`, or `TESS_ANY`.
    pub partitioning: u32,
    /// `TESS_OUTPUT_...`, or `TESS_ANY`.
    pub output: u32,
    /// `TESS_SPLIT_...`, or `TESS_ANY`.
    pub split: u32,
}

/// The options that a null pointer selects.
impl Default for TessFuzzOptions {
    fn default() -> Self {
        Self {
            order: TESS_ORDER_EXACT,
            denormals: TESS_DENORMALS_KEEP,
            conversion: TESS_CONVERSION_EXACT,
            domain: TESS_ANY,
            partitioning: TESS_ANY,
            output: TESS_ANY,
            split: TESS_ANY,
        }
    }
}

/// Compares a tessellator with the model on the patch that a fuzzer's bytes encode.
///
/// Any bytes encode a patch of a configuration that the options select. Most patches are small, and
/// boundary cases are frequent. Without options (null) the comparison is exact, and all
/// configurations are tested.
///
/// - `TESS_OK`: equal.
/// - `TESS_LEFT_OUT`: the tessellator does not have the configuration; nothing was compared. Count
///   these: a run in which every patch is left out proves nothing.
/// - `TESS_DIFFERENT`: a finding. `message` receives the case as a line for `tess patch --cases`, a
///   command that shows the correct output, and the first difference. The message ends with a zero
///   byte and is cut off at `message_capacity` bytes; 1024 are enough.
///
/// `message` must not overlap `data` (`TESS_OVERLAP`; nothing was compared). This function
/// allocates.
///
/// # Safety
/// Pointers that are not null and aligned must be valid:
/// - `data` for reading `size` bytes,
/// - `device` for calls as its type says,
/// - `options` for reading one structure,
/// - `message` for writing `message_capacity` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_fuzz(
    data: *const u8,
    size: usize,
    device: TessDevice,
    user: *mut c_void,
    options: *const TessFuzzOptions,
    message: *mut c_char,
    message_capacity: usize,
) -> TessStatus {
    answer(|| {
        let options = if options.is_null() {
            TessFuzzOptions::default()
        } else {
            // SAFETY: one readable structure, as the caller promises.
            unsafe { boundary::read(options) }?
        };
        let (strength, selection) = (options.strength()?, options.selection()?);
        boundary::check_all_apart(&[
            boundary::bytes(data, size)?,
            boundary::bytes(message, message_capacity)?,
        ])?;
        // SAFETY: `size` readable bytes, as the caller promises.
        let data = unsafe { boundary::list(data, size) }?;
        // SAFETY: room for `message_capacity` bytes, as the caller promises, apart from `data`.
        let message = unsafe { boundary::room(message, message_capacity) }?;
        let Ok(case) = Case::arbitrary(&mut Unstructured::new(data)) else {
            return Err(TESS_LEFT_OUT);
        };
        let case = selection.fit(&case);
        // SAFETY: the caller promises that `device` may be called as its type says.
        let wrong = match unsafe { ask(device, user, &case) }? {
            Asked::Unsupported => return Err(TESS_LEFT_OUT),
            Asked::Failed(wrong) => Some(wrong),
            Asked::Output(output) => {
                let report = check_device([(case, output)], strength);
                report.differences.first().map(|difference| difference.mismatch.to_string())
            }
        };
        let Some(wrong) = wrong else { return Ok(()) };
        write(message, &format!("{case}\n{}\n{wrong}", case.command()));
        Err(TESS_DIFFERENT)
    })
}

impl TessFuzzOptions {
    fn strength(&self) -> Result<Strength, TessStatus> {
        Ok(Strength {
            order: listed(&ORDERS, self.order)?,
            denormals: listed(&DENORMALS, self.denormals)?,
            conversion: listed(&CONVERSIONS, self.conversion)?,
            ..Strength::default()
        })
    }

    fn selection(&self) -> Result<Selection, TessStatus> {
        Ok(Selection {
            domain: any_or(&Domain::ALL, self.domain)?,
            partitioning: any_or(&Partitioning::ALL, self.partitioning)?,
            output: any_or(&OutputPrimitive::ALL, self.output)?,
            split: any_or(&SplitOrder::ALL, self.split)?,
            ..Selection::level(GenLevel::Three, 1)
        })
    }
}

/// The value of a number; `None` for any.
fn any_or<T: Copy>(list: &[T], number: u32) -> Result<Option<T>, TessStatus> {
    if number == TESS_ANY { Ok(None) } else { listed(list, number).map(Some) }
}
