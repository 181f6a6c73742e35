//! Files and entries of the tables.

use super::BakedTable;
use crate::data::Decode;
use crate::effects::containers::contained;
use crate::effects::context::Context;
use crate::effects::{BakeError, Deviation, Part};
use crate::emit::manifest::{LookupEntry, TableEntry, TableError};

/// Every table in every container of the scene.
pub fn tables(tables: &[BakedTable], context: &Context, part: &mut Part) -> Result<(), BakeError> {
    for baked in tables {
        let Some(table) = baked.table() else { continue };
        let decode = Decode::of(baked.layout, baked.serves);
        let written =
            contained(table, decode, &baked.approximation.certificate, None, context, &mut part.files)?;
        let entry =
            TableEntry::new(part.by.name(), &baked.approximation, table, decode.formulas(), errors(baked));
        part.entries.tables.push(entry.in_files(written));
    }
    Ok(())
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
