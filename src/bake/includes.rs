//! The include files: one per language, everything that the scene called for and nothing else. Each
//! effect has a section of its own between marks, so that a bake of some effects can keep the
//! sections of the others.

use crate::effects::Part;
use crate::effects::context::Context;
use crate::emit::compensation;
use lobefit_shade::code::{CodeError, Language, helpers};
use lobefit_shade::comment::comment;

/// Path of a language's include file.
pub fn path(language: Language) -> String {
    format!("fits/lobefit.{}", language.extension())
}

/// Begins the line that opens a section.
const MARK: &str = "// ---- ";

/// The mark of what sections share, the first of a file: in most languages a function stands before
/// what calls it.
const SHARED: &str = "shared";

/// Language and text of every include file; none where there is nothing to include.
///
/// # Errors
/// A text of compensations that does not parse, a defect of this program.
pub fn includes(
    parts: &[Part],
    opening: &[String],
    context: &Context,
) -> Result<Vec<(Language, String)>, CodeError> {
    let file = |language: Language| {
        let sections: Vec<(&str, &str)> =
            parts.iter().filter_map(|p| Some((p.by.name(), p.code.get(&language)?.as_str()))).collect();
        if sections.is_empty() {
            return Ok(None);
        }
        let notes: Vec<String> = language.notes().iter().map(ToString::to_string).collect();
        let mut text =
            comment(language.comment(), &[context.recipe.lines(), opening.to_vec(), notes].concat());
        let preamble = language.preamble(context.scene.output.float);
        if !preamble.is_empty() {
            text += &format!("\n{preamble}");
        }
        let of_effects: String =
            sections.iter().map(|(effect, section)| format!("\n{MARK}{effect} ----\n{section}")).collect();
        let shared = shared(language, &of_effects, parts)?;
        if !shared.is_empty() {
            text += &format!("\n{MARK}{SHARED} ----\n\n{}", shared.trim_start());
        }
        Ok(Some((language, text + &of_effects)))
    };
    Language::ALL.into_iter().filter_map(|language| file(language).transpose()).collect()
}

/// The section of an effect in the text of an include file.
pub fn section<'a>(text: &'a str, effect: &str) -> Option<&'a str> {
    let open = format!("\n{MARK}{effect} ----\n");
    let start = text.find(&open)? + open.len();
    let rest = &text[start..];
    let end = rest.find(&format!("\n{MARK}")).unwrap_or(rest.len());
    Some(&rest[..end])
}

/// What all sections share: the fetches that lookups call, and what a value of a table is used for.
fn shared(language: Language, sections: &str, parts: &[Part]) -> Result<String, CodeError> {
    let tables = parts.iter().flat_map(|part| &part.entries.tables).filter(|table| table.has_albedo()[0]);
    let mut text = String::new();
    for compensation in compensation::of(tables.map(|entry| entry.quantity.as_str())) {
        text += &format!("\n{}", compensation.print(language)?);
    }
    Ok(helpers(language, &format!("{sections}{text}")) + &text)
}
