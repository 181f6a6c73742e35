//! A table in the containers that the scene asks for.

use super::BakeError;
use super::context::Context;
use crate::data::{Certificate, Container, Decode, Table};
use crate::emit::container::{Described, encode};
use crate::emit::header;
use crate::store::Files;

/// Adds the files of a table; their paths, the table's own before its sidecars.
pub fn contained(
    table: &Table,
    decode: Decode,
    certificate: &Certificate,
    formats: &[Container],
    context: &Context,
    files: &mut Files,
) -> Result<Vec<String>, BakeError> {
    let header =
        [context.recipe.lines(), header::table_lines(table, decode.formulas(), certificate)].concat();
    let described = Described { table, decode, certificate, header: &header };
    let mut paths = Vec::new();
    for container in formats {
        for file in encode(*container, &described)? {
            let path = format!("tables/{}.{}", table.name, file.extension);
            files.insert(path.clone(), file.bytes);
            paths.push(path);
        }
    }
    Ok(paths)
}
