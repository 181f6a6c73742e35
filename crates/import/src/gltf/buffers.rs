//! Where the bytes of a glTF file's buffers are.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use lobefit_strict::value::{List, Maybe};
use serde::Deserialize;

use super::Wrong;
use crate::limits::GLTF_LIST;
use crate::texture::{Place, relative};

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", expecting = "an object that describes a view of a buffer")]
pub(super) struct View {
    buffer: usize,
    #[serde(default)]
    byte_offset: u64,
    byte_length: u64,
    /// Bytes from an element of an accessor to the next one; none: they are packed.
    #[serde(default)]
    pub byte_stride: Maybe<u64>,
}

#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase", default, expecting = "an object that describes a buffer")]
pub(super) struct Buffer {
    uri: Maybe<String>,
}

/// Views and buffers of a document.
pub(super) type Lists<'l> = (&'l Maybe<List<View, GLTF_LIST>>, &'l Maybe<List<Buffer, GLTF_LIST>>);

/// Where the buffers of a document are.
pub(super) struct Buffers {
    /// First byte of the chunk behind the JSON of a binary file, and its length.
    chunk: Option<[u64; 2]>,
    /// The bytes of those in the text that were asked for, by their number.
    decoded: BTreeMap<usize, Vec<u8>>,
}

impl Buffers {
    /// Of a file; `chunk` is where a binary one has its buffer.
    pub fn new(chunk: Option<[u64; 2]>) -> Buffers {
        Buffers { chunk, decoded: BTreeMap::new() }
    }

    /// The bytes of a [`Place::Buffer`].
    pub fn decoded(&self, buffer: usize, [from, to]: [usize; 2]) -> &[u8] {
        &self.decoded[&buffer][from..to]
    }

    /// Where the bytes of a view are; a buffer in the text is decoded the first time.
    pub fn place(&mut self, (views, buffers): Lists, index: usize) -> Result<Place, Wrong> {
        let view = at(views, index, "bufferViews", "view")?;
        let path = format!("bufferViews[{index}]");
        let beyond = || (path.clone(), "it reaches beyond its buffer".to_string());
        let end = view.byte_offset.checked_add(view.byte_length).ok_or_else(beyond)?;
        let buffer = at(buffers, view.buffer, "buffers", "buffer")?;
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
pub(super) fn at<'l, T, const MAX: usize>(
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
pub(super) fn is_data(uri: &str) -> bool {
    uri.starts_with("data:")
}

/// The bytes that a `data:` URI holds.
pub(super) fn data(uri: &str) -> Result<Vec<u8>, String> {
    let (_, text) = uri.split_once(";base64,").ok_or("its `data:` is not in base64")?;
    STANDARD.decode(text).map_err(|e| format!("its base64 is broken: {e}"))
}
