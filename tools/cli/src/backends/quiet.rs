//! The environment that the loader of GPU drivers wants.

/// Begins the program again with `XDG_RUNTIME_DIR` set, if it is not.
///
/// Mesa's loader looks for a Wayland display there, and complains on stderr, twice for each use, if
/// the variable is not set, as on servers. A process cannot safely set its own variables once it has
/// threads. So this must be called before anything is read or written.
#[cfg(target_os = "linux")]
pub(crate) fn start_again_for_loader() {
    use std::os::unix::process::CommandExt;
    const VARIABLE: &str = "XDG_RUNTIME_DIR";
    if std::env::var_os(VARIABLE).is_some() {
        return;
    }
    if let Ok(program) = std::env::current_exe() {
        let mut again = std::process::Command::new(program);
        again.args(std::env::args_os().skip(1)).env(VARIABLE, std::env::temp_dir());
        crate::output::stay_closed();
        // It returns only if it fails, and then the message is all that is wrong.
        drop(again.exec());
    }
}

/// Other systems have no such loader.
#[cfg(not(target_os = "linux"))]
pub(crate) fn start_again_for_loader() {}
