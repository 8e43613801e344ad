//! Errors of a tessellation stage.

/// The reason why a tessellation stage cannot be made or used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum StageError {
    /// There are more patches than the stage was made for. Ask for more when you make it.
    #[error("{got} patches are too many; the stage was made for at most {most}")]
    TooManyPatches {
        /// Patches of the frame.
        got: u32,
        /// The most that the stage was made for.
        most: u32,
    },
    /// The factors exceed one binding. Make several stages.
    #[error(
        "the factors take {needed} bytes, but one binding holds only {limit}; \
         make several stages"
    )]
    TooManyFactors {
        /// Bytes of the factors.
        needed: u64,
        /// The device's `max_storage_buffer_binding_size`.
        limit: u64,
    },
    /// There are more bind groups than the device allows in addition to the stage's own. Put the
    /// bindings into fewer groups.
    #[error(
        "{got} bind groups are too many; the device allows {most} besides the stage's own; put the bindings \
         into fewer groups"
    )]
    TooManyBindGroups {
        /// Bind groups of the user.
        got: u32,
        /// The most that the user can have.
        most: u32,
    },
    /// The user's WGSL is not valid.
    #[error("{}", invalid(*line, message))]
    Wgsl {
        /// Line of the user's text, counted from 1; `None` if the text lacks something that the
        /// stage needs, for example a function `domain`.
        line: Option<u32>,
        /// The compiler's message.
        message: String,
    },
    /// The user's WGSL has no fragment shader, or lacks the one that was asked for, or has several
    /// of which none was chosen with
    /// [`StageBuilder::fragment`](crate::stage::StageBuilder::fragment).
    #[error("{}", unclear(asked.as_deref(), found))]
    UnclearFragment {
        /// The name that was asked for.
        asked: Option<String>,
        /// The functions with the attribute `@fragment`.
        found: Vec<String>,
    },
    /// The user's WGSL declares no pipeline constant (`override`) of this name.
    #[error("your WGSL declares no `override {name}`; it declares {}", or_none(found))]
    NoSuchConstant {
        /// The name that was passed to
        /// [`StageBuilder::constants`](crate::stage::StageBuilder::constants).
        name: String,
        /// Names that the WGSL declares.
        found: Vec<String>,
    },
    /// The tessellator or the encoder belongs to another device than the stage. Make it with the
    /// stage's device.
    #[error(
        "the tessellator or the encoder belongs to another device; make it with the stage's device"
    )]
    OtherDevice,
    /// A member of `Vertex` is `@interpolate(flat)`, which takes the value of a primitive's first
    /// vertex, but OpenGL takes the last vertex's. Write `@interpolate(flat, either)` if all
    /// vertices of a primitive share the value, for example a value of their patch; otherwise draw
    /// with Vulkan, Metal or Direct3D.
    #[error(
        "`{member}` of your `struct Vertex` is flat with the value of a primitive's first vertex, \
         and OpenGL takes the last vertex's; write `@interpolate(flat, either)` if a \
         primitive's vertices share the value, for example a value of their patch; otherwise \
         draw with Vulkan, Metal or Direct3D"
    )]
    FlatOfFirstVertex {
        /// Name of the member.
        member: String,
    },
    /// The number of patches is to be read from a buffer that lacks the usage `COPY_SRC`, at an
    /// offset that is not a multiple of 4, or past the buffer's end.
    #[error(
        "the number of patches at byte {offset} of a buffer of {size} bytes with the \
         usages {usage:?} cannot be read; its offset must be a multiple of 4 within the \
         buffer, which needs COPY_SRC"
    )]
    BadPatchCount {
        /// Offset of the number.
        offset: u64,
        /// Bytes of the buffer.
        size: u64,
        /// Usages of the buffer.
        usage: wgpu::BufferUsages,
    },
    /// The stage has no group of this number.
    #[error("there is no group {group}; the stage has {groups} groups, numbered from 0")]
    NoSuchGroup {
        /// Number of the group.
        group: u32,
        /// Groups of the stage.
        groups: usize,
    },
    /// The stage was made without a bind group of this number.
    #[error("there is no bind group {number}; the stage was made with {groups}, numbered from 0")]
    NoSuchBindGroup {
        /// Number of the bind group.
        number: u32,
        /// Bind groups that the stage was made with.
        groups: usize,
    },
    /// The factors of this stage do not come from the host. Make it with `Factors::Host`.
    #[error("the factors of this stage do not come from the host; make it with Factors::Host")]
    NotHostFactors,
    /// The user's WGSL has no function of the name that was passed to
    /// [`StageBuilder::project`](crate::stage::StageBuilder::project).
    #[error("your WGSL has no function `{name}`; write `fn {name}(vertex: Vertex) -> Vertex`")]
    NoSuchFunction {
        /// The name.
        name: String,
    },
    /// A stage that was made with
    /// [`StageBuilder::output_of`](crate::stage::StageBuilder::output_of) has a different domain or
    /// configuration from the other stage or, if points are evaluated, a different `struct Vertex`.
    #[error(
        "a stage can draw another's output only if both have the same domain and configuration and, \
         if points are evaluated, a `struct Vertex` with the same types and locations"
    )]
    OtherOutput,
    /// A stage that was made with
    /// [`StageBuilder::output_of`](crate::stage::StageBuilder::output_of) cannot be prepared or
    /// changed. Prepare the other stage, once for all stages that draw its output.
    #[error("this stage draws the output of another; prepare and change that one")]
    DrawsAnother,
    /// Drawing without the stage's pipeline needs stored points and indices. Leave out `points`, or
    /// choose `Points::Evaluated`.
    #[error(
        "to draw without the stage's pipeline, points and indices have to be stored; leave out `points`"
    )]
    NothingStored,
}

impl StageError {
    /// What the stage demands of the user's WGSL.
    pub(crate) const NEEDED: &'static str = "it declares `struct Vertex`, `fn domain(number: u32, uv: vec2<f32>) -> Vertex` without derivatives, \
         unless factors are given also `fn hull(number: u32) -> QuadFactors` (`TriFactors`, \
         `IsolineFactors`), and no name that begins with `tess_`; its bindings are in the groups that the builder got";
}

/// The compiler's message, with the line or with the stage's demands.
fn invalid(line: Option<u32>, message: &str) -> String {
    match line {
        Some(line) => format!("line {line} of your WGSL: {message}"),
        None => {
            format!("your WGSL does not go with the stage ({message}); {}", StageError::NEEDED)
        }
    }
}

fn or_none(names: &[String]) -> String {
    if names.is_empty() { "none".to_owned() } else { names.join(", ") }
}

/// The message about a missing or unclear fragment shader, with those that exist.
fn unclear(asked: Option<&str>, found: &[String]) -> String {
    let names = found.join(", ");
    match (asked, found.is_empty()) {
        (None, true) => {
            "your WGSL has no function with the attribute @fragment; write one, or leave \
                         out `target`"
                .to_owned()
        }
        (None, false) => {
            format!("your WGSL has several fragment shaders; choose one of {names} with `fragment`")
        }
        (Some(asked), true) => format!("your WGSL has no fragment shader `{asked}`, nor any other"),
        (Some(asked), false) => {
            format!("your WGSL has no fragment shader `{asked}`; it has {names}")
        }
    }
}
