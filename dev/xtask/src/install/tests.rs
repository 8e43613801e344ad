//! A C program finds, links and runs the installed library, with the commands that its author would
//! type.

use super::*;

/// Runs a shell command in `folder`, and returns its output.
fn shell(folder: &Path, line: &str) -> String {
    let mut shell = Command::new("sh");
    shell.args(["-ec", line]).current_dir(folder);
    shell.env("PKG_CONFIG_PATH", folder.join("usr/lib/pkgconfig")).env_remove("LD_LIBRARY_PATH");
    let output = shell.output().expect("a shell");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "`{line}` ended with {}: {said}", output.status);
    String::from_utf8(output.stdout).expect("text")
}

/// The library as the surrounding tests build it, or as cargo builds it.
fn library() -> Built {
    let own = "build -p tess-capi --lib";
    let mut build_tests = match std::env::var("TESS_CAPI_BUILD") {
        Ok(all) => cargo(&format!("{all} --no-run")),
        Err(_) => cargo(own),
    };
    build(build_tests.arg(MESSAGES), System::Linux).expect("a library")
}

#[test]
fn programs_find_what_is_installed() {
    let folder = command::target().join(format!("tmp/install-{}", std::process::id()));
    fs::create_dir_all(&folder).expect("a folder");
    let files = Files { prefix: folder.join("usr"), system: System::Linux };
    files.install(&library()).expect("an installation");
    fs::copy(workspace().join("bindings/c/examples/patch.c"), folder.join("patch.c"))
        .expect("the example");

    let arguments = "tri integer triangle_cw ruler 40a00000 40a00000 40a00000 40a00000";
    shell(&folder, "cc patch.c $(pkg-config --cflags --libs tess) -o shared");
    let needed = shell(&folder, "readelf -d shared");
    assert!(needed.contains("[libtess.so"), "the shared library is taken where both are: {needed}");
    let shared = shell(&folder, &format!("LD_LIBRARY_PATH=usr/lib ./shared {arguments}"));
    assert!(shared.starts_with("points 27\n"), "the patch: {shared}");

    let project = workspace().join("bindings/c/examples/cmake");
    let build = "-DCMAKE_PREFIX_PATH=$PWD/usr -DCMAKE_C_FLAGS=-Werror -DCMAKE_CXX_FLAGS='-Wall -Wextra -Werror'";
    shell(
        &folder,
        &format!("cmake -S {} -B build {build} && cmake --build build", project.display()),
    );
    assert!(
        shell(&folder, "readelf -d build/batch").contains("libtess.so"),
        "tess::tess is the shared library"
    );
    assert!(
        !shell(&folder, "readelf -d build/batch_static").contains("libtess.so"),
        "tess::static is the archive"
    );
    let batch = shell(&folder, "build/batch");
    assert!(batch.starts_with("1000 patches, "), "each compared with the model: {batch}");
    assert_eq!(shell(&folder, "build/batch_static"), batch, "the same in C++");
    let later =
        format!("sed 's/tess 0.1/tess 0.2/' {}/CMakeLists.txt > CMakeLists.txt", project.display());
    shell(
        &folder,
        &format!("{later} && ! cmake -B refused {build} 2> said && grep -q 'version: 0.1.0' said"),
    );

    // If there is no shared library, `-ltess` is the archive.
    shell(&folder, "rm usr/lib/libtess.so*");
    shell(&folder, "cc patch.c $(pkg-config --cflags --static --libs tess) -o static");
    assert_eq!(shell(&folder, &format!("./static {arguments}")), shared, "the same patch");
    shell(&folder, "cc patch.c -Iusr/include usr/lib/libtess.a -lpthread -ldl -lm -o whole");
    let size = |name: &str| fs::metadata(folder.join(name)).expect("a program").len();
    for small in ["static", "build/batch_static"] {
        let (small, whole) = (size(small), size("whole"));
        assert!(4 * small < 3 * whole, "what is not called is left out: {small} of {whole} bytes");
    }

    let version = shell(&folder, "pkg-config --modversion tess");
    assert_eq!(version.trim_end(), VERSION, "as the package");
    fs::remove_dir_all(&folder).expect("the folder was made here");
}

#[test]
fn sonames_change_with_what_may_break() {
    assert_eq!(soname(), "libtess.so.0.1", "before 1.0 every minor version may break programs");
}
