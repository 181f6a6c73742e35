//! The triangles of a glTF 2.0 file, where its nodes put them: of the buffers that the file itself
//! holds, as they are at rest, without skins and morph targets.

use std::ops::Range;

use lobefit_strict::value::{List, Maybe};
use lobefit_strict::{SceneError, read_object};
use serde::Deserialize;

use super::buffers::{Buffer, Buffers, View, at};
use super::nodes::{Node, Scene, Transform, placed};
use super::{Wrong, chunks, version};
use crate::limits::{GLTF_EXTENSIONS, GLTF_LIST, GLTF_NODES, PARTS, TRIANGLES};
use crate::texture::Place;

/// Triangles of a file: metres, y up, as glTF has them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Three corners each.
    pub triangles: Vec<[[f32; 3]; 3]>,
    /// Which of them belong to each primitive of each node that has any.
    pub parts: Vec<Range<usize>>,
}

/// The part of a document that says what its surfaces are.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase", expecting = "a glTF document, an object")]
struct Document {
    asset: super::document::Asset,
    #[serde(default)]
    extensions_required: Maybe<List<String, GLTF_EXTENSIONS>>,
    #[serde(default)]
    scene: Maybe<usize>,
    #[serde(default)]
    scenes: Maybe<List<Scene, GLTF_NODES>>,
    #[serde(default)]
    nodes: Maybe<List<Node, GLTF_NODES>>,
    #[serde(default)]
    meshes: Maybe<List<Surface, GLTF_LIST>>,
    #[serde(default)]
    accessors: Maybe<List<Accessor, GLTF_LIST>>,
    #[serde(default)]
    buffer_views: Maybe<List<View, GLTF_LIST>>,
    #[serde(default)]
    buffers: Maybe<List<Buffer, GLTF_LIST>>,
}

#[derive(Deserialize)]
#[serde(expecting = "an object that describes a mesh")]
struct Surface {
    primitives: List<Primitive, PARTS>,
}

#[derive(Deserialize)]
#[serde(expecting = "an object that describes a primitive")]
struct Primitive {
    attributes: Attributes,
    #[serde(default)]
    indices: Maybe<usize>,
    #[serde(default)]
    mode: Maybe<u64>,
}

#[derive(Deserialize)]
#[serde(expecting = "an object of attributes")]
struct Attributes {
    #[serde(default, rename = "POSITION")]
    position: Maybe<usize>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", expecting = "an object that describes an accessor")]
struct Accessor {
    #[serde(default)]
    buffer_view: Maybe<usize>,
    #[serde(default)]
    byte_offset: u64,
    component_type: u64,
    count: u64,
    #[serde(rename = "type")]
    kind: String,
    #[serde(default)]
    sparse: Maybe<serde::de::IgnoredAny>,
}

/// How the names of extensions begin that leave triangles and their places as they are.
const HARMLESS: [&str; 3] = ["KHR_materials_", "KHR_texture_", "KHR_lights_punctual"];

/// Types of numbers of an accessor, with the bytes of each.
const BYTE: (u64, u64) = (5121, 1);
const SHORT: (u64, u64) = (5123, 2);
const INT: (u64, u64) = (5125, 4);
const FLOAT: (u64, u64) = (5126, 4);

/// Kinds of primitives, by `mode`: every three corners, a strip, a fan. Less than these are points
/// and lines.
const EACH: u64 = 4;
const STRIP: u64 = 5;
const FAN: u64 = 6;

/// Largest coordinate of a corner, metres: beyond it floats are 6 cm apart.
const FARTHEST: f64 = 1e6;

/// The triangles of a file.
///
/// # Errors
/// What is no such file, with its field; one without triangles, or with too many.
pub fn mesh(bytes: &[u8], file: &str) -> Result<Mesh, SceneError> {
    let whole = |(path, message)| SceneError::Whole { file: file.into(), path, message };
    let (json, chunk) = chunks(bytes, file).map_err(|message| whole((String::new(), message)))?;
    let document: Document = read_object(json, file, usize::MAX)?;
    version(&document.asset.version).map_err(whole)?;
    let mut reader =
        Reader { bytes, document: &document, buffers: Buffers::new(chunk), mesh: Mesh::default() };
    reader.all().map_err(whole)?;
    Ok(reader.mesh)
}

/// A file on the way to its triangles.
struct Reader<'a> {
    bytes: &'a [u8],
    document: &'a Document,
    buffers: Buffers,
    mesh: Mesh,
}

/// The elements of an accessor: bytes from the first on, and bytes from each to the next.
struct Elements {
    place: Place,
    first: u64,
    stride: u64,
    count: u64,
    /// Bytes of a number.
    width: u64,
}

impl Reader<'_> {
    fn all(&mut self) -> Result<(), Wrong> {
        let document = self.document;
        let required = document.extensions_required.0.iter().flat_map(|list| &list.0);
        let is_harmless = |name: &str| HARMLESS.iter().any(|known| name.starts_with(known));
        if let Some(name) = required.into_iter().find(|name| !is_harmless(name)) {
            let message = format!("`{name}` is not read; export the mesh without it");
            return Err(("extensionsRequired".into(), message));
        }
        let nodes = document.nodes.0.as_ref().map_or(&[][..], |list| &list.0);
        let scenes = document.scenes.0.as_ref().map_or(&[][..], |list| &list.0);
        let mut parts = 0;
        for (i, transform) in placed(nodes, scenes, document.scene.0)? {
            let Some(mesh) = nodes[i].mesh.0 else { continue };
            let field = format!("nodes[{i}].mesh");
            let surface = at(&document.meshes, mesh, &field, "mesh")?;
            parts += surface.primitives.0.len();
            if parts > PARTS {
                return Err((field, format!("more than {PARTS} primitives are drawn")));
            }
            for (k, primitive) in surface.primitives.0.iter().enumerate() {
                self.primitive(primitive, &transform, &format!("meshes[{mesh}].primitives[{k}]"))?;
            }
        }
        if self.mesh.triangles.is_empty() {
            return Err((String::new(), "no node of its scene has a triangle".into()));
        }
        Ok(())
    }

    /// Adds the triangles of a primitive.
    fn primitive(&mut self, primitive: &Primitive, to: &Transform, path: &str) -> Result<(), Wrong> {
        let mode = primitive.mode.0.unwrap_or(EACH);
        if mode < EACH {
            return Ok(());
        }
        let Some(position) = primitive.attributes.position.0 else {
            return Err((format!("{path}.attributes"), "it has no POSITION".into()));
        };
        let field = format!("{path}.attributes.POSITION");
        let positions = self.elements(position, &field, ("VEC3", 3, &[FLOAT]))?;
        let indices = match primitive.indices.0 {
            Some(indices) => {
                let field = format!("{path}.indices");
                Some((indices, self.elements(indices, &field, ("SCALAR", 1, &[BYTE, SHORT, INT]))?))
            }
            None => None,
        };
        let count = indices.as_ref().map_or(positions.count, |(_, indices)| indices.count);
        let triangles = match mode {
            EACH if count % 3 != 0 => {
                return Err((path.into(), format!("{count} corners make no whole number of triangles")));
            }
            EACH => count / 3,
            STRIP | FAN => count.saturating_sub(2),
            _ => {
                return Err((
                    format!("{path}.mode"),
                    format!("{mode} is none of glTF's kinds of primitives"),
                ));
            }
        };
        let first = self.mesh.triangles.len();
        if triangles > (TRIANGLES - first) as u64 {
            return Err((path.into(), format!("more than {TRIANGLES} triangles are drawn")));
        }
        for i in 0..triangles {
            let corners = match mode {
                EACH => [3 * i, 3 * i + 1, 3 * i + 2],
                FAN => [0, i + 1, i + 2],
                _ => [i, i + 1, i + 2],
            };
            let mut triangle = [[0.0; 3]; 3];
            for (out, corner) in triangle.iter_mut().zip(corners) {
                let index = match &indices {
                    None => corner,
                    Some((accessor, indices)) => self.index(indices, (*accessor, corner), positions.count)?,
                };
                *out = self.position(&positions, (position, index), to)?;
            }
            self.mesh.triangles.push(triangle);
        }
        if triangles > 0 {
            self.mesh.parts.push(first..self.mesh.triangles.len());
        }
        Ok(())
    }

    /// The elements of an accessor that a field names: of a kind of so many numbers, each of one of
    /// these types.
    fn elements(
        &mut self,
        index: usize,
        field: &str,
        (kind, numbers, types): (&str, u64, &[(u64, u64)]),
    ) -> Result<Elements, Wrong> {
        let document = self.document;
        let accessor = at(&document.accessors, index, field, "accessor")?;
        let wrong = |part: &str, message: String| Err((format!("accessors[{index}]{part}"), message));
        if accessor.kind != kind {
            return wrong(".type", format!("`{}` where {kind} is called for", accessor.kind));
        }
        let Some((_, width)) = types.iter().find(|(code, _)| *code == accessor.component_type) else {
            let codes: Vec<String> = types.iter().map(|(code, _)| code.to_string()).collect();
            let message = format!("{} where {} is called for", accessor.component_type, codes.join(" or "));
            return wrong(".componentType", message);
        };
        if accessor.sparse.0.is_some() {
            return wrong(".sparse", "sparse accessors are not read; export the mesh without them".into());
        }
        let Some(view) = accessor.buffer_view.0 else {
            return wrong("", "it has no `bufferView`: its elements are not in the file".into());
        };
        let size = numbers * width;
        let lists = (&document.buffer_views, &document.buffers);
        let stride = at(&document.buffer_views, view, &format!("accessors[{index}].bufferView"), "view")?;
        let stride = stride.byte_stride.0.unwrap_or(size);
        if !(size..=252).contains(&stride) {
            let message = format!("{stride} is outside [{size}, 252]");
            return Err((format!("bufferViews[{view}].byteStride"), message));
        }
        let place = self.buffers.place(lists, view)?;
        let length = match &place {
            Place::Own([first, length]) => {
                if first.checked_add(*length).is_none_or(|end| end > self.bytes.len() as u64) {
                    let message = "the file ends before the end of its buffer".into();
                    return Err((format!("bufferViews[{view}]"), message));
                }
                *length
            }
            Place::Buffer(_, [from, to]) => (to - from) as u64,
            Place::Beside(..) | Place::Inline(_) => {
                let message = "its buffer is a file of its own; export as .glb, or with buffers embedded";
                return Err((format!("bufferViews[{view}].buffer"), message.into()));
            }
        };
        let last = accessor.count.checked_sub(1).and_then(|n| n.checked_mul(stride));
        let end = last.and_then(|last| last.checked_add(size)?.checked_add(accessor.byte_offset));
        if end.is_none_or(|end| end > length) {
            let message =
                format!("{} elements of {size} bytes, and its view has {length} bytes", accessor.count);
            return wrong(".count", message);
        }
        Ok(Elements { place, first: accessor.byte_offset, stride, count: accessor.count, width: *width })
    }

    /// `N` bytes of an element, from byte `at` of it on. They are in the file: [`Reader::elements`].
    fn part<const N: usize>(&self, of: &Elements, element: u64, at: u64) -> [u8; N] {
        let within = (of.first + element * of.stride + at) as usize;
        let bytes = match &of.place {
            Place::Own([first, _]) => &self.bytes[*first as usize..],
            Place::Buffer(buffer, range) => self.buffers.decoded(*buffer, *range),
            Place::Beside(..) | Place::Inline(_) => &[],
        };
        std::array::from_fn(|k| bytes[within + k])
    }

    /// An index of an accessor, below `count`.
    fn index(&self, of: &Elements, (accessor, corner): (usize, u64), count: u64) -> Result<u64, Wrong> {
        let index = match of.width {
            1 => self.part::<1>(of, corner, 0)[0].into(),
            2 => u16::from_le_bytes(self.part(of, corner, 0)).into(),
            _ => u64::from(u32::from_le_bytes(self.part(of, corner, 0))),
        };
        if index >= count {
            let message = format!("element {corner} is {index}, and there are {count} positions");
            return Err((format!("accessors[{accessor}]"), message));
        }
        Ok(index)
    }

    /// A position where a node puts it.
    fn position(
        &self,
        of: &Elements,
        (accessor, i): (usize, u64),
        to: &Transform,
    ) -> Result<[f32; 3], Wrong> {
        let own = [0, 1, 2].map(|k| f64::from(f32::from_le_bytes(self.part(of, i, 4 * k))));
        if !own.iter().all(|x| x.is_finite()) {
            return Err((format!("accessors[{accessor}]"), format!("element {i} is {own:?}: not finite")));
        }
        let placed = to.applied(own);
        // Written so that what is not a number is refused.
        if !placed.iter().all(|x| x.abs() <= FARTHEST) {
            let message = format!("element {i} lies at {placed:?}, beyond {FARTHEST} m from the origin");
            return Err((format!("accessors[{accessor}]"), message));
        }
        Ok(placed.map(|x| x as f32))
    }
}
