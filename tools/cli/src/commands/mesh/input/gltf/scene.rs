//! The nodes of a scene, each with its transform to the scene.
//!
//! glTF 2.0 Specification, section 3.5.2: nodes form strict trees. A node has at most one parent, so
//! no node is visited twice and the walk ends.

use super::document::{Document, Node, broken};
use glam::{Mat4, Quat, Vec3};

/// The nodes of the default scene, or the first one, parents before children. Errors: no scene, a node that is out of
/// range or has two parents, a transform that is none.
pub(super) fn nodes(document: &Document) -> Result<Vec<(usize, Mat4)>, String> {
    let parents = parents(document)?;
    let number = document.scene.unwrap_or(0);
    let scene = document.scenes.get(number).ok_or_else(|| match document.scene {
        None => broken("scenes", "there is none"),
        Some(_) => broken("scene", out_of_range(number, document.scenes.len(), "scenes")),
    })?;
    let mut is_root = vec![false; document.nodes.len()];
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
    let mut visited = Vec::new();
    let mut waiting: Vec<(usize, Mat4)> =
        scene.nodes.iter().rev().map(|&root| (root, Mat4::IDENTITY)).collect();
    while let Some((number, parent)) = waiting.pop() {
        let node = &document.nodes[number];
        let transform = transform(node)
            .map_err(|(name, what)| broken(format!("nodes[{number}].{name}"), what))?;
        let transform = parent * transform;
        visited.push((number, transform));
        waiting.extend(node.children.iter().rev().map(|&child| (child, transform)));
    }
    Ok(visited)
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
        // Exporters round quaternions, at the coarsest to signed bytes.
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
