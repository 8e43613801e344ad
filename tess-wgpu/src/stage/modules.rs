//! Modules that begin with the user's WGSL, and what is wrong with it.

use super::{StageError, source, wgsl};
use crate::error::{Error, checked};

/// A module that begins with the user's text. Errors name the user's line. `function` is the user's function that the
/// module calls.
pub(super) async fn user_module(
    device: &wgpu::Device,
    function: &str,
    user: &str,
    joined: String,
) -> Result<wgpu::ShaderModule, Error> {
    let mut made = None;
    let outcome = checked(device, || {
        made = Some(device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(function),
            source: wgpu::ShaderSource::Wgsl(joined.into()),
        }));
    });
    let Some(module) = made else {
        return Err(Error::Refused { reason: "no shader module was made".to_owned() });
    };
    let info = module.get_compilation_info().await;
    let is_error = |message: &&wgpu::CompilationMessage| {
        message.message_type == wgpu::CompilationMessageType::Error
    };
    if let Some(error) = info.messages.iter().find(is_error) {
        let line = error.location.map(|location| location.line_number);
        return Err(wrong_wgsl(user, function, line, headline(&error.message)).into());
    }
    outcome?;
    Ok(module)
}

/// An error in a line of the joined text. In a line behind the user's text, the stage's call does not go with what the
/// user declares: something that the message names, or else `function`.
fn wrong_wgsl(user: &str, function: &str, line: Option<u32>, message: String) -> StageError {
    let line = line.filter(|&line| (1..=source::lines(user)).contains(&line));
    if line.is_some() {
        return StageError::Wgsl { line, message };
    }
    let declared = wgsl::declarations(user);
    let named = message.split('`').skip(1).step_by(2);
    let culprit = named
        .chain([function])
        .find_map(|name| declared.iter().find(|declaration| declaration.name == name));
    match culprit {
        None => StageError::Wgsl { line: None, message },
        Some(culprit) => StageError::Wgsl {
            line: Some(culprit.line),
            message: format!(
                "`{}` does not go with the stage ({message}); {}",
                culprit.name,
                StageError::NEEDED
            ),
        },
    }
}

/// What is wrong, without the excerpt of the source: the first line of a compiler's report, and naga's
/// reasons, which begin with `= `.
fn headline(report: &str) -> String {
    let from = report.find("error: ").map_or(report, |at| &report[at + "error: ".len()..]);
    let mut lines = from.trim().lines().map(str::trim);
    let first = lines.next().unwrap_or_default();
    let reasons = lines.filter_map(|line| line.strip_prefix("= "));
    [first].into_iter().chain(reasons).collect::<Vec<_>>().join(": ")
}

#[cfg(test)]
mod tests {
    use super::headline;

    #[test]
    fn reports_are_shortened() {
        let report = "in your shader: error: no such name\n  --> wgsl:3:4\n   |\n   = it is `x`\n";
        assert_eq!(headline(report), "no such name: it is `x`");
        assert_eq!(headline("no more than this"), "no more than this");
    }
}
