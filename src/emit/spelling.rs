//! How the languages write what the functions of tables and compensations are made of.

use lobefit_shade::code::{Language, decimal};

/// A vector type of 2 to 4 floats, and the type of one.
pub(crate) fn vector(language: Language, n: usize) -> String {
    match (language, n) {
        (Language::Rust | Language::Wgsl, 1) => "f32".into(),
        (_, 1) => "float".into(),
        (Language::Rust, n) => format!("[f32; {n}]"),
        (Language::Wgsl, n) => format!("vec{n}<f32>"),
        (Language::Glsl, n) => format!("vec{n}"),
        (Language::Hlsl | Language::Msl, n) => format!("float{n}"),
        (Language::C, n) => format!("lobefit_float{n}"),
    }
}

/// Channel `i` of a vector.
pub(crate) fn part(language: Language, vector: &str, i: usize) -> String {
    match language {
        Language::Rust => format!("{vector}[{i}]"),
        _ => format!("{vector}.{}", &"xyzw"[i..=i]),
    }
}

/// An argument with its type.
pub(crate) fn argument(language: Language, name: &str, kind: &str) -> String {
    match language {
        Language::Rust | Language::Wgsl => format!("{name}: {kind}"),
        // The star of a pointer stands at the name.
        _ if kind.ends_with('*') => format!("{kind}{name}"),
        _ => format!("{kind} {name}"),
    }
}

/// Longest line before arguments or values get lines of their own.
const WIDTH: usize = 120;

/// The lines that open a function.
pub(crate) fn head(language: Language, name: &str, arguments: &[String], result: &str) -> String {
    let (start, end) = match language {
        Language::Rust => (format!("pub fn {name}("), format!(") -> {result} {{\n")),
        Language::Wgsl => (format!("fn {name}("), format!(") -> {result} {{\n")),
        Language::Hlsl | Language::Glsl => (format!("{result} {name}("), ") {\n".into()),
        Language::Msl => (format!("inline {result} {name}("), ") {\n".into()),
        Language::C => (format!("static inline {result} {name}("), ") {\n".into()),
    };
    within(&start, arguments, &end, "")
}

/// A list in one line, or one item in each, between lines that are indented by `indent`.
fn within(start: &str, list: &[String], end: &str, indent: &str) -> String {
    let line = format!("{start}{}{end}", list.join(", "));
    if line.len() <= WIDTH {
        return line;
    }
    format!("{start}\n{indent}    {}\n{indent}{end}", list.join(&format!(",\n{indent}    ")))
}

/// The line that names a value of a type.
pub(crate) fn declare(language: Language, kind: &str, name: &str, value: &str) -> String {
    match language {
        Language::Rust | Language::Wgsl => format!("    let {name} = {value};\n"),
        Language::Glsl => format!("    {kind} {name} = {value};\n"),
        Language::Hlsl | Language::Msl | Language::C => format!("    const {kind} {name} = {value};\n"),
    }
}

/// The lines that return a number or a vector of numbers, which C gives the name `name`.
pub(crate) fn finish(language: Language, name: &str, values: &[String]) -> String {
    let kind = vector(language, values.len());
    let (start, end) = match (language, values.len()) {
        (Language::Rust, 1) => ("    ".into(), "\n".into()),
        (Language::Rust, _) => ("    [".into(), "]\n".into()),
        (_, 1) => ("    return ".into(), ";\n".into()),
        // C++ has no compound literals.
        (Language::C, _) => (format!("    const {kind} {name} = {{"), format!("}};\n    return {name};\n")),
        _ => (format!("    return {kind}("), ");\n".into()),
    };
    within(&start, values, &end, "    ") + "}\n"
}

/// The lines that use the arguments which a body does not mention, where compilers ask for it.
pub(crate) fn unused(language: Language, arguments: &[&str], body: &str) -> String {
    let line = |name: &&str| match language {
        Language::Rust => format!("    let _ = {name};\n"),
        Language::C => format!("    (void){name};\n"),
        _ => String::new(),
    };
    arguments.iter().filter(|name| !mentions(body, name)).map(line).collect()
}

/// Functions of coordinates, decodings and lookups, with their names in C. All but exp2, log2 and pow are exact on every machine; the last
/// bits of those are the machine's.
const FUNCTIONS: [(&str, &str); 7] = [
    ("sqrt", "sqrtf"),
    ("abs", "fabsf"),
    ("min", "fminf"),
    ("max", "fmaxf"),
    ("exp2", "exp2f"),
    ("log2", "log2f"),
    ("pow", "powf"),
];

/// An expression of a shader's arithmetic, as [`crate::data::Axis::expression`] writes it, in a language.
pub(crate) fn expression(language: Language, text: &str) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let length = token(rest, first);
        let (word, after) = rest.split_at(length);
        out.push_str(&spelled(language, word));
        rest = after;
    }
    out
}

/// Length of the name, the literal or the other character that a text begins with.
fn token(text: &str, first: char) -> usize {
    let within = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '.';
    if !within(first) {
        return first.len_utf8();
    }
    let mut end = text.find(|c| !within(c)).unwrap_or(text.len());
    // 1e-6
    if first.is_ascii_digit() && text[..end].ends_with('e') && text[end..].starts_with('-') {
        end += 1 + text[end + 1..].find(|c| !within(c)).unwrap_or(text.len() - end - 1);
    }
    end
}

fn spelled(language: Language, word: &str) -> String {
    let function = FUNCTIONS.iter().find(|(name, _)| *name == word);
    match (language, function, word.parse::<f32>()) {
        (Language::Rust, Some(("pow", name)), _) => format!("f32::{name}"),
        (Language::Rust, Some(_), _) => format!("f32::{word}"),
        (Language::C, Some((_, name)), _) => name.to_string(),
        (Language::Hlsl | Language::Msl | Language::C, None, Ok(x)) => format!("{}f", decimal(x)),
        (Language::Wgsl | Language::Glsl, None, Ok(x)) => decimal(x),
        (Language::Rust, None, Err(_)) => match word.split_once('.') {
            Some((vector, part)) => format!("{vector}[{}]", "xyzw".find(part).unwrap_or_default()),
            None => word.to_string(),
        },
        _ => word.to_string(),
    }
}

/// Whether a text holds a word.
pub(crate) fn mentions(text: &str, word: &str) -> bool {
    text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').any(|w| w == word)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn expressions_are_spelled() {
        let text = "sqrt(max(r_min2 - 1.05, 0.0)) / max(-log2(q), 1e-6)";
        for (language, expected) in [
            (Language::Rust, "f32::sqrt(f32::max(r_min2 - 1.05, 0.0)) / f32::max(-f32::log2(q), 1e-6)"),
            (Language::Glsl, "sqrt(max(r_min2 - 1.05, 0.0)) / max(-log2(q), 1e-6)"),
            (Language::Hlsl, "sqrt(max(r_min2 - 1.05f, 0.0f)) / max(-log2(q), 1e-6f)"),
            (Language::C, "sqrtf(fmaxf(r_min2 - 1.05f, 0.0f)) / fmaxf(-log2f(q), 1e-6f)"),
        ] {
            assert_eq!(expression(language, text), expected);
        }
    }
}
