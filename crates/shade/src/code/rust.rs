//! The Rust printer.

use super::expression::{Level, Text, Writer};
use super::helpers::power;
use super::printer::{Facts, Printer};
use super::rust_table;
use super::spelling::ascii;
use super::table::TableLookup;
use super::words::Words;
use crate::{Builtin, Expr, ExprKind, Fetches, Function, Kind, Statement};

/// What Rust does its own way: operations that are neither operators nor methods become functions
/// inside the function that uses them.
pub(super) struct Rust;

const FACTS: Facts = Facts {
    name: "rust",
    title: "Rust",
    extension: "rs",
    comment: "//!",
    notes: &[],
    opening: "",
    attributes: "// An engine uses some of these functions, not all.\n#![allow(dead_code)]\n",
    reads_arrays: true,
    words: WORDS,
};

/// All editions (The Rust Reference, "Keywords").
const WORDS: Words = Words {
    reserved: "abstract as async await become box do dyn extern f32 final gen impl in loop macro match mod move mut
        override priv pub ref static super trait try type typeof union unsafe unsized use virtual where yield crate self
        Self main",
    functions: "",
    stems: "",
    any_case: false,
    spelled: ascii,
};

impl Printer for Rust {
    fn facts(&self) -> &'static Facts {
        &FACTS
    }

    fn number(&self, x: f32, typed: bool) -> String {
        if typed { format!("{x:?}_f32") } else { format!("{x:?}") }
    }

    fn kind(&self, kind: Kind) -> String {
        match kind {
            Kind::Number => "f32".into(),
            Kind::Truth => "bool".into(),
            Kind::Vector(n) => format!("[f32; {n}]"),
            Kind::List(n) => format!("&[[f32; 4]; {n}]"),
            Kind::Fetches(fetches) => camel(&fetches.name),
        }
    }

    fn component(&self, vector: &str, i: usize) -> String {
        format!("{vector}[{i}]")
    }

    fn has_vectors(&self) -> bool {
        false
    }

    fn vector(&self, components: &[String]) -> String {
        format!("[{}]", components.join(", "))
    }

    fn argument(&self, name: &str, kind: &str) -> String {
        format!("{name}: {kind}")
    }

    fn signature(&self, name: &str, result: &str, public: bool) -> [String; 2] {
        let visibility = if public { "pub " } else { "" };
        [format!("{visibility}fn {name}("), format!(") -> {result} {{\n")]
    }

    fn attributes(&self, function: &Function, names: &[String], name: &str) -> String {
        let snake = |name: &str| name.chars().all(|c| !c.is_uppercase());
        let mut out = String::new();
        if !snake(name) || !names.iter().all(|name| snake(name)) {
            out.push_str("#[allow(non_snake_case)]\n");
        }
        if function.body.iter().any(has_var) {
            // A `var` keeps its initial value as written, also where every branch then assigns
            // another: printed as it stands.
            out.push_str("#[allow(unused_assignments)]\n");
        }
        out
    }

    fn unused(&self, name: &str) -> Option<String> {
        Some(format!("let _ = {name};"))
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

    fn each(&self, element: &str, list: &str, _: u8) -> Vec<String> {
        vec![format!("for {element} in {list} {{")]
    }

    fn fetches(&self, Fetches { name, count: n, .. }: &Fetches) -> String {
        format!(
            "#[derive(Clone, Copy, Debug, PartialEq)]\npub struct {} {{\n    /// What to fetch.\n    \
             pub fetches: [[f32; 4]; {n}],\n    /// Their shares, which sum to 1.\n    pub weights: [f32; {n}],\n}}\n",
            camel(name)
        )
    }

    fn give_fetches(&self, kind: &str, _: &str, [fetches, weights]: [&[String]; 2]) -> Vec<String> {
        let [fetches, weights] = [fetches, weights].map(|list| list.join(", "));
        vec![format!("{kind} {{ fetches: [{fetches}], weights: [{weights}] }}")]
    }

    fn builtin(&self, writer: &Writer, builtin: Builtin, operands: &[Expr], typed: bool) -> Text {
        let method = |name: &str| method(writer, name, operands);
        let inner = |base: &str| Text::atom(format!("{}({})", writer.helper(base), writer.list(operands)));
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
            Builtin::Dot => writer.dot(&operands[0], &operands[1], typed),
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

    fn lacking(&self, builtin: Builtin, _: &[Expr]) -> Option<&'static str> {
        match builtin {
            Builtin::Mix => Some("mix"),
            Builtin::Step => Some("step"),
            Builtin::SmoothStep => Some("smoothstep"),
            Builtin::Sign => Some("sign"),
            _ => None,
        }
    }

    fn lookup(&self, table: &TableLookup) -> String {
        rust_table::lookup(table)
    }

    fn shared(&self, functions: &str) -> String {
        rust_table::helpers(functions)
    }

    fn nests_helpers(&self) -> bool {
        true
    }

    fn helper(&self, base: &str, name: &str) -> String {
        let (arguments, body) = match base {
            "mix" => ("x: f32, y: f32, t: f32", "x * (1.0 - t) + y * t".to_string()),
            "step" => ("edge: f32, x: f32", "if edge <= x { 1.0 } else { 0.0 }".to_string()),
            "smoothstep" => (
                "lo: f32, hi: f32, x: f32",
                "let t = ((x - lo) / (hi - lo)).clamp(0.0, 1.0);\n        t * t * (3.0 - 2.0 * t)"
                    .to_string(),
            ),
            "sign" => ("x: f32", "if x > 0.0 { 1.0 } else if x < 0.0 { -1.0 } else { x }".to_string()),
            _ => {
                let (lines, value) = power(base, "let");
                ("x: f32", [lines, vec![value]].concat().join("\n        "))
            }
        };
        format!("    fn {name}({arguments}) -> f32 {{\n        {body}\n    }}\n")
    }
}

/// The name of a type: `RoomLight2` of `room_light_2`.
fn camel(name: &str) -> String {
    let word = |word: &str| format!("{}{}", word[..1].to_uppercase(), &word[1..]);
    name.split('_').filter(|part| !part.is_empty()).map(word).collect()
}

fn has_var(statement: &Statement) -> bool {
    match statement {
        Statement::Var(..) => true,
        Statement::If(_, accept, reject) => accept.iter().chain(reject).any(has_var),
        Statement::Each(_, _, body) => body.iter().any(has_var),
        _ => false,
    }
}

/// A method call on the first operand.
fn method(writer: &Writer, name: &str, operands: &[Expr]) -> Text {
    Text::atom(format!("{}.{name}({})", receiver(writer, &operands[0]), writer.list(&operands[1..])))
}

/// The operand that a method is called on; its type must be known before the call.
fn receiver(writer: &Writer, operand: &Expr) -> String {
    writer.expression(operand, !writer.anchored(operand)).within(Level::Atom)
}

/// f32::clamp panics if its bounds are in the wrong order, so only literal bounds are given to it.
fn clamp(writer: &Writer, operands: &[Expr]) -> Text {
    let x = receiver(writer, &operands[0]);
    let [lo, hi] = [1, 2].map(|i| writer.expression(&operands[i], false).text);
    let ordered = match (&operands[1].kind, &operands[2].kind) {
        (ExprKind::Number(lo), ExprKind::Number(hi)) => lo <= hi,
        _ => false,
    };
    Text::atom(if ordered { format!("{x}.clamp({lo}, {hi})") } else { format!("{x}.max({lo}).min({hi})") })
}
