//! The functions that read a table: coordinates with the remap of its registration, decoding, and the lookup itself, in WGSL
//! and in Rust. The arithmetic is that in which the table was measured.

mod decoding;
mod rust;
mod wgsl;

use super::comment::comment;
use crate::data::{Axis, Decode, Expression, Table};

pub use rust::{HELPER_NAMES as RUST_HELPER_NAMES, helpers as rust_helpers};

/// Arguments that the functions of a table may have, in their order. Those of a table of three axes have the ones that
/// its axes and its decoding use; those of a table of two have `roughness`, `alpha` and `mu` whether they use them or not, so
/// that one layout can stand in for another.
const ARGUMENTS: [&str; 6] = ["roughness", "alpha", "mu", "anisotropy", "ior", "cos2_phi"];

/// A table with what its channels mean.
#[derive(Clone, Copy, Debug)]
pub struct Readable<'a> {
    /// The table, with as many channels as its decoding reads.
    pub table: &'a Table,
    /// Meaning of the channels.
    pub decode: Decode,
    /// Header lines.
    pub header: &'a [String],
}

impl Readable<'_> {
    /// The table's name as an identifier.
    pub fn identifier(&self) -> String {
        self.table.name.replace(|c: char| !c.is_ascii_alphanumeric(), "_")
    }

    /// The WGSL functions `<name>_uv` (`<name>_uvw` with slices), `<name>_decode` and `<name>_lookup`.
    ///
    /// The lookup takes a `texture_2d<f32>` or `texture_3d<f32>` and a sampler that filters linearly and clamps to the edge.
    pub fn wgsl(&self) -> String {
        wgsl::print(self)
    }

    /// The same in Rust, with a bilinear or trilinear fetch from a slice of texels, columns fastest and slices slowest.
    /// They call [`rust_helpers`].
    pub fn rust(&self) -> String {
        rust::print(self)
    }

    /// Arguments of `<name>_lookup` in order.
    pub fn arguments(&self) -> Vec<&'static str> {
        self.needed(&[self.coordinate_text(), self.decode_text()].join("\n"), |_| true)
    }

    /// Arguments of the coordinates.
    fn coordinate_arguments(&self) -> Vec<&'static str> {
        self.needed(&self.coordinate_text(), |_| true)
    }

    /// Arguments of the decoding beside the texel.
    fn decode_arguments(&self) -> Vec<&'static str> {
        self.needed(&self.decode_text(), |name| name == "mu")
    }

    fn coordinate_text(&self) -> String {
        coordinates(&self.table.axes).join("\n")
    }

    fn decode_text(&self) -> String {
        decoding::body(self.decode, |_| String::new()).lines().collect::<Vec<_>>().join("\n")
    }

    /// The arguments that a text mentions; for a table of two axes, all that are `habitual` of the three it may have.
    fn needed(&self, text: &str, habitual: impl Fn(&str) -> bool) -> Vec<&'static str> {
        if self.table.axes.len() == 2 {
            return ARGUMENTS.into_iter().take(3).filter(|name| habitual(name)).collect();
        }
        ARGUMENTS.into_iter().filter(|name| mentions(text, name)).collect()
    }
}

/// Letters of the texture coordinates, and the suffix of the function that computes them.
const LETTERS: [&str; 3] = ["u", "v", "w"];

fn declared(arguments: &[&str]) -> String {
    arguments.iter().map(|name| format!("{name}: f32")).collect::<Vec<_>>().join(", ")
}

/// Whether a text holds a word.
fn mentions(text: &str, word: &str) -> bool {
    text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').any(|w| w == word)
}

/// Lines that compute the texture coordinates of some axes, each under its letter: in WGSL, the arithmetic of
/// [`Axis::texture_coordinate`]. What they mention of [`ARGUMENTS`] becomes an argument; their functions must be among those that Rust
/// has by the same name.
fn coordinates(axes: &[Axis]) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for (letter, axis) in LETTERS.iter().zip(axes) {
        let Expression { steps, value } = axis.expression();
        let value = match axis.affine() {
            (1.0, 0.0) => value,
            (scale, offset) if scale < 0.0 => format!("{offset:?} - {value} * {:?}", -scale),
            (scale, offset) if offset < 0.0 => format!("{value} * {scale:?} - {:?}", -offset),
            (scale, offset) => format!("{value} * {scale:?} + {offset:?}"),
        };
        for (name, value) in steps.into_iter().chain([(letter.to_string(), value)]) {
            let line = format!("let {name} = {value};");
            // Another axis may have named the same quantity.
            if !lines.contains(&line) {
                lines.push(line);
            }
        }
    }
    lines
}
