//! JSON to a typed object.

use std::cell::Cell;
use std::fmt;

use serde::de::{DeserializeOwned, DeserializeSeed, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use serde_json::value::RawValue;

use super::error::{Position, SceneError};
use super::text;
use super::value::{ObjectOnly, told};

/// An object of a file whose strings have at most `longest` bytes; `file` is its name in messages.
///
/// # Errors
/// What is no such object, with its place and field.
pub fn read_object<T: DeserializeOwned>(bytes: &[u8], file: &str, longest: usize) -> Result<T, SceneError> {
    let text = text::accept(bytes, file, longest)?;
    let mut json = serde_json::Deserializer::from_str(text);
    let mut track = serde_path_to_error::Track::new();
    let parsed = T::deserialize(ObjectOnly(serde_path_to_error::Deserializer::new(&mut json, &mut track)));
    let parsed = parsed.map_err(|e| field_error(&e, &track.path().to_string(), (file, text)))?;
    json.end().map_err(|e| field_error(&e, "", (file, text)))?;
    Ok(parsed)
}

fn position(error: &serde_json::Error) -> Position {
    Position { line: error.line().max(1), column: error.column().max(1) }
}

/// Where the value of a field, `culling.grid[0]`, stands in a text that was read: its end, of a list or
/// an object its beginning; none of a field that is absent.
pub fn place(text: &[u8], path: &str) -> Option<Position> {
    found(text, path).map(|value| value.at)
}

/// A value of a text.
struct Found {
    at: Position,
    is_object: bool,
}

fn found(text: &[u8], path: &str) -> Option<Found> {
    let steps: Vec<&str> = path.split(['.', '[', ']']).filter(|step| !step.is_empty()).collect();
    let mut json = serde_json::Deserializer::from_slice(text);
    let found = Cell::new(None);
    // The parser complains about what is left behind the value.
    let _ = Follow { steps: &steps, found: &found }.deserialize(&mut json);
    let value: &str = found.get()?;
    let start = value.as_ptr() as usize - text.as_ptr() as usize;
    let is_object = value.starts_with('{');
    let last = if is_object || value.starts_with('[') { start } else { start + value.len() - 1 };
    let line = text[..last].iter().filter(|byte| **byte == b'\n').count() + 1;
    let before = text[..last].iter().rposition(|byte| *byte == b'\n').map_or(0, |end| end + 1);
    Some(Found { at: Position { line, column: last - before + 1 }, is_object })
}

/// Follows steps through JSON to the value that they lead to.
#[derive(Clone, Copy)]
struct Follow<'s, 'de> {
    steps: &'s [&'s str],
    found: &'s Cell<Option<&'de str>>,
}

impl<'s, 'de> Follow<'s, 'de> {
    /// The first step and those behind it; an error where there is none.
    fn step<E: Error>(self) -> Result<(&'s str, Follow<'s, 'de>), E> {
        let (first, steps) = self.steps.split_first().ok_or_else(|| E::custom("here"))?;
        Ok((first, Follow { steps, ..self }))
    }
}

impl<'de> DeserializeSeed<'de> for Follow<'_, 'de> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        if self.steps.is_empty() {
            self.found.set(Some(<&RawValue>::deserialize(deserializer)?.get()));
            return Ok(());
        }
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Follow<'_, 'de> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object or a list")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        let (name, rest) = self.step()?;
        while let Some(key) = map.next_key::<String>()? {
            if key == name {
                return map.next_value_seed(rest);
            }
            map.next_value::<IgnoredAny>()?;
        }
        Ok(())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<(), A::Error> {
        let (index, rest) = self.step()?;
        let index: usize = index.parse().map_err(A::Error::custom)?;
        for _ in 0..index {
            if list.next_element::<IgnoredAny>()?.is_none() {
                return Ok(());
            }
        }
        list.next_element_seed(rest).map(|_| ())
    }
}

/// serde_json's error as ours: its place moved to the front.
fn field_error(error: &serde_json::Error, path: &str, (file, text): (&str, &str)) -> SceneError {
    let said = error.to_string();
    let suffix = format!(" at line {} column {}", error.line(), error.column());
    let message = said.strip_suffix(&suffix).unwrap_or(&said);
    let message = match message {
        "key must be a string" => {
            "object keys must be strings in double quotes (and a decimal is written with a point)"
        }
        "expected value" => {
            "expected a value: a number such as 0.9, a text in double quotes, a list, an object, true, false or null"
        }
        "trailing characters" => "the object has ended before this: is there a bracket too many?",
        other => other,
    };
    let message = message.replace("EOF while parsing", "the file ends inside");
    let message = &["usize", "u64"].iter().fold(message, |text, kind| {
        text.replace(&format!("expected {kind}"), "expected a whole number, 0 or above")
    });
    // serde_path_to_error ends a path with "?" where the reader stood between two fields.
    let path = path.strip_suffix(".?").unwrap_or(path);
    let (inner, message) = told(message);
    let path = match (path, inner) {
        (path, "") => path.into(),
        ("" | ".", inner) => inner.into(),
        (path, inner) => format!("{path}.{inner}"),
    };
    // Of a field that is judged with its neighbours, and of an object, the reader stood behind them all.
    let is_whole =
        error.is_data() && !["unknown field", "duplicate field"].iter().any(|m| message.starts_with(m));
    let own = found(text.as_bytes(), &path).filter(|value| !inner.is_empty() || is_whole && value.is_object);
    let at = own.map_or_else(|| position(error), |value| value.at);
    let meant = meant(message).map_or_else(String::new, |name| format!("; did you mean `{name}`?"));
    SceneError::Field { file: file.into(), at, path, message: format!("{message}{meant}") }
}

/// Of the names that a message lists after an unknown one, the one that is spelt like it.
fn meant(message: &str) -> Option<&str> {
    let mut names = message.strip_prefix("unknown ")?.split('`').skip(1).step_by(2);
    let given = names.next()?;
    let given = given.to_lowercase();
    let alike = names.map(|name| (strsim::jaro_winkler(&given, &name.to_lowercase()), name));
    // As clap does for options; a letter is like every word that begins with it.
    let alike = alike.filter(|(likeness, name)| *likeness > 0.7 && 2 * name.len() >= given.len());
    alike.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, name)| name)
}
