//! Occlusion culling by depth that arrives late: what the lookups of sub-voxels are emitted for,
//! and what `lobefit report --study occlusion` simulates.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize};
use serde_json::{Value, json};

use super::number::{BufferSide, GridSide, Latency, Numbers, Seed, Whole};
use super::value::{List, Maybe, Text, TextRule, Word, about, distinct, from_file};
use super::{limits, name};

/// Quarter resolution of 1280 x 720.
const BUFFER: [u32; 2] = [320, 180];
/// Voxels of half a metre over a block of houses.
const GRID: [u32; 3] = [256, 256, 128];
/// Frames between a depth buffer and its arrival.
const LATENCY: u32 = 5;

/// Culling as a scene calls for it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Culling {
    /// What is looked at.
    pub world: World,
    /// Seed of the world, in [0, 2^32).
    pub seed: u32,
    /// How the camera moves.
    pub path: CameraPath,
    /// Width and height of the occlusion buffer, a quarter of the frame's.
    pub buffer: [u32; 2],
    /// Frames that depth is old, in [1, 8].
    pub latency: u32,
    /// Voxels along x, y and z, powers of two.
    pub grid: [u32; 3],
    /// What the buffer is made by, each once, in the order of [`Pass`].
    pub passes: Vec<Pass>,
}

/// What is looked at.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(untagged)]
pub enum World {
    /// A procedural one.
    Generated(Generator),
    /// The triangles of a glTF file, by its path relative to the scene.
    Mesh(String),
}

/// A procedural world.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Generator {
    /// Blocks of houses with arches, fences and poles.
    Town,
    /// Trunks, crowns and fences.
    Forest,
}

impl Generator {
    const ALL: [(&str, Generator); 2] = [("town", Generator::Town), ("forest", Generator::Forest)];
}

/// What a string has to be.
struct WorldText;

impl TextRule for WorldText {
    const EXPECTED: &'static str = "town, forest, or the relative path of a .glb or .gltf file, in quotes";

    fn check(text: &str) -> Result<(), String> {
        let lower = text.to_ascii_lowercase();
        match [".glb", ".gltf"].into_iter().find(|extension| lower.ends_with(extension)) {
            _ if Generator::ALL.iter().any(|(word, _)| *word == text) => Ok(()),
            Some(extension) => name::relative(text, &text[text.len() - extension.len()..]),
            None => Err(format!(
                "`{text}` is neither town nor forest, and no path of a .glb or .gltf file with a mesh"
            )),
        }
    }
}

impl<'de> Deserialize<'de> for World {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = Text::<WorldText>::deserialize(deserializer)?.0;
        let known = Generator::ALL.into_iter().find(|(word, _)| *word == text);
        Ok(known.map_or(World::Mesh(text), |(_, generator)| World::Generated(generator)))
    }
}

/// What [`WorldText`] takes for the path of a mesh: parts that are neither empty nor `.` nor `..`.
const MESH: &str = r"^((\.{0,2}[^./\\:][^/\\:]*|\.{3,}[^/\\:]*)/)*[^/\\:]+\.([gG][lL][bB]|[gG][lL][tT][fF])$";

impl JsonSchema for World {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "World".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let words = Generator::ALL.map(|(word, _)| word);
        json_schema!({ "anyOf": [
            { "type": "string", "enum": words },
            { "type": "string", "pattern": MESH, "maxLength": limits::STRING_BYTES },
        ] })
    }
}

/// A camera's path.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum CameraPath {
    /// A fast look around from one place, forth and back.
    #[default]
    Turn,
    /// Sideways along a street.
    Strafe,
    /// Ahead along a street, with a slow turn.
    Walk,
}

/// The field, and who calls its functions.
pub const CULLING: &str = "culling";

/// A pass of the reconstruction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Pass {
    /// Old depth as points, forward into the buffer.
    Reproject,
    /// The same of old depth of twice the resolution.
    ReprojectHalf,
    /// A median of what is around, where small holes are left.
    Median,
    /// Splats of accumulated voxels, where nothing is yet.
    Voxels,
    /// The farthest of what is around, where still nothing is.
    Dilation,
}

impl Pass {
    /// What there is where the scene does not say: the passes of the method.
    const DEFAULT: [Pass; 4] = [Pass::Reproject, Pass::Median, Pass::Voxels, Pass::Dilation];

    fn name(self) -> &'static str {
        match self {
            Pass::Reproject => "reproject",
            Pass::ReprojectHalf => "reproject-half",
            Pass::Median => "median",
            Pass::Voxels => "voxels",
            Pass::Dilation => "dilation",
        }
    }
}

/// Occlusion culling by depth that is frames old. It calls for the lookups of sub-voxels, where
/// voxels are among the passes; its other fields are for `lobefit report --study occlusion`.
#[derive(Default, Deserialize, JsonSchema)]
#[schemars(rename = "Culling")]
#[serde(deny_unknown_fields, default, expecting = "an object that describes culling, which may be empty")]
struct CullingFile {
    /// What is looked at: `town` (the default), `forest`, or the triangles of a glTF file by its path
    /// relative to the scene, which the study alone reads.
    world: Maybe<World>,
    /// Seed of a world that is generated; default 1.
    seed: Maybe<Whole<Seed>>,
    /// How the camera moves: `turn` (the default), `strafe` or `walk`.
    path: Maybe<Word<CameraPath>>,
    /// Width and height of the occlusion buffer; default [320, 180], a quarter of 1280 x 720.
    buffer: Maybe<Numbers<Whole<BufferSide>, 2, false>>,
    /// Frames that depth is old; default 5.
    latency: Maybe<Whole<Latency>>,
    /// Voxels along x, y and z, powers of two; default [256, 256, 128].
    #[schemars(extend("items" = sides()))]
    grid: Maybe<Numbers<Whole<GridSide>, 3, false>>,
    /// What the buffer is made by: `reproject`, or `reproject-half` of depth of twice the
    /// resolution; `median`, `voxels`, `dilation`; default all but `reproject-half`.
    #[schemars(extend("minItems" = 1, "uniqueItems" = true, "contains" = writers(), "not" = both()))]
    passes: Maybe<List<Word<Pass>, 5>>,
}

/// Passes that write depth where nothing is, one of which there has to be.
const WRITERS: [Pass; 3] = [Pass::Reproject, Pass::ReprojectHalf, Pass::Voxels];

fn writers() -> Value {
    json!({ "enum": WRITERS })
}

/// Voxels along a side of a grid.
fn sides() -> Value {
    let all: Vec<u32> = (1..10).map(|n| 1 << n).collect();
    json!({ "enum": all })
}

/// Both ways to reproject, which stand for one another.
fn both() -> Value {
    let each = [Pass::Reproject, Pass::ReprojectHalf];
    let contains: Vec<Value> = each.iter().map(|pass| json!({ "contains": { "const": pass } })).collect();
    json!({ "allOf": contains })
}

impl TryFrom<CullingFile> for Culling {
    type Error = String;

    fn try_from(file: CullingFile) -> Result<Self, String> {
        let grid = file.grid.0.map_or(GRID, |n| n.0.map(|n| n.0));
        let voxels: u64 = grid.iter().map(|n| u64::from(*n)).product();
        if let Some(axis) = grid.iter().position(|n| !n.is_power_of_two()) {
            return Err(about(format!("grid[{axis}]"), format!("{} is no power of two", grid[axis])));
        }
        if voxels > limits::VOXELS {
            return Err(about("grid", format!("{voxels} voxels are more than {}", limits::VOXELS)));
        }
        Ok(Culling {
            world: file.world.0.unwrap_or(World::Generated(Generator::Town)),
            seed: file.seed.0.map_or(1, |n| n.0),
            path: file.path.0.map_or_else(CameraPath::default, |w| w.0),
            buffer: file.buffer.0.map_or(BUFFER, |n| n.0.map(|n| n.0)),
            latency: file.latency.0.map_or(LATENCY, |n| n.0),
            grid,
            passes: passes(file.passes.0).map_err(|message| about("passes", message))?,
        })
    }
}

/// The passes in their order; a list that is empty, names one twice or makes nothing is refused.
fn passes(given: Option<List<Word<Pass>, 5>>) -> Result<Vec<Pass>, String> {
    let Some(List(words)) = given else { return Ok(Pass::DEFAULT.to_vec()) };
    let passes = distinct(words.into_iter().map(|Word(pass)| pass), Pass::name)?;
    let has = |pass: Pass| passes.contains(&pass);
    match () {
        () if has(Pass::Reproject) && has(Pass::ReprojectHalf) => {
            Err("`reproject` and `reproject-half` stand for one another; give one of them".into())
        }
        () if !WRITERS.into_iter().any(has) => {
            Err("no pass writes depth: give `reproject`, `reproject-half` or `voxels`".into())
        }
        () => Ok(passes),
    }
}

from_file!(Culling, CullingFile);
