//! The files, entries and functions of baked tables.

use super::BakedTable;
use crate::effects::containers::contained;
use crate::effects::context::Context;
use crate::effects::{BakeError, Deviation, Made};
use crate::emit::header;
use crate::emit::lookup::Readable;
use crate::emit::manifest::{LookupEntry, TableEntry, TableError};
use lobefit_shade::code::Language;

impl Made {
    /// Enters tables: the files in every container of the scene, the entries of the manifest, and
    /// the shader code.
    ///
    /// # Errors
    /// A container that cannot hold a table; a table whose name a language has taken.
    pub fn tables(&mut self, context: &Context, tables: Vec<BakedTable>) -> Result<(), BakeError> {
        let part = &mut self.part;
        for baked in &tables {
            let Some(table) = baked.table() else { continue };
            let (certificate, files) = (&baked.approximation.certificate, &mut part.files);
            let written = contained(table, baked.decode, certificate, baked.note, context, files)?;
            let formulas = baked.decode.formulas();
            let entry = TableEntry::new(part.by.name(), &baked.approximation, table, formulas, errors(baked));
            part.entries.tables.push(entry.in_files(written));
        }
        for baked in &tables {
            let Some(table) = baked.table() else { continue };
            let entry = self.part.entries.tables.iter().find(|entry| entry.name == table.name);
            let file = entry.map(|entry| entry.file.clone());
            let readable = Readable { table, decode: baked.decode, header: &[] };
            let function = format!("{}_lookup", readable.identifier());
            self.called_by(baked.wanted_by.clone(), &function, &baked.approximation, file.as_deref());
        }
        self.code(context, |language| code(language, &tables))?;
        self.tables.extend(tables);
        Ok(())
    }
}

fn errors(baked: &BakedTable) -> TableError {
    let entry = |e: &Deviation| LookupEntry { max: e.max, rms: e.rms, at: e.at.clone() };
    TableError {
        integration: baked.errors.integration,
        quantisation: baked.errors.quantisation.iter().fold(0.0, |worst, r| r.max.max(worst)),
        lookup: entry(&baked.errors.lookup),
        lookup_8_bit_weights: entry(&baked.errors.lookup_8_bit),
    }
}

/// The lookups of tables in a language.
///
/// # Errors
/// A table whose name a language has taken.
fn code(language: Language, tables: &[BakedTable]) -> Result<String, BakeError> {
    let mut text = String::new();
    for baked in tables {
        let Some(table) = baked.table() else { continue };
        let mut lines = header::table_lines(table, baked.decode.formulas(), &baked.approximation.certificate);
        lines.extend(baked.note.map(String::from));
        text += &format!("\n{}", Readable { table, decode: baked.decode, header: &lines }.print(language)?);
    }
    Ok(text)
}
