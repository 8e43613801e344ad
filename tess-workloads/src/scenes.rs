//! The patches of each workload. They are built only from integers and correctly rounded
//! operations, so they are the same on every machine.
#![expect(
    clippy::float_arithmetic,
    clippy::cast_possible_truncation,
    reason = "scenes are built from additions, multiplications, divisions and square roots in \
              binary64, each correctly rounded, and rounded to binary32 at the end"
)]

use super::{Calls, Workload};
use tess_core::{
    Config, IsolineFactors, OutputPrimitive, Partitioning, PatchFactors, QuadFactors,
    TriangleFactors,
};
use tess_verify::generate::SplitMix64;

/// The factors K of the workloads `uniform-K`.
pub(super) const UNIFORM_FACTORS: [u8; 7] = [1, 2, 4, 8, 16, 32, 64];

/// The seed of the workloads that are drawn at random.
const SEED: u64 = 11;

/// `uniform-K`: 4096 quads, with all factors `factor`, integer.
#[must_use]
pub(super) fn uniform(factor: u8) -> Workload {
    let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
    let patch = quad([factor.into(); 6]);
    Workload::batch(format!("uniform-{factor}"), config, vec![patch; 4096])
}

/// `seed-table`: single quads of several sizes, and every integer isoline, one patch per call.
#[must_use]
pub(super) fn seed_table() -> Vec<Workload> {
    let quads = [
        ("16", [16; 6]),
        ("32", [32; 6]),
        ("48", [48; 6]),
        ("64", [64; 6]),
        ("32-16-8-6-4-2", [32, 16, 8, 6, 4, 2]),
        ("64-15-23-14-13-46", [64, 15, 23, 14, 13, 46]),
    ];
    let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
    let mut workloads = Vec::new();
    for (name, factors) in quads {
        let patch = quad(factors.map(|factor: u8| f32::from(factor)));
        workloads.push(Workload::single(format!("seed-table/quad-{name}"), config, vec![patch]));
    }
    workloads.push(isolines());
    workloads
}

/// `seed-table/isolines`: every integer isoline, density by density.
fn isolines() -> Workload {
    let factors = (1..=64u8).flat_map(|density| (1..=64u8).map(move |detail| (density, detail)));
    let patches = factors
        .map(|(density, detail)| IsolineFactors { density, detail }.map(f32::from).into())
        .collect();
    let config = Config::new(Partitioning::Integer, OutputPrimitive::Line);
    Workload::single("seed-table/isolines", config, patches)
}

/// `unlike-K`: like `uniform-K`, except that every other patch has the factors K - 1/2, which
/// integer partitioning rounds up to K. So all patches have the same output, but neighbours always
/// have different factors.
fn unlike(factor: u8) -> Workload {
    let alike = uniform(factor);
    let other = quad([f32::from(factor) - 0.5; 6]);
    let pair = [alike.patches[0], other];
    let patches = pair.into_iter().cycle().take(alike.patches.len()).collect();
    Workload { name: format!("unlike-{factor}"), patches, ..alike }
}

/// `single/...`: one patch per call; with small patches, and with the workloads in which neighbours
/// differ.
#[must_use]
pub(super) fn single() -> Vec<Workload> {
    let uniforms = [1, 2, 4, 8].map(uniform);
    let scenes = [terrain(), character(), mosaic(), mosaic_even(), worst()];
    uniforms
        .into_iter()
        .chain(UNIFORM_FACTORS.map(unlike))
        .chain(scenes)
        .map(|workload| Workload {
            name: format!("single/{}", workload.name),
            calls: Calls::SinglePatch,
            ..workload
        })
        .collect()
}

/// `terrain`: a flat ground of 64 x 64 quads seen by a camera, `fractional_even`.
///
/// Patch (x, z) covers the unit square from (x, z), with u along x and v along z. The camera is at
/// (32, 0), 3 units above the ground: over the middle of the border z = 0. An edge's factor is 192
/// divided by the distance from the camera to the edge's midpoint: from 63 below the camera to 2.7
/// in the far corners. Patches on both sides of an edge use the same midpoint, so they agree. Both
/// inside factors are the mean of the four edges' factors.
#[must_use]
pub(super) fn terrain() -> Workload {
    /// Coordinates are in half units, so that midpoints are whole numbers.
    fn edge_factor(x_halves: i32, z_halves: i32) -> f64 {
        let (x, z) = (f64::from(x_halves) / 2.0 - 32.0, f64::from(z_halves) / 2.0);
        192.0 / (x * x + z * z + 9.0).sqrt()
    }
    let mut patches = Vec::new();
    for z in (0..128).step_by(2) {
        for x in (0..128).step_by(2) {
            let midpoints = [(x, z + 1), (x + 1, z), (x + 2, z + 1), (x + 1, z + 2)];
            let [u0, v0, u1, v1] = midpoints.map(|(x, z)| edge_factor(x, z));
            let mean = (u0 + v0 + u1 + v1) / 4.0;
            patches.push(quad([u0, v0, u1, v1, mean, mean].map(|factor| factor as f32)));
        }
    }
    let config = Config::new(Partitioning::FractionalEven, OutputPrimitive::TriangleCw);
    Workload::batch("terrain", config, patches)
}

/// `character`: 20000 triangles with edge factors log-uniform in 1..8, `fractional_odd`.
///
/// The inside factor is the mean of the three edge factors.
#[must_use]
pub(super) fn character() -> Workload {
    let mut random = SplitMix64::new(SEED);
    let patches = (0..20_000).map(|_| character_triangle(&mut random)).collect();
    let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
    Workload::batch("character", config, patches)
}

/// `mosaic`: 20000 quads, integer, with every factor drawn from 1, 2, 3 and 4 independently. Hardly
/// any two neighbours are equal.
#[must_use]
pub(super) fn mosaic() -> Workload {
    let mut random = SplitMix64::new(SEED);
    let patches =
        (0..20_000).map(|_| quad(std::array::from_fn(|_| (1 + random.below(4)) as f32))).collect();
    let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
    Workload::batch("mosaic", config, patches)
}

/// `mosaic-even`: 20000 quads, `fractional_even`, with every factor uniform in 1..6 independently.
#[must_use]
pub(super) fn mosaic_even() -> Workload {
    let mut random = SplitMix64::new(SEED);
    let patches = (0..20_000)
        .map(|_| quad(std::array::from_fn(|_| (1.0 + 5.0 * unit(&mut random)) as f32)))
        .collect();
    let config = Config::new(Partitioning::FractionalEven, OutputPrimitive::TriangleCw);
    Workload::batch("mosaic-even", config, patches)
}

/// `meshes/...`: 256 meshes of 40 to 400 patches, `fractional_odd`, with edge factors as in
/// `character`. Inside factors are the mean of the edge factors. There are `triangles` and `quads`,
/// with one mesh per call or (`-at-once`) all of them in one call.
#[must_use]
pub(super) fn meshes() -> Vec<Workload> {
    let triangles = meshes_of("triangles", character_triangle);
    triangles.into_iter().chain(meshes_of("quads", character_quad)).collect()
}

/// The two workloads with the same meshes.
fn meshes_of(name: &str, patch: fn(&mut SplitMix64) -> PatchFactors) -> [Workload; 2] {
    let mut random = SplitMix64::new(SEED);
    let (mut groups, mut patches) = (Vec::new(), Vec::new());
    for _ in 0..256 {
        groups.push(patches.len() as u32);
        let size = 40 + random.below(361);
        patches.extend((0..size).map(|_| patch(&mut random)));
    }
    let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
    let all = Workload::batch(format!("meshes/{name}"), config, patches);
    let each = Workload { groups, calls: Calls::Group, ..all };
    let name = format!("meshes/{name}-at-once");
    let at_once = Workload { name, calls: Calls::AllGroups, ..each.clone() };
    [each, at_once]
}

/// A triangle with edge factors log-uniform in 1..8.
fn character_triangle(random: &mut SplitMix64) -> PatchFactors {
    let [u0, v0, w0] = std::array::from_fn(|_| power_of_two(3.0 * unit(random)));
    let inside = (u0 + v0 + w0) / 3.0;
    TriangleFactors { u0, v0, w0, inside }.map(|factor| factor as f32).into()
}

/// A quad with edge factors log-uniform in 1..8.
fn character_quad(random: &mut SplitMix64) -> PatchFactors {
    let [u0, v0, u1, v1] = std::array::from_fn(|_| power_of_two(3.0 * unit(random)));
    let mean = (u0 + v0 + u1 + v1) / 4.0;
    quad([u0, v0, u1, v1, mean, mean].map(|factor| factor as f32))
}

/// `worst`: 1024 quads, `fractional_odd`, with every factor uniform in 1..64 independently.
#[must_use]
pub(super) fn worst() -> Workload {
    let mut random = SplitMix64::new(SEED);
    let patches = (0..1024)
        .map(|_| quad(std::array::from_fn(|_| (1.0 + 63.0 * unit(&mut random)) as f32)))
        .collect();
    let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
    Workload::batch("worst", config, patches)
}

fn quad(factors: [f32; 6]) -> PatchFactors {
    QuadFactors::from(factors).into()
}

/// 2^x for x >= 0, computed from square roots, because library powers differ between machines.
///
/// Uses the first 24 bits of x's fraction: bit -k contributes the 2^k-th root of two.
fn power_of_two(mut x: f64) -> f64 {
    let mut power = 1.0;
    while x >= 1.0 {
        power *= 2.0;
        x -= 1.0;
    }
    let mut root: f64 = 2.0;
    for _ in 0..24 {
        root = root.sqrt();
        x *= 2.0;
        if x >= 1.0 {
            power *= root;
            x -= 1.0;
        }
    }
    power
}

/// A multiple of 2^-24 in `0..1`, evenly distributed.
fn unit(random: &mut SplitMix64) -> f64 {
    f64::from(random.next_u32() >> 8) / f64::from(1 << 24)
}
