//! Replaces the execution modes of an evaluation shader in its SPIR-V, so that one module serves
//! every domain, spacing and output.

use tess_core::{Config, Domain, OutputPrimitive, Partitioning};

const HEADER_WORDS: usize = 5;
const OP_EXECUTION_MODE: u32 = 16;

const SPACING_EQUAL: u32 = 1;
const SPACING_FRACTIONAL_EVEN: u32 = 2;
const SPACING_FRACTIONAL_ODD: u32 = 3;
const VERTEX_ORDER_CW: u32 = 4;
const VERTEX_ORDER_CCW: u32 = 5;
const POINT_MODE: u32 = 10;
const TRIANGLES: u32 = 22;
const QUADS: u32 = 24;
const ISOLINES: u32 = 25;

/// A module whose entry point has the modes of a domain and a configuration.
///
/// Vulkan has no `pow2`: it becomes equal spacing, and the factors are rounded beforehand.
pub(crate) fn with_modes(module: &[u32], domain: Domain, config: Config) -> Vec<u32> {
    let modes = modes(domain, config);
    let mut words = module[..HEADER_WORDS.min(module.len())].to_vec();
    let mut rest = module.get(HEADER_WORDS..).unwrap_or_default();
    let mut entry = None;
    while let [first, ..] = *rest {
        let length = (first >> 16).max(1) as usize;
        let (instruction, after) = rest.split_at(length.min(rest.len()));
        rest = after;
        match *instruction {
            [_, target, mode] if first & 0xFFFF == OP_EXECUTION_MODE && is_replaced(mode) => {
                if entry.replace(target).is_none() {
                    let op = 3 << 16 | OP_EXECUTION_MODE;
                    words.extend(modes.iter().flat_map(|&mode| [op, target, mode]));
                }
            }
            _ => words.extend(instruction),
        }
    }
    words
}

fn is_replaced(mode: u32) -> bool {
    matches!(mode, SPACING_EQUAL..=VERTEX_ORDER_CCW | POINT_MODE | TRIANGLES | QUADS | ISOLINES)
}

fn modes(domain: Domain, config: Config) -> Vec<u32> {
    let domain_mode = match domain {
        Domain::Isoline => ISOLINES,
        Domain::Triangle => TRIANGLES,
        Domain::Quad => QUADS,
    };
    let spacing = match config.partitioning {
        Partitioning::Integer | Partitioning::Pow2 => SPACING_EQUAL,
        Partitioning::FractionalOdd => SPACING_FRACTIONAL_ODD,
        Partitioning::FractionalEven => SPACING_FRACTIONAL_EVEN,
    };
    let order = match config.output {
        OutputPrimitive::TriangleCcw => VERTEX_ORDER_CCW,
        _ => VERTEX_ORDER_CW,
    };
    let point_mode = (config.output == OutputPrimitive::Point).then_some(POINT_MODE);
    [domain_mode, spacing, order].into_iter().chain(point_mode).collect()
}
