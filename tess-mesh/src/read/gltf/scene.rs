//! The nodes of a scene, each with its transform to the scene.
//!
//! The source is the glTF 2.0 Specification, section 3.5.2: nodes form strict trees. A node has at
//! most one parent, so that no node is visited twice and the walk ends.

use super::document::{Document, Node, broken, out_of_range};
use crate::repair::tally::Tally;
use glam::{Mat4, Quat, Vec3};
use std::cell::RefCell;

/// The nodes of a document.
#[derive(Debug)]
pub(crate) struct Nodes<'a> {
    document: &'a Document,
    /// The parent of each node, if it has one.
    parents: Vec<Option<usize>>,
    /// The transform of each node to scene coordinates, once it is known.
    transforms: RefCell<Vec<Option<Mat4>>>,
    /// The visible nodes, parents before children.
    pub(crate) seen: Vec<usize>,
    /// The number of the scene, if the document has scenes.
    pub(crate) scene: Option<usize>,
    /// The nodes that `KHR_node_visibility` hides.
    pub(crate) hidden: Tally,
}

impl<'a> Nodes<'a> {
    /// The nodes of this scene, of the default scene, of the first one, or all nodes if there are
    /// no scenes. Errors: a scene or node that is out of range; a visible node that has two parents
    /// or is below itself.
    pub(crate) fn of(document: &'a Document, scene: Option<usize>) -> Result<Self, String> {
        let count = document.nodes.len();
        let (parents, twice) = parents(document);
        let scene_of = scene.or(document.scene).or((document.scenes.len() > 0).then_some(0));
        let mut nodes = Self {
            document,
            parents,
            transforms: RefCell::new(vec![None; count]),
            seen: Vec::new(),
            scene: scene_of,
            hidden: Tally::default(),
        };
        let roots = match scene_of {
            Some(number) => nodes.roots(number)?,
            None => (0..count).filter(|&node| nodes.parents[node].is_none()).collect(),
        };
        let is_visited = nodes.walk(roots)?;
        if let Some((node, place)) = twice.iter().find(|(node, _)| is_visited[*node]) {
            let what = format!("node {node} is a child of another node already");
            return Err(broken(place, format!("{what}; nodes must form trees")));
        }
        Ok(nodes)
    }

    /// The roots of a scene.
    fn roots(&self, number: usize) -> Result<Vec<usize>, String> {
        let scene = self.document.scenes.get(number, "scene")?;
        let mut is_root = vec![false; self.parents.len()];
        let mut roots = Vec::with_capacity(scene.nodes.len());
        for (k, &node) in scene.nodes.iter().enumerate() {
            let path = format!("scenes[{number}].nodes[{k}]");
            let Some(parent) = self.parents.get(node) else {
                return Err(broken(path, out_of_range(node, self.parents.len(), "nodes")));
            };
            if is_root[node] {
                self.document.irregular(|| path);
                continue;
            }
            if parent.is_some() {
                self.document.irregular(|| path);
            }
            is_root[node] = true;
            roots.push(node);
        }
        Ok(roots)
    }

    /// Visits the nodes below these roots, parents before children, and returns which were visited.
    fn walk(&mut self, roots: Vec<usize>) -> Result<Vec<bool>, String> {
        let mut is_visited = vec![false; self.parents.len()];
        let mut waiting = roots;
        waiting.reverse();
        while let Some(number) = waiting.pop() {
            // A root may also be the child of another root.
            if std::mem::replace(&mut is_visited[number], true) {
                continue;
            }
            let node = self.document.nodes.get(number, format!("nodes[{number}]"))?;
            if node.is_hidden() {
                self.hidden.add(|| format!("nodes[{number}]"));
                continue;
            }
            for (k, &child) in node.children.iter().enumerate() {
                if child >= self.parents.len() {
                    let path = format!("nodes[{number}].children[{k}]");
                    return Err(broken(path, out_of_range(child, self.parents.len(), "nodes")));
                }
            }
            self.seen.push(number);
            waiting.extend(node.children.iter().rev());
        }
        Ok(is_visited)
    }

    /// The transform of a node to scene coordinates. Errors: a node that is below itself; an
    /// invalid transform of the node or of one above it.
    pub(crate) fn transform(&self, number: usize) -> Result<Mat4, String> {
        // From the node upwards, to the first whose transform is known.
        let mut path = Vec::new();
        let mut next = Some(number);
        let mut transform = Mat4::IDENTITY;
        while let Some(node) = next {
            if let Some(known) = self.transforms.borrow()[node] {
                transform = known;
                break;
            }
            path.push(node);
            if path.len() > self.parents.len() {
                let what = format!("node {node} is below itself; nodes must form trees");
                return Err(broken("nodes", what));
            }
            next = self.parents[node];
        }
        for &node in path.iter().rev() {
            let own = own_transform(self.document, node)?;
            transform = if self.parents[node].is_some() { transform * own } else { own };
            self.transforms.borrow_mut()[node] = Some(transform);
        }
        Ok(transform)
    }
}

/// The parent of each node, if it has one; and the nodes that have two, each with the place of the
/// second.
fn parents(document: &Document) -> (Vec<Option<usize>>, Vec<(usize, String)>) {
    let mut parents = vec![None; document.nodes.len()];
    let mut twice = Vec::new();
    // A malformed node matters only if it is needed, but it is a parent all the same.
    for (number, node) in document.nodes.values().iter().enumerate() {
        let children = node["children"].as_array().map_or(&[][..], Vec::as_slice);
        for (k, child) in children.iter().enumerate() {
            let child = child.as_u64().and_then(|child| usize::try_from(child).ok());
            let Some((child, parent)) = child.and_then(|c| Some((c, parents.get_mut(c)?))) else {
                continue;
            };
            match parent {
                None => *parent = Some(number),
                Some(_) => twice.push((child, format!("nodes[{number}].children[{k}]"))),
            }
        }
    }
    (parents, twice)
}

fn own_transform(document: &Document, number: usize) -> Result<Mat4, String> {
    let node = document.nodes.get(number, format!("nodes[{number}]"))?;
    if node.matrix.is_some()
        && (node.translation.is_some() || node.rotation.is_some() || node.scale.is_some())
    {
        // The matrix excludes the others.
        document.irregular(|| format!("nodes[{number}].matrix"));
    }
    transform(node).map_err(|(name, what)| broken(format!("nodes[{number}].{name}"), what))
}

fn transform(node: &Node) -> Result<Mat4, (&'static str, String)> {
    let finite = |name, numbers: &[f32]| {
        let fits = numbers.iter().all(|number| number.is_finite());
        fits.then_some(()).ok_or((name, "a number is too large for 32 bits".to_owned()))
    };
    if let Some(matrix) = node.matrix {
        finite("matrix", &matrix)?;
        let last_row = [matrix[3], matrix[7], matrix[11], matrix[15] - 1.0];
        if last_row.iter().any(|number| number.abs() > 0.0) {
            return Err(("matrix", "its last row must be 0, 0, 0, 1".to_owned()));
        }
        return Ok(Mat4::from_cols_array(&matrix));
    }
    let translation = node.translation.unwrap_or_default();
    let rotation = node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]);
    let scale = node.scale.unwrap_or([1.0; 3]);
    finite("translation", &translation)?;
    finite("rotation", &rotation)?;
    finite("scale", &scale)?;
    let rotation = Quat::from_array(rotation);
    // Exporters round quaternions, at worst to signed bytes.
    if (rotation.length_squared() - 1.0).abs() > 0.02 {
        return Err(("rotation", "it is not a unit quaternion".to_owned()));
    }
    let (scale, translation) = (Vec3::from_array(scale), Vec3::from_array(translation));
    Ok(Mat4::from_scale_rotation_translation(scale, rotation, translation))
}
