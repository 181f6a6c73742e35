//! A table in any of the file formats. All hold the same quantised texels.

use super::exr::ExrError;
use super::{dds, exr, npy, raw, sidecar};
use crate::data::{Certificate, Container, Decode, Table, TableError};

/// A table with what its files say of it.
#[derive(Clone, Copy, Debug)]
pub struct Described<'a> {
    /// The table.
    pub table: &'a Table,
    /// What its channels mean.
    pub decode: Decode,
    /// Error of its lookup.
    pub certificate: &'a Certificate,
    /// Header lines: how it was made, and [`super::header::table_lines`].
    pub header: &'a [String],
}

/// One file of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct File {
    /// What follows the table's name and a dot.
    pub extension: &'static str,
    /// Its contents.
    pub bytes: Vec<u8>,
}

/// A table that a container cannot hold.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ContainerError {
    /// Its shape or its values.
    #[error(transparent)]
    Table(#[from] TableError),
    /// The EXR encoder.
    #[error(transparent)]
    Exr(#[from] ExrError),
    /// What DDS has no place for.
    #[error(transparent)]
    Dds(#[from] dds::DdsError),
    /// The sidecar.
    #[error("cannot write JSON: {0}")]
    Json(#[from] serde_json::Error),
}

/// The files of a table in a container: the table, and a JSON file beside it where the container
/// has no room for the header.
///
/// Errors: a table that contradicts itself or holds a value that is not finite in its format; what
/// the container cannot hold.
pub fn encode(container: Container, described: &Described) -> Result<Vec<File>, ContainerError> {
    let table = described.table;
    // A finite value may be beyond the range of its format.
    table.quantised().validate()?;
    let (bytes, beside) = match container {
        Container::Exr => {
            let header = [("lobefit".to_string(), described.header.join("\n"))];
            (exr::encode(table, &header)?, None)
        }
        Container::Dds => (dds::encode(table)?, Some("dds.json")),
        Container::Npy => (npy::encode(table), Some("npy.json")),
        Container::Raw => (raw::encode(table), Some("raw.json")),
    };
    let mut files = vec![File { extension: container.name(), bytes }];
    if let Some(extension) = beside {
        files.push(File { extension, bytes: sidecar::encode(container, described)? });
    }
    Ok(files)
}
