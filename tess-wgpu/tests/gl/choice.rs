//! The choice of an adapter, and the error if there is none. This program asks in a process of its
//! own, whose environment hides some of the drivers.

use std::process::Command;
use tess_wgpu::{DeviceLimits, Gpu};

/// The argument that asks for [`answer`].
const QUESTION: &str = "which-adapter";

/// Whether this process was started to print its adapter.
pub(crate) fn is_asked() -> bool {
    std::env::args().nth(1).is_some_and(|argument| argument == QUESTION)
}

/// Prints the adapter, or the reason why there is none.
#[expect(clippy::print_stdout, reason = "another process reads it")]
pub(crate) fn answer() {
    let opened = match std::env::args().nth(2) {
        None => pollster::block_on(Gpu::open()),
        Some(_) => {
            let (limits, features) = (DeviceLimits::Default, wgpu::Features::empty());
            pollster::block_on(Gpu::open_on(wgpu::Backends::all(), limits, features))
        }
    };
    match opened {
        Ok(gpu) => print!("{}", gpu.name()),
        Err(error) => print!("{error}"),
    }
}

/// The output of this program in an environment with these variables.
fn say(arguments: &[&str], variables: &[(&str, &str)]) -> String {
    let own = std::env::current_exe().expect("a test has a path");
    let mut command = Command::new(own);
    command.args(arguments).env_remove("WGPU_BACKEND").envs(variables.iter().copied());
    let output = command.output().expect("it starts");
    assert!(output.status.success(), "{output:?}");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// The adapter in an environment with these variables, or the reason why there is none.
fn adapter(variables: &[(&str, &str)]) -> String {
    say(&[QUESTION], variables)
}

/// An environment without Vulkan.
const NO_VULKAN: [(&str, &str); 2] =
    [("VK_DRIVER_FILES", "/nonexistent"), ("VK_ICD_FILENAMES", "/nonexistent")];
/// An environment with an old OpenGL that bears the name of a GPU, which wgpu prefers to a driver
/// in software.
const OLD: [(&str, &str); 4] = [
    ("force_gl_renderer", "Intel"),
    ("MESA_GL_VERSION_OVERRIDE", "3.3"),
    ("MESA_GLSL_VERSION_OVERRIDE", "330"),
    ("MESA_EXTENSION_OVERRIDE", "-GL_ARB_compute_shader -GL_ARB_shader_storage_buffer_object"),
];

/// An environment with only OpenGL ES, because Mesa has no OpenGL of the version that wgpu asks
/// for.
const ES: (&str, &str) = ("MESA_GL_VERSION_OVERRIDE", "3.2");

pub(crate) fn opengl_is_last() {
    let is = |variables: &[(&str, &str)], backend| {
        let adapter = adapter(variables);
        assert!(adapter.contains(backend), "{adapter}, not{backend} with {variables:?}");
    };
    is(&[], " (vulkan, ");
    is(&OLD, " (vulkan, ");
    let none = adapter(&NO_VULKAN);
    assert!(none.contains("no graphics adapter") && none.contains("Gpu::open_on asks"), "{none}");
    let fallback = say(&[QUESTION, "on-all"], &NO_VULKAN);
    assert!(fallback.contains(" (gl, "), "{fallback}, which was asked for");
    is(&[("WGPU_BACKEND", "vulkan,gl"), NO_VULKAN[0], NO_VULKAN[1]], " (gl, ");
    is(&[("WGPU_BACKEND", "gl")], " (gl, ");
    is(&[("WGPU_BACKEND", "gl,vulkan")], " (vulkan, ");
}

pub(crate) fn what_is_lacking_is_said() {
    let fallback = [("WGPU_BACKEND", "vulkan,gl")];
    let old = adapter(&[&NO_VULKAN[..], &OLD, &fallback].concat());
    assert!(old.contains("lacks compute shaders, which need OpenGL 4.3"), "{old}");
    assert!(old.contains("install a driver of Vulkan"), "what to do: {old}");
    let metal = adapter(&[("WGPU_BACKEND", "metal")]);
    assert!(metal.contains("that this program has"), "{metal}");
    assert!(old.contains("WGPU_BACKEND allows no other"), "{old}");
    let none = adapter(&[("WGPU_BACKEND", "glide")]);
    assert!(none.contains("WGPU_BACKEND names none of vulkan, metal, dx12, gl"), "{none}");
}

/// Runs the tests of OpenGL on OpenGL ES.
pub(crate) fn opengl_es_equals_the_model() {
    let adapter = adapter(&[ES, ("WGPU_BACKEND", "gl")]);
    assert!(adapter.contains("OpenGL ES 3."), "{adapter}");
    for test in [crate::LARGE_BATCH, crate::PICTURES] {
        let said = say(&["--exact", test], &[ES]);
        assert!(said.contains("1 passed"), "{said}");
    }
}
