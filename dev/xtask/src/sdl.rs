//! The host in C for SDL's GPU interface: builds SDL 3 once, runs the example, and compares its
//! points and indices with the model.

use crate::command::{self, cargo, in_file, target, workspace};
use crate::setup::{self, Need, VULKAN, XVFB};
use std::ffi::OsString;
use std::fs;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

const COMPILERS: Need = Need {
    what: "a C compiler, CMake, pkg-config and headers of X11 (build SDL and the programs)",
    packages: &["gcc", "libc6-dev", "cmake", "pkg-config", "libx11-dev", "libxext-dev"],
    is_there: || {
        ["cc", "cmake", "pkg-config"].into_iter().all(setup::has_program)
            && command::quiet_output(Command::new("pkg-config").args(["--exists", "x11", "xext"]))
                .is_ok()
    },
};

/// How the shaders of try.c are written.
const TRIANGLES: &str = "--target spirv --domain tri --partitioning fractional_even";

/// Parts of SDL that need libraries of the system, or that are not used.
const WITHOUT: &str = "X11_XCURSOR X11_XDBE X11_XFIXES X11_XINPUT X11_XRANDR X11_XSCRNSAVER X11_XSHAPE X11_XSYNC \
    X11_XTEST WAYLAND KMSDRM AUDIO JOYSTICK HAPTIC HIDAPI CAMERA SENSOR POWER DIALOG TRAY RENDER \
    DBUS IBUS LIBUDEV TESTS TEST_LIBRARY EXAMPLES";

/// What the programs share.
const SHARED: [&str; 2] = ["offscreen.c", "compare.c"];

/// Checks the host.
///
/// # Errors
/// A step fails, an output differs from the model's, or a planted fault is not seen.
pub(crate) fn run() -> Result<(), String> {
    setup::provide(&[COMPILERS, VULKAN, XVFB])?;
    let sdl = Sdl::provide()?;
    let program = command::program()?;
    command::run(&mut cargo("build --package tess-capi"))?;
    let [terrain, waves] = [source("terrain.wgsl"), readme("wgsl")?];
    let shaders = |name: &str, options: &str| shaders(&program, &terrain, name, options);
    let stored = shaders("stored", "--target spirv --domain quad --partitioning fractional_odd")?;
    let evaluated = shaders(
        "evaluated",
        "--target spirv --domain quad --partitioning fractional_odd --evaluate",
    )?;
    let other = shaders("other", "--target spirv --domain quad --partitioning fractional_even")?;
    let host = source("tess_sdl.c");
    let (own, picture) = (sdl.terrain("terrain", &stored, &host)?, folder().join("terrain.bmp"));

    let said = Run::of(&own, &stored).words(&["--compare"]).word(&picture).ends_with(0)?;
    room_grows(&said)?;
    let said = Run::of(&own, &stored).words(&["--compare", "--budget", "200000"]).ends_with(0)?;
    stays_coarser(&said)?;

    let said = Run::of(&own, &stored).words(&["--compare", "--ready"]).ends_with(0)?;
    is_ready(&said)?;
    let of_try = self::shaders(&program, &source("try.wgsl"), "try", TRIANGLES)?;
    let tried = sdl.program("try", &source("try.c"), &of_try, &host)?;
    Run::of(&tried, &of_try).word(&folder().join("try.bmp")).ends_with(0)?;

    let (drawn, again) = (sdl.terrain("evaluated", &evaluated, &host)?, folder().join("again.bmp"));
    Run::of(&drawn, &evaluated).words(&["--compare"]).word(&again).ends_with(0)?;
    alike(&picture, &again)?;

    Run::of(&own, &other).words(&["--compare"]).ends_with(1)?;
    println!("as it should be: shaders of another partitioning are seen");
    let faulty = planted(&host, "rows_of(count, rows);", "rows_of((count + 1) / 2, rows);")?;
    let faulty = sdl.terrain("faulty", &stored, &faulty)?;
    Run::of(&faulty, &stored).words(&["--compare"]).ends_with(1)?;
    println!("as it should be: half of the workgroups are seen");
    let said = Run::of(&own, Path::new("nowhere")).ends_with(3)?;
    must(said.contains("nowhere/") && said.contains("cannot be read"), "a sentence", &said)?;

    for language in ["msl", "hlsl"] {
        let options = format!("--target {language} --domain quad --evaluate");
        sdl.compiles(&shaders(language, &options)?, &source("terrain.c"))?;
    }
    rooms(&sdl, &stored, &host)?;
    let of_readme = self::shaders(&program, &waves, "readme", WAVES)?;
    let window = sdl.program("readme", &readme("c")?, &of_readme, &host)?;
    shows_a_window(&window, &of_readme)
}

/// How the README translates its WGSL.
const WAVES: &str = "--target spirv --domain quad --partitioning fractional_odd";

/// The host decides on the rooms that the stage in Rust decides on; one that grows later does not.
fn rooms(sdl: &Sdl, shaders: &Path, host: &Path) -> Result<(), String> {
    let record = workspace().join("bindings/rooms.txt");
    let late = planted(host, "points * 8 > now.points * 7ull", "points * 8 > now.points * 8ull")?;
    for (name, host, code) in [("rooms", host, 0), ("late", &late, 1)] {
        let program = folder().join(name);
        let mut cc = sdl.cc(shaders);
        cc.arg(format!("-DHOST=\"{}\"", host.display())).arg(source("rooms.c"));
        command::run(cc.arg("-o").arg(&program).args(&sdl.libraries))?;
        Run::of(&program, &record).ends_with(code)?;
    }
    println!("as it should be: a room that grows later is seen");
    Ok(())
}

/// An X server without a screen, whose picture is in a file; it ends when this is dropped.
struct Server {
    process: Child,
    display: String,
    picture: PathBuf,
}

impl Server {
    fn start() -> Result<Self, String> {
        let wrong = |error| format!("cannot run Xvfb: {error}");
        let screen = folder().join("screen");
        fs::create_dir_all(&screen).map_err(|error| in_file(&screen, &error))?;
        let mut server = Command::new("Xvfb");
        server.args(["-displayfd", "1", "-screen", "0", "800x600x24", "-nolisten", "tcp"]);
        server.arg("-fbdir").arg(&screen).stdout(Stdio::piped()).stderr(Stdio::null());
        let mut process = server.spawn().map_err(wrong)?;
        let mut number = String::new();
        let said = process.stdout.take().map(|said| BufReader::new(said).read_line(&mut number));
        said.transpose().map_err(wrong)?;
        let (display, picture) = (format!(":{}", number.trim()), screen.join("Xvfb_screen0"));
        Ok(Self { process, display, picture })
    }

    /// How many colours its picture has.
    fn colours(&self) -> Result<usize, String> {
        let bytes = fs::read(&self.picture).map_err(|error| in_file(&self.picture, &error))?;
        // A dump of the format XWD: its length, ..., then a map of as many colours as word 19 says.
        let word = |at: usize| {
            let word = bytes.get(4 * at..).and_then(|rest| rest.first_chunk());
            word.map_or(0, |word| u32::from_be_bytes(*word))
        };
        let head = usize::try_from(word(0) + 12 * word(19)).unwrap_or(usize::MAX);
        let pixels = bytes.get(head..).unwrap_or_default();
        let mut colours: Vec<&[u8; 4]> = pixels.as_chunks().0.iter().collect();
        colours.sort_unstable();
        colours.dedup();
        Ok(colours.len())
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

/// The README's program shows its waves in a window, and ends after as many frames as it was told.
#[expect(clippy::disallowed_methods, reason = "no event tells that the server's picture changed")]
fn shows_a_window(program: &Path, shaders: &Path) -> Result<(), String> {
    let server = Server::start()?;
    let on_display = |mut run: Run| {
        run.0.env("DISPLAY", &server.display).env("SDL_VIDEO_DRIVER", "x11");
        run
    };
    let before = server.colours()?;
    let mut shown = on_display(Run::of(program, shaders)).0.spawn();
    let shown = shown.as_mut().map_err(|error| format!("cannot run the README's: {error}"))?;
    let began = Instant::now();
    let mut colours = before;
    while colours < 1000 && began.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(200));
        colours = server.colours()?;
    }
    let copy = folder().join("window.xwd");
    fs::copy(&server.picture, &copy).map_err(|error| in_file(&copy, &error))?;
    let is_open = shown.try_wait().is_ok_and(|ended| ended.is_none());
    // It may have ended by itself.
    let _ = shown.kill();
    let _ = shown.wait();
    println!("a window: {colours} colours, {before} without it; see {}", copy.display());
    if before > 100 || colours < 1000 || !is_open {
        return Err(format!("the README's window shows {colours} colours, or is gone"));
    }
    let said = on_display(Run::of(program, shaders).words(&["3"])).ends_with(0)?;
    must(said.contains(" triangles"), "the number of triangles", &said)?;
    let mut run = Run::of(program, shaders).words(&["3"]);
    run.0.env("DISPLAY", ":987654").env("SDL_VIDEO_DRIVER", "x11");
    run.ends_with(1).map(drop)
}

/// The variables with which programs outside of the project find SDL, which is built if it is
/// nowhere. Provides a driver and an X server, too.
///
/// # Errors
/// A tool is missing, or SDL does not compile.
pub(crate) fn environment() -> Result<[(&'static str, OsString); 2], String> {
    setup::provide(&[COMPILERS, VULKAN, XVFB])?;
    let Sdl { place, .. } = Sdl::provide()?;
    let found = std::env::var_os("LD_LIBRARY_PATH").map_or_else(OsString::new, |more| {
        let mut found = OsString::from(":");
        found.push(more);
        found
    });
    let mut libraries = OsString::from(place);
    libraries.push(found);
    Ok([("PKG_CONFIG_PATH", packages(&installed())), ("LD_LIBRARY_PATH", libraries)])
}

/// The folder of everything that is made.
fn folder() -> PathBuf {
    target().join("sdl")
}

fn source(name: &str) -> PathBuf {
    workspace().join("bindings/sdl").join(name)
}

fn must(is: bool, what: &str, said: &str) -> Result<(), String> {
    if is { Ok(()) } else { Err(format!("{what} is missing in what the program said:\n{said}")) }
}

/// Shaders for a text in WGSL in a new folder.
fn shaders(program: &Path, wgsl: &Path, name: &str, options: &str) -> Result<PathBuf, String> {
    let to = folder().join(name);
    let mut tess = Command::new(program);
    tess.args(["shaders", "--layout", "sdl", "--force"]);
    tess.args(options.split(' ')).arg("--stage").arg(wgsl).arg("-o").arg(&to);
    command::run(&mut tess)?;
    Ok(to)
}

/// A copy of a source with a fault.
fn planted(path: &Path, from: &str, to: &str) -> Result<PathBuf, String> {
    let text = command::read(path)?;
    if text.matches(from).count() != 1 {
        return Err(in_file(path, &format!("`{from}` has to be there once")));
    }
    written("faulty.c", &text.replace(from, to))
}

fn written(name: &str, text: &str) -> Result<PathBuf, String> {
    let path = folder().join(name);
    fs::write(&path, text).map_err(|error| in_file(&path, &error))?;
    Ok(path)
}

/// The README's text in a language.
fn readme(language: &str) -> Result<PathBuf, String> {
    let text = command::read(&source("README.md"))?;
    let begin = format!("```{language}\n");
    let code = text.split_once(&begin).and_then(|(_, rest)| rest.split_once("```\n"));
    let (code, _) =
        code.ok_or_else(|| format!("bindings/sdl/README.md has no text in {language}"))?;
    written(&format!("readme.{language}"), code)
}

/// The numbers of a line `...: A triangles needed, B drawn, scale C`.
fn numbers(line: &str) -> Option<(u64, u64, f64)> {
    let (_, said) = line.split_once(": ")?;
    let (needed, said) = said.split_once(" triangles needed, ")?;
    let (drawn, scale) = said.split_once(" drawn, scale ")?;
    Some((needed.parse().ok()?, drawn.parse().ok()?, scale.parse().ok()?))
}

/// The first frames are coarser, but drawn; later ones are whole.
fn room_grows(said: &str) -> Result<(), String> {
    let frames: Vec<_> = said.lines().filter_map(numbers).filter(|one| one.0 > 0).collect();
    let is_coarser = frames.first().is_some_and(|one| one.1 > 0 && one.2 < 1.0);
    let is_whole = frames.last().is_some_and(|one| one.0 == one.1 && one.2 >= 1.0);
    must(is_coarser, "a coarser frame at first", said)?;
    must(is_whole, "a whole frame at last", said)
}

/// Where room was made before the first frame, no frame is coarser.
fn is_ready(said: &str) -> Result<(), String> {
    let frames: Vec<_> = said.lines().filter_map(numbers).skip(2).collect();
    let is_whole = |one: &(u64, u64, f64)| 0 < one.0 && one.0 == one.1 && one.2 >= 1.0;
    must(!frames.is_empty() && frames.iter().all(is_whole), "a whole frame each time", said)
}

/// Within a budget that is too small, every frame is drawn and coarser.
fn stays_coarser(said: &str) -> Result<(), String> {
    let frames: Vec<_> = said.lines().filter_map(numbers).filter(|one| one.0 > 0).collect();
    let is_coarser = |one: &(u64, u64, f64)| 0 < one.1 && one.1 < one.0 && one.2 < 1.0;
    must(!frames.is_empty() && frames.iter().all(is_coarser), "a coarser frame each time", said)
}

/// Two pictures in which few bytes differ: a device may round a point in a draw and in a pass
/// differently.
fn alike(one: &Path, other: &Path) -> Result<(), String> {
    let read = |path: &Path| fs::read(path).map_err(|error| in_file(path, &error));
    let (a, b) = (read(one)?, read(other)?);
    let differing = a.iter().zip(&b).filter(|(a, b)| a != b).count();
    println!("{differing} of {} bytes differ in the pictures", a.len());
    if a.len() != b.len() || differing * 1000 > a.len() {
        return Err(format!("{} and {} differ", one.display(), other.display()));
    }
    let mut colours: Vec<&[u8; 4]> = a.as_chunks().0.iter().collect();
    colours.sort_unstable();
    colours.dedup();
    // A picture of the sky alone has one.
    if colours.len() > 1000 { Ok(()) } else { Err(in_file(one, &"it shows no terrain")) }
}

/// A run of the example.
struct Run(Command);

impl Run {
    fn of(program: &Path, shaders: &Path) -> Self {
        let mut command = Command::new(program);
        command.arg(shaders);
        Self(command)
    }

    fn words(mut self, words: &[&str]) -> Self {
        self.0.args(words);
        self
    }

    fn word(mut self, word: &Path) -> Self {
        self.0.arg(word);
        self
    }

    /// What it says, if it ends with this code.
    fn ends_with(mut self, code: i32) -> Result<String, String> {
        let shown = command::shown(&self.0);
        println!("\n$ {shown}");
        let output = self.0.output().map_err(|error| format!("cannot run `{shown}`: {error}"))?;
        let said =
            [output.stdout, output.stderr].map(|it| String::from_utf8_lossy(&it).into_owned());
        let said = said.concat();
        print!("{said}");
        match output.status.code() == Some(code) {
            true => Ok(said),
            false => Err(format!("`{shown}` ended with {}, not {code}\n{said}", output.status)),
        }
    }
}

/// What compiles against SDL and links with it.
struct Sdl {
    flags: Vec<String>,
    libraries: Vec<String>,
    /// The folder of the library.
    place: String,
}

/// Where SDL is installed, if the system has none.
fn installed() -> PathBuf {
    folder().join("installed-with-x11")
}

impl Sdl {
    /// The system's SDL 3, or one that is built from the sources of the crate `sdl3-src`.
    fn provide() -> Result<Self, String> {
        let installed = installed();
        if pkg_config(&installed, &["--exists"]).is_err() {
            build(&installed)?;
        }
        let words = |option| -> Result<Vec<String>, String> {
            let said = pkg_config(&installed, &[option])?;
            Ok(said.split_whitespace().map(str::to_owned).collect())
        };
        let mut libraries = words("--libs")?;
        let place = pkg_config(&installed, &["--variable=libdir"])?.trim().to_owned();
        libraries.push(format!("-Wl,-rpath,{place}"));
        Ok(Self { flags: words("--cflags")?, libraries, place })
    }

    fn cc(&self, shaders: &Path) -> Command {
        let mut cc = Command::new("cc");
        cc.args("-std=c99 -O2 -Wall -Wextra -Wpedantic -Werror".split(' ')).args(&self.flags);
        cc.arg("-I").arg(shaders).arg("-I").arg(source(""));
        cc
    }

    /// Builds the example with the model, and returns its path.
    fn terrain(&self, name: &str, shaders: &Path, host: &Path) -> Result<PathBuf, String> {
        self.program(name, &source("terrain.c"), shaders, host)
    }

    fn program(
        &self,
        name: &str,
        main: &Path,
        shaders: &Path,
        host: &Path,
    ) -> Result<PathBuf, String> {
        let program = folder().join(format!("{name}-program"));
        let mut cc = self.cc(shaders);
        cc.arg("-DTESS_MODEL").arg("-I").arg(workspace().join("bindings/c/include"));
        cc.arg("-o").arg(&program).arg(main).args(SHARED.map(source)).arg(host);
        cc.args(&self.libraries).arg(target().join("debug/libtess_capi.a"));
        command::run(cc.args(["-lpthread", "-ldl", "-lm"]))?;
        Ok(program)
    }

    fn compiles(&self, shaders: &Path, source: &Path) -> Result<(), String> {
        command::run(self.cc(shaders).arg("-fsyntax-only").arg(source))
    }
}

/// `pkg-config` about SDL 3, in this folder or installed by the system.
fn pkg_config(installed: &Path, words: &[&str]) -> Result<String, String> {
    let mut command = Command::new("pkg-config");
    command.args(words).arg("sdl3").env("PKG_CONFIG_PATH", packages(installed));
    command::quiet_output(&mut command)
}

/// Where pkg-config looks first: in this folder.
fn packages(installed: &Path) -> OsString {
    let mut path = OsString::from(installed.join("lib/pkgconfig"));
    if let Some(more) = std::env::var_os("PKG_CONFIG_PATH") {
        path.push(":");
        path.push(more);
    }
    path
}

/// Builds SDL, which takes minutes, once.
fn build(installed: &Path) -> Result<(), String> {
    let crate_of = workspace().join("bindings/sdl/source/Cargo.toml");
    let mut cargo = cargo("run --quiet --manifest-path");
    cargo.arg(crate_of).env("CARGO_TARGET_DIR", folder().join("source"));
    let sources = command::output(&mut cargo)?;
    let built = folder().join("build");
    let mut cmake = Command::new("cmake");
    cmake.arg("-S").arg(sources.trim()).arg("-B").arg(&built);
    cmake.args("-DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_LIBDIR=lib".split(' '));
    cmake.args("-DSDL_UNIX_CONSOLE_BUILD=ON -DSDL_SHARED=ON -DSDL_STATIC=OFF".split(' '));
    cmake.args(WITHOUT.split_whitespace().map(|part| format!("-DSDL_{part}=OFF")));
    cmake.arg(format!("-DCMAKE_INSTALL_PREFIX={}", installed.display()));
    command::run(&mut cmake)?;
    let mut cmake = Command::new("cmake");
    command::run(cmake.arg("--build").arg(&built).args(["--parallel", "--target", "install"]))
}
