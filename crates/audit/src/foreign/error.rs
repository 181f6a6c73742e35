//! What can be wrong with somebody else's file.

use std::fmt::{self, Display};

use lobefit::cli::{CliError, PackageError};

/// A place in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Spot {
    /// Offset from the start, bytes.
    Byte(u64),
    /// Line and column of a text, both from 1; columns count characters.
    Line { line: usize, column: usize },
}

impl Spot {
    /// The place of byte `at` of a text.
    pub fn of(text: &str, at: usize) -> Spot {
        let mut at = at.min(text.len());
        while !text.is_char_boundary(at) {
            at -= 1;
        }
        let start = text[..at].rfind('\n').map_or(0, |i| i + 1);
        let line = text[..at].matches('\n').count() + 1;
        Spot::Line { line, column: text[start..at].chars().count() + 1 }
    }
}

impl Display for Spot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Spot::Byte(offset) => write!(f, "byte {offset}"),
            Spot::Line { line, column } => write!(f, "{line}:{column}"),
        }
    }
}

/// A file that cannot be read as a table or as shader functions.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{file}{place}: {message}")]
pub struct ForeignError {
    /// File as the caller named it.
    pub file: String,
    /// Where in it, as it is printed after the file: a byte, line and column, or an array or layer.
    pub place: String,
    /// What is wrong, and what to do.
    pub message: String,
}

impl ForeignError {
    /// Of a whole file.
    pub(super) fn new(file: &str, message: impl Into<String>) -> ForeignError {
        ForeignError { file: file.into(), place: String::new(), message: message.into() }
    }

    /// At a place of it.
    pub(super) fn at(file: &str, at: Spot, message: impl Into<String>) -> ForeignError {
        ForeignError { place: format!(": {at}"), ..ForeignError::new(file, message) }
    }

    /// Of an array or layer, if it has a name.
    pub(super) fn of(file: &str, name: &str, message: impl Into<String>) -> ForeignError {
        let place = if name.is_empty() { String::new() } else { format!(", {name}") };
        ForeignError { place, ..ForeignError::new(file, message) }
    }

    /// Values in another number than is stated or can be.
    pub(super) fn size(file: &str, name: &str, found: usize, message: &str) -> ForeignError {
        ForeignError::of(file, name, format!("{found} values, which {message}"))
    }

    /// More than a limit allows; nothing was allocated for it.
    pub(super) fn too_large(
        file: &str,
        what: &str,
        found: impl Display,
        limit: impl Display,
    ) -> ForeignError {
        ForeignError::new(file, format!("{what}: {found}, the limit is {limit}"))
    }

    /// A kind of file, or of what is in it, that is known and not read.
    pub(super) fn unsupported(file: &str, at: Spot, what: &str, advice: &str) -> ForeignError {
        ForeignError::at(file, at, format!("{what} is not read: {advice}"))
    }

    /// Integers whose meaning is not stated and cannot be told.
    pub(super) fn encoding(file: &str, at: Spot, name: &str, message: &str) -> ForeignError {
        ForeignError::at(
            file,
            at,
            format!("{name}: {message}: state the format, one of f16, f32, unorm8, unorm16"),
        )
    }

    /// The same with what else is to be known.
    pub(super) fn beside(self, more: &str) -> ForeignError {
        ForeignError { message: format!("{}; {more}", self.message), ..self }
    }

    /// An array, layer or function that is asked for by name and is not there, or may be one of
    /// several.
    pub(super) fn no_such(file: &str, what: &str, name: &str, known: &[String]) -> ForeignError {
        let known = known.join(", ");
        ForeignError::new(file, format!("{what} {name} is not there; the file has {known}"))
    }
}

/// The text of a file's bytes, without a byte order mark.
pub(super) fn text<'a>(bytes: &'a [u8], file: &str, what: &str) -> Result<&'a str, ForeignError> {
    let text = std::str::from_utf8(bytes).map_err(|e| {
        let message = format!("these bytes are not UTF-8: save the {what} as UTF-8");
        ForeignError::at(file, Spot::Byte(e.valid_up_to() as u64), message)
    })?;
    Ok(text.strip_prefix('\u{feff}').unwrap_or(text))
}

impl PackageError for ForeignError {}

impl From<ForeignError> for CliError {
    fn from(error: ForeignError) -> CliError {
        CliError::Package(Box::new(error))
    }
}
