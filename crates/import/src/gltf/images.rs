//! Where the images of a glTF file are: in the file, in another's buffer, or in files beside it.

use lobefit_strict::value::{List, Maybe};
use lobefit_strict::{SceneError, read_object};
use serde::Deserialize;

use super::Wrong;
use super::buffers::{Buffer, Buffers, View, at, data, is_data};
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

/// The images of a document.
pub(super) struct Images<'a, 't> {
    storage: Storage,
    textures: &'a mut Textures<'t>,
    buffers: Buffers,
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
        let buffers = Buffers::new(chunk);
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
            (None, Some(view)) => {
                self.buffers.place((&self.storage.buffer_views, &self.storage.buffers), view)?
            }
            (None, None) => return Err((path, "it has neither `uri` nor `bufferView`".into())),
        };
        let inline = || match place {
            Place::Buffer(buffer, range) => Ok(self.buffers.decoded(buffer, range).to_vec()),
            _ => data(image.uri.0.as_deref().unwrap_or_default()),
        };
        self.textures.image(&place, inline).map_err(|message| (path, message))
    }

    /// The share of texels that is left out at each end.
    pub fn quantile(&self) -> f64 {
        self.textures.quantile()
    }
}
