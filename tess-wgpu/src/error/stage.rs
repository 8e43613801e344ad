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
    /// A shader binds more storage buffers than the device allows, with the stage's own. Put
    /// several arrays into one buffer, give them the visibility of the shader stages that read
    /// them, or open the device with higher limits ([`crate::DeviceLimits::Highest`]).
    #[error(
        "{got} storage buffers are too many for `{function}`: the device allows {most} besides the \
         stage's {own}; put several arrays into one buffer, or open the device with a higher \
         max_storage_buffers_per_shader_stage"
    )]
    TooManyStorageBuffers {
        /// The user's function.
        function: &'static str,
        /// Storage buffers of the user.
        got: u32,
        /// The most that the user can have.
        most: u32,
        /// Storage buffers of the stage.
        own: u32,
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
    /// [`MaterialBuilder::fragment`](crate::stage::MaterialBuilder::fragment).
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
    /// The tessellator or the encoder, also that of a render pass, belongs to another device than
    /// the stage. Make it with the device that [`build`](crate::stage::StageBuilder::build) got.
    #[error(
        "the tessellator or the encoder belongs to another device than the stage; make it with the \
         device that `build` got: `Tessellator::new(&device)`, `device.create_command_encoder(...)`"
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
    /// [`MaterialBuilder::project`](crate::stage::MaterialBuilder::project).
    #[error("your WGSL has no function `{name}`; write `fn {name}(vertex: Vertex) -> Vertex`")]
    NoSuchFunction {
        /// The name.
        name: String,
    },
    /// Points are evaluated, and the material's `struct Vertex` differs from the stage's. Names may
    /// differ.
    #[error(
        "the material's `struct Vertex` has other members than the stage's, whose vertices it draws; \
         give it members of the same types and locations, in the same order"
    )]
    OtherVertex,
    /// Materials of one stage differ in whether they call a function of
    /// [`MaterialBuilder::project`](crate::stage::MaterialBuilder::project), and those without did
    /// not ask for it with
    /// [`MaterialBuilder::unprojected`](crate::stage::MaterialBuilder::unprojected).
    #[error("{}", forgotten(function.as_deref()))]
    ProjectForgotten {
        /// The function of this material; `None` if others have one and this has none.
        function: Option<String>,
    },
    /// The frame was prepared by another stage than the material was made from.
    #[error(
        "the material was made from another stage than the frame; after a stage is replaced, make \
         its materials again with `stage.material`"
    )]
    OtherStage,
    /// The stage has prepared another frame since.
    #[error(
        "frame {frame} cannot be drawn any more, because its stage has prepared frame {last}; draw \
         the frame that the last `prepare` returned"
    )]
    OldFrame {
        /// Number of the frame.
        frame: u64,
        /// Number of the last frame.
        last: u64,
    },
    /// The stage of the frame or of the material was dropped.
    #[error(
        "the stage of the frame or of the material is gone; prepare the stage that replaces it, and \
         make its materials again with `stage.material`"
    )]
    StageGone,
    /// An engine's vertex shader can read only stored points. Leave out `points`, or choose
    /// [`Points::Evaluated`](crate::stage::Points).
    #[error(
        "a vertex shader of your own pipeline reads stored points; leave out `points`, or choose \
         `Points::Evaluated`"
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

/// The message about materials of which one calls a function of `project` and another does not.
fn forgotten(function: Option<&str>) -> String {
    let remedy = "or `.unprojected()` if `domain` returns positions in clip space";
    match function {
        None => format!(
            "other materials of this stage have `.project(...)`, and this one does not; add \
             `.project(...)`, {remedy}"
        ),
        Some(name) => format!(
            "this material has `.project(\"{name}\")`, and an earlier one of its stage does not; \
             add `.project(...)` to that one, {remedy}"
        ),
    }
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
