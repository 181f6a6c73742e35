//! A glTF 2.0 file as a scene of ours: the JSON that one would write by hand, and what its materials say
//! that it does not hold.
//!
//! A factor beside a texture bounds the texture's values: its range is from 0 to the factor. What is drawn
//! counts: the materials of primitives and of their variants, or all where the file has no mesh.

mod document;
mod material;

use std::collections::{BTreeMap, BTreeSet};

use serde::Serialize;
use serde_json::json;

use super::error::SceneError;
use super::file::read_object;
use super::limits;
use document::{Document, KNOWN};
use material::{Part, parts};

/// What a file says that the scene does not hold, and the names of the materials that say it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Note {
    /// A sentence.
    pub text: String,
    /// Names as the scene has them; none where it is said of the file.
    pub of: Vec<String>,
}

/// A scene that a glTF file was read as.
#[derive(Clone, Debug, PartialEq)]
pub struct FromGltf {
    /// Its JSON.
    pub json: String,
    /// What that leaves out.
    pub notes: Vec<Note>,
}

/// What a binary glTF file begins with.
const MAGIC: &[u8] = b"glTF";

/// Bytes before the JSON of a binary glTF file: a header of 12 and that of the chunk.
const HEAD: usize = 20;

/// Most bytes of a file that are read: of a binary one the JSON stands before all buffers.
pub const BYTES: u64 = limits::FILE_BYTES + HEAD as u64;

/// Names that a message lists.
const NAMED: usize = 3;

/// Longest name of a material, in characters.
const NAME: usize = 64;

/// Whether bytes or a file's name are glTF's.
pub fn is_gltf(bytes: &[u8], file: &str) -> bool {
    let lower = file.to_ascii_lowercase();
    bytes.starts_with(MAGIC) || lower.ends_with(".gltf") || lower.ends_with(".glb")
}

/// The scene of a glTF file, `.gltf` or `.glb`, of which at least the first [`BYTES`] are given.
///
/// # Errors
/// What is no glTF 2.0, with file, place and field.
pub fn from_gltf(bytes: &[u8], file: &str) -> Result<FromGltf, SceneError> {
    let whole =
        |path: &str, message: String| SceneError::Whole { file: file.into(), path: path.into(), message };
    let json = json_of(bytes).map_err(|message| whole("", message))?;
    let document: Document = read_object(json, file, usize::MAX)?;
    if !document.asset.version.starts_with("2.") {
        let message = format!("`{}` is not a version of glTF 2", document.asset.version);
        return Err(whole("asset.version", message));
    }
    let materials = document.materials.0.as_ref().map_or(&[][..], |list| &list.0);
    let drawn = drawn(&document, materials.len()).map_err(|(path, message)| whole(&path, message))?;
    let mut names = BTreeMap::new();
    let (mut scene, mut notes) = (Vec::new(), Vec::new());
    let default = document::Material::default();
    let own = materials.iter().enumerate().filter(|(i, _)| drawn.of.contains(i));
    let own = own.map(|(i, material)| (name(material.name.0.as_deref(), i), material));
    let unnamed = drawn.has_default.then(|| ("glTF default".to_string(), &default));
    for (name, material) in own.chain(unnamed) {
        let found = parts(material);
        let alone = found.parts.len() == 1;
        let name = free(&name, &mut names);
        for Part { kind, fields } in found.parts {
            let name = if alone { name.clone() } else { free(&format!("{name} ({kind})"), &mut names) };
            let all = [("name", json!(name)), ("kind", json!(kind))].into_iter().chain(fields);
            let all: Vec<String> = all.map(|(key, value)| format!("\"{key}\": {value}")).collect();
            scene.push(format!("    {{ {} }}", all.join(", ")));
        }
        for text in found.notes {
            add(&mut notes, text, Some(&name));
        }
    }
    if materials.len() > drawn.of.len() {
        let more = materials.len() - drawn.of.len();
        let (materials, are) = if more == 1 { ("material", "is") } else { ("materials", "are") };
        add(&mut notes, format!("{more} {materials} that no primitive has {are} left out"), None);
    }
    let used = document.extensions_used.0.map_or_else(Vec::new, |list| list.0);
    for extension in
        used.iter().filter(|name| name.contains("_materials_") && !KNOWN.contains(&name.as_str()))
    {
        let text = format!("this version does not read `{extension}`: its materials are planned without it");
        add(&mut notes, text, None);
    }
    let scene = if scene.is_empty() { String::new() } else { format!("\n{}\n  ", scene.join(",\n")) };
    Ok(FromGltf { json: format!("{{\n  \"schema_version\": 1,\n  \"materials\": [{scene}]\n}}\n"), notes })
}

impl std::fmt::Display for Note {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        let named = self.of.iter().take(NAMED).cloned().collect::<Vec<_>>().join(", ");
        match self.of.len() {
            0 => f.write_str(&self.text),
            n if n > NAMED => write!(f, "{named} and {} more: {}", n - NAMED, self.text),
            _ => write!(f, "{named}: {}", self.text),
        }
    }
}

/// The JSON of a file: all of it, or the first chunk of a binary one.
fn json_of(bytes: &[u8]) -> Result<&[u8], String> {
    if !bytes.starts_with(MAGIC) {
        return Ok(bytes);
    }
    let number = |at: usize| {
        let word = bytes.get(at..at + 4).and_then(|word| word.try_into().ok());
        word.map(u32::from_le_bytes).ok_or("the file ends in its header")
    };
    let (version, length) = (number(4)?, u64::from(number(12)?));
    if version != 2 {
        return Err(format!("a binary glTF of version {version}; this program reads version 2"));
    }
    if number(16)? != u32::from_le_bytes(*b"JSON") {
        return Err("the first chunk is not JSON".into());
    }
    if length > limits::FILE_BYTES {
        return Err(format!("its JSON is larger than {} bytes", limits::FILE_BYTES));
    }
    let end = HEAD + length as usize;
    bytes.get(HEAD..end).ok_or_else(|| format!("its JSON should be {length} bytes, and the file ends before"))
}

/// The materials that are drawn.
struct Drawn {
    of: BTreeSet<usize>,
    /// Whether a primitive has none, and so the default one.
    has_default: bool,
}

/// Which materials are drawn; the place of an index that no material has, and the message.
fn drawn(document: &Document, count: usize) -> Result<Drawn, (String, String)> {
    let meshes = document.meshes.0.as_ref().map_or(&[][..], |list| &list.0);
    if meshes.is_empty() {
        return Ok(Drawn { of: (0..count).collect(), has_default: false });
    }
    let mut drawn = Drawn { of: BTreeSet::new(), has_default: false };
    for (i, mesh) in meshes.iter().enumerate() {
        drawn.has_default |= mesh.primitives.has_bare;
        if let Some(index) = mesh.primitives.materials.iter().find(|index| **index >= count) {
            let message = format!("material {index} is none of the file's {count} materials");
            return Err((format!("meshes[{i}].primitives"), message));
        }
        drawn.of.extend(&mesh.primitives.materials);
    }
    Ok(drawn)
}

/// What a scene may call a material: its name without control characters, or by its number.
fn name(given: Option<&str>, index: usize) -> String {
    let given = given.unwrap_or_default().trim();
    let text: String = given.chars().filter(|c| !c.is_control()).take(NAME).collect();
    if text.trim().is_empty() { format!("material {index}") } else { text }
}

/// A name that no other material has, which is then taken; of each name the last number that was tried.
fn free(name: &str, names: &mut BTreeMap<String, usize>) -> String {
    let mut tried = names.get(name).copied().unwrap_or_default();
    let mut free = name.to_string();
    while names.contains_key(&free) {
        tried += 1;
        free = format!("{name} {}", tried + 1);
    }
    names.insert(name.to_string(), tried);
    names.entry(free.clone()).or_default();
    free
}

/// Adds a note, or a name to the one of its text.
fn add(notes: &mut Vec<Note>, text: String, of: Option<&str>) {
    let of = of.map(String::from);
    match notes.iter_mut().find(|note| note.text == text) {
        Some(note) => note.of.extend(of),
        None => notes.push(Note { text, of: of.into_iter().collect() }),
    }
}
