//! Functions that the languages of C's family lack, in the order of operations of the tape.

use std::collections::BTreeSet;

use super::clike::ordered;
use super::expression::power_body;
use super::{Language, visit};
use crate::{Builtin, Expr, ExprKind, Formula};

/// What the functions compute that a formula calls and its language lacks: `mix`, `pow5`, ...
pub(super) fn needed(formula: &Formula, language: Language) -> BTreeSet<String> {
    let mut needed = BTreeSet::new();
    for function in &formula.functions {
        visit(&function.body, &mut |expr| match &expr.kind {
            ExprKind::Power(_, n) => {
                needed.insert(format!("pow{n}"));
            }
            ExprKind::Builtin(builtin, operands) => {
                needed.extend(base(*builtin, operands, language).map(String::from));
            }
            _ => {}
        });
    }
    needed
}

/// What stands in for a built-in that a language has no equal of; none where it has one, or where an expression does.
pub(super) fn base(builtin: Builtin, operands: &[Expr], language: Language) -> Option<&'static str> {
    let lacks = language.call(builtin).is_none();
    match builtin {
        Builtin::Mix if lacks => Some("mix"),
        Builtin::Step if lacks => Some("step"),
        Builtin::SmoothStep if lacks || !ordered(&operands[0], &operands[1]) => Some("smoothstep"),
        Builtin::Sign if language == Language::C => Some("sign"),
        _ => None,
    }
}

/// The function's text, from its result type on.
pub(super) fn print(base: &str, name: &str, language: Language, number: impl Fn(f32) -> String) -> String {
    let [zero, one, two, three] = [0.0, 1.0, 2.0, 3.0].map(number);
    let (arguments, lines, value) = match base {
        "mix" => ("float x, float y, float t", Vec::new(), format!("x * ({one} - t) + y * t")),
        "step" => ("float edge, float x", Vec::new(), format!("edge <= x ? {one} : {zero}")),
        "smoothstep" => {
            let [min, max] = if language == Language::C { ["fminf", "fmaxf"] } else { ["min", "max"] };
            let t = format!("float t = {min}({max}((x - lo) / (hi - lo), {zero}), {one});");
            ("float lo, float hi, float x", vec![t], format!("t * t * ({three} - {two} * t)"))
        }
        "sign" => {
            let sign = format!("x > {zero} ? {one} : (x < {zero} ? -{one} : x)");
            ("float x", Vec::new(), sign)
        }
        // pow and exponent
        _ => {
            let (lines, value) = power_body(base[3..].parse().unwrap_or(1), "float");
            ("float x", lines, value)
        }
    };
    let lines: String = lines.iter().map(|line| format!("    {line}\n")).collect();
    format!("float {name}({arguments}) {{\n{lines}    return {value};\n}}\n")
}
