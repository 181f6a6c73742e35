//! glTF 2.0. A factor beside a texture bounds the texture's values: where images are not read its range
//! is from 0 to the factor. What is drawn counts: the materials of primitives and of their variants, or
//! all where the file has no mesh.

mod buffers;
mod document;
mod images;
pub(crate) mod material;
pub(crate) mod mesh;
mod nodes;

use std::collections::BTreeSet;

use lobefit_strict::limits::FILE_BYTES;
use lobefit_strict::{SceneError, read_object};

use super::Imported;
use super::note::About;
use super::scene::Writer;
use super::texture::Textures;
use document::{AnyVersion, Document, KNOWN, Material, Versioned};
use images::Images;
use material::parts;

/// What is wrong with a field: its path, and the message.
type Wrong = (String, String);

/// What a binary file begins with.
pub(crate) const MAGIC: &[u8] = b"glTF";

/// Bytes before the JSON of a binary file: a header of 12 and that of the chunk.
const HEAD: u64 = 20;

/// Most bytes of a file that are read: of a binary one the JSON stands before all buffers, and behind it
/// the head of their chunk.
pub(crate) const BYTES: u64 = FILE_BYTES + HEAD + CHUNK_HEAD;

/// Bytes before the buffer of a binary file.
const CHUNK_HEAD: u64 = 8;

pub(crate) fn read(
    bytes: &[u8],
    file: &str,
    textures: Option<&mut Textures>,
) -> Result<Imported, SceneError> {
    let whole =
        |path: &str, message: String| SceneError::Whole { file: file.into(), path: path.into(), message };
    let (json, chunk) = chunks(bytes, file).map_err(|message| whole("", message))?;
    let document: Document = read_object(json, file, usize::MAX).map_err(|error| {
        let stated = serde_json::from_slice(json).ok().map(|Versioned { asset }| match asset.version {
            AnyVersion::Text(text) => text,
            AnyVersion::Number(number) => number.to_string(),
        });
        let other =
            stated.filter(|stated| !stated.starts_with('2')).and_then(|stated| version(&stated).err());
        other.map_or(error, |(path, message)| whole(&path, message))
    })?;
    version(&document.asset.version).map_err(|(path, message)| whole(&path, message))?;
    let mut images = match textures {
        Some(textures) => Some(Images::of(json, file, textures, chunk)?),
        None => None,
    };
    let materials = document.materials.0.as_ref().map_or(&[][..], |list| &list.0);
    let drawn = drawn(&document, materials.len()).map_err(|(path, message)| whole(&path, message))?;
    let mut writer = Writer::default();
    for (i, material) in materials.iter().enumerate().filter(|(i, _)| drawn.of.contains(i)) {
        let found = parts(material, images.as_mut());
        let found = found.map_err(|(path, message)| whole(&path, format!("{message} (materials[{i}])")))?;
        writer.add(material.name.0.as_deref().unwrap_or_default(), i, found);
    }
    if drawn.has_default {
        let found = parts(&Material::default(), None).map_err(|(path, message)| whole(&path, message))?;
        writer.add("glTF default", materials.len(), found);
    }
    if materials.len() > drawn.of.len() {
        let more = materials.len() - drawn.of.len();
        let (materials, are) = if more == 1 { ("material", "is") } else { ("materials", "are") };
        writer.note(About::Reading, format!("{more} {materials} that no primitive has {are} left out"), None);
    }
    let used = document.extensions_used.0.map_or_else(Vec::new, |list| list.0);
    if used.iter().any(|name| name == ANIMATION) {
        let text = format!(
            "this version does not read `{ANIMATION}`: factors that it changes are planned as they are at rest"
        );
        writer.note(About::Missing, text, None);
    }
    for extension in
        used.iter().filter(|name| name.contains("_materials_") && !KNOWN.contains(&name.as_str()))
    {
        let text = format!("this version does not read `{extension}`: its materials are planned without it");
        writer.note(About::Missing, text, None);
    }
    Ok(writer.finish())
}

/// What changes factors of materials over time.
const ANIMATION: &str = "KHR_animation_pointer";

/// Refuses another version than 2.
fn version(stated: &str) -> Result<(), Wrong> {
    let is_known = stated.starts_with("2.");
    let message = || format!("`{stated}` is not a version of glTF 2");
    is_known.then_some(()).ok_or_else(|| ("asset.version".into(), message()))
}

/// The JSON of a file, all of it or the first chunk of a binary one; of a binary one the first byte of
/// its buffer and the length.
fn chunks<'b>(bytes: &'b [u8], file: &str) -> Result<(&'b [u8], Option<[u64; 2]>), String> {
    if !bytes.starts_with(MAGIC) {
        // JSON under this name is read as what it is.
        let is_text = bytes.trim_ascii_start().first().is_none_or(|first| *first == b'{');
        if file.to_ascii_lowercase().ends_with(".glb") && !is_text {
            return Err("not a binary glTF: it does not begin with `glTF`".into());
        }
        return Ok((bytes, None));
    }
    let word = |at: u64| {
        let at = usize::try_from(at).ok()?;
        bytes.get(at..at + 4)?.try_into().ok().map(u32::from_le_bytes)
    };
    let number = |at| word(at).ok_or("the file ends in its header");
    let (version, length) = (number(4)?, u64::from(number(12)?));
    if version != 2 {
        return Err(format!("a binary glTF of version {version}; this program reads version 2"));
    }
    if number(16)? != u32::from_le_bytes(*b"JSON") {
        return Err("the first chunk is not JSON".into());
    }
    if length > FILE_BYTES {
        return Err(format!("its JSON is larger than {FILE_BYTES} bytes"));
    }
    let end = HEAD + length;
    let json = bytes.get(HEAD as usize..end as usize);
    let json = json.ok_or_else(|| format!("its JSON should be {length} bytes, and the file ends before"))?;
    let is_buffer = word(end + 4) == Some(u32::from_le_bytes(*b"BIN\0"));
    let buffer = word(end).filter(|_| is_buffer).map(|length| [end + CHUNK_HEAD, length.into()]);
    Ok((json, buffer))
}

/// The materials that are drawn.
struct Drawn {
    of: BTreeSet<usize>,
    /// Whether a primitive has none, and so the default one.
    has_default: bool,
}

/// Which materials are drawn; the place of an index that no material has, and the message.
fn drawn(document: &Document, count: usize) -> Result<Drawn, Wrong> {
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
