//! The printer of the languages of C's family: HLSL, GLSL, MSL and C. What differs between them is
//! data.

use super::expression::{Level, Text, Writer, decimal};
use super::helpers::power;
use super::printer::{Facts, Printer, fields};
use super::table::TableLookup;
use crate::{Builtin, Expr, ExprKind, Fetches, Kind};

/// How a language of the family writes what the others write in another way.
pub(super) struct Family {
    pub facts: &'static Facts,
    /// Before a function.
    pub linkage: &'static str,
    /// What qualifies the types of numbers and vectors in declarations; empty or ends in a space.
    pub qualifier: &'static str,
    /// The type of numbers.
    pub number: &'static str,
    /// What makes a number of a literal, where a number is the numbers of two evaluations; empty where
    /// the literal is one.
    pub both: &'static str,
    /// After a literal.
    pub suffix: &'static str,
    /// Before the type of a value that keeps its value.
    pub constant: &'static str,
    /// Type of a truth value, false, true.
    pub truth: [&'static str; 3],
    /// How the vector types begin, before the number of components.
    pub vector: &'static str,
    /// The type of the vectors of an array that is an argument; ends in `*` where that is a
    /// pointer.
    pub list: &'static str,
    /// Whether vectors have constructors and arithmetic.
    pub has_vectors: bool,
    /// Whether compilers ask for arguments that are not used.
    pub strict: bool,
    /// The functions of the smaller and of the larger of two numbers.
    pub extremes: [&'static str; 2],
    /// Whether `fma` rounds once.
    pub rounds_fma: bool,
    /// The language's own function for a built-in, or what is written where it has none.
    pub call: fn(Builtin) -> Result<&'static str, Lacks>,
    /// The lookup of a table.
    pub lookup: fn(&TableLookup) -> String,
    /// What functions of vectors share.
    pub shared: fn(&str) -> String,
}

/// What is written for a built-in that a language does not have as WGSL has it.
#[derive(Clone, Copy)]
pub(super) enum Lacks {
    /// min(max(x, lo), hi).
    Clamp,
    /// A clamp to [0, 1].
    Saturate,
    /// The sum of the products of the components.
    Dot,
    /// x * y + z.
    Fma,
    /// 1 over the language's square root.
    InverseSqrt(&'static str),
    /// The language's `sign`, which returns an integer.
    FloatOfSign,
    /// `?:`.
    Select,
    /// A function of ours.
    Helper(&'static str),
}

/// The functions of a shading language of the family, with the arguments and the order of operations of the
/// dialect.
pub(super) fn call(builtin: Builtin) -> Result<&'static str, Lacks> {
    Ok(match builtin {
        Builtin::InverseSqrt => "rsqrt",
        Builtin::Sign => "sign",
        Builtin::Abs => "abs",
        Builtin::Min => "min",
        Builtin::Max => "max",
        Builtin::Clamp => "clamp",
        Builtin::Sqrt => "sqrt",
        Builtin::Exp => "exp",
        Builtin::Exp2 => "exp2",
        Builtin::Log => "log",
        Builtin::Log2 => "log2",
        Builtin::Pow => "pow",
        Builtin::Floor => "floor",
        Builtin::Step => "step",
        Builtin::SmoothStep => "smoothstep",
        Builtin::Sin => "sin",
        Builtin::Cos => "cos",
        Builtin::Dot => "dot",
        Builtin::Saturate => return Err(Lacks::Saturate),
        Builtin::Fma => return Err(Lacks::Fma),
        Builtin::Select => return Err(Lacks::Select),
        // `lerp` of HLSL and `mix` of MSL are x + t (y - x), which is another number.
        Builtin::Mix => return Err(Lacks::Helper("mix")),
    })
}

impl Family {
    fn spelled(&self, x: f32) -> String {
        format!("{}{}", decimal(x), self.suffix)
    }

    /// min(max(x, lo), hi)
    fn between(&self, x: &str, bounds: [String; 2]) -> Text {
        let ([min, max], [lo, hi]) = (self.extremes, bounds);
        Text::atom(format!("{min}({max}({x}, {lo}), {hi})"))
    }

    fn clamp(&self, writer: &Writer, operands: &[Expr]) -> Text {
        let [x, lo, hi] = [0, 1, 2].map(|i| writer.value(&operands[i], false));
        match (self.call)(Builtin::Clamp) {
            Ok(name) if ordered(&operands[1], &operands[2]) => Text::atom(format!("{name}({x}, {lo}, {hi})")),
            _ => self.between(&x, [lo, hi]),
        }
    }

    /// Of a language without a `saturate`.
    fn saturate(&self, writer: &Writer, x: &Expr) -> Text {
        let (x, [zero, one]) = (writer.expression(x, false).text, [0.0, 1.0].map(|x| self.spelled(x)));
        match (self.call)(Builtin::Clamp) {
            Ok(name) => Text::atom(format!("{name}({x}, {zero}, {one})")),
            Err(_) => self.between(&x, [zero, one]),
        }
    }

    /// `condition ? accept : reject`, neither of which has side effects.
    fn select(&self, writer: &Writer, operands: &[Expr]) -> Text {
        let [reject, accept, condition] =
            [0, 1, 2].map(|i| writer.expression(&operands[i], false).within(Level::Logic));
        Text { text: format!("{condition} ? {accept} : {reject}"), level: Level::Choice }
    }

    /// What a language without the function writes for it.
    fn instead(&self, writer: &Writer, lacks: Lacks, operands: &[Expr], typed: bool) -> Text {
        let text = |i: usize, level| writer.expression(&operands[i], false).within(level);
        match lacks {
            Lacks::Clamp => self.clamp(writer, operands),
            Lacks::Select => self.select(writer, operands),
            Lacks::Saturate => self.saturate(writer, &operands[0]),
            Lacks::Dot => writer.dot(&operands[0], &operands[1], typed),
            Lacks::Helper(base) => Text::atom(format!("{}({})", writer.helper(base), writer.list(operands))),
            Lacks::Fma => {
                let [x, y, z] = [text(0, Level::Product), text(1, Level::Sign), text(2, Level::Product)];
                Text { text: format!("{x} * {y} + {z}"), level: Level::Sum }
            }
            Lacks::InverseSqrt(root) => {
                let text = format!("{} / {root}({})", self.spelled(1.0), text(0, Level::Choice));
                Text { text, level: Level::Product }
            }
            Lacks::FloatOfSign => Text::atom(format!("{}(sign({}))", self.number, text(0, Level::Choice))),
        }
    }
}

/// Whether a `clamp` or `smoothstep` has literal bounds in their order: built-ins are undefined
/// where they are not.
fn ordered(lo: &Expr, hi: &Expr) -> bool {
    matches!((&lo.kind, &hi.kind), (ExprKind::Number(lo), ExprKind::Number(hi)) if lo < hi)
}

impl Printer for Family {
    fn facts(&self) -> &'static Facts {
        self.facts
    }

    fn number(&self, x: f32, _: bool) -> String {
        self.spelled(x)
    }

    fn both(&self, literal: &str) -> Option<String> {
        (!self.both.is_empty()).then(|| format!("{}({literal})", self.both))
    }

    fn truth(&self, x: bool) -> &'static str {
        self.truth[1 + usize::from(x)]
    }

    fn kind(&self, kind: Kind) -> String {
        match kind {
            Kind::Number => format!("{}{}", self.qualifier, self.number),
            Kind::Truth => self.truth[0].into(),
            Kind::Vector(n) => format!("{}{}{n}", self.qualifier, self.vector),
            Kind::List(n) => format!("{}[{n}]", self.list),
            Kind::Fetches(fetches) => fetches.name,
        }
    }

    fn has_vectors(&self) -> bool {
        self.has_vectors
    }

    /// C++ has no compound literals, so that C's stand in declarations alone.
    fn returns_vectors(&self) -> bool {
        self.has_vectors
    }

    fn vector(&self, components: &[String]) -> String {
        let list = components.join(", ");
        if self.has_vectors {
            format!("{}{}({list})", self.vector, components.len())
        } else {
            format!("{{{list}}}")
        }
    }

    fn argument(&self, name: &str, kind: &str) -> String {
        match kind.split_once('[') {
            // the mark of a pointer stands at the name, and no length
            _ if kind.ends_with('*') => format!("{kind}{name}"),
            Some((kind, _)) if kind.ends_with('*') => format!("{kind}{name}"),
            Some((kind, length)) => format!("{kind} {name}[{length}"),
            None => format!("{kind} {name}"),
        }
    }

    fn signature(&self, name: &str, result: &str, _: bool) -> [String; 2] {
        [format!("{}{result} {name}(", self.linkage), ") {\n".into()]
    }

    fn unused(&self, name: &str) -> Option<String> {
        self.strict.then(|| format!("(void){name};"))
    }

    fn declare(&self, name: &str, kind: Kind, mutable: bool, _: bool) -> String {
        let constant = if mutable { "" } else { self.constant };
        format!("{constant}{} {name} = ", self.kind(kind))
    }

    fn builtin(&self, writer: &Writer, builtin: Builtin, operands: &[Expr], typed: bool) -> Text {
        if let Some(base) = self.lacking(builtin, operands) {
            return self.instead(writer, Lacks::Helper(base), operands, typed);
        }
        match (builtin, (self.call)(builtin)) {
            (Builtin::Clamp, _) => self.clamp(writer, operands),
            (_, Ok(name)) => Text::atom(format!("{name}({})", writer.list(operands))),
            (_, Err(lacks)) => self.instead(writer, lacks, operands, typed),
        }
    }

    fn lacking(&self, builtin: Builtin, operands: &[Expr]) -> Option<&'static str> {
        match (self.call)(builtin) {
            Err(Lacks::Helper(base)) => Some(base),
            _ if builtin == Builtin::SmoothStep && !ordered(&operands[0], &operands[1]) => Some("smoothstep"),
            _ => None,
        }
    }

    fn helper(&self, base: &str, name: &str) -> String {
        let [zero, one, two, three] = [0.0, 1.0, 2.0, 3.0].map(|x| self.spelled(x));
        let number = self.kind(Kind::Number);
        let (arguments, lines, value): (&[&str], _, _) = match base {
            "mix" => (&["x", "y", "t"], Vec::new(), format!("x * ({one} - t) + y * t")),
            "step" => (&["edge", "x"], Vec::new(), format!("edge <= x ? {one} : {zero}")),
            "smoothstep" => {
                let t = self.between("(x - lo) / (hi - lo)", [zero, one]).text;
                let value = format!("t * t * ({three} - {two} * t)");
                (&["lo", "hi", "x"], vec![format!("{number} t = {t};")], value)
            }
            "sign" => (&["x"], Vec::new(), format!("x > {zero} ? {one} : (x < {zero} ? -{one} : x)")),
            _ => {
                let (lines, value) = power(base, &number);
                (&["x"], lines, value)
            }
        };
        let arguments: Vec<String> = arguments.iter().map(|name| self.argument(name, &number)).collect();
        let lines: String = lines.iter().map(|line| format!("    {line}\n")).collect();
        let [start, end] = self.signature(name, &number, false);
        format!("{start}{}{end}{lines}    return {value};\n}}\n", arguments.join(", "))
    }

    fn each(&self, element: &str, list: &str, n: u8) -> Vec<String> {
        let declared = self.declare(element, Kind::Vector(4), false, false);
        vec![format!("for (int i = 0; i < {n}; ++i) {{"), format!("{declared}{list}[i];")]
    }

    fn fetches(&self, Fetches { name, count, .. }: &Fetches) -> String {
        let fields = fields(*count, |kind, name| format!("{} {name};", self.kind(kind)));
        if self.has_vectors {
            format!("struct {name} {{\n{fields}}};\n")
        } else {
            format!("typedef struct {name} {{\n{fields}}} {name};\n")
        }
    }

    fn give_fetches(&self, kind: &str, name: &str, [fetches, weights]: [&[String]; 2]) -> Vec<String> {
        let field = |field: &'static str, list: &[String]| -> Vec<String> {
            list.iter().enumerate().map(|(i, value)| format!("{name}.{field}_{i} = {value};")).collect()
        };
        [
            vec![format!("{kind} {name};")],
            field("fetch", fetches),
            field("weight", weights),
            vec![format!("return {name};")],
        ]
        .concat()
    }

    fn lookup(&self, table: &TableLookup) -> String {
        (self.lookup)(table)
    }

    fn shared(&self, functions: &str) -> String {
        (self.shared)(functions)
    }

    fn rounds(&self, builtin: Builtin) -> bool {
        builtin != Builtin::Fma || self.rounds_fma
    }
}
