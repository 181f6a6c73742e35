//! The files, entries and functions of tables of three axes.

use std::collections::BTreeMap;

use super::BakedVolume;
use crate::data::Container;
use crate::effects::BakeError;
use crate::effects::Deviation;
use crate::effects::containers::contained;
use crate::effects::context::Context;
use crate::emit::header;
use crate::emit::lookup::Readable;
use crate::emit::manifest::canonical;
use crate::emit::manifest::{Entries, LookupEntry, TableEntry, TableError};
use crate::store::Files;
use lobefit_shade::code::Language;

/// Every table in every container.
pub fn tables(
    effect: &'static str,
    tables: &[BakedVolume],
    formats: &[Container],
    context: &Context,
    files: &mut Files,
    entries: &mut Entries,
) -> Result<(), BakeError> {
    for baked in tables {
        let Some(table) = baked.table() else { continue };
        let written = contained(
            table,
            baked.decode,
            &baked.approximation.certificate,
            baked.note(),
            formats,
            context,
            files,
        )?;
        let decode = baked.decode.formulas().iter().copied().collect();
        let entry = TableEntry::new(effect, &baked.approximation, table, decode, errors(baked));
        entries.tables.push(canonical(&entry.in_files(written))?);
    }
    Ok(())
}

fn errors(baked: &BakedVolume) -> TableError {
    let entry = |e: &Deviation| LookupEntry { max: e.max, rms: e.rms, at: e.at.clone() };
    TableError {
        integration: baked.errors.integration,
        quantisation: baked.errors.quantisation.iter().fold(0.0, |worst, r| r.max.max(worst)),
        lookup: entry(&baked.errors.lookup),
        lookup_8_bit_weights: entry(&baked.errors.lookup_8_bit),
    }
}

/// The lookups, by language.
pub fn section(tables: &[BakedVolume]) -> BTreeMap<Language, String> {
    let mut texts: BTreeMap<Language, String> = BTreeMap::new();
    for baked in tables {
        let Some(table) = baked.table() else { continue };
        let mut lines = header::table_lines(table, baked.decode.formulas(), &baked.approximation.certificate);
        lines.extend(baked.note().map(String::from));
        let readable = Readable { table, decode: baked.decode, header: &lines };
        for language in Language::ALL {
            *texts.entry(language).or_default() += &format!("\n{}", readable.print(language));
        }
    }
    texts
}
