//! Which adapter is opened, and what is said where there is none: by this program as a process of its own, whose
//! environment takes from the drivers what they have.

use std::process::Command;
use tess_wgpu::Gpu;

/// The argument that asks for [`answer`].
const QUESTION: &str = "which-adapter";

/// Whether this process was started to say which adapter there is.
pub(crate) fn is_asked() -> bool {
    std::env::args().nth(1).is_some_and(|argument| argument == QUESTION)
}

/// Says which adapter there is, or why there is none.
#[expect(clippy::print_stdout, reason = "another process reads it")]
pub(crate) fn answer() {
    match pollster::block_on(Gpu::open()) {
        Ok(gpu) => print!("{:?}", gpu.info.backend),
        Err(error) => print!("{error}"),
    }
}

/// What a process with these variables says.
fn ask(variables: &[(&str, &str)]) -> String {
    let own = std::env::current_exe().expect("a test has a path");
    let mut command = Command::new(own);
    command.arg(QUESTION).env_remove("WGPU_BACKEND").envs(variables.iter().copied());
    let output = command.output().expect("it starts");
    assert!(output.status.success(), "{output:?}");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// There is no Vulkan.
const NO_VULKAN: [(&str, &str); 2] =
    [("VK_DRIVER_FILES", "/nonexistent"), ("VK_ICD_FILENAMES", "/nonexistent")];
/// OpenGL is an old one.
const OLD: [(&str, &str); 3] = [
    ("MESA_GL_VERSION_OVERRIDE", "3.3"),
    ("MESA_GLSL_VERSION_OVERRIDE", "330"),
    ("MESA_EXTENSION_OVERRIDE", "-GL_ARB_compute_shader -GL_ARB_shader_storage_buffer_object"),
];

pub(crate) fn opengl_is_last() {
    assert_eq!(ask(&[]), "Vulkan", "where there is Vulkan too");
    assert_eq!(ask(&OLD), "Vulkan", "however old OpenGL is");
    assert_eq!(ask(&NO_VULKAN), "Gl", "where there is no Vulkan");
}

pub(crate) fn old_opengl_is_refused() {
    let said = ask(&[&NO_VULKAN[..], &OLD].concat());
    assert!(said.contains("lacks compute shaders, which OpenGL has from 4.3"), "{said}");
    assert!(said.contains("install a driver of Vulkan"), "what to do: {said}");
}

pub(crate) fn the_variable_is_heeded() {
    let with = |backends| ask(&[("WGPU_BACKEND", backends)]);
    assert_eq!(with("gl"), "Gl");
    assert_eq!(with("vulkan"), "Vulkan");
    assert_eq!(with("gl,vulkan"), "Vulkan", "OpenGL is last");
    assert!(with("metal").contains("WGPU_BACKEND allows no other"), "{}", with("metal"));
    assert!(with("glide").contains("WGPU_BACKEND is none of vulkan"), "{}", with("glide"));
}
