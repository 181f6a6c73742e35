//! A pair of tables, measured, and what a bake writes of it.

use super::{METRIC, engines, side};
use crate::approximate::FitStageError;
use crate::data::{
    Approximation, Axis, Certificate, Channel, Cost, Decode, Form, Half, HalfError, Source, Table, Use, Warp,
    lookup_features, lookup_ops, shortest,
};
use crate::effects::containers::contained;
use crate::effects::context::Context;
use crate::effects::demand::Job;
use crate::effects::{BakeError, Made};
use crate::emit::call::{Around, How};
use crate::emit::container::ContainerError;
use crate::emit::header;
use crate::emit::lookup::{Readable, TableNames};
use crate::emit::manifest::{LookupEntry, TableEntry, TableError};
use crate::report::{Measured as Listed, Offer, Purpose, Role};
use crate::scene::TableWant;
use crate::store::Files;
use lobefit_ltc::{Deviation, Lobe, Measured, Pair, QUAD, Setting, measured};
use lobefit_shade::code::Language;
use lobefit_shade::round_up;

/// Places along both axes at which a pair is measured.
const PLACES: usize = 24;

/// The tables of a pair: what names of functions end in, what they hold, and its channels.
const TABLES: [(&str, Decode, [&str; 4]); 2] = [
    ("matrix", Decode::Transform, ["m11", "m31", "m13", "m33"]),
    ("light", Decode::Light, ["E", "B", "zero", "sphere"]),
];

/// A pair that was made, with what was measured of it.
pub(super) struct Baked {
    pub lobe: Lobe,
    pub pair: Pair,
    pub measured: Measured,
    /// The matrices, and what scales them.
    tables: [(Approximation, Decode, TableNames, TableError); 2],
}

/// Makes the pair of a job; `stem` begins the names of its functions.
pub(super) fn bake(
    job: &Job,
    (lobe, want): (Lobe, &TableWant),
    stem: &str,
    context: &Context,
) -> Result<Baked, BakeError> {
    let (map, format) = (context.scene.alpha, want.format);
    let alpha = |roughness: f64| map.alpha(roughness);
    let exact = Pair::fitted(lobe, side(want), alpha)?;
    let pair = exact.stored(|x| format.quantise(x));
    let setting = Setting { lobe, roughness: job.range("roughness")?, mu: job.range("mu")?, places: PLACES };
    let found = measured(&pair, &setting, alpha)?;
    let axes = |n: usize| {
        vec![
            Axis::ends("roughness", n, Warp::Linear, [0.0, 1.0]),
            Axis::ends("mu", n, Warp::Grazing, [1.0, 0.0]),
        ]
    };
    let smith = if let Lobe::Ggx(smith) = lobe { Some(smith) } else { None };
    let table = |k: usize| -> Result<_, BakeError> {
        let (what, decode, channels) = TABLES[k];
        let texels = [&exact.matrices, &exact.amplitudes][k];
        let channel = |c: usize| Channel::new(channels[c], texels.iter().map(|texel| texel[c]).collect());
        let table = Table {
            name: if k == 0 { job.name.clone() } else { format!("{}-{what}", job.name) },
            quantity: lobe.transformed().into(),
            smith,
            alpha_map: map,
            axes: axes(pair.side),
            channels: (0..4).map(channel).collect(),
            format,
        };
        table.validate()?;
        let (error, coarse, half, integration) = match k {
            0 => (found.shape, found.shape_8_bit, found.shape_half, found.integration.max),
            _ => (found.light, found.light_8_bit, found.light_half, 1e-6),
        };
        let rounded = texels.iter().flatten().map(|x| (format.quantise(*x) - x).abs()).fold(0.0, f64::max);
        let error_entry = TableError {
            integration: round_up(integration, 2),
            quantisation: round_up(rounded, 4),
            lookup: entry(&error),
            lookup_8_bit_weights: entry(&coarse),
            half: Half::Measured(HalfError {
                max_abs: round_up(half.max, 4),
                rms: half.rms,
                at: place(half.at),
                precision: "f16".into(),
            }),
        };
        let ops = lookup_ops(&table.axes, decode).map_err(shader)?;
        let approximation = Approximation {
            name: table.name.clone(),
            quantity: table.quantity.clone(),
            column: ["the share of a square light", "E, B"][k].into(),
            used_as: Use::VALUE,
            smith,
            side: None,
            source: Source::Fitted,
            certificate: certificate(&error, &setting, format.name()),
            cost: Cost { ops, fetches: 1, bytes: table.bytes() },
            form: Form::Table(table.quantised()),
        };
        let names = TableNames { lookup: format!("{stem}_{what}"), stem: stem.into() };
        Ok((approximation, decode, names, error_entry))
    };
    let tables = [table(0)?, table(1)?];
    Ok(Baked { lobe, pair, measured: found, tables })
}

fn shader(error: lobefit_shade::ShadeError) -> BakeError {
    BakeError::Effect(Box::new(error))
}

fn place([roughness, mu]: [f64; 2]) -> crate::data::Place {
    let digits = |x: f64| shortest(x as f32);
    [("roughness".to_string(), digits(roughness)), ("mu".to_string(), digits(mu))].into()
}

fn entry(error: &Deviation) -> LookupEntry {
    let [max, max_rel] = [error.max, error.relative].map(|error| round_up(error, 4));
    LookupEntry { max, max_rel, rms: error.rms, at: place(error.at) }
}

fn certificate(error: &Deviation, setting: &Setting, format: &str) -> Certificate {
    let Setting { roughness, mu, .. } = *setting;
    Certificate {
        max_abs: round_up(error.max, 4),
        max_rel: round_up(error.relative, 4),
        rms: error.rms,
        mean: error.mean,
        at: place(error.at),
        domain: [("roughness".to_string(), roughness), ("mu".to_string(), mu)].into(),
        precision: format!("{format} texels, f64 lookup"),
        points: error.count as u64,
    }
}

impl Baked {
    /// The largest error of the shape.
    pub fn error(&self) -> f64 {
        self.tables[0].0.certificate.max_abs
    }

    /// The two approximations.
    pub fn approximations(&self) -> [&Approximation; 2] {
        [&self.tables[0].0, &self.tables[1].0]
    }

    /// Files, entries, calls and the card.
    pub fn entered(&self, made: &mut Made, job: &Job, context: &Context) -> Result<(), BakeError> {
        let mut offers = Vec::new();
        for (k, (approximation, decode, names, error)) in self.tables.iter().enumerate() {
            let note = &self.measured.notes()[k];
            let Form::Table(table) = &approximation.form else { continue };
            let part = &mut made.part;
            let files =
                contained(table, *decode, &approximation.certificate, Some(note), context, &mut part.files)?;
            let mut files = files;
            if *decode == Decode::Transform {
                files.extend(self.shared(job, context, &mut part.files)?);
            }
            let entry =
                TableEntry::new(part.by.name(), approximation, table, decode.formulas(), error.clone());
            let inputs = self.readable(context, table, *decode, names, &[]).inputs()?;
            let entry = entry.in_files(files).read_by(&names.lookup, &inputs);
            let file = entry.file.clone();
            part.entries.tables.push(entry);
            let price = context.scene.output.cost.map(|vendor| {
                let work = lookup_features(&table.axes, *decode).map_err(shader)?;
                Ok::<f64, BakeError>(vendor.price(&work).map_err(FitStageError::from)?)
            });
            let known = part.entries.calls.len();
            made.called_by(job.callers(), &names.lookup, (approximation, price.transpose()?), Some(&file));
            if *decode == Decode::Transform {
                let calls = made.part.entries.calls[known..].iter_mut();
                calls.for_each(|call| call.around.push(Around::new(QUAD.into(), How::TakesValue)));
            }
            offers.push(self.purpose(approximation, &names.lookup));
        }
        made.purposes.extend(offers);
        Ok(())
    }

    /// Adds the files that engines read both tables from; their paths.
    fn shared(&self, job: &Job, context: &Context, files: &mut Files) -> Result<Vec<String>, BakeError> {
        let [matrices, lights] = &self.tables;
        let (Form::Table(one), Form::Table(other)) = (&matrices.0.form, &lights.0.form) else {
            return Ok(Vec::new());
        };
        let mut paths = Vec::new();
        let mut header = context.recipe.lines();
        header.extend(header::table_lines(one, matrices.1, &matrices.0.certificate));
        header.extend(self.measured.notes());
        for engine in engines(context.scene, job) {
            let bytes = engines::file(engine, [one, other], &header).map_err(ContainerError::from)?;
            let path = format!("tables/{}.{}", one.name, engine.extension());
            files.insert(path.clone(), bytes);
            paths.push(path);
        }
        Ok(paths)
    }

    fn purpose(&self, a: &Approximation, function: &str) -> Purpose {
        let error = [a.certificate.max_abs, a.certificate.rms];
        let offer = Offer::new(Role::Recommended, &a.name, Some(function.into()), (a.cost, Some(error)));
        Purpose {
            name: function.into(),
            about: format!("Table of {} of {}.", a.column, a.quantity),
            metric: if a.column == "E, B" { "lookup error of E and B".into() } else { METRIC.into() },
            choices: vec![offer],
            measured: vec![Listed {
                name: a.name.clone(),
                ops: a.cost.ops,
                error,
                table: true,
                ..Listed::default()
            }],
            ..Purpose::default()
        }
    }

    fn readable<'a>(
        &self,
        context: &Context,
        table: &'a Table,
        decode: Decode,
        names: &'a TableNames,
        header: &'a [String],
    ) -> Readable<'a> {
        Readable { table, decode, names, arguments: context.scene.output.arguments, header }
    }

    /// The lookups in a language.
    pub fn code(&self, language: Language, context: &Context) -> Result<String, BakeError> {
        let mut text = String::new();
        for (k, (approximation, decode, names, errors)) in self.tables.iter().enumerate() {
            let Form::Table(table) = &approximation.form else { continue };
            let note = &self.measured.notes()[k];
            let half = &errors.half;
            let header = header::lookup_lines(table, *decode, &approximation.certificate, half, Some(note));
            let readable = self.readable(context, table, *decode, names, &header);
            if k == 0 {
                text += &format!("\n{}", readable.print_parts(language)?);
            }
            text += &format!("\n{}", readable.print_lookup(language)?);
        }
        Ok(text)
    }
}
