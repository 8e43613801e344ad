//! The rules that a standard has for the output of a tessellator.

use crate::boundary;
use crate::device::{Asked, TessDevice, ask, write};
use crate::status::{TESS_DIFFERENT, TESS_LEFT_OUT, TessStatus, answer};
use crate::types::listed;
use std::ffi::{c_char, c_void};
use tess_core::SplitOrder;
use tess_verify::generate::{GenLevel, Selection};
use tess_verify::rules::{Checker, Specification, Verdict};

/// Standard: Vulkan.
pub const TESS_SPECIFICATION_VULKAN: u32 = 0;
/// Standard: OpenGL.
pub const TESS_SPECIFICATION_OPENGL: u32 = 1;
/// Standard: Direct3D 11.
pub const TESS_SPECIFICATION_D3D11: u32 = 2;

const SPECIFICATIONS: [Specification; 3] =
    [Specification::Vulkan, Specification::OpenGl, Specification::D3d11];

/// Asks a tessellator for the patches of `tess gen --rules`, and judges its outputs by the rules of
/// a standard.
///
/// `specification` is `TESS_SPECIFICATION_...`. The patches are the systematic ones in the
/// standard split order, then `random` patches that depend on `seed`. For Direct3D 11 the correct
/// locations of vertices come from the model; the other standards are judged without it. Patches of
/// configurations that the tessellator does not have are left out.
///
/// - `TESS_OK`: no rule is broken.
/// - `TESS_DIFFERENT`: a rule is broken, or the tessellator failed.
/// - `TESS_LEFT_OUT`: the tessellator has none of the configurations; nothing was judged.
///
/// `report` receives the text that `tess check --rules` prints: each rule as held, held as far as
/// asked, broken or not exercised, with what was not asked and the smallest patches that break it;
/// or the patch at which the tessellator failed. It ends with a zero byte and is cut off at
/// `report_capacity` bytes; 16384 are enough. This function allocates.
///
/// # Safety
/// Pointers that are not null and aligned must be valid:
/// - `device` for calls as its type says,
/// - `report` for writing `report_capacity` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_check_rules(
    specification: u32,
    random: u64,
    seed: u64,
    device: TessDevice,
    user: *mut c_void,
    report: *mut c_char,
    report_capacity: usize,
) -> TessStatus {
    answer(|| {
        let mut checker = Checker::new(listed(&SPECIFICATIONS, specification)?);
        // SAFETY: room for `report_capacity` bytes, as the caller promises.
        let room = unsafe { boundary::room(report, report_capacity) }?;
        let (split, random) = (Some(SplitOrder::Ruler), Some(random));
        let selection = Selection { split, random, ..Selection::level(GenLevel::Rules, seed) };
        for case in selection.cases() {
            // SAFETY: the caller promises that `device` may be called as its type says.
            match unsafe { ask(device, user, &case) }? {
                Asked::Output(output) => checker.add(&case, &output),
                Asked::Unsupported => {}
                Asked::Failed(wrong) => {
                    write(room, &format!("{case}\n{wrong}\n"));
                    return Err(TESS_DIFFERENT);
                }
            }
        }
        let report = checker.report();
        write(room, &report.to_string());
        let broken = report.rows.iter().filter(|row| row.verdict() == Verdict::Broken).count();
        match (report.patches, broken) {
            (0, _) => Err(TESS_LEFT_OUT),
            (_, 0) => Ok(()),
            _ => Err(TESS_DIFFERENT),
        }
    })
}
