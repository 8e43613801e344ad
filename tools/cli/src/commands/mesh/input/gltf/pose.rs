//! The pose of a mesh at rest: morph targets first, then the skin's joints or the node's transform.
//!
//! The source is the glTF 2.0 Specification, sections 3.7.2.2 (morph targets) and 3.7.3 (skins). A
//! vertex with a skin is moved by the weighted sum of its joints' matrices, not by its node's
//! transform.

use super::accessor::{Data, float};
use super::document::{Attributes, ComponentType, ElementKind, Skin, broken};
use super::scene::{Nodes, out_of_range};
use glam::{Mat3, Mat4, Vec3};

/// The pose of one node's mesh.
#[derive(Debug)]
pub(super) struct Pose {
    /// The node's transform to scene coordinates.
    transform: Mat4,
    /// The matrix of each joint, if there is a skin.
    joints: Option<Vec<Mat4>>,
    /// The weights of morph targets, if there are any.
    weights: Option<Vec<f32>>,
}

/// A joint that moves a vertex, and its weight.
type Influence = (usize, f32);

/// The matrices that move a primitive's vertices.
pub(super) enum Matrices<'a> {
    /// One matrix for all vertices.
    Same(Mat4),
    /// Weighted sums of joints' matrices: the joints of each vertex, equally many for each.
    Blended { joints: &'a [Mat4], influences: Vec<Vec<[Influence; 4]>> },
}

impl Pose {
    /// The pose of a node's mesh. Errors: a skin that breaks a rule; weights that are not finite.
    pub(super) fn of(data: &Data<'_>, nodes: &Nodes, number: usize) -> Result<Self, String> {
        let document = data.document;
        let node = &document.nodes[number];
        let mesh = node.mesh.and_then(|mesh| document.meshes.get(mesh));
        let weights = node.weights.as_ref().or_else(|| mesh.and_then(|mesh| mesh.weights.as_ref()));
        if weights.is_some_and(|weights| !weights.iter().all(|weight| weight.is_finite())) {
            return Err(broken(
                format!("nodes[{number}]"),
                "a morph weight is too large for 32 bits",
            ));
        }
        let joints = node.skin.map(|skin| {
            let count = document.skins.len();
            let found = document.skins.get(skin).ok_or_else(|| {
                broken(format!("nodes[{number}].skin"), out_of_range(skin, count, "skins"))
            })?;
            joint_matrices(data, nodes, found)
                .map_err(|(name, what)| broken(format!("skins[{skin}].{name}"), what))
        });
        let transform = nodes.transforms[number];
        Ok(Self { transform, joints: joints.transpose()?, weights: weights.cloned() })
    }

    /// Adds the morph targets' displacements of an attribute to its values. Errors: the number of
    /// weights is not that of targets; a target of another type or length. The message has the path
    /// below the primitive.
    pub(super) fn morph(
        &self,
        data: &Data<'_>,
        targets: &[Attributes],
        name: &str,
        values: &mut [Vec3],
    ) -> Result<(), String> {
        let Some(weights) = &self.weights else { return Ok(()) };
        if weights.len() != targets.len() {
            let (weights, targets) = (weights.len(), targets.len());
            return Err(broken("targets", format!("there are {targets}, but {weights} weights")));
        }
        for ((number, target), &weight) in targets.iter().enumerate().zip(weights) {
            let Some(&accessor) = target.get(name) else { continue };
            if weight != 0.0 {
                let moves = data.numbers::<3>(accessor)?;
                let path = format!("targets[{number}].{name}");
                if moves.len() != values.len() {
                    return Err(broken(path, "its count is not that of the primitive's attribute"));
                }
                values
                    .iter_mut()
                    .zip(moves)
                    .for_each(|(value, by)| *value += Vec3::from_array(by) * weight);
            }
        }
        Ok(())
    }

    /// The matrices of a primitive's vertices. Errors: a joint that is out of range, with the path
    /// below the primitive.
    pub(super) fn matrices(
        &self,
        data: &Data<'_>,
        attributes: &Attributes,
    ) -> Result<Matrices<'_>, String> {
        let Some(joints) = &self.joints else { return Ok(Matrices::Same(self.transform)) };
        let mut influences = Vec::new();
        for set in 0.. {
            let [joint, weight] =
                ["JOINTS", "WEIGHTS"].map(|name| attributes.get(&format!("{name}_{set}")));
            let (Some(&joint), Some(&weight)) = (joint, weight) else { break };
            let numbers = data.integers::<4>(joint)?.into_iter().zip(data.numbers::<4>(weight)?);
            let of_vertex = |(joints, weights): ([u32; 4], [f32; 4])| {
                std::array::from_fn(|k| (joints[k] as usize, weights[k]))
            };
            let of_set: Vec<[Influence; 4]> = numbers.map(of_vertex).collect();
            let is_wrong = |&&(joint, _): &&Influence| joint >= joints.len();
            if let Some(&(joint, _)) = of_set.as_flattened().iter().find(is_wrong) {
                let path = format!("attributes.JOINTS_{set}");
                return Err(broken(path, out_of_range(joint, joints.len(), "joints")));
            }
            influences.push(of_set);
        }
        // A mesh without joints is moved by its node, whether or not the node has a skin.
        if influences.is_empty() {
            return Ok(Matrices::Same(self.transform));
        }
        Ok(Matrices::Blended { joints, influences })
    }
}

impl Matrices<'_> {
    /// The matrix of a vertex.
    pub(super) fn of(&self, vertex: usize) -> Mat4 {
        let (joints, influences) = match self {
            Self::Same(matrix) => return *matrix,
            Self::Blended { joints, influences } => (joints, influences),
        };
        let of_vertex = || influences.iter().flat_map(|set| set[vertex]);
        let sum: f32 = of_vertex().map(|(_, weight)| weight).sum();
        // Rounded weights may not add up to exactly 1. If all are zero, the first joint moves the
        // vertex.
        if !(sum > 0.0 && sum.is_finite()) {
            return of_vertex().next().map_or(Mat4::IDENTITY, |(joint, _)| joints[joint]);
        }
        let weighted = of_vertex().filter(|&(_, weight)| weight != 0.0);
        let blended =
            weighted.fold(Mat4::ZERO, |all, (joint, weight)| all + joints[joint] * weight);
        blended * (1.0 / sum)
    }

    /// Whether the vertex's matrix turns faces inside out.
    pub(super) fn is_mirrored(&self, vertex: usize) -> bool {
        Mat3::from_mat4(self.of(vertex)).determinant() < 0.0
    }
}

/// A normal moved by a matrix, of any length; zero if the matrix flattens its face to a line.
///
/// It is moved by the matrix of cofactors, which is the inverse transpose times the determinant.
/// That matrix exists even where the determinant is 0: a face that is flattened to a plane gets the
/// plane's normal.
pub(super) fn moved_normal(matrix: Mat4, normal: Vec3) -> Vec3 {
    let linear = Mat3::from_mat4(matrix);
    let [x, y, z] = linear.to_cols_array_2d().map(Vec3::from_array);
    let largest = x.abs().max(y.abs()).max(z.abs()).max_element();
    if !(largest > 0.0 && largest.is_finite()) {
        return Vec3::ZERO;
    }
    let [x, y, z] = [x, y, z].map(|column| column / largest);
    let moved = y.cross(z) * normal.x + z.cross(x) * normal.y + x.cross(y) * normal.z;
    if x.dot(y.cross(z)) < 0.0 { -moved } else { moved }
}

/// The matrix of each joint of a skin, from the mesh's bind pose to the scene.
fn joint_matrices(
    data: &Data<'_>,
    nodes: &Nodes,
    skin: &Skin,
) -> Result<Vec<Mat4>, (&'static str, String)> {
    let Skin { inverse_bind_matrices, joints } = skin;
    let inverse = match *inverse_bind_matrices {
        None => vec![Mat4::IDENTITY; joints.len()],
        Some(number) => {
            let name = "inverseBindMatrices";
            inverse_bind_matrices_of(data, number, joints.len()).map_err(|what| (name, what))?
        }
    };
    let matrix = |(&joint, inverse): (&usize, Mat4)| {
        let count = nodes.transforms.len();
        let transform = nodes.transforms.get(joint);
        let transform = transform.ok_or_else(|| ("joints", out_of_range(joint, count, "nodes")))?;
        Ok(*transform * inverse)
    };
    joints.iter().zip(inverse).map(matrix).collect()
}

fn inverse_bind_matrices_of(
    data: &Data<'_>,
    number: usize,
    joints: usize,
) -> Result<Vec<Mat4>, String> {
    let accessors = &data.document.accessors;
    let accessor =
        accessors.get(number).ok_or_else(|| out_of_range(number, accessors.len(), "accessors"))?;
    let (kind, component) = (accessor.kind, accessor.component_type);
    if kind != ElementKind::Mat4 || component != ComponentType::Float {
        return Err(format!(
            "accessors[{number}] is {kind:?} of {component:?}; it must be MAT4 of Float"
        ));
    }
    let matrices = data.read::<f32, 16>(number, float)?;
    if matrices.len() < joints {
        return Err(format!(
            "accessors[{number}] has {} matrices for {joints} joints",
            matrices.len()
        ));
    }
    Ok(matrices.iter().map(Mat4::from_cols_array).collect())
}
