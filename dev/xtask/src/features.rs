//! Every published package compiles with none of its features, with each, and with all.

use crate::command::{self, cargo};
use crate::packages::{self, Package};
use std::collections::{BTreeMap, BTreeSet};

/// Checks the published packages, or those with these names. A user's first command may be
/// `--no-default-features`, which nothing else of the suite compiles.
///
/// # Errors
/// A combination that does not compile, or a name that no published package has.
pub(crate) fn check(names: &[&str]) -> Result<(), String> {
    let packages = packages::published()?;
    let is_known = |name: &str| packages.iter().any(|package| package.name == name);
    if let Some(name) = names.iter().find(|name| !is_known(name)) {
        return Err(format!("no published package is `{name}`"));
    }
    let is_chosen = |package: &&Package| names.is_empty() || names.contains(&package.name.as_str());
    for package in packages.iter().filter(is_chosen) {
        for features in combinations(&package.features) {
            let mut check = cargo("check --no-default-features --package");
            check.arg(&package.name).arg(format!("--features={features}"));
            command::run(&mut check)?;
        }
    }
    Ok(())
}

/// A package's features, each with what it turns on: other features of its own, those of dependencies, dependencies.
type Features = BTreeMap<String, Vec<String>>;

/// None, each, and all, each list with commas. Of several that turn the same features on, the first.
fn combinations(features: &Features) -> Vec<String> {
    let each = features.keys().map(|name| vec![name.clone()]);
    let all: Vec<String> = features.keys().cloned().collect();
    let mut known = BTreeSet::new();
    let wanted = std::iter::once(vec![]).chain(each).chain([all]);
    let new = wanted.filter(|names| known.insert(turned_on(names, features)));
    new.map(|names| names.join(",")).collect()
}

/// The features of the package that these turn on; a name that is only a list of others does not count.
fn turned_on(names: &[String], features: &Features) -> BTreeSet<String> {
    let (mut found, mut waiting) = (BTreeSet::new(), names.to_vec());
    while let Some(name) = waiting.pop() {
        if found.insert(name.clone()) {
            waiting.extend(features.get(&name).into_iter().flatten().cloned());
        }
    }
    found.retain(|name| name != "default");
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_combinations_are_checked_once() {
        let features = [
            ("default", vec!["gpu", "shaders"]),
            ("gles", vec!["gpu", "wgpu/gles"]),
            ("gpu", vec!["dep:wgpu"]),
            ("shaders", vec!["dep:naga"]),
        ];
        let features = features
            .map(|(name, on)| (name.to_owned(), on.into_iter().map(str::to_owned).collect()))
            .into();
        let expected = ["", "default", "gles", "gpu", "shaders", "default,gles,gpu,shaders"];
        assert_eq!(combinations(&features), expected, "none, each, all");
        let one = Features::from([
            ("alloc".to_owned(), vec![]),
            ("default".to_owned(), vec!["alloc".to_owned()]),
        ]);
        assert_eq!(combinations(&one), ["", "alloc"], "default and all are the same as alloc");
        assert_eq!(combinations(&Features::new()), [""], "no features");
    }
}
