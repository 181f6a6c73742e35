//! A table in any of the file formats. All hold the same quantised texels.

use super::exr::ExrError;
use super::sidecar::Sidecar;
use super::texels::Packed;
use super::texture::TextureError;
use super::{dds, exr, ktx2, npy, raw};
use crate::data::{Certificate, Container, Decode, Table, TableError};

/// What follows the name of a table's file in that of its sidecar.
pub const SIDECAR: &str = ".json";

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
    pub extension: String,
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
    /// What a texture has no place for.
    #[error(transparent)]
    Texture(#[from] TextureError),
    /// The sidecar.
    #[error("cannot write JSON: {0}")]
    Json(#[from] serde_json::Error),
}

/// How a container holds the texels of a table one after another; none of EXR, whose texels are
/// blocks of its own.
///
/// # Errors
/// What the container cannot hold.
pub fn packed(container: Container, table: &Table) -> Result<Option<Packed>, TextureError> {
    match container {
        Container::Exr => Ok(None),
        Container::Dds => dds::packed(table).map(Some),
        Container::Ktx2 => ktx2::packed(table).map(Some),
        Container::Npy => Ok(Some(npy::packed(table))),
        Container::Raw => Ok(Some(raw::packed(table))),
    }
}

/// The files of a table in a container: the table, and a JSON file beside it where the container
/// has no room for the header.
///
/// # Errors
/// A table that contradicts itself or holds a value that is not finite in its format; what the
/// container cannot hold.
pub fn encode(container: Container, described: &Described) -> Result<Vec<File>, ContainerError> {
    let table = described.table;
    // A finite value may be beyond the range of its format.
    table.quantised().validate()?;
    let extension = container.name();
    let Some(packed) = packed(container, table)? else {
        let header = [("lobefit".to_string(), described.header.join("\n"))];
        return Ok(vec![File { extension: extension.into(), bytes: exr::encode(table, &header)? }]);
    };
    let beside = Sidecar::new(container, described, &packed).bytes()?;
    let file = File { extension: extension.into(), bytes: packed.file(table) };
    Ok(vec![file, File { extension: format!("{extension}{SIDECAR}"), bytes: beside }])
}
