//! The languages that code is printed in.

use super::function::within;
use super::printer::{Facts, Printer};
use super::{c, glsl, hlsl, msl, rust, wgsl};
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
    pub(super) fn printer(self) -> &'static dyn Printer {
        match self {
            Language::Rust => &rust::Rust,
            Language::Wgsl => &wgsl::Wgsl,
            Language::Hlsl => &hlsl::HLSL,
            Language::Glsl => &glsl::GLSL,
            Language::Msl => &msl::MSL,
            Language::C => &c::C,
        }
    }

    fn facts(self) -> &'static Facts {
        self.printer().facts()
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
    pub fn preamble(self) -> String {
        format!("{}{}", self.facts().attributes, self.facts().opening)
    }

    /// The structure of weighted fetches, with its documentation.
    pub(crate) fn fetches(self, fetches: &Fetches) -> String {
        format!("{}{}", comment("///", &fetches.doc), self.printer().fetches(fetches))
    }

    /// An argument with its type.
    pub fn argument(self, name: &str, kind: &str) -> String {
        self.printer().argument(name, kind)
    }

    /// The lines that open a function which a file offers.
    pub fn opened(self, name: &str, arguments: &[String], result: &str) -> String {
        let [start, end] = self.printer().signature(name, result, true);
        within(&start, arguments, &end)
    }

    /// Whether no variable may have this name.
    pub fn takes(self, name: &str) -> bool {
        self.facts().words.takes(name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_back() {
        for language in Language::ALL {
            assert_eq!(Language::parse(language.name()), Some(language));
        }
        assert_eq!(Language::parse("HLSL"), None);
    }
}
