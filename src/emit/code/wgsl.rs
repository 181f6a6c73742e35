//! The WGSL printer.

use std::collections::BTreeMap;

use super::expression::{Language, Text, Writer};
use super::names::{Names, WGSL, free};
use super::rust::power_body;
use super::{CodeError, visit};
use crate::fit::{Builtin, Expr, ExprKind, Formula, Function, Kind};

/// What WGSL does its own way. Whole powers become functions: its `pow` is undefined for negative bases.
struct Wgsl {
    /// Printed names of the power functions, by exponent.
    powers: BTreeMap<u32, String>,
}

/// Prints a specialised formula.
pub(super) fn print(formula: &Formula, header: &[String]) -> Result<String, CodeError> {
    let names = Names::of(formula, &WGSL)?;
    let main = &formula.main().name;
    let mut powers = BTreeMap::new();
    for function in &formula.functions {
        visit(&function.body, &mut |expr| {
            if let ExprKind::Power(_, n) = expr.kind {
                let name = free(&format!("{main}_pow{n}"), |name| names.functions.iter().any(|f| f == name));
                powers.insert(n, name);
            }
        });
    }
    let language = Wgsl { powers };
    let mut out = String::new();
    for (n, name) in &language.powers {
        let body = power_body(*n, "let", "    ");
        let (lines, value) = body.rsplit_once('\n').unwrap_or(("", &body));
        let lines = if lines.is_empty() { String::new() } else { format!("    {lines}\n") };
        out.push_str(&format!("fn {name}(x: f32) -> f32 {{\n{lines}    return {};\n}}\n\n", value.trim()));
    }
    for (index, function) in formula.functions.iter().enumerate() {
        let main = index + 1 == formula.functions.len();
        for line in header.iter().filter(|_| main) {
            out.push_str(format!("/// {line}").trim_end());
            out.push('\n');
        }
        print_function(&language, function, &names, index, &mut out);
        if !main {
            out.push('\n');
        }
    }
    Ok(out)
}

fn print_function(language: &Wgsl, function: &Function, names: &Names, index: usize, out: &mut String) {
    let variables = names.variables(function, &WGSL);
    let writer = Writer { language, function, function_names: &names.functions, names: &variables };
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

impl Language for Wgsl {
    /// The shortest decimal; where reading it as f64 and rounding that to f32 would give another number (WGSL does
    /// so with literals that have no suffix), the decimal of the f64.
    fn number(&self, x: f32, typed: bool) -> String {
        let short = format!("{x:?}");
        let text = match short.parse::<f64>() {
            Ok(wide) if wide as f32 == x => short,
            _ => format!("{:?}", f64::from(x)),
        };
        if typed { format!("{text}f") } else { text }
    }

    fn builtin(&self, writer: &Writer<Wgsl>, builtin: Builtin, operands: &[Expr], typed: bool) -> Text {
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

    fn power(&self, n: u32) -> String {
        self.powers.get(&n).cloned().unwrap_or_else(|| format!("pow{n}"))
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
