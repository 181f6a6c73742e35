//! Who made a bake, and from what: tool and recipe, which every file names. The hash of the scene
//! stays: a scene that changed is another.

use std::borrow::Cow;

use serde::Deserialize;

use crate::store::{Files, MANIFEST};

/// The provenance that a manifest states.
#[derive(Deserialize)]
struct Provenance {
    tool: String,
    recipe: String,
}

/// What stands in the found files, and what the recipe writes in its place.
pub struct Restated(Vec<(String, String)>);

impl Restated {
    /// The provenance of `found` for that of `expected`; nothing where a manifest does not state
    /// it.
    pub fn new(expected: &Files, found: &Files) -> Restated {
        let (Some(new), Some(old)) = (read(expected), read(found)) else { return Restated(Vec::new()) };
        let mut pairs = vec![(old.recipe, new.recipe)];
        // Headers name the tool with its version, the data of the report its version alone.
        if let (Some((_, a)), Some((_, b))) = (old.tool.split_once(' '), new.tool.split_once(' ')) {
            pairs.push((format!("\"tool\": \"{a}\""), format!("\"tool\": \"{b}\"")));
        }
        pairs.push((old.tool, new.tool));
        // An empty text stands everywhere.
        pairs.retain(|(old, new)| old != new && !old.is_empty());
        Restated(pairs)
    }

    /// A found file as the recipe's tool would have signed it. Images stay: their headers are
    /// judged apart from their texels.
    pub fn apply<'a>(&self, bytes: &'a [u8]) -> Cow<'a, [u8]> {
        match std::str::from_utf8(bytes) {
            Ok(text) if self.0.iter().any(|(old, _)| text.contains(old)) => {
                let restated = self.0.iter().fold(text.to_owned(), |text, (old, new)| text.replace(old, new));
                Cow::Owned(restated.into_bytes())
            }
            _ => Cow::Borrowed(bytes),
        }
    }
}

fn read(files: &Files) -> Option<Provenance> {
    serde_json::from_slice(files.get(MANIFEST)?).ok()
}
