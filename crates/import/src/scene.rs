//! The JSON of a scene, as one would write it by hand.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use super::Imported;
use super::note::{About, Notes, Said};

/// Longest name of a material, in characters.
const NAME: usize = 64;

/// Fields of an object in their order.
pub(crate) type Fields = Vec<(&'static str, Value)>;

/// A material of the scene: its kind, and its fields but the name, in the order of a scene.
#[derive(Debug)]
pub(crate) struct Part {
    pub kind: &'static str,
    pub fields: Fields,
}

/// What a material becomes: a metal, a dielectric, glass, several of them, or nothing.
#[derive(Debug, Default)]
pub(crate) struct Parts {
    pub parts: Vec<Part>,
    pub said: Said,
}

/// A scene that grows by its materials.
#[derive(Default)]
pub(crate) struct Writer {
    lines: Vec<String>,
    notes: Notes,
    names: BTreeMap<String, usize>,
}

impl Writer {
    /// Adds a material of the file. Where it is several of the scene, the kind stands in their names.
    pub fn add(&mut self, given: &str, index: usize, found: Parts) {
        let name = self.free(&name(given, index));
        let alone = found.parts.len() == 1;
        for Part { kind, fields } in found.parts {
            let name = if alone { name.clone() } else { self.free(&format!("{name} ({kind})")) };
            let all = [("name", json!(name)), ("kind", json!(kind))].into_iter().chain(fields);
            let all: Vec<String> = all.map(|(key, value)| format!("\"{key}\": {value}")).collect();
            self.lines.push(format!("    {{ {} }}", all.join(", ")));
        }
        for said in found.said.0 {
            self.notes.add(said, Some(&name));
        }
    }

    /// Says something of the file, or of what it names.
    pub fn note(&mut self, about: About, text: String, of: Option<&str>) {
        self.notes.add((about, text, None), of);
    }

    pub fn finish(self) -> Imported {
        let scene =
            if self.lines.is_empty() { String::new() } else { format!("\n{}\n  ", self.lines.join(",\n")) };
        let json = format!("{{\n  \"schema_version\": 1,\n  \"materials\": [{scene}]\n}}\n");
        Imported { json, notes: self.notes.finish() }
    }

    /// A name that no other material has, which is then taken; of each name the last number that was
    /// tried.
    fn free(&mut self, name: &str) -> String {
        let mut tried = self.names.get(name).copied().unwrap_or_default();
        let mut free = name.to_string();
        while self.names.contains_key(&free) {
            tried += 1;
            free = format!("{name} {}", tried + 1);
        }
        self.names.insert(name.to_string(), tried);
        self.names.entry(free.clone()).or_default();
        free
    }
}

/// What a scene may call a material: its name without control characters, or by its number.
fn name(given: &str, index: usize) -> String {
    let text: String = given.trim().chars().filter(|c| !c.is_control()).take(NAME).collect();
    if text.trim().is_empty() { format!("material {index}") } else { text }
}

/// A range, or a number where both ends are equal.
pub(crate) fn span(range: [f64; 2]) -> Value {
    let range = range.map(tidy);
    if range[0] == range[1] { json!(range[0]) } else { json!(range) }
}

/// A derived number without the digits of its rounding.
pub(crate) fn tidy(x: f64) -> f64 {
    (x * 1e9).round() / 1e9
}
