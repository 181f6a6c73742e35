//! What can be wrong with somebody else's file.

use std::fmt;

use lobefit::cli::{CliError, PackageError};

/// A place in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spot {
    /// Offset from the start, bytes.
    Byte(u64),
    /// Line and column of a text, both from 1; columns count characters.
    Line {
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
    },
}

/// How many more there are, as the sentence goes on.
fn others(count: usize) -> String {
    match count {
        0 => ", the only one".into(),
        1 => ", nor is 1 other".into(),
        n => format!(", nor are {n} others"),
    }
}

impl Spot {
    /// The place of byte `at` of a text.
    pub(super) fn of(text: &str, at: usize) -> Spot {
        let mut at = at.min(text.len());
        while !text.is_char_boundary(at) {
            at -= 1;
        }
        let start = text[..at].rfind('\n').map_or(0, |i| i + 1);
        let line = text[..at].matches('\n').count() + 1;
        Spot::Line { line, column: text[start..at].chars().count() + 1 }
    }
}

impl fmt::Display for Spot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Spot::Byte(offset) => write!(f, "byte {offset}"),
            Spot::Line { line, column } => write!(f, "{line}:{column}"),
        }
    }
}

/// A file that cannot be read as a table or as shader functions.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ForeignError {
    /// The file has no bytes.
    #[error("{file}: the file is empty")]
    Empty {
        /// File as the caller named it.
        file: String,
    },
    /// Neither the first bytes nor the name tell what the file is.
    #[error("{file}: {message}")]
    Unknown {
        /// File as the caller named it.
        file: String,
        /// What was looked for, and what to do.
        message: String,
    },
    /// More than a limit allows; nothing was allocated for it.
    #[error("{file}: {what}: {found}, the limit is {limit}")]
    TooLarge {
        /// File as the caller named it.
        file: String,
        /// What is too large.
        what: String,
        /// Size found or claimed.
        found: u128,
        /// Largest size allowed.
        limit: u128,
    },
    /// The file ends before what it announces.
    #[error("{file}: {at}: {what} would take {needed} bytes, {found} are left: the file is cut short")]
    Truncated {
        /// File as the caller named it.
        file: String,
        /// Where the missing part begins.
        at: Spot,
        /// What is missing.
        what: String,
        /// Bytes that it takes.
        needed: u64,
        /// Bytes that there are.
        found: u64,
    },
    /// The file contradicts its format.
    #[error("{file}: {at}: {message}")]
    Malformed {
        /// File as the caller named it.
        file: String,
        /// Where.
        at: Spot,
        /// What is wrong.
        message: String,
    },
    /// A kind of file that is known and not read.
    #[error("{file}: {at}: {what} is not read: {advice}")]
    Unsupported {
        /// File as the caller named it.
        file: String,
        /// Where the file says so.
        at: Spot,
        /// The kind.
        what: String,
        /// What to do.
        advice: String,
    },
    /// The size that the caller states does not fit the file.
    #[error("{file}{}: {found} values, which {message}", of(name))]
    Size {
        /// File as the caller named it.
        file: String,
        /// Name of the array, if it has one.
        name: String,
        /// Values found.
        found: usize,
        /// What was expected, and what to change.
        message: String,
    },
    /// The size is not stated and cannot be told.
    #[error("{file}{}: {found} values may be {}: state the size (x first) or the number of channels", of(name), readings.join(" or "))]
    Ambiguous {
        /// File as the caller named it.
        file: String,
        /// Name of the array, if it has one.
        name: String,
        /// Values found.
        found: usize,
        /// The sizes that fit.
        readings: Vec<String>,
    },
    /// Integers in a text whose meaning is not stated and cannot be told.
    #[error("{file}: {at}: {name}: {message}: state the format, one of f16, f32, unorm8, unorm16")]
    Encoding {
        /// File as the caller named it.
        file: String,
        /// Where the array begins.
        at: Spot,
        /// Name of the array, or `the list`.
        name: String,
        /// What they look like.
        message: String,
    },
    /// Values that are NaN or infinite.
    #[error(
        "{file}{}: channel {channel}, texel {texel:?}: {value} is not a finite number{} of {total} values",
        of(name), others(count.saturating_sub(1))
    )]
    NotFinite {
        /// File as the caller named it.
        file: String,
        /// Name of the array or layer, if it has one.
        name: String,
        /// Channel of the first such value.
        channel: String,
        /// Index along each axis of the first such value, x first.
        texel: Box<[usize]>,
        /// The first such value.
        value: f64,
        /// How many there are, all channels together.
        count: usize,
        /// Values of the table.
        total: usize,
    },
    /// Brackets of one array that hold different numbers of values.
    #[error("{file}: {at}: {message}")]
    TwoLobes {
        /// File as the caller named it.
        file: String,
        /// Where the first one that differs begins.
        at: Spot,
        /// What differs from what.
        message: String,
    },
    /// An array, layer or function that is asked for by name and is not there, or may be one of
    /// several.
    #[error("{file}: {what} {name} is not there; the file has {}", known.join(", "))]
    NoSuch {
        /// File as the caller named it.
        file: String,
        /// `array`, `layer`, `function`.
        what: &'static str,
        /// Name asked for.
        name: String,
        /// Names that there are.
        known: Vec<String>,
    },
    /// A text without an array of numbers, or an image without pixels.
    #[error("{file}: {message}")]
    Nothing {
        /// File as the caller named it.
        file: String,
        /// What was looked for.
        message: String,
    },
}

/// `, name`, or nothing.
fn of(name: &str) -> String {
    if name.is_empty() { String::new() } else { format!(", {name}") }
}

impl PackageError for ForeignError {}

impl From<ForeignError> for CliError {
    fn from(error: ForeignError) -> CliError {
        CliError::Package(Box::new(error))
    }
}
