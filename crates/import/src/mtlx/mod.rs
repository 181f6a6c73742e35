//! MaterialX: its surface shaders `open_pbr_surface`, `standard_surface`, `gltf_pbr` and
//! `UsdPreviewSurface`. Inputs are constants, or images over one connection; what is computed by a graph
//! takes the whole range of its input.

mod inputs;
mod models;
mod xml;

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

use lobefit_strict::SceneError;
use roxmltree::Node;

use super::Imported;
use super::limits::MATERIALS;
use super::note::{About, Said};
use super::scene::{Parts, Writer};
use super::texture::Textures;
use inputs::{ByName, Inputs, children};
use models::MODELS;
use xml::wrong;

/// Whether bytes begin as a document of MaterialX does.
pub(crate) fn is_document(bytes: &[u8]) -> bool {
    let start = bytes.trim_ascii_start();
    start.starts_with(b"<?xml") || start.starts_with(b"<materialx")
}

pub(crate) fn read(
    bytes: &[u8],
    file: &str,
    mut textures: Option<&mut Textures>,
) -> Result<Imported, SceneError> {
    let parsed = xml::parse(bytes, file)?;
    let document = Document::of(parsed.root_element(), file)?;
    let mut writer = Writer::default();
    for (index, node) in document.surfaces().into_iter().enumerate() {
        if index == MATERIALS {
            return Err(wrong(node, file, String::new(), format!("more than {MATERIALS} materials")));
        }
        let parts = document.material(node, textures.as_deref_mut())?;
        writer.add(node.attribute("name").unwrap_or_default(), index, parts);
    }
    for child in document.root.children() {
        match child.tag_name().name() {
            "include" => {
                let href = child.attribute("href").unwrap_or_default();
                let text = "it is included, and this version opens no other document: read it by itself";
                writer.note(About::Missing, text.into(), Some(href));
            }
            "material" => {
                let text =
                    "materials of MaterialX before 1.37 are not read: this version reads `surfacematerial`";
                writer.note(About::Missing, text.into(), None);
            }
            _ => {}
        }
    }
    Ok(writer.finish())
}

/// A document, and its named elements by the element that they stand in.
struct Document<'d, 'b, 'f> {
    root: Node<'d, 'b>,
    named: BTreeMap<(u32, &'d str), Node<'d, 'b>>,
    /// The first output of each graph.
    outputs: BTreeMap<u32, Node<'d, 'b>>,
    file: &'f str,
    /// The inputs of the nodes that were asked for: materials may share them.
    inputs: RefCell<BTreeMap<u32, ByName<'d, 'b>>>,
}

impl<'d, 'b, 'f> Document<'d, 'b, 'f> {
    fn of(root: Node<'d, 'b>, file: &'f str) -> Result<Self, SceneError> {
        if root.tag_name().name() != "materialx" {
            let message = format!("`{}` is not a `materialx` document", root.tag_name().name());
            return Err(wrong(root, file, String::new(), message));
        }
        let (mut named, mut outputs) = (BTreeMap::new(), BTreeMap::new());
        let graphs = root.children().filter(|node| node.has_tag_name("nodegraph"));
        for scope in [root].into_iter().chain(graphs) {
            for node in scope.children().filter(Node::is_element) {
                if node.has_tag_name("output") {
                    outputs.entry(scope.id().get()).or_insert(node);
                }
                if let Some(name) = node.attribute("name")
                    && named.insert((scope.id().get(), name), node).is_some()
                {
                    return Err(wrong(node, file, String::new(), format!("`{name}` is there twice")));
                }
            }
        }
        Ok(Document { root, named, outputs, file, inputs: RefCell::default() })
    }

    /// The inputs of a node by name, found once.
    fn inputs(&self, node: Node<'d, 'b>) -> Result<ByName<'d, 'b>, SceneError> {
        let known = self.inputs.borrow().get(&node.id().get()).cloned();
        if let Some(inputs) = known {
            return Ok(inputs);
        }
        let inputs = children(node, self.file)?;
        self.inputs.borrow_mut().insert(node.id().get(), Rc::clone(&inputs));
        Ok(inputs)
    }

    /// The element of a name that stands in another.
    fn find(&self, scope: Node, name: &str, at: Node, path: &str) -> Result<Node<'d, 'b>, SceneError> {
        self.named.get(&(scope.id().get(), name)).copied().ok_or_else(|| {
            wrong(
                at,
                self.file,
                path.into(),
                format!("it is connected to `{name}`, which is not in this file"),
            )
        })
    }

    /// Its materials, or without any its surface shaders.
    fn surfaces(&self) -> Vec<Node<'d, 'b>> {
        let of = |is: &dyn Fn(&str) -> bool| {
            self.root.children().filter(|node| is(node.tag_name().name())).collect::<Vec<_>>()
        };
        let materials = of(&|name| name == "surfacematerial");
        let is_model = |name: &str| MODELS.iter().any(|(model, _)| *model == name);
        if materials.is_empty() { of(&is_model) } else { materials }
    }

    /// The materials of a scene that one of the document calls for.
    fn material(&self, node: Node<'d, 'b>, textures: Option<&mut Textures>) -> Result<Parts, SceneError> {
        let mut said = Said::default();
        let Some(shader) = self.shader(node)? else {
            said.reading("it has no surface shader");
            return Ok(Parts { parts: Vec::new(), said });
        };
        let category = shader.tag_name().name();
        let Some((_, model)) = MODELS.iter().find(|(name, _)| *name == category) else {
            let names = MODELS.map(|(name, _)| name).join(", ");
            said.missing(format!("its shader is `{category}`: this version reads {names}"));
            return Ok(Parts { parts: Vec::new(), said });
        };
        let mut inputs = Inputs::of(self, shader, textures)?;
        let surface = model(&mut inputs)?;
        Ok(surface.parts(inputs.said))
    }

    /// The surface shader of a material.
    fn shader(&self, node: Node<'d, 'b>) -> Result<Option<Node<'d, 'b>>, SceneError> {
        if !node.has_tag_name("surfacematerial") {
            return Ok(Some(node));
        }
        let inputs = self.inputs(node)?;
        let Some(&input) = inputs.get("surfaceshader") else { return Ok(None) };
        let path = format!("{}.surfaceshader", node.attribute("name").unwrap_or_default());
        Ok(self.connected(input, self.root, &path)?.map(|(shader, _, _)| shader))
    }

    /// The node that an input is connected to, the element that it stands in, and the element that names
    /// its output: over the output of a graph where it names one.
    fn connected(
        &self,
        input: Node<'d, 'b>,
        scope: Node<'d, 'b>,
        path: &str,
    ) -> Result<Option<(Node<'d, 'b>, Node<'d, 'b>, Node<'d, 'b>)>, SceneError> {
        let graph = match (input.attribute("nodegraph"), input.attribute("nodename")) {
            (Some(name), _) => self.find(self.root, name, input, path)?,
            (None, Some(name)) => {
                let node = self.find(scope, name, input, path)?;
                if !node.has_tag_name("nodegraph") {
                    return Ok(Some((node, scope, input)));
                }
                node
            }
            (None, None) => return Ok(None),
        };
        let output = match input.attribute("output") {
            Some(name) => Some(self.find(graph, name, input, path)?),
            None => self.outputs.get(&graph.id().get()).copied(),
        };
        let named = output.and_then(|output| Some((output, output.attribute("nodename")?)));
        named.map(|(output, name)| Ok((self.find(graph, name, output, path)?, graph, output))).transpose()
    }
}
