//! Tessellates a model and welds the result by the bits of its positions.

use std::collections::BTreeMap;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, Patch, PatchFactors};
use tess_surface::{DisplacedModel, Displacement, FactorRule, HalfEdge, Model};

pub(crate) type Triangle = [[f32; 3]; 3];

/// A change of one patch's factors, to plant a fault.
pub(crate) type Tamper = fn(usize, &mut PatchFactors);

/// A tessellated model.
#[derive(Default)]
pub(crate) struct Tessellated {
    pub(crate) triangles: Vec<Triangle>,
    /// The segments of the model's border: of edges with no other side that are not collapsed.
    pub(crate) border: Vec<[[f32; 3]; 2]>,
}

/// Tessellates a model, every position from the public evaluators.
pub(crate) fn tessellate(
    model: &Model,
    rule: &FactorRule,
    partitioning: Partitioning,
    displacement: Option<&Displacement>,
    tamper: Option<Tamper>,
) -> Tessellated {
    let config = Config::new(partitioning, OutputPrimitive::TriangleCw);
    let displaced = displacement.map(|displacement| DisplacedModel::new(model, displacement));
    let mut out = Tessellated::default();
    for number in 0..model.len() {
        let mut factors = rule.factors(model, number, partitioning);
        if let Some(tamper) = tamper {
            tamper(number, &mut factors);
        }
        let patch = model.patch(number);
        let displaced = displaced.as_ref().map(|displaced| displaced.patch(number));
        let position = |at: [f32; 2]| match &displaced {
            Some(displaced) => displaced.sample(at).position.to_array(),
            None => patch.sample(at).position.to_array(),
        };
        let whole = Patch::new(config, factors).tessellate();
        assert!(!whole.indices.is_empty(), "rules cull no patch");
        let at: Vec<[f32; 2]> = whole.points.iter().map(|point| point.to_f32()).collect();
        let positions: Vec<_> = at.iter().map(|&at| position(at)).collect();
        let corners = whole.indices.as_chunks::<3>().0;
        out.triangles.extend(corners.iter().map(|t| t.map(|index| positions[index as usize])));
        for edge in border_edges(model, number) {
            let line = points_on(&patch, edge, &at);
            out.border.extend(line.windows(2).map(|pair| [position(pair[0]), position(pair[1])]));
        }
    }
    out
}

fn border_edges(model: &Model, number: usize) -> Vec<usize> {
    let patch = model.patch(number);
    let edges = patch.edges().as_slice().iter().enumerate();
    let alone = edges.filter(|(edge, shared)| {
        let twin = model.twin(HalfEdge { patch: number, edge: *edge });
        twin.is_none() && shared.curve.collapsed_to().is_none()
    });
    alone.map(|(edge, _)| edge).collect()
}

/// The domain points on an edge, in order.
fn points_on(patch: &tess_surface::SurfacePatch, edge: usize, at: &[[f32; 2]]) -> Vec<[f32; 2]> {
    let on_edge = |&[u, v]: &[f32; 2]| match (patch.domain(), edge) {
        (_, 0) => u == 0.0,
        (_, 1) => v == 0.0,
        (Domain::Triangle, _) => u + v == 1.0,
        (_, 2) => u == 1.0,
        (_, _) => v == 1.0,
    };
    let mut line: Vec<_> = at.iter().copied().filter(on_edge).collect();
    line.sort_by(|a, b| (a[0] - a[1]).total_cmp(&(b[0] - b[1])));
    line
}

type EdgeKey = [[u32; 3]; 2];

fn edge_key(a: [f32; 3], b: [f32; 3]) -> Option<EdgeKey> {
    let [a, b] = [a, b].map(|p| p.map(f32::to_bits));
    (a != b).then(|| if a < b { [a, b] } else { [b, a] })
}

fn uses(edges: impl Iterator<Item = EdgeKey>) -> BTreeMap<EdgeKey, u32> {
    let mut uses = BTreeMap::new();
    edges.for_each(|key| *uses.entry(key).or_default() += 1);
    uses
}

/// The fault that is left after positions with equal bits are welded: `None` if the edges with an
/// odd number of triangles are those that the border passes an odd number of times. (Where a coarse
/// tessellation maps two edges to the same segment, four triangles meet.)
pub(crate) fn complaint(out: &Tessellated) -> Option<String> {
    // Triangles that welding has collapsed have no area and do not count.
    let solid = out
        .triangles
        .iter()
        .filter_map(|&[a, b, c]| Some([edge_key(a, b)?, edge_key(b, c)?, edge_key(c, a)?]));
    let inside = uses(solid.flatten());
    let border = uses(out.border.iter().filter_map(|&[a, b]| edge_key(a, b)));
    let odd =
        |uses: &BTreeMap<EdgeKey, u32>, key: &EdgeKey| uses.get(key).copied().unwrap_or(0) % 2 == 1;
    let cracks: Vec<_> = inside.keys().filter(|k| odd(&inside, k) && !odd(&border, k)).collect();
    let missing: Vec<_> = border.keys().filter(|k| odd(&border, k) && !odd(&inside, k)).collect();
    let first = |keys: &[&EdgeKey]| keys.first().map(|key| key.map(|p| p.map(f32::from_bits)));
    let (a, b) = (first(&cracks), first(&missing));
    let counts = (cracks.len(), missing.len());
    (counts != (0, 0)).then(|| {
        format!(
            "{} cracks, the first {a:?}; {} border segments missing, the first {b:?}",
            counts.0, counts.1
        )
    })
}
