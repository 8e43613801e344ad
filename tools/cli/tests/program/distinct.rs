//! Tests that an output never replaces a file that the same command reads, nor another of its
//! outputs.

use crate::support::{Folder, directory, shell};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

const SETUP: &str = "set -e
    $TESS patch tri --outer 2,2,2 --inner 2 -o e.txt
    echo case isoline integer line ruler 40000000 40400000 > a.txt
    $TESS gen --level 3 --count 5 --coverage c.xml > /dev/null
    $TESS mesh --factor 1 -o m.gltf
    $TESS mesh --factor 1 -o m.obj
    $TESS mesh --factor 1 --size 8x8 -o h.png
    ln -s e.txt link.txt
    ln e.txt hard.txt
    sed s/m.bin/other.bin/ m.gltf > other.gltf
    ln -s m.bin other.bin
    mkdir folder";

/// Commands that would destroy a file, most of them by another name of it.
const LOSING: &[&str] = &[
    "check e.txt --failures e.txt",
    "check e.txt --failures folder/../e.txt",
    "check e.txt --failures link.txt",
    "check e.txt --failures hard.txt",
    "check link.txt --failures hard.txt",
    "check - --failures e.txt < e.txt",
    "check e.txt --coverage e.txt",
    "check e.txt --cases a.txt --failures a.txt",
    "check e.txt --coverage c.xml --failures c.xml",
    "check e.txt --coverage new.xml --failures folder/../new.xml",
    "check e.txt --coverage c.xml >> c.xml",
    "gen --level 3 --count 5 --coverage c.xml -o c.xml",
    "gen --level 3 --count 5 --coverage new.xml -o new.xml",
    "patch --cases a.txt -o a.txt",
    "patch --cases - -o a.txt < a.txt",
    "patch --cases a.txt >> a.txt",
    "draw tri --outer 2,2,2 --inner 2 --overlay e.txt --format svg -o hard.txt",
    "mesh m.obj --factor 1 -o m.obj",
    "mesh m.obj --factor 1 --displace h.png -o h.png",
    "mesh m.gltf --factor 1 -o m.gltf",
    "mesh m.gltf --factor 1 --format glb -o m.bin",
    "mesh m.gltf --factor 1 -o other.gltf",
];

fn prepared(name: &str) -> Folder {
    let folder = directory(name);
    shell(SETUP, &folder).exits(0);
    folder
}

/// Every file of a folder with its contents.
fn contents(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder).expect("the folder").map(|entry| entry.expect("an entry"));
    let files = entries.filter(|entry| entry.path().is_file());
    files
        .map(|entry| {
            let content = fs::read(entry.path()).expect("readable");
            (entry.file_name().to_string_lossy().into_owned(), content)
        })
        .collect()
}

fn refused(command: &str, folder: &Path, before: &BTreeMap<String, Vec<u8>>) {
    shell(&format!("$TESS {command}"), folder).exits(2).says("are the same file");
    assert!(contents(folder) == *before, "{command}: a file is not as it was");
}

#[test]
fn no_command_replaces_what_it_reads() {
    let folder = prepared("no_command_replaces_what_it_reads");
    let before = contents(&folder);
    for command in LOSING {
        refused(command, &folder, &before);
    }
}

#[cfg(feature = "probe")]
#[test]
fn report_and_picture_are_two_files() {
    let folder = directory("report_and_picture_are_two_files");
    let words = "probe --device 1000 --level 3 --count 1 --picture p.svg -o p.svg";
    refused(words, &folder, &contents(&folder));
}

/// A device accepts any output, and two inputs may be one file unless that would compare nothing.
#[test]
fn what_loses_nothing_is_done() {
    let folder = prepared("what_loses_nothing_is_done");
    for (command, code) in [
        ("check e.txt --failures new.txt --coverage c.xml > /dev/null < /dev/null", 0),
        ("draw tri --outer 2,2,2 --inner 2 --overlay e.txt -o new.svg", 0),
        ("mesh m.gltf --factor 1 -o new.gltf", 0),
        ("check e.txt --cases link.txt", 2),
    ] {
        shell(&format!("$TESS {command}"), &folder).exits(code);
    }
}
