//! The emitted code of a bake, item by item: what a function is made of, and how it is called.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::json;

use super::manifest::{Manifest, TableEntry};
use crate::store::{Files, MANIFEST};
use lobefit_shade::code::Language;

/// What a table's lookup fetches, by function: format and channels, which its code does not tell.
fn texels(manifest: &Manifest) -> BTreeMap<String, String> {
    let texel = |table: &TableEntry| {
        (table.function.clone(), format!("{:?} {}", table.format, json!(table.channels)))
    };
    manifest.entries.tables.iter().map(texel).collect()
}

/// The emitted WGSL of a bake, item by item.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Include {
    /// The whole text.
    pub text: String,
    /// Functions and structures by name, without comments.
    items: BTreeMap<String, String>,
    /// Texels of tables by the function that fetches them.
    texels: BTreeMap<String, String>,
}

impl Include {
    /// The WGSL among the files of a bake, the manifest among them; none where it emits none.
    pub fn of(files: &Files) -> Option<Include> {
        let manifest = files.get(MANIFEST).and_then(|bytes| Manifest::read(bytes).ok());
        Include::with(files, manifest.as_ref())
    }

    /// The same where the manifest is not yet a file.
    pub fn with(files: &Files, manifest: Option<&Manifest>) -> Option<Include> {
        let file = format!("fits/lobefit.{}", Language::Wgsl.extension());
        let text = String::from_utf8_lossy(files.get(&file)?).into_owned();
        Some(Include { texels: manifest.map(texels).unwrap_or_default(), ..Include::new(text) })
    }

    /// Of a text as this program prints it: items begin at the beginning of a line and end with a
    /// brace or `);` at one, or with a semicolon on their first line.
    pub fn new(text: String) -> Include {
        let mut items: BTreeMap<String, String> = BTreeMap::new();
        let mut inside: Option<String> = None;
        for line in text.lines().filter(|line| !line.trim_start().starts_with("//")) {
            let name =
                ["fn ", "struct ", "const "].iter().find_map(|word| line.strip_prefix(word)).map(first_word);
            if let Some(name) = name {
                inside = Some(name.to_owned());
            }
            if let Some(name) = &inside {
                let item = items.entry(name.clone()).or_default();
                item.push_str(line);
                item.push('\n');
            }
            if line == "}" || line == ");" || name.is_some() && line.ends_with(';') {
                inside = None;
            }
        }
        Include { text, items, texels: BTreeMap::new() }
    }

    /// The code of a function and of all that it names, without comments; none where there is no
    /// such function.
    pub fn code(&self, function: &str) -> Option<String> {
        let mut needed = BTreeSet::new();
        let mut pending = vec![self.items.get_key_value(function)?];
        while let Some((name, text)) = pending.pop() {
            if needed.insert(name) {
                pending.extend(words(text).filter_map(|word| self.items.get_key_value(word)));
            }
        }
        Some(needed.into_iter().filter_map(|name| self.items.get(name)).map(String::as_str).collect())
    }

    /// Hash of [`Include::code`], and of the texels where the function fetches from a table.
    pub fn hash(&self, function: &str) -> Option<String> {
        let code = self.code(function)? + self.texels.get(function).map_or("", String::as_str);
        Some(blake3::hash(code.as_bytes()).to_hex().to_string())
    }
}

fn first_word(text: &str) -> &str {
    words(text).next().unwrap_or_default()
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').filter(|word| !word.is_empty())
}

/// How a function is called.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Called {
    /// The line.
    pub call: String,
    /// The names of what it is called with.
    pub arguments: Vec<String>,
    /// What it is called with, as the include file declares it.
    pub parameters: String,
}

/// A line that calls a function with the arguments that an include file declares:
/// `let value = ggx_average_albedo(roughness);`. None where the file does not declare it.
pub fn call(text: &str, function: &str) -> Option<Called> {
    let head = format!(" {function}(");
    let start = text.match_indices(&head).map(|(at, _)| at).find(|&at| {
        let line = text[..at].rfind('\n').map_or(0, |end| end + 1);
        text[line..].starts_with(|c: char| c.is_ascii_alphabetic())
    })?;
    let line = text[..start].rfind('\n').map_or(0, |end| end + 1);
    let rest = &text[start + head.len()..];
    let mut depth = 1;
    let end = rest.find(|c: char| {
        depth += i32::from("([<".contains(c)) - i32::from(")]>".contains(c));
        depth == 0
    })?;
    let parameters = parts(&rest[..end]);
    let arguments: Vec<String> = parameters.iter().map(|part| named(part).to_string()).collect();
    let call = format!("{function}({})", arguments.join(", "));
    let result = text[line..start].rsplit(' ').next().unwrap_or_default();
    let word = if typed_after(result) { "let" } else { result };
    Some(Called { call: format!("{word} value = {call};"), arguments, parameters: parameters.join(", ") })
}

/// Whether types stand after names: whether this word is before the name of a function.
fn typed_after(word: &str) -> bool {
    word == "fn"
}

/// Parameters between commas that no bracket holds.
fn parts(text: &str) -> Vec<&str> {
    let mut depth = 0;
    let inside = move |c: char| {
        depth += i32::from("([<".contains(c)) - i32::from(")]>".contains(c));
        c == ',' && depth == 0
    };
    text.split(inside).map(str::trim).filter(|part| !part.is_empty()).collect()
}

/// The name of a declared parameter.
fn named(parameter: &str) -> &str {
    match parameter.split_once(':') {
        Some((name, _)) => name.trim(),
        None => parameter.rsplit([' ', '*']).next().unwrap_or_default(),
    }
}
