//! Who made a bake, and from what: tool, command and recipe, which every file names, and the names of a
//! scene. The hash of the scene stays where more than names changed: it is another scene.

use std::borrow::Cow;
use std::collections::BTreeSet;

use serde::Deserialize;
use serde_json::Value;

use crate::store::{Files, MANIFEST};

/// The provenance that a manifest states.
#[derive(Deserialize)]
struct Provenance {
    tool: String,
    #[serde(default)]
    command: String,
    recipe: String,
    scene: String,
    made_from: Value,
}

/// What stands in the found files, and what the recipe writes in its place.
#[derive(Default)]
pub struct Restated {
    /// Anywhere.
    words: Vec<(String, String)>,
    /// In lines that are equal but for them: as short as names may be, they stand in other words.
    names: Vec<(String, String)>,
}

impl Restated {
    /// The provenance of `found` for that of `expected`; nothing where a manifest does not state
    /// it.
    pub fn new(expected: &Files, found: &Files) -> Restated {
        let (Some(new), Some(old)) = (read(expected), read(found)) else { return Restated::default() };
        let mut names = Vec::new();
        if !renamed(&old.made_from, &new.made_from, &mut names) {
            names.clear();
        }
        let mut pairs = vec![(old.recipe, new.recipe), (old.command, new.command)];
        // Headers name the tool with its version, the data of the report its version alone.
        if let (Some((_, a)), Some((_, b))) = (old.tool.split_once(' '), new.tool.split_once(' ')) {
            pairs.push((format!("\"tool\": \"{a}\""), format!("\"tool\": \"{b}\"")));
        }
        pairs.push((old.tool, new.tool));
        pairs.extend((!names.is_empty()).then_some((old.scene, new.scene)));
        // An empty text stands everywhere.
        pairs.retain(|(old, new)| old != new && !old.is_empty());
        Restated { words: pairs, names }
    }

    /// A found file as the recipe's tool would have signed it, with the names of its scene. Images
    /// stay: their headers are judged apart from their texels.
    pub fn apply<'a>(&self, bytes: &'a [u8], expected: &[u8]) -> Cow<'a, [u8]> {
        let (Ok(text), Ok(expected)) = (std::str::from_utf8(bytes), std::str::from_utf8(expected)) else {
            return Cow::Borrowed(bytes);
        };
        if !self.names.is_empty() || self.words.iter().any(|(old, _)| text.contains(old)) {
            let mut text = self.words.iter().fold(text.to_owned(), |text, (old, new)| text.replace(old, new));
            if !self.names.is_empty() && text.lines().count() == expected.lines().count() {
                let line = |(found, expected)| if self.same(found, expected) { expected } else { found };
                let lines = text.split_inclusive('\n').zip(expected.split_inclusive('\n')).map(line);
                text = lines.collect();
            }
            return Cow::Owned(text.into_bytes());
        }
        Cow::Borrowed(bytes)
    }

    /// Whether two lines are equal but for the names: of the places in both that are reached by
    /// equal bytes and by pairs of names, the first is taken on, until the ends are.
    fn same(&self, found: &str, expected: &str) -> bool {
        let (found, expected) = (found.as_bytes(), expected.as_bytes());
        let mut reached = BTreeSet::from([(0, 0)]);
        while let Some((i, j)) = reached.pop_first() {
            if (i, j) == (found.len(), expected.len()) {
                return true;
            }
            let (found, expected) = (&found[i..], &expected[j..]);
            if !found.is_empty() && found.first() == expected.first() {
                reached.insert((i + 1, j + 1));
            }
            let both = |(old, new): &&(String, String)| {
                found.starts_with(old.as_bytes()) && expected.starts_with(new.as_bytes())
            };
            reached.extend(self.names.iter().filter(both).map(|(old, new)| (i + old.len(), j + new.len())));
        }
        false
    }
}

/// Whether two scenes are equal but for the values of `name`, which are gathered as they stand in
/// JSON where they differ.
fn renamed(old: &Value, new: &Value, names: &mut Vec<(String, String)>) -> bool {
    match (old, new) {
        (Value::Object(a), Value::Object(b)) => {
            a.len() == b.len()
                && a.iter().all(|(key, old)| match (old, b.get(key)) {
                    (Value::String(_), Some(new @ Value::String(_))) if key == "name" => {
                        let words = [old, new].map(|name| name.to_string().trim_matches('"').to_owned());
                        names.extend((old != new).then(|| words.into()));
                        true
                    }
                    (_, Some(new)) => renamed(old, new, names),
                    (_, None) => false,
                })
        }
        (Value::Array(a), Value::Array(b)) => {
            a.len() == b.len() && a.iter().zip(b).all(|(old, new)| renamed(old, new, names))
        }
        _ => old == new,
    }
}

fn read(files: &Files) -> Option<Provenance> {
    serde_json::from_slice(files.get(MANIFEST)?).ok()
}
