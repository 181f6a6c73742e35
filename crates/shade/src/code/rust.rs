//! The Rust printer.

use std::collections::BTreeMap;

use super::expression::{Dialect, Level, Text, Writer, power_body};
use super::names::{Names, free};
use super::words::Words;
use super::{CodeError, Language, comment, is_read, visit};
use crate::{Builtin, Expr, ExprKind, Formula, Function, Kind, Statement};

/// What Rust does its own way: operations that are neither operators nor methods become functions inside the
/// function that uses them.
struct Rust {
    /// Printed names of the inner functions, by WGSL name or `pow` and exponent.
    inner: BTreeMap<String, String>,
}

/// Prints a specialised formula.
pub(super) fn print(formula: &Formula, header: &[String]) -> Result<String, CodeError> {
    let names = Names::of(formula, Words::of(Language::Rust))?;
    let mut out = String::new();
    for (index, function) in formula.functions.iter().enumerate() {
        let main = index + 1 == formula.functions.len();
        if main {
            out.push_str(&comment("///", header));
        }
        print_function(formula, function, &names, index, &mut out);
        if !main {
            out.push('\n');
        }
    }
    Ok(out)
}

fn print_function(formula: &Formula, function: &Function, names: &Names, index: usize, out: &mut String) {
    let main = index + 1 == formula.functions.len();
    let variables = names.variables(function);
    let dialect = Rust { inner: inner_functions(function, &variables, &names.functions) };
    let writer = Writer { dialect: &dialect, function, function_names: &names.functions, names: &variables };
    let snake = |name: &String| name.chars().all(|c| !c.is_uppercase());
    if !variables.iter().chain([&names.functions[index]]).all(snake) {
        out.push_str("#[allow(non_snake_case)]\n");
    }
    if function.body.iter().any(has_var) {
        // A `var` keeps its initial value as written, also where every branch then assigns another: printed as it stands.
        out.push_str("#[allow(unused_assignments)]\n");
    }
    let kind = |kind: Kind| if kind == Kind::Number { "f32" } else { "bool" };
    let arguments: Vec<String> = (0..function.arguments)
        .map(|i| format!("{}: {}", variables[i], kind(function.variables[i].kind)))
        .collect();
    let visibility = if main { "pub " } else { "" };
    let name = &names.functions[index];
    let result = kind(function.result);
    out.push_str(&format!("{visibility}fn {name}({}) -> {result} {{\n", arguments.join(", ")));
    for (base, name) in &dialect.inner {
        out.push_str(&inner_text(base, name));
    }
    for unused in (0..function.arguments).filter(|&i| !is_read(function, i)) {
        out.push_str(&format!("    let _ = {};\n", variables[unused]));
    }
    writer.block(&function.body, 1, true, out);
    out.push_str("}\n");
}

fn has_var(statement: &Statement) -> bool {
    match statement {
        Statement::Var(..) => true,
        Statement::If(_, accept, reject) => accept.iter().chain(reject).any(has_var),
        _ => false,
    }
}

/// The inner functions that a function needs, with names that nothing else in it has.
fn inner_functions(
    function: &Function,
    variables: &[String],
    functions: &[String],
) -> BTreeMap<String, String> {
    let mut inner = BTreeMap::new();
    visit(&function.body, &mut |expr| {
        let base = match &expr.kind {
            ExprKind::Builtin(Builtin::Mix, _) => "mix".to_string(),
            ExprKind::Builtin(Builtin::Step, _) => "step".to_string(),
            ExprKind::Builtin(Builtin::SmoothStep, _) => "smoothstep".to_string(),
            ExprKind::Builtin(Builtin::Sign, _) => "sign".to_string(),
            ExprKind::Power(_, n) => format!("pow{n}"),
            _ => return,
        };
        let name = free(&base, |n| variables.iter().chain(functions).any(|v| v == n));
        inner.insert(base, name);
    });
    inner
}

/// An inner function, in the order of operations of the tape.
fn inner_text(base: &str, name: &str) -> String {
    let (arguments, body) = match base {
        "mix" => ("x: f32, y: f32, t: f32", "x * (1.0 - t) + y * t".to_string()),
        "step" => ("edge: f32, x: f32", "if edge <= x { 1.0 } else { 0.0 }".to_string()),
        "smoothstep" => (
            "lo: f32, hi: f32, x: f32",
            "let t = ((x - lo) / (hi - lo)).clamp(0.0, 1.0);\n        t * t * (3.0 - 2.0 * t)".to_string(),
        ),
        "sign" => ("x: f32", "if x > 0.0 { 1.0 } else if x < 0.0 { -1.0 } else { x }".to_string()),
        // pow and exponent
        _ => {
            let (lines, value) = power_body(base[3..].parse().unwrap_or(1), "let");
            ("x: f32", [lines, vec![value]].concat().join("\n        "))
        }
    };
    format!("    fn {name}({arguments}) -> f32 {{\n        {body}\n    }}\n")
}

impl Dialect for Rust {
    fn number(&self, x: f32, typed: bool) -> String {
        if typed { format!("{x:?}_f32") } else { format!("{x:?}") }
    }

    fn builtin(&self, writer: &Writer<Rust>, builtin: Builtin, operands: &[Expr], typed: bool) -> Text {
        let method = |name: &str| method(writer, name, operands);
        let inner = |base: &str| Text::atom(format!("{}({})", self.helper(base), writer.list(operands)));
        match builtin {
            Builtin::Abs => method("abs"),
            Builtin::Min => method("min"),
            Builtin::Max => method("max"),
            Builtin::Fma => method("mul_add"),
            Builtin::Sqrt => method("sqrt"),
            Builtin::Exp => method("exp"),
            Builtin::Exp2 => method("exp2"),
            Builtin::Log => method("ln"),
            Builtin::Log2 => method("log2"),
            Builtin::Pow => method("powf"),
            Builtin::Floor => method("floor"),
            Builtin::Sin => method("sin"),
            Builtin::Cos => method("cos"),
            Builtin::Mix => inner("mix"),
            Builtin::Step => inner("step"),
            Builtin::SmoothStep => inner("smoothstep"),
            Builtin::Sign => inner("sign"),
            Builtin::Saturate => Text::atom(format!("{}.clamp(0.0, 1.0)", receiver(writer, &operands[0]))),
            Builtin::Clamp => clamp(writer, operands),
            Builtin::InverseSqrt => {
                let text = format!("1.0 / {}.sqrt()", receiver(writer, &operands[0]));
                Text { text, level: Level::Product }
            }
            Builtin::Select => {
                let [reject, accept, condition] =
                    [0, 1, 2].map(|i| writer.expression(&operands[i], typed && i < 2).text);
                Text {
                    text: format!("if {condition} {{ {accept} }} else {{ {reject} }}"),
                    level: Level::Choice,
                }
            }
        }
    }

    fn helper(&self, base: &str) -> String {
        self.inner.get(base).map_or(base, String::as_str).to_string()
    }

    fn declare(&self, name: &str, kind: Kind, mutable: bool, typed: bool) -> String {
        let mutable = if mutable { "mut " } else { "" };
        let kind = match (typed, kind) {
            (true, Kind::Number) => ": f32",
            _ => "",
        };
        format!("let {mutable}{name}{kind} = ")
    }

    fn condition(&self, condition: String) -> String {
        condition
    }

    fn tail(&self) -> bool {
        true
    }
}

/// A method call on the first operand.
fn method(writer: &Writer<Rust>, name: &str, operands: &[Expr]) -> Text {
    Text::atom(format!("{}.{name}({})", receiver(writer, &operands[0]), writer.list(&operands[1..])))
}

/// The operand that a method is called on; its type must be known before the call.
fn receiver(writer: &Writer<Rust>, operand: &Expr) -> String {
    writer.expression(operand, !writer.anchored(operand)).within(Level::Atom)
}

/// f32::clamp panics if its bounds are in the wrong order, so only literal bounds are given to it.
fn clamp(writer: &Writer<Rust>, operands: &[Expr]) -> Text {
    let x = receiver(writer, &operands[0]);
    let [lo, hi] = [1, 2].map(|i| writer.expression(&operands[i], false).text);
    let ordered = match (&operands[1].kind, &operands[2].kind) {
        (ExprKind::Number(lo), ExprKind::Number(hi)) => lo <= hi,
        _ => false,
    };
    Text::atom(if ordered { format!("{x}.clamp({lo}, {hi})") } else { format!("{x}.max({lo}).min({hi})") })
}
