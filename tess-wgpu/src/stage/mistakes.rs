//! Reports mistakes by the user's names and lines, where a compiler or wgpu would use its own
//! terms.

use super::wgsl::{self, Declaration};
use super::{StageError, vertex};
use crate::error::Error;
use tess_core::Domain;

/// The type that `hull` returns for a domain.
const fn factors_of(domain: Domain) -> &'static str {
    match domain {
        Domain::Isoline => "IsolineFactors",
        Domain::Triangle => "TriFactors",
        Domain::Quad => "QuadFactors",
    }
}

/// Refuses a `hull` that takes or returns something else than the stage's domain asks for.
pub(super) fn check_hull(declared: &[Declaration<'_>], domain: Domain) -> Result<(), StageError> {
    let expected = factors_of(domain);
    let Some(hull) = function(declared, "hull") else { return Ok(()) };
    let Signature { parameters, result } = Signature::of(hull, declared);
    let other = Domain::ALL.map(factors_of).into_iter().find(|&kind| result == [kind]);
    if let Some(other) = other.filter(|&other| other != expected && parameters == [["u32"]]) {
        return Err(StageError::Wgsl {
            line: Some(hull.line),
            message: format!(
                "`hull` returns `{other}`, and the stage was made for Domain::{domain:?}: return \
                 `{expected}`, or make the stage for the other domain"
            ),
        });
    }
    check_signature(declared, "hull", &["number: u32"], expected)
}

/// Refuses a `domain` that takes or returns something else than the stage gives and takes.
pub(super) fn check_domain(declared: &[Declaration<'_>]) -> Result<(), StageError> {
    check_signature(declared, "domain", &["number: u32", "uv: vec2<f32>"], "Vertex")
}

/// Refuses a function of `project` that is not there, or that takes or returns something else than
/// a vertex.
pub(super) fn check_project(declared: &[Declaration<'_>], name: &str) -> Result<(), StageError> {
    if function(declared, name).is_none() {
        return Err(StageError::NoSuchFunction { name: name.to_owned() });
    }
    check_signature(declared, name, &["vertex: Vertex"], "Vertex")
}

/// Refuses a function whose parameters or result have other types than these. The compiler reports
/// a function that is missing.
fn check_signature(
    declared: &[Declaration<'_>],
    name: &str,
    parameters: &[&str],
    result: &str,
) -> Result<(), StageError> {
    let Some(found) = function(declared, name) else { return Ok(()) };
    let expected = format!("fn {name}({}) -> {result}", parameters.join(", "));
    let wanted = Declaration { text: &expected, ..*found };
    if Signature::of(found, declared) == Signature::of(&wanted, &[]) {
        return Ok(());
    }
    let head = found.text.split('{').next().unwrap_or_default();
    let from = head.find("fn ").unwrap_or_default();
    let own = head[from..].split_whitespace().collect::<Vec<_>>().join(" ");
    let message = format!("`{own}` does not go with the stage; write `{expected}`");
    Err(StageError::Wgsl { line: Some(found.line), message })
}

fn function<'a, 'b>(declared: &'b [Declaration<'a>], name: &str) -> Option<&'b Declaration<'a>> {
    declared.iter().find(|one| one.keyword == "fn" && one.name == name)
}

/// The types of a function's parameters and of its result, in words and signs, with aliases
/// replaced.
#[derive(Debug, PartialEq, Eq)]
struct Signature<'a> {
    parameters: Vec<Vec<&'a str>>,
    result: Vec<&'a str>,
}

impl<'a> Signature<'a> {
    fn of(function: &Declaration<'a>, declared: &[Declaration<'a>]) -> Self {
        let words = wgsl::tokens(function.text).map(|(_, word)| word);
        let mut words = words.skip_while(|&word| word != "fn").skip_while(|&word| word != "(");
        let (mut depth, mut parameters, mut own) = (0_i32, Vec::new(), Vec::new());
        for word in words.by_ref() {
            match word {
                "(" | "<" => depth += 1,
                ")" | ">" => depth -= 1,
                _ => {}
            }
            if word == "," && depth == 1 || depth == 0 {
                parameters.push(std::mem::take(&mut own));
            } else {
                own.push(word);
            }
            if depth == 0 {
                break;
            }
        }
        let kind = |words: Vec<&'a str>| vertex::plain_type(&words, declared);
        let parameters = parameters.into_iter().filter_map(|words| {
            let colon = words.iter().position(|&word| word == ":")?;
            Some(kind(words[colon + 1..].to_vec()))
        });
        let result = words.skip_while(|&word| word != ">").skip(1).take_while(|&word| word != "{");
        Self { parameters: parameters.collect(), result: kind(result.collect()) }
    }
}

/// Refuses functions that take derivatives where there are none: in `entries`, and in the functions
/// that they call.
pub(super) fn check_derivatives<'a>(
    declared: &[Declaration<'a>],
    entries: &[&'a str],
) -> Result<(), StageError> {
    for one in wgsl::reached(declared, entries) {
        // A user's function of this name is another one.
        let is_own = |name| function(declared, name).is_some();
        let find = |word| DERIVATIVES.iter().find(|own| own.0 == word && !is_own(word));
        let Some((used, remedy)) = wgsl::tokens(one.text).find_map(|(_, word)| find(word)) else {
            continue;
        };
        let message = format!(
            "`{used}` needs derivatives, which only a fragment shader has, and `{}` is called \
             elsewhere; {remedy}",
            one.name
        );
        return Err(StageError::Wgsl { line: Some(one.line), message });
    }
    Ok(())
}

/// Built-in functions that need derivatives, and what to write instead.
const DERIVATIVES: [(&str, &str); 12] = {
    const LEVEL: &str = "use `textureSampleLevel`, or `tess_sample` for heights";
    const NONE: &str = "compute the difference from two places";
    [
        ("textureSample", LEVEL),
        ("textureSampleBias", LEVEL),
        ("textureSampleCompare", "use `textureSampleCompareLevel`"),
        ("dpdx", NONE),
        ("dpdy", NONE),
        ("dpdxCoarse", NONE),
        ("dpdyCoarse", NONE),
        ("dpdxFine", NONE),
        ("dpdyFine", NONE),
        ("fwidth", NONE),
        ("fwidthCoarse", NONE),
        ("fwidthFine", NONE),
    ]
};

/// Turns wgpu's refusal of too many storage buffers into an error that counts only the user's.
/// `own` are the stage's in the same shader, which runs the user's `function`.
pub(super) fn counted(error: Error, function: &'static str, own: u32) -> Error {
    let Error::Refused { reason } = &error else { return error };
    if !reason.contains("Too many bindings of type StorageBuffers") {
        return error;
    }
    match (number(reason, "limit is "), number(reason, "count was ")) {
        (Some(limit), Some(count)) => {
            let (got, most) = (count.saturating_sub(own), limit.saturating_sub(own));
            StageError::TooManyStorageBuffers { function, got, most, own }.into()
        }
        _ => error,
    }
}

/// The number that follows this text.
fn number(reason: &str, key: &str) -> Option<u32> {
    let digits = reason.split_once(key)?.1;
    digits.split(|c: char| !c.is_ascii_digit()).next()?.parse().ok()
}

/// Turns wgpu's refusal of a pipeline, which names a binding by its numbers, into an error with the
/// binding's name and line. `visibility` is that of the shader stage that reads the binding.
pub(super) fn explained(error: Error, user: &str, visibility: &str) -> Error {
    let Error::Refused { reason } = &error else { return error };
    let (Some(group), Some(binding)) = (number(reason, "group: "), number(reason, "binding: "))
    else {
        return error;
    };
    let declared = wgsl::declarations(user);
    let has = |one: &Declaration<'_>, name: &str, number: u32| {
        let written = one.attribute(name).map(|text| text.trim_end_matches(['i', 'u']));
        written.and_then(|text| text.parse().ok()) == Some(number)
    };
    let is_it = |one: &&Declaration<'_>| has(one, "group", group) && has(one, "binding", binding);
    let Some(one) = declared.iter().find(is_it) else { return error };
    let last = reason.lines().map(str::trim).rfind(|line| !line.is_empty()).unwrap_or_default();
    let remedy = if last.contains("isibility") {
        format!("add ShaderStages::{visibility} to the visibility of entry {binding}")
    } else if last.contains("missing") {
        format!("add entry {binding} to it")
    } else {
        format!("let entry {binding} have its type ({})", last.trim_end_matches('.'))
    };
    StageError::Wgsl {
        line: Some(one.line),
        message: format!(
            "`{}` does not go with the layout that `bind_group` got for group {group}: {remedy}",
            one.name
        ),
    }
    .into()
}
