//! The rules: a row for each, with its name, its demand, its sources, what it is asked about, and
//! its judge. The table of docs/rules.md is printed from these rows.

use super::answer::Answer;
use super::memory::Memory;
use super::scope::Scope;
use super::standard::Specification;
use super::{Judged, Judgement, edge, inside, mesh, neighbours, specified};
use crate::names::{Named, named};

/// How a rule judges.
#[derive(Clone, Copy)]
pub(super) enum Judge {
    /// A patch by itself.
    One(fn(&Subject<'_>) -> Judged),
    /// A patch against earlier ones.
    Many(fn(&mut Memory, &Answer) -> Vec<Judgement>),
}

/// A patch to judge.
pub(super) struct Subject<'a> {
    pub(super) answer: &'a Answer,
    /// The answer that Direct3D specifies, if the patch has primitives.
    pub(super) specified: Option<&'a Answer>,
}

/// A rule: all that there is to say of it.
pub(super) struct Row {
    pub(super) rule: Rule,
    /// Its demand, as docs/rules.md states it.
    #[cfg_attr(not(test), expect(dead_code, reason = "printed by a test, into docs/rules.md"))]
    pub(super) demand: &'static str,
    /// The section of each standard that states it, in the order of [`Specification`].
    pub(super) sources: [Option<&'static str>; 3],
    /// The levels about which it must be asked before it counts as held.
    pub(super) scope: Scope,
    pub(super) judge: Judge,
}

impl Row {
    pub(super) const fn of(rule: Rule) -> &'static Self {
        &ROWS[rule as usize]
    }

    pub(super) const fn source(&self, specification: Specification) -> Option<&'static str> {
        self.sources[specification as usize]
    }
}

/// The section of OpenGL 4.6 about tessellation, without its list of invariance rules.
const OPENGL: Option<&str> = Some("11.2.2 Tessellation Primitive Generation");

/// Sections about tessellation in Vulkan 1.3.
const DISCARD: Option<&str> = Some("22.2 Tessellator Patch Discard");
const SPACING: Option<&str> = Some("22.3 Tessellator Spacing");
const WINDING: Option<&str> = Some("22.5 Tessellator Vertex Winding Order");
const MESH: Option<&str> = Some("22.6 Triangle Tessellation, 22.7 Quad Tessellation");
const ISOLINES: Option<&str> = Some("22.8 Isoline Tessellation");
const POINTS: Option<&str> = Some("22.9 Tessellation Point Mode");

/// A rule of the list of invariance rules, which has the same title and numbers in Vulkan and
/// OpenGL.
macro_rules! invariance {
    ($number:literal) => {
        Some(concat!("Tessellation Invariance, rule ", $number))
    };
}

/// Defines the rules and the rows of their table.
macro_rules! rules {
    ($($rule:ident = $name:literal {
        demand: $demand:literal,
        sources: $sources:expr,
        scope: $scope:expr,
        judge: $judge:expr,
    })*) => {
        named! {
            /// A demand of a standard on a tessellator's output.
            #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
            #[non_exhaustive]
            pub enum Rule: "rule" {
                $(#[doc = $demand] $rule = $name,)*
            }
        }

        /// Every rule, in the order of [`Rule`].
        pub(super) static ROWS: [Row; Rule::NAMES.len()] = [$(Row {
            rule: Rule::$rule,
            demand: $demand,
            sources: $sources,
            scope: $scope,
            judge: $judge,
        },)*];
    };
}

rules! {
    Same = "same" {
        demand: "Equal levels and state give the same sequence.",
        sources: [
            invariance!(1),
            invariance!(1),
            Some("13 What the public specification leaves open: order"),
        ],
        scope: Scope::numbers(),
        judge: Judge::Many(Memory::same),
    }
    EdgeLevel = "edge-level" {
        demand: "The vertices of an outer edge depend only on its own level and the spacing.",
        sources: [invariance!(2), invariance!(2), Some("12.5 Crack-free")],
        scope: Scope::numbers().outer().of_surfaces(),
        judge: Judge::Many(Memory::edge_level),
    }
    Symmetric = "symmetric" {
        demand: "They are mirrored about the middle, and both ends are among them.",
        sources: [invariance!(3), invariance!(3), Some("12.2 Symmetry")],
        scope: Scope::numbers().outer().without_details(),
        judge: Judge::One(|subject| edge::symmetric(subject.answer)),
    }
    EveryEdge = "every-edge" {
        demand: "Edges of equal levels have equal vertices. In Direct3D also where a triangle meets a quad.",
        sources: [invariance!(4), invariance!(4), Some("12.5 Crack-free")],
        scope: Scope::numbers().outer().of_surfaces(),
        judge: Judge::Many(Memory::every_edge),
    }
    Winding = "winding" {
        demand: "Both windings have the same set of triangles.",
        sources: [invariance!(5), invariance!(5), Some("12.7 Winding")],
        scope: Scope::numbers().of_surfaces(),
        judge: Judge::Many(Memory::winding),
    }
    Interior = "interior" {
        demand: "Triangles without a vertex on the outline depend only on the inner levels and the spacing.",
        sources: [invariance!(6), invariance!(6), None],
        scope: Scope::numbers().inner().of_surfaces(),
        judge: Judge::Many(Memory::interior),
    }
    Transition = "transition" {
        demand: "Triangles with an outer segment depend only on that edge's level, the inner levels and the spacing.",
        sources: [invariance!(7), invariance!(7), None],
        scope: Scope::numbers().of_surfaces(),
        judge: Judge::Many(Memory::transition),
    }
    Range = "range" {
        demand: "Vertices exist and are in the domain.",
        sources: [invariance!(8), invariance!(8), Some("12.1 Range")],
        scope: Scope::numbers().and_classes(),
        judge: Judge::One(|subject| subject.answer.range()),
    }
    Discard = "discard" {
        demand: "A patch has no primitive if an outer level is NaN or not above 0, and has some otherwise.",
        sources: [DISCARD, OPENGL, Some("3 Factor processing: cull")],
        scope: Scope::values(),
        judge: Judge::One(|subject| subject.answer.discard()),
    }
    Segments = "segments" {
        demand: "The clamped level, rounded up (to an odd or even number if fractional), is the number of segments, or of isolines.",
        sources: [SPACING, OPENGL, Some("4 The factor context: points")],
        scope: Scope::numbers().and_classes().outer(),
        judge: Judge::One(|subject| edge::segments(subject.answer, subject.specified)),
    }
    Spacing = "spacing" {
        demand: "Segments are equally long. Under fractional spacing, two may be shorter, a mirrored pair: none if the level is the number of segments, and nearly nothing if it is just above the next lower number.",
        sources: [SPACING, OPENGL, None],
        scope: Scope::numbers().and_classes().outer(),
        judge: Judge::One(|subject| edge::spacing(subject.answer)),
    }
    InnerLevels = "inner-levels" {
        demand: "The inner levels are the numbers of a quad's columns and rows, which cross in vertices, and of the segments that make a triangle's rings. Patches whose levels are all 1 have no vertex inside.",
        sources: [MESH, OPENGL, Some("6 Points, in order: interior")],
        scope: Scope::numbers().and_classes().inner().of_surfaces(),
        judge: Judge::One(|subject| inside::inner_levels(subject.answer, subject.specified)),
    }
    InnerSpacing = "inner-spacing" {
        demand: "Columns, rows and rings are spaced as edges of these levels; a ring's vertices are perpendicular to those of the outermost ring.",
        sources: [MESH, OPENGL, None],
        scope: Scope::numbers().inner().of_surfaces(),
        judge: Judge::One(|subject| inside::inner_spacing(subject.answer)),
    }
    EqualLevels = "equal-levels" {
        demand: "Two lines of one level, edges, isolines, columns, rows or rings, have their shorter segments at the same place.",
        sources: [SPACING, OPENGL, None],
        scope: Scope::numbers().fractional(1),
        judge: Judge::Many(Memory::equal_levels),
    }
    Monotone = "monotone" {
        demand: "The shorter segments do not shrink as the level grows, and grow from a level to one that is 1/8 higher.",
        sources: [SPACING, OPENGL, None],
        scope: Scope::numbers().fractional(3),
        judge: Judge::Many(Memory::monotone),
    }
    Cover = "cover" {
        demand: "Every edge within the domain is shared in both directions, and the outline is walked once.",
        sources: [MESH, OPENGL, Some("12.3 Area, 12.4 Manifold")],
        scope: Scope::numbers().and_classes().of_surfaces().and_pairs(),
        judge: Judge::One(|subject| mesh::cover(subject.answer)),
    }
    Neighbours = "neighbours" {
        demand: "A triangle joins two neighbours of one edge or ring with a vertex of the next one, or is half a cell of columns and rows, or the innermost ring.",
        sources: [MESH, OPENGL, None],
        scope: Scope::numbers().of_surfaces().and_pairs(),
        judge: Judge::One(|subject| neighbours::neighbours(subject.answer)),
    }
    Orientation = "orientation" {
        demand: "No triangle turns the other way.",
        sources: [WINDING, OPENGL, None],
        scope: Scope::numbers().and_classes().of_surfaces().and_pairs(),
        judge: Judge::One(|subject| mesh::orientation(subject.answer)),
    }
    Isolines = "isolines" {
        demand: "Lines are equally spaced and begin at v = 0, none is at v = 1, and each is walked once from 0 to 1.",
        sources: [ISOLINES, OPENGL, Some("6 Points, in order: isoline")],
        scope: Scope::numbers().and_classes().of_isolines(),
        judge: Judge::One(|subject| mesh::isolines(subject.answer)),
    }
    PointsOnce = "points-once" {
        demand: "No place is a point twice.",
        sources: [POINTS, OPENGL, None],
        scope: Scope::numbers(),
        judge: Judge::One(|subject| mesh::points_once(subject.answer)),
    }
    PointsSame = "points-same" {
        demand: "Points are the vertices of the same patch's triangles or lines.",
        sources: [POINTS, OPENGL, Some("8 Output primitives")],
        scope: Scope::numbers(),
        judge: Judge::Many(Memory::points_same),
    }
    Counts = "counts" {
        demand: "There are as many primitives as the levels ask for, degenerate ones included; coinciding points may be merged.",
        sources: [None, None, Some("12.6 Counts")],
        scope: Scope::numbers().and_classes().and_pairs(),
        judge: Judge::One(|subject| specified::counts(subject.answer, subject.specified)),
    }
    Places = "places" {
        demand: "Vertices are where sections 5 and 6 place them.",
        sources: [None, None, Some("6 Points, in order")],
        scope: Scope::numbers().and_classes(),
        judge: Judge::One(|subject| specified::places(subject.answer, subject.specified)),
    }
    Primitives = "primitives" {
        demand: "Primitives are those of section 7, each as often, in any order, any vertex of a triangle first.",
        sources: [None, None, Some("7 Connectivity")],
        scope: Scope::numbers().and_classes().and_pairs(),
        judge: Judge::One(|subject| specified::primitives(subject.answer, subject.specified)),
    }
}

impl Specification {
    /// Its rules, in the order of [`Rule`].
    pub(super) fn rules(self) -> impl Iterator<Item = &'static Row> {
        ROWS.iter().filter(move |row| row.source(self).is_some())
    }

    /// The section of the standard that states a rule, by number and title; `None` if the standard
    /// has no such rule.
    ///
    /// Direct3D's rules are sections of `docs/specification.md`, which refines chapter 11 of the
    /// D3D11.3 functional specification.
    #[must_use]
    pub const fn source(self, rule: Rule) -> Option<&'static str> {
        Row::of(rule).source(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The section numbers of a source: `22.6, 22.7` or `rule 3`.
    fn sections(source: Option<&str>) -> String {
        let Some(source) = source else { return "-".to_owned() };
        let parts = source.split(", ").filter_map(|part| {
            let number = part.split(' ').next()?;
            let is_number = number.starts_with(|first: char| first.is_ascii_digit());
            (is_number || number == "rule").then_some(if is_number { number } else { part })
        });
        parts.collect::<Vec<_>>().join(", ")
    }

    /// A row of the table in docs/rules.md.
    fn printed(row: &Row) -> String {
        let [vulkan, opengl, d3d11] = row.sources.map(sections);
        format!("| `{}` | {} | {vulkan} | {opengl} | {d3d11} |", row.rule.name(), row.demand)
    }

    #[test]
    fn the_documented_table_is_printed_from_the_rows() {
        let page = include_str!("../../../docs/rules.md");
        let (_, section) = page.split_once("\n## The rules\n").expect("the section");
        let rows = section.lines().skip_while(|line| !line.starts_with("| ---")).skip(1);
        let documented: Vec<_> = rows.take_while(|line| line.starts_with("| ")).collect();
        let lines: Vec<_> = ROWS.iter().map(printed).collect();
        assert_eq!(documented, lines, "the table should be:\n{}", lines.join("\n"));
    }

    /// [`Row::of`] looks a rule up by its number.
    #[test]
    fn rows_are_in_the_order_of_the_rules() {
        for (_, rule) in Rule::NAMES {
            assert_eq!(Row::of(*rule).rule, *rule);
        }
    }
}
