//! Mistakes: one entry of a table of triangles is wrong. Such a table has the steps between two
//! rows of points, by their numbers of points.

use super::family::Family;
use crate::case::Case;
use tess_core::{OutputPrimitive, Side, Step, Stitch, StitchKind, Tessellation};

/// An entry of a table of steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Entry {
    /// Between an edge of as many points and an inside of as many.
    Transition { outer: u32, inside: u32 },
    /// Between two rings, the inner one of which has as many points on an edge.
    Ring { points: u32 },
    /// In the middle of a quad, between two rows of as many points.
    Strip { points: u32 },
}

impl Entry {
    fn of(stitch: &Stitch) -> Option<Self> {
        match stitch.kind {
            StitchKind::Transition { .. } => Some(Self::Transition {
                outer: stitch.outer_points,
                inside: stitch.inner_points + 2,
            }),
            StitchKind::Ring { .. } => Some(Self::Ring { points: stitch.inner_points }),
            StitchKind::Centre(_) => Some(Self::Strip { points: stitch.outer_points }),
            StitchKind::CentreTriangle => None,
        }
    }

    fn label(self) -> String {
        match self {
            Self::Transition { outer, inside } => format!("{outer} points and {inside} inside"),
            Self::Ring { points } => format!("a ring of {points} points"),
            Self::Strip { points } => format!("rows of {points} points"),
        }
    }

    /// Whether the answer to a case shows it.
    fn is_in(self, case: &Case) -> bool {
        let mut is_there = false;
        if case.primitive_size() == 3 {
            case.patch().stitches(|stitch| is_there |= Self::of(&stitch) == Some(self));
        }
        is_there
    }
}

/// Entries of every number of points on an edge, with every third number inside.
fn transitions() -> impl Iterator<Item = Entry> {
    (2..=65).step_by(3).map(|outer| Entry::Transition { outer, inside: 4 + outer * 23 % 62 })
}

/// Entries of rings and of the middle. The larger ones are in large patches only.
fn within() -> impl Iterator<Item = Entry> {
    let rings = (2..20).step_by(3).map(|points| Entry::Ring { points });
    let strips = (2..60).step_by(9).map(|points| Entry::Strip { points });
    rings.chain(strips)
}

pub(super) fn all() -> Vec<Family> {
    let free = "the triangles are implementation-dependent (22.6, 22.7)";
    let exchanged = Family::new("an entry of the table of transitions joins other vertices");
    let incomplete = Family::new("an entry of the table of transitions lacks a triangle");
    let inner_exchanged = Family::new("an entry of the tables of rings joins other vertices");
    let inner_incomplete = Family::new("an entry of the tables of rings lacks a triangle");
    vec![
        wrong(exchanged, transitions(), |steps| exchange(steps)).vulkan_allows("", free),
        wrong(incomplete, transitions(), lose),
        wrong(inner_exchanged, within(), |steps| exchange(steps)).vulkan_allows("", free),
        wrong(inner_incomplete, within(), lose),
    ]
}

/// Adds a device for each entry, whose steps are changed.
fn wrong(
    family: Family,
    entries: impl Iterator<Item = Entry>,
    change: impl Fn(&mut Vec<Step>) + Copy + Send + Sync + 'static,
) -> Family {
    entries.fold(family, |family, entry| {
        family.answers_some(
            entry.label(),
            move |case| entry.is_in(case),
            move |case, output| {
                stitch_again(case, output, |stitch, steps| {
                    if Entry::of(stitch) == Some(entry) {
                        change(steps);
                    }
                });
            },
        )
    })
}

/// Replaces the triangles by those of changed steps.
fn stitch_again(case: &Case, output: &mut Tessellation, change: impl Fn(&Stitch, &mut Vec<Step>)) {
    let is_clockwise = case.config.output == OutputPrimitive::TriangleCw;
    output.indices.clear();
    case.patch().stitches(|stitch| {
        let mut steps = Vec::new();
        stitch.steps(case.config.split, |step| steps.push(step));
        change(&stitch, &mut steps);
        for step in steps {
            let [a, b, c] = step.triangle(&stitch.outer, &stitch.inner);
            output.indices.extend(if is_clockwise { [a, b, c] } else { [a, c, b] });
        }
    });
}

/// Exchanges two steps that advance on different rows, the first ones from the middle on: two
/// triangles then have the other diagonal in common.
fn exchange(steps: &mut [Step]) {
    let differ = |k: &usize| steps[*k].advances != steps[*k + 1].advances;
    let (last, middle) = (steps.len().saturating_sub(1), steps.len() / 2);
    let Some(k) = (middle..last).chain(0..middle.min(last)).find(differ) else { return };
    steps.swap(k, k + 1);
    let (mut outer, mut inner) = (0, 0);
    for step in steps {
        (step.outer, step.inner) = (outer, inner);
        match step.advances {
            Side::Outer => outer += 1,
            Side::Inner => inner += 1,
        }
    }
}

fn lose(steps: &mut Vec<Step>) {
    steps.remove(steps.len() / 2);
}

#[cfg(test)]
mod tests {
    use super::*;
    use tess_core::SplitOrder;

    /// The right steps give the model's triangles, so only a change makes others.
    #[test]
    fn right_steps_give_the_answer() {
        let levels = "40a00000 40e00000 41100000 3f800000";
        for line in [
            format!("case tri integer triangle_cw ruler {levels}"),
            format!("case tri fractional_odd triangle_ccw center {levels}"),
            format!("case quad integer triangle_ccw ruler {levels} 41500000 40a00000"),
        ] {
            let case: Case = line.parse().expect("a case");
            let right = case.patch().tessellate();
            let mut own = right.clone();
            stitch_again(&case, &mut own, |_, _| ());
            assert_eq!(own, right, "{line}");
        }
    }

    /// An exchange keeps both rows walked from end to end, and changes the walk, if it has two
    /// ways.
    #[test]
    fn exchanged_steps_are_another_walk() {
        for entry in transitions() {
            let Entry::Transition { outer, inside } = entry else { panic!("{entry:?}") };
            let mut steps = Vec::new();
            tess_core::stitch::transition(SplitOrder::Ruler, outer, inside, |s| steps.push(s));
            let right = steps.clone();
            exchange(&mut steps);
            assert_ne!(steps, right, "{entry:?}");
            let of = |side| steps.iter().filter(|step| step.advances == side).count();
            let wanted = [outer - 1, inside - 3].map(|n| n as usize);
            assert_eq!([of(Side::Outer), of(Side::Inner)], wanted, "{entry:?}");
            let is_walk = steps.windows(2).all(|pair| {
                let next = match pair[0].advances {
                    Side::Outer => [pair[0].outer + 1, pair[0].inner],
                    Side::Inner => [pair[0].outer, pair[0].inner + 1],
                };
                [pair[1].outer, pair[1].inner] == next
            });
            assert!(is_walk, "{entry:?}");
        }
    }
}
