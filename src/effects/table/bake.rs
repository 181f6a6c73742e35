//! Jobs to measured tables.

use std::sync::Arc;

use super::instead::instead;
use super::{BuildError, Errors, Family, Judge, LookupError, Made, Region, Spec, TableJob, measure};
use crate::data::{
    Approximation, Certificate, Channel, Cost, Decode, Form, Layout, Smith, Source, Table, Use, lookup_ops,
};
use crate::effects::BakeError;
use crate::effects::context::Context;
use crate::effects::demand::Caller;
use crate::emit::header;
use crate::emit::lookup::TableNames;
use crate::store::Key;
use lobefit_shade::code::TEXTURE_AXES;
use lobefit_shade::round_up;
use lobefit_truth::integrate::glass::Side;

/// A baked table: the approximation holds its quantised texels.
#[derive(Clone, Debug)]
pub struct BakedTable {
    /// The table as an approximation: certificate of the lookup, cost, texels.
    pub approximation: Approximation,
    /// What its functions are called.
    pub names: TableNames,
    /// Its errors by their causes.
    pub errors: Errors,
    /// What its channels mean.
    pub decode: Decode,
    /// Coordinates.
    pub layout: Layout,
    /// Region in which it was measured.
    pub region: Region,
    /// Side of glass.
    pub side: Option<Side>,
    /// What its texels took; of both tables of glass together.
    pub made: Made,
    /// What the axes do not tell of the nodes, for headers.
    pub note: Option<&'static str>,
    /// Names of the materials that want it.
    pub wanted_by: Vec<Caller>,
    /// Where it was measured: the judge of it alone.
    pub judge: Arc<Judge>,
}

impl BakedTable {
    /// The quantised table.
    pub fn table(&self) -> Option<&Table> {
        match &self.approximation.form {
            Form::Table(table) => Some(table),
            Form::Formula(_) => None,
        }
    }

    /// The lookup error with other texels, channels found by name.
    ///
    /// # Errors
    /// A channel is missing.
    pub fn measured_again(&self, channels: &[Channel]) -> Result<f64, BakeError> {
        let lacks = |what: &str| BakeError::Internal(format!("{}: no {what}", self.approximation.name));
        let mut table = self.table().ok_or_else(|| lacks("texels"))?.clone();
        for channel in &mut table.channels {
            let found = channels.iter().find(|c| c.name == channel.name);
            channel.texels = found.ok_or_else(|| lacks(&format!("channel {}", channel.name)))?.texels.clone();
        }
        Ok(measure(&table, self.decode, &self.judge.points, self.judge.truth(0), 0.0)?.lookup.max)
    }
}

/// Bakes the jobs; returns the tables in their order, and the promises that tables do not keep: a line each,
/// of the last table of a job with a line for each choice that keeps it. Jobs that promise something come
/// first, and where a promise is not kept no others are baked.
///
/// # Errors
/// A truth that cannot be integrated.
pub fn bake(
    family: &dyn Family,
    jobs: &[TableJob],
    context: &Context,
) -> Result<(Vec<BakedTable>, Vec<String>), BakeError> {
    let (mut broken, mut baked) = (Vec::new(), Vec::new());
    let mut judges: Vec<((Smith, Region, bool), Arc<Judge>)> = Vec::new();
    let mut order: Vec<usize> = (0..jobs.len()).collect();
    order.sort_by_key(|i| !jobs[*i].is_promised());
    for i in order {
        let job = &jobs[i];
        if !broken.is_empty() && !job.is_promised() {
            break;
        }
        context.progress.stage(&format!("table {}", job.names.join(" and ")));
        let key = (job.smith, job.region, family.finer(job, jobs));
        let judge = match judges.iter().find(|(known, _)| *known == key) {
            Some((_, judge)) => judge.clone(),
            None => {
                let judge = Arc::new(Judge::new(family, key.0, key.1, key.2, &context.memo)?);
                judges.push((key, judge.clone()));
                judge
            }
        };
        let tables = bake_job(family, (jobs, i), &judge, context)?;
        let mut unkept: Vec<String> = tables.iter().filter_map(|table| unkept(job, table)).collect();
        if let (Some(last), Some(table), Some(limit)) =
            (unkept.last_mut(), tables.first(), job.want.max_error)
        {
            let mut size: Vec<usize> =
                table.table().into_iter().flat_map(|t| &t.axes).map(|a| a.size).collect();
            size.extend(job.want.has_one_slice().then_some(1));
            for line in instead(family, (job, &size), &judge, limit, context)? {
                *last += &format!("\n{line}");
            }
        }
        broken.extend(unkept);
        broken.extend(tables.iter().filter_map(|table| unjudged(job, table)));
        baked.push((i, tables));
    }
    baked.sort_by_key(|(i, _)| *i);
    Ok((baked.into_iter().flat_map(|(_, tables)| tables).collect(), broken))
}

/// The tables of job `i`; where the size is open, the smallest that keep the limit, or without a limit
/// the largest.
fn bake_job(
    family: &dyn Family,
    (jobs, i): (&[TableJob], usize),
    judge: &Judge,
    context: &Context,
) -> Result<Vec<BakedTable>, BakeError> {
    let job = &jobs[i];
    let mut last = Vec::new();
    let sizes = job.sizes();
    let first = if job.want.max_error.is_some() { 0 } else { sizes.len() - 1 };
    let mut sizes = sizes.into_iter().skip(first).peekable();
    while let Some(size) = sizes.next() {
        let text = job.sized(&size, jobs);
        let spec = job.spec(size, &text);
        let (tables, made) = built(family, &spec, context)?;
        if let Some(limit) = job.want.max_error.filter(|_| sizes.peek().is_some()) {
            let mut exceeds = false;
            for (i, table) in tables.iter().enumerate() {
                exceeds = exceeds || judge.exceeds((table, spec.decode()), i, limit)?;
            }
            // More points find no smaller error.
            if exceeds {
                continue;
            }
        }
        let names = job.functions(family, &text, &jobs[..i]);
        let parts = tables.into_iter().zip(family.sides()).zip(names).enumerate();
        let finished = parts.map(|(i, ((table, side), names))| {
            let judge = judge.closer((&table, spec.decode()), (family, i), &context.memo)?;
            let baked = finish(&spec, &table, made, judge)?;
            let wanted_by = job.wanted_by.clone();
            Ok(BakedTable { names, side: *side, note: family.note(spec.layout), wanted_by, ..baked })
        });
        last = finished.collect::<Result<_, BakeError>>()?;
        if job.want.max_error.is_some_and(|limit| last.iter().all(|table| table.errors.lookup.max <= limit)) {
            break;
        }
    }
    Ok(last)
}

/// The tables of a spec, of which nothing is integrated where they are known.
pub(super) fn built(
    family: &dyn Family,
    spec: &Spec,
    context: &Context,
) -> Result<(Vec<Table>, Made), BuildError> {
    let key = Key::of("tables").with(&family.identity()).with(&format!("{spec:?}"));
    context.memo.kept(key, || family.build(spec, &context.memo))
}

fn unkept(job: &TableJob, baked: &BakedTable) -> Option<String> {
    let (name, error) = (&baked.approximation.name, baked.errors.lookup.max);
    let limit = job.want.max_error.filter(|limit| error.is_nan() || error > *limit)?;
    let by = &job.limited_by;
    let at = header::place(&baked.errors.lookup.at);
    Some(format!("table {name}: lookup error {error} exceeds the max_error {limit} of {by}\nworst at {at}"))
}

fn unjudged(job: &TableJob, baked: &BakedTable) -> Option<String> {
    let (name, least, by) = (&baked.approximation.name, job.region.roughness[0], job.unjudged_by.as_ref()?);
    Some(format!(
        "table {name}: rows begin at roughness {least}, above all of the material's, so that no lookup tells whether the \
         max_error of {by} is kept: raise its roughness, or set a size without max_error"
    ))
}

impl TableJob {
    /// Whether the scene limits its error.
    fn is_promised(&self) -> bool {
        self.want.max_error.is_some() || self.unjudged_by.is_some()
    }

    /// What to build of it in a size, which names have as `text`.
    pub(super) fn spec(&self, size: Vec<usize>, text: &str) -> Spec {
        Spec {
            names: self.names.iter().map(|name| name.replace("auto", text)).collect(),
            smith: self.smith,
            size,
            format: self.want.format,
            layout: self.want.layout,
            serves: self.want.serves,
            region: self.region,
        }
    }
}

/// A table measured where its own judge says.
pub(super) fn finish(spec: &Spec, table: &Table, made: Made, judge: Judge) -> Result<BakedTable, BakeError> {
    let decode = spec.decode();
    let integration = round_up(made.integration.max(judge.made.integration), 2);
    let mut errors = measure(table, decode, &judge.points, judge.truth(0), integration)?;
    let lookups = [&mut errors.lookup, &mut errors.lookup_8_bit, &mut errors.lookup_e];
    for lookup in lookups.into_iter().chain(&mut errors.lookup_b) {
        lookup.max = round_up(lookup.max, 4);
    }
    for rounding in &mut errors.quantisation {
        rounding.max = round_up(rounding.max, 4);
    }
    let certificate = Certificate {
        max_abs: errors.lookup.max,
        max_rel: round_up(errors.lookup.max_rel, 4),
        rms: errors.lookup.rms,
        mean: errors.lookup.mean,
        at: errors.lookup.at.clone(),
        domain: spec.region.ranges(),
        precision: format!("{} texels, f32 lookup", table.format.name()),
        points: errors.points as u64,
    };
    let (column, used_as) =
        if decode.has_bias() { ("E, A, B", Use::F0_BLEND) } else { (decode.formulas()[0].0, Use::VALUE) };
    let ops = lookup_ops(&table.axes, decode).map_err(LookupError::Shader)?;
    let approximation = Approximation {
        name: table.name.clone(),
        quantity: table.quantity.clone(),
        column: column.into(),
        used_as,
        smith: table.smith,
        side: None,
        source: Source::Fitted,
        cost: Cost { ops, fetches: 1 << table.axes.len().saturating_sub(TEXTURE_AXES), bytes: table.bytes() },
        form: Form::Table(table.quantised()),
        certificate,
    };
    let (layout, region, judge) = (spec.layout, spec.region, Arc::new(judge));
    let (side, note) = (None, None);
    let wanted_by = Vec::new();
    let names = TableNames::from(table.name.replace('-', "_").as_str());
    Ok(BakedTable {
        approximation,
        names,
        errors,
        decode,
        layout,
        region,
        side,
        made,
        note,
        wanted_by,
        judge,
    })
}
