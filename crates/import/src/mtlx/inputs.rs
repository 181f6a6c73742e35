//! The inputs of a surface shader: constants, images and graphs, as ranges.

use std::collections::BTreeMap;
use std::rc::Rc;

use lobefit_math::srgb;
use lobefit_strict::SceneError;
use lobefit_strict::number::{Interval, inside};
use roxmltree::Node;

use super::Document;
use super::xml::wrong;
use crate::note::Said;
use crate::texture::{Outcome, Place, Textures, relative};

/// Most inputs of a node: more than twice those of any model. Materials may share a shader, and each looks
/// at all its inputs.
const INPUTS: usize = 128;

/// Most bytes of a value. Materials may share it, and each reads it.
const DIGITS: usize = 4096;

/// Ranges of red, green, blue and alpha.
type Ranges = [[f64; 2]; 4];

/// What the file of an image holds, the channel that is asked for first, or why that is not known; none
/// where images are not read.
type Texels = Option<Outcome>;

/// What an input holds.
enum Value {
    Constant(Vec<f64>),
    Image(Ranges, Texels),
    /// Computed by nodes, of which this is the last.
    Graph,
}

/// A surface shader, and what is said of its material.
pub(super) struct Inputs<'i, 'd, 'b, 'f, 't> {
    document: &'i Document<'d, 'b, 'f>,
    shader: Node<'d, 'b>,
    inputs: ByName<'d, 'b>,
    textures: Option<&'i mut Textures<'t>>,
    pub said: Said,
}

/// The inputs of a node by name.
pub(super) type ByName<'d, 'b> = Rc<BTreeMap<&'d str, Node<'d, 'b>>>;

/// Finds the inputs among all children of a node.
pub(super) fn children<'d, 'b>(node: Node<'d, 'b>, file: &str) -> Result<ByName<'d, 'b>, SceneError> {
    let mut inputs = BTreeMap::new();
    for input in node.children().filter(|child| child.has_tag_name("input")) {
        let name = input.attribute("name").unwrap_or_default();
        if inputs.insert(name, input).is_some() {
            return Err(wrong(input, file, String::new(), format!("the input `{name}` is there twice")));
        }
        if inputs.len() > INPUTS {
            return Err(wrong(input, file, String::new(), format!("more than {INPUTS} inputs")));
        }
    }
    Ok(Rc::new(inputs))
}

/// Whether the value of an input comes from elsewhere, whatever else stands there.
fn is_connected(input: Node) -> bool {
    ["nodename", "interfacename", "nodegraph", "output"].iter().any(|key| input.has_attribute(*key))
}

impl<'i, 'd, 'b, 'f, 't> Inputs<'i, 'd, 'b, 'f, 't> {
    pub fn of(
        document: &'i Document<'d, 'b, 'f>,
        shader: Node<'d, 'b>,
        textures: Option<&'i mut Textures<'t>>,
    ) -> Result<Self, SceneError> {
        let inputs = document.inputs(shader)?;
        Ok(Inputs { document, shader, inputs, textures, said: Said::default() })
    }

    /// The version of the model that the shader asks for.
    pub fn version(&self) -> Option<&'d str> {
        self.shader.attribute("version")
    }

    /// The range of a number in an interval. Of a graph it is the interval, or up to `most` where that has
    /// no end.
    pub fn number<I: Interval>(
        &mut self,
        name: &str,
        default: f64,
        most: f64,
    ) -> Result<[f64; 2], SceneError> {
        let Some(value) = self.value(name)? else { return Ok([default; 2]) };
        let whole = [I::MIN, I::MAX.min(most)];
        match value {
            Value::Constant(values) => match values[..] {
                [x] => {
                    inside::<I>(x, x).map_err(|message| self.wrong(name, message))?;
                    Ok([x; 2])
                }
                _ => Err(self.wrong(name, count(&values, "1 is"))),
            },
            Value::Image(ranges, texels) if ranges[0][1] > I::MIN || I::MIN <= 0.0 => {
                let range = ranges[0].map(|x| x.clamp(whole[0], whole[1]));
                self.texels(name, &texels, 0, range);
                Ok(range)
            }
            // No texel is an index of refraction: what scales them is not known.
            Value::Image(..) => {
                let text = format!(
                    "`{name}` has an image that is {} at most: it takes [{}, {}]",
                    I::MIN,
                    whole[0],
                    whole[1]
                );
                self.said.missing(text);
                Ok(whole)
            }
            Value::Graph => {
                self.graph(name, &format!("[{}, {}]", whole[0], whole[1]));
                Ok(whole)
            }
        }
    }

    /// The largest values of a colour, linear, in [0, 1].
    pub fn colour(&mut self, name: &str, default: [f64; 3]) -> Result<[f64; 3], SceneError> {
        let Some(value) = self.value(name)? else { return Ok(default) };
        match value {
            Value::Constant(values) => {
                let [r, g, b] = values[..] else {
                    return Err(self.wrong(name, count(&values, "3 are")));
                };
                for x in [r, g, b] {
                    inside::<lobefit_strict::number::Unit>(x, x)
                        .map_err(|message| self.wrong(name, message))?;
                }
                let space = self.inputs.get(name).and_then(|input| space(*input));
                Ok(self.linear(space, [r, g, b]))
            }
            Value::Image(ranges, texels) => Ok([0, 1, 2].map(|k| {
                let range = ranges[k].map(|x| x.clamp(0.0, 1.0));
                self.texels(&format!("{} of `{name}`", ["red", "green", "blue"][k]), &texels, k, range);
                range[1]
            })),
            Value::Graph => {
                self.graph(name, "any colour");
                Ok([1.0; 3])
            }
        }
    }

    /// Whether a switch is on somewhere.
    pub fn is_on(&mut self, name: &str) -> Result<bool, SceneError> {
        match self.value(name)? {
            Some(Value::Constant(values)) => Ok(values.iter().any(|x| *x != 0.0)),
            Some(Value::Image(..) | Value::Graph) => {
                self.graph(name, "true");
                Ok(true)
            }
            None => Ok(false),
        }
    }

    fn graph(&mut self, name: &str, range: &str) {
        self.said.missing(format!(
            "`{name}` is computed by a graph, which this version does not evaluate: it takes {range}"
        ));
    }

    /// The number of an input that is one constant.
    pub fn one_constant(&mut self, name: &str) -> Result<Option<f64>, SceneError> {
        Ok(match self.value(name)? {
            Some(Value::Constant(values)) if values.len() == 1 => Some(values[0]),
            _ => None,
        })
    }

    fn value(&mut self, name: &str) -> Result<Option<Value>, SceneError> {
        let Some(&input) = self.inputs.get(name) else { return Ok(None) };
        let path = self.path(name);
        let scope = self.shader.parent_element().unwrap_or(self.document.root);
        let Some((node, graph, output)) = self.document.connected(input, scope, &path)? else {
            let connected = is_connected(input);
            let written = input.attribute("value").filter(|_| !connected);
            let constant =
                written.map(|text| numbers(text).map_err(|m| wrong(input, self.document.file, path, m)));
            return constant.transpose().map(|found| match (found, connected) {
                (_, true) => Some(Value::Graph),
                (found, false) => found.map(Value::Constant),
            });
        };
        let channel = output.attribute("output").unwrap_or_default();
        let own = self.document.inputs(node)?;
        match node.tag_name().name() {
            // Which channel of an image: one connection further.
            "separate2" | "separate3" | "separate4" => {
                let Some(&inner) = own.get("in") else { return Ok(Some(Value::Graph)) };
                match self.document.connected(inner, graph, &path)? {
                    Some((image, graph, _)) => self.node(name, image, graph, channel).map(Some),
                    None => Ok(Some(Value::Graph)),
                }
            }
            _ => self.node(name, node, graph, channel).map(Some),
        }
    }

    /// What a node gives that an input is connected to: a constant or an image.
    fn node(
        &mut self,
        name: &str,
        node: Node<'d, 'b>,
        graph: Node<'d, 'b>,
        channel: &str,
    ) -> Result<Value, SceneError> {
        let own = self.document.inputs(node)?;
        let found = match node.tag_name().name() {
            "constant" => self.constant(&own, "value", &self.path(name))?.map(Value::Constant),
            "image" | "tiledimage" | "gltf_image" | "gltf_colorimage" | "UsdUVTexture" => {
                let scopes = [node, graph, self.document.root];
                self.image(name, &own, scopes, channel)?
            }
            _ => None,
        };
        Ok(found.unwrap_or(Value::Graph))
    }

    /// The numbers of an input that is not connected; none of one that is.
    fn constant(
        &self,
        own: &BTreeMap<&str, Node>,
        name: &str,
        path: &str,
    ) -> Result<Option<Vec<f64>>, SceneError> {
        let own_value = own.get(name).filter(|input| !is_connected(**input));
        let Some(text) = own_value.and_then(|input| input.attribute("value")) else { return Ok(None) };
        numbers(text).map(Some).map_err(|message| wrong(own[name], self.document.file, path.into(), message))
    }

    /// The ranges of an image, its first channel the one that `output` names.
    fn image(
        &mut self,
        name: &str,
        own: &BTreeMap<&'d str, Node<'d, 'b>>,
        scopes: [Node<'d, 'b>; 3],
        output: &str,
    ) -> Result<Option<Value>, SceneError> {
        let path = self.path(name);
        let is_named = |file: &&Node| file.has_attribute("value") && !is_connected(**file);
        let Some(&file) = own.get("file").filter(is_named) else { return Ok(None) };
        let channel = match output {
            "g" | "outg" | "outy" => 1,
            "b" | "outb" | "outz" => 2,
            "a" | "outa" | "outw" => 3,
            _ => 0,
        };
        let mut texels = self.read(name, file, scopes)?;
        let mut ranges = match &texels {
            Some(Ok(channels)) => channels.map(|extremes| extremes.kept),
            Some(Err(_)) | None => [[0.0, 1.0]; 4],
        };
        let space = space(file);
        if space == Some("srgb_texture") {
            for range in &mut ranges[..3] {
                *range = range.map(srgb::decoded);
            }
        }
        for (factor, is_sum) in [("factor", false), ("scale", false), ("color", false), ("bias", true)] {
            let Some(values) = self.constant(own, factor, &path)? else {
                if own.contains_key(factor) {
                    return Ok(None);
                }
                continue;
            };
            let neutral = if is_sum { 0.0 } else { 1.0 };
            let of = |k: usize| match values[..] {
                [all] => all,
                _ => values.get(k).copied().unwrap_or(neutral),
            };
            for (k, range) in ranges.iter_mut().enumerate() {
                let ends = range.map(|x| if is_sum { x + of(k) } else { x * of(k) });
                *range = [ends[0].min(ends[1]), ends[0].max(ends[1])];
            }
        }
        if own.get("default").is_some_and(|default| is_connected(*default)) {
            return Ok(None);
        }
        self.beyond_edges(own, &path, &mut ranges)?;
        ranges[0] = ranges[channel];
        if let Some(Ok(channels)) = &mut texels {
            channels[0] = channels[channel];
        }
        Ok(Some(Value::Image(ranges, texels)))
    }

    /// Beyond the edges of an image that does not repeat stands its default.
    fn beyond_edges(
        &self,
        own: &BTreeMap<&str, Node>,
        path: &str,
        ranges: &mut Ranges,
    ) -> Result<(), SceneError> {
        let ends = |key: &&str| {
            let mode = own.get(*key).and_then(|input| input.attribute("value"));
            mode.is_some_and(|mode| matches!(mode, "constant" | "black"))
        };
        if !["uaddressmode", "vaddressmode", "wrapS", "wrapT"].iter().any(ends) {
            return Ok(());
        }
        let default = self.constant(own, "default", path)?.unwrap_or_default();
        for (k, [low, high]) in ranges.iter_mut().enumerate() {
            let there = default.get(k).copied().unwrap_or(0.0);
            (*low, *high) = (low.min(there), high.max(there));
        }
        Ok(())
    }

    /// The values of the file of an image.
    fn read(&mut self, name: &str, file: Node, scopes: [Node; 3]) -> Result<Texels, SceneError> {
        let Some(textures) = self.textures.as_deref_mut() else { return Ok(None) };
        let refused = |message| wrong(file, self.document.file, path(self.shader, name), message);
        let prefix = scopes.iter().find_map(|scope| scope.attribute("fileprefix")).unwrap_or_default();
        let uri = format!("{prefix}{}", file.attribute("value").unwrap_or_default());
        let place = Place::Beside(relative(&uri).map_err(refused)?, None);
        textures.image(&place, || Ok(Vec::new())).map_err(refused).cloned().map(Some)
    }

    /// Says what is not known of a channel, or what the quantile leaves out of it.
    fn texels(&mut self, what: &str, texels: &Texels, channel: usize, range: [f64; 2]) {
        let quantile = self.textures.as_ref().map_or(0.0, |textures| textures.quantile());
        match texels {
            Some(Ok(channels)) => {
                let same = |texel: f64| texel;
                let is_roughness = ["roughness", "specular_roughness"].contains(&what);
                let roughness = is_roughness.then_some(&same as &dyn Fn(f64) -> f64);
                self.said.beyond(what, &channels[channel], quantile, roughness);
            }
            Some(Err(why)) => self.said.unknown(what, why, range),
            None => {}
        }
    }

    /// A colour of a space in linear values.
    fn linear(&mut self, space: Option<&str>, colour: [f64; 3]) -> [f64; 3] {
        match space {
            Some("srgb_texture") => colour.map(srgb::decoded),
            None | Some("" | "none" | "raw" | "lin_rec709" | "linear") => colour,
            Some(other) => {
                self.said
                    .missing(format!("colours in `{other}`: this version takes their values as they are"));
                colour
            }
        }
    }

    fn path(&self, name: &str) -> String {
        path(self.shader, name)
    }

    fn wrong(&self, name: &str, message: String) -> SceneError {
        let at = self.inputs.get(name).copied().unwrap_or(self.shader);
        wrong(at, self.document.file, self.path(name), message)
    }
}

fn path(shader: Node, name: &str) -> String {
    format!("{}.{name}", shader.attribute("name").unwrap_or_default())
}

/// The colour space of an input: its own, or of the nearest element around it.
fn space<'d>(input: Node<'d, '_>) -> Option<&'d str> {
    input.ancestors().find_map(|node| node.attribute("colorspace"))
}

fn count(values: &[f64], called_for: &str) -> String {
    let numbers = if values.len() == 1 { "number" } else { "numbers" };
    format!("{} {numbers} where {called_for} called for", values.len())
}

/// The numbers of a value.
fn numbers(text: &str) -> Result<Vec<f64>, String> {
    let one = |word: &str| match word.trim() {
        "true" => Ok(1.0),
        "false" => Ok(0.0),
        word => match word.parse::<f64>() {
            Ok(x) if x.is_finite() => Ok(x + 0.0),
            _ => Err(format!("`{word}` is no finite number")),
        },
    };
    if text.len() > DIGITS {
        return Err(format!("more than {DIGITS} bytes of numbers"));
    }
    if text.split(',').count() > 4 {
        return Err("more than 4 numbers".into());
    }
    text.split(',').map(one).collect()
}
