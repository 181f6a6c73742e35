//! The include files: one per language, everything that the scene called for and nothing else. Each effect has a section of its
//! own between marks, so that a bake of some effects can keep the sections of the others.

use super::context::Context;
use super::part::Part;
use crate::emit::comment::comment;
use crate::emit::compensation;
use crate::emit::lookup::rust_helpers;

/// Languages with their files and comment marks (of the header, of a line).
pub const LANGUAGES: [(&str, &str, &str); 2] =
    [("rust", "fits/lobefit.rs", "//!"), ("wgsl", "fits/lobefit.wgsl", "//")];

/// Begins the line that opens a section.
const MARK: &str = "// ---- ";

/// The mark of the helpers that sections share, at the end of a file.
const SHARED: &str = "shared";

/// Language, path and text of every include file; none where there is nothing to include.
pub fn includes(
    parts: &[Part],
    opening: &[String],
    context: &Context,
) -> Vec<(&'static str, &'static str, String)> {
    let file = |(language, path, mark): (&'static str, &'static str, &str)| {
        let sections: Vec<(&str, &str)> =
            parts.iter().filter_map(|p| Some((p.effect.name(), p.code.get(language)?.as_str()))).collect();
        if sections.is_empty() {
            return None;
        }
        let mut text = comment(mark, &[context.recipe.lines(), opening.to_vec()].concat());
        if language == "rust" {
            text += "\n// An engine uses some of these functions, not all.\n#![allow(dead_code)]\n";
        }
        for (effect, section) in &sections {
            text += &format!("\n{MARK}{effect} ----\n{section}");
        }
        let shared = shared(language, &text, parts);
        if !shared.is_empty() {
            text += &format!("\n{MARK}{SHARED} ----\n\n{}", shared.trim_start());
        }
        Some((language, path, text))
    };
    LANGUAGES.into_iter().filter_map(file).collect()
}

/// The section of an effect in the text of an include file.
pub fn section<'a>(text: &'a str, effect: &str) -> Option<&'a str> {
    let open = format!("\n{MARK}{effect} ----\n");
    let start = text.find(&open)? + open.len();
    let rest = &text[start..];
    let end = rest.find(&format!("\n{MARK}")).unwrap_or(rest.len());
    Some(&rest[..end])
}

/// What all sections share: the fetches that the Rust lookups call, and what a value of a table is used for.
fn shared(language: &str, sections: &str, parts: &[Part]) -> String {
    let mut text = String::new();
    let rust = language == "rust";
    if rust {
        text += &rust_helpers(sections);
    }
    let tables = parts.iter().flat_map(|part| &part.entries.tables);
    for compensation in compensation::of(tables.filter_map(|entry| entry["quantity"].as_str())) {
        let function = if rust { compensation.rust() } else { compensation.wgsl() };
        text += &format!("\n{function}");
    }
    text
}
