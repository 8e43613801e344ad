//! Running the program.

use std::fmt;
use std::io::Write;
use std::ops::Deref;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use tempfile::TempDir;
use tess_verify::vectors::Fnv1a;

/// The result of a run of the program. Its checks show all of it when they fail.
pub(crate) struct Run {
    command: String,
    pub(crate) code: Option<i32>,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

impl fmt::Display for Run {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { command, code, stdout, stderr } = self;
        write!(f, "{command} ended with {code:?}\n{stdout}\n{stderr}")
    }
}

impl Run {
    /// Runs a command until it ends.
    pub(crate) fn of(command: &mut Command) -> Self {
        let output = command.output().expect("the command runs");
        Self::with(format!("{command:?}"), &output)
    }

    fn with(command: String, Output { status, stdout, stderr }: &Output) -> Self {
        let [stdout, stderr] =
            [stdout, stderr].map(|text| String::from_utf8_lossy(text).into_owned());
        Self { command, code: status.code(), stdout, stderr }
    }

    #[track_caller]
    pub(crate) fn exits(&self, code: i32) -> &Self {
        assert_eq!(self.code, Some(code), "{self}");
        self
    }

    /// Checks that stdout contains this text.
    #[track_caller]
    pub(crate) fn prints(&self, text: impl AsRef<str>) -> &Self {
        assert!(self.stdout.contains(text.as_ref()), "no `{}` on stdout: {self}", text.as_ref());
        self
    }

    /// Checks that stdout is exactly this text.
    #[track_caller]
    pub(crate) fn prints_only(&self, text: &str) -> &Self {
        assert_eq!(self.stdout, text, "{self}");
        self
    }

    #[track_caller]
    pub(crate) fn prints_nothing(&self) -> &Self {
        self.prints_only("")
    }

    /// Checks that stderr contains this text.
    #[track_caller]
    pub(crate) fn says(&self, text: impl AsRef<str>) -> &Self {
        assert!(self.stderr.contains(text.as_ref()), "no `{}` on stderr: {self}", text.as_ref());
        self
    }

    #[track_caller]
    pub(crate) fn says_nothing(&self) -> &Self {
        assert_eq!(self.stderr, "", "{self}");
        self
    }
}

/// Runs `tess` with these arguments.
pub(crate) fn tess(words: &str) -> Run {
    tess_with_input(words, "")
}

/// A digest of what was printed.
pub(crate) fn digest(text: &str) -> String {
    let mut digest = Fnv1a::default();
    digest.words(text.bytes().map(u32::from));
    format!("{:016x}", digest.finish())
}

/// The command `tess` with these arguments.
pub(crate) fn command(words: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_tess"));
    command.args(words.split_whitespace());
    command
}

/// Runs a shell script in which `$TESS` is the program.
#[cfg(unix)]
pub(crate) fn shell(script: &str, folder: &Path) -> Run {
    let mut shell = Command::new("sh");
    shell.args(["-c", script]).current_dir(folder).env("TESS", env!("CARGO_BIN_EXE_tess"));
    Run::of(&mut shell)
}

/// Runs `tess` with these arguments and this stdin.
pub(crate) fn tess_with_input(words: &str, input: &str) -> Run {
    let mut child = command(words)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("tess starts");
    // A program that does not read its input may have closed it.
    _ = child.stdin.take().expect("stdin is piped").write_all(input.as_bytes());
    Run::with(words.to_owned(), &child.wait_with_output().expect("tess ends"))
}

/// Runs `tess` with these arguments and environment variables.
#[cfg(all(feature = "gpu", target_os = "linux"))]
pub(crate) fn tess_with_environment(words: &str, variables: &[(&str, &str)]) -> Run {
    Run::of(command(words).envs(variables.iter().copied()))
}

/// The path of the program.
#[cfg(target_os = "linux")]
pub(crate) fn tess_program() -> &'static Path {
    Path::new(env!("CARGO_BIN_EXE_tess"))
}

/// An empty directory for one run of one test, removed when the value is dropped. Other processes
/// may run the same test at the same time.
pub(crate) struct Folder(TempDir);

impl Deref for Folder {
    type Target = Path;

    fn deref(&self) -> &Path {
        self.0.path()
    }
}

impl AsRef<Path> for Folder {
    fn as_ref(&self) -> &Path {
        self
    }
}

/// Creates a directory for a test.
pub(crate) fn directory(test: &str) -> Folder {
    let mut builder = tempfile::Builder::new();
    let made = builder.prefix(&format!("{test}-")).tempdir_in(env!("CARGO_TARGET_TMPDIR"));
    Folder(made.expect("a directory for the test"))
}

/// Each run of a test has a folder of its own. When two runs used the same path, one removed the
/// folder of the other.
#[test]
fn directories_are_not_shared() {
    let folders = [directory("shared"), directory("shared")];
    assert_ne!(*folders[0], *folders[1], "each run has its own");
    let path = folders[0].to_owned();
    drop(folders);
    assert!(!path.exists(), "and leaves nothing");
}
