//! Functions of vectors, written once and printed in every language: a script of one statement per line.
//!
//! | line | meaning |
//! |---|---|
//! | `x = E` | names a number |
//! | `v = E \| E \| E` | names a vector of three or four numbers |
//! | `v :4 = f(...)` | names the vector of that many numbers that a call returns |
//! | `var x = E`, `set x = E` | names a number that changes, and changes it |
//! | `each`, `end` | around what is done for each `plane` of `planes` |
//! | `give E \| ...` | returns a number or a vector, or the fields of a structure |
//!
//! E is a shader's arithmetic on numbers and parts of vectors (`v.x`), with `sqrt abs min max pow exp2 log2`, comparisons, and
//! `choose(condition, a, b)` by itself, as an argument or in another `choose`.

use super::spelling::{expression, mentions, vector};
use lobefit_fit::FitError;
use lobefit_shade::Hypothesis;
use lobefit_shade::code::{Language, wrapped};
use lobefit_shade::comment::comment;

/// The type of an argument or a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// So many numbers.
    Numbers(usize),
    /// So many planes, by pointer where the language has them.
    Planes(u32),
    /// Fetches and their weights.
    Taps(usize),
}

/// A function.
#[derive(Clone, Debug)]
pub(super) struct Routine {
    pub name: String,
    pub header: Vec<String>,
    pub arguments: Vec<(&'static str, Kind)>,
    pub result: Kind,
    /// Its script.
    pub body: String,
}

/// The name of the structure of so many fetches.
pub(super) fn structure(language: Language, taps: usize) -> String {
    match language {
        Language::Rust => format!("ParallaxTaps{taps}"),
        _ => format!("parallax_taps_{taps}"),
    }
}

/// The structure of so many fetches.
pub(super) fn structure_text(language: Language, taps: usize) -> String {
    let name = structure(language, taps);
    let [number, four] = [1, 4].map(|n| vector(language, n));
    let lines: Vec<String> = match language {
        Language::Rust => {
            return format!(
                "/// Fetches from a probe: directions (xyz), with widths or levels (w).\n#[derive(Clone, Copy, Debug, PartialEq)]\n\
                 pub struct {name} {{\n    /// What to fetch.\n    pub fetches: [[f32; 4]; {taps}],\n    \
                 /// Their shares, which sum to 1.\n    pub weights: [f32; {taps}],\n}}\n"
            );
        }
        Language::Wgsl => {
            let fetches = (0..taps).map(|i| format!("    fetch_{i}: {four},"));
            fetches.chain((0..taps).map(|i| format!("    weight_{i}: {number},"))).collect()
        }
        _ => {
            let fetches = (0..taps).map(|i| format!("    {four} fetch_{i};"));
            fetches.chain((0..taps).map(|i| format!("    {number} weight_{i};"))).collect()
        }
    };
    let (start, end) = match language {
        Language::C => (format!("typedef struct {name} {{"), format!("}} {name};")),
        Language::Wgsl => (format!("struct {name} {{"), "}".into()),
        _ => (format!("struct {name} {{"), "};".into()),
    };
    let what = "/// Fetches from a probe: directions (xyz), with widths or levels (w); weights are their shares, which sum to 1.";
    format!("{what}\n{start}\n{}\n{end}\n", lines.join("\n"))
}

impl Kind {
    fn spelled(self, language: Language) -> String {
        match self {
            Kind::Numbers(n) => vector(language, n),
            Kind::Taps(n) => structure(language, n),
            Kind::Planes(n) => match language {
                Language::Rust => format!("&[[f32; 4]; {n}]"),
                Language::Wgsl => format!("array<vec4<f32>, {n}>"),
                Language::Msl => "constant float4 *".into(),
                Language::C => "const lobefit_float4 *".into(),
                Language::Hlsl | Language::Glsl => vector(language, 4),
            },
        }
    }

    fn argument(self, language: Language, name: &str) -> String {
        let plain = language.argument(name, &self.spelled(language));
        match (self, language) {
            (Kind::Planes(n), Language::Hlsl | Language::Glsl) => format!("{plain}[{n}]"),
            _ => plain,
        }
    }
}

impl Routine {
    /// Its text.
    pub fn print(&self, language: Language) -> String {
        let arguments: Vec<String> =
            self.arguments.iter().map(|(name, kind)| kind.argument(language, name)).collect();
        let mut printer =
            Printer { language, planes: self.planes(), result: self.result, depth: 1, out: String::new() };
        if language == Language::Wgsl && printer.planes.is_some() {
            // an argument may be indexed by constants alone
            printer.line("var every = planes");
        }
        for line in self.lines() {
            printer.statement(line);
        }
        let head = language.opened(&self.name, &arguments, &self.result.spelled(language));
        format!("{}{head}{}}}\n", comment("///", &self.header), printer.out)
    }

    /// The lines that are used: none names a value that no later one mentions.
    fn lines(&self) -> Vec<&str> {
        let mut kept: Vec<&str> = Vec::new();
        for line in self.body.lines().map(str::trim).filter(|line| !line.is_empty()).rev() {
            let named = line.split_once(" = ").map(|(name, _)| name.split(" :").next().unwrap_or(name));
            let plain = named.filter(|name| !name.contains(' '));
            if plain.is_none_or(|name| kept.iter().any(|later| mentions(later, name))) {
                kept.push(line);
            }
        }
        kept.reverse();
        kept
    }

    fn planes(&self) -> Option<u32> {
        self.arguments.iter().find_map(|(_, kind)| match kind {
            Kind::Planes(n) => Some(*n),
            _ => None,
        })
    }

    /// Operations of its own arithmetic, without that of the functions that it calls: each line's by itself, times the number of planes
    /// inside `each`.
    ///
    /// # Errors
    /// A line that is no arithmetic, a defect.
    pub fn operations(&self) -> Result<u32, FitError> {
        let (mut times, mut sum) = (1, 0);
        for line in self.lines() {
            match line {
                "each" => times = self.planes().unwrap_or(1),
                "end" => times = 1,
                _ if line.contains(" :") => {}
                _ => sum += times * operations(line)?,
            }
        }
        Ok(sum)
    }
}

/// Operations of a line's values: those of a function that returns their largest, without its comparisons. (A sum would be fused with the
/// products before it.)
fn operations(line: &str) -> Result<u32, FitError> {
    let values =
        line.strip_prefix("give ").or_else(|| line.split_once(" = ").map(|(_, v)| v)).unwrap_or(line);
    let values: Vec<&str> = values.split(" | ").collect();
    let text = values
        .iter()
        .map(|value| format!("({})", chosen(Language::Wgsl, value)))
        .reduce(|all, value| format!("max({all}, {value})"))
        .unwrap_or_default();
    let text = text.replace("(-(", "(0.0 - (");
    let flat = text.replace(".x", "_x").replace(".y", "_y").replace(".z", "_z").replace(".w", "_w");
    let inputs = names(&flat).iter().map(|name| format!("{name}: f32")).collect::<Vec<_>>().join(", ");
    let source = format!("fn line({inputs}) -> f32 {{ return {flat}; }}\n");
    let whole = Hypothesis::parse("lookup.wgsl", &source)?.tape().cost_ops();
    Ok(whole.saturating_sub(values.len() as u32 - 1))
}

/// The names in an expression that are no functions', each once.
fn names(text: &str) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    let word = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '.';
    let mut rest = text;
    while let Some(start) = rest.find(word) {
        let tail = &rest[start..];
        let end = tail.find(|c| !word(c)).unwrap_or(tail.len());
        let (found, after) = tail.split_at(end);
        let named = found.starts_with(|c: char| c.is_ascii_alphabetic());
        if named && !after.starts_with('(') && !names.contains(&found) {
            names.push(found);
        }
        rest = after;
    }
    names
}

struct Printer {
    language: Language,
    planes: Option<u32>,
    result: Kind,
    depth: usize,
    out: String,
}

impl Printer {
    fn line(&mut self, statement: &str) {
        self.out += &wrapped(&format!("{statement};"), self.depth);
    }

    fn statement(&mut self, line: &str) {
        let language = self.language;
        if line == "each" {
            self.open();
        } else if line == "end" {
            self.depth -= 1;
            self.out += &wrapped("}", self.depth);
        } else if let Some(values) = line.strip_prefix("give ") {
            self.give(&values.split(" | ").map(|value| chosen(language, value)).collect::<Vec<_>>());
        } else if let Some((name, value)) = line.strip_prefix("var ").and_then(|rest| rest.split_once(" = "))
        {
            let kind = match language {
                Language::Rust => "let mut ".into(),
                Language::Wgsl => "var ".into(),
                _ => format!("{} ", vector(language, 1)),
            };
            self.line(&format!("{kind}{name} = {}", chosen(language, value)));
        } else if let Some((name, value)) = line.strip_prefix("set ").and_then(|rest| rest.split_once(" = "))
        {
            self.line(&format!("{name} = {}", chosen(language, value)));
        } else if let Some((name, value)) = line.split_once(" = ") {
            self.named(name, value);
        }
    }

    /// Opens the loop over the planes.
    fn open(&mut self) {
        let n = self.planes.unwrap_or(0);
        let (head, plane) = match self.language {
            Language::Rust => ("for plane in planes {".into(), String::new()),
            Language::Wgsl => (format!("for (var i = 0; i < {n}; i++) {{"), "let plane = every[i]".into()),
            language => (
                format!("for (int i = 0; i < {n}; ++i) {{"),
                format!("{}{} plane = planes[i]", constant(language), vector(language, 4)),
            ),
        };
        self.out += &wrapped(&head, self.depth);
        self.depth += 1;
        if !plane.is_empty() {
            self.line(&plane);
        }
    }

    fn named(&mut self, name: &str, value: &str) {
        let language = self.language;
        let values: Vec<String> = value.split(" | ").map(|value| chosen(language, value)).collect();
        let (name, count) = match name.split_once(" :") {
            Some((name, count)) => (name, count.parse().unwrap_or(1)),
            None => (name, values.len()),
        };
        let kind = vector(language, count);
        let value = match values.as_slice() {
            [one] => one.clone(),
            list => vector_of(language, &kind, list),
        };
        self.line(&match language {
            Language::Rust | Language::Wgsl => format!("let {name} = {value}"),
            _ => format!("{}{kind} {name} = {value}", constant(language)),
        });
    }

    fn give(&mut self, values: &[String]) {
        let (language, kind) = (self.language, self.result.spelled(self.language));
        let value = match (values, self.result) {
            ([one], _) => one.clone(),
            (list, Kind::Taps(n)) => return self.give_taps(&kind, list, n),
            (list, _) => vector_of(language, &kind, list),
        };
        match language {
            Language::Rust => self.out += &wrapped(&value, self.depth),
            // C++ has no compound literals
            Language::C if values.len() > 1 => {
                self.line(&format!("const {kind} result = {value}"));
                self.line("return result");
            }
            _ => self.line(&format!("return {value}")),
        }
    }

    /// The names of fetches, then their weights.
    fn give_taps(&mut self, kind: &str, values: &[String], n: usize) {
        let (fetches, weights) = values.split_at(n);
        match self.language {
            Language::Rust => {
                let list = format!("fetches: [{}], weights: [{}]", fetches.join(", "), weights.join(", "));
                self.out += &wrapped(&format!("{kind} {{ {list} }}"), self.depth);
            }
            Language::Wgsl => self.line(&format!("return {kind}({})", values.join(", "))),
            _ => {
                self.line(&format!("{kind} taps"));
                for (i, value) in fetches.iter().enumerate() {
                    self.line(&format!("taps.fetch_{i} = {value}"));
                }
                for (i, value) in weights.iter().enumerate() {
                    self.line(&format!("taps.weight_{i} = {value}"));
                }
                self.line("return taps");
            }
        }
    }
}

/// The word before the type of a value that does not change.
fn constant(language: Language) -> &'static str {
    if language == Language::Glsl { "" } else { "const " }
}

fn vector_of(language: Language, kind: &str, values: &[String]) -> String {
    let list = values.join(", ");
    match language {
        Language::Rust => format!("[{list}]"),
        Language::C => format!("{{{list}}}"),
        _ => format!("{kind}({list})"),
    }
}

/// An expression in a language, its choices as the language has them.
fn chosen(language: Language, text: &str) -> String {
    let Some(start) = text.find("choose(") else { return expression(language, text) };
    let (before, inside) = (&text[..start], &text[start + "choose(".len()..]);
    let (operands, after) = operands(inside);
    let [condition, accept, reject] =
        [0, 1, 2].map(|i| chosen(language, operands.get(i).copied().unwrap_or("0.0").trim()));
    let choice = match language {
        Language::Rust => format!("if {condition} {{ {accept} }} else {{ {reject} }}"),
        Language::Wgsl => format!("select({reject}, {accept}, {condition})"),
        _ => format!("({condition} ? {accept} : {reject})"),
    };
    format!("{}{choice}{}", expression(language, before), chosen(language, after))
}

/// The operands of a call whose bracket is open, and what follows its end.
fn operands(text: &str) -> (Vec<&str>, &str) {
    let (mut depth, mut start, mut found) = (0, 0, Vec::new());
    for (at, letter) in text.char_indices() {
        match letter {
            '(' => depth += 1,
            ')' if depth > 0 => depth -= 1,
            ')' => {
                found.push(&text[start..at]);
                return (found, &text[at + 1..]);
            }
            ',' if depth == 0 => {
                found.push(&text[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    (found, "")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scripts_are_printed_and_their_operations_counted() {
        let routine = Routine {
            name: "f".into(),
            header: vec!["A function.".into()],
            arguments: vec![("place", Kind::Numbers(3)), ("planes", Kind::Planes(5))],
            result: Kind::Numbers(3),
            body: "var sum = 0.0
                each
                    set sum = max(sum, plane.x * place.x + plane.w)
                end
                part = choose(sum > 1.0, pow(sum, 2.5), choose(place.y > 0.0, 1.0, -1.0))
                give part | place.x / sum | 0.5"
                .into(),
        };
        // a fused product and max for each plane; two comparisons, two choices and a power; a reciprocal and a product
        assert_eq!(routine.operations().expect("arithmetic"), 5 * 2 + 4 + 9 + 5);
        // where long lines are broken is another test's
        let flat = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
        let rust = flat(&routine.print(Language::Rust));
        for line in [
            "pub fn f(place: [f32; 3], planes: &[[f32; 4]; 5]) -> [f32; 3] {",
            "        sum = f32::max(sum, plane[0] * place[0] + plane[3]);",
            "    let part = if sum > 1.0 { f32::powf(sum, 2.5) } else { if place[1] > 0.0 { 1.0 } else { -1.0 } };",
            "    [part, place[0] / sum, 0.5]",
        ] {
            assert!(rust.contains(&flat(line)), "{line}\n{rust}");
        }
        let c = flat(&routine.print(Language::C));
        for line in [
            "static inline lobefit_float3 f(lobefit_float3 place, const lobefit_float4 *planes) {",
            "        const lobefit_float4 plane = planes[i];",
            "    const float part = (sum > 1.0f ? powf(sum, 2.5f) : (place.y > 0.0f ? 1.0f : -1.0f));",
            "    const lobefit_float3 result = {part, place.x / sum, 0.5f};",
        ] {
            assert!(c.contains(&flat(line)), "{line}\n{c}");
        }
    }
}
