//! Jobs to measured tables.

use std::collections::BTreeMap;

use crate::data::{
    Approximation, Certificate, Channel, Cost, Decode, Form, Layout, Smith, Source, Table, Use,
};
use crate::effects::BakeError;
use crate::effects::context::Context;
use crate::effects::demand::JUDGED_MU;
use crate::effects::table::{Errors, Made, Points, Region, SliceAxis, Spec, TableJob, Truth, measure};
use crate::effects::{anisotropy, glass};

use lobefit_shade::round_up;
use lobefit_truth::integrate::glass::Side;

/// 2^12 groups of eight uniform points of glass, half as many in the layer and about the critical angle, and the edges.
const LOG2_GROUPS: u32 = 12;

/// A baked table: the approximation holds its quantised texels.
#[derive(Clone, Debug)]
pub struct BakedVolume {
    /// The table as an approximation: certificate of the lookup, cost, texels.
    pub approximation: Approximation,
    /// Its errors, told apart.
    pub errors: Errors,
    /// What its channels mean.
    pub decode: Decode,
    /// Coordinates.
    pub layout: Layout,
    /// Region in which it was measured.
    pub region: Region,
    /// Shadowing form.
    pub smith: Smith,
    /// Side of glass.
    pub side: Option<Side>,
    /// What its texels took; of both tables of glass together.
    pub made: Made,
}

impl BakedVolume {
    /// What the axes do not tell of the nodes, for headers.
    pub fn note(&self) -> Option<&'static str> {
        match (self.layout, self.side) {
            (Layout::PathTracer, None) => Some(anisotropy::PATH_TRACER_NOTE),
            (Layout::PathTracer, Some(_)) => Some(glass::PATH_TRACER_NOTE),
            _ => None,
        }
    }

    /// The quantised table.
    pub fn table(&self) -> Option<&Table> {
        match &self.approximation.form {
            Form::Table(table) => Some(table),
            Form::Formula(_) => None,
        }
    }
}

/// Truths at the points of one region, shared by the tables that are judged there.
pub struct Judge {
    smith: Smith,
    region: Region,
    azimuth: bool,
    /// The points.
    pub points: Points,
    /// By side; of an anisotropic lobe one.
    truths: Vec<Vec<f64>>,
    made: Made,
}

impl Judge {
    /// Integrates at the points of a region.
    pub fn new(smith: Smith, region: &Region, azimuth: bool) -> Result<Judge, BakeError> {
        let (points, truths, made) = match region.slices.axis {
            SliceAxis::Ior => {
                let points = Points::certification(region, LOG2_GROUPS);
                let truth = glass::Truth::at(smith, &points)?;
                (points, vec![truth.outside, truth.inside], truth.made)
            }
            SliceAxis::Anisotropy => {
                let judge = anisotropy::Judge::new(region, azimuth);
                let (truth, made) = if azimuth {
                    anisotropy::at_azimuths(smith, &judge)?
                } else {
                    anisotropy::means(smith, &judge)?
                };
                (judge.points, vec![truth], made)
            }
        };
        Ok(Judge { smith, region: *region, azimuth, points, truths, made })
    }

    /// Whether its points are at azimuths of their own in this region.
    pub fn has_azimuths(&self, smith: Smith, region: &Region) -> bool {
        self.azimuth && self.smith == smith && self.region == *region
    }

    /// E of a side.
    pub fn truth(&self, side: Option<Side>) -> Truth<'_> {
        Truth { e: &self.truths[usize::from(side == Some(Side::Inside))], b: None }
    }
}

/// What jobs gave.
pub struct Baked {
    /// The tables, in the order of the jobs.
    pub tables: Vec<BakedVolume>,
    /// The truths that they were measured against.
    pub judges: Vec<Judge>,
    /// The promises that tables do not keep, in words.
    pub broken: Vec<String>,
}

/// Bakes the jobs in order.
pub fn bake(jobs: &[TableJob], context: &Context) -> Result<Baked, BakeError> {
    let mut broken = Vec::new();
    let mut judges: Vec<Judge> = Vec::new();
    let mut baked = Vec::new();
    for job in jobs {
        context.progress.stage(&format!("table {}", job.names()));
        let (region, azimuth) = (region(job)?, job.layout == Layout::Azimuth);
        let known = |j: &Judge| j.smith == job.smith && j.region == region && j.azimuth == azimuth;
        let judge = match judges.iter().position(known) {
            Some(known) => &judges[known],
            None => {
                let judge = Judge::new(job.smith, &region, azimuth)?;
                context.counter.add(judge.truths.iter().map(Vec::len).sum());
                judges.push(judge);
                &judges[judges.len() - 1]
            }
        };
        let (tables, made) = build(job, &region)?;
        // By texel, as the tables of two axes count, though most come from fewer integrals than texels.
        context.counter.add(tables.iter().map(|table| table.size().iter().product::<usize>()).sum());
        for (table, planned) in tables.into_iter().zip(&job.tables) {
            let one = finish(job, &region, table, planned.side, made, judge)?;
            let error = one.errors.lookup.max;
            if let Some(limit) = job.max_error.filter(|limit| error.is_nan() || error > *limit) {
                let (name, by) = (&planned.name, &job.limited_by);
                broken.push(format!(
                    "table {name}: lookup error {error} exceeds the max_error {limit} of {by}"
                ));
            }
            if let Some(by) = &job.unjudged_by {
                let (name, least) = (&planned.name, job.roughness[0]);
                broken.push(format!(
                    "table {name}: rows begin at roughness {least}, above all of the material's, so that no lookup tells whether the \
                     max_error of {by} is kept: raise its roughness, or set a size without max_error"
                ));
            }
            baked.push(one);
        }
    }
    Ok(Baked { tables: baked, judges, broken })
}

/// Where a job's lookups must hold.
fn region(job: &TableJob) -> Result<Region, BakeError> {
    let none = || BakeError::Internal(format!("table {}: no slices", job.names()));
    let slices = job.slices.ok_or_else(none)?;
    Ok(Region { roughness: job.roughness, mu: JUDGED_MU, slices, alpha_map: job.alpha_map })
}

fn build(job: &TableJob, region: &Region) -> Result<(Vec<Table>, Made), BakeError> {
    let size = job.size.as_ref().and_then(|size| <[usize; 3]>::try_from(size.as_slice()).ok());
    let none = || BakeError::Internal(format!("table {}: not a size of three axes", job.names()));
    let size = size.ok_or_else(none)?;
    let spec = |name: &str| Spec {
        name: name.into(),
        smith: job.smith,
        size,
        format: job.format,
        layout: job.layout,
        region: *region,
    };
    match (region.slices.axis, job.tables.as_slice()) {
        (SliceAxis::Ior, [outside, inside]) => {
            let (tables, made) = glass::build(&[spec(&outside.name), spec(&inside.name)])?;
            Ok((tables.to_vec(), made))
        }
        (SliceAxis::Anisotropy, [one]) => {
            let (table, made) = anisotropy::build(&spec(&one.name))?;
            Ok((vec![table], made))
        }
        _ => Err(BakeError::Internal("a job of another number of tables than its lobe has".into())),
    }
}

fn finish(
    job: &TableJob,
    region: &Region,
    table: Table,
    side: Option<Side>,
    made: Made,
    judge: &Judge,
) -> Result<BakedVolume, BakeError> {
    let decode = Decode::of(job.layout, job.serves);
    let integration = made.integration.max(judge.made.integration);
    let mut errors = measure(&table, decode, &judge.points, judge.truth(side), round_up(integration, 2))?;
    for lookup in [&mut errors.lookup, &mut errors.lookup_8_bit, &mut errors.lookup_e] {
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
        domain: ranges(region),
        precision: format!("{} texels, f32 lookup", table.format.name()),
        points: errors.points as u64,
    };
    let ops = crate::data::lookup_ops(&table.axes, decode);
    let approximation = Approximation {
        name: table.name.clone(),
        quantity: table.quantity.clone(),
        column: "E".into(),
        used_as: Use::Value,
        smith: Some(table.smith),
        source: Source::Fitted,
        cost: Cost { ops, fetches: 1, bytes: table.bytes() },
        form: Form::Table(table.quantised()),
        certificate,
    };
    let (region, layout, smith) = (*region, job.layout, job.smith);
    Ok(BakedVolume { approximation, errors, decode, layout, region, smith, side, made })
}

/// The region by input, as certificates state it.
fn ranges(region: &Region) -> BTreeMap<String, [f64; 2]> {
    let inputs = [
        ("alpha", region.alpha()),
        ("mu", region.mu),
        ("roughness", region.roughness),
        (region.slices.axis.name(), region.slices.range),
    ];
    inputs.into_iter().map(|(name, range)| (name.to_string(), range)).collect()
}

/// The lookup error of a table with other texels, channels found by name.
///
/// Errors: a channel is missing; the truth cannot be integrated again.
pub fn measured_again(baked: &BakedVolume, channels: &[Channel]) -> Result<f64, BakeError> {
    let lacks = |what: &str| BakeError::Internal(format!("{}: no {what}", baked.approximation.name));
    let mut table = baked.table().ok_or_else(|| lacks("texels"))?.clone();
    for channel in &mut table.channels {
        let found = channels.iter().find(|c| c.name == channel.name);
        channel.texels = found.ok_or_else(|| lacks(&format!("channel {}", channel.name)))?.texels.clone();
    }
    let judge = Judge::new(table.smith, &baked.region, baked.layout == Layout::Azimuth)?;
    let errors = measure(&table, baked.decode, &judge.points, judge.truth(baked.side), 0.0)?;
    Ok(errors.lookup.max)
}
