//! Compiles modules that begin with the user's WGSL, and reports the errors in it.

use super::{StageError, source, wgsl};
use crate::error::{Error, checked};

/// A module that begins with the user's text. Errors name the user's line. `function` is the user's
/// function that the module calls.
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
        let (line, message) = match marked(&error.message) {
            Some((line, text)) => (Some(line), format!("in `{text}`: {}", reason(&error.message))),
            None => (error.location.map(|one| one.line_number), headline(&error.message)),
        };
        return Err(wrong_wgsl(user, function, line, message).into());
    }
    outcome?;
    Ok(module)
}

/// The error for a line of the joined text. A line after the user's text belongs to the stage:
/// there, the stage's call does not match a declaration of the user. That is a declaration that the
/// message names, or else `function`.
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

/// A compiler's report without the excerpt of the source: its first line, and naga's reasons, which
/// begin with `= `.
fn headline(report: &str) -> String {
    let from = report.find("error: ").map_or(report, |at| &report[at + "error: ".len()..]);
    let mut lines = from.trim().lines().map(str::trim);
    let first = lines.next().unwrap_or_default();
    let reasons = lines.filter_map(|line| line.strip_prefix("= "));
    let all: Vec<_> = [first].into_iter().chain(reasons).take(2).collect();
    all.join(": ")
}

/// The last line and text that the report of naga's validator marks. They are the innermost,
/// because the report begins with the function.
///
/// ```text
/// 26 | |     let at = place(number) + number;
///    | |              ^^^^^^^^^^^^^^^^^^^^^^ naga::ir::Expression [4]
/// ```
fn marked(report: &str) -> Option<(u32, String)> {
    let (mut source, mut found) = (None, None);
    for row in report.lines().filter(|_| report.contains("validation error: ")) {
        let number = row.split_whitespace().next().and_then(|word| word.parse::<u32>().ok());
        if let Some(number) = number {
            source = Some((number, row));
        } else if let (Some((line, text)), false) = (source, row.contains('╰')) {
            let is_mark = |c: &char| *c == '^';
            let begin = row.chars().take_while(|c| !is_mark(c)).count();
            let length = row.chars().skip(begin).take_while(is_mark).count();
            let text: String = text.chars().skip(begin).take(length).collect();
            found = if text.is_empty() { found } else { Some((line, text)) };
        }
    }
    found
}

/// The innermost reason of such a report, with WGSL's names for types and without naga's internal
/// numbers.
fn reason(report: &str) -> String {
    let last = report.lines().filter_map(|line| line.trim().strip_prefix("= ")).next_back();
    let mut text = last.map_or_else(|| headline(report), str::to_owned);
    let brackets: Vec<_> = text.match_indices('[').map(|one| one.0).collect();
    for at in brackets.into_iter().rev() {
        let length = text[at..].find(']').map_or(0, |end| end + 1);
        if text[at..at + length].trim_matches(['[', ']']).parse::<u32>().is_ok() {
            text.replace_range(at..at + length, "");
        }
    }
    for (kind, name) in [
        ("Float, width: 4", "f32"),
        ("Uint, width: 4", "u32"),
        ("Sint, width: 4", "i32"),
        ("Bool, width: 1", "bool"),
    ] {
        text = text
            .replace(&format!("Scalar {{ kind: {kind} }}"), name)
            .replace(&format!("Scalar({name})"), name);
        for (size, count) in [("Bi", 2), ("Tri", 3), ("Quad", 4)] {
            let vector = format!("Vector {{ size: {size}, scalar: {name} }}");
            text = text.replace(&vector, &format!("vec{count}<{name}>"));
        }
    }
    let text = text.replace("Some()", "").replace(" (of type ", " (");
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::{headline, marked, reason};

    #[test]
    fn reports_are_shortened() {
        let report =
            "in your shader: error: no such name\n  --> wgsl:3:4\n   |\n   = it is `x`\n   = y\n";
        assert_eq!(headline(report), "no such name: it is `x`");
        assert_eq!(headline("no more than this"), "no more than this");
    }

    #[test]
    fn numbers_of_nagas_become_types_and_places() {
        let report = "Shader validation error: Function [2] 'f' is invalid\n   ┌─ a:1:1\n   │  \n\
                      25 │ ╭ fn f() {\n26 │ │     let a = b + c;\n   │ │             ^^^^^ naga::ir::Expression [4]\n\
                      27 │ │ }\n   │ ╰─^ naga::ir::Function [2]\n   = Expression [4] is invalid\n   = Operation Add \
                      can't work with [2] (of type Vector { size: Bi, scalar: Scalar { kind: Float, width: 4 } }) \
                      and Some([13]) (of type Scalar(Scalar { kind: Uint, width: 4 }))\n";
        assert_eq!(marked(report), Some((26, "b + c".to_owned())));
        assert_eq!(reason(report), "Operation Add can't work with (vec2<f32>) and (u32)");
        assert_eq!(
            marked(&report.replace("validation", "parsing")),
            None,
            "these name what is wrong"
        );
    }
}
