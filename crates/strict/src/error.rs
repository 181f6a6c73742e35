//! What can be wrong with a scene: always the file, where known the line and column, and the field.

use super::escape::visible;

/// Line and column of a byte in a file, both from 1; columns count bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Position {
    /// Line, from 1.
    pub line: usize,
    /// Column in bytes, from 1.
    pub column: usize,
}

/// A scene, or the table of a kernel that it names, that is refused. Every message names the file;
/// its text holds no control characters.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// The file is longer than [`FILE_BYTES`](super::limits::FILE_BYTES).
    #[error("{}: the file is larger than {limit} bytes", visible(file))]
    TooLarge {
        /// File as the user named it.
        file: String,
        /// The limit in bytes.
        limit: u64,
    },
    /// The bytes are not what a scene file is made of: empty, another encoding, nested too deeply.
    #[error("{}:{}:{}: {message}", visible(file), at.line, at.column)]
    Text {
        /// File as the user named it.
        file: String,
        /// Where.
        at: Position,
        /// What is wrong and what to do.
        message: String,
    },
    /// Not JSON, or a field that is unknown, twice there, missing, of the wrong type or out of
    /// range.
    #[error("{}:{}:{}: {}{}", visible(file), at.line, at.column, prefix(path), visible(message))]
    Field {
        /// File as the user named it.
        file: String,
        /// Where the reader stood: at the end of the value that it refused.
        at: Position,
        /// The field, as `materials[3].roughness[1]`; empty for the scene itself.
        path: String,
        /// What is wrong and what would be right.
        message: String,
    },
    /// Fields that are right one by one and contradict each other.
    #[error("{}: {}{}", visible(file), prefix(path), visible(message))]
    Whole {
        /// File as the user named it.
        file: String,
        /// The field, as `materials[3].name`.
        path: String,
        /// What is wrong and what would be right.
        message: String,
    },
}

/// `path: `, or nothing for the scene itself.
fn prefix(path: &str) -> String {
    // serde_path_to_error says "." for the whole and "?" where it lost its way in text that is not
    // JSON.
    if matches!(path, "" | "." | "?") { String::new() } else { format!("{}: ", visible(path)) }
}
