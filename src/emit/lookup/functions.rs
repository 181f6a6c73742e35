//! The functions of a table that all languages have alike: its coordinates and its decoding.

use super::{LETTERS, Readable, comment, coordinates, decoding};
use crate::emit::spelling::{argument, declare, expression, finish, head, part, unused, vector};
use lobefit_shade::code::Language;

/// The functions of a table in a language.
pub(super) fn print(readable: &Readable, language: Language) -> String {
    let [coordinates, decode] = [coordinate_function, decode_function].map(|f| f(readable, language));
    let lookup = match language {
        Language::Rust => super::rust::lookup(readable),
        Language::C => super::c::lookup(readable),
        Language::Wgsl | Language::Hlsl | Language::Glsl | Language::Msl => {
            super::sampled::lookup(readable, language)
        }
    };
    format!("{}{coordinates}\n{decode}\n{lookup}", comment("///", readable.header))
}

/// Declarations of the arguments that are numbers.
pub(super) fn numbers(language: Language, names: &[&str]) -> Vec<String> {
    names.iter().map(|name| argument(language, name, &vector(language, 1))).collect()
}

/// Lines that name values.
fn named(language: Language, values: &[(String, String)]) -> String {
    let number = vector(language, 1);
    values
        .iter()
        .map(|(name, value)| declare(language, &number, name, &expression(language, value)))
        .collect()
}

fn coordinate_function(readable: &Readable, language: Language) -> String {
    let (name, axes) = (readable.identifier(), &readable.table.axes);
    let (letters, arguments) = (&LETTERS[..axes.len()], readable.coordinate_arguments());
    let (suffix, result) = (letters.concat(), vector(language, axes.len()));
    let body = named(language, &coordinates(axes));
    let head = head(language, &format!("{name}_{suffix}"), &numbers(language, &arguments), &result);
    let values: Vec<String> = letters.iter().map(ToString::to_string).collect();
    format!("{head}{}{body}{}", unused(language, &arguments, &body), finish(language, &suffix, &values))
}

fn decode_function(readable: &Readable, language: Language) -> String {
    let (name, channels) = (readable.identifier(), readable.decode.channels());
    let channel = |i: usize| if channels == 1 { "texel".into() } else { part(language, "texel", i) };
    let body = decoding::body(readable.decode, channel);
    let arguments = readable.decode_arguments();
    let texel = argument(language, "texel", &vector(language, channels));
    let all = [vec![texel], numbers(language, &arguments)].concat();
    let lets = named(language, &body.lets);
    let values: Vec<String> = body.values.iter().map(|value| expression(language, value)).collect();
    let result = vector(language, values.len());
    let head = head(language, &format!("{name}_decode"), &all, &result);
    let unused = unused(language, &arguments, &format!("{lets}{}", values.join(", ")));
    let end = finish(language, "values", &values);
    format!("/// {} from a texel of the table above.\n{head}{unused}{lets}{end}", body.meaning)
}
