//! Tests of help: every command has it, with an example that runs.

use crate::support::tess;

const COMMANDS: [&str; 5] = ["patch", "explain", "draw", "check", "bench"];

#[test]
fn every_command_is_listed_and_has_an_example() {
    let program = tess("--help");
    program.exits(0);
    let listed = program.stdout.lines().skip_while(|line| !line.starts_with("Commands:")).skip(1);
    let listed: Vec<_> = listed
        .take_while(|line| !line.is_empty())
        .filter(|line| line.starts_with("  ") && !line.starts_with("   "))
        .filter_map(|line| line.split_whitespace().next())
        .filter(|&name| name != "help")
        .collect();
    for command in COMMANDS {
        assert!(listed.contains(&command), "{command} is listed: {listed:?}");
    }
    for command in listed {
        let help = tess(&format!("{command} --help"));
        help.exits(0);
        let example = format!("  tess {command} ");
        help.prints(&example);
    }
}

/// The examples of `patch` and `explain`, except those that write or read files.
#[test]
fn examples_run() {
    for command in ["patch", "explain"] {
        let help = tess(&format!("{command} --help")).stdout;
        let examples = help.lines().filter_map(|line| line.strip_prefix("  tess "));
        let has_file = |line: &&str| line.contains(" -o ") || line.contains(" --signals ");
        let examples: Vec<_> = examples.filter(|line| !has_file(line)).collect();
        assert!(examples.len() >= 2, "{command} has examples:\n{help}");
        for example in examples {
            let run = tess(example);
            run.exits(0);
            assert!(!run.stdout.is_empty(), "{example} prints something");
        }
    }
}

#[test]
fn no_command_and_unknown_commands_are_bad_usage() {
    for words in ["", "tessellate", "patch --what"] {
        tess(words).exits(2).says("Usage");
    }
}

/// A command that this build does not contain is known, and the message says how to get it.
#[cfg(not(all(feature = "gpu", feature = "probe", feature = "shaders")))]
#[test]
fn what_this_build_leaves_out_is_named() {
    let all = [
        ("probe", "probe --level 1", cfg!(feature = "probe")),
        ("probe", "probe --help", cfg!(feature = "probe")),
        ("shaders", "shaders --target wgsl -o out", cfg!(feature = "shaders")),
        ("gpu", "verify --backend gpu", cfg!(feature = "gpu")),
    ];
    for (feature, words, _) in all.into_iter().filter(|(.., is_there)| !is_there) {
        let run = tess(words);
        run.exits(3).prints_nothing();
        let advice = format!("build it with --features {feature}");
        run.says(&advice);
    }
}
