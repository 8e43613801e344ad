//! Choices of the page, and factors as people write them.

use crate::{json, thrown};
use serde_json::json;
use tess_core::{Domain, OutputPrimitive, Partitioning, SplitOrder};
use tess_verify::{Named, factor};
use wasm_bindgen::JsError;
use wasm_bindgen::prelude::wasm_bindgen;

/// Domains with their factors, partitionings with their ranges, outputs and split orders: JSON.
#[wasm_bindgen]
pub fn choices() -> String {
    let domain = |&(name, domain): &(&str, Domain)| {
        let (factors, outer) = (domain.factor_names(), domain.outer_factors());
        json!({ "name": name, "factors": factors, "outer": outer })
    };
    let partitioning =
        |&(name, value): &(&str, Partitioning)| json!({ "name": name, "range": value.range() });
    json(&json!({
        "domains": Domain::NAMES.iter().map(domain).collect::<Vec<_>>(),
        "partitionings": Partitioning::NAMES.iter().map(partitioning).collect::<Vec<_>>(),
        "outputs": OutputPrimitive::NAMES.iter().map(|(name, _)| *name).collect::<Vec<_>>(),
        "splits": SplitOrder::NAMES.iter().map(|(name, _)| *name).collect::<Vec<_>>(),
    }))
}

/// The bits of a factor as `tess` reads it: a decimal number, nan, inf, or `0x` and its bits.
/// Errors: the text is neither.
#[wasm_bindgen]
pub fn factor_bits(text: &str) -> Result<u32, JsError> {
    factor(text).map(f32::to_bits).map_err(thrown)
}

/// The shortest text that [`factor_bits`] reads back to these bits.
#[wasm_bindgen]
pub fn factor_text(bits: u32) -> String {
    let decimal = f32::from_bits(bits).to_string();
    let same = factor(&decimal).is_ok_and(|value| value.to_bits() == bits);
    if same && decimal.len() <= 14 { decimal } else { format!("0x{bits:08x}") }
}

/// The factor `steps` units in the last place above or below; NaN stays as it is.
#[wasm_bindgen]
pub fn step_factor(bits: u32, steps: i32) -> u32 {
    let step = if steps < 0 { f32::next_down } else { f32::next_up };
    let steps = steps.unsigned_abs().min(65536);
    (0..steps).fold(f32::from_bits(bits), |factor, _| step(factor)).to_bits()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_of_factors_read_back() {
        for bits in [0, 0x8000_0000, 0x4040_0000, 0x3fd9_999a, 0x7f80_0000, 0x7fc0_0001, 1] {
            let text = factor_text(bits);
            assert_eq!(factor(&text).map(f32::to_bits), Ok(bits), "{text}");
        }
    }

    #[test]
    fn steps_are_units_in_the_last_place() {
        assert_eq!(step_factor(0x4040_0000, 1), 0x4040_0001, "up");
        assert_eq!(step_factor(0x4040_0000, -2), 0x403f_fffe, "down");
        assert_eq!(step_factor(0x7fc0_0001, 1), 0x7fc0_0001, "NaN");
    }
}
