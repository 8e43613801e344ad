//! The third-party parts of an archive: a bill of materials in `CycloneDX`, and the licences.
//! cargo-cyclonedx describes one package, beside its manifest; an archive has several, and its
//! licences would still be collected here.

use super::pack::Release;
use crate::command::{self, cargo, in_file};
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::fmt::Write;
use std::fs;
use std::path::Path;

/// The system for which programs are built here.
pub(super) const SYSTEM: &str = "x86_64-unknown-linux-gnu";

/// The packages in an archive, and their workspace.
pub(super) struct Of<'a> {
    pub(super) name: &'a str,
    pub(super) manifest: &'a str,
    pub(super) packages: &'a [String],
}

/// Writes `NAME.cdx.json` and `NAME-licences.txt` into the release.
pub(super) fn write(release: &Release, of: &Of<'_>) -> Result<(), String> {
    let packages = dependencies(of)?;
    let own = |package: &Value| package["source"].is_null();
    let bill = json!({
        "bomFormat": "CycloneDX",
        "specVersion": "1.5",
        "version": 1,
        "metadata": { "component": { "type": "library", "name": format!("tess-{}", of.name), "version": super::VERSION } },
        "components": packages.iter().map(component).collect::<Vec<_>>(),
    });
    let text = format!("{bill:#}\n");
    let mut licences = String::new();
    for package in packages.iter().filter(|package| !own(package)) {
        licences += &licence(package)?;
    }
    let put = |file: String, text: &str| {
        fs::write(release.out.join(&file), text).map_err(|error| format!("{file}: {error}"))
    };
    put(file(of.name), &text)?;
    put(licences_file(of.name), &licences)
}

pub(super) fn file(name: &str) -> String {
    format!("{name}.cdx.json")
}

pub(super) fn licences_file(name: &str) -> String {
    format!("{name}-licences.txt")
}

/// The packages and their run-time dependencies, as `cargo metadata` describes them, by name and
/// version.
fn dependencies(of: &Of<'_>) -> Result<Vec<Value>, String> {
    let with = |words: &str| cargo(&format!("{words} {SYSTEM} --manifest-path {}", of.manifest));
    // Metadata unites the features requested by all packages of a workspace; the tree has those of
    // a single package.
    let mut names = BTreeSet::new();
    for package in of.packages {
        let mut tree =
            with("tree --edges normal,no-proc-macro --prefix none --format {p} --target");
        let lines = command::output(tree.args(["--package", package]))?;
        let named = lines.lines().filter_map(|line| {
            let mut words = line.split(' ');
            Some((words.next()?.to_owned(), words.next()?.trim_start_matches('v').to_owned()))
        });
        names.extend(named);
    }
    let text = command::output(&mut with("metadata --format-version 1 --filter-platform"))?;
    let metadata: Value = serde_json::from_str(&text).map_err(|error| error.to_string())?;
    let all = metadata["packages"].as_array().ok_or("cargo metadata lists no packages")?;
    let find = |(name, version): &(String, String)| {
        let it = all.iter().find(|it| it["name"] == **name && it["version"] == **version);
        it.cloned().ok_or_else(|| format!("cargo metadata has no {name} {version}"))
    };
    names.iter().map(find).collect()
}

fn component(package: &Value) -> Value {
    let (name, version) = (text(package, "name"), text(package, "version"));
    let purl = format!("pkg:cargo/{name}@{version}");
    // Crates from before 2018 write alternatives with a slash.
    let expression = text(package, "license").replace('/', " OR ");
    json!({
        "type": "library", "bom-ref": purl, "purl": purl, "name": name, "version": version,
        "licenses": [{ "expression": expression }],
    })
}

/// A package's name and licence, and the licence texts in its archive.
fn licence(package: &Value) -> Result<String, String> {
    let folder = Path::new(text(package, "manifest_path")).parent().unwrap_or(Path::new(""));
    let entries = fs::read_dir(folder).map_err(|error| in_file(folder, &error))?;
    let is_licence = |name: &String| {
        let name = name.to_uppercase();
        ["LICENSE", "LICENCE", "COPYING", "NOTICE", "UNLICENSE"]
            .iter()
            .any(|it| name.starts_with(it))
    };
    let names = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    let names: BTreeSet<_> = names.filter(is_licence).collect();
    let mut all = format!("==== {} {}: ", text(package, "name"), text(package, "version"));
    // Writing to a String cannot fail.
    _ = writeln!(all, "{}", text(package, "license"));
    if names.is_empty() {
        _ = writeln!(all, "(its archive has no text of it)");
    }
    for path in names.iter().map(|name| folder.join(name)).filter(|path| path.is_file()) {
        let text = command::read(&path)?;
        _ = writeln!(all, "\n{}", text.trim_end());
    }
    Ok(all + "\n")
}

fn text<'a>(package: &'a Value, key: &str) -> &'a str {
    package[key].as_str().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bill_has_what_the_library_links() {
        let packages = ["tess-capi".to_owned()];
        let all = dependencies(&Of { name: "c", manifest: "Cargo.toml", packages: &packages });
        let all = all.expect("cargo says");
        let has = |name: &str| all.iter().any(|package| package["name"] == name);
        assert!(
            has("tess-capi") && has("tess-core") && has("fixed") && has("rayon-core"),
            "{all:?}"
        );
        assert!(
            !has("cbindgen") && !has("syn") && !has("wgpu"),
            "neither tests, nor macros, nor others"
        );
        let fixed = all.iter().find(|package| package["name"] == "fixed").expect("it was there");
        assert_eq!(component(fixed)["licenses"][0]["expression"], "MIT OR Apache-2.0");
        let licence = licence(fixed).expect("read");
        assert!(
            licence.contains("MIT License") || licence.contains("Permission is hereby"),
            "{licence}"
        );
    }
}
