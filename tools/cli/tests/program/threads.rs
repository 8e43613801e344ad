//! Tests that commands do their work on the threads that exist where more cannot be started.

use crate::support::{Folder, Run, directory, shell, tess_program};
use std::fs;

/// Runs `tess` where a user may have this many threads. The limit does not apply to root, so root
/// switches to another user for it, and this user needs a program that anybody can read.
fn with_threads(threads: u32, words: &str, folder: &Folder) -> Run {
    let limited = format!("ulimit -u {threads}; exec {}/tess {words}", folder.display());
    let is_root = shell("test $(id -u) = 0", folder).code == Some(0);
    let somebody = "exec setpriv --reuid=61234 --regid=61234 --clear-groups";
    let script = if is_root { format!("{somebody} sh -c '{limited}'") } else { limited };
    shell(&script, folder)
}

#[test]
#[ignore = "slow: every command, with every number of threads"]
fn commands_run_without_threads() {
    let folder = directory("commands_run_without_threads");
    let anybody = "chmod 777 . && umask 000 && mkdir out && chmod 777 out";
    shell(anybody, &folder).exits(0);
    fs::copy(tess_program(), folder.join("tess")).expect("a copy");
    let patch = "tri --outer 3,4,5 --inner 6";
    fs::write(folder.join("cases.txt"), shell(&format!("$TESS patch {patch}"), &folder).stdout)
        .expect("a vector file");
    for words in [
        format!("patch {patch} -o out/patch.txt"),
        format!("patch {patch} --backend simd"),
        "check cases.txt".to_owned(),
        "check cases.txt --backend simd".to_owned(),
        "gen --level 3 --count 20 -o out/vectors.csv".to_owned(),
        "mesh --factor 2 -o out/teapot.obj".to_owned(),
        "verify --backend simd --backend core --subject interiors".to_owned(),
        "bench --working-set cache --samples 1 --workload uniform-1 --json".to_owned(),
    ] {
        for threads in [1, 2, 3] {
            let run = with_threads(threads, &words, &folder);
            run.exits(0);
            assert!(!run.stderr.contains("panicked"), "{words}, {threads}: {}", run.stderr);
        }
    }
}

/// rayon would start all of them, which would take minutes.
#[test]
fn tens_of_thousands_of_threads_are_not_started() {
    let folder = directory("tens_of_thousands_of_threads");
    let mesh = "timeout 60 env RAYON_NUM_THREADS=20000 $TESS mesh --factor 1 -o teapot.obj";
    shell(mesh, &folder).exits(0);
}
