//! What the bake found out, for the report.

use super::BakeError;
use super::context::Context;
use super::pictures::Grid;
use super::tables::BakedTable;
use crate::data::{Place, Serves, Use};
use crate::effects::reflection::{Dropped, Fit, LookupError, Study, studies};
use crate::emit::code;
use crate::plan::{Effect, Plan};
use crate::report::{
    self, ApproximationFinding, ChannelFinding, EffectFinding, ErrorFigure, Findings, FitFinding, Furnace,
    LeftOut, Marked, Origin, StudySeries, TableFinding,
};
use crate::scene::Scene;

/// How often the furnace's departure from white is amplified.
const AMPLIFICATION: f64 = 10.0;

/// The findings of a bake: empty lists where the plan called for nothing.
pub fn findings(
    scene: &Scene,
    plan: &Plan,
    tables: &[BakedTable],
    fits: &[Fit],
    dropped: &[Dropped],
    context: &Context,
) -> Result<Findings, BakeError> {
    let shown: Vec<&Fit> = shown(fits);
    let mut truths = Vec::new();
    let mut furnace = None;
    let mut fit_findings = Vec::new();
    if let Some(job) = &plan.fit {
        let region = crate::effects::reflection::Region {
            roughness: job.roughness,
            mu: job.mu,
            alpha_map: job.alpha_map,
        };
        let map = Grid::map(job.smith, &region, false, context);
        let curves = Grid::curves(job.smith, &region, context);
        truths.push(map.albedo());
        for fit in &shown {
            fit_findings.push(fit_finding(fit, &map, &curves)?);
        }
    } else if let Some(baked) = tables.first() {
        truths.push(Grid::map(scene.smith, &baked.region, false, context).albedo());
    }
    if let Some(region) = region_of_furnace(plan, tables) {
        furnace = Some(furnace_of(&Grid::furnace(scene.smith, &region, context), tables, &shown)?);
    }
    let studies = if plan.is_empty() { Vec::new() } else { studies(scene.smith)? };
    Ok(Findings {
        origin: Origin {
            scene: scene.name.clone(),
            recipe: context.recipe.hash.clone(),
            tool: env!("CARGO_PKG_VERSION").into(),
            command: context.recipe.command.clone(),
        },
        effects: plan.effects.iter().map(|e| effect(e, tables, fits)).collect(),
        left_out: left_out(plan, dropped),
        tables: tables.iter().filter_map(|t| table(t, context)).collect(),
        truths,
        approximations: approximations(tables, fits),
        fits: fit_findings,
        furnace,
        studies: studies.iter().map(study).collect(),
    })
}

/// Effects that the scene does not call for, and hypotheses that have no reliable fit in it.
fn left_out(plan: &Plan, dropped: &[Dropped]) -> Vec<LeftOut> {
    let effects =
        plan.left_out.iter().map(|l| LeftOut { effect: l.effect.name().into(), reason: l.reason.clone() });
    let fits = dropped
        .iter()
        .map(|d| LeftOut { effect: format!("fit {} ({})", d.hypothesis, d.norm), reason: d.reason.clone() });
    effects.chain(fits).collect()
}

/// The fits whose pictures are worth a reader's time: normalisations that nothing of ours beats in both cost and largest error,
/// and the source's published ones.
fn shown(fits: &[Fit]) -> Vec<&Fit> {
    let normalises =
        |f: &&Fit| f.approximation.used_as == Use::Normalisation && f.wraps.is_none() && f.emitted;
    let ours: Vec<&Fit> = fits.iter().filter(normalises).collect();
    let error = |f: &Fit| f.approximation.certificate.max_abs;
    let ops = |f: &Fit| f.approximation.cost.ops;
    let beaten = |f: &Fit| ours.iter().any(|o| ops(o) <= ops(f) && error(o) < error(f));
    ours.iter().copied().filter(|f| f.norm() == "published" || !beaten(f)).collect()
}

fn region_of_furnace(plan: &Plan, tables: &[BakedTable]) -> Option<crate::effects::reflection::Region> {
    let of_fit = plan.fit.as_ref().map(|job| crate::effects::reflection::Region {
        roughness: job.roughness,
        mu: job.mu,
        alpha_map: job.alpha_map,
    });
    of_fit.or_else(|| tables.first().map(|t| t.region))
}

fn furnace_of(grid: &Grid, tables: &[BakedTable], shown: &[&Fit]) -> Result<Furnace, BakeError> {
    let mut rows = vec![grid.uncompensated()];
    rows.extend(tables.iter().filter_map(|t| grid.furnace_of_table(t)));
    for fit in shown {
        rows.push(grid.furnace_of_fit(fit)?);
    }
    Ok(Furnace {
        roughness: grid.roughness.values.clone(),
        mu: grid.mu.values.clone(),
        rows,
        amplification: AMPLIFICATION,
    })
}

fn fit_finding(fit: &Fit, map: &Grid, curves: &Grid) -> Result<FitFinding, BakeError> {
    Ok(FitFinding {
        name: fit.approximation.name.clone(),
        formula: code::wgsl(&fit.hypothesis, &fit.coefficients(), &[])?.text.trim_end().to_string(),
        value: "N = 1/E".into(),
        curves: curves.fit_curves(fit)?,
        error: map.furnace_error(fit)?,
    })
}

fn approximations(tables: &[BakedTable], fits: &[Fit]) -> Vec<ApproximationFinding> {
    let fits = fits.iter().filter(|f| f.wraps.is_none()).map(|f| &f.approximation);
    tables.iter().map(|t| &t.approximation).chain(fits).map(ApproximationFinding::from).collect()
}

fn table(baked: &BakedTable, context: &Context) -> Option<TableFinding> {
    let table = baked.table()?;
    let split = baked.serves == Serves::SplitSum;
    let map = Grid::map(table.smith, &baked.region, split, context);
    let channel =
        |c: &crate::data::Channel| ChannelFinding { name: c.name.clone(), texels: c.texels.clone() };
    Some(TableFinding {
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
        lookup_error: map.lookup_errors(baked),
    })
}

/// The errors of a table, one line each.
fn errors(baked: &BakedTable) -> Vec<(String, ErrorFigure)> {
    let e = &baked.errors;
    let lookup = |what: &str, error: &LookupError| {
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
    let best = fits
        .iter()
        .filter(|f| f.emitted && f.approximation.used_as == Use::Normalisation)
        .map(|f| f.approximation.certificate.max_abs)
        .fold(f64::INFINITY, f64::min);
    let worst = tables.iter().map(|t| t.errors.lookup.max).fold(0.0, f64::max);
    let measured = if best.is_finite() { worst.max(best) } else { worst };
    EffectFinding {
        effect: effect.effect.name().into(),
        because: effect.because.clone(),
        ranges: effect.ranges.iter().map(|(name, range)| (name.to_string(), *range)).collect(),
        approximation: effect.approximation.clone(),
        expected_error: effect.expected_error,
        measured_error: measured,
        metric: "the larger of the tables' lookup error and the best normalisation's furnace error |E N - 1|"
            .into(),
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
