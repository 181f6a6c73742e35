//! A table in the containers that the scene asks for.

use super::BakeError;
use super::context::Context;
use crate::data::{Certificate, Decode, Table};
use crate::emit::container::{Described, encode};
use crate::emit::header;
use crate::store::Files;

/// Adds the files of a table, `note` last in its header; their paths, the table's own before its
/// sidecars.
pub fn contained(
    table: &Table,
    decode: Decode,
    certificate: &Certificate,
    note: Option<&str>,
    context: &Context,
    files: &mut Files,
) -> Result<Vec<String>, BakeError> {
    let mut header = context.recipe.lines();
    header.extend(header::table_lines(table, decode, certificate));
    header.extend(note.map(String::from));
    let described = Described { table, decode, certificate, header: &header };
    let mut paths = Vec::new();
    for container in &context.scene.formats {
        for file in encode(*container, &described)? {
            let path = format!("tables/{}.{}", table.name, file.extension);
            files.insert(path.clone(), file.bytes);
            paths.push(path);
        }
    }
    Ok(paths)
}
