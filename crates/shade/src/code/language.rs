//! The languages that code is printed in.

use super::function::within;
use super::printer::{Facts, Printer};
use super::{Float, c, glsl, hlsl, msl, rust, wgsl};
use crate::Fetches;
use crate::comment::comment;

/// A language of the emitted code.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Language {
    /// Rust, editions 2021 and 2024; no dependencies.
    Rust,
    /// WGSL.
    Wgsl,
    /// HLSL, shader model 5 and later, as FXC, DXC and glslang read it.
    Hlsl,
    /// GLSL 3.30, GLSL ES 3.00 and later, Vulkan's GLSL among them.
    Glsl,
    /// Metal Shading Language.
    Msl,
    /// C99, and C++ that includes it.
    C,
}

impl Language {
    /// Every language, in the order of the manifest.
    pub const ALL: [Language; 6] =
        [Language::Rust, Language::Wgsl, Language::Hlsl, Language::Glsl, Language::Msl, Language::C];

    /// The printer of the language: the only place where languages part.
    pub(super) fn printer(self, float: Float) -> &'static dyn Printer {
        match (self, float) {
            (Language::Rust, _) => &rust::Rust,
            (Language::Wgsl, Float::F32) => &wgsl::WGSL,
            (Language::Wgsl, Float::F16) => &wgsl::HALF,
            (Language::Hlsl, Float::F32) => &hlsl::HLSL,
            (Language::Hlsl, Float::F16) => &hlsl::HALF,
            (Language::Glsl, Float::F32) => &glsl::GLSL,
            (Language::Glsl, Float::F16) => &glsl::HALF,
            (Language::Msl, Float::F32) => &msl::MSL,
            (Language::Msl, Float::F16) => &msl::HALF,
            (Language::C, _) => &c::C,
        }
    }

    /// The printer of two evaluations at once in half precision; none where a language has none.
    pub(super) fn pair_printer(self) -> Option<&'static dyn Printer> {
        match self {
            Language::Wgsl => Some(&wgsl::PAIR),
            Language::Hlsl => Some(&hlsl::PAIR),
            Language::Glsl => Some(&glsl::PAIR),
            Language::Msl => Some(&msl::PAIR),
            Language::Rust | Language::C => None,
        }
    }

    /// The printer where the type of numbers makes no difference.
    fn plain(self) -> &'static dyn Printer {
        self.printer(Float::F32)
    }

    fn facts(self) -> &'static Facts {
        self.plain().facts()
    }

    /// The word used in the manifest and on the command line.
    pub fn name(self) -> &'static str {
        self.facts().name
    }

    /// The language of a [`Language::name`].
    pub fn parse(name: &str) -> Option<Language> {
        Language::ALL.into_iter().find(|language| language.name() == name)
    }

    /// The name that people give it.
    pub fn title(self) -> &'static str {
        self.facts().title
    }

    /// Whether its lookups of tables read arrays, in the order of the `raw` file, for want of textures.
    pub fn reads_arrays(self) -> bool {
        self.facts().reads_arrays
    }

    /// What follows the dot in a file's name.
    pub fn extension(self) -> &'static str {
        self.facts().extension
    }

    /// Begins a line of a file's opening comment.
    pub fn comment(self) -> &'static str {
        self.facts().comment
    }

    /// What a file of printed functions says of its language: what it needs, and what becomes of
    /// bits.
    pub fn notes(self) -> &'static [&'static str] {
        self.facts().notes
    }

    /// What printed functions need before them in their file, once; empty or ends in a line feed.
    ///
    /// `#pragma once` stands where files include one another; GLSL has no such directive of its
    /// own.
    pub fn opening(self) -> &'static str {
        self.facts().opening
    }

    /// What stands at the start of a file of functions, [`Language::opening`] in it; empty or ends
    /// in a line feed.
    pub fn preamble(self, float: Float) -> String {
        format!("{}{}{}", self.facts().attributes, self.facts().opening, self.printer(float).enables())
    }

    /// The structure of weighted fetches, with its documentation.
    pub(crate) fn fetches(self, fetches: &Fetches) -> String {
        format!("{}{}", comment("///", &fetches.doc), self.plain().fetches(fetches))
    }

    /// An argument with its type.
    pub fn argument(self, name: &str, kind: &str) -> String {
        self.plain().argument(name, kind)
    }

    /// The lines that open a function which a file offers.
    pub fn opened(self, name: &str, arguments: &[String], result: &str) -> String {
        let [start, end] = self.plain().signature(name, result, true);
        within(&start, arguments, &end)
    }

    /// Whether no variable may have this name.
    pub fn takes(self, name: &str) -> bool {
        self.facts().words.takes(name)
    }
}
