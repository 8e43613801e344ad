//! The options that grant freedoms to a device's listings.

use crate::args::{Choices, choice};
use crate::backends::BackendName;
use crate::comparison::{CONVERSIONS, DENORMALS};
use crate::failure::Failure;
use tess_verify::Named;
use tess_verify::check::{Conversion, Denormals, Elements, ListOrder, Strength, Tested};
use tess_verify::vectors::Kind;

/// The strength of a comparison with a device under test (spec section 13).
#[derive(Clone, Debug, clap::Args)]
#[command(next_help_heading = "Strength, for the listings of a device")]
pub(crate) struct StrengthArgs {
    /// Order of points and primitives
    #[arg(long, value_name = "NAME", default_value = "exact", value_parser = choice(LIST_ORDERS))]
    order: ListOrder,
    /// Compare only the domain points, not the primitives made of them
    #[arg(long)]
    points: bool,
    /// Conversion of factors to fixed point
    #[arg(long, value_name = "NAME", default_value = "exact", value_parser = choice(CONVERSIONS))]
    conversion: Conversion,
    /// Positive denormal outer factors
    #[arg(long, value_name = "NAME", default_value = "keep", value_parser = choice(DENORMALS))]
    denormals: Denormals,
}

const LIST_ORDERS: Choices<ListOrder> = &[
    ("exact", ListOrder::Exact, "The model's, index for index"),
    ("sequence", ListOrder::Sequence, "The model's, each vertex by its coordinates"),
    ("any", ListOrder::Any, "Any, and any leading vertex of a triangle"),
];

impl StrengthArgs {
    /// The side under test, for a file of this kind and the backend, if one is given.
    ///
    /// # Errors
    /// A strength other than the strictest is given, but no device is tested.
    pub(super) fn tested(
        &self,
        kind: Kind,
        backend: Option<BackendName>,
    ) -> Result<Tested, Failure> {
        let strength = self.strength();
        if kind == Kind::Listings && backend.is_none() {
            return Ok(Tested::Listings(strength));
        }
        if strength == Strength::default() {
            return Ok(Tested::Backend);
        }
        let why = match backend {
            Some(_) => "leave out --backend, which is what is tested otherwise".to_owned(),
            None => format!("this file has no listings, its kind is {}", kind.name()),
        };
        Err(Failure::bad_input(format!(
            "--order, --points, --conversion and --denormals are for the listings of a device: {why}"
        )))
    }

    fn strength(&self) -> Strength {
        Strength {
            order: self.order,
            elements: if self.points { Elements::Points } else { Elements::Primitives },
            conversion: self.conversion,
            denormals: self.denormals,
        }
    }
}
