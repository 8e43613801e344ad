//! Digests of captures, in the device's order and in none.

use tess_core::Tessellation;
use tess_verify::digest::Fnv1a;

/// Digests over the patches of a configuration, one after another.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Digests {
    sequence: Fnv1a,
    set: Fnv1a,
}

impl Digests {
    /// Continues over a patch whose primitives have `size` vertices: the number of its primitives,
    /// then u and v of each vertex as 16.16 numbers. For the set, each triangle begins with the vertex
    /// that makes it least, and primitives are sorted.
    pub fn add(&mut self, output: &Tessellation, size: usize) {
        let point = |&index: &u32| {
            let point = output.points.get(index as usize);
            point.map_or([u32::MAX; 2], |point| [point.u.to_bits(), point.v.to_bits()])
        };
        let vertices: Vec<[u32; 2]> = output.indices.iter().map(point).collect();
        let mut primitives: Vec<Vec<[u32; 2]>> = vertices.chunks(size).map(<[_]>::to_vec).collect();
        add(&mut self.sequence, &primitives);
        if size == 3 {
            for triangle in &mut primitives {
                let least = (0..triangle.len()).min_by_key(|&i| {
                    let mut turned = triangle.clone();
                    turned.rotate_left(i);
                    turned
                });
                triangle.rotate_left(least.unwrap_or(0));
            }
        }
        primitives.sort_unstable();
        add(&mut self.set, &primitives);
    }

    /// The digest in order, as 16 hex digits.
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

fn add(digest: &mut Fnv1a, primitives: &[Vec<[u32; 2]>]) {
    digest.word(u32::try_from(primitives.len()).unwrap_or(u32::MAX));
    digest.words(primitives.iter().flatten().flatten().copied());
}
