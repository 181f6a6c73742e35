//! How the languages write what scripts are made of.

use lobefit_shade::Kind;
use lobefit_shade::code::{Language, decimal};

/// A vector type of 2 to 4 floats, and the type of one.
pub(super) fn vector(language: Language, n: usize) -> String {
    language.kind(if n == 1 { Kind::Number } else { Kind::Vector(n as u8) })
}

/// Functions of lookups, with their names in C. All but exp2, log2 and pow are exact on every machine; the last
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

/// An expression of a shader's arithmetic in a language.
pub(super) fn expression(language: Language, text: &str) -> String {
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
pub(super) fn mentions(text: &str, word: &str) -> bool {
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
