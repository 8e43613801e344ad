//! The teapot example's shaders evaluate the surface of tess-surface, and the test notices another
//! one.

#![expect(clippy::float_arithmetic, reason = "surfaces are evaluated in floating point")]

use crate::common::objects::{compute, dispatch, group, whole};
use crate::teapot;
use glam::{Vec3, Vec4};
use tess_core::Patch;
use tess_surface::{HalfEdge, Model};
use tess_wgpu::{Gpu, Tessellator};
use wgpu::BufferUsages as Usage;

/// Domain points to positions, by the function that the vertex shader calls.
const EVALUATE: &str = "
@group(0) @binding(1) var<storage, read> points: array<vec2u>;
@group(0) @binding(2) var<storage, read_write> positions: array<vec4f>;

@compute @workgroup_size(64)
fn evaluate(@builtin(global_invocation_id) id: vec3u) {
    if id.x < arrayLength(&points) {
        positions[id.x] = vec4f(teapot_position(unpack(points[id.x])), 1.0);
    }
}
";

/// The largest difference between two evaluations of one point, in units in the last place (ulps)
/// of the control net's extent E: its largest coordinate, well below the next power of two.
///
/// A point is six levels of interpolation deep, three along u and three along v. Each level, `a +
/// (b - a) t` with 0 <= t <= 1, passes on at most the larger error of a and b, and adds those of
/// its own operations: b - a and its product with t are at most 2 E, so rounding to nearest adds at
/// most 1 ulp each; the sum is at most E and adds half an ulp; fusing omits one of these errors.
/// That makes 6 * 2.5 = 15 ulps on the CPU. WGSL leaves the direction of rounding open, which
/// doubles it to 30 on the device; and its division by the weight, here exactly 1, may be off by
/// 2.5 ulps, here 3. Both together: 48. The two sides of an edge, both evaluated on the device, are
/// three levels deep: 2 * (15 + 3) = 36.
const BOUND_ULPS: f32 = 48.0;

/// The tessellated teapot: its points in the tessellator's order.
struct Teapot {
    gpu: Gpu,
    model: Model,
    /// The device's points, packed.
    packed: Vec<[u32; 2]>,
    /// tess-core's points: (u, v) of each point, by patch.
    domain_points: Vec<Vec<[f32; 2]>>,
    /// [`BOUND_ULPS`] as a distance along each axis.
    bound: f32,
}

impl Teapot {
    fn new() -> Self {
        let gpu = pollster::block_on(Gpu::open()).unwrap_or_else(|error| panic!("{error}"));
        let model = Model::bezier(tess_surface::teapot::patches()).expect("a sound model");
        let factors = teapot::factors().expect("a sound model");
        let mut tessellator = Tessellator::new(&gpu.device);
        let output = tessellator.tessellate(&gpu, teapot::setup(), &factors).expect("it runs");
        let domain_points: Vec<Vec<_>> = factors
            .iter()
            .map(|&factors| {
                let points = Patch::new(teapot::setup().config, factors).tessellate().points;
                points.iter().map(|point| point.to_f32()).collect()
            })
            .collect();
        let count: usize = domain_points.iter().map(Vec::len).sum();
        assert_eq!(output.points.len(), count, "the device has tess-core's points");
        let (low, high) = model.bounds();
        let extent = low.abs().max(high.abs()).max_element();
        Self {
            domain_points,
            packed: output.points,
            bound: BOUND_ULPS * (extent.next_up() - extent),
            gpu,
            model,
        }
    }

    /// The device's positions of each patch's points.
    fn positions(&self, source: &str, nets: &[[f32; 4]]) -> Vec<Vec<Vec3>> {
        let gpu = &self.gpu;
        let nets = gpu
            .upload("nets", bytemuck::cast_slice(nets), Usage::STORAGE)
            .expect("the device has room");
        let points = gpu
            .upload("points", bytemuck::cast_slice(&self.packed), Usage::STORAGE)
            .expect("the device has room");
        let size = 16 * self.packed.len() as u64;
        let written = gpu
            .buffer("positions", size, Usage::STORAGE | Usage::COPY_SRC)
            .expect("the device has room");
        let pipeline = compute(&gpu.device, [source, EVALUATE].concat(), "evaluate", &[]);
        let layout = pipeline.get_bind_group_layout(0);
        let group = group(&gpu.device, &layout, whole([&nets, &points, &written]));
        let threads = u32::try_from(self.packed.len()).expect("a teapot's points");
        dispatch(gpu, &pipeline, &[&group], threads.div_ceil(64)).expect("the device finishes");
        let bytes = gpu.read(&written, size).expect("the device answers");
        let all: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&bytes);
        assert!(all.iter().all(|point| point[3] > 0.0), "every position is written");
        let mut positions = all.iter().map(|&point| Vec4::from_array(point).truncate());
        let each =
            self.domain_points.iter().map(|points| positions.by_ref().take(points.len()).collect());
        each.collect()
    }

    /// The first position that is too far from the CPU's, if any.
    fn compare(&self, observed: &[Vec<Vec3>]) -> Result<(), String> {
        for (number, (points, observed)) in self.domain_points.iter().zip(observed).enumerate() {
            let patch = self.model.patch(number);
            for (&at, &observed) in points.iter().zip(observed) {
                let expected = patch.position(at);
                self.near(observed, expected)
                    .map_err(|error| format!("patch {number} at {at:?}: {error}"))?;
            }
        }
        Ok(())
    }

    /// The first pair of positions on both sides of an edge that are too far apart, if any.
    fn compare_sides(&self, observed: &[Vec<Vec3>]) -> Result<(), String> {
        let (mut edges, mut pairs) = (0, 0);
        let all = 0..4 * self.model.len();
        for half in all.map(|slot| HalfEdge { patch: slot / 4, edge: slot % 4 }) {
            let Some(twin) = self.model.twin(half) else { continue };
            let [own, other] = [half, twin].map(|half| self.along(half, observed));
            let [times, other_times] = [&own, &other].map(|side| side.iter().map(|&(t, _)| t));
            assert!(times.eq(other_times), "both sides of {half:?} have the same points");
            for ((t, own), (_, other)) in own.iter().zip(&other) {
                self.near(*own, *other).map_err(|error| format!("{half:?} at {t}: {error}"))?;
            }
            (edges, pairs) = (edges + 1, pairs + own.len());
        }
        assert_eq!(edges, 2 * 52, "sides of common curves");
        assert!(pairs >= 2 * edges, "at least the ends of each");
        Ok(())
    }

    /// The positions along an edge with their parameters in the edge's canonical direction.
    fn along(&self, half: HalfEdge, observed: &[Vec<Vec3>]) -> Vec<(f32, Vec3)> {
        let HalfEdge { patch, edge } = half;
        let direction = self.model.patch(patch).edges().as_slice()[edge].direction;
        let on_edge = |[u, v]: [f32; 2]| match edge {
            0 => (u <= 0.0).then_some(v),
            1 => (v <= 0.0).then_some(u),
            2 => (u >= 1.0).then_some(v),
            _ => (v >= 1.0).then_some(u),
        };
        let all = self.domain_points[patch].iter().zip(&observed[patch]);
        let mut points: Vec<_> = all
            .filter_map(|(&at, &position)| Some((direction.canonical(on_edge(at)?), position)))
            .collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        points
    }

    fn near(&self, observed: Vec3, expected: Vec3) -> Result<(), String> {
        let distance = (observed - expected).abs().max_element();
        // NaN is not near either number.
        if distance <= self.bound {
            return Ok(());
        }
        let ulps = BOUND_ULPS * distance / self.bound;
        Err(format!("{observed} is {ulps} ulps from {expected}"))
    }
}

#[test]
fn the_shaders_evaluate_the_teapot() {
    let teapot = Teapot::new();
    assert!(teapot.packed.len() > 10_000, "{} points", teapot.packed.len());
    let positions = teapot.positions(&teapot::source(), &teapot::nets());
    assert_eq!(teapot.compare(&positions), Ok(()), "the CPU's positions");
    assert_eq!(teapot.compare_sides(&positions), Ok(()), "both sides of every edge");
}

/// One coordinate of one control point, on an edge that the patch shares with a neighbour.
#[test]
fn a_moved_control_point_is_seen() {
    let teapot = Teapot::new();
    let mut nets = teapot::nets();
    // Patch 6, row 0, column 1, which has the weight 4/9 at u = 1/3.
    nets[16 * 6 + 1][2] += 4.0 * teapot.bound;
    let positions = teapot.positions(&teapot::source(), &nets);
    let difference = teapot.compare(&positions).expect_err("another surface");
    assert!(difference.starts_with("patch 6 "), "{difference}");
    assert!(teapot.compare_sides(&positions).is_err(), "the edge is open");
}

#[test]
fn a_changed_formula_is_seen() {
    let teapot = Teapot::new();
    for (right, wrong) in [
        ("a + (b - a) * t", "a + (b - a) * (1.0001 * t)"),
        ("bezier_lerp(points[1], points[2], t)", "bezier_lerp(points[1], points[3], t)"),
        ("s = 1.0 - t", "s = t"),
        ("packed.x >> 17u", "packed.x >> 16u"),
    ] {
        let source = teapot::source();
        assert_eq!(source.matches(right).count(), 1, "{right}");
        let positions = teapot.positions(&source.replace(right, wrong), &teapot::nets());
        assert!(teapot.compare(&positions).is_err(), "{wrong} makes no difference");
    }
}
