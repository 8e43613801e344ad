//! Circles among the children of each module.

use super::modules::{Modules, Reference};
use std::collections::{BTreeMap, BTreeSet};

/// Modules with one parent, each of which names the others, itself or by way of them. A child stands for all of
/// its parts.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Circle {
    /// The parent's path with `::`; empty for the root.
    pub(super) parent: String,
    pub(super) members: BTreeSet<String>,
    /// From which member to which, and where.
    pub(super) edges: BTreeMap<(String, String), Vec<String>>,
}

/// The circles of a crate. A module and its own parts may name each other.
pub(super) fn circles(modules: &Modules) -> Vec<Circle> {
    let references = modules.references();
    let parents: BTreeSet<&[String]> =
        modules.paths().filter_map(|path| Some(path.split_last()?.1)).collect();
    parents.into_iter().flat_map(|parent| among(parent, &references)).collect()
}

/// The circles among the children of `parent`.
fn among(parent: &[String], references: &[Reference]) -> Vec<Circle> {
    let child = |path: &[String]| -> Option<String> {
        path.strip_prefix(parent).and_then(|rest| rest.first().cloned())
    };
    let mut edges = BTreeMap::<(String, String), Vec<String>>::new();
    for Reference { from, to, place } in references {
        if let (Some(from), Some(to)) = (child(from), child(to))
            && from != to
        {
            edges.entry((from, to)).or_default().push(place.clone());
        }
    }
    let reached = reached(&edges);
    let is_mutual = |a: &String, b: &String| {
        let goes = |a: &String, b: &String| reached.get(a).is_some_and(|set| set.contains(b));
        goes(a, b) && goes(b, a)
    };
    let mut found: Vec<Circle> = Vec::new();
    for name in reached.keys().filter(|name| is_mutual(name, name)) {
        if found.iter().any(|circle| circle.members.contains(name)) {
            continue;
        }
        let members: BTreeSet<_> =
            reached.keys().filter(|other| is_mutual(name, other)).cloned().collect();
        let within = |(from, to): &(String, String)| members.contains(from) && members.contains(to);
        let edges = edges.iter().filter(|(edge, _)| within(edge));
        let edges = edges.map(|(edge, places)| (edge.clone(), places.clone())).collect();
        found.push(Circle { parent: parent.join("::"), members, edges });
    }
    found
}

/// What each module names, itself or by way of others.
fn reached(edges: &BTreeMap<(String, String), Vec<String>>) -> BTreeMap<String, BTreeSet<String>> {
    let mut reached = BTreeMap::<String, BTreeSet<String>>::new();
    for (from, to) in edges.keys() {
        reached.entry(from.clone()).or_default().insert(to.clone());
    }
    loop {
        let before: usize = reached.values().map(BTreeSet::len).sum();
        for (from, to) in edges.keys() {
            let more = reached.get(to).cloned().unwrap_or_default();
            reached.entry(from.clone()).or_default().extend(more);
        }
        if reached.values().map(BTreeSet::len).sum::<usize>() == before {
            return reached;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The members of each circle of a crate with these files.
    fn members(files: &[(&str, &str)]) -> Vec<String> {
        let files = files.iter().map(|&(file, text)| (file.into(), text.to_owned()));
        let show = |circle: Circle| {
            let members: Vec<_> = circle.members.into_iter().collect();
            format!("{}: {}", circle.parent, members.join(" "))
        };
        circles(&Modules::of(files.collect()).expect("Rust")).into_iter().map(show).collect()
    }

    #[test]
    fn planted_circles_are_seen() {
        let two =
            [("lib.rs", ""), ("a.rs", "use crate::b::X;"), ("b.rs", "fn f() { super::a::y() }")];
        assert_eq!(members(&two), [": a b"], "two files");
        let by_parts = [
            ("lib.rs", ""),
            ("a.rs", "use inner::I;"),
            ("a/inner.rs", "use crate::c::Z;"),
            ("b.rs", "use crate::a::Y;"),
            ("c.rs", "use crate::b::X;"),
            ("d.rs", "use crate::{a, b, c};"),
        ];
        assert_eq!(members(&by_parts), [": a b c"], "three, one by its part; not what names them");
        let parts = [
            ("lib.rs", ""),
            ("a.rs", ""),
            ("a/b.rs", "use super::c::X;"),
            ("a/c.rs", "use crate::a::b::Y;"),
        ];
        assert_eq!(members(&parts), ["a: b c"], "two parts of a module");
    }

    #[test]
    fn a_module_and_its_parts_are_no_circle() {
        let files = [
            ("lib.rs", "use a::X;"),
            ("a.rs", "mod b; use b::Y; use crate::Z;"),
            ("a/b.rs", "use super::X; use crate::c::Y;"),
            ("c.rs", "#[cfg(test)] mod tests { use crate::a::X; }"),
        ];
        assert!(members(&files).is_empty(), "parts, and a test");
    }

    #[test]
    fn a_circle_has_its_places() {
        let files = [("a.rs", "\nuse crate::b::X;"), ("b.rs", "use crate::a;"), ("lib.rs", "")];
        let files = files.iter().map(|&(file, text)| (file.into(), text.to_owned()));
        let found = circles(&Modules::of(files.collect()).expect("Rust"));
        let edge = ("a".to_owned(), "b".to_owned());
        assert_eq!(found[0].edges[&edge], ["a.rs:2: crate::b::X"], "the place");
    }
}
