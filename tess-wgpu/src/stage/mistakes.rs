//! Reports mistakes by the user's names and lines, where a compiler or wgpu would use its own
//! terms.

use super::wgsl::{self, Declaration};
use super::{StageError, source};
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

/// Refuses a `hull` that returns the factors of another domain.
pub(super) fn check_hull(declared: &[Declaration<'_>], domain: Domain) -> Result<(), StageError> {
    let is_hull = |one: &&Declaration<'_>| one.keyword == "fn" && one.name == "hull";
    let Some(hull) = declared.iter().find(is_hull) else { return Ok(()) };
    let head = hull.text.split('{').next().unwrap_or_default();
    let expected = factors_of(domain);
    let returned = Domain::ALL.map(factors_of).into_iter().find(|kind| source::uses(head, kind));
    match returned {
        Some(other) if other != expected => Err(StageError::Wgsl {
            line: Some(hull.line),
            message: format!(
                "`hull` returns `{other}`, and the stage was made for Domain::{domain:?}: return \
                 `{expected}`, or make the stage for the other domain"
            ),
        }),
        _ => Ok(()),
    }
}

/// Turns wgpu's refusal of a pipeline, which names a binding by its numbers, into an error with the
/// binding's name and line. `visibility` is that of the shader stage that reads the binding.
pub(super) fn explained(error: Error, user: &str, visibility: &str) -> Error {
    let Error::Refused { reason } = &error else { return error };
    let number = |key: &str| {
        let digits = reason.split_once(key)?.1;
        digits.split(|c: char| !c.is_ascii_digit()).next()?.parse::<u32>().ok()
    };
    let (Some(group), Some(binding)) = (number("group: "), number("binding: ")) else {
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
