//! Digests of captures, with and without regard to the device's order.

use tess_core::Tessellation;
use tess_verify::vectors::Fnv1a;

/// Digests over the patches of a configuration, one after another.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Digests {
    sequence: Fnv1a,
    set: Fnv1a,
}

impl Digests {
    /// Adds a patch whose primitives have `size` vertices: the number of its primitives, then u and
    /// v of each vertex as 16.16 numbers. For the set, each triangle starts with the vertex that
    /// makes it smallest, and primitives are sorted.
    pub fn add(&mut self, output: &Tessellation, size: usize) {
        let place = |&index: &u32| {
            let point = output.points.get(index as usize);
            point.map_or(NONE, |p| u64::from(p.u.to_bits()) << 32 | u64::from(p.v.to_bits()))
        };
        let primitive = |indices: &[u32]| {
            let mut places = [NONE; 3];
            places.iter_mut().zip(indices).for_each(|(to, index)| *to = place(index));
            places
        };
        let mut primitives: Vec<[u64; 3]> = output.indices.chunks(size).map(primitive).collect();
        add(&mut self.sequence, &primitives, size);
        if size == 3 {
            for triangle in &mut primitives {
                let [a, b, c] = *triangle;
                *triangle = [a, b, c].min([b, c, a]).min([c, a, b]);
            }
        }
        primitives.sort_unstable();
        add(&mut self.set, &primitives, size);
    }

    /// The digest in the device's order, as 16 hex digits.
    #[must_use]
    pub fn sequence(&self) -> String {
        format!("{:016x}", self.sequence.finish())
    }

    /// The digest that does not depend on the order, as 16 hex digits.
    #[must_use]
    pub fn set(&self) -> String {
        format!("{:016x}", self.set.finish())
    }
}

/// A placeholder for a vertex that does not exist.
const NONE: u64 = u64::MAX;

fn add(digest: &mut Fnv1a, primitives: &[[u64; 3]], size: usize) {
    digest.words([u32::try_from(primitives.len()).unwrap_or(u32::MAX)]);
    let places = primitives.iter().flat_map(|primitive| primitive.iter().take(size));
    digest.words(places.flat_map(|place| [(place >> 32) as u32, (place & 0xFFFF_FFFF) as u32]));
}
