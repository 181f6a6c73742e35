//! What the bake found out, for the report.

mod selection;

pub(in crate::effects) use selection::{Selected, selected};

use super::fits::region as region_of_fit;
use super::pictures::{Grid, averages};
use super::tables::BakedTable;
use crate::approximate::{Dropped, Fit, Region};
use crate::data::{Place, Serves, Smith, Use};
use crate::effects::Deviation;
use crate::effects::context::Context;
use crate::effects::reflection::{Study, studies};
use crate::effects::{BakeError, origin};
use crate::plan::{Effect, Plan};
use crate::report::{
    self, ApproximationFinding, AverageFinding, ChannelFinding, EffectFinding, ErrorFigure, Findings,
    FitFinding, Furnace, LeftOut, Marked, StudySeries, TableFinding,
};
use crate::scene::Scene;
use lobefit_shade::code::{self, Language};

/// How often the furnace's departure from white is amplified.
const AMPLIFICATION: f64 = 10.0;

/// f0 of the curves of a blend: a dielectric of index 1.5.
const DIELECTRIC: f64 = 0.04;

/// The findings of the effect.
pub fn findings(
    scene: &Scene,
    plan: &Plan,
    called: &Effect,
    tables: &[BakedTable],
    fits: &[Fit],
    dropped: &[Dropped],
    context: &Context,
) -> Result<Findings, BakeError> {
    let shown = selected(fits, Use::Normalisation);
    let blends = selected(fits, Use::F0Blend);
    let mut averages = None;
    let mut truths = Vec::new();
    let mut furnace = None;
    let mut fit_findings = Vec::new();
    if let Some(job) = &plan.fit {
        let region = region_of_fit(job);
        let map = Grid::map(job.smith, &region, false, context);
        let curves = Grid::curves(job.smith, &region, context);
        truths.push(map.albedo());
        for one in &shown {
            fit_findings.push(fit_finding(one, &map, &curves)?);
        }
        if !blends.is_empty() {
            let (map, curves) = (Grid::split_map(&map, context), Grid::split_map(&curves, context));
            for one in &blends {
                fit_findings.push(blend_finding(one, &map, &curves)?);
            }
        }
        averages = average_finding(job.smith, &region, fits, context)?;
    } else if let Some(baked) = tables.first() {
        truths.push(Grid::map(scene.smith, &baked.region, false, context).albedo());
    }
    if let Some(region) = region_of_furnace(plan, tables) {
        furnace = Some(furnace_of(&Grid::furnace(scene.smith, &region, context), tables, &shown)?);
    }
    let studies = studies(scene.smith)?;
    Ok(Findings {
        origin: origin(scene, context),
        effects: vec![effect(called, tables, fits)],
        left_out: left_out(dropped),
        tables: tables.iter().filter_map(|t| table(t, context).transpose()).collect::<Result<_, _>>()?,
        truths,
        approximations: approximations(tables, fits),
        fits: fit_findings,
        averages,
        furnace,
        studies: studies.iter().map(study).collect(),
    })
}

/// Hypotheses that have no reliable fit in the scene.
pub(in crate::effects) fn left_out(dropped: &[Dropped]) -> Vec<LeftOut> {
    let fit = |d: &Dropped| LeftOut {
        effect: format!("fit {} ({})", d.hypothesis, d.norm),
        reason: d.reason.clone(),
    };
    dropped.iter().map(fit).collect()
}

fn region_of_furnace(plan: &Plan, tables: &[BakedTable]) -> Option<Region> {
    let of_fit = plan.fit.as_ref().map(region_of_fit);
    of_fit.or_else(|| tables.first().map(|t| t.region))
}

fn furnace_of(grid: &Grid, tables: &[BakedTable], shown: &[Selected]) -> Result<Furnace, BakeError> {
    let mut rows = vec![grid.uncompensated()];
    for table in tables {
        rows.extend(grid.furnace_of_table(table)?);
    }
    for one in shown {
        rows.push(grid.furnace_of_fit(one.fit)?);
    }
    Ok(Furnace {
        roughness: grid.roughness.values.clone(),
        mu: grid.mu.values.clone(),
        rows,
        amplification: AMPLIFICATION,
    })
}

fn fit_finding(one: &Selected, map: &Grid, curves: &Grid) -> Result<FitFinding, BakeError> {
    let fit = one.fit;
    Ok(FitFinding {
        name: fit.approximation.name.clone(),
        shown_as: one.because.into(),
        formula: code::print(Language::Wgsl, &fit.hypothesis, &fit.coefficients(), &[])?
            .text
            .trim_end()
            .to_string(),
        value: "N = 1/E".into(),
        curves: curves.fit_curves(fit)?,
        error: map.furnace_error(fit)?,
    })
}

/// A fit of f0 A + B: its curves are those of a dielectric, its errors those at the worse end of f0.
fn blend_finding(one: &Selected, map: &Grid, curves: &Grid) -> Result<FitFinding, BakeError> {
    let fit = one.fit;
    let formula = code::print(Language::Wgsl, &fit.hypothesis, &fit.coefficients(), &[])?;
    Ok(FitFinding {
        name: fit.approximation.name.clone(),
        shown_as: one.because.into(),
        formula: formula.text.trim_end().to_string(),
        value: format!("f0 A + B at f0 = {DIELECTRIC}"),
        curves: curves.blend_curves(fit, DIELECTRIC)?,
        error: map.blend_error(fit)?,
    })
}

/// The fits of E_avg over roughness; none where the scene wants none.
fn average_finding(
    smith: Smith,
    region: &Region,
    fits: &[Fit],
    context: &Context,
) -> Result<Option<AverageFinding>, BakeError> {
    let ours: Vec<&Fit> = fits.iter().filter(|f| f.approximation.quantity == "ggx-average").collect();
    if ours.is_empty() { Ok(None) } else { averages(smith, region, &ours, context).map(Some) }
}

fn approximations(tables: &[BakedTable], fits: &[Fit]) -> Vec<ApproximationFinding> {
    let fits = fits.iter().filter(|f| f.wraps.is_none()).map(|f| &f.approximation);
    tables.iter().map(|t| &t.approximation).chain(fits).map(ApproximationFinding::from).collect()
}

fn table(baked: &BakedTable, context: &Context) -> Result<Option<TableFinding>, BakeError> {
    let Some(table) = baked.table() else { return Ok(None) };
    let split = baked.serves == Serves::SplitSum;
    let map = Grid::map(table.smith, &baked.region, split, context);
    let channel =
        |c: &crate::data::Channel| ChannelFinding { name: c.name.clone(), texels: c.texels.clone() };
    Ok(Some(TableFinding {
        name: table.name.clone(),
        file: format!("tables/{}.exr", table.name),
        quantity: table.quantity.clone(),
        smith: table.smith,
        alpha_map: table.alpha_map,
        axes: table.axes.clone(),
        format: table.format,
        bytes: table.bytes(),
        channels: table.channels.iter().map(channel).collect(),
        errors: errors(baked),
        lookup_error: map.lookup_errors(baked)?,
    }))
}

/// The errors of a table, one line each.
fn errors(baked: &BakedTable) -> Vec<(String, ErrorFigure)> {
    let e = &baked.errors;
    let lookup = |what: &str, error: &Deviation| {
        (what.to_string(), ErrorFigure { max: error.max, rms: Some(error.rms), at: error.at.clone() })
    };
    let mut lines = vec![(
        "integration (bound)".to_string(),
        ErrorFigure { max: e.integration, rms: None, at: Place::new() },
    )];
    for r in &e.quantisation {
        let figure = ErrorFigure { max: r.max, rms: Some(r.rms), at: r.at.clone() };
        lines.push((format!("quantisation of {}", r.channel), figure));
    }
    lines.push(lookup("lookup of E", &e.lookup_e));
    lines.extend(e.lookup_b.iter().map(|b| lookup("lookup of B", b)));
    lines.push(lookup("lookup in use, weights of 8 bits", &e.lookup_8_bit));
    lines
}

fn effect(effect: &Effect, tables: &[BakedTable], fits: &[Fit]) -> EffectFinding {
    let (measured_error, metric) = measured(tables, fits);
    EffectFinding {
        effect: effect.effect.name().into(),
        because: effect.because.clone(),
        ranges: effect.ranges.iter().map(|(name, range)| (name.to_string(), *range)).collect(),
        approximation: effect.approximation.clone(),
        expected_error: effect.expected_error,
        measured_error,
        metric: metric.into(),
    }
}

/// The error of what was baked, and what error that is.
fn measured(tables: &[BakedTable], fits: &[Fit]) -> (Option<f64>, &'static str) {
    let of_tables = tables.iter().map(|t| t.errors.lookup.max).reduce(f64::max);
    let of_fits = fits
        .iter()
        .filter(|f| f.emitted && f.approximation.used_as == Use::Normalisation)
        .map(|f| f.approximation.certificate.max_abs)
        .reduce(f64::min);
    match (of_tables, of_fits) {
        (Some(table), Some(fit)) => (
            Some(table.max(fit)),
            "the larger of the worst table's lookup error and the best normalisation's furnace error |E N − 1|",
        ),
        (Some(table), None) => (Some(table), "lookup error of the worst table"),
        (None, Some(fit)) => (Some(fit), "furnace error |E N − 1| of the best normalisation"),
        (None, None) => (None, "neither a table nor a normalisation was made"),
    }
}

fn study(study: &Study) -> report::Study {
    let sources = &study.sources;
    report::Study {
        name: study.name.into(),
        alpha: study.alpha,
        mu: study.mu,
        series: study
            .series
            .iter()
            .map(|s| StudySeries {
                name: s.name.into(),
                evaluations: s.points.iter().map(|p| p.0 as u64).collect(),
                error: s.points.iter().map(|p| p.1).collect(),
            })
            .collect(),
        marked: Some(Marked {
            name: "the sources: 10 million samples, f32 running sum".into(),
            evaluations: sources.samples as u64,
            noise: sources.noise,
            bias: sources.bias,
        }),
    }
}
