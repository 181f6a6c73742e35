//! The include files: one per language, everything that the scene called for and nothing else.

use super::BakeError;
use super::context::Context;
use super::tables::BakedTable;
use crate::data::{AlphaMap, Decode, Smith};
use crate::effects::reflection::Fit;
use crate::emit::lookup::{Readable, comment, rust_helpers};
use crate::emit::{code, compensation, header};

/// Language, path and text of every include file; none where there is nothing to include.
pub fn includes(
    lobe: (Smith, AlphaMap),
    tables: &[BakedTable],
    fits: &[Fit],
    context: &Context,
) -> Result<Vec<(&'static str, &'static str, String)>, BakeError> {
    if tables.is_empty() && fits.is_empty() {
        return Ok(Vec::new());
    }
    let (mut rust, mut wgsl) = (opening("//!", lobe, context), opening("//", lobe, context));
    for fit in fits.iter().filter(|f| f.emitted) {
        let lines = function_lines(fit);
        if let Some(inner) = &fit.wraps {
            rust += &format!("\n{}", wrapper(fit, inner, &lines, true));
            wgsl += &format!("\n{}", wrapper(fit, inner, &lines, false));
        } else {
            let coefficients = fit.coefficients();
            rust += &format!("\n{}", code::rust(&fit.hypothesis, &coefficients, &lines)?.text);
            wgsl += &format!("\n{}", code::wgsl(&fit.hypothesis, &coefficients, &lines)?.text);
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
    let helpers = rust_helpers(tables.iter().filter_map(BakedTable::table));
    if !helpers.is_empty() {
        rust += &format!("\n{helpers}");
    }
    let solid = tables.iter().filter_map(BakedTable::table).filter(|table| table.axes.len() == 3);
    for compensation in compensation::of(solid.map(|table| table.quantity.as_str())) {
        rust += &format!("\n{}", compensation.rust());
        wgsl += &format!("\n{}", compensation.wgsl());
    }
    Ok(vec![("rust", "fits/lobefit.rs", rust), ("wgsl", "fits/lobefit.wgsl", wgsl)])
}

fn opening(mark: &str, lobe: (Smith, AlphaMap), context: &Context) -> String {
    let mut lines = context.recipe.lines();
    let smith = format!("GGX lobe, smith: {}; alpha = {}", lobe.0.name(), lobe.1.name());
    lines.extend(
        [
            "",
            &smith,
            "Inputs: alpha is the GGX width, roughness the parameter it is made from, mu the cosine between normal and",
            "view, f0 the reflectance at normal incidence. `ggx_norm_*` is N with E N = 1: multiply the specular lobe by it.",
            "`*_saturating` is 1 + f0 (N - 1): multiply a metal's lobe by that, per colour channel.",
            "Operations: add, mul, fma, min, max, compare, select 1; rcp, sqrt, exp2 4; division rcp + mul; exp 5, pow 9;",
            "sin, cos, log2 4; log 5.",
        ]
        .map(String::from),
    );
    let mut text = comment(mark, &lines);
    if mark == "//!" {
        text += "\n// An engine uses some of these functions, not all.\n#![allow(dead_code)]\n";
    }
    text
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
        (None, _) => "absolute",
    };
    let constants = match fit.norm() {
        "published" => format!("as published: {}", a.source.text()),
        norm => format!("fitted for the smallest {norm} error"),
    };
    lines.push(format!(
        "{} {}, smith {}; {}; constants {constants}",
        a.quantity,
        a.column,
        a.smith.name(),
        header::operations(a.cost.ops)
    ));
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
