//! The helpers of hull and domain functions, each compared with the function of tess-surface on a
//! table of arguments.
//!
//! Bits are compared where two patches meet and where WGSL leaves no freedom. Elsewhere WGSL lets a
//! device fuse a multiplication with an addition, and divide and take roots with errors of some
//! units in the last place; each table states the errors that it allows. The tables notice every
//! fault that `dev/faults/wgsl.faults` has of them.

#![expect(clippy::float_arithmetic, reason = "the helpers compute in floats")]

mod bevy;
mod beziers;
mod culling;
mod device;
mod factors;
#[path = "../common/objects.rs"]
mod objects;
mod points;

use device::Device;
use tess_testkit::listed::ListedFault;
use tess_testkit::wgsl_faults;

/// The arguments of a call.
pub(crate) type Args = [[f32; 4]; 5];

/// A helper and its table.
#[derive(Debug)]
pub(crate) struct Table {
    pub(crate) name: &'static str,
    /// A `vec4<f32>`, by the arguments `a[0]` to `a[4]`.
    pub(crate) call: &'static str,
    pub(crate) cases: Vec<Case>,
}

/// One call and its result.
#[derive(Debug)]
pub(crate) struct Case {
    pub(crate) args: Args,
    pub(crate) expected: Expected,
}

/// The result that a call has to return.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Expected {
    /// These numbers, to the bit.
    Bits([f32; 4]),
    /// These numbers, each within its error.
    Near([f32; 4], f32),
    /// The bits of the previous case, which is the other side of the edge.
    AsBefore,
}

/// An ulp of a number between 0.5 and 1.
pub(crate) const ULP: f32 = f32::EPSILON / 2.0;

/// A result of one number.
pub(crate) const fn one(x: f32) -> [f32; 4] {
    [x, 0.0, 0.0, 0.0]
}

/// The arguments, followed by zeros.
pub(crate) fn args(given: &[[f32; 4]]) -> Args {
    std::array::from_fn(|i| given.get(i).copied().unwrap_or_default())
}

/// A vector followed by a number.
pub(crate) fn vec(xyz: glam::Vec3, w: f32) -> [f32; 4] {
    xyz.extend(w).to_array()
}

impl Table {
    /// The first result that is not as expected.
    fn compare(&self, results: &[[f32; 4]]) -> Result<(), String> {
        assert_eq!(results.len(), self.cases.len(), "a result for each case of {}", self.name);
        for (number, (Case { args, expected }, result)) in
            self.cases.iter().zip(results).enumerate()
        {
            let is_equal = |other: &[f32; 4]| result.map(f32::to_bits) == other.map(f32::to_bits);
            let is_right = match expected {
                Expected::Bits(bits) => is_equal(bits),
                Expected::Near(numbers, error) => {
                    result.iter().zip(numbers).all(|(a, b)| (a - b).abs() <= *error)
                }
                Expected::AsBefore => is_equal(&results[number - 1]),
            };
            if !is_right {
                return Err(format!(
                    "{}, case {number}: {args:?} gives {result:?}, before {:?}, expected {expected:?}",
                    self.name,
                    number.checked_sub(1).map(|before| results[before]),
                ));
            }
        }
        Ok(())
    }
}

fn tables() -> Vec<Table> {
    [factors::tables(), culling::tables(), points::tables(), beziers::tables()]
        .into_iter()
        .flatten()
        .collect()
}

#[test]
fn helpers_are_the_functions_of_the_cpu() {
    let device = Device::open();
    for table in tables() {
        assert!(table.cases.len() > 10, "{} has a table", table.name);
        let results = device.run(str::to_owned, &table);
        if let Err(difference) = table.compare(&results) {
            panic!("{difference}");
        }
    }
}

#[test]
fn planted_faults_are_seen() {
    let (device, tables) = (Device::open(), tables());
    let is_unseen = |fault: &&ListedFault| {
        let name = fault.filters.join(" ");
        let table = tables.iter().find(|table| table.name == name);
        let table = table.unwrap_or_else(|| panic!("{}: there is no table {name}", fault.name));
        let plant = |source: &str| {
            assert_eq!(fault.places(source), 1, "{fault:?} has one place");
            fault.planted(source).unwrap_or_default()
        };
        table.compare(&device.run(plant, table)).is_ok()
    };
    let faults = wgsl_faults::of_helpers();
    let is_tried = |table: &&Table| faults.iter().any(|f| f.filters.join(" ") == table.name);
    let untried: Vec<_> = tables.iter().filter(|table| !is_tried(table)).map(|t| t.name).collect();
    assert!(untried.is_empty(), "no fault tries {untried:?}");
    let unseen: Vec<_> = faults.iter().filter(is_unseen).collect();
    assert!(unseen.is_empty(), "of {} faults these are not seen: {unseen:#?}", faults.len());
}
