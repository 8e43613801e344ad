//! Patches worth a look.

use crate::json;
use serde_json::{Value, json};
use tess_core::place::place;
use tess_core::{
    Config, Domain, FactorContext, FixedFactor, OutputPrimitive, Parity, Partitioning,
    PatchFactors, SplitOrder,
};
use tess_verify::Case;
use wasm_bindgen::prelude::wasm_bindgen;

/// Groups of named case lines: JSON.
#[wasm_bindgen]
pub fn curiosities() -> String {
    json(&json!([
        { "name": "Transitions", "cases": transitions() },
        { "name": "Picture frame and centres", "cases": centres() },
        { "name": "Culled and special", "cases": special() },
        { "name": "Locations that go backwards (fractional_even)", "cases": backwards() },
    ]))
}

/// A patch of the domain that has as many factors.
fn named(name: &str, partitioning: Partitioning, factors: &[f32]) -> Value {
    let domain = if factors.len() == 4 { Domain::Triangle } else { Domain::Quad };
    let factors = PatchFactors::from_slice(domain, factors).expect("factors of this domain");
    let config = Config::new(partitioning, OutputPrimitive::TriangleCw);
    json!({ "name": name, "line": Case { config, factors }.to_string() })
}

fn transitions() -> Vec<Value> {
    use Partitioning::{FractionalEven, FractionalOdd, Integer};
    vec![
        named("fine inside, coarse edges", Integer, &[1.0, 1.0, 1.0, 1.0, 9.0, 9.0]),
        named("coarse inside, fine edges", Integer, &[16.0, 16.0, 16.0, 16.0, 2.0, 2.0]),
        named("a different factor on every side", Integer, &[2.0, 5.0, 11.0, 23.0, 7.0, 10.0]),
        named("edges 17, 5, 9 around 3", FractionalOdd, &[17.0, 5.0, 9.0, 3.0]),
        named("one edge of 64", FractionalEven, &[64.0, 2.0, 2.0, 8.5]),
    ]
}

fn centres() -> Vec<Value> {
    use Partitioning::{FractionalEven, FractionalOdd, Integer};
    vec![
        named("picture frame: inside 1, edges 3", FractionalOdd, &[3.0, 3.0, 3.0, 3.0, 1.0, 1.0]),
        named("one edge just above 1", FractionalOdd, &[1.001, 1.0, 1.0, 1.0, 1.0, 1.0]),
        named("centre is a row of points", FractionalEven, &[8.0, 8.0, 8.0, 8.0, 4.0, 9.0]),
        named("centre is one point", FractionalEven, &[4.0, 4.0, 4.0, 4.0, 4.0, 4.0]),
        named("centre is a strip of quads", FractionalOdd, &[7.0, 7.0, 7.0, 7.0, 3.0, 7.0]),
        named("an inside factor of 1", Integer, &[4.0, 4.0, 4.0, 4.0, 1.0, 6.0]),
        named("centre is a triangle", FractionalOdd, &[5.0, 5.0, 5.0, 5.0]),
        named("centre is a point", FractionalEven, &[6.0, 6.0, 6.0, 6.0]),
    ]
}

fn special() -> Vec<Value> {
    use Partitioning::{Integer, Pow2};
    vec![
        named("an edge of 0 culls the patch", Integer, &[0.0, 4.0, 4.0, 4.0, 4.0, 4.0]),
        named("NaN inside counts as the least", Integer, &[4.0, 4.0, 4.0, 4.0, f32::NAN, 4.0]),
        named("infinity counts as 64", Integer, &[f32::INFINITY, 4.0, 4.0, 4.0, 4.0, 4.0]),
        named("pow2 from 5", Pow2, &[5.0, 5.0, 5.0, 5.0, 5.0, 5.0]),
        named("the minimum patch", Integer, &[1.0, 1.0, 1.0, 1.0]),
    ]
}

/// Quads of every factor whose locations go backwards (spec section 12), split order `ruler`.
fn backwards() -> Vec<Value> {
    let quad_of = |bits: u32| {
        let name = format!("0x{bits:06x} = {}", value(bits));
        named(&name, Partitioning::FractionalEven, &[value(bits); 6])
    };
    backward_factors().into_iter().map(quad_of).collect()
}

/// A 15.16 number as binary32, exactly: at most 22 bits.
#[expect(clippy::float_arithmetic, clippy::cast_precision_loss, reason = "exact")]
const fn value(bits: u32) -> f32 {
    bits as f32 / 65536.0
}

/// The 15.16 factors. All of them exceed an even integer by less than 0.02 (spec section 12).
fn backward_factors() -> Vec<u32> {
    const LESS_THAN: u32 = 1311;
    let near = |even: u32| (even << 16)..(even << 16) + LESS_THAN;
    let goes_back = |&bits: &u32| {
        let factor = FixedFactor::from_bits(bits);
        let context = FactorContext::new(factor, Parity::Even, SplitOrder::Ruler);
        (1..context.points).any(|p| place(&context, p) < place(&context, p - 1))
    };
    (2..64).step_by(2).flat_map(near).filter(goes_back).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The specification counted them over all factors.
    #[test]
    fn there_are_420_factors_whose_locations_go_backwards() {
        let factors = backward_factors();
        assert_eq!(factors.len(), 420, "section 12");
        assert_eq!((factors[0], factors[419]), (0x0006_0001, 0x001E_019E), "section 12");
    }

    #[test]
    fn every_curiosity_is_a_case() {
        let groups: Vec<Value> = serde_json::from_str(&curiosities()).expect("JSON");
        let cases = groups.iter().flat_map(|group| group["cases"].as_array().expect("a list"));
        for case in cases {
            let line = case["line"].as_str().expect("text");
            assert!(line.parse::<Case>().is_ok(), "{line}");
        }
    }
}
