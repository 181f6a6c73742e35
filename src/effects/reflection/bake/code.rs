//! The section of this effect in the include files: its formulas, then the lookups of its tables.

use std::collections::BTreeMap;

use super::tables::BakedTable;
use crate::approximate::Fit;
use crate::data::Decode;
use crate::effects::BakeError;
use crate::emit::compensation::saturating;
use crate::emit::header;
use crate::emit::lookup::Readable;
use lobefit_shade::code::{self, Language};

/// Text by language; empty where there is nothing to include.
pub fn section(tables: &[BakedTable], fits: &[Fit]) -> Result<BTreeMap<Language, String>, BakeError> {
    let mut texts = BTreeMap::new();
    for language in Language::ALL {
        let text = in_language(language, tables, fits)?;
        if !text.is_empty() {
            texts.insert(language, text);
        }
    }
    Ok(texts)
}

fn in_language(language: Language, tables: &[BakedTable], fits: &[Fit]) -> Result<String, BakeError> {
    let mut text = String::new();
    for fit in fits.iter().filter(|f| f.emitted) {
        let lines = function_lines(fit);
        let function = match &fit.wraps {
            Some(inner) => {
                saturating(language, &fit.approximation.name, fit.hypothesis.inputs(), inner, &lines)
            }
            None => code::print(language, &fit.hypothesis, &fit.coefficients(), &lines)?.text,
        };
        text += &format!("\n{function}");
    }
    for baked in tables {
        let Some(table) = baked.table() else { continue };
        let decode = Decode::of(baked.layout, baked.serves);
        let lines = header::table_lines(table, decode.formulas(), &baked.approximation.certificate);
        text += &format!("\n{}", Readable { table, decode, header: &lines }.print(language));
    }
    Ok(text)
}

/// The header of one function: what it is, its error and its cost.
fn function_lines(fit: &Fit) -> Vec<String> {
    let a = &fit.approximation;
    let mut lines: Vec<String> = fit.hypothesis.doc().to_vec();
    if !lines.is_empty() {
        lines.push(String::new());
    }
    let what = match (&fit.wraps, a.used_as) {
        (Some(_), _) => {
            "furnace error |E N - 1| at f0 = 1; no larger, relative to 1 + f0 (1/E - 1), at any other f0"
        }
        (None, crate::data::Use::Normalisation) => "furnace error |E N - 1|",
        (None, crate::data::Use::F0Blend) => "of f0 A + B, at the worst f0",
        (None, _) => "absolute",
    };
    let constants = match fit.norm() {
        "published" => format!("as published: {}", a.source.text()),
        norm => format!("fitted for the smallest {norm} error"),
    };
    let smith = a.smith.map_or_else(String::new, |smith| format!(", smith {}", smith.name()));
    let ops = header::operations(a.cost.ops);
    lines.push(format!("{} {}{smith}; {ops}; constants {constants}", a.quantity, a.column));
    lines.extend(header::certificate_lines(what, &a.certificate));
    lines
}
