//! An example that draws into a file.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

fn run(words: &[&str]) -> Output {
    let mut example = Command::new(env!("CARGO_BIN_EXE_tess-examples"));
    example.args(words).output().expect("it starts")
}

/// `cargo example NAME -- --screenshot FILE` passes its `--` on.
#[test]
fn a_picture_is_drawn_with_or_without_dashes_before_the_options() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    for (name, dashes) in [("without.png", &[][..]), ("with.png", &["--"])] {
        let file = folder.join(name);
        // That of an earlier run.
        let _ = fs::remove_file(&file);
        let path = file.to_str().expect("the folder's name is a text");
        let words = [&["quickstart"], dashes, &["--width", "64", "--screenshot", path]].concat();
        let output = run(&words);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success(), "{words:?}: {said}");
        let begin = fs::read(&file).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert!(begin.starts_with(b"\x89PNG"), "{name} is a picture");
    }
    let output = run(&["quickstart", "screenshot", "file"]);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(!output.status.success() && said.contains("screenshot is no option"), "{said}");
    assert!(said.contains("--screenshot FILE"), "{said}");
}
