//! Coverage as one HTML file that needs no other.

use super::report::{by_stage, percent, sum};
use super::{BinGroup, Coverage, Exclusions};
use crate::quote::escape;
use std::fmt::Write;

const STYLE: &str = "\
body { font: 15px/1.5 system-ui, sans-serif; max-width: 60rem; margin: 2rem auto; padding: 0 1rem; color: #1b1f24 }
table { border-collapse: collapse; width: 100% }
th, td { text-align: left; padding: .25rem .75rem; border-bottom: 1px solid #d8dee4 }
td.number, th.number { text-align: right; font-variant-numeric: tabular-nums }
tbody.stage { border-top: 2px solid #8c959f }
tr.sum { font-weight: 600; background: #f6f8fa }
.bar { background: #ffd8b5; width: 10rem; height: .7rem }
.bar i { display: block; background: #2c7a3f; height: 100% }
.nothing { background: #eaeef2 }
.wrong { border-left: 4px solid #cf222e; padding-left: 1rem }
ul { columns: 26rem; font: 13px/1.5 ui-monospace, monospace; list-style: none; padding: 0 }
";

impl Coverage {
    /// The report as one HTML file, which says that the hits are those of `sources`.
    #[must_use]
    pub fn to_html(&self, exclusions: &Exclusions, sources: &[String]) -> String {
        let all = sum(&self.groups_without(exclusions));
        let mut page = format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>Coverage of the \
             tessellator</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<h1>Coverage of the tessellator</h1>\n"
        );
        let (hit, left, percent) = (all.hit, all.bins - all.excluded, percent(&all));
        let excluded = all.excluded;
        // Writing to a String does not fail.
        _ = writeln!(
            page,
            "<p>{hit} of {left} bins were hit: {percent} %. {excluded} more are excluded.</p>"
        );
        let names: Vec<String> = sources.iter().map(|name| escape(name)).collect();
        if !names.is_empty() {
            _ = writeln!(page, "<p>Hits of {}.</p>", names.join(", "));
        }
        wrong(&mut page, self, exclusions);
        table(&mut page, self, exclusions, &all);
        holes(&mut page, self, exclusions);
        page + "</body>\n</html>\n"
    }
}

fn wrong(page: &mut String, coverage: &Coverage, exclusions: &Exclusions) {
    let bins: Vec<&str> = coverage.hit_though_excluded(exclusions).collect();
    if !bins.is_empty() {
        let words = "These bins are excluded, but were hit: the exclusions are wrong.";
        _ = writeln!(page, "<div class=\"wrong\">\n<p>{words}</p>");
        list(page, &bins);
        page.push_str("</div>\n");
    }
}

fn table(page: &mut String, coverage: &Coverage, exclusions: &Exclusions, all: &BinGroup) {
    page.push_str(
        "<table>\n<thead>\n<tr><th>stage (section of the specification)</th><th>group</th>",
    );
    for name in ["bins", "hit", "excluded", "percent"] {
        _ = write!(page, "<th class=\"number\">{name}</th>");
    }
    page.push_str("<th></th></tr>\n</thead>\n");
    for (groups, sum, section) in by_stage(coverage, exclusions) {
        page.push_str("<tbody class=\"stage\">\n");
        let stage = format!("{} ({section})", sum.stage);
        for (number, group) in groups.iter().enumerate() {
            row(page, if number == 0 { &stage } else { "" }, group, "");
        }
        if groups.len() > 1 {
            row(page, "", &sum, " class=\"sum\"");
        }
        page.push_str("</tbody>\n");
    }
    page.push_str("<tbody class=\"stage\">\n");
    row(page, "all", &BinGroup { name: String::new(), ..all.clone() }, " class=\"sum\"");
    page.push_str("</tbody>\n</table>\n");
}

fn row(page: &mut String, stage: &str, group: &BinGroup, class: &str) {
    _ = write!(page, "<tr{class}><td>{stage}</td><td>{}</td>", group.name);
    let percent = percent(group);
    for number in [group.bins, group.hit, group.excluded] {
        _ = write!(page, "<td class=\"number\">{number}</td>");
    }
    let bar = match &*percent {
        "-" => "<div class=\"bar nothing\"></div>".to_owned(),
        percent => format!("<div class=\"bar\"><i style=\"width: {percent}%\"></i></div>"),
    };
    _ = writeln!(page, "<td class=\"number\">{percent}</td><td>{bar}</td></tr>");
}

/// The holes, group by group; a long list is folded.
fn holes(page: &mut String, coverage: &Coverage, exclusions: &Exclusions) {
    page.push_str("<h2>Holes</h2>\n");
    let holes: Vec<&str> = coverage.holes(exclusions).collect();
    if holes.is_empty() {
        page.push_str("<p>None.</p>\n");
    }
    for group in by_stage(coverage, exclusions).iter().flat_map(|(groups, _, _)| groups) {
        let is_own = |bin: &&&str| bin.split('/').next() == Some(&group.name);
        let own: Vec<&str> = holes.iter().filter(is_own).copied().collect();
        if own.is_empty() {
            continue;
        }
        let open = if own.len() <= 60 { " open" } else { "" };
        let left = group.bins - group.excluded;
        _ = writeln!(
            page,
            "<details{open}>\n<summary>{}: {} of {left} missed</summary>",
            group.name,
            own.len()
        );
        list(page, &own);
        page.push_str("</details>\n");
    }
}

fn list(page: &mut String, bins: &[&str]) {
    page.push_str("<ul>\n");
    bins.iter().for_each(|bin| _ = writeln!(page, "<li>{bin}</li>"));
    page.push_str("</ul>\n");
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two hits, one of them in an excluded group.
    fn example() -> (Coverage, Exclusions) {
        let (mut coverage, mut exclusions) = (Coverage::default(), Exclusions::default());
        exclusions.add("centre").expect("a group");
        assert!(coverage.add("centre/tri/point", 1) && coverage.add("middle/oddxodd", 1), "bins");
        (coverage, exclusions)
    }

    #[test]
    fn the_page_says_what_the_text_says() {
        let (coverage, exclusions) = example();
        let page = coverage.to_html(&exclusions, &["a<b>.xml".to_owned()]);
        let left = coverage.bins().count() - 12;
        assert!(page.contains(&format!("1 of {left} bins were hit: 0.0 %. 12 more")), "{page}");
        assert!(page.contains("Hits of a&lt;b&gt;.xml."), "names are escaped");
        assert!(page.contains("the exclusions are wrong"), "a hit bin is excluded");
        let items: Vec<&str> = page
            .lines()
            .filter_map(|line| line.strip_prefix("<li>")?.strip_suffix("</li>"))
            .collect();
        assert_eq!(items.len(), 1 + left - 1, "each hole once, and the wrong exclusion");
        assert!(!page.contains("href") && !page.contains("src="), "it needs no other file");
    }

    /// The rows of a stage with several groups, of which only the first names the stage and only the last is a sum.
    #[test]
    fn rows_of_the_table() {
        let (coverage, mut exclusions) = example();
        exclusions.add("middle/evenxodd").expect("a bin");
        let page = coverage.to_html(&exclusions, &[]);
        let numbers = |numbers: [&str; 4]| -> String {
            numbers.iter().map(|number| format!("<td class=\"number\">{number}</td>")).collect()
        };
        let middle = "<tr><td></td><td>middle</td>".to_owned()
            + &numbers(["4", "1", "1", "33.3"])
            + "<td><div class=\"bar\"><i style=\"width: 33.3%\"></i></div></td></tr>\n";
        let centre = "<tr><td></td><td>centre</td>".to_owned()
            + &numbers(["12", "0", "12", "-"])
            + "<td><div class=\"bar nothing\"></div></td></tr>\n";
        assert!(page.contains(&middle) && page.contains(&centre), "{page}");
        assert!(page.contains("<tr><td>stitch (7)</td><td>parities</td>"), "{page}");
        assert_eq!(page.matches("<tr class=\"sum\">").count(), 3, "factors, stitch and all");
        assert!(page.contains("<tr class=\"sum\"><td>all</td><td></td>"), "{page}");
        assert!(page.contains("<summary>middle: 2 of 3 missed</summary>"), "{page}");
        assert!(!page.contains("<summary>centre"), "no holes are excluded: {page}");
    }

    /// A group of 96 bins, of which some are hit: up to 60 holes are listed without a click.
    #[test]
    fn long_lists_are_folded() {
        for (hit, head) in [(36, "<details open>"), (35, "<details>")] {
            let mut coverage = Coverage::default();
            let bins: Vec<String> = coverage.bins().map(|(bin, _)| bin.to_owned()).collect();
            let own = bins.iter().filter(|bin| bin.starts_with("configuration/"));
            own.take(hit).for_each(|bin| assert!(coverage.add(bin, 1), "{bin}"));
            let page = coverage.to_html(&Exclusions::default(), &[]);
            let missed = 96 - hit;
            let summary =
                format!("{head}\n<summary>configuration: {missed} of 96 missed</summary>");
            assert!(page.contains(&summary), "{summary}: {page}");
        }
    }
}
