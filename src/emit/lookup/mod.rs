//! The functions that read a table: coordinates with the remap of its registration, decoding, and the lookup itself, in every
//! [`Language`]. The arithmetic is that in which the table was measured.

mod c;
mod decoding;
mod functions;
mod rust;
mod sampled;

use super::spelling::mentions;
use crate::data::{Axis, Decode, Expression, Table};
use lobefit_shade::code::Language;
use lobefit_shade::comment::comment;

pub use c::HELPER_PREFIX as C_HELPER_PREFIX;
pub use rust::HELPER_NAMES as RUST_HELPER_NAMES;

/// What the functions of tables and of compensations share in a language, to stand before them; empty where they share nothing.
/// `functions` is the text of them all.
pub fn helpers(language: Language, functions: &str) -> String {
    match language {
        Language::Rust => rust::helpers(functions),
        Language::C => c::helpers(functions),
        Language::Wgsl | Language::Hlsl | Language::Glsl | Language::Msl => String::new(),
    }
}

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

    /// The functions `<name>_uv` (`<name>_uvw` with slices), `<name>_decode` and `<name>_lookup`.
    ///
    /// The lookup takes a texture of two or three dimensions and a sampler that filters linearly and clamps to the edge (in GLSL one
    /// `sampler2D` or `sampler3D`). In Rust and C, which have no textures, it fetches from a slice or array of f32 texels itself, columns
    /// fastest and slices slowest, a texel's channels together, and calls [`helpers`].
    pub fn print(&self, language: Language) -> String {
        functions::print(self, language)
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
        coordinates(&self.table.axes).into_iter().map(|(_, value)| value).collect::<Vec<_>>().join("\n")
    }

    fn decode_text(&self) -> String {
        decoding::body(self.decode, |_| String::new()).text()
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

/// Names and values of the texture coordinates of some axes, each under its letter, and of what they are computed from, in the arithmetic
/// of [`Axis::texture_coordinate`]. What they mention of [`ARGUMENTS`] becomes an argument.
fn coordinates(axes: &[Axis]) -> Vec<(String, String)> {
    let mut values: Vec<(String, String)> = Vec::new();
    for (letter, axis) in LETTERS.iter().zip(axes) {
        let Expression { steps, value } = axis.expression();
        let value = match axis.affine() {
            (1.0, 0.0) => value,
            (scale, offset) if scale < 0.0 => format!("{offset:?} - {value} * {:?}", -scale),
            (scale, offset) if offset < 0.0 => format!("{value} * {scale:?} - {:?}", -offset),
            (scale, offset) => format!("{value} * {scale:?} + {offset:?}"),
        };
        for step in steps.into_iter().chain([(letter.to_string(), value)]) {
            // Another axis may have named the same quantity.
            if !values.contains(&step) {
                values.push(step);
            }
        }
    }
    values
}
