//! JSON to a typed object.

use serde::de::DeserializeOwned;

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
    let parsed = parsed.map_err(|e| field_error(&e, &track.path().to_string(), file))?;
    json.end().map_err(|e| field_error(&e, "", file))?;
    Ok(parsed)
}

/// serde_json's error as ours: its place moved to the front.
fn field_error(error: &serde_json::Error, path: &str, file: &str) -> SceneError {
    let at = Position { line: error.line().max(1), column: error.column().max(1) };
    let text = error.to_string();
    let suffix = format!(" at line {} column {}", error.line(), error.column());
    let message = text.strip_suffix(&suffix).unwrap_or(&text);
    let message = match message {
        "key must be a string" => "object keys must be strings in double quotes",
        other => other,
    };
    let message = &["usize", "u64"].iter().fold(message.to_string(), |text, kind| {
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
    let meant = meant(message).map_or_else(String::new, |name| format!("; did you mean `{name}`?"));
    SceneError::Field { file: file.into(), at, path, message: format!("{message}{meant}") }
}

/// Of the names that a message lists after an unknown one, the one that is spelt like it.
fn meant(message: &str) -> Option<&str> {
    let mut names = message.strip_prefix("unknown ")?.split('`').skip(1).step_by(2);
    let given = names.next()?;
    let given = given.to_lowercase();
    let alike = names.map(|name| (strsim::jaro_winkler(&given, &name.to_lowercase()), name));
    // As clap does for options.
    let alike = alike.filter(|(likeness, _)| *likeness > 0.7);
    alike.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, name)| name)
}
