//! The options that say what counts as equal in a device's listings.

use crate::failure::Failure;
use clap::ValueEnum;
use tess_verify::strength::{Conversion, Denormals, Elements, Order, Strength};
use tess_verify::vectors::{Header, Kind};

/// The strength of a comparison with a device under test (spec section 13).
#[derive(Clone, Debug, clap::Args)]
#[command(next_help_heading = "Strength, for the listings of a device")]
pub(crate) struct StrengthArgs {
    /// Order of points and primitives
    #[arg(long, value_name = "NAME", default_value = "exact")]
    order: OrderName,
    /// Compare points and primitives (the default)
    #[arg(long, conflicts_with = "points")]
    primitives: bool,
    /// Compare the domain points alone
    #[arg(long)]
    points: bool,
    /// Conversion of factors to fixed point
    #[arg(long, value_name = "NAME", default_value = "exact")]
    conversion: ConversionName,
    /// Positive denormal outer factors
    #[arg(long, value_name = "NAME", default_value = "keep")]
    denormals: DenormalsName,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum OrderName {
    /// The model's, index for index
    Exact,
    /// Any, and any leading vertex of a triangle
    Any,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum ConversionName {
    /// To the nearest, ties to even
    Exact,
    /// Either neighbour where the fraction lies in 0.4 to 0.6
    #[value(name = "0.6ulp")]
    Within06Ulp,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum DenormalsName {
    /// Greater than zero
    Keep,
    /// Maybe zero, which culls the patch
    Flush,
}

impl StrengthArgs {
    /// The strength for a file with this header.
    ///
    /// # Errors
    /// A weaker strength than identity for results that are not a device's.
    pub(crate) fn of(&self, header: &Header) -> Result<Strength, Failure> {
        let strength = self.strength();
        let from_device = header.kind == Kind::Listings && header.is_from_device();
        if strength.is_strictest() || from_device {
            return Ok(strength);
        }
        Err(Failure::bad_input(format!(
            "--order, --points, --conversion and --denormals are for the listings of a device; \
             this file's results come from {}, and every backend must equal them exactly",
            header.source
        )))
    }

    fn strength(&self) -> Strength {
        Strength {
            order: match self.order {
                OrderName::Exact => Order::Exact,
                OrderName::Any => Order::Any,
            },
            elements: if self.points { Elements::Points } else { Elements::Primitives },
            conversion: match self.conversion {
                ConversionName::Exact => Conversion::Exact,
                ConversionName::Within06Ulp => Conversion::Within06Ulp,
            },
            denormals: match self.denormals {
                DenormalsName::Keep => Denormals::Keep,
                DenormalsName::Flush => Denormals::Flush,
            },
        }
    }
}
