//! The lookup of a table: a fetch between the functions of its coordinates and of its decoding.

use super::printer::Printer;
use super::{Float, Language};
use crate::Kind;
use crate::comment::comment;

/// A lookup to be printed: of a table of two or three axes, whose functions `STEM_uv` (`STEM_uvw`)
/// and `STEM_decode` the file has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TableLookup {
    /// Its name.
    pub name: String,
    /// What the names of the functions of coordinates and decoding begin with.
    pub stem: String,
    /// What its comment says beside what it returns.
    pub about: Vec<String>,
    /// Texels along each axis.
    pub sizes: Vec<usize>,
    /// Channels of a texel.
    pub channels: usize,
    /// Numbers of the result.
    pub values: usize,
    /// What they are, in words.
    pub meaning: &'static str,
    /// Arguments of the lookup.
    pub arguments: Vec<&'static str>,
    /// Those of the coordinates among them.
    pub coordinates: Vec<&'static str>,
    /// Those of the decoding among them.
    pub decoding: Vec<&'static str>,
    /// What a device needs to filter its texels.
    pub texels: Texels,
}

/// Formats of texels, by what a device needs to filter them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Texels {
    /// Halves and bytes: nothing.
    Common,
    /// Singles.
    Single,
    /// Integers of 16 bits / 65535.
    Norm16,
}

/// Letters of the texture coordinates, and the suffix of the function that computes them.
pub const LETTERS: [&str; 5] = ["u", "v", "w", "t", "s"];

/// Most axes of a texture. A table with more has its other slices behind one another, and a lookup as many
/// fetches as there are of them about a place.
pub const TEXTURE_AXES: usize = 3;

impl TableLookup {
    /// The function.
    ///
    /// It takes a texture of two or three dimensions and a sampler that filters linearly and clamps
    /// to the edge (in GLSL one `sampler2D` or `sampler3D`). In Rust and C, which have no textures,
    /// it fetches from a slice or array of f32 texels itself, columns fastest and slices slowest, a
    /// texel's channels together, and calls [`helpers`].
    pub fn print(&self, language: Language) -> String {
        language.printer(Float::F32).lookup(self)
    }

    /// The letters of its coordinates.
    pub(super) fn letters(&self) -> &'static [&'static str] {
        &LETTERS[..self.sizes.len().min(TEXTURE_AXES)]
    }

    /// The further arguments of the coordinates, one for each fetch of a table of more axes than a texture
    /// has.
    pub(super) fn corners(&self) -> Vec<String> {
        let beyond = self.sizes.len().saturating_sub(TEXTURE_AXES);
        let next = |i: usize| (0..beyond).map(|k| format!("{}.0", i >> k & 1)).collect::<Vec<_>>().join(", ");
        if beyond == 0 { Vec::new() } else { (0..1 << beyond).map(next).collect() }
    }

    /// A call of the function of the coordinates of one of these.
    pub(super) fn located_at(&self, corner: &str) -> String {
        self.located().replace(')', &format!(", {corner})"))
    }

    /// A call of the function of the coordinates.
    pub(super) fn located(&self) -> String {
        format!("{}_{}({})", self.stem, self.letters().concat(), self.coordinates.join(", "))
    }

    /// A call of the decoding.
    pub(super) fn decoded(&self, texel: &str) -> String {
        let arguments: String = self.decoding.iter().map(|name| format!(", {name}")).collect();
        format!("{}_decode({texel}{arguments})", self.stem)
    }

    /// The comment, which `first` begins, and the lines that open the function, after arguments of
    /// its own.
    pub(super) fn opening(&self, printer: &dyn Printer, first: &[String], own: &[String]) -> String {
        let number = printer.kind(Kind::Number);
        let given = self.arguments.iter().map(|name| printer.argument(name, &number));
        let arguments: Vec<String> = own.iter().cloned().chain(given).collect();
        let [start, end] = printer.signature(&self.name, &printer.kind(kind(self.values)), true);
        comment("///", &[first, &self.about].concat()) + &super::function::within(&start, &arguments, &end)
    }

    /// What a fetch between texels in memory is called, and how they are ordered.
    pub(super) fn order(&self) -> [&'static str; 2] {
        match self.sizes.len() {
            3.. => ["trilinear", "slice by slice, each row by row"],
            _ => ["bilinear", "row by row"],
        }
    }

    /// The sizes of its texture: `64, 64, 32`.
    pub(super) fn listed(&self) -> String {
        let (own, beyond) = self.sizes.split_at(self.letters().len());
        let mut sizes = own.to_vec();
        sizes.iter_mut().last().into_iter().for_each(|last| *last *= beyond.iter().product::<usize>());
        sizes.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")
    }
}

/// The kind of so many numbers.
pub(super) fn kind(n: usize) -> Kind {
    if n == 1 { Kind::Number } else { Kind::Vector(n as u8) }
}

/// What lookups and other functions of vectors share in a language, to stand before them; empty
/// where they share nothing. `functions` is the text of them all.
pub fn helpers(language: Language, functions: &str) -> String {
    language.printer(Float::F32).shared(functions)
}

/// How a language that has textures fetches.
pub(super) struct Textures {
    /// Names and types of the arguments, `#` for the number of axes.
    pub resources: &'static [(&'static str, &'static str)],
    /// The fetch of four channels, `#` for the coordinates.
    pub fetch: &'static str,
    /// What a device must have for texels of 32 bits.
    pub single: &'static str,
    /// The same for integers of 16 bits, where the language's interfaces leave them open.
    pub norm16: Option<&'static str>,
}

/// What picks a texel's channels from the four that are fetched.
const SWIZZLES: [&str; 4] = [".x", ".xy", ".xyz", ""];

impl Textures {
    /// The lookup by one fetch.
    pub fn lookup(&self, printer: &dyn Printer, table: &TableLookup) -> String {
        let (n, corners) = (table.letters().len(), table.corners());
        let axes = n.to_string();
        let own = self.resources.iter().map(|(name, kind)| printer.argument(name, &kind.replace('#', &axes)));
        let meaning = table.meaning;
        let fetches =
            if corners.is_empty() { "one fetch".into() } else { format!("{} fetches", corners.len()) };
        let mut first =
            vec![format!("{meaning} by {fetches}; the sampler filters linearly and clamps to the edge.")];
        let needed = match table.texels {
            Texels::Common => None,
            Texels::Single => Some(self.single),
            Texels::Norm16 => self.norm16,
        };
        first.extend(needed.map(String::from));
        let mut text = table.opening(printer, &first, &own.collect::<Vec<_>>());
        let uv = table.letters().concat();
        let declare = |name: &str, n: usize, value: &str| {
            format!("    {}{value};\n", printer.declare(name, kind(n), false, false))
        };
        if corners.is_empty() {
            text += &declare(&uv, n, &table.located());
            text += &declare("texel", 4, &self.fetch.replace('#', &uv));
        } else {
            let name = |i: usize| format!("{uv}_{i}");
            for (i, corner) in corners.iter().enumerate() {
                text += &declare(&name(i), 4, &table.located_at(corner));
            }
            let fetch = |i: usize| {
                format!("{} * {}.w", self.fetch.replace('#', &format!("{}.xyz", name(i))), name(i))
            };
            let sum: Vec<String> = (0..corners.len()).map(fetch).collect();
            text += &declare("texel", 4, &sum.join("\n        + "));
        }
        let decoded = table.decoded(&format!("texel{}", SWIZZLES[table.channels - 1]));
        text + &format!("    return {decoded};\n}}\n")
    }
}
