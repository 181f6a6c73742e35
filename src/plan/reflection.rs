//! What a plan says of the reflection effect.

use std::collections::BTreeMap;

use super::effect::{Effect, EffectName, JobSummary};
use super::job::{FitJob, JUDGED_MU, TableJob};
use super::merge::{forms, isotropic, widened};
use super::work;
use crate::scene::Scene;

/// The reflection effect, where a rough material calls for it.
pub(super) fn effect(scene: &Scene, tables: &[TableJob], fit: Option<&FitJob>) -> Option<Effect> {
    let because: Vec<String> = isotropic(scene)
        .map(|(_, m, range)| {
            let (name, kind, forms) = (&m.name, m.kind.name(), forms(&m.wants));
            let roughness = range_text(range, widened(range, scene.alpha));
            let ignored = if m.anisotropy[1] > 0.0 {
                "; its anisotropy is left out of them: `wants.tables` makes tables that have it"
            } else {
                ""
            };
            format!(
                "{name}: {kind} with a rough specular lobe (roughness {roughness}) wants {forms}{ignored}"
            )
        })
        .collect();
    if because.is_empty() {
        return None;
    }
    let seconds = work::table_seconds(tables);
    let summaries = tables.iter().zip(seconds).map(|(job, seconds)| table_summary(job, seconds));
    let jobs: Vec<JobSummary> = summaries.chain(fit.map(fit_summary)).collect();
    Some(Effect::new(EffectName::Reflection, because, jobs, work::REPORT_S))
}

/// A range, and that of its job where it is too narrow for one.
pub(super) fn range_text(range: [f64; 2], job: [f64; 2]) -> String {
    let [lo, hi] = range;
    let own = if lo == hi { format!("{lo}") } else { format!("{lo} to {hi}") };
    if job == range {
        return own;
    }
    // Digits for people: the sums of widening have rounding errors behind them.
    let [lo, hi] = job.map(|x| (x * 1e9).round() / 1e9);
    format!("{own}, widened to {lo} to {hi}")
}

fn table_summary(job: &TableJob, seconds: f64) -> JobSummary {
    let (size, format, layout, serves) =
        (size_text(job), job.format.name(), job.layout.name(), job.serves.name());
    JobSummary {
        name: job.name.clone(),
        approximation: format!("table {size} {format}, {layout} layout, for {serves}"),
        ranges: BTreeMap::from([("mu", JUDGED_MU), ("roughness", job.roughness)]),
        bytes: work::table_bytes(job),
        bytes_at_most: job.columns.is_none(),
        expected_error: job.max_error,
        seconds,
    }
}

fn size_text(job: &TableJob) -> String {
    match (job.columns, job.rows) {
        (Some(columns), Some(rows)) => format!("{columns}x{rows}"),
        _ => "of the smallest sufficient size".into(),
    }
}

fn fit_summary(job: &FitJob) -> JobSummary {
    let ops = job.max_ops.map_or_else(|| "any number of".into(), |n| format!("up to {n}"));
    let more = match (job.average, job.blend) {
        (true, true) => ", of the average albedo and of f0 A + B",
        (true, false) => " and of the average albedo",
        (false, true) => " and of f0 A + B",
        (false, false) => "",
    };
    let norms: Vec<&str> = job.norms.iter().map(|n| n.name()).collect();
    JobSummary {
        name: "normalisation".into(),
        approximation: format!("fits of the normalisation{more}, {ops} operations, {}", norms.join(" and ")),
        ranges: BTreeMap::from([("mu", job.mu), ("roughness", job.roughness)]),
        bytes: 0,
        bytes_at_most: false,
        expected_error: job.max_error,
        seconds: work::fit_seconds(job),
    }
}
