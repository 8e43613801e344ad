//! Compiles every shader with Tint, the WGSL compiler of browsers built on Chromium. Unlike naga,
//! it refuses barriers in control flow that may not be uniform.

mod common;

use common::{COUNTING, DRAWING, PULLING, all_setups};
use std::collections::BTreeSet;
use std::io::Write;
use std::process::{Command, Stdio};
use tess_gpu::{Counting, Pull, Stage, Tap};

/// Tint's message about a shader that it refuses.
fn refusal(source: &str) -> Option<String> {
    let mut child = Command::new("tint")
        .args(["--input-format", "wgsl", "--format", "wgsl", "-"])
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap_or_else(|error| panic!("tint, a part of Dawn, has to be on the PATH: {error}"));
    child.stdin.take().expect("it is piped").write_all(source.as_bytes()).expect("tint reads");
    let output = child.wait_with_output().expect("tint ends");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    (!output.status.success()).then_some(said)
}

#[test]
#[ignore = "needs tint, a part of Dawn: cargo test -p tess-gpu --test tint -- --ignored"]
fn browsers_take_every_shader_on_request() {
    let mut sources = BTreeSet::new();
    for setup in all_setups() {
        sources.extend(Stage::ALL.map(|stage| stage.source(stage.relevant(setup))));
        sources.extend(Tap::ALL.map(|tap| tap.source(setup)));
        let pull = Pull { group: 0, first_binding: 0 };
        sources.insert(pull.source(setup) + PULLING);
        sources.insert(pull.source_for_drawing(setup) + DRAWING);
        sources.insert(Counting { group: 0, binding: 0 }.source(setup) + COUNTING);
    }
    assert!(sources.len() > 100, "{} different shaders", sources.len());
    for source in &sources {
        assert_eq!(refusal(source), None, "{source}");
    }
}

#[test]
#[ignore = "needs tint, a part of Dawn: cargo test -p tess-gpu --test tint -- --ignored"]
fn a_barrier_that_some_threads_miss_is_refused_on_request() {
    let source = Stage::ExpandPoints.source(all_setups()[0]);
    assert_eq!(refusal(&source), None, "as it is");
    let barrier = "    workgroupBarrier();\n";
    let planted = source.replacen(barrier, "    if thread > 3u { workgroupBarrier(); }\n", 1);
    assert_ne!(source, planted, "there is a barrier");
    let said = refusal(&planted).expect("it is refused");
    assert!(said.contains("uniform control flow"), "{said}");
}
