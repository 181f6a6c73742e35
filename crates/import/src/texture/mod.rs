//! Ranges of textures: the smallest and the largest texel of the base level bound whatever a filter or a
//! mip level makes of them.

mod decode;
mod histogram;

use std::collections::BTreeMap;

use super::limits;
use decode::Decoded;

/// Where the bytes of images come from: the package itself opens nothing.
pub trait Files {
    /// `length` bytes of the scene's own file from byte `at` on.
    ///
    /// # Errors
    /// Why not, in words.
    fn own(&self, at: u64, length: u64) -> Result<Vec<u8>, String>;

    /// A file inside the folder of the scene's, or `length` bytes of it from `at` on; `path` is relative
    /// and without `..`.
    ///
    /// # Errors
    /// Why not, in words: one that is reached through a link out of the folder, too.
    fn beside(&self, path: &str, part: Option<[u64; 2]>) -> Result<Vec<u8>, String>;
}

/// The images of a scene, each decoded once, when its values are asked for.
pub struct Textures<'a> {
    files: &'a dyn Files,
    quantile: f64,
    texels_left: u64,
    /// The bytes that texels were counted for, by their file.
    counted: BTreeMap<String, Spans>,
    known: BTreeMap<Place, Outcome>,
}

/// Spans of bytes, none of which touches another: ends by beginnings.
#[derive(Default)]
struct Spans(BTreeMap<u64, u64>);

impl Spans {
    /// Adds a span, and how many of its bytes were in none before.
    fn add(&mut self, [mut first, mut end]: [u64; 2]) -> u64 {
        let mut new = end - first;
        while let Some((&from, &to)) = self.0.range(..=end).next_back().filter(|(_, to)| **to >= first) {
            new -= to.min(end).saturating_sub(from.max(first)).min(new);
            (first, end) = (first.min(from), end.max(to));
            self.0.remove(&from);
        }
        self.0.insert(first, end);
        new
    }
}

/// Where an image is.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Place {
    /// Bytes of the scene's own file: the first, and how many.
    Own([u64; 2]),
    /// A file beside it, or a part of one.
    Beside(String, Option<[u64; 2]>),
    /// An image in the text of the scene's file, by its number there.
    Inline(usize),
    /// Bytes of a buffer in that text: its number, the first, and the one behind the last.
    Buffer(usize, [usize; 2]),
}

/// The values of a channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Extremes {
    /// Smallest and largest without the quantile at each end.
    pub kept: [f64; 2],
    /// Smallest and largest of all.
    pub all: [f64; 2],
}

/// Extremes of red, green, blue and alpha, or why they are not known.
pub(crate) type Outcome = Result<[Extremes; 4], String>;

impl<'a> Textures<'a> {
    /// Textures whose values are taken without a share of `quantile`, in [0, 0.5), at each end.
    pub fn new(files: &'a dyn Files, quantile: f64) -> Textures<'a> {
        Textures {
            files,
            quantile,
            texels_left: limits::ALL_TEXELS,
            counted: BTreeMap::new(),
            known: BTreeMap::new(),
        }
    }

    /// The extremes of an image, whose bytes `inline` gives where they are in the scene's text.
    ///
    /// # Errors
    /// An image that cannot be read or is broken, in words.
    pub(crate) fn image(
        &mut self,
        place: &Place,
        inline: impl FnOnce() -> Result<Vec<u8>, String>,
    ) -> Result<&Outcome, String> {
        if !self.known.contains_key(place) {
            let outcome = self.decoded(place, inline)?;
            self.known.insert(place.clone(), outcome);
        }
        Ok(&self.known[place])
    }

    fn decoded(
        &mut self,
        place: &Place,
        inline: impl FnOnce() -> Result<Vec<u8>, String>,
    ) -> Result<Outcome, String> {
        let bytes = match place {
            Place::Own([_, length]) | Place::Beside(_, Some([_, length]))
                if *length > limits::IMAGE_BYTES =>
            {
                return Ok(Err(format!("larger than {} bytes", limits::IMAGE_BYTES)));
            }
            Place::Own([at, length]) => self.files.own(*at, *length)?,
            Place::Beside(path, part) => self.files.beside(path, *part)?,
            Place::Inline(_) | Place::Buffer(..) => inline()?,
        };
        // Views of one file may overlap: each of its bytes counts once.
        let length = bytes.len() as u64;
        let (file, at) = match place {
            Place::Own([at, _]) => (String::new(), *at),
            Place::Beside(path, part) => (path.clone(), part.map_or(0, |[at, _]| at)),
            Place::Inline(image) => (format!("image:{image}"), 0),
            Place::Buffer(buffer, [at, _]) => (format!("buffer:{buffer}"), *at as u64),
        };
        let new = self.counted.entry(file).or_default().add([at, at.saturating_add(length)]);
        let left = self.texels_left.saturating_add(limits::TEXELS_OF_BYTE * new);
        match decode::decode(&bytes, left)? {
            Decoded::Texels(texels) => {
                self.texels_left = left - texels.count();
                Ok(Ok(texels.extremes(self.quantile)))
            }
            Decoded::Not(why) => {
                self.texels_left = left;
                Ok(Err(why))
            }
        }
    }

    /// The share that is left out at each end.
    pub(crate) fn quantile(&self) -> f64 {
        self.quantile
    }
}

/// The path of a URI relative to a folder, its escapes resolved.
///
/// # Errors
/// One that leads out of the folder, or elsewhere.
pub(crate) fn relative(uri: &str) -> Result<String, String> {
    let bytes = unescaped(uri).ok_or_else(|| format!("`{uri}` is not a URI: its escapes are no UTF-8"))?;
    let hostile = |c: char| c.is_control() || matches!(c, '\\' | ':');
    // `.` is the folder that a part stands in.
    let parts: Vec<&str> = bytes.split('/').filter(|part| *part != ".").collect();
    if bytes.contains(hostile) || parts.is_empty() || parts.iter().any(|part| matches!(*part, "" | "..")) {
        return Err(format!("`{uri}` is no plain path inside the folder of the scene: it is not opened"));
    }
    Ok(parts.join("/"))
}

/// A text with each `%xx` as its byte.
fn unescaped(uri: &str) -> Option<String> {
    let mut out = Vec::with_capacity(uri.len());
    let mut bytes = uri.bytes();
    while let Some(byte) = bytes.next() {
        if byte == b'%' {
            let digit = |byte: Option<u8>| char::from(byte?).to_digit(16);
            let (high, low) = (digit(bytes.next())?, digit(bytes.next())?);
            out.push(u8::try_from(16 * high + low).ok()?);
        } else {
            out.push(byte);
        }
    }
    String::from_utf8(out).ok()
}
