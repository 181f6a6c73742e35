//! The section of this effect in the include files: its formulas, then the lookups of its tables.

use super::tables::BakedTable;
use crate::approximate::Fit;
use crate::data::Decode;
use crate::effects::BakeError;
use crate::effects::code::functions;
use crate::emit::header;
use crate::emit::lookup::Readable;
use lobefit_shade::code::Language;

/// The text in a language; empty where there is nothing to include.
pub fn in_language(language: Language, tables: &[BakedTable], fits: &[Fit]) -> Result<String, BakeError> {
    let mut text = functions(language, fits)?;
    for baked in tables {
        let Some(table) = baked.table() else { continue };
        let decode = Decode::of(baked.layout, baked.serves);
        let lines = header::table_lines(table, decode.formulas(), &baked.approximation.certificate);
        text += &format!("\n{}", Readable { table, decode, header: &lines }.print(language)?);
    }
    Ok(text)
}
