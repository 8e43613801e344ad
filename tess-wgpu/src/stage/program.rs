//! The user's WGSL with the bind groups and constants that its shaders take, and checks of it.

use super::wgsl::{self, Declaration};
use super::{StageError, source};
use crate::device::pipelines::PipelineKey;
use crate::error::Error;

/// The user's WGSL, and what its shaders take.
#[derive(Clone, Debug)]
pub(super) struct Program<'a> {
    pub(super) source: &'a str,
    pub(super) layouts: Vec<wgpu::BindGroupLayout>,
    pub(super) bind_groups: Vec<wgpu::BindGroup>,
    pub(super) constants: &'a [(&'a str, f64)],
}

impl<'a> Program<'a> {
    pub(super) const fn new(source: &'a str) -> Self {
        Self { source, layouts: Vec::new(), bind_groups: Vec::new(), constants: &[] }
    }

    /// Adds the next bind group.
    pub(super) fn bind(&mut self, layout: &wgpu::BindGroupLayout, group: &wgpu::BindGroup) {
        self.layouts.push(layout.clone());
        self.bind_groups.push(group.clone());
    }

    /// Whether the WGSL reads the frame's factors.
    pub(super) fn has_factors(&self) -> bool {
        source::uses(self.source, "tess_factors")
    }

    /// The number of the stage's own bind group: the one after the user's.
    pub(super) fn own_group(&self) -> u32 {
        u32::try_from(self.layouts.len()).unwrap_or(u32::MAX)
    }

    /// The key of a pipeline with the user's bind groups, then the stage's own.
    pub(super) fn key(
        &self,
        text: String,
        entry_point: &'static str,
        own: Option<&wgpu::BindGroupLayout>,
    ) -> PipelineKey {
        let layouts = self.layouts.iter().chain(own).cloned().collect();
        let constants = self.constants_of(&wgsl::declarations(self.source));
        PipelineKey { text, entry_point, layouts, constants }
    }

    /// The pipeline constants, keyed by name or, if the constant has the attribute `@id`, by
    /// number.
    fn constants_of(&self, declared: &[Declaration<'_>]) -> Vec<(String, u64)> {
        let key = |name: &str| {
            let declared = declared.iter().find(|one| one.name == name);
            declared.and_then(|one| one.attribute("id")).unwrap_or(name).to_owned()
        };
        self.constants.iter().map(|&(name, value)| (key(name), value.to_bits())).collect()
    }

    /// Refuses more bind groups than the device allows; `has_own` is whether the stage needs one.
    pub(super) fn check_bind_groups(
        &self,
        limits: &wgpu::Limits,
        has_own: bool,
    ) -> Result<(), StageError> {
        let most = limits.max_bind_groups.saturating_sub(u32::from(has_own));
        let got = self.own_group();
        if got > most { Err(StageError::TooManyBindGroups { got, most }) } else { Ok(()) }
    }

    /// Refuses WGSL whose functions `entries` read a binding that the builder did not get, and
    /// constants that the WGSL does not declare or that have no value.
    pub(super) fn check(
        &self,
        declared: &[Declaration<'a>],
        entries: &[&'a str],
    ) -> Result<(), Error> {
        check_groups(&wgsl::reached(declared, entries), self.own_group())?;
        check_constants(declared, self.constants)
    }
}

/// Refuses a binding in a group that the builder did not get.
fn check_groups(reached: &[Declaration<'_>], groups: u32) -> Result<(), Error> {
    // wgpu checks a group that is not written as a plain number.
    let is_there = |one: &Declaration<'_>| {
        let group = one
            .attribute("group")
            .and_then(|group| group.trim_end_matches(['i', 'u']).parse::<u32>().ok());
        group.is_none_or(|group| group < groups)
    };
    match reached.iter().find(|one| !is_there(one)) {
        None => Ok(()),
        Some(one) => Err(StageError::Wgsl {
            line: Some(one.line),
            message: format!(
                "`{}` is in a bind group that the builder did not get: it got {groups}, numbered from 0; call \
                 `bind_group` for each, in order",
                one.name
            ),
        }
        .into()),
    }
}

/// Refuses a value for an `override` that the WGSL does not declare, and an `override` without a
/// value.
fn check_constants(declared: &[Declaration<'_>], given: &[(&str, f64)]) -> Result<(), Error> {
    let overrides: Vec<_> = declared.iter().filter(|one| one.keyword == "override").collect();
    let is_given = |name: &str| given.iter().any(|one| one.0 == name);
    for &(name, _) in given {
        if !overrides.iter().any(|one| one.name == name) {
            let found = overrides.iter().map(|one| one.name.to_owned()).collect();
            return Err(StageError::NoSuchConstant { name: name.to_owned(), found }.into());
        }
    }
    match overrides.iter().find(|one| one.has_no_value() && !is_given(one.name)) {
        None => Ok(()),
        Some(Declaration { name, line, .. }) => Err(StageError::Wgsl {
            line: Some(*line),
            message: format!("`{name}` has no value; give one with `constants`"),
        }
        .into()),
    }
}
