//! The WGSL printer.

use super::expression::{Text, Writer, decimal};
use super::helpers::power;
use super::printer::{Facts, Printer, fields};
use super::table::{TableLookup, Textures};
use super::words::Words;
use crate::{Builtin, Expr, Fetches, Kind};

/// What WGSL does its own way.
pub(super) struct Wgsl {
    /// The type of numbers.
    number: &'static str,
    /// Ends a literal that nothing else gives its type.
    suffix: &'static str,
    /// See [`Printer::enables`].
    enables: &'static str,
    /// Whether a number is the numbers of two evaluations.
    is_pair: bool,
}

/// The printer of WGSL.
pub(super) const WGSL: Wgsl = Wgsl { number: "f32", suffix: "f", enables: "", is_pair: false };

/// The same in half precision.
pub(super) const HALF: Wgsl = Wgsl { number: "f16", suffix: "h", enables: "enable f16;\n", is_pair: false };

/// Two evaluations at once in half precision.
pub(super) const PAIR: Wgsl = Wgsl { number: "vec2<f16>", is_pair: true, ..HALF };

const FACTS: Facts = Facts {
    name: "wgsl",
    title: "WGSL",
    extension: "wgsl",
    comment: "//",
    notes: &[],
    opening: "",
    attributes: "",
    reads_arrays: false,
    words: WORDS,
};

/// Built-ins that printed code may call, and so must not be shadowed. WGSL's own words cannot stand
/// in a hypothesis.
const WORDS: Words = Words {
    reserved:
        "abs min max clamp saturate mix fma sqrt inverseSqrt exp exp2 log log2 pow floor sign step smoothstep
        sin cos select",
    functions: "",
    stems: "",
    any_case: false,
    spelled: |name| name.to_string(),
};

const TEXTURES: Textures = Textures {
    resources: &[("table", "texture_#d<f32>"), ("linear_clamp", "sampler")],
    fetch: "textureSampleLevel(table, linear_clamp, #, 0.0)",
    single: "Texels of 32 bits need a device with the feature float32-filterable.",
    norm16: Some("Texels of 16-bit integers need a device with the feature texture-formats-tier1."),
};

impl Printer for Wgsl {
    fn facts(&self) -> &'static Facts {
        &FACTS
    }

    fn enables(&self) -> &'static str {
        self.enables
    }

    fn number(&self, x: f32, typed: bool) -> String {
        let text = decimal(x);
        if typed { format!("{text}{}", self.suffix) } else { text }
    }

    fn both(&self, literal: &str) -> Option<String> {
        self.is_pair.then(|| format!("{}({literal})", self.number))
    }

    fn kind(&self, kind: Kind) -> String {
        match kind {
            Kind::Number => self.number.into(),
            Kind::Truth => "bool".into(),
            Kind::Vector(n) => format!("vec{n}<{}>", self.number),
            Kind::List(n) => format!("array<vec4<{}>, {n}>", self.number),
            Kind::Fetches(fetches) => fetches.name,
        }
    }

    fn argument(&self, name: &str, kind: &str) -> String {
        format!("{name}: {kind}")
    }

    fn signature(&self, name: &str, result: &str, _: bool) -> [String; 2] {
        [format!("fn {name}("), format!(") -> {result} {{\n")]
    }

    fn declare(&self, name: &str, kind: Kind, mutable: bool, typed: bool) -> String {
        let word = if mutable { "var" } else { "let" };
        if typed { format!("{word} {name}: {} = ", self.kind(kind)) } else { format!("{word} {name} = ") }
    }

    fn builtin(&self, writer: &Writer, builtin: Builtin, operands: &[Expr], typed: bool) -> Text {
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
            Builtin::Dot => "dot",
            Builtin::Select => "select",
        };
        // Literals alone would be taken for abstract numbers, which naga refuses beside a run-time
        // condition.
        let numbers = if builtin == Builtin::Select { &operands[..2] } else { operands };
        let typed = typed || !numbers.iter().any(|e| writer.anchored(e));
        let printed: Vec<String> = operands.iter().map(|e| writer.value(e, typed)).collect();
        Text::atom(format!("{name}({})", printed.join(", ")))
    }

    /// Older front ends index an argument by constants alone.
    fn copied(&self, list: &str) -> Option<[String; 2]> {
        Some(["every".into(), format!("var every = {list};")])
    }

    fn each(&self, element: &str, list: &str, n: u8) -> Vec<String> {
        vec![format!("for (var i = 0; i < {n}; i++) {{"), format!("let {element} = {list}[i];")]
    }

    fn fetches(&self, fetches: &Fetches) -> String {
        let fields = fields(fetches.count, |kind, name| format!("{name}: {},", self.kind(kind)));
        format!("struct {} {{\n{fields}}}\n", fetches.name)
    }

    fn give_fetches(&self, kind: &str, _: &str, lists: [&[String]; 2]) -> Vec<String> {
        vec![format!("return {kind}({});", lists.concat().join(", "))]
    }

    fn lookup(&self, table: &TableLookup) -> String {
        TEXTURES.lookup(self, table)
    }

    fn lacking(&self, _: Builtin, _: &[Expr]) -> Option<&'static str> {
        None
    }

    fn helper(&self, base: &str, name: &str) -> String {
        let (lines, value) = power(base, "let");
        let lines: String = lines.iter().map(|line| format!("    {line}\n")).collect();
        let number = self.number;
        format!("fn {name}(x: {number}) -> {number} {{\n{lines}    return {value};\n}}\n")
    }
}
