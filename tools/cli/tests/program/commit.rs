//! Tests that a report's commit is clean only if everything that the program was made of is.

#[path = "../../build.rs"]
#[expect(dead_code, clippy::print_stdout, reason = "a build script; its parts are tested here")]
mod build;

use crate::support::{Folder, directory, shell};
use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};

/// The files that the build script looked at.
const SOURCES: &str = include_str!(concat!(env!("OUT_DIR"), "/sources.txt"));

/// The packages of this workspace that cargo builds into the program, as it names their files.
fn crates() -> BTreeSet<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let words = "$CARGO tree --offline --all-features -e normal,build --prefix none -f {p}";
    let tree = shell(words, folder);
    // A package with a folder, `NAME vVERSION (FOLDER)`, is one of the workspace.
    let own = tree.exits(0).stdout.lines().filter(|line| line.contains(" ("));
    own.filter_map(|line| line.split(' ').next()).map(|name| name.replace('-', "_")).collect()
}

/// The files of the repository that the compiler read for the program: its dep-info of each crate,
/// in the folder where cargo keeps it. Cargo's own `tess.d` joins them; `cargo test` makes none.
fn read_by_compiler(root: &Path) -> BTreeSet<PathBuf> {
    let crates = crates();
    let folder = Path::new(env!("CARGO_BIN_EXE_tess")).with_file_name("deps");
    let mut read = BTreeSet::new();
    for entry in fs::read_dir(&folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display())) {
        let path = entry.expect("an entry").path();
        let name = path.file_name().and_then(OsStr::to_str).unwrap_or_default();
        let Some(unit) = name.strip_suffix(".d") else { continue };
        let of = unit.rsplit_once('-').map_or(unit, |(name, _)| name);
        // Tests and checks of a crate have dep-info of its name too, but make nothing of this name.
        let made = if of == "tess" { unit.to_owned() } else { format!("lib{unit}.rlib") };
        if (of == "tess" || crates.contains(of)) && folder.join(made).is_file() {
            let text = fs::read_to_string(&path).expect("dep-info");
            let files = text.lines().filter_map(|line| line.strip_suffix(':'));
            // Earlier builds may have left dep-info of files that are gone since.
            let files = files.filter_map(|f| root.join(f.replace("\\ ", " ")).canonicalize().ok());
            read.extend(files.filter(|file| file.starts_with(root) && file.is_file()));
        }
    }
    read
}

/// The compiler's own list is the judge: what it read of this repository, the build script looked
/// at.
#[test]
fn everything_that_was_read_counts() {
    if SOURCES.is_empty() {
        // The commit was given, or this is no clone.
        let clone = build::checked_out(Path::new(env!("CARGO_MANIFEST_DIR")));
        let is_of_clone = clone.is_some_and(|built| built.commit == env!("TESS_COMMIT"));
        assert!(!is_of_clone, "the files of a clone are known");
        return;
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).expect("the repository");
    let root = &*root.canonicalize().expect("the repository");
    let sources: BTreeSet<&Path> = SOURCES.lines().map(Path::new).collect();
    let read = read_by_compiler(root);
    for path in read.iter().filter(|path| !path.starts_with(root.join("target"))) {
        assert!(sources.contains(path.as_path()), "{} was read, not looked at", path.display());
    }
    for some in ["tess-core/src/lib.rs", "tess-mesh/src/lib.rs", "tools/cli/src/main.rs"] {
        assert!(read.contains(&root.join(some)), "{some} is among what the compiler read");
    }
    for some in [
        "Cargo.toml",
        "Cargo.lock",
        "tess-core/Cargo.toml",
        "tools/cli/build.rs",
        "tools/probe/shaders/evaluate.tese.spv",
    ] {
        assert!(sources.contains(&*root.join(some)), "{some} counts");
    }
    let is_test = |path: &&&Path| path.starts_with(root.join("tools/cli/tests"));
    assert_eq!(sources.iter().find(is_test), None, "a test is no part of the program");
}

/// A clone with the workspace of a program in `app`, which uses `dep`, and of `other`.
fn clone() -> Folder {
    let folder = directory("clone");
    for (name, text) in [
        ("Cargo.toml", "[workspace]\nresolver = \"3\"\nmembers = [\"app\", \"dep\", \"other\"]\n"),
        ("Cargo.lock", "version = 4\n"),
        (".gitignore", "target\n"),
        ("README.md", "of the workspace\n"),
        (
            "app/Cargo.toml",
            "[package]\nname = \"app\"\nedition = \"2024\"\n[dependencies]\ndep = { path = \"../dep\", optional = true }\n[dev-dependencies]\nother = { path = \"../other\" }\n",
        ),
        ("app/src/main.rs", "fn main() {}\n"),
        ("app/tests/test.rs", "#[test]\nfn test() {}\n"),
        ("dep/src/inside.rs", "\n"),
        ("app/data é.bin", "data"),
        (
            "dep/Cargo.toml",
            "[package]\nname = \"dep\"\nedition = \"2024\"\n[[test]]\nname = \"inside\"\npath = \"src/inside.rs\"\n",
        ),
        ("dep/src/lib.rs", "\n"),
        ("dep/shaders/a.spv", "words"),
        ("dep/examples/inner/Cargo.toml", "[workspace]\n[package]\nname = \"inner\"\n"),
        ("dep/examples/inner/src/main.rs", "fn main() {}\n"),
        ("other/Cargo.toml", "[package]\nname = \"other\"\nedition = \"2024\"\n"),
        ("other/src/lib.rs", "\n"),
    ] {
        let path = folder.join(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        fs::write(path, text).expect("written");
    }
    let made = "git init -q . && git add . && \
                git -c user.name=a -c user.email=a@b -c commit.gpgsign=false commit -qm all";
    shell(made, &folder).exits(0);
    folder
}

/// The commit of the clone's program.
fn commit(folder: &Path) -> String {
    let folder = folder.canonicalize().expect("the clone");
    build::checked_out(&folder.join("app")).expect("a clone").commit
}

#[test]
fn whatever_a_program_is_made_of() {
    let folder = clone();
    let head = shell("git rev-parse HEAD", &folder).stdout.trim().to_owned();
    assert_eq!(commit(&folder), head, "clean");
    let changed = head.clone() + "+changes";
    for (change, expected) in [
        ("echo >> app/src/main.rs", &changed),
        ("echo >> 'app/data é.bin'", &changed),
        ("echo >> dep/src/lib.rs", &changed),
        ("echo >> dep/shaders/a.spv", &changed),
        ("rm dep/shaders/a.spv", &changed),
        ("echo > dep/src/new.rs", &changed),
        ("echo >> dep/src/lib.rs; git add .", &changed),
        ("echo >> app/Cargo.toml", &changed),
        ("echo >> dep/Cargo.toml", &changed),
        ("echo >> Cargo.toml", &changed),
        ("echo >> Cargo.lock", &changed),
        ("mkdir .cargo; echo > .cargo/config.toml", &changed),
        ("echo > rust-toolchain.toml", &changed),
        ("echo >> README.md", &head),
        ("echo >> app/tests/test.rs", &head),
        ("echo >> dep/examples/inner/src/main.rs", &head),
        ("echo >> other/src/lib.rs", &head),
        ("mkdir app/target; echo > app/target/x", &head),
    ] {
        shell(change, &folder).exits(0);
        assert_eq!(&commit(&folder), expected, "{change}");
        shell("git reset -q --hard && git clean -qfdx", &folder).exits(0);
        assert_eq!(commit(&folder), head, "{change}, taken back");
    }
}

/// A workspace inside another project's clone has no commit of its own.
#[test]
fn other_clones() {
    let folder = clone();
    let moved = "mkdir inner && mv app dep other Cargo.toml Cargo.lock inner";
    shell(moved, &folder).exits(0);
    let app = folder.canonicalize().expect("the clone").join("inner/app");
    assert!(build::checked_out(&app).is_none(), "the clone is another project's");
}

/// A package records whether it was made of changed files.
#[test]
fn commits_of_packages() {
    let folder = directory("commits_of_packages");
    for (info, expected) in [
        (r#"{"git":{"sha1":"abc"},"path_in_vcs":"tools/cli"}"#, Some("abc")),
        (r#"{"git":{"sha1":"abc","dirty":true},"path_in_vcs":""}"#, Some("abc+changes")),
        (r#"{"path_in_vcs":""}"#, None),
    ] {
        fs::write(folder.join(".cargo_vcs_info.json"), info).expect("written");
        let found = build::packaged(&folder).map(|built| built.commit);
        assert_eq!(found.as_deref(), expected, "{info}");
    }
}
