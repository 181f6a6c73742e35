//! Where the images of a glTF file are: in the file, in another's buffer, or in files beside it.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use lobefit_strict::value::{List, Maybe};
use lobefit_strict::{SceneError, read_object};
use serde::Deserialize;

use crate::limits::GLTF_LIST;
use crate::texture::{Outcome, Place, Textures, relative};

/// The part of a document that says where its images are.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase", default, expecting = "a glTF document, an object")]
#[derive(Default)]
struct Storage {
    textures: Maybe<List<Texture, GLTF_LIST>>,
    images: Maybe<List<Image, GLTF_LIST>>,
    buffer_views: Maybe<List<View, GLTF_LIST>>,
    buffers: Maybe<List<Buffer, GLTF_LIST>>,
}

#[derive(Default, Deserialize)]
#[serde(default, expecting = "an object that describes a texture")]
struct Texture {
    source: Maybe<usize>,
    extensions: Extensions,
}

#[derive(Default, Deserialize)]
#[serde(default, expecting = "an object of extensions")]
struct Extensions {
    #[serde(rename = "EXT_texture_webp")]
    webp: Maybe<Source>,
    #[serde(rename = "KHR_texture_basisu")]
    basis: Maybe<Source>,
}

#[derive(Deserialize)]
#[serde(expecting = "an object with the `source` of a texture")]
struct Source {
    source: usize,
}

#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase", default, expecting = "an object that describes an image")]
struct Image {
    uri: Maybe<String>,
    buffer_view: Maybe<usize>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", expecting = "an object that describes a view of a buffer")]
struct View {
    buffer: usize,
    #[serde(default)]
    byte_offset: u64,
    byte_length: u64,
}

#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase", default, expecting = "an object that describes a buffer")]
struct Buffer {
    uri: Maybe<String>,
}

/// What is wrong with a field: its path, and the message.
pub(super) type Wrong = (String, String);

/// The images of a document.
pub(super) struct Images<'a, 't> {
    storage: Storage,
    textures: &'a mut Textures<'t>,
    buffers: Buffers,
}

/// Where the buffers of a document are.
struct Buffers {
    /// First byte of the chunk behind the JSON of a binary file, and its length.
    chunk: Option<[u64; 2]>,
    /// The bytes of those in the text that were asked for, by their number.
    decoded: BTreeMap<usize, Vec<u8>>,
}

impl<'a, 't> Images<'a, 't> {
    /// The images of a document; `chunk` is where a binary file has its buffer.
    ///
    /// # Errors
    /// Fields that are none of glTF's.
    pub fn of(
        json: &[u8],
        file: &str,
        textures: &'a mut Textures<'t>,
        chunk: Option<[u64; 2]>,
    ) -> Result<Images<'a, 't>, SceneError> {
        let buffers = Buffers { chunk, decoded: BTreeMap::new() };
        Ok(Images { storage: read_object(json, file, usize::MAX)?, textures, buffers })
    }

    /// The extremes of a texture's channels, or why they are not known.
    ///
    /// # Errors
    /// A texture that is not there, an image that cannot be read.
    pub fn texture(&mut self, index: usize) -> Result<&Outcome, Wrong> {
        let texture = at(&self.storage.textures, index, "textures", "texture")?;
        // Of two sources the one that every reader knows.
        let others = [&texture.extensions.webp, &texture.extensions.basis];
        let mut others = others.iter().filter_map(|other| other.0.as_ref().map(|other| other.source));
        let source = texture.source.0.or_else(|| others.next());
        let source =
            source.ok_or_else(|| (format!("textures[{index}]"), "it has no `source`".to_string()))?;
        let image = at(&self.storage.images, source, "images", "image")?;
        let path = format!("images[{source}]");
        let place = match (&image.uri.0, image.buffer_view.0) {
            (Some(uri), _) if is_data(uri) => Place::Inline(source),
            (Some(uri), _) => {
                Place::Beside(relative(uri).map_err(|message| (format!("{path}.uri"), message))?, None)
            }
            (None, Some(view)) => self.buffers.place(&self.storage, view)?,
            (None, None) => return Err((path, "it has neither `uri` nor `bufferView`".into())),
        };
        let inline = || match place {
            Place::Buffer(buffer, [from, to]) => Ok(self.buffers.decoded[&buffer][from..to].to_vec()),
            _ => data(image.uri.0.as_deref().unwrap_or_default()),
        };
        self.textures.image(&place, inline).map_err(|message| (path, message))
    }

    /// The share of texels that is left out at each end.
    pub fn quantile(&self) -> f64 {
        self.textures.quantile()
    }
}

impl Buffers {
    /// Where the bytes of a view are; a buffer in the text is decoded the first time.
    fn place(&mut self, storage: &Storage, index: usize) -> Result<Place, Wrong> {
        let view = at(&storage.buffer_views, index, "bufferViews", "view")?;
        let path = format!("bufferViews[{index}]");
        let beyond = || (path.clone(), "it reaches beyond its buffer".to_string());
        let end = view.byte_offset.checked_add(view.byte_length).ok_or_else(beyond)?;
        let buffer = at(&storage.buffers, view.buffer, "buffers", "buffer")?;
        let wrong = |field: &str, message: String| (format!("buffers[{}]{field}", view.buffer), message);
        match (&buffer.uri.0, self.chunk) {
            (None, Some([first, length])) if view.buffer == 0 => {
                let within = end <= length;
                within.then_some(Place::Own([first + view.byte_offset, view.byte_length])).ok_or_else(beyond)
            }
            (None, _) => Err(wrong("", "it has no `uri`".into())),
            (Some(uri), _) if is_data(uri) => {
                let bytes = match self.decoded.entry(view.buffer) {
                    Entry::Occupied(known) => known.into_mut(),
                    Entry::Vacant(free) => free.insert(data(uri).map_err(|m| wrong(".uri", m))?),
                };
                let range = usize::try_from(view.byte_offset).ok().zip(usize::try_from(end).ok());
                let range = range.filter(|(_, to)| *to <= bytes.len());
                range.map(|(from, to)| Place::Buffer(view.buffer, [from, to])).ok_or_else(beyond)
            }
            (Some(uri), _) => {
                let name = relative(uri).map_err(|m| wrong(".uri", m))?;
                Ok(Place::Beside(name, Some([view.byte_offset, view.byte_length])))
            }
        }
    }
}

/// An entry of a list of the document.
fn at<'l, T, const MAX: usize>(
    list: &'l Maybe<List<T, MAX>>,
    index: usize,
    field: &str,
    one: &str,
) -> Result<&'l T, Wrong> {
    let list = list.0.as_ref().map_or(&[][..], |list| &list.0);
    let none = || (field.to_string(), format!("{one} {index} is none of the file's {}", list.len()));
    list.get(index).ok_or_else(none)
}

/// Whether a URI holds its bytes itself.
fn is_data(uri: &str) -> bool {
    uri.starts_with("data:")
}

/// The bytes that a `data:` URI holds.
fn data(uri: &str) -> Result<Vec<u8>, String> {
    let (_, text) = uri.split_once(";base64,").ok_or("its `data:` is not in base64")?;
    STANDARD.decode(text).map_err(|e| format!("its base64 is broken: {e}"))
}
