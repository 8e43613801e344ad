//! An example in a real window, on an X server without a screen.

use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Output, Stdio};

/// An X server, which ends when this is dropped.
struct Server {
    process: Child,
    display: String,
}

impl Server {
    /// If there is none, the test fails, and is not skipped: `cargo xtask setup` installs it.
    fn start() -> Self {
        let mut process = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", "1280x900x24", "-nolisten", "tcp"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap_or_else(|error| panic!("Xvfb, Debian's xvfb, has to be on the PATH: {error}"));
        let mut number = String::new();
        let output = process.stdout.take().expect("it is piped");
        BufReader::new(output).read_line(&mut number).expect("it names its display");
        let display = format!(":{}", number.trim());
        Self { process, display }
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        // The server may have ended by itself.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

/// Shows five frames on a display.
fn show(display: &str) -> Output {
    let mut example = Command::new(env!("CARGO_BIN_EXE_tess-examples"));
    example
        .args(["quickstart", "--frames", "5"])
        .env("DISPLAY", display)
        .env_remove("WAYLAND_DISPLAY");
    example.output().expect("it starts")
}

#[test]
fn the_quickstart_opens_a_window() {
    let server = Server::start();
    let output = show(&server.display);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{said}");
}

#[test]
fn without_a_display_it_fails() {
    let output = show(":987654");
    assert!(!output.status.success(), "there is no such display");
}
