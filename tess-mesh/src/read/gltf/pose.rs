//! The pose of a mesh at rest: morph targets first, then the skin's joints or the node's transform.
//!
//! The source is the glTF 2.0 Specification, sections 3.7.2.2 (morph targets) and 3.7.3 (skins). A
//! vertex with a skin is moved by the weighted sum of its joints' matrices, not by its node's
//! transform.

use super::accessor::{Data, float};
use super::document::{Attributes, ComponentType, ElementKind, Skin, broken, out_of_range};
use super::scene::Nodes;
use glam::{Mat3, Mat4, Vec3};
use std::collections::BTreeMap;
use std::rc::Rc;

/// The matrices of each skin's joints, made once however many nodes have the skin.
#[derive(Debug, Default)]
pub(crate) struct Skins(BTreeMap<usize, Rc<[Mat4]>>);

impl Skins {
    fn joints(
        &mut self,
        data: &Data<'_>,
        nodes: &Nodes<'_>,
        skin: usize,
        path: &str,
    ) -> Result<Rc<[Mat4]>, String> {
        let found = data.document.skins.get(skin, path)?;
        if let Some(known) = self.0.get(&skin) {
            return Ok(Rc::clone(known));
        }
        let joints: Rc<[Mat4]> = joint_matrices(data, nodes, found, skin)?.into();
        self.0.insert(skin, Rc::clone(&joints));
        Ok(joints)
    }
}

/// The pose of one node's mesh.
#[derive(Debug)]
pub(crate) struct Pose {
    /// The node's transform to scene coordinates.
    transform: Mat4,
    /// The matrix of each joint, if there is a skin.
    joints: Option<Rc<[Mat4]>>,
    /// The weights of morph targets, if there are any.
    weights: Option<Vec<f32>>,
}

/// A joint that moves a vertex, and its weight.
type Influence = (usize, f32);

/// The matrices that move a primitive's vertices.
pub(crate) enum Matrices<'a> {
    /// One matrix for all vertices.
    Same(Mat4),
    /// Weighted sums of joints' matrices: the joints of each vertex, equally many for each.
    Blended { joints: &'a [Mat4], influences: Vec<Vec<[Influence; 4]>> },
}

impl Pose {
    /// The pose of a node's mesh. Errors: a skin that breaks a rule; weights that are not finite.
    pub(crate) fn of(
        data: &Data<'_>,
        nodes: &Nodes<'_>,
        skins: &mut Skins,
        number: usize,
    ) -> Result<Self, String> {
        let document = data.document;
        let node = document.nodes.get(number, format!("nodes[{number}]"))?;
        let mesh = node.mesh.and_then(|mesh| document.meshes.get(mesh, "").ok());
        let weights = node.weights.as_ref().or_else(|| mesh.and_then(|mesh| mesh.weights.as_ref()));
        if weights.is_some_and(|weights| !weights.iter().all(|weight| weight.is_finite())) {
            return Err(broken(
                format!("nodes[{number}]"),
                "a morph weight is too large for 32 bits",
            ));
        }
        let path = format!("nodes[{number}].skin");
        let joints = node.skin.map(|skin| skins.joints(data, nodes, skin, &path)).transpose()?;
        Ok(Self { transform: nodes.transform(number)?, joints, weights: weights.cloned() })
    }

    /// Whether joints move the vertices.
    pub(crate) const fn has_joints(&self) -> bool {
        self.joints.is_some()
    }

    /// Adds the morph targets' displacements of an attribute to its values. Errors: the number of
    /// weights is not that of targets; a target of another type or length. The message has the path
    /// below the primitive.
    pub(crate) fn morph(
        &self,
        data: &Data<'_>,
        targets: &[Attributes],
        name: &str,
        values: &mut [Vec3],
    ) -> Result<(), String> {
        let Some(weights) = &self.weights else { return Ok(()) };
        if weights.iter().all(|&weight| weight == 0.0) {
            return Ok(());
        }
        if weights.len() != targets.len() {
            let (weights, targets) = (weights.len(), targets.len());
            return Err(broken("targets", format!("there are {targets}, but {weights} weights")));
        }
        for ((number, target), &weight) in targets.iter().enumerate().zip(weights) {
            let Some(&accessor) = target.get(name) else { continue };
            if weight != 0.0 {
                let path = format!("targets[{number}].{name}");
                let moved = data.accessor(accessor, &path)?;
                if moved.kind != ElementKind::Vec3 {
                    let kind = moved.kind;
                    return Err(broken(
                        path,
                        format!("accessors[{accessor}] is {kind:?}, not VEC3"),
                    ));
                }
                if moved.count != values.len() as u64 {
                    return Err(broken(path, "its count is not that of the primitive's attribute"));
                }
                let moves = data.numbers::<3>(accessor)?;
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
    pub(crate) fn matrices(
        &self,
        data: &Data<'_>,
        attributes: &Attributes,
    ) -> Result<Matrices<'_>, String> {
        let Some(joints) = self.joints.as_deref() else {
            return Ok(Matrices::Same(self.transform));
        };
        let mut influences = Vec::new();
        for set in 0.. {
            let [joint, weight] =
                ["JOINTS", "WEIGHTS"].map(|name| attributes.get(&format!("{name}_{set}")));
            let (Some(&joint), Some(&weight)) = (joint, weight) else { break };
            let count = data.accessor(joint, format!("attributes.JOINTS_{set}"))?.count;
            let charged = data.budget.charge(count, size_of::<[Influence; 4]>() as u64, "joints");
            charged.map_err(|what| broken(format!("attributes.JOINTS_{set}"), what))?;
            let numbers = data.integers::<4>(joint)?.into_iter().zip(data.numbers::<4>(weight)?);
            let of_vertex = |(joints, weights): ([u32; 4], [f32; 4])| {
                std::array::from_fn(|k| (joints[k] as usize, weights[k]))
            };
            let of_set: Vec<[Influence; 4]> = numbers.map(of_vertex).collect();
            // A joint without weight moves nothing.
            let is_wrong = |&&(joint, weight): &&Influence| joint >= joints.len() && weight != 0.0;
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
    pub(crate) fn of(&self, vertex: usize) -> Mat4 {
        let (joints, influences) = match self {
            Self::Same(matrix) => return *matrix,
            Self::Blended { joints, influences } => (joints, influences),
        };
        let of_vertex = || influences.iter().flat_map(|set| set[vertex]);
        let sum: f32 = of_vertex().map(|(_, weight)| weight).sum();
        // Rounded weights may not add up to exactly 1. If all are zero, the first joint moves the
        // vertex.
        if !(sum > 0.0 && sum.is_finite()) {
            let first = of_vertex().next().and_then(|(joint, _)| joints.get(joint));
            return first.copied().unwrap_or(Mat4::IDENTITY);
        }
        let weighted = of_vertex().filter(|&(_, weight)| weight != 0.0);
        let blended =
            weighted.fold(Mat4::ZERO, |all, (joint, weight)| all + joints[joint] * weight);
        blended * (1.0 / sum)
    }

    /// Whether the vertex's matrix turns faces inside out.
    pub(crate) fn is_mirrored(&self, vertex: usize) -> bool {
        Mat3::from_mat4(self.of(vertex)).determinant() < 0.0
    }
}

/// A normal moved by a matrix, of any length; zero if the matrix flattens its face to a line.
///
/// It is moved by the matrix of cofactors, which is the inverse transpose times the determinant.
/// That matrix exists even where the determinant is 0: a face that is flattened to a plane gets the
/// plane's normal.
pub(crate) fn moved_normal(matrix: Mat4, normal: Vec3) -> Vec3 {
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
    nodes: &Nodes<'_>,
    skin: &Skin,
    number: usize,
) -> Result<Vec<Mat4>, String> {
    let Skin { inverse_bind_matrices, joints } = skin;
    let path = |name: &str| format!("skins[{number}].{name}");
    let charged = data.budget.charge(joints.len() as u64, size_of::<Mat4>() as u64, "joints");
    charged.map_err(|what| broken(path("joints"), what))?;
    let inverse = match *inverse_bind_matrices {
        None => vec![Mat4::IDENTITY; joints.len()],
        Some(accessor) => {
            inverse_bind_matrices_of(data, accessor, joints.len(), &path("inverseBindMatrices"))?
        }
    };
    let matrix = |(&joint, inverse): (&usize, Mat4)| {
        let count = data.document.nodes.len();
        if joint >= count {
            return Err(broken(path("joints"), out_of_range(joint, count, "nodes")));
        }
        Ok(nodes.transform(joint)? * inverse)
    };
    joints.iter().zip(inverse).map(matrix).collect()
}

fn inverse_bind_matrices_of(
    data: &Data<'_>,
    number: usize,
    joints: usize,
    path: &str,
) -> Result<Vec<Mat4>, String> {
    let accessor = data.accessor(number, path)?;
    let (kind, component, count) = (accessor.kind, accessor.component_type, accessor.count);
    if kind != ElementKind::Mat4 || component != ComponentType::Float {
        let what =
            format!("accessors[{number}] is {kind:?} of {component:?}; it must be MAT4 of Float");
        return Err(broken(path, what));
    }
    if count < joints as u64 {
        return Err(broken(
            path,
            format!("accessors[{number}] has {count} matrices for {joints} joints"),
        ));
    }
    let matrices = data.read::<f32, 16>(number, float)?;
    Ok(matrices.iter().map(Mat4::from_cols_array).collect())
}
