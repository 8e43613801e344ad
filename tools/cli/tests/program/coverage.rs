//! Coverage files: added to by several processes at a time, and nothing but regular files.

use crate::support::{command, directory, shell, tess};
use std::fs;

/// Each of the processes adds its hits to what the others added.
#[test]
fn no_hit_is_lost() {
    let folder = directory("no_hit_is_lost");
    let file = |name: &str| folder.join(name).display().to_string();
    let words = |seed: u32, file: &str| {
        format!("gen --level 3 --domain tri --count 40 --seed {seed} --coverage {file}")
    };
    for seed in 1..=12 {
        let run = tess(&words(seed, &file("one.xml")));
        assert_eq!(run.code, Some(0), "{}", run.stderr);
    }
    let together = (1..=12).map(|seed| {
        let mut tess = command(&words(seed, &file("all.xml")));
        tess.stdout(std::process::Stdio::null()).spawn().expect("tess starts")
    });
    for mut process in together.collect::<Vec<_>>() {
        assert!(process.wait().expect("it ends").success(), "every one adds");
    }
    let read = |name: &str| fs::read_to_string(folder.join(name)).expect("a coverage file");
    assert!(read("one.xml") == read("all.xml"), "the same hits as one after another");
    assert_eq!(fs::read_dir(&folder).expect("the folder").count(), 2, "nothing else is left");
}

/// What could fill the memory, or wait for ever, is refused.
#[test]
fn other_than_coverage_files() {
    let folder = directory("other_than_coverage_files");
    let setup = "mkfifo pipe; truncate -s 3G large.xml; printf '\\377' > bytes.xml; mkdir folder";
    assert_eq!(shell(setup, &folder).code, Some(0));
    for (file, why) in [
        ("/dev/zero", "is no regular file"),
        ("pipe", "is no regular file"),
        ("folder", "is no regular file"),
        ("-", "is no regular file"),
        ("large.xml", "large.xml: line 1: no coverage file"),
        ("bytes.xml", "bytes.xml: line 1: no coverage file"),
        ("/nowhere/a.xml", "cannot write /nowhere/a.xml"),
    ] {
        let script = format!("ulimit -v 2000000; $TESS gen --level 3 --count 1 --coverage {file}");
        let run = shell(&script, &folder);
        assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{file}: {}", run.stderr);
        assert!(run.stderr.contains(why) && run.stderr.len() < 500, "{file}: {}", run.stderr);
    }
}
