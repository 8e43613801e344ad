//! Runs test commands, and counts the tests that they ran.

use crate::command::shown;
use std::collections::VecDeque;
use std::fmt;
use std::io::{BufRead, BufReader};
use std::process::{Command, ExitStatus, Stdio};
use std::sync::Mutex;
use std::sync::mpsc::{self, Receiver};
use std::time::Instant;

/// Numbers of tests, summed up from the lines that test runners print.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct Tally {
    passed: u64,
    failed: u64,
    ignored: u64,
}

impl Tally {
    /// Adds a line such as `test result: ok. 3 passed; 0 failed; 1 ignored; ...`; returns whether
    /// it is one.
    fn add_line(&mut self, line: &str) -> bool {
        let Some(result) = line.trim_start().strip_prefix("test result: ") else { return false };
        let counts = result.split_once(". ").map_or("", |(_, counts)| counts);
        for count in counts.split("; ") {
            let Some((number, what)) = count.split_once(' ') else { continue };
            let number = number.parse::<u64>().unwrap_or(0);
            match what {
                "passed" => self.passed += number,
                "failed" => self.failed += number,
                "ignored" => self.ignored += number,
                _ => {}
            }
        }
        true
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} passed, {} failed, {} skipped", self.passed, self.failed, self.ignored)
    }
}

/// A command that runs tests.
pub(crate) struct Job {
    pub(crate) name: String,
    pub(crate) command: Command,
}

impl Job {
    /// A command, named as a person would type it.
    pub(crate) fn new(command: Command) -> Self {
        Self { name: shown(&command), command }
    }

    /// The size of its program in bytes; 0 for one that is searched for in `PATH`.
    pub(crate) fn size(&self) -> u64 {
        std::fs::metadata(self.command.get_program()).map_or(0, |file| file.len())
    }

    /// The same program with this additional word, which selects tests.
    pub(crate) fn with(&self, word: &str) -> Self {
        let mut command = Command::new(self.command.get_program());
        command.args(self.command.get_args()).arg(word);
        command.envs(self.command.get_envs().filter_map(|(key, value)| Some((key, value?))));
        if let Some(folder) = self.command.get_current_dir() {
            command.current_dir(folder);
        }
        Self { name: format!("{} {word}", self.name), command }
    }
}

/// How a test's head says that only `test all` runs it: `#[ignore = "slow: all 96 setups"]`, or
/// with libtest-mimic a kind that begins so.
const SLOW: &str = "slow: ";

/// The number of tests that commands ran, and the commands that failed.
#[derive(Default)]
pub(crate) struct TestReport {
    all: Tally,
    broken: Vec<String>,
    /// Tests that are marked as slow and were not run, each with its mark.
    slow: Vec<String>,
}

impl TestReport {
    /// Runs the commands one after another, and passes their output on.
    ///
    /// # Errors
    /// A command cannot be started. A command that fails, or that passes without having run a test,
    /// is recorded for [`TestReport::finish`]: a filter that matches nothing must not count as
    /// success.
    pub(crate) fn one_by_one(
        &mut self,
        commands: impl IntoIterator<Item = Command>,
    ) -> Result<(), String> {
        for mut command in commands {
            let passed_before = self.all.passed;
            let name = shown(&command);
            println!("\n$ {name}");
            if !run_one(&mut command, &mut self.all)? {
                self.broken.push(name);
            } else if self.all.passed == passed_before {
                self.broken.push(format!("{name} (no test ran)"));
            }
        }
        Ok(())
    }

    /// Runs the jobs, several at a time. Prints the line of each test when it ends, and the rest of
    /// a job's output when the job ends. A job may have no tests, but must report that; otherwise a
    /// program that ends before its tests would pass.
    ///
    /// # Errors
    /// As for [`TestReport::one_by_one`], or if all jobs together ran no test.
    pub(crate) fn beside_each_other(&mut self, jobs: Vec<Job>) -> Result<(), String> {
        let passed_before = self.all.passed;
        let (total, workers) = (jobs.len(), at_once());
        let waiting = Mutex::new(jobs.into_iter().collect::<VecDeque<_>>());
        let (sender, news) = mpsc::channel();
        let take = || waiting.lock().ok().and_then(|mut jobs| jobs.pop_front());
        std::thread::scope(|scope| {
            for sender in std::iter::repeat_n(sender, workers) {
                scope.spawn(move || {
                    while let Some(Job { name, command }) = take() {
                        // The receiver outlives all senders.
                        let tell = |news| _ = sender.send((name.clone(), news));
                        tell(News::Ended(captured(command, |line| tell(News::Test(line)))));
                    }
                });
            }
            self.receive(total, news)
        })?;
        if self.all.passed == passed_before {
            self.broken.push("no test ran".to_owned());
        }
        Ok(())
    }

    /// Prints and counts the jobs' output.
    fn receive(&mut self, total: usize, news: Receiver<(String, News)>) -> Result<(), String> {
        let mut number = 0;
        for (name, news) in news {
            let output = match news {
                News::Test(line) => {
                    println!("{name}: {line}");
                    if line.contains(SLOW) {
                        self.slow.push(format!("{name}: {line}"));
                    }
                    continue;
                }
                News::Ended(output) => output.map_err(|error| format!("{name}: {error}"))?,
            };
            let Captured { text, status, seconds } = output;
            number += 1;
            println!("\n[{number} of {total}] {name}, {seconds} s\n{}\n", text.trim());
            let results = text.lines().filter(|line| self.all.add_line(line)).count();
            match (status.success(), results) {
                (true, 1..) => {}
                (true, 0) => self.broken.push(format!("{name} (no result)")),
                // A program that crashes has no result either; its exit status is the only reason
                // known.
                (false, 0) => self.broken.push(format!("{name} (no result; {status})")),
                (false, _) => self.broken.push(name),
            }
        }
        Ok(())
    }

    /// Programs and tests that were not run because they are slow: these programs, and every test
    /// that was ignored with [`SLOW`] as its reason.
    pub(crate) fn not_run<'a>(&'a self, programs: &'a [String]) -> impl Iterator<Item = &'a str> {
        programs.iter().chain(&self.slow).map(String::as_str)
    }

    /// Prints the tally, and returns it.
    ///
    /// # Errors
    /// A command failed.
    pub(crate) fn finish(self) -> Result<Tally, String> {
        println!("\n{}", self.all);
        match self.broken.is_empty() {
            true => Ok(self.all),
            false => Err(format!("these failed: {}", self.broken.join("; "))),
        }
    }
}

/// Runs every command, even after a failure, and prints their output and the tally.
///
/// # Errors
/// A command fails, or passes without having run a test.
pub(crate) fn run(commands: impl IntoIterator<Item = Command>) -> Result<(), String> {
    let mut report = TestReport::default();
    report.one_by_one(commands)?;
    report.finish().map(drop)
}

/// News of a job.
enum News {
    /// The line of a test that has ended, without its first word.
    Test(String),
    Ended(Result<Captured, String>),
}

/// The rest of a command's output, from both of its streams.
struct Captured {
    text: String,
    status: ExitStatus,
    seconds: u64,
}

/// The number of test programs that run at the same time. Each has a thread per processor, but few
/// are busy at its end, so a second program fills the gaps. More programs take memory and gain
/// nothing.
fn at_once() -> usize {
    std::thread::available_parallelism().map_or(1, |count| count.get().clamp(1, 4))
}

/// Runs a command and keeps its output, except for the lines of tests, which are passed on at once.
fn captured(mut command: Command, tell: impl Fn(String)) -> Result<Captured, String> {
    let began = Instant::now();
    let (reader, writer) = std::io::pipe().map_err(|error| error.to_string())?;
    let both = writer.try_clone().map_err(|error| error.to_string())?;
    let mut child = command.stdout(writer).stderr(both).spawn().map_err(|e| e.to_string())?;
    // The command holds the other end of the pipe, which would otherwise never close.
    drop(command);
    let mut text = String::new();
    for line in BufReader::new(reader).split(b'\n') {
        let line = line.map_err(|error| error.to_string())?;
        let line = String::from_utf8_lossy(&line);
        match line.strip_prefix("test ").filter(|rest| !rest.starts_with("result: ")) {
            Some(test) => tell(test.to_owned()),
            None => text += &format!("{line}\n"),
        }
    }
    let status = child.wait().map_err(|error| error.to_string())?;
    if !status.success() {
        text += &format!("\nended with {status}");
    }
    Ok(Captured { text, status, seconds: began.elapsed().as_secs() })
}

/// Runs a command and passes its output on; returns whether it succeeded.
fn run_one(command: &mut Command, tally: &mut Tally) -> Result<bool, String> {
    let name = shown(command);
    let cannot = |error| format!("cannot run `{name}`: {error}");
    let mut child = command.stdout(Stdio::piped()).spawn().map_err(cannot)?;
    let output = child.stdout.take().ok_or("no output to read")?;
    for line in BufReader::new(output).lines() {
        let line = line.map_err(cannot)?;
        println!("{line}");
        tally.add_line(&line);
    }
    Ok(child.wait().map_err(cannot)?.success())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tallies_result_lines_alone() {
        let mut tally = Tally::default();
        tally.add_line("test result: FAILED. 3 passed; 2 failed; 1 ignored; 0 measured; 9 filtered out; finished in 0.10s");
        tally
            .add_line("test result: ok. 4 passed; 0 failed; 0 ignored; 0 measured; 0 filtered out");
        tally.add_line("test 7 passed; 7 failed");
        assert_eq!(tally, Tally { passed: 7, failed: 2, ignored: 1 }, "sums");
    }

    #[test]
    fn a_command_without_tests_is_a_failure() {
        let says = |text: &str| {
            let mut echo = Command::new("echo");
            echo.arg(text);
            run([echo])
        };
        assert_eq!(says("test result: ok. 1 passed; 0 failed"), Ok(()), "one test");
        let none =
            says("test result: ok. 0 passed; 0 failed; 0 ignored; 0 measured; 9 filtered out");
        assert!(none.is_err_and(|message| message.contains("no test ran")), "none");
    }
    /// Runs these shell scripts as jobs; returns their failures.
    #[cfg(unix)]
    fn beside_each_other(scripts: &[&str]) -> Result<(), String> {
        let jobs = scripts.iter().map(|script| {
            let mut shell = Command::new("sh");
            shell.args(["-c", script]);
            Job { name: format!("job {script}"), command: shell }
        });
        let mut report = TestReport::default();
        report.beside_each_other(jobs.collect())?;
        report.finish().map(drop)
    }

    #[cfg(unix)]
    #[test]
    fn jobs_are_counted_and_faults_are_seen() {
        const ONE: &str = "echo 'test result: ok. 1 passed; 0 failed'";
        const NONE: &str = "echo 'test result: ok. 0 passed; 0 failed'";
        assert_eq!(beside_each_other(&[ONE, NONE, ONE, ONE]), Ok(()), "one job has no test");
        for (faulty, said) in [
            ("echo 'test result: FAILED. 0 passed; 1 failed'; exit 101", "exit 101"),
            ("exit 0", "no result"),
            ("kill -9 $$", "no result; signal: 9"),
            ("echo 'test result: ok. 1 passed; 0 failed' >&2; kill -9 $$", "kill"),
        ] {
            let result = beside_each_other(&[ONE, faulty, ONE]);
            assert!(result.is_err_and(|message| message.contains(said)), "{faulty}");
        }
        assert!(beside_each_other(&[NONE]).is_err_and(|m| m.contains("no test ran")), "no test");
    }
}
