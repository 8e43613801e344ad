//! Other compilers, processors and systems, on which the same bits are expected.

mod cross;
mod macos;
mod miri;
mod msrv;
mod wasm;
mod windows;

/// How much of a port is checked.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Extent {
    /// The recorded results of `golden/` and other checks that take seconds, for continuous
    /// integration.
    Brief,
    /// Every test that can run there.
    Whole,
}

/// A port: its name on the command line, and its check.
struct Port {
    name: &'static str,
    check: fn(Extent) -> Result<(), String>,
}

const PORTS: &[Port] = &[
    Port { name: "msrv", check: |_| msrv::check() },
    Port { name: "i686", check: |extent| cross::check(&cross::I686, extent) },
    Port { name: "aarch64", check: |extent| cross::check(&cross::AARCH64, extent) },
    Port { name: "s390x", check: |extent| cross::check(&cross::S390X, extent) },
    Port { name: "windows", check: windows::check },
    Port { name: "macos", check: |_| macos::check() },
    Port { name: "wasm", check: wasm::check },
    Port { name: "miri", check: miri::check },
];

/// Checks these ports, or all of them if none is given.
///
/// # Errors
/// A name is not that of a port, something cannot be installed, or a port fails; the other ports
/// are checked nevertheless.
pub(crate) fn run(names: &[&str], extent: Extent) -> Result<(), String> {
    if let Some(name) = names.iter().find(|name| PORTS.iter().all(|port| port.name != **name)) {
        let known: Vec<&str> = PORTS.iter().map(|port| port.name).collect();
        return Err(format!("there is no port `{name}`; there are {}", known.join(", ")));
    }
    let chosen = |port: &&Port| names.is_empty() || names.contains(&port.name);
    let mut failures = Vec::new();
    for port in PORTS.iter().filter(chosen) {
        println!("\n== port {}", port.name);
        if let Err(error) = (port.check)(extent) {
            println!("{}: {error}", port.name);
            failures.push(format!("{}: {error}", port.name));
        }
    }
    if failures.is_empty() { Ok(()) } else { Err(failures.join("\n")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unknown_port_is_an_error() {
        let error = run(&["msrv", "m68k"], Extent::Brief).expect_err("no such port");
        assert!(error.contains("`m68k`") && error.contains("s390x"), "{error}");
    }
}
