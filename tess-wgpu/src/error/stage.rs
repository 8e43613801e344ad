//! Errors of a tessellation stage.

use std::fmt;

/// Why a tessellation stage cannot be made or used.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum StageError {
    /// More patches than the stage was made for. Name more when you make it.
    TooManyPatches {
        /// Patches of the frame.
        got: u32,
        /// The most that the stage was made for.
        most: u32,
    },
    /// The factors exceed one binding. Make several stages.
    TooManyFactors {
        /// Bytes of the factors.
        needed: u64,
        /// The device's `max_storage_buffer_binding_size`.
        limit: u64,
    },
    /// More bind groups than the device has beside the stage's own. Put the bindings into fewer groups.
    TooManyBindGroups {
        /// Bind groups of the user's.
        got: u32,
        /// The most that there can be.
        most: u32,
    },
    /// The user's WGSL is not valid.
    Wgsl {
        /// Line of the user's text, from 1 on; `None` if the text lacks what the stage needs, for example a
        /// function `domain`.
        line: Option<u32>,
        /// The compiler's message.
        message: String,
    },
    /// The user's WGSL has no fragment shader, or not the one that was asked for, or several and none was chosen with
    /// [`StageBuilder::fragment`](crate::stage::StageBuilder::fragment).
    UnclearFragment {
        /// The name that was asked for.
        asked: Option<String>,
        /// The functions with the attribute `@fragment`.
        found: Vec<String>,
    },
    /// The user's WGSL declares no pipeline constant (`override`) of this name.
    NoSuchConstant {
        /// The name that [`StageBuilder::constants`](crate::stage::StageBuilder::constants) got.
        name: String,
        /// Names that the WGSL declares.
        found: Vec<String>,
    },
    /// The tessellator or the encoder belongs to another device than the stage. Make it with the stage's device.
    OtherDevice,
    /// A member of `Vertex` is `@interpolate(flat)`, which takes the value of a primitive's first vertex, and OpenGL
    /// takes the last vertex's. Write `@interpolate(flat, either)` if a primitive's vertices share the value,
    /// for example a value of their patch; otherwise draw with Vulkan, Metal or Direct3D.
    FlatOfFirstVertex {
        /// Name of the member.
        member: String,
    },
    /// The number of patches is read from a buffer that lacks the usage `COPY_SRC`, at an offset that is no
    /// multiple of 4, or behind its end.
    BadPatchCount {
        /// Offset of the number.
        offset: u64,
        /// Bytes of the buffer.
        size: u64,
        /// Usages of the buffer.
        usage: wgpu::BufferUsages,
    },
    /// The stage has no group of this number.
    NoSuchGroup {
        /// Number of the group.
        group: u32,
        /// Groups of the stage.
        groups: usize,
    },
    /// The stage was made without a bind group of this number.
    NoSuchBindGroup {
        /// Number of the bind group.
        number: u32,
        /// Bind groups that the stage was made with.
        groups: usize,
    },
    /// The factors of this stage do not come from the host. Make it with `Factors::Host`.
    NotHostFactors,
    /// Whoever draws without the stage's pipeline needs stored points and indices. Leave out `points`.
    NothingStored,
}

impl StageError {
    /// The demands on the user's WGSL.
    pub(crate) const NEEDED: &'static str = "it declares `struct Vertex`, `fn domain(number: u32, uv: vec2<f32>) -> Vertex` without derivatives, \
         unless factors are given also `fn hull(number: u32) -> QuadFactors` (`TriFactors`, \
         `IsolineFactors`), and no name that begins with `tess_`; its bindings are in the groups that the builder got";
}

impl fmt::Display for StageError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooManyPatches { got, most } => {
                write!(f, "{got} patches, and the stage was made for {most} at most")
            }
            Self::TooManyFactors { needed, limit } => write!(
                f,
                "the factors take {needed} bytes, and one binding holds {limit}; \
                 make several stages"
            ),
            Self::TooManyBindGroups { got, most } => write!(
                f,
                "{got} bind groups, and the device has {most} beside what the stage binds; put the bindings \
                 into fewer groups"
            ),
            Self::Wgsl { line: Some(line), message } => {
                write!(f, "line {line} of your WGSL: {message}")
            }
            Self::Wgsl { line: None, message } => {
                write!(f, "your WGSL does not go with the stage ({message}); {}", Self::NEEDED)
            }
            Self::NoSuchConstant { name, found } => write!(
                f,
                "your WGSL declares no `override {name}`; it declares {}",
                if found.is_empty() { "none".to_owned() } else { found.join(", ") }
            ),
            Self::OtherDevice => f.write_str(
                "the tessellator or the encoder belongs to another device; make it with the stage's device",
            ),
            Self::UnclearFragment { asked, found } => unclear(f, asked.as_deref(), found),
            Self::FlatOfFirstVertex { member } => write!(
                f,
                "`{member}` of your `struct Vertex` is flat with the value of a primitive's first vertex, \
                 and OpenGL takes the last vertex's; write `@interpolate(flat, either)` if a \
                 primitive's vertices share the value, for example a value of their patch; otherwise \
                 draw with Vulkan, Metal or Direct3D"
            ),
            Self::BadPatchCount { offset, size, usage } => write!(
                f,
                "the number of patches at byte {offset} of a buffer of {size} bytes with the \
                 usages {usage:?} cannot be read; its offset must be a multiple of 4 within the \
                 buffer, which needs COPY_SRC"
            ),
            Self::NotHostFactors => f.write_str(
                "the factors of this stage do not come from the host; make it with Factors::Host",
            ),
            Self::NothingStored => f.write_str(
                "to draw without the stage's pipeline, points and indices have to be stored; leave out `points`",
            ),
            Self::NoSuchGroup { group, groups } => {
                write!(f, "the stage has {groups} groups, numbered from 0, and none is {group}")
            }
            Self::NoSuchBindGroup { number, groups } => write!(
                f,
                "the stage was made with {groups} bind groups, numbered from 0, and none is {number}"
            ),
        }
    }
}

/// Says which fragment shaders there are.
fn unclear(f: &mut fmt::Formatter<'_>, asked: Option<&str>, found: &[String]) -> fmt::Result {
    let names = found.join(", ");
    match (asked, found.is_empty()) {
        (None, true) => f.write_str(
            "your WGSL has no function with the attribute @fragment; write one, or leave out `target`",
        ),
        (None, false) => write!(
            f,
            "your WGSL has several fragment shaders; choose one of {names} with `fragment`"
        ),
        (Some(asked), true) => {
            write!(f, "your WGSL has no fragment shader `{asked}`, nor any other")
        }
        (Some(asked), false) => {
            write!(f, "your WGSL has no fragment shader `{asked}`; it has {names}")
        }
    }
}

impl std::error::Error for StageError {}
