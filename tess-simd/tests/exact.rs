//! Whole batches, bit for bit the core's: every configuration, level, format and numbering.
#![expect(missing_docs, reason = "a test")]
#![expect(clippy::missing_panics_doc, clippy::cast_possible_truncation, reason = "a test")]

mod common;

use common::{Patches, compare, configs, levels};
use tess_core::{Config, Domain, DomainPoint};
use tess_simd::{Level, Numbering, Tessellator};

const SAME: fn(DomainPoint) -> DomainPoint = |point| point;

/// One batch in every format and numbering.
fn compare_all(tessellator: &mut Tessellator, domain: Domain, patches: &Patches) {
    let expected = patches.expected(tessellator.config());
    let structures = (patches, patches.structures(domain));
    let columns = (patches, patches.columns(domain));
    let to_f32 = DomainPoint::to_f32;
    for numbering in [Numbering::PerPatch, Numbering::Batch { base_vertex: 77 }] {
        compare::<DomainPoint, u32>(tessellator, structures, &expected, numbering, SAME);
        compare::<[f32; 2], u16>(tessellator, columns, &expected, numbering, to_f32);
    }
    compare::<DomainPoint, u16>(tessellator, columns, &expected, Numbering::PerPatch, SAME);
    compare::<[f32; 2], u32>(tessellator, structures, &expected, Numbering::PerPatch, to_f32);
}

fn tessellator(config: Config, level: Level) -> Tessellator {
    Tessellator::with_level(config, level).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn every_configuration_at_every_level() {
    for level in levels() {
        for (seed, config) in (0..).zip(configs()) {
            let mut tessellator = tessellator(config, level);
            for domain in Domain::ALL {
                compare_all(&mut tessellator, domain, &Patches::random(seed, domain, 203));
            }
        }
    }
}

#[test]
fn every_batch_size() {
    for level in levels() {
        for (seed, config) in (100..).zip(configs()) {
            let mut tessellator = tessellator(config, level);
            for count in 0..=40 {
                let domain = Domain::ALL[count % 3];
                compare_all(&mut tessellator, domain, &Patches::random(seed, domain, count));
            }
        }
    }
}
