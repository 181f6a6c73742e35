//! The printer of the languages of C's family: HLSL, GLSL, MSL and C. What differs between them is data.

use std::collections::BTreeMap;

use super::expression::{Dialect, Level, Text, Writer, decimal};
use super::helpers;
use super::names::Names;
use super::words::Words;
use super::{CodeError, Language, comment, is_read};
use crate::{Builtin, Expr, ExprKind, Formula, Function, Kind};

/// How a language of the family writes what the others write in another way.
pub(super) struct Spelling {
    /// Before a function.
    linkage: &'static str,
    /// After a literal.
    suffix: &'static str,
    /// Before the type of a value that keeps its value.
    constant: &'static str,
    /// Type of a truth value, false, true.
    truth: [&'static str; 3],
    /// Whether compilers ask for arguments that are not used.
    strict: bool,
}

const HLSL: Spelling = Spelling {
    linkage: "",
    suffix: "f",
    constant: "const ",
    truth: ["bool", "false", "true"],
    strict: false,
};
/// A `const` had a constant for its value before GLSL 4.20.
const GLSL: Spelling = Spelling { suffix: "", constant: "", ..HLSL };
const MSL: Spelling = Spelling { linkage: "inline ", ..HLSL };
/// C99 has its `bool` in another header, and C++ has none of C99's `_Bool`.
const C: Spelling = Spelling { linkage: "static inline ", truth: ["int", "0", "1"], strict: true, ..HLSL };

impl Spelling {
    fn of(language: Language) -> &'static Spelling {
        match language {
            Language::Glsl => &GLSL,
            Language::Msl => &MSL,
            Language::C => &C,
            _ => &HLSL,
        }
    }

    fn kind(&self, kind: Kind) -> &'static str {
        match kind {
            Kind::Number => "float",
            Kind::Truth => self.truth[0],
        }
    }

    fn number(&self, x: f32) -> String {
        format!("{}{}", decimal(x), self.suffix)
    }
}

/// What one language of the family does its own way.
struct Family<'a> {
    language: Language,
    spelling: &'static Spelling,
    helpers: &'a BTreeMap<String, String>,
}

/// Prints a specialised formula.
pub(super) fn print(language: Language, formula: &Formula, header: &[String]) -> Result<String, CodeError> {
    let mut names = Names::of(formula, Words::of(language))?;
    let spelling = Spelling::of(language);
    let main = &formula.main().name;
    let mut out = String::new();
    for base in helpers::needed(formula, language) {
        names.help(main, &base);
        let printed = helpers::print(&base, &names.helpers[&base], language, |x| spelling.number(x));
        out.push_str(&format!("{}{printed}\n", spelling.linkage));
    }
    let family = Family { language, spelling, helpers: &names.helpers };
    for (index, function) in formula.functions.iter().enumerate() {
        let main = index + 1 == formula.functions.len();
        if main {
            out.push_str(&comment("///", header));
        }
        family.function(function, &names, index, &mut out);
        if !main {
            out.push('\n');
        }
    }
    Ok(out)
}

impl Family<'_> {
    fn function(&self, function: &Function, names: &Names, index: usize, out: &mut String) {
        let variables = names.variables(function);
        let writer = Writer { dialect: self, function, function_names: &names.functions, names: &variables };
        let spelling = self.spelling;
        let argument = |i: usize| format!("{} {}", spelling.kind(function.variables[i].kind), variables[i]);
        let arguments: Vec<String> = (0..function.arguments).map(argument).collect();
        let (linkage, result) = (spelling.linkage, spelling.kind(function.result));
        let name = &names.functions[index];
        out.push_str(&format!("{linkage}{result} {name}({}) {{\n", arguments.join(", ")));
        for unused in (0..function.arguments).filter(|&i| spelling.strict && !is_read(function, i)) {
            out.push_str(&format!("    (void){};\n", variables[unused]));
        }
        writer.block(&function.body, 1, true, out);
        out.push_str("}\n");
    }

    fn clamp(&self, writer: &Writer<Self>, x: &Expr, bounds: [String; 2]) -> Text {
        let (x, [lo, hi]) = (writer.expression(x, false).text, bounds);
        let [min, max] = [Builtin::Min, Builtin::Max].map(|b| self.language.call(b).unwrap_or_default());
        Text::atom(format!("{min}({max}({x}, {lo}), {hi})"))
    }

    fn select(&self, writer: &Writer<Self>, operands: &[Expr]) -> Text {
        let [reject, accept, condition] =
            [0, 1, 2].map(|i| writer.expression(&operands[i], false).within(Level::Logic));
        Text { text: format!("{condition} ? {accept} : {reject}"), level: Level::Choice }
    }
}

/// Whether a `clamp` or `smoothstep` has literal bounds in their order: built-ins are undefined where they are not.
pub(super) fn ordered(lo: &Expr, hi: &Expr) -> bool {
    matches!((&lo.kind, &hi.kind), (ExprKind::Number(lo), ExprKind::Number(hi)) if lo < hi)
}

impl Language {
    /// The language's own function for a built-in, with the same arguments and the same order of operations; none where it
    /// has none. HLSL's `lerp` and MSL's `mix` are x + t (y - x), which is another number.
    pub(super) fn call(self, builtin: Builtin) -> Option<&'static str> {
        use Language::{C, Glsl, Hlsl, Msl};
        let name = match (builtin, self) {
            (Builtin::Abs, C) => "fabsf",
            (Builtin::Min, C) => "fminf",
            (Builtin::Max, C) => "fmaxf",
            (Builtin::Fma, C) => "fmaf",
            (Builtin::Sqrt, C) => "sqrtf",
            (Builtin::Exp, C) => "expf",
            (Builtin::Exp2, C) => "exp2f",
            (Builtin::Log, C) => "logf",
            (Builtin::Log2, C) => "log2f",
            (Builtin::Pow, C) => "powf",
            (Builtin::Floor, C) => "floorf",
            (Builtin::Sin, C) => "sinf",
            (Builtin::Cos, C) => "cosf",
            (_, C) => return None,
            (Builtin::Saturate, Hlsl | Msl) => "saturate",
            (Builtin::Mix, Glsl) => "mix",
            (Builtin::Fma, Msl) => "fma",
            (Builtin::Fma, Hlsl) => "mad",
            (Builtin::InverseSqrt, Glsl) => "inversesqrt",
            (Builtin::InverseSqrt, Hlsl | Msl) => "rsqrt",
            // HLSL's returns an integer.
            (Builtin::Sign, Glsl | Msl) => "sign",
            (Builtin::Abs, _) => "abs",
            (Builtin::Min, _) => "min",
            (Builtin::Max, _) => "max",
            (Builtin::Clamp, _) => "clamp",
            (Builtin::Sqrt, _) => "sqrt",
            (Builtin::Exp, _) => "exp",
            (Builtin::Exp2, _) => "exp2",
            (Builtin::Log, _) => "log",
            (Builtin::Log2, _) => "log2",
            (Builtin::Pow, _) => "pow",
            (Builtin::Floor, _) => "floor",
            (Builtin::Step, _) => "step",
            (Builtin::SmoothStep, _) => "smoothstep",
            (Builtin::Sin, _) => "sin",
            (Builtin::Cos, _) => "cos",
            (Builtin::Saturate | Builtin::Mix | Builtin::Fma | Builtin::InverseSqrt, _)
            | (Builtin::Sign | Builtin::Select, _) => return None,
        };
        Some(name)
    }

    /// Whether a built-in's rounding is that of the tape, on a machine of IEEE 754: HLSL's `mad` may round once or twice, and so
    /// may `x * y + z` in GLSL, whose older versions have no `fma`.
    pub(super) fn rounds(self, builtin: Builtin) -> bool {
        builtin != Builtin::Fma || !matches!(self, Language::Hlsl | Language::Glsl)
    }
}

impl Dialect for Family<'_> {
    fn number(&self, x: f32, _: bool) -> String {
        self.spelling.number(x)
    }

    fn truth(&self, x: bool) -> String {
        self.spelling.truth[1 + usize::from(x)].to_string()
    }

    fn builtin(&self, writer: &Writer<Self>, builtin: Builtin, operands: &[Expr], _: bool) -> Text {
        let [zero, one] = [0.0, 1.0].map(|x| self.spelling.number(x));
        let within = |i: usize, level| writer.expression(&operands[i], false).within(level);
        let unordered = |lo: usize| !ordered(&operands[lo], &operands[lo + 1]);
        match (builtin, self.language) {
            (Builtin::Select, _) => self.select(writer, operands),
            (Builtin::Clamp, Language::C) => {
                self.clamp(writer, &operands[0], [within(1, Level::Choice), within(2, Level::Choice)])
            }
            (Builtin::Clamp, _) if unordered(1) => {
                self.clamp(writer, &operands[0], [within(1, Level::Choice), within(2, Level::Choice)])
            }
            (Builtin::Saturate, Language::C) => self.clamp(writer, &operands[0], [zero, one]),
            (Builtin::Saturate, Language::Glsl) => {
                Text::atom(format!("clamp({}, {zero}, {one})", within(0, Level::Choice)))
            }
            (Builtin::Fma, Language::Glsl) => Text {
                text: format!(
                    "{} * {} + {}",
                    within(0, Level::Product),
                    within(1, Level::Sign),
                    within(2, Level::Product)
                ),
                level: Level::Sum,
            },
            (Builtin::InverseSqrt, Language::C) => {
                Text { text: format!("{one} / sqrtf({})", within(0, Level::Choice)), level: Level::Product }
            }
            (Builtin::Sign, Language::Hlsl) => {
                Text::atom(format!("float(sign({}))", within(0, Level::Choice)))
            }
            _ => match helpers::base(builtin, operands, self.language) {
                Some(base) => Text::atom(format!("{}({})", self.helper(base), writer.list(operands))),
                None => {
                    let name = self.language.call(builtin).unwrap_or_default();
                    Text::atom(format!("{name}({})", writer.list(operands)))
                }
            },
        }
    }

    fn helper(&self, base: &str) -> String {
        self.helpers.get(base).map_or(base, String::as_str).to_string()
    }

    fn declare(&self, name: &str, kind: Kind, mutable: bool, _: bool) -> String {
        let constant = if mutable { "" } else { self.spelling.constant };
        format!("{constant}{} {name} = ", self.spelling.kind(kind))
    }

    fn condition(&self, condition: String) -> String {
        format!("({condition})")
    }

    fn tail(&self) -> bool {
        false
    }
}
