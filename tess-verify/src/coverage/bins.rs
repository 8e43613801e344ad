//! Every bin there is.

use crate::names::Named;
use tess_core::{Domain, OutputPrimitive, Parity, Partitioning, SplitOrder};

/// Domains with an inside.
const FILLED: [Domain; 2] = [Domain::Triangle, Domain::Quad];
const PARITIES: [Parity; 2] = [Parity::Even, Parity::Odd];

/// The paths of all bins.
pub(super) fn all() -> Vec<String> {
    let mut bins = Vec::new();
    configuration(&mut bins);
    cull(&mut bins);
    factors(&mut bins);
    contexts(&mut bins);
    stitches(&mut bins);
    centres(&mut bins);
    bins
}

fn configuration(bins: &mut Vec<String>) {
    for domain in Domain::ALL.map(Named::name) {
        for partitioning in Partitioning::ALL.map(Named::name) {
            for output in OutputPrimitive::ALL.map(Named::name) {
                for split in SplitOrder::ALL.map(Named::name) {
                    bins.push(format!("configuration/{domain}/{partitioning}/{output}/{split}"));
                }
            }
        }
    }
    for domain in FILLED.map(Named::name) {
        for partitioning in ["integer", "pow2", "fractional_odd"] {
            for output in OutputPrimitive::ALL.map(Named::name) {
                bins.push(format!("minimum/{domain}/{partitioning}/{output}"));
            }
        }
    }
}

fn cull(bins: &mut Vec<String>) {
    for domain in Domain::ALL {
        for factor in &domain.factor_names()[..domain.outer_factors()] {
            for why in ["zero", "negative", "nan"] {
                bins.push(format!("cull/{}/{factor}/{why}", domain.name()));
            }
            bins.push(format!("denormal/{}/{factor}", domain.name()));
        }
    }
}

fn factors(bins: &mut Vec<String>) {
    for role in ["outer", "inside"] {
        for partitioning in Partitioning::ALL.map(Named::name) {
            for clamp in ["below", "within", "above"] {
                bins.push(format!("clamp/{partitioning}/{role}/{clamp}"));
            }
        }
        for partitioning in ["integer", "pow2"] {
            bins.extend(["exact", "up"].map(|how| format!("round/{partitioning}/{role}/{how}")));
        }
        for how in ["exact", "down", "up", "tie_down", "tie_up"] {
            bins.push(format!("conversion/{role}/{how}"));
        }
    }
    for partitioning in Partitioning::ALL.map(Named::name) {
        bins.push(format!("clamp/{partitioning}/inside/nan"));
    }
    bins.extend(["raised", "all_one", "already_above"].map(|how| format!("picture_frame/{how}")));
}

fn contexts(bins: &mut Vec<String>) {
    for split in SplitOrder::ALL.map(Named::name) {
        for parity in PARITIES.map(Named::name) {
            for half_points in 1..=32 {
                bins.push(format!("context/{split}/{parity}/{half_points}/whole"));
                if half_points > 1 {
                    bins.push(format!("context/{split}/{parity}/{half_points}/split"));
                }
            }
            bins.push(format!("exceptional/{split}/{parity}/equal_neighbours"));
        }
        bins.push(format!("exceptional/{split}/even/backwards"));
    }
}

fn stitches(bins: &mut Vec<String>) {
    for domain in FILLED.map(Named::name) {
        for partitioning in ["integer", "pow2"] {
            for (outer, inside) in parity_pairs() {
                bins.push(format!("parities/{domain}/{partitioning}/{outer}x{inside}"));
            }
        }
        bins.push(format!("parities/{domain}/fractional_odd/oddxodd"));
        bins.push(format!("parities/{domain}/fractional_even/evenxeven"));
        bins.extend((1..=32).map(|rings| format!("rings/{domain}/{rings}")));
    }
    bins.extend(parity_pairs().map(|(outer, inside)| format!("middle/{outer}x{inside}")));
    for outer in 2..=65 {
        bins.extend((3..=65).map(|inside| format!("transition/{outer}x{inside}")));
    }
}

fn parity_pairs() -> impl Iterator<Item = (&'static str, &'static str)> {
    PARITIES.into_iter().flat_map(|a| PARITIES.map(|b| (a.name(), b.name())))
}

fn centres(bins: &mut Vec<String>) {
    bins.extend(["point", "triangle"].map(|what| format!("centre/tri/{what}")));
    bins.push("centre/quad/point".to_owned());
    for axis in ["u", "v"] {
        for other in PARITIES.map(Named::name) {
            bins.push(format!("centre/quad/row_along_{axis}/{other}"));
            bins.push(format!("centre/quad/strip_along_{axis}/{other}"));
        }
    }
    bins.push("centre/quad/strip_of_one".to_owned());
}
