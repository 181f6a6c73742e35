//! Bytes to a validated scene.

use std::collections::{BTreeMap, BTreeSet};

use schemars::{JsonSchema, Schema};
use serde::{Deserialize, Serialize};

use super::SceneError;
use super::culling::{CULLING, Culling};
use super::layers::Visibility;
use super::limits;
use super::material::Material;
use super::name::Name;
use super::number::{Cosine, Span, Version, Whole};
use super::output::{self, OneOf, Output};
use super::probe::Probe;
use super::table::{Layout, TableWant};
use super::value::{List, Maybe, Text, Word, about, distinct, told};
use crate::data::{AlphaMap, Arguments, Container, Decode, Pick, Smith, Vendor};
use lobefit_import::Note;
use lobefit_shade::code::{Float, Language};
use lobefit_strict::{place, read_object};
use lobefit_truth::optics::kernel::Kernel;

/// Domain of mu for fits where the scene gives none.
const DEFAULT_MU: [f64; 2] = [0.01, 1.0];
/// Largest side of a table whose size is left to the bake.
const AUTO_SIDE: usize = 128;

/// The name of a scene that states none.
pub const UNNAMED: &str = "scene";

/// A validated scene: every field in its range, names unique, sizes within the [limits].
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Scene {
    /// Name without control characters; escape it where it is printed.
    pub name: String,
    /// Shadowing form of every material.
    pub smith: Smith,
    /// How roughness becomes alpha, for every material.
    pub alpha: AlphaMap,
    /// What the sheens are shadowed by.
    // Absent at its default, as the formats.
    #[serde(skip_serializing_if = "Visibility::is_default")]
    pub sheen_visibility: Visibility,
    /// Domain of mu for fits, lo < hi in [1e-4, 1].
    pub mu: [f64; 2],
    /// File formats in which every table is written, each once, in the order of [`Container`]; at
    /// least one.
    // Absent at its default: the hash of a scene without it is that of the versions before it.
    #[serde(skip_serializing_if = "exr_alone")]
    pub formats: Vec<Container>,
    /// What is written.
    #[serde(skip_serializing_if = "Output::is_default")]
    pub output: Output,
    /// Materials in the order of the file.
    pub materials: Vec<Material>,
    /// Probes in the order of the file.
    // Absent where there is none: the hash of a scene without it is that of the versions before it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub probes: Vec<Probe>,
    /// Occlusion culling, where the scene calls for it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub culling: Option<Culling>,
    /// The file that it is made of as a command names it, with its options: `room.glb --textures`; none
    /// of a scene in JSON, whose name is its own.
    #[serde(skip)]
    pub made_of: Option<String>,
    /// What that file says that the scene does not hold.
    #[serde(skip)]
    pub notes: Vec<Note>,
}

/// A scene: the materials that a renderer has, and what it wants of them.
#[derive(Deserialize, JsonSchema)]
#[schemars(rename = "Scene")]
#[serde(deny_unknown_fields, expecting = "an object that describes a scene")]
struct SceneFile {
    /// Version of this format: 1.
    #[allow(dead_code, reason = "reading it is the check")]
    schema_version: Whole<Version>,
    /// Name for reports; default `scene`.
    #[serde(default)]
    name: Maybe<Text<Name>>,
    /// Masking-shadowing form; default `correlated`.
    #[serde(default)]
    smith: Maybe<Word<Smith>>,
    /// How roughness becomes GGX alpha; default `roughness^2`.
    #[serde(default)]
    alpha: Maybe<Word<AlphaMap>>,
    /// The visibility of every sheen: `neubelt` (the default), 1/(4 (mu + mu_l - mu mu_l)), which real-time
    /// renderers take, or `estevez-kulla`, with the Lambda that the authors of the lobe fitted.
    #[serde(default)]
    sheen_visibility: Maybe<Word<Visibility>>,
    /// Range [lo, hi] of the cosine of the view angle over which fits are made and certified;
    /// default [0.01, 1]. Tables have their own, `n_dot_v`.
    #[serde(default)]
    mu: Maybe<Span<Cosine, false>>,
    /// File formats in which every table is written; default EXR alone.
    #[serde(default)]
    #[schemars(extend("minItems" = 1, "uniqueItems" = true))]
    formats: Maybe<List<Word<Container>, { Container::ALL.len() }>>,
    /// Which approximations the include files hold: `best` (the default) for each job one, the
    /// cheapest that keeps `max_error`, or the most accurate within `max_ops`; where neither is
    /// given, the cheapest within 0.02. `frontier` those that none beats in both cost and error,
    /// `all` every one. Reports show all that were measured.
    #[serde(default)]
    pick: Maybe<Word<Pick>>,
    /// How emitted functions take the width of the lobe: by `roughness` (the default), by `alpha`,
    /// or by `both`. With `all`, formulas take what they read.
    #[serde(default)]
    arguments: Maybe<Word<Arguments>>,
    /// The GPUs on which the emitted formulas are to be cheap: `neutral` (the default: the operation
    /// model), `amd`, `intel`, `adreno`, `mali` or `nvidia`, by models of these vendors' compiled code.
    /// `max_ops` and the figures of operations stay the neutral ones.
    #[serde(default)]
    cost: Maybe<Word<OneOf<Option<Vendor>>>>,
    /// Languages of the include files; default all.
    #[serde(default)]
    #[schemars(extend("minItems" = 1, "uniqueItems" = true))]
    languages: Maybe<List<Word<OneOf<Language>>, 6>>,
    /// The numbers that emitted formulas of lobes compute with: `f32` (the default), or `f16`, in which
    /// they are then picked and certified. Lookups of tables and of probes stay f32, and so do the
    /// functions in Rust and C.
    #[serde(default)]
    precision: Maybe<Word<OneOf<Float>>>,
    /// Whether pages and their data are written; default true.
    #[serde(default)]
    reports: Maybe<bool>,
    /// The materials.
    materials: List<Material, { limits::MATERIALS }>,
    /// Probes that capture the scene's light; default none.
    #[serde(default)]
    probes: Maybe<List<Probe, { limits::PROBES }>>,
    /// Occlusion culling by depth that is frames old; default none.
    #[serde(default)]
    culling: Maybe<Culling>,
}

fn exr_alone(formats: &[Container]) -> bool {
    formats == [Container::Exr]
}

/// The formats in their order; a list that is empty or names one twice is refused.
fn formats(given: Option<List<Word<Container>, { Container::ALL.len() }>>) -> Result<Vec<Container>, String> {
    let Some(List(words)) = given else { return Ok(vec![Container::default()]) };
    if words.is_empty() {
        return Err("the list is empty; leave the field out for EXR".into());
    }
    distinct(words.into_iter().map(|Word(format)| format), Container::name)
}

/// What is wrong with a field, with its place where the file has it.
fn placed(bytes: &[u8], file: &str, path: &str, message: String) -> SceneError {
    let (file, path) = (file.to_string(), path.to_string());
    match place(bytes, &path) {
        Some(at) => SceneError::Field { file, at, path, message },
        None => SceneError::Whole { file, path, message },
    }
}

/// What a scene must have, with a value that it may have.
const EXAMPLES: [(&str, &str); 5] = [
    ("schema_version", "1"),
    ("materials", "[{ \"name\": \"steel\", \"kind\": \"metal\", \"f0\": 0.57, \"roughness\": [0.1, 1] }]"),
    ("name", "\"steel\""),
    ("kind", "\"metal\""),
    ("roughness", "[0.1, 1]"),
];

/// An unknown field of a part of the scene, with what is said where the scene itself has one of that name;
/// a missing one, with an example.
fn advised(error: SceneError) -> SceneError {
    let SceneError::Field { file, at, path, mut message } = error else { return error };
    if let Some((name, _)) = message.strip_prefix("unknown field `").and_then(|rest| rest.split_once('`')) {
        let alone = serde_json::Map::from_iter([(name.to_string(), serde_json::Value::Null)]);
        let read = serde_json::from_value::<SceneFile>(alone.into());
        if !read.is_err_and(|error| error.to_string().starts_with("unknown field")) {
            message = format!("{message}; the scene itself has a field of that name");
        }
    }
    let missing = message.strip_prefix("missing field `").and_then(|rest| rest.strip_suffix('`'));
    if let Some((name, value)) = EXAMPLES.iter().find(|(name, _)| missing == Some(name)) {
        message = format!("{message}; for example \"{name}\": {value}");
    }
    SceneError::Field { file, at, path, message }
}

impl Scene {
    /// The same without the materials and probes of these fields, as `materials[0]`, and without notes.
    pub fn without(&self, those: &BTreeSet<&str>) -> Scene {
        let stays = |of: &str, i: usize| !those.contains(format!("{of}[{i}]").as_str());
        let materials = self.materials.iter().enumerate().filter(|(i, _)| stays("materials", *i));
        let probes = self.probes.iter().enumerate().filter(|(i, _)| stays("probes", *i));
        Scene {
            name: self.name.clone(),
            formats: self.formats.clone(),
            output: self.output.clone(),
            culling: self.culling.clone(),
            made_of: self.made_of.clone(),
            notes: Vec::new(),
            materials: materials.map(|(_, material)| material.clone()).collect(),
            probes: probes.map(|(_, probe)| probe.clone()).collect(),
            ..*self
        }
    }

    /// Reads a scene that names no file of a kernel; `file` is its name in messages.
    ///
    /// # Errors
    /// What is no scene, with its place and field; a kernel in a file.
    pub fn from_json(bytes: &[u8], file: &str) -> Result<Scene, SceneError> {
        Scene::with_kernels(bytes, file, |path, field| {
            let message = format!("`{path}` cannot be read from here");
            Err(SceneError::Whole { file: file.into(), path: field, message })
        })
    }

    /// Reads a scene; `kernel` reads the table of a path relative to the scene, which the field
    /// names.
    ///
    /// # Errors
    /// As [`Scene::from_json`]; those of `kernel`.
    pub fn with_kernels<E: From<SceneError>>(
        bytes: &[u8],
        file: &str,
        mut kernel: impl FnMut(&str, String) -> Result<Kernel, E>,
    ) -> Result<Scene, E> {
        let mut scene = Scene::parsed(bytes, file)?;
        for (i, probe) in scene.probes.iter_mut().enumerate() {
            if let Some(path) = &probe.kernel_file {
                probe.kernel = kernel(path, format!("probes[{i}].kernel"))?;
            }
        }
        scene.check().map_err(|(path, message)| placed(bytes, file, &path, message))?;
        Ok(scene)
    }

    /// The fields, each right by itself.
    fn parsed(bytes: &[u8], file: &str) -> Result<Scene, SceneError> {
        let parsed: SceneFile = read_object(bytes, file, limits::STRING_BYTES).map_err(advised)?;
        let whole = |field: &str, message: String| {
            let message = about(field, message);
            let (path, message) = told(&message);
            placed(bytes, file, path, message.into())
        };
        let formats = formats(parsed.formats.0).map_err(|message| whole("formats", message))?;
        let languages = output::languages(parsed.languages.0);
        let output = Output {
            pick: parsed.pick.0.map_or_else(Pick::default, |w| w.0),
            arguments: parsed.arguments.0.map_or_else(Arguments::default, |w| w.0),
            languages: languages.map_err(|message| whole("languages", message))?,
            cost: parsed.cost.0.and_then(|w| w.0.0),
            budget: None,
            every_error: None,
            float: parsed.precision.0.map_or_else(Float::default, |w| w.0.0),
            reports: parsed.reports.0.unwrap_or(true),
        };
        let mut scene = Scene {
            name: parsed.name.0.map_or_else(|| UNNAMED.into(), |t| t.0),
            smith: parsed.smith.0.map_or_else(Smith::default, |w| w.0),
            alpha: parsed.alpha.0.map_or_else(AlphaMap::default, |w| w.0),
            sheen_visibility: parsed.sheen_visibility.0.map_or_else(Visibility::default, |w| w.0),
            mu: parsed.mu.0.map_or(DEFAULT_MU, |s| s.0),
            formats,
            output,
            materials: parsed.materials.0,
            probes: parsed.probes.0.map_or_else(Vec::new, |l| l.0),
            culling: parsed.culling.0,
            made_of: None,
            notes: Vec::new(),
        };
        scene.settle_slices();
        Ok(scene)
    }

    /// Pairs of linearly transformed cosines are fitted to one visibility.
    fn check_sheens(&self) -> Result<(), (String, String)> {
        let sheens = self.materials.iter().enumerate().filter_map(|(i, m)| Some((i, m.sheen.as_ref()?)));
        let all = sheens.flat_map(|(i, sheen)| sheen.tables.iter().enumerate().map(move |(j, t)| (i, j, t)));
        let mut pairs = all.filter(|(.., table)| table.layout == Layout::AreaLights);
        match pairs.next().filter(|_| !self.sheen_visibility.is_default()) {
            Some((i, j, _)) => Err((
                format!("materials[{i}].sheen.tables[{j}].layout"),
                "this version fits transformed cosines to sheens of `neubelt`; leave the table or the scene's `sheen_visibility` out".into(),
            )),
            None => Ok(()),
        }
    }

    /// Engines fetch a pair of area lights by the roughness of glTF.
    fn check_engines(&self) -> Result<(), (String, String)> {
        let wanted = self.materials.iter().enumerate().flat_map(|(i, m)| m.tables().map(move |t| (i, t)));
        let mut wanted = wanted.filter(|(_, (.., table))| !table.engines.is_empty());
        match wanted.next().filter(|_| self.alpha != AlphaMap::default()) {
            Some((i, (part, j, _))) => Err((
                format!("materials[{i}].{part}.tables[{j}].engines"),
                format!(
                    "engines read alpha = roughness^2, and the scene has `{}`; leave the field out",
                    self.alpha.name()
                ),
            )),
            None => Ok(()),
        }
    }

    /// The scene that is compiled in, which every verb uses by default.
    pub fn built_in() -> Result<Scene, SceneError> {
        Scene::from_json(include_bytes!("default.json"), "the built-in scene")
    }

    /// Hash of what the scene means: blake3 of its normal form, in which every default is filled
    /// in, so that spelling, layout and order of fields do not matter and values do. The text of
    /// hypothesis files is not part of it.
    pub fn hash(&self) -> Result<String, serde_json::Error> {
        let normal = serde_json::to_vec(self)?;
        Ok(blake3::hash(&normal).to_hex().to_string())
    }

    /// Hypothesis files that the materials name, each once, in order of first mention, with the
    /// field that mentions it.
    pub fn hypotheses(&self) -> Vec<(&str, String)> {
        let mut paths: Vec<(&str, String)> = Vec::new();
        for (i, material) in self.materials.iter().enumerate() {
            for (j, path) in material.wants.fit.iter().flat_map(|fit| &fit.hypotheses).enumerate() {
                if !paths.iter().any(|(known, _)| known == path) {
                    paths.push((path, format!("materials[{i}].wants.fit.hypotheses[{j}]")));
                }
            }
        }
        paths
    }

    /// What only the whole scene shows: field path and message of the first contradiction.
    fn check(&self) -> Result<(), (String, String)> {
        if self.mu[0] >= self.mu[1] {
            return Err(("mu".into(), "the range is a single cosine; fits need a range".into()));
        }
        self.check_names()?;
        self.check_slices()?;
        self.check_sheens()?;
        self.check_engines()?;
        self.check_texels()?;
        self.check_probes()?;
        self.check_hypotheses()
    }

    fn check_names(&self) -> Result<(), (String, String)> {
        let materials: Vec<&str> = self.materials.iter().map(|m| m.name.as_str()).collect();
        let probes: Vec<&str> = self.probes.iter().map(|p| p.name.as_str()).collect();
        // Calls are listed by these names, of all lists together.
        let mut seen: BTreeMap<&str, String> = BTreeMap::new();
        seen.extend(self.culling.as_ref().map(|_| (CULLING, "the scene's `culling`".to_string())));
        for (list, names) in [("materials", materials), ("probes", probes)] {
            for (i, name) in names.into_iter().enumerate() {
                if let Some(first) = seen.insert(name, format!("{list}[{i}]")) {
                    return Err((
                        format!("{list}[{i}].name"),
                        format!("`{name}` is already the name of {first}"),
                    ));
                }
            }
        }
        Ok(())
    }

    /// A chain holds some of the roughness that it is looked up with. Rules of several fetches are
    /// fitted for kernels with a formula, the lobe of a surface for one kernel alone.
    fn check_probes(&self) -> Result<(), (String, String)> {
        self.check_kernels()?;
        for (i, probe) in self.probes.iter().enumerate() {
            if let Some((j, taps)) = probe.unruled() {
                let message = format!(
                    "{taps} fetches: rules of several fetches are fitted for ndf, half and half-cosine chains, and this probe's is of \
                     the kernel `{}`; give 1",
                    probe.kernel.name()
                );
                return Err((format!("probes[{i}].lookups[{j}].taps"), message));
            }
            if let Some([first, last]) = probe.unheld() {
                let [low, high] = probe.roughness;
                let message = format!(
                    "the chain holds roughness {first} to {last}, and the probe is looked up with {low} to {high}: no level could be \
                     measured; give a chain or a `roughness` of which the other holds a part"
                );
                return Err((format!("probes[{i}].mips"), message));
            }
            if let Some(j) = probe.unfitted() {
                let message = format!(
                    "the lobe is fitted for half-cosine chains, and this probe's is of the kernel `{}`; give `mirror`",
                    probe.kernel.name()
                );
                return Err((format!("probes[{i}].lookups[{j}].lobe"), message));
            }
        }
        Ok(())
    }

    /// Functions are named by their kernel's name: two tables of one name would have the same
    /// functions.
    fn check_kernels(&self) -> Result<(), (String, String)> {
        let mut known: BTreeMap<&str, (usize, &Kernel)> = BTreeMap::new();
        for (i, probe) in self.probes.iter().enumerate() {
            let (first, kernel) = *known.entry(probe.kernel.name()).or_insert((i, &probe.kernel));
            if kernel != &probe.kernel {
                let name = kernel.name();
                let message = format!(
                    "the table calls its kernel `{name}`, as another one of probes[{first}] does; rename one"
                );
                return Err((format!("probes[{i}].kernel"), message));
            }
        }
        Ok(())
    }

    /// Holds the texels of all different tables together to the limits, before anything is
    /// allocated.
    fn check_texels(&self) -> Result<(), (String, String)> {
        let mut tables = BTreeSet::new();
        let mut total = (0, 0);
        for (i, material) in self.materials.iter().enumerate() {
            let lobe = material.lobe();
            for (part, j, table) in material.tables() {
                let TableWant { layout, size, format, serves, .. } = table;
                let key = (part, lobe.is_glass(), *layout, size.clone(), format.name(), *serves);
                if tables.insert(key) {
                    let size = size.clone().unwrap_or_else(|| vec![AUTO_SIDE; 2]);
                    let [columns, rest @ ..] = &size[..] else { continue };
                    let size = [*columns, rest.iter().product::<usize>() * lobe.sides()];
                    let field = || format!("materials[{i}].{part}.tables[{j}].size");
                    let texel_bytes = Decode::of(*layout, *serves).channels() as u64 * format.bytes();
                    total = add_table(total, size, texel_bytes, field)?;
                }
            }
        }
        Ok(())
    }

    /// Holds hypotheses to their number. Whether two define one function is seen when they are
    /// read.
    fn check_hypotheses(&self) -> Result<(), (String, String)> {
        let mut count = 0;
        for (i, material) in self.materials.iter().enumerate() {
            let Some(fit) = &material.wants.fit else { continue };
            if count + fit.hypotheses.len() > limits::HYPOTHESES {
                let first_beyond = limits::HYPOTHESES - count;
                let message = format!("more than {} hypotheses in the scene", limits::HYPOTHESES);
                return Err((format!("materials[{i}].wants.fit.hypotheses[{first_beyond}]"), message));
            }
            count += fit.hypotheses.len();
        }
        Ok(())
    }
}

/// The total with one table more, or the field of its size and the message.
fn add_table(
    total: (u64, u64),
    [columns, rows]: [usize; 2],
    texel_bytes: u64,
    field: impl FnOnce() -> String,
) -> Result<(u64, u64), (String, String)> {
    let table = limits::texels(columns, rows, texel_bytes);
    table.and_then(|texels| limits::add_texels(total, texels)).ok_or_else(|| {
        let (cells, bytes) = (limits::CELLS, limits::TEXEL_BYTES);
        (field(), format!("the scene's tables together exceed {cells} texels or {bytes} bytes"))
    })
}

/// The JSON Schema of the scene format.
pub fn schema() -> Schema {
    schemars::schema_for!(SceneFile)
}
