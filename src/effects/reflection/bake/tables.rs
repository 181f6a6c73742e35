//! Table jobs to measured tables.

use std::collections::BTreeMap;

use crate::approximate::{Counter, Region, certification};
use crate::data::{
    Approximation, Certificate, Channel, Cost, Decode, Form, Layout, Serves, Smith, Source, Table, Use,
    lookup_ops,
};
use crate::effects::context::Context;
use crate::effects::demand::JUDGED_MU;
use crate::effects::reflection::{TableSpec, build};
use crate::effects::table::{Errors, Points, TableJob, Truth, measure};
use crate::effects::{Albedo, BakeError};
use lobefit_shade::round_up;
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::quantity::TRUTH_ERROR;

/// 2^17 uniform points, half as many in the layer mu ~ alpha, and the edges.
const LOG2_POINTS: u32 = 17;

/// Squares tried in turn where the scene leaves the size open.
const SIZES: [usize; 4] = [16, 32, 64, 128];

/// A baked table: the approximation holds its quantised texels.
#[derive(Clone, Debug)]
pub struct BakedTable {
    /// The table as an approximation: certificate of the lookup, cost, texels.
    pub approximation: Approximation,
    /// Its errors, told apart.
    pub errors: Errors,
    /// Coordinates.
    pub layout: Layout,
    /// Use.
    pub serves: Serves,
    /// Region in which it was measured.
    pub region: Region,
}

impl BakedTable {
    /// The quantised table.
    pub fn table(&self) -> Option<&Table> {
        match &self.approximation.form {
            Form::Table(table) => Some(table),
            Form::Formula(_) => None,
        }
    }
}

/// Points and truth over one region, shared by the tables that are judged there.
struct Judge {
    smith: Smith,
    region: Region,
    points: Points,
    truth: Albedo,
}

/// E, and B where it was integrated.
fn truth(field: &Albedo) -> Truth<'_> {
    Truth { e: &field.e, b: (!field.b.is_empty()).then_some(&field.b) }
}

/// Bakes the jobs in order; returns also the promises that tables do not keep, in words.
pub fn bake_tables(
    jobs: &[TableJob],
    context: &Context,
) -> Result<(Vec<BakedTable>, Vec<String>), BakeError> {
    let mut broken = Vec::new();
    let mut judges: Vec<Judge> = Vec::new();
    let mut baked = Vec::new();
    for job in jobs {
        context.progress.stage(&format!("table {}", job.names()));
        let judge = judge(job, jobs, &mut judges, context)?;
        let table = bake_table(job, judge, context)?;
        if let Some(limit) = job.max_error.filter(|limit| table.errors.lookup.max > *limit) {
            broken.push(format!(
                "table {}: lookup error {} exceeds the max_error {limit} of {}",
                table.approximation.name, table.errors.lookup.max, job.limited_by,
            ));
        }
        baked.push(table);
    }
    Ok((baked, broken))
}

fn region(job: &TableJob) -> Region {
    Region { roughness: job.roughness, mu: JUDGED_MU, alpha_map: job.alpha_map }
}

/// The judge of a job's region, made when it is first needed; with B if any table judged there holds it.
fn judge<'a>(
    job: &TableJob,
    jobs: &[TableJob],
    judges: &'a mut Vec<Judge>,
    context: &Context,
) -> Result<&'a Judge, IntegrateError> {
    let (smith, region_of_job) = (job.smith, region(job));
    let known = judges.iter().position(|j| j.smith == smith && j.region == region_of_job);
    if known.is_none() {
        let same = |other: &&TableJob| other.smith == smith && region(other) == region_of_job;
        let split = jobs.iter().filter(same).any(|other| other.serves == Serves::SplitSum);
        let points = certification(&region_of_job, LOG2_POINTS);
        let truth = Albedo::new(smith, &points, split, &context.counter)?;
        judges.push(Judge { smith, region: region_of_job, points: Points::isotropic(&points), truth });
    }
    Ok(&judges[known.unwrap_or(judges.len() - 1)])
}

fn bake_table(job: &TableJob, judge: &Judge, context: &Context) -> Result<BakedTable, BakeError> {
    let sizes: Vec<[usize; 2]> = match job.size.as_deref() {
        Some(&[columns, rows]) => vec![[columns, rows]],
        Some(_) => return Err(BakeError::Internal(format!("table {}: not a size of two axes", job.names()))),
        None => SIZES.map(|n| [n, n]).to_vec(),
    };
    let mut last = None;
    for size in sizes {
        let spec = spec(job, judge.region, size);
        let table = build(&spec, &context.counter)?;
        let decode = Decode::of(job.layout, job.serves);
        let errors = measure(&table, decode, &judge.points, truth(&judge.truth), TRUTH_ERROR)?;
        let enough = job.max_error.is_none_or(|limit| errors.lookup.max <= limit);
        last = Some(finish(job, judge.region, &table, errors));
        if enough {
            break;
        }
    }
    last.ok_or_else(|| BakeError::Internal("a table job has no size to try".into()))
}

fn spec(job: &TableJob, region: Region, size: [usize; 2]) -> TableSpec {
    TableSpec {
        name: job.names().replace("auto", &format!("{}x{}", size[0], size[1])),
        smith: job.smith,
        alpha_map: job.alpha_map,
        size,
        format: job.format,
        layout: job.layout,
        serves: job.serves,
        region,
    }
}

fn finish(job: &TableJob, region: Region, table: &Table, mut errors: Errors) -> BakedTable {
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
        domain: ranges(&region),
        precision: format!("{} texels, f32 lookup", table.format.name()),
        points: errors.points as u64,
    };
    let (column, used_as) = match job.serves {
        Serves::Albedo => ("E", Use::Value),
        Serves::SplitSum => ("E, A, B", Use::F0Blend),
    };
    let cost = Cost {
        ops: lookup_ops(&table.axes, Decode::of(job.layout, job.serves)),
        fetches: 1,
        bytes: table.bytes(),
    };
    let approximation = Approximation {
        name: table.name.clone(),
        quantity: table.quantity.clone(),
        column: column.into(),
        used_as,
        smith: Some(table.smith),
        source: Source::Fitted,
        form: Form::Table(table.quantised()),
        certificate,
        cost,
    };
    BakedTable { approximation, errors, layout: job.layout, serves: job.serves, region }
}

/// The region by input, as certificates state it.
pub fn ranges(region: &Region) -> BTreeMap<String, [f64; 2]> {
    let inputs = [("alpha", region.alpha()), ("mu", region.mu), ("roughness", region.roughness)];
    inputs.into_iter().map(|(name, range)| (name.to_string(), range)).collect()
}

/// Points that tell whether other texels keep a stated error: as many as that was measured at.
const LOG2_RECHECK: u32 = LOG2_POINTS;

/// The lookup error of a table with other texels, channels found by name.
///
/// # Errors
/// A channel is missing.
pub fn measured_again(baked: &BakedTable, channels: &[Channel]) -> Result<f64, BakeError> {
    let lacks = |what: &str| BakeError::Internal(format!("{}: no {what}", baked.approximation.name));
    let mut table = baked.table().ok_or_else(|| lacks("texels"))?.clone();
    for channel in &mut table.channels {
        let found = channels.iter().find(|c| c.name == channel.name);
        channel.texels = found.ok_or_else(|| lacks(&format!("channel {}", channel.name)))?.texels.clone();
    }
    let (points, counter) = (certification(&baked.region, LOG2_RECHECK), Counter::default());
    let field = Albedo::new(table.smith, &points, baked.serves == Serves::SplitSum, &counter)?;
    let decode = Decode::of(baked.layout, baked.serves);
    let errors = measure(&table, decode, &Points::isotropic(&points), truth(&field), TRUTH_ERROR)?;
    Ok(errors.lookup.max)
}
