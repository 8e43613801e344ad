//! A device that the driver loses is an error, whichever call detects it.
//!
//! A software driver never loses its device, so a Vulkan layer (`lose.c`) does that, in a process
//! of its own.

use crate::drawing::scene;
use crate::scene::PATCHES;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use tess_core::{Domain, Partitioning};
use tess_wgpu::Error;
use tess_wgpu::stage::Room;

const LAYER: &str = "VK_LAYER_TESS_lose";

/// Compiles the layer, and describes it to Vulkan's loader. Returns the folder.
fn layer() -> PathBuf {
    let folder = std::env::temp_dir().join(format!("tess-lose-{}", std::process::id()));
    fs::create_dir_all(&folder).expect("a folder");
    let library = folder.join("libtess_lose.so");
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/stage/lose.c");
    let mut compiler = Command::new("cc");
    let compiled = compiler.args(["-shared", "-fPIC", "-o"]).arg(&library).arg(source).status();
    let is_compiled = compiled.is_ok_and(|status| status.success());
    assert!(is_compiled, "install a C compiler and Vulkan's headers (Debian: gcc libvulkan-dev)");
    let description = format!(
        r#"{{"file_format_version": "1.1.0", "layer": {{"name": "{LAYER}", "type": "GLOBAL",
        "library_path": "{}", "api_version": "1.3.0", "implementation_version": "1",
        "description": "loses the device"}}}}"#,
        library.display()
    );
    fs::write(folder.join("lose.json"), description).expect("the description");
    folder
}

#[test]
#[ignore = "slow: eight processes, each with a device"]
fn a_device_that_the_driver_loses_is_an_error() {
    let folder = layer();
    for at in ["submit", "wait"] {
        for after in 0..4 {
            let own = std::env::current_exe().expect("this program");
            let mut child = Command::new(own);
            child.args([
                "--ignored",
                "--exact",
                "lost::frames_until_the_device_is_lost_on_request",
            ]);
            child.env("VK_LAYER_PATH", &folder).env("VK_INSTANCE_LAYERS", LAYER);
            child.env("TESS_LOSE_AT", at).env("TESS_LOSE_AFTER", after.to_string());
            let output = child.output().expect("it runs");
            let said = String::from_utf8_lossy(&output.stdout);
            let is_run = said.contains("1 passed");
            assert!(output.status.success() && is_run, "{at} after {after}: {said}");
        }
    }
    fs::remove_dir_all(folder).expect("removed");
}

#[test]
#[ignore = "a_device_that_the_driver_loses_is_an_error runs it with the layer that loses the device"]
fn frames_until_the_device_is_lost_on_request() {
    let scene = scene(Domain::Quad, Partitioning::FractionalOdd);
    let room = Room::Automatic { most_bytes: 1 << 20 };
    let mut stage = scene.build(scene.builder().room(room));
    let lost = (0..10).find_map(|_| scene.frame(&mut stage, PATCHES.into()).err());
    assert!(matches!(lost, Some(Error::DeviceLost { .. })), "{lost:?}");
    for _ in 0..3 {
        let _ = stage.feedback();
        let mut encoder = scene.gpu.device.create_command_encoder(&Default::default());
        let refused = stage.prepare(&mut encoder, PATCHES);
        assert!(matches!(refused, Err(Error::DeviceLost { .. })), "{refused:?}");
        let refused = stage.make_room(&scene.gpu.queue, PATCHES);
        assert!(matches!(refused, Err(Error::DeviceLost { .. })), "{refused:?}");
    }
}
