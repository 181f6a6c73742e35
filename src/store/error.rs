//! What can go wrong with files: always the path and the operation.

use std::io;
use std::path::{Path, PathBuf};

/// What was being done to a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Operation {
    /// Reading a file.
    Read,
    /// Listing a folder.
    List,
    /// Finding out what is at a path.
    Look,
    /// Creating a folder.
    CreateFolder,
    /// Creating a temporary file in a folder.
    CreateTemp,
    /// Writing a temporary file.
    Write,
    /// Synchronising a file or folder with the disk.
    Sync,
    /// Renaming a temporary file to its destination.
    Rename,
    /// Removing a file.
    Remove,
    /// Locking the output folder.
    Lock,
}

impl Operation {
    /// As in "cannot `read`".
    pub fn verb(self) -> &'static str {
        match self {
            Operation::Read => "read",
            Operation::List => "list the folder",
            Operation::Look => "access",
            Operation::CreateFolder => "create the folder",
            Operation::CreateTemp => "create a file in this folder",
            Operation::Write => "write",
            Operation::Sync => "synchronise",
            Operation::Rename => "rename the new file to",
            Operation::Remove => "remove",
            Operation::Lock => "lock",
        }
    }
}

/// A file that could not be read or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StoreError {
    /// The system refused an operation.
    #[error("{}: cannot {}: {source}", path.display(), operation.verb())]
    Io {
        /// Path that was operated on.
        path: PathBuf,
        /// What was being done.
        operation: Operation,
        /// Whether it was part of writing.
        writing: bool,
        /// What the system said.
        source: io::Error,
    },
    /// A file to be read is longer than its limit.
    #[error("{}: larger than {limit} bytes", path.display())]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// The limit in bytes.
        limit: u64,
    },
    /// Another process is writing to the folder.
    #[error("{}: another lobefit is writing to this folder; wait for it or choose another --out", path.display())]
    Busy {
        /// The folder.
        path: PathBuf,
    },
    /// Something is in the way of a file or folder that is to be written.
    #[error("{}: {what} is in the way; move it or choose another --out", path.display())]
    InTheWay {
        /// Where it is.
        path: PathBuf,
        /// What it is.
        what: &'static str,
    },
    /// The folder holds a manifest that no bake has written.
    #[error("{}: not the manifest of a bake ({reason}); move it or choose another --out", path.display())]
    ForeignManifest {
        /// The manifest.
        path: PathBuf,
        /// What tells.
        reason: String,
    },
    /// A name that would leave its folder.
    #[error("`{name}` is no plain path inside the folder")]
    Outside {
        /// The name.
        name: String,
        /// Whether it was to be written.
        writing: bool,
    },
}

impl StoreError {
    /// Whether writing failed (exit code 3), rather than reading (exit code 2).
    pub fn is_write(&self) -> bool {
        match self {
            StoreError::Io { writing, .. } | StoreError::Outside { writing, .. } => *writing,
            StoreError::TooLarge { .. } => false,
            StoreError::Busy { .. } | StoreError::InTheWay { .. } | StoreError::ForeignManifest { .. } => {
                true
            }
        }
    }

    pub(super) fn writing(path: &Path, operation: Operation) -> impl FnOnce(io::Error) -> StoreError {
        let path = path.to_owned();
        move |source| StoreError::Io { path, operation, writing: true, source }
    }

    pub(super) fn reading(path: &Path, operation: Operation) -> impl FnOnce(io::Error) -> StoreError {
        let path = path.to_owned();
        move |source| StoreError::Io { path, operation, writing: false, source }
    }
}
