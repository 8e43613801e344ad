//! Tests of the places that output goes to: links, pipes, permissions, long names, a full stdout, a
//! terminal.

use crate::support::{Run, command, directory, shell, tess};
use std::fs;
use std::os::unix::fs::{MetadataExt, PermissionsExt, symlink};
use std::path::Path;

const PATCH: &str = "patch tri --outer 2,3,4 --inner 5";

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("the folder");
    let mut names: Vec<_> = entries
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

fn done(run: &Run) {
    run.exits(0);
}

/// Every command writes its files in the same way: a link stays a link, and its target keeps its
/// mode.
#[test]
fn links_and_modes_are_kept() {
    let folder = directory("links_and_modes");
    for (name, words) in [
        ("patch.txt", PATCH.to_owned()),
        ("patch.svg", PATCH.replace("patch", "draw")),
        ("explain.txt", PATCH.replace("patch", "explain")),
        ("vectors.csv", "gen --level 3 --count 5".to_owned()),
        ("model.obj", "mesh --factor 1".to_owned()),
        ("model.glb", "mesh --factor 1".to_owned()),
        ("model.png", "mesh --factor 1 --size 8x8".to_owned()),
    ] {
        let (file, link) = (folder.join(format!("real-{name}")), folder.join(name));
        fs::write(&file, "old").expect("an old file");
        fs::set_permissions(&file, PermissionsExt::from_mode(0o600)).expect("a private file");
        symlink(file.file_name().expect("a name"), &link).expect("a link");
        done(&tess(&format!("{words} -o {}", link.display())));
        assert!(link.is_symlink(), "{name}: the link stays");
        assert_eq!(file.metadata().expect("the file").mode() & 0o777, 0o600, "{name}: its mode");
        assert_ne!(fs::read(&file).expect("the file"), b"old", "{name}: it is written");
    }
    symlink("new.txt", folder.join("dangling.txt")).expect("a link to nothing");
    done(&tess(&format!("{PATCH} -o {}/dangling.txt", folder.display())));
    assert!(folder.join("new.txt").is_file(), "the target of a dangling link is made");
    assert!(names(&folder).iter().all(|name| !name.starts_with('.')), "{:?}", names(&folder));
}

/// New files have the permissions that the user's mask permits.
#[test]
fn new_files_follow_the_mask() {
    let folder = directory("new_files_follow_the_mask");
    let script = format!(
        "umask 027; $TESS {PATCH} -o a.txt && $TESS mesh --factor 1 -o a.obj && \
         $TESS gen --level 3 --count 3 --format readmemh -o images"
    );
    done(&shell(&script, &folder));
    for (name, mode) in [("a.txt", 0o640), ("a.obj", 0o640), ("images", 0o750)] {
        let found = folder.join(name).metadata().expect("it is there").mode() & 0o777;
        assert_eq!(found, mode, "{name}: {found:o}");
    }
}

/// A named pipe is written to, not replaced, by formats that are written from beginning to end and
/// by those that are not.
#[test]
fn pipes_are_streamed() {
    let folder = directory("pipes_are_streamed");
    for (name, words) in [("p.txt", PATCH), ("p.glb", "mesh --factor 1")] {
        let script = format!(
            "mkfifo {name}; cat {name} > got & $TESS {words} -o {name} && test -p {name} && wait && \
             $TESS {words} -o file-{name} && cmp got file-{name} || {{ kill $!; exit 1; }}"
        );
        done(&shell(&script, &folder));
    }
}

/// `-`, `/dev/stdout` and no option are the same: the output is appended to the file that stdout is
/// redirected to.
#[test]
fn stdout_by_any_name() {
    let folder = directory("stdout_by_any_name");
    let expected = tess(PATCH).stdout;
    for option in ["", "-o -", "-o /dev/stdout", "-o /proc/self/fd/1"] {
        let run = shell(&format!("(echo first; $TESS {PATCH} {option}) > got; cat got"), &folder);
        assert_eq!(run.stdout, format!("first\n{expected}"), "{option}: {}", run.stderr);
    }
    let script = "$TESS mesh --factor 1 --format obj -o - > a.obj && $TESS mesh --factor 1 -o b.obj \
                  && cmp a.obj b.obj";
    done(&shell(script, &folder));
    tess("mesh --factor 1 -o -").exits(2).says("--format");
}

/// A name may be as long as the system allows.
#[test]
fn long_names() {
    let folder = directory("long_names");
    let long = "x".repeat(246);
    for (name, words) in [
        (format!("{long}.txt"), PATCH),
        (format!("{long}.obj"), "mesh --factor 1"),
        (long.clone(), "gen --level 3 --count 3 --format readmemh"),
    ] {
        done(&tess(&format!("{words} -o {}", folder.join(&name).display())));
    }
    assert_eq!(names(&folder).len(), 3, "nothing else");
}

/// Outputs that cannot be written: exit code 2 and the reason, and existing files stay.
#[test]
fn failures_change_nothing() {
    let folder = directory("failures_change_nothing");
    fs::create_dir(folder.join("folder.txt")).expect("a folder");
    symlink("circle.txt", folder.join("circle.txt")).expect("a circle");
    fs::write(folder.join("file"), "file").expect("a file");
    let before = names(&folder);
    for name in ["folder.txt", "circle.txt", "nowhere/a.txt", "file/a.txt"] {
        tess(&format!("{PATCH} -o {}", folder.join(name).display())).exits(2).says("cannot write");
    }
    assert_eq!(names(&folder), before, "nothing else");
    tess(&format!("{PATCH} -o /dev/full")).exits(2); // a full device
}

/// A stdout that cannot be written to is an error, even for help.
#[test]
fn a_full_stdout() {
    let folder = directory("a_full_stdout");
    let mut commands =
        vec![PATCH, "gen --level 3 --count 10", "explain tri --outer 1,1,1 --inner 1"];
    commands.extend(["--help", "--version", "help patch", "bench --help"]);
    if cfg!(feature = "probe") {
        commands.push("probe --list");
    }
    if cfg!(feature = "gpu") {
        commands.push("patch tri --outer 2,3,4 --inner 5 --backend gpu");
    }
    for words in commands {
        shell(&format!("$TESS {words} > /dev/full"), &folder).exits(2).says("cannot write stdout");
        shell(&format!("$TESS {words} > /dev/null"), &folder).exits(0);
    }
}

/// Messages name the file that was asked for, not the temporary file next to it.
#[cfg(target_os = "linux")]
#[test]
fn messages_have_no_temporary_names() {
    for words in [PATCH.to_owned(), PATCH.replace("patch", "explain"), "mesh".to_owned()] {
        let run = tess(&format!("{words} -o /proc/a.obj"));
        run.exits(2).says("cannot write /proc/a.obj");
        assert!(!run.stderr.contains(".tess-"), "{words}: {}", run.stderr);
    }
    let run = tess("gen --level 3 --count 1 --format readmemh -o /proc/a");
    assert!(run.stderr.contains("/proc/a") && !run.stderr.contains(".tess-"), "{}", run.stderr);
}

/// The binary part of a glTF file replaces only the binary part of the same glTF file.
#[test]
fn the_bin_of_a_gltf() {
    let folder = directory("the_bin_of_a_gltf");
    let [gltf, bin] = ["model.gltf", "model.bin"].map(|name| folder.join(name));
    fs::write(&bin, "something else").expect("a file");
    let mesh = format!("mesh --factor 1 -o {}", gltf.display());
    tess(&mesh).exits(2).says("model.bin is there already");
    assert_eq!(fs::read(&bin).expect("the file"), b"something else", "as it was");
    assert_eq!(names(&folder), ["model.bin"], "nothing else");

    fs::remove_file(&bin).expect("removed");
    done(&tess(&mesh));
    let before = [&gltf, &bin].map(|path| fs::read(path).expect("written"));
    tess(&mesh.replace("--factor 1", "--factor 64 --indices 16")).exits(2); // too many vertices
    let after = [&gltf, &bin].map(|path| fs::read(path).expect("still there"));
    assert!(before == after, "both are as they were");
    done(&tess(&mesh.replace("--factor 1", "--factor 2")));
    assert_ne!(fs::read(&bin).expect("written"), before[1], "its own is replaced");
    shell("mkfifo p.gltf; $TESS mesh --factor 1 -o p.gltf", &folder).exits(2).says("--format glb");
}

/// Characters that have a meaning in a URI are encoded, and such a file can be read back.
#[test]
fn uris_are_encoded() {
    let folder = directory("uris_are_encoded");
    let gltf = folder.join("a b#c?d%41.gltf");
    done(&Run::of(command("mesh --factor 2 -o").arg(&gltf)));
    let text = fs::read_to_string(&gltf).expect("the glTF");
    assert!(text.contains("\"a%20b%23c%3Fd%2541.bin\""), "{text}");
    done(&Run::of(command("mesh --factor 1 -o").arg(folder.join("out.obj")).arg(&gltf)));
}

/// A picture or a binary mesh is not written to a terminal; text is.
#[test]
fn no_pictures_on_terminals() {
    for (words, code) in [
        (format!("{PATCH} --format png"), 2),
        (PATCH.replace("patch", "draw --format png"), 2),
        ("mesh --factor 1 --format glb -o -".to_owned(), 2),
        (PATCH.to_owned(), 0),
    ] {
        let run = Run::of(command(&words).stdout(terminal()));
        run.exits(code);
        assert_eq!(run.stderr.contains("-o FILE"), code == 2, "{words}: {}", run.stderr);
    }
}

/// A terminal, as a program sees it. What is written to it is read and discarded.
fn terminal() -> fs::File {
    use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
    let ours = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY).expect("a terminal");
    grantpt(&ours).expect("granted");
    unlockpt(&ours).expect("unlocked");
    let name = ptsname(&ours, Vec::new()).expect("its name");
    let path = Path::new(name.to_str().expect("a path"));
    let theirs = fs::File::options().read(true).write(true).open(path).expect("its other side");
    // The copy ends, with an error, when the other side is closed.
    std::thread::spawn(move || std::io::copy(&mut fs::File::from(ours), &mut std::io::sink()));
    theirs
}

/// `--force` replaces everything that the command wrote, and nothing else.
#[test]
#[cfg(feature = "shaders")]
fn shaders_replace_only_shaders() {
    let folder = directory("shaders_replace_only_shaders");
    let write = |options: &str| shell(&format!("$TESS shaders {options} -o out"), &folder);
    fs::create_dir(folder.join("out")).expect("an empty folder");
    done(&write("--force --target wgsl"));
    write("--target wgsl").exits(2).says("it exists already; --force replaces it");
    done(&write("--force --target spirv --index-order cache"));
    let written = names(&folder.join("out"));
    assert!(written.contains(&"manifest.json".into()), "{written:?}");
    assert!(written.iter().all(|name| !name.ends_with(".wgsl")), "nothing old stays: {written:?}");
    let manifest = fs::read_to_string(folder.join("out/manifest.json")).expect("a manifest");
    assert!(manifest.contains("\"order\": \"cache\""), "{manifest:.600}");
    // What this command did not write is kept, whatever its manifest quotes.
    fs::write(folder.join("out/thesis.txt"), "mine").expect("another's");
    write("--force --target wgsl").exits(2);
    fs::remove_file(folder.join("out/thesis.txt")).expect("removed");
    let quoting = r#"{"about": "\"format\": \"tess-shaders 1\"", "format": "other", "stages": []}"#;
    fs::write(folder.join("out/manifest.json"), quoting).expect("another's");
    write("--force --target wgsl").exits(2);
    assert_eq!((names(&folder), names(&folder.join("out"))), (vec!["out".into()], written));
}

/// `--stage` writes modules for the user's WGSL, or parts; `--force` replaces them too.
#[test]
#[cfg(all(feature = "gpu", feature = "shaders"))]
fn shaders_of_a_stage() {
    let folder = directory("shaders_of_a_stage");
    let write = |options: &str| {
        shell(&format!("$TESS shaders --target wgsl --domain quad {options} -o out"), &folder)
    };
    let wgsl = "struct Vertex { @builtin(position) position: vec4f }\n\
                fn hull(number: u32) -> QuadFactors { return tess_quad_factors(vec4f(2.0)); }\n\
                fn domain(number: u32, uv: vec2f) -> Vertex { return Vertex(vec4f(uv, 0.0, 1.0)); }\n";
    fs::write(folder.join("user.wgsl"), wgsl).expect("the user's WGSL");
    done(&write("--stage user.wgsl --evaluate"));
    let read = |name: &str| fs::read_to_string(folder.join("out").join(name)).expect(name);
    for (name, entry) in
        [("hull", "tess_hull"), ("evaluate", "tess_evaluate"), ("vertex", "tess_vertex")]
    {
        let text = read(&format!("stage_{name}.wgsl"));
        assert!(text.starts_with(wgsl), "{name}: the user's lines come first");
        assert!(text.contains(&format!("fn {entry}(")), "{name}");
    }
    done(&write("--force --stage"));
    let manifest = read("stage.json");
    assert!(manifest.contains("\"parts\""), "{manifest:.400}");
    let modules = |name: &String| name.starts_with("stage_");
    assert!(!names(&folder.join("out")).iter().any(modules), "no module is left");
    done(&write("--force"));
    assert!(!names(&folder.join("out")).contains(&"stage.json".into()), "nothing of the stage is");
    fs::write(folder.join("wrong.wgsl"), wgsl.replace("-> QuadFactors", "-> TriFactors"))
        .expect("a wrong text");
    fs::write(folder.join("broken.wgsl"), wgsl.to_owned() + "fn f() -> f32 { return 1u; }\n")
        .expect("another");
    for (options, says) in [
        ("--stage wrong.wgsl", "wrong.wgsl: line 2 of your WGSL"),
        ("--stage broken.wgsl", "broken.wgsl: "),
        ("--stage none.wgsl", "cannot read none.wgsl"),
        ("--stage user.wgsl --project seen", "seen"),
        (
            "--stage user.wgsl --points f32",
            "--stage needs --target wgsl or --layout sdl, packed points",
        ),
        ("--stage --evaluate", "name its file, as in --stage FILE"),
    ] {
        write(&format!("--force {options}")).exits(2).says(says);
    }
}

/// `--layout sdl` writes every entry point and a header; what does not go with it is refused.
#[test]
#[cfg(all(feature = "gpu", feature = "shaders"))]
fn shaders_for_sdl() {
    let folder = directory("shaders_for_sdl");
    let write = |options: &str| shell(&format!("$TESS shaders {options} -o out"), &folder);
    let wgsl = "struct Vertex { @builtin(position) position: vec4f }\n\
                fn hull(number: u32) -> TriFactors { return tess_tri_factors(vec3f(2.0)); }\n\
                fn domain(number: u32, uv: vec2f) -> Vertex { return Vertex(vec4f(uv, 0.0, 1.0)); }\n\
                @fragment fn shade(vertex: Vertex) -> @location(0) vec4f { return vec4f(1.0); }\n";
    fs::write(folder.join("user.wgsl"), wgsl).expect("the user's WGSL");
    for (target, ending) in [("spirv", "spv"), ("hlsl", "hlsl"), ("msl", "metal")] {
        done(&write(&format!("--force --target {target} --layout sdl --stage user.wgsl")));
        let written = names(&folder.join("out"));
        for name in ["hull", "decide", "vertex", "fragment_shade"] {
            let name = format!("stage_{name}.{ending}");
            assert!(written.contains(&name), "{name}: {written:?}");
        }
        let header = fs::read_to_string(folder.join("out/tess_stage.h")).expect("a header");
        assert!(header.contains("TESS_FRAGMENT_shade"), "{header:.900}");
        // A compiler of HLSL puts its result beside the text.
        let beside = if ending == "hlsl" { "dxil" } else { ending };
        fs::write(folder.join(format!("out/stage_hull.{beside}")), "compiled").expect("a file");
    }
    for (options, says) in [
        ("--target wgsl --layout sdl --stage user.wgsl", "needs --target spirv, hlsl or msl"),
        ("--target glsl --layout sdl", "needs --target spirv, hlsl or msl"),
        ("--target spirv --layout sdl --stage", "name its file, as in --stage FILE"),
        ("--target spirv --stage user.wgsl", "--stage needs --target wgsl or --layout sdl"),
        ("--target spirv --layout sdl --domain quad --stage user.wgsl", "user.wgsl: "),
    ] {
        write(&format!("--force {options}")).exits(2).says(says);
    }
}

/// Several files need a folder, and stdout is not one.
#[test]
fn folders_are_not_stdout() {
    let folder = directory("folders_are_not_stdout");
    let mut commands = vec!["gen --level 3 --count 1 --format readmemh -o -"];
    if cfg!(feature = "shaders") {
        commands.push("shaders --target spirv -o -");
    }
    for words in commands {
        let run = shell(&format!("$TESS {words}"), &folder);
        run.exits(2).prints_nothing().says("give a folder with -o");
        assert_eq!(names(&folder), [""; 0], "{words}: nothing is made");
    }
}

/// The parent folders of a new folder are created; a file is not a folder.
#[test]
fn folders_around_new_folders() {
    let folder = directory("folders_around_new_folders");
    fs::write(folder.join("file"), "").expect("a file");
    let mut commands = vec![("gen --level 3 --count 1 --format readmemh", "a/b")];
    if cfg!(feature = "shaders") {
        commands.push(("shaders --target wgsl", "c/d/e"));
    }
    for (words, place) in commands {
        done(&shell(&format!("$TESS {words} -o {place}"), &folder));
        assert!(folder.join(place).is_dir(), "{words}");
        let run = shell(&format!("$TESS {words} -o file/b"), &folder);
        run.exits(2).prints_nothing().says("cannot write file/b: ");
    }
}
