//! The commands that ask the verification kit for cases, bins and names.

mod rtl;

/// Runs the command; `None` if there is no such command.
pub(crate) fn run(words: &[&str]) -> Option<Result<(), String>> {
    Some(match *words {
        ["rtl"] => rtl::run(),
        ["rtl", "--long"] => rtl::long(),
        ["rtl", "--prove"] => rtl::prove(),
        ["rtl", "--synth"] => rtl::synthesize(),
        ["rtl", "--place"] => rtl::place(),
        ["rtl", "--names"] => rtl::write_names(),
        _ => return None,
    })
}
