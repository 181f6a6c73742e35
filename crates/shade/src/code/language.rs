//! The languages that code is printed in.

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

    /// The word used in the manifest and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Language::Rust => "rust",
            Language::Wgsl => "wgsl",
            Language::Hlsl => "hlsl",
            Language::Glsl => "glsl",
            Language::Msl => "msl",
            Language::C => "c",
        }
    }

    /// The language of a [`Language::name`].
    pub fn parse(name: &str) -> Option<Language> {
        Language::ALL.into_iter().find(|language| language.name() == name)
    }

    /// The name that people give it.
    pub fn title(self) -> &'static str {
        match self {
            Language::Rust => "Rust",
            Language::Wgsl => "WGSL",
            Language::Hlsl => "HLSL",
            Language::Glsl => "GLSL",
            Language::Msl => "MSL",
            Language::C => "C",
        }
    }

    /// What follows the dot in a file's name.
    pub fn extension(self) -> &'static str {
        match self {
            Language::Rust => "rs",
            Language::Wgsl => "wgsl",
            Language::Hlsl => "hlsl",
            Language::Glsl => "glsl",
            Language::Msl => "metal",
            Language::C => "h",
        }
    }

    /// Begins a line of a file's opening comment.
    pub fn comment(self) -> &'static str {
        match self {
            Language::Rust => "//!",
            _ => "//",
        }
    }

    /// What a file of printed functions says of its language: what it needs, and what becomes of bits.
    pub fn notes(self) -> &'static [&'static str] {
        match self {
            Language::Rust | Language::Wgsl => &[],
            Language::Hlsl => &["HLSL of shader model 5 or later."],
            Language::Glsl => &[
                "GLSL 3.30, GLSL ES 3.00 or later. GLSL ES needs, before this file: `precision highp float; precision highp sampler2D;`, and",
                "`precision highp sampler3D;` for a volume.",
            ],
            Language::Msl => &[
                "Metal Shading Language. No Metal compiler has read this file: it is checked as C++ about stand-ins for the library.",
                "Fast math, Metal's default, may reorder its sums.",
            ],
            Language::C => &[
                "C99, or C++. Its functions return the bits that were certified where a float is evaluated as a float and a * b + c is",
                "rounded twice: -ffp-contract=off for GCC and Clang, and no -ffast-math.",
            ],
        }
    }

    /// What printed functions need before them in their file, once; empty or ends in a line feed.
    ///
    /// `#pragma once` stands where files include one another; GLSL has no such directive of its own.
    pub fn opening(self) -> &'static str {
        match self {
            Language::Rust | Language::Wgsl | Language::Glsl => "",
            Language::Hlsl => "#pragma once\n",
            Language::Msl => "#pragma once\n#include <metal_stdlib>\nusing namespace metal;\n",
            Language::C => "#pragma once\n#include <math.h>\n",
        }
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
