//! The files, entries and functions of baked tables.

use std::collections::BTreeMap;

use super::{BakedTable, LookupError};
use crate::approximate::FitStageError;
use crate::data::{Table, lookup_features};
use crate::effects::containers::contained;
use crate::effects::context::Context;
use crate::effects::{BakeError, Deviation, Made};
use crate::emit::call::{INVERSE, OVER, SPLIT, SPLIT_OVER};
use crate::emit::compensation::Compensation;
use crate::emit::header;
use crate::emit::lookup::Readable;
use crate::emit::manifest::{LookupEntry, TableEntry, TableError};
use crate::scene::Material;
use lobefit_shade::code::Language;
use lobefit_shade::round_up;
use lobefit_truth::quantity::Specular;

impl Made {
    /// Enters tables: the files in every container of the scene, the entries of the manifest, and
    /// the shader code.
    ///
    /// # Errors
    /// A container that cannot hold a table; a table whose name a language has taken.
    pub fn tables(&mut self, context: &Context, tables: Vec<BakedTable>) -> Result<(), BakeError> {
        let materials: BTreeMap<&str, &Material> =
            context.scene.materials.iter().map(|material| (material.name.as_str(), material)).collect();
        for baked in &tables {
            let Some(table) = baked.table() else { continue };
            let part = &mut self.part;
            let (certificate, files) = (&baked.approximation.certificate, &mut part.files);
            let written = contained(table, baked.decode, certificate, baked.note, context, files)?;
            let (formulas, errors) = (baked.decode.formulas(), errors(baked));
            let entry = TableEntry::new(part.by.name(), &baked.approximation, table, formulas, errors);
            let inputs = readable(baked, table, context, &[]).inputs()?;
            let entry = entry.in_files(written).read_by(&baked.names.lookup, &inputs);
            let (file, has) = (entry.file.clone(), entry.has_albedo());
            part.entries.tables.push(entry);
            let (by, function) = (baked.wanted_by.clone(), &baked.names.lookup);
            let price = match context.scene.output.cost {
                Some(vendor) => {
                    let work = lookup_features(&table.axes, baked.decode).map_err(LookupError::Shader)?;
                    Some(vendor.price(&work).map_err(FitStageError::from)?)
                }
                None => None,
            };
            let known = self.part.entries.calls.len();
            self.called_by(by, function, (&baked.approximation, price), Some(&file));
            for call in &mut self.part.entries.calls[known..] {
                let material = materials.get(call.of.as_str());
                call.then =
                    material.and_then(|material| then(material, &table.quantity, has)).map(String::from);
            }
        }
        self.code(context, |language| code(language, &tables, context))?;
        self.tables.extend(tables);
        Ok(())
    }
}

/// What a material makes of an albedo, where it is there and where its parts are: a function that takes it,
/// or the lobe f over it.
fn then(material: &Material, quantity: &str, [is_there, is_split]: [bool; 2]) -> Option<&'static str> {
    let compensation = Compensation::of_quantity(quantity).filter(|_| is_there)?;
    if material.mixed.is_some() {
        return Some(INVERSE);
    }
    match (compensation, material.specular()) {
        (Compensation::Glass, _) | (_, Specular::Compensated) => Some(compensation.of_colours()),
        (_, Specular::Normalised) => Some(if is_split { SPLIT_OVER } else { OVER }),
        (_, Specular::Single) => is_split.then_some(SPLIT),
    }
}

fn readable<'a>(
    baked: &'a BakedTable,
    table: &'a Table,
    context: &Context,
    header: &'a [String],
) -> Readable<'a> {
    let arguments = context.scene.output.arguments;
    Readable { table, decode: baked.decode, names: &baked.names, arguments, header }
}

fn errors(baked: &BakedTable) -> TableError {
    let entry = |e: &Deviation| {
        let max_rel = round_up(e.max_rel, 4);
        LookupEntry { max: e.max, max_rel, rms: e.rms, at: e.at.clone() }
    };
    TableError {
        integration: baked.errors.integration,
        quantisation: baked.errors.quantisation.iter().fold(0.0, |worst, r| r.max.max(worst)),
        lookup: entry(&baked.errors.lookup),
        lookup_8_bit_weights: entry(&baked.errors.lookup_8_bit),
        half: baked.errors.half.clone(),
    }
}

/// The lookups of tables in a language, and what they call, which tables of both sides share.
///
/// # Errors
/// A table whose name a language has taken.
fn code(language: Language, tables: &[BakedTable], context: &Context) -> Result<String, BakeError> {
    let mut text = String::new();
    let mut stems: Vec<&str> = Vec::new();
    for baked in tables {
        let Some(table) = baked.table() else { continue };
        let certificate = &baked.approximation.certificate;
        let header = header::lookup_lines(table, baked.decode, certificate, &baked.errors.half, baked.note);
        let readable = readable(baked, table, context, &header);
        if !stems.contains(&baked.names.stem.as_str()) {
            text += &format!("\n{}", readable.print_parts(language)?);
            stems.push(&baked.names.stem);
        }
        text += &format!("\n{}", readable.print_lookup(language)?);
    }
    Ok(text)
}
