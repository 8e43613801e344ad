//! The nodes of a scene, each with its transform to the scene.
//!
//! The source is the glTF 2.0 Specification, section 3.5.2: nodes form strict trees. A node has at
//! most one parent, so no node is visited twice and the walk ends.

use super::document::{Document, Node, broken};
use glam::{Mat4, Quat, Vec3};

/// The nodes of a document.
#[derive(Debug)]
pub(super) struct Nodes {
    /// The transform of each node to scene coordinates.
    pub(super) transforms: Vec<Mat4>,
    /// The visible nodes, parents before children.
    pub(super) seen: Vec<usize>,
}

impl Nodes {
    /// The nodes of the default scene, or of the first one, or all nodes if there are no scenes.
    /// Errors: a scene or node that is out of range; a node with two parents; an invalid transform.
    pub(super) fn of(document: &Document) -> Result<Self, String> {
        let parents = parents(document)?;
        let all_roots = || (0..parents.len()).filter(|&node| parents[node].is_none()).collect();
        let all = walk(document, all_roots());
        let mut transforms = vec![Mat4::IDENTITY; parents.len()];
        let mut is_visited = vec![false; parents.len()];
        for &number in &all {
            is_visited[number] = true;
            let own = transform(&document.nodes[number])
                .map_err(|(name, what)| broken(format!("nodes[{number}].{name}"), what))?;
            transforms[number] = match parents[number] {
                Some(parent) => transforms[parent] * own,
                None => own,
            };
        }
        let roots = roots(document, &parents)?;
        if let Some(lost) = (0..parents.len()).find(|node| !is_visited[*node]) {
            return Err(broken(
                "nodes",
                format!("node {lost} is below itself; nodes must form trees"),
            ));
        }
        let seen = roots.map_or(all, |roots| walk(document, roots));
        Ok(Self { transforms, seen })
    }
}

/// The roots of the scene that is shown; `None` if there are no scenes.
fn roots(document: &Document, parents: &[Option<usize>]) -> Result<Option<Vec<usize>>, String> {
    let scenes = document.scenes.as_deref().unwrap_or_default();
    let number = document.scene.unwrap_or(0);
    let Some(scene) = scenes.get(number) else {
        return match document.scene {
            None => Ok(None),
            Some(_) => Err(broken("scene", out_of_range(number, scenes.len(), "scenes"))),
        };
    };
    let mut is_root = vec![false; parents.len()];
    for (k, &node) in scene.nodes.iter().enumerate() {
        let path = format!("scenes[{number}].nodes[{k}]");
        match parents.get(node) {
            None => return Err(broken(path, out_of_range(node, parents.len(), "nodes"))),
            Some(Some(parent)) => {
                let what = format!("node {node} is a child of node {parent}; a scene has roots");
                return Err(broken(path, what));
            }
            Some(None) if is_root[node] => {
                return Err(broken(path, format!("node {node} is there twice")));
            }
            Some(None) => is_root[node] = true,
        }
    }
    Ok(Some(scene.nodes.clone()))
}

/// The nodes below these roots, parents before children.
fn walk(document: &Document, roots: Vec<usize>) -> Vec<usize> {
    let (mut visited, mut waiting) = (Vec::new(), roots);
    waiting.reverse();
    while let Some(number) = waiting.pop() {
        visited.push(number);
        waiting.extend(document.nodes[number].children.iter().rev());
    }
    visited
}

/// The parent of each node, if it has one.
fn parents(document: &Document) -> Result<Vec<Option<usize>>, String> {
    let count = document.nodes.len();
    let mut parents = vec![None; count];
    for (number, node) in document.nodes.iter().enumerate() {
        for (k, &child) in node.children.iter().enumerate() {
            let path = || format!("nodes[{number}].children[{k}]");
            let Some(parent) = parents.get_mut(child) else {
                return Err(broken(path(), out_of_range(child, count, "nodes")));
            };
            if let Some(other) = parent.replace(number) {
                let what = format!("node {child} is a child of node {other} already");
                return Err(broken(path(), format!("{what}; nodes must form trees")));
            }
        }
    }
    Ok(parents)
}

/// The message about an index into one of the document's lists.
pub(super) fn out_of_range(index: usize, count: usize, what: &str) -> String {
    format!("{index} is out of range: there are {count} {what}")
}

fn transform(node: &Node) -> Result<Mat4, (&'static str, String)> {
    let finite = |name, numbers: &[f32]| {
        let fits = numbers.iter().all(|number| number.is_finite());
        fits.then_some(()).ok_or((name, "a number is too large for 32 bits".to_owned()))
    };
    let translation = node.translation.unwrap_or_default();
    let rotation = node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]);
    let scale = node.scale.unwrap_or([1.0; 3]);
    finite("translation", &translation)?;
    finite("rotation", &rotation)?;
    finite("scale", &scale)?;
    let Some(matrix) = node.matrix else {
        let rotation = Quat::from_array(rotation);
        // Exporters round quaternions, at worst to signed bytes.
        if (rotation.length_squared() - 1.0).abs() > 0.02 {
            return Err(("rotation", "it is not a unit quaternion".to_owned()));
        }
        let (scale, translation) = (Vec3::from_array(scale), Vec3::from_array(translation));
        return Ok(Mat4::from_scale_rotation_translation(scale, rotation, translation));
    };
    finite("matrix", &matrix)?;
    if node.translation.is_some() || node.rotation.is_some() || node.scale.is_some() {
        return Err(("matrix", "it excludes translation, rotation and scale".to_owned()));
    }
    let last_row = [matrix[3], matrix[7], matrix[11], matrix[15] - 1.0];
    if last_row.iter().any(|number| number.abs() > 0.0) {
        return Err(("matrix", "its last row must be 0, 0, 0, 1".to_owned()));
    }
    Ok(Mat4::from_cols_array(&matrix))
}
