//! The options that say what counts as equal in a device's listings.

use crate::backends::BackendName;
use crate::failure::Failure;
use clap::ValueEnum;
use tess_verify::Named;
use tess_verify::check::{Conversion, Denormals, Elements, ListOrder, Strength, Tested};
use tess_verify::vectors::Kind;

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
    /// The model's, each vertex by its coordinates
    Sequence,
    /// Any, and any leading vertex of a triangle
    Any,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum ConversionName {
    /// To the nearest, ties to even
    Exact,
    /// Either neighbour where the fraction lies in 0.4 to 0.6
    #[value(name = "0.6ulp")]
    Within06Ulp,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum DenormalsName {
    /// Greater than zero
    Keep,
    /// Maybe zero, which culls the patch
    Flush,
}

impl StrengthArgs {
    /// The side that is tested with a file of this kind and a backend, if one was asked for.
    ///
    /// # Errors
    /// A weaker strength than identity where no device is tested.
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
            order: match self.order {
                OrderName::Exact => ListOrder::Exact,
                OrderName::Sequence => ListOrder::Sequence,
                OrderName::Any => ListOrder::Any,
            },
            elements: if self.points { Elements::Points } else { Elements::Primitives },
            conversion: self.conversion.into(),
            denormals: self.denormals.into(),
        }
    }
}

impl From<ConversionName> for Conversion {
    fn from(name: ConversionName) -> Self {
        match name {
            ConversionName::Exact => Self::Exact,
            ConversionName::Within06Ulp => Self::Within06Ulp,
        }
    }
}

impl From<DenormalsName> for Denormals {
    fn from(name: DenormalsName) -> Self {
        match name {
            DenormalsName::Keep => Self::Keep,
            DenormalsName::Flush => Self::Flush,
        }
    }
}
