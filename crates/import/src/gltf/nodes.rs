//! The nodes of a glTF file: which of them a scene draws, and where.

use lobefit_strict::value::{List, Maybe};
use serde::Deserialize;

use super::Wrong;
use crate::limits::GLTF_NODES;

#[derive(Deserialize)]
#[serde(expecting = "an object that describes a scene")]
pub(super) struct Scene {
    #[serde(default)]
    nodes: Maybe<List<usize, GLTF_NODES>>,
}

#[derive(Deserialize)]
#[serde(expecting = "an object that describes a node")]
pub(super) struct Node {
    /// Its mesh.
    #[serde(default)]
    pub mesh: Maybe<usize>,
    #[serde(default)]
    children: Maybe<List<usize, GLTF_NODES>>,
    #[serde(default)]
    matrix: Maybe<[f64; 16]>,
    #[serde(default)]
    translation: Maybe<[f64; 3]>,
    #[serde(default)]
    rotation: Maybe<[f64; 4]>,
    #[serde(default)]
    scale: Maybe<[f64; 3]>,
}

/// An affine map: what it makes of the three axes, and of the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Transform([[f64; 3]; 4]);

impl Transform {
    const IDENTITY: Transform =
        Transform([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 0.0]]);

    /// Of a displacement.
    fn turned(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        let [a, b, c, _] = self.0;
        [0, 1, 2].map(|k| a[k] * x + b[k] * y + c[k] * z)
    }

    /// Of a place.
    pub fn applied(&self, place: [f64; 3]) -> [f64; 3] {
        let turned = self.turned(place);
        [0, 1, 2].map(|k| turned[k] + self.0[3][k])
    }

    /// Another one, and then this one.
    fn after(&self, inner: &Transform) -> Transform {
        let [a, b, c, origin] = inner.0;
        Transform([self.turned(a), self.turned(b), self.turned(c), self.applied(origin)])
    }
}

impl Node {
    /// From its own coordinates to those of its parent.
    fn transform(&self) -> Result<Transform, Wrong> {
        if let Some(m) = self.matrix.0 {
            if self.translation.0.is_some() || self.rotation.0.is_some() || self.scale.0.is_some() {
                return Err((".matrix".into(), "it stands beside translation, rotation or scale".into()));
            }
            if [m[3], m[7], m[11], m[15]] != [0.0, 0.0, 0.0, 1.0] {
                return Err((".matrix".into(), "its last row is not 0, 0, 0, 1".into()));
            }
            return Ok(Transform([0, 4, 8, 12].map(|i| [m[i], m[i + 1], m[i + 2]])));
        }
        let [x, y, z, w] = self.rotation.0.unwrap_or([0.0, 0.0, 0.0, 1.0]);
        let length = x * x + y * y + z * z + w * w;
        if !(0.99..1.01).contains(&length) {
            return Err((".rotation".into(), "it is no quaternion of unit length".into()));
        }
        // The columns of the rotation of a quaternion, which need not be of unit length to the last digit.
        let s = 2.0 / length;
        let columns = [
            [1.0 - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y)],
            [s * (x * y - w * z), 1.0 - s * (x * x + z * z), s * (y * z + w * x)],
            [s * (x * z + w * y), s * (y * z - w * x), 1.0 - s * (x * x + y * y)],
        ];
        let scale = self.scale.0.unwrap_or([1.0; 3]);
        let [a, b, c] = [0, 1, 2].map(|k| columns[k].map(|x| x * scale[k]));
        Ok(Transform([a, b, c, self.translation.0.unwrap_or_default()]))
    }
}

/// The nodes that a scene draws, each with its transform: those of the scene of a file, or of the
/// first, or where there is none all.
pub(super) fn placed(
    nodes: &[Node],
    scenes: &[Scene],
    chosen: Option<usize>,
) -> Result<Vec<(usize, Transform)>, Wrong> {
    let parents = parents(nodes)?;
    let mut drawn = vec![scenes.is_empty(); nodes.len()];
    if let Some(index) = chosen.or((!scenes.is_empty()).then_some(0)) {
        let scene = scenes.get(index);
        let message = || format!("scene {index} is none of the file's {}", scenes.len());
        let scene = scene.ok_or_else(|| ("scene".to_string(), message()))?;
        for (k, &root) in scene.nodes.0.iter().flat_map(|list| &list.0).enumerate() {
            let wrong = |message: String| (format!("scenes[{index}].nodes[{k}]"), message);
            match parents.get(root) {
                None => return Err(wrong(format!("node {root} is none of the file's {}", nodes.len()))),
                Some(Some(parent)) => return Err(wrong(format!("node {root} is a child of node {parent}"))),
                Some(None) => drawn[root] = true,
            }
        }
    }
    let mut found = Vec::new();
    let mut seen = vec![false; nodes.len()];
    // Parents come before their children.
    let roots = (0..nodes.len()).rev().filter(|i| parents[*i].is_none());
    let mut open: Vec<(usize, Transform, bool)> =
        roots.map(|root| (root, Transform::IDENTITY, drawn[root])).collect();
    while let Some((i, outer, is_drawn)) = open.pop() {
        seen[i] = true;
        let own = nodes[i].transform();
        let own = own.map_err(|(field, message)| (format!("nodes[{i}]{field}"), message))?;
        let transform = outer.after(&own);
        let children = nodes[i].children.0.iter().flat_map(|list| &list.0).rev();
        open.extend(children.map(|child| (*child, transform, is_drawn)));
        if is_drawn {
            found.push((i, transform));
        }
    }
    match seen.iter().position(|seen| !seen) {
        Some(i) => Err((format!("nodes[{i}]"), "it is among its own ancestors".into())),
        None => Ok(found),
    }
}

/// The parent of each node.
fn parents(nodes: &[Node]) -> Result<Vec<Option<usize>>, Wrong> {
    let mut parents = vec![None; nodes.len()];
    for (i, node) in nodes.iter().enumerate() {
        for (k, &child) in node.children.0.iter().flat_map(|list| &list.0).enumerate() {
            let wrong = |message: String| (format!("nodes[{i}].children[{k}]"), message);
            let none = || wrong(format!("node {child} is none of the file's {}", nodes.len()));
            let parent: &mut Option<usize> = parents.get_mut(child).ok_or_else(none)?;
            if let Some(other) = parent.replace(i) {
                return Err(wrong(format!("node {child} is a child of node {other} too")));
            }
        }
    }
    Ok(parents)
}
