//! Elements as messages print them.

use tess_core::DomainPoint;

/// A point in decimal and in bits.
pub(crate) fn shown(point: DomainPoint) -> String {
    let DomainPoint { u, v } = point;
    format!("({u}, {v}) = (0x{:05x}, 0x{:05x})", u.to_bits(), v.to_bits())
}
