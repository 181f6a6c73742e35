//! Where the images of a glTF file are: in the file, in another's buffer, or in files beside it.

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
    /// First byte of the chunk behind the JSON of a binary file, and its length.
    chunk: Option<[u64; 2]>,
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
        Ok(Images { storage: read_object(json, file, usize::MAX)?, textures, chunk })
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
        let mut inline = Ok(Vec::new());
        let place = match (&image.uri.0, image.buffer_view.0) {
            (Some(uri), _) => match data(uri) {
                Some(bytes) => {
                    inline = bytes;
                    Place::Inline(source)
                }
                None => {
                    Place::Beside(relative(uri).map_err(|message| (format!("{path}.uri"), message))?, None)
                }
            },
            (None, Some(view)) => self.place(view, source, &mut inline)?,
            (None, None) => return Err((path, "it has neither `uri` nor `bufferView`".into())),
        };
        self.textures.image(&place, || inline).map_err(|message| (path, message))
    }

    /// Where the bytes of a view are.
    fn place(
        &self,
        index: usize,
        image: usize,
        inline: &mut Result<Vec<u8>, String>,
    ) -> Result<Place, Wrong> {
        let view = at(&self.storage.buffer_views, index, "bufferViews", "view")?;
        let path = format!("bufferViews[{index}]");
        let beyond = || (path.clone(), "it reaches beyond its buffer".to_string());
        let end = view.byte_offset.checked_add(view.byte_length).ok_or_else(beyond)?;
        let buffer = at(&self.storage.buffers, view.buffer, "buffers", "buffer")?;
        match (&buffer.uri.0, self.chunk) {
            (None, Some([first, length])) if view.buffer == 0 => {
                let within = end <= length;
                within.then_some(Place::Own([first + view.byte_offset, view.byte_length])).ok_or_else(beyond)
            }
            (None, _) => Err((format!("buffers[{}]", view.buffer), "it has no `uri`".into())),
            (Some(uri), _) => match data(uri) {
                Some(Ok(bytes)) => {
                    let range = usize::try_from(view.byte_offset).ok().zip(usize::try_from(end).ok());
                    let part = range.and_then(|(from, to)| bytes.get(from..to)).ok_or_else(beyond)?;
                    *inline = Ok(part.to_vec());
                    Ok(Place::Inline(image))
                }
                Some(Err(message)) => Err((format!("buffers[{}].uri", view.buffer), message)),
                None => {
                    let name = relative(uri).map_err(|m| (format!("buffers[{}].uri", view.buffer), m))?;
                    Ok(Place::Beside(name, Some([view.byte_offset, view.byte_length])))
                }
            },
        }
    }

    /// The share of texels that is left out at each end.
    pub fn quantile(&self) -> f64 {
        self.textures.quantile()
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

/// The bytes that a `data:` URI holds.
fn data(uri: &str) -> Option<Result<Vec<u8>, String>> {
    let (_, text) = uri.strip_prefix("data:")?.split_once(";base64,")?;
    Some(STANDARD.decode(text).map_err(|e| format!("its base64 is broken: {e}")))
}
