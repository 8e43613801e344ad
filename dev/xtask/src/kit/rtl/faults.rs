//! The planted faults of `rtl/dv/tb/faults.txt`: each must be found, by the stage and the signal that stand there.

use super::bench::Bench;
use crate::command::workspace;
use std::time::Instant;

/// Random patches that find every fault.
const PATCHES: &str = "+random=20000";

/// A line of the list.
#[derive(Debug, PartialEq, Eq)]
struct Fault<'a> {
    number: &'a str,
    stage: &'a str,
    signal: &'a str,
    what: &'a str,
}

/// Plants each fault, and prints what finds it.
///
/// # Errors
/// One is not found, or another stage or signal is named first.
pub(crate) fn run(bench: &Bench) -> Result<(), String> {
    let file = workspace().join("rtl/dv/tb/faults.txt");
    let text = std::fs::read_to_string(&file).map_err(|e| format!("{}: {e}", file.display()))?;
    println!("\nplanted faults, each found by random patches:");
    for fault in read(&text)? {
        let began = Instant::now();
        let (succeeded, said) =
            bench.output(&[&format!("+fault={}", fault.number), PATCHES, "+gaps"])?;
        let first = said.lines().find(|line| line.starts_with("MISMATCH")).unwrap_or("nothing");
        let named = format!("MISMATCH stage={} signal={} ", fault.stage, fault.signal);
        if succeeded || !first.starts_with(&named) {
            return Err(format!("fault {} is not found as `{named}`, but: {first}", fault.number));
        }
        let asserts = said.lines().find_map(|line| line.strip_prefix("ASSERTION "));
        let asserts = asserts.and_then(|line| line.split(" at ").next()).unwrap_or("none");
        let seconds = began.elapsed().as_secs_f32();
        println!(
            "  {:>2} {}: {} (assertion: {asserts}), {seconds:.1} s",
            fault.number,
            fault.what,
            &named[9..].trim()
        );
    }
    Ok(())
}

/// The faults of the list.
fn read(text: &str) -> Result<Vec<Fault<'_>>, String> {
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    lines
        .map(|line| {
            let (words, what) = line.split_once(" # ").ok_or(format!("no ` # ` in `{line}`"))?;
            match words.split_whitespace().collect::<Vec<_>>()[..] {
                [number, stage, signal] => Ok(Fault { number, stage, signal, what: what.trim() }),
                _ => Err(format!("not NUMBER STAGE SIGNAL: `{words}`")),
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kit::rtl::names::signals;

    #[test]
    fn the_list_is_read() {
        let text =
            std::fs::read_to_string(workspace().join("rtl/dv/tb/faults.txt")).expect("a file");
        let faults = read(&text).expect("lines");
        assert!(faults.len() >= 12, "all faults");
        assert!(faults.iter().zip(1..).all(|(fault, n)| fault.number == n.to_string()), "in order");
        for Fault { stage, signal, .. } in &faults {
            let is_known = signals().any(|known| (known.stage, known.name) == (*stage, *signal));
            assert!(is_known, "{stage} {signal}");
        }
        assert!(read("1 points\n").is_err(), "a line without a description");
        assert!(read("1 points # what\n").is_err(), "a line without a signal");
    }
}
