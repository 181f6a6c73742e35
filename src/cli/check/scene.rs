//! What changed in a scene since the bake that is checked.

use serde::Deserialize;
use serde_json::Value;

use crate::scene::Output;
use crate::store::{Files, MANIFEST};

/// Most changes that are named.
const NAMED: usize = 5;

/// How the change begins where the bake has no pages and the scene asks for them.
pub(super) const PAGES: &str = "reports: false became";

/// What a manifest states of its scene; the rest of it is not kept.
#[derive(Deserialize)]
struct Stated {
    #[serde(default)]
    scene: Value,
    #[serde(default)]
    made_from: Value,
}

/// The changes from the scene of the manifest among `found` to that of the manifest among `baked`,
/// as `materials[0].roughness[0]: 0.05 became 0.1`; none where a manifest does not hold its scene.
pub(super) fn changes(found: &Files, baked: &Files) -> Vec<String> {
    let manifest = |files: &Files| -> Option<Stated> { serde_json::from_slice(files.get(MANIFEST)?).ok() };
    let (Some(old), Some(new)) = (manifest(found), manifest(baked)) else { return Vec::new() };
    // An edited copy of the scene beside the same hash is a difference like any other.
    if old.scene == new.scene || !old.made_from.is_object() {
        return Vec::new();
    }
    let mut all = Vec::new();
    compare("", &whole(&old.made_from), &whole(&new.made_from), &mut all);
    // Its own object in the manifest, and fields of the scene in a file.
    all.iter_mut().for_each(|change| *change = change.trim_start_matches("output.").to_string());
    if all.len() > NAMED {
        let more = all.len() - NAMED;
        all.truncate(NAMED);
        all.push(format!("and {more} more"));
    }
    all
}

/// A scene with what it leaves out where nothing was asked for.
fn whole(scene: &Value) -> Value {
    let mut scene = scene.clone();
    if let (Value::Object(fields), Ok(output)) = (&mut scene, serde_json::to_value(Output::default())) {
        fields.entry("output").or_insert(output);
    }
    scene
}

fn compare(path: &str, old: &Value, new: &Value, all: &mut Vec<String>) {
    let absent = Value::Null;
    match (old, new) {
        (Value::Object(a), Value::Object(b)) => {
            // The reflectance of what has an index of refraction follows from it.
            let index = [a, b].map(|fields| fields.get("ior").unwrap_or(&absent));
            let follows = |key: &str| key == "f0" && index[0] != index[1] && !index[1].is_null();
            let more = b.keys().filter(|key| !a.contains_key(*key));
            for key in a.keys().chain(more).filter(|key| !follows(key)) {
                let dot = if path.is_empty() { "" } else { "." };
                let (old, new) = (a.get(key).unwrap_or(&absent), b.get(key).unwrap_or(&absent));
                compare(&format!("{path}{dot}{key}"), old, new, all);
            }
        }
        (Value::Array(a), Value::Array(b)) if is_one_change(a, b) => {
            all.push(format!("{path}: {} became {}", figures(a), figures(b)));
        }
        (Value::Array(a), Value::Array(b)) if a.iter().chain(b).all(Value::is_string) => {
            words(path, a, b, all);
        }
        (Value::Array(a), Value::Array(b)) => {
            for i in 0..a.len().max(b.len()) {
                let (old, new) = (a.get(i).unwrap_or(&absent), b.get(i).unwrap_or(&absent));
                compare(&format!("{path}[{i}]"), old, new, all);
            }
        }
        (old, new) if old == new => {}
        (Value::Null, new) => all.push(format!("{path}: {} is new", shown(new))),
        (old, Value::Null) => all.push(format!("{path}: {} is gone", shown(old))),
        (old, new) => all.push(format!("{path}: {} became {}", shown(old), shown(new))),
    }
}

/// What is gone from a list of words, `languages`, and what is new in it, or else that their order is
/// another: of words that are left the places mean nothing.
fn words(path: &str, old: &[Value], new: &[Value], all: &mut Vec<String>) {
    let known = all.len();
    all.extend(old.iter().filter(|word| !new.contains(word)).map(|word| format!("{path}: {word} is gone")));
    all.extend(new.iter().filter(|word| !old.contains(word)).map(|word| format!("{path}: {word} is new")));
    if all.len() == known && old != new {
        let [old, new] = [old, new].map(|list| Value::Array(list.to_vec()).to_string());
        all.push(format!("{path}: {old} became {new}"));
    }
}

/// Whether several of as many numbers changed: those of one colour, or both ends of a range.
fn is_one_change(old: &[Value], new: &[Value]) -> bool {
    let figures = old.len() == new.len() && old.iter().chain(new).all(Value::is_number);
    figures && old.iter().zip(new).filter(|(old, new)| old != new).count() > 1
}

/// A list of numbers, or the number that all of them are.
fn figures(list: &[Value]) -> String {
    match list {
        [first, rest @ ..] if rest.iter().all(|other| other == first) => first.to_string(),
        _ => Value::Array(list.to_vec()).to_string(),
    }
}

/// A value in a few characters: of an object its name.
fn shown(value: &Value) -> String {
    match value {
        Value::Object(fields) => match fields.get("name") {
            Some(name) => name.to_string(),
            None => "an object".into(),
        },
        Value::Array(items) => format!("a list of {}", items.len()),
        value => value.to_string(),
    }
}
