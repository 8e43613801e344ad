//! How a draw gets its vertices where points are evaluated ([`Points::Evaluated`]).
//!
//! A device's fetch of attributes limits frames whose vertices are large: on an H200, two million
//! triangles of 48 bytes took 1.21, 1.51 and 1.28 times the frame of stored points with attributes,
//! and 1.07, 1.25 and 1.13 with loads from a storage buffer (factors 4, 16 and 64). Up to 32 bytes
//! both took the same time. So large vertices are loaded, wherever the draw can bind all of them:
//!
//! ```text
//! bytes of a vertex       room of the frame              the draw gets its vertices from
//! up to 32                any                            attributes
//! more                    at most one binding's bytes    a storage buffer: tess_vertices[index]
//! more                    more                           attributes
//! ```
//!
//! A room that changes can cross the limit of a binding between two frames, and a frame must not
//! wait for a compiler. A material therefore has a pipeline for each way that its stage's room can
//! ask for: one, or both.

use super::TessellationStage;
use super::choices::Points;
use super::gl;
use super::program::Program;
use super::vertex::Load;

/// The most bytes of a vertex that are always attributes.
const SMALL: u64 = 32;

/// The ways in which draws of a stage get their vertices, the better one first.
///
/// A browser reports a layout with too many storage buffers only later, so that nothing can be
/// tried there, and OpenGL need not have any in vertex shaders: both have attributes.
pub(super) fn of(stage: &TessellationStage, program: &Program<'_>) -> &'static [Load] {
    let device = stage.tessellator.device();
    let limits = device.limits();
    let can_load = stage.form.points == Points::Evaluated
        && stage.vertices.array_stride > SMALL
        && program.check_bind_groups(&limits, true).is_ok()
        && !gl::is_gl(device)
        && cfg!(not(target_arch = "wasm32"));
    let most = stage.form.most_vertex_bytes(stage.room);
    match can_load {
        true if most <= limits.max_storage_buffer_binding_size => &[Load::Storage],
        true => &[Load::Storage, Load::Attributes],
        false => &[Load::Attributes],
    }
}
