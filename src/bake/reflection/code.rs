//! The section of this effect in the include files: its formulas, then the lookups of its tables.

use std::collections::BTreeMap;

use super::tables::BakedTable;
use crate::bake::BakeError;
use crate::data::Decode;
use crate::effects::reflection::Fit;
use crate::emit::code::{self, Language};
use crate::emit::comment::comment;
use crate::emit::header;
use crate::emit::lookup::Readable;

/// Text by language; empty where there is nothing to include.
pub fn section(tables: &[BakedTable], fits: &[Fit]) -> Result<BTreeMap<String, String>, BakeError> {
    let (mut rust, mut wgsl) = (String::new(), String::new());
    for fit in fits.iter().filter(|f| f.emitted) {
        let lines = function_lines(fit);
        if let Some(inner) = &fit.wraps {
            rust += &format!("\n{}", wrapper(fit, inner, &lines, true));
            wgsl += &format!("\n{}", wrapper(fit, inner, &lines, false));
        } else {
            let coefficients = fit.coefficients();
            rust +=
                &format!("\n{}", code::print(Language::Rust, &fit.hypothesis, &coefficients, &lines)?.text);
            wgsl +=
                &format!("\n{}", code::print(Language::Wgsl, &fit.hypothesis, &coefficients, &lines)?.text);
        }
    }
    for baked in tables {
        let Some(table) = baked.table() else { continue };
        let decode = Decode::of(baked.layout, baked.serves);
        let lines = header::table_lines(table, decode.formulas(), &baked.approximation.certificate);
        let readable = Readable { table, decode, header: &lines };
        rust += &format!("\n{}", readable.rust());
        wgsl += &format!("\n{}", readable.wgsl());
    }
    let texts = [("rust", rust), ("wgsl", wgsl)].into_iter().filter(|(_, text)| !text.is_empty());
    Ok(texts.map(|(language, text)| (language.to_string(), text)).collect())
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
    // The lobe of the sheen has no Smith form.
    let smith = match a.quantity.as_str() {
        "sheen-charlie" => String::new(),
        _ => format!(", smith {}", a.smith.name()),
    };
    let ops = header::operations(a.cost.ops);
    lines.push(format!("{} {}{smith}; {ops}; constants {constants}", a.quantity, a.column));
    lines.extend(header::certificate_lines(what, &a.certificate));
    lines
}

/// 1 + f0 (N - 1) by a call of N.
fn wrapper(fit: &Fit, inner: &str, lines: &[String], rust: bool) -> String {
    let inputs = fit.hypothesis.inputs();
    let declared: Vec<String> = inputs.iter().map(|i| format!("{i}: f32")).collect();
    let passed: Vec<&str> = inputs.iter().map(String::as_str).filter(|i| *i != "f0").collect();
    let (head, name) = (comment("///", lines), &fit.approximation.name);
    let (declared, passed) = (declared.join(", "), passed.join(", "));
    let value = format!("1.0 + f0 * ({inner}({passed}) - 1.0)");
    if rust {
        format!("{head}pub fn {name}({declared}) -> f32 {{\n    {value}\n}}\n")
    } else {
        format!("{head}fn {name}({declared}) -> f32 {{\n    return {value};\n}}\n")
    }
}
