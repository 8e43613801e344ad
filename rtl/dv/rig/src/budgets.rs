//! The time that each port of the placed circuit leaves to its user, from the delays that nextpnr
//! writes (SDF).
//!
//! `rtl/fpga/tess_registered.sv` has a register at each port: the cell to which its pad is wired.
//! For an input, the longest path from that register to one of the circuit counts; for an output,
//! the longest path from a register of the circuit. The rest of a clock period is left to the user:
//! for a register, for logic and for the wire to the port.
//!
//! ```text
//! register of point_ready -> wire -> LUT -> wire -> register of the circuit      6.2 ns: 3.8 ns of 10 are left
//! ```

use std::collections::{BTreeMap, HashMap, HashSet};
use std::path::Path;
use tess_commands::command::{self, in_file};

/// The clock period in `rtl/fpga/ecp5.lpf`, in ps.
const PERIOD: u64 = 10_000;

/// The ports with registers: inputs and outputs.
const INPUTS: [&str; 6] =
    ["rst", "patch_valid", "patch", "counts_ready", "point_ready", "primitive_ready"];
const OUTPUTS: [&str; 4] = ["patch_ready", "counts_out", "point_out", "primitive_out"];

/// Prints the time of each port.
///
/// # Errors
/// The file cannot be read, or it lacks a port's register.
pub(crate) fn print(sdf: &Path) -> Result<(), String> {
    let delays = Delays::read(&command::read(sdf)?);
    println!("\n| port | ns of {} left |\n| --- | --- |", PERIOD / 1000);
    for (ports, path) in [(&INPUTS[..], Direction::In), (&OUTPUTS[..], Direction::Out)] {
        for port in ports {
            let longest = delays.longest(port, path);
            let longest = longest.ok_or_else(|| in_file(sdf, &format!("no register at {port}")))?;
            let left = PERIOD.saturating_sub(longest) / 100;
            println!("| `{port}` | {}.{} |", left / 10, left % 10);
        }
    }
    Ok(())
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Direction {
    In,
    Out,
}

/// The delays between pins, in ps. A pin is `CELL/PIN`.
#[derive(Default)]
struct Delays {
    /// From each pin to the next ones.
    next: HashMap<String, Vec<(String, u64)>>,
    /// For each pin at which a path ends, the time before the clock at which a value must arrive.
    setup: HashMap<String, u64>,
    /// The delay from the clock to the output of each register.
    clocked: BTreeMap<String, u64>,
    /// All registers.
    cells: HashSet<String>,
    /// The registers of each port.
    registers: HashMap<String, HashSet<String>>,
}

impl Delays {
    fn read(text: &str) -> Self {
        let text = text.replace('\\', ""); // before each `[`, `]` and `$` of a name
        let mut delays = Self::default();
        let mut cell = String::new();
        for line in text.lines() {
            let words: Vec<&str> =
                line.trim().trim_matches(['(', ')']).split_whitespace().collect();
            match words[..] {
                ["INSTANCE", name] => cell = name.to_owned(),
                ["INTERCONNECT", from, to, .., delay] => delays.add(from, to, longest(delay)),
                ["IOPATH", "CLK", to, .., delay] => {
                    delays.cells.insert(cell.clone());
                    _ = delays.clocked.insert(format!("{cell}/{to}"), longest(delay));
                }
                ["IOPATH", from, to, .., delay] => {
                    delays.add(&format!("{cell}/{from}"), &format!("{cell}/{to}"), longest(delay));
                }
                // (SETUPHOLD (posedge M) (posedge CLK) (SETUP) (HOLD))
                ["SETUPHOLD", _, pin, "(posedge", _, setup, _] => {
                    let pin = format!("{cell}/{}", pin.trim_end_matches(')'));
                    _ = delays.setup.insert(pin, longest(setup));
                }
                _ => {}
            }
        }
        delays
    }

    fn add(&mut self, from: &str, to: &str, delay: u64) {
        // A pad is `PORT$tr_io` or `PORT[BIT]$tr_io`.
        for (pad, register) in [(from, to), (to, from)] {
            if let Some((bit, _)) = pad.split_once("$tr_io/") {
                let port = bit.split('[').next().unwrap_or(bit);
                let registers = self.registers.entry(port.to_owned()).or_default();
                registers.insert(cell_of(register).to_owned());
            }
        }
        self.next.entry(from.to_owned()).or_default().push((to.to_owned(), delay));
    }

    /// The longest path of a port: from its register's output, or to its register's input.
    fn longest(&self, port: &str, direction: Direction) -> Option<u64> {
        let registers = self.registers.get(port)?;
        let mut known = HashMap::new();
        let is_here = |pin: &str| registers.contains(cell_of(pin));
        let starts =
            self.clocked.iter().filter(|(pin, _)| is_here(pin) == (direction == Direction::In));
        let paths = starts.filter_map(|(pin, clock)| {
            let from = match direction {
                Direction::In => self.from(pin, &|pin| self.rest(pin), &mut known)?,
                Direction::Out => {
                    clock + self.from(pin, &|pin| is_here(pin).then_some(0), &mut known)?
                }
            };
            Some(from)
        });
        paths.max()
    }

    /// The time before the clock at which a value must arrive at a register's pin; 0 for pins
    /// without a time in the SDF, such as a reset.
    fn rest(&self, pin: &str) -> Option<u64> {
        let is_register = self.cells.contains(cell_of(pin));
        self.setup.get(pin).copied().or_else(|| is_register.then_some(0))
    }

    /// The longest path from a pin to one for which `ends` returns the rest; `None` if there is
    /// none.
    fn from(
        &self,
        pin: &str,
        ends: &impl Fn(&str) -> Option<u64>,
        known: &mut HashMap<String, Option<u64>>,
    ) -> Option<u64> {
        if let Some(rest) = known.get(pin) {
            return *rest;
        }
        let next = self.next.get(pin).into_iter().flatten();
        let paths = next.filter_map(|(to, delay)| Some(delay + self.from(to, ends, known)?));
        let rest = paths.max().or_else(|| ends(pin));
        known.insert(pin.to_owned(), rest);
        rest
    }
}

/// The cell of a pin.
fn cell_of(pin: &str) -> &str {
    pin.rsplit_once('/').map_or(pin, |(cell, _)| cell)
}

/// The largest number of `(least:typical:most)`.
fn longest(delay: &str) -> u64 {
    let numbers = delay.trim_matches(['(', ')']).rsplit(':');
    numbers.take(1).filter_map(|number| number.parse().ok()).next().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SDF: &str = "\
    (INSTANCE )
        (INTERCONNECT rst\\$tr_io/O in/M (1:2:9) (1:2:9))
        (INTERCONNECT out/Q point_out\\[3\\]\\$tr_io/I (1:2:9) (1:2:9))
        (INTERCONNECT in/Q lut/A (1:2:100) (1:2:100))
        (INTERCONNECT lut/F one/M (1:2:50) (1:2:50))
        (INTERCONNECT lut/F two/CE (1:2:70) (1:2:70))
        (INTERCONNECT one/Q out/M (5:6:9) (5:6:9))
    (INSTANCE lut)
        (IOPATH A F (1:2:30) (1:2:30))
    (INSTANCE in)
        (IOPATH CLK Q (1:2:500) (1:2:500))
    (INSTANCE one)
        (IOPATH CLK Q (1:2:400) (1:2:400))
      (SETUPHOLD (posedge M) (posedge CLK) (1:2:8) (1:2:3))
    (INSTANCE two)
      (SETUPHOLD (posedge CE) (posedge CLK) (1:2:4) (1:2:3))
    (INSTANCE out)
        (IOPATH CLK Q (1:2:500) (1:2:500))
      (SETUPHOLD (posedge M) (posedge CLK) (1:2:8) (1:2:3))
";

    #[test]
    fn the_longest_path_counts() {
        let delays = Delays::read(SDF);
        let input = delays.longest("rst", Direction::In);
        assert_eq!(input, Some(100 + 30 + 70 + 4), "to the register that is furthest");
        let output = delays.longest("point_out", Direction::Out);
        assert_eq!(output, Some(400 + 9), "from the register's clock on");
        assert_eq!(delays.longest("patch", Direction::In), None, "no such register");
    }
}
