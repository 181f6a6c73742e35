//! The WGSL printer.

use std::collections::{BTreeMap, BTreeSet};

use super::expression::{Dialect, Text, Writer, decimal, power_body};
use super::names::Names;
use super::words::Words;
use super::{CodeError, Language, comment, visit};
use crate::{Builtin, Expr, ExprKind, Formula, Function, Kind};

/// What WGSL does its own way. Whole powers become functions: its `pow` is undefined for negative bases.
struct Wgsl<'a> {
    /// Printed names of the power functions, by `pow` and exponent.
    powers: &'a BTreeMap<String, String>,
}

/// Prints a specialised formula.
pub(super) fn print(formula: &Formula, header: &[String]) -> Result<String, CodeError> {
    let mut names = Names::of(formula, Words::of(Language::Wgsl))?;
    let mut powers = BTreeSet::new();
    for function in &formula.functions {
        visit(&function.body, &mut |expr| {
            if let ExprKind::Power(_, n) = expr.kind {
                powers.insert(n);
            }
        });
    }
    let mut out = String::new();
    for n in powers {
        names.help(&formula.main().name, &format!("pow{n}"));
        let name = &names.helpers[&format!("pow{n}")];
        let (lines, value) = power_body(n, "let");
        let lines: String = lines.iter().map(|line| format!("    {line}\n")).collect();
        out.push_str(&format!("fn {name}(x: f32) -> f32 {{\n{lines}    return {value};\n}}\n\n"));
    }
    let dialect = Wgsl { powers: &names.helpers };
    for (index, function) in formula.functions.iter().enumerate() {
        let main = index + 1 == formula.functions.len();
        if main {
            out.push_str(&comment("///", header));
        }
        print_function(&dialect, function, &names, index, &mut out);
        if !main {
            out.push('\n');
        }
    }
    Ok(out)
}

fn print_function(dialect: &Wgsl, function: &Function, names: &Names, index: usize, out: &mut String) {
    let variables = names.variables(function);
    let writer = Writer { dialect, function, function_names: &names.functions, names: &variables };
    let arguments: Vec<String> = (0..function.arguments)
        .map(|i| format!("{}: {}", variables[i], type_name(function.variables[i].kind)))
        .collect();
    let result = type_name(function.result);
    out.push_str(&format!("fn {}({}) -> {result} {{\n", names.functions[index], arguments.join(", ")));
    writer.block(&function.body, 1, true, out);
    out.push_str("}\n");
}

fn type_name(kind: Kind) -> &'static str {
    match kind {
        Kind::Number => "f32",
        Kind::Truth => "bool",
    }
}

impl Dialect for Wgsl<'_> {
    fn number(&self, x: f32, typed: bool) -> String {
        let text = decimal(x);
        if typed { format!("{text}f") } else { text }
    }

    fn builtin(&self, writer: &Writer<Self>, builtin: Builtin, operands: &[Expr], typed: bool) -> Text {
        let name = match builtin {
            Builtin::Abs => "abs",
            Builtin::Min => "min",
            Builtin::Max => "max",
            Builtin::Clamp => "clamp",
            Builtin::Saturate => "saturate",
            Builtin::Mix => "mix",
            Builtin::Fma => "fma",
            Builtin::Sqrt => "sqrt",
            Builtin::InverseSqrt => "inverseSqrt",
            Builtin::Exp => "exp",
            Builtin::Exp2 => "exp2",
            Builtin::Log => "log",
            Builtin::Log2 => "log2",
            Builtin::Pow => "pow",
            Builtin::Floor => "floor",
            Builtin::Sign => "sign",
            Builtin::Step => "step",
            Builtin::SmoothStep => "smoothstep",
            Builtin::Sin => "sin",
            Builtin::Cos => "cos",
            Builtin::Select => "select",
        };
        // Literals alone would be taken for abstract numbers, which naga refuses beside a run-time condition.
        let numbers = if builtin == Builtin::Select { &operands[..2] } else { operands };
        let typed = typed || !numbers.iter().any(|e| writer.anchored(e));
        let printed: Vec<String> = operands.iter().map(|e| writer.expression(e, typed).text).collect();
        Text::atom(format!("{name}({})", printed.join(", ")))
    }

    fn helper(&self, base: &str) -> String {
        self.powers.get(base).map_or(base, String::as_str).to_string()
    }

    fn declare(&self, name: &str, kind: Kind, mutable: bool, typed: bool) -> String {
        let word = if mutable { "var" } else { "let" };
        if typed { format!("{word} {name}: {} = ", type_name(kind)) } else { format!("{word} {name} = ") }
    }

    fn condition(&self, condition: String) -> String {
        format!("({condition})")
    }

    fn tail(&self) -> bool {
        false
    }
}
