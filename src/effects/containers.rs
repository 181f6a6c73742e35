//! A table in the containers that the scene asks for.

use super::BakeError;
use super::context::Context;
use crate::data::{Certificate, Container, Decode, Table};
use crate::emit::container::{Described, encode};
use crate::emit::header;
use crate::store::Files;

/// Adds the files of a table, `note` last in its header; their paths, the table's own before its
/// sidecars, and first that which the include files read where all of them read arrays.
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
    let mut containers = context.scene.formats.clone();
    if context.scene.output.languages.iter().all(|language| language.reads_arrays()) {
        containers.sort_by_key(|container| *container != Container::Raw);
    }
    for container in containers {
        for file in encode(container, &described)? {
            let path = format!("tables/{}.{}", table.name, file.extension);
            files.insert(path.clone(), file.bytes);
            paths.push(path);
        }
    }
    Ok(paths)
}
