//! The effects that a scene can call for, and why it does or does not.

use std::collections::BTreeMap;

use serde::Serialize;

use super::job::{FitJob, TableJob};
use super::merge::{forms, rough, widened};
use super::work;
use crate::data::AlphaMap;
use crate::scene::{Kind, Material, Scene};

/// Most materials that a reason names; the rest are counted.
const NAMED: usize = 3;

/// The names of effects, as the contract fixes them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
#[allow(missing_docs, reason = "the words are the contract's; `reason` says what each is")]
pub enum EffectName {
    Reflection,
    Anisotropy,
    Glass,
    DiffuseCoupling,
    Sheen,
    Clearcoat,
    OrenNayar,
    Parallax,
    Occlusion,
}

impl EffectName {
    /// All of them, in the contract's order.
    pub const ALL: [EffectName; 9] = [
        EffectName::Reflection,
        EffectName::Anisotropy,
        EffectName::Glass,
        EffectName::DiffuseCoupling,
        EffectName::Sheen,
        EffectName::Clearcoat,
        EffectName::OrenNayar,
        EffectName::Parallax,
        EffectName::Occlusion,
    ];

    /// The word used in options and in the manifest.
    pub fn name(self) -> &'static str {
        match self {
            EffectName::Reflection => "reflection",
            EffectName::Anisotropy => "anisotropy",
            EffectName::Glass => "glass",
            EffectName::DiffuseCoupling => "diffuse-coupling",
            EffectName::Sheen => "sheen",
            EffectName::Clearcoat => "clearcoat",
            EffectName::OrenNayar => "oren-nayar",
            EffectName::Parallax => "parallax",
            EffectName::Occlusion => "occlusion",
        }
    }

    /// The effect of a name.
    pub fn from_name(name: &str) -> Option<EffectName> {
        EffectName::ALL.into_iter().find(|e| e.name() == name)
    }
}

/// One job of an effect, for people and scripts.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct JobSummary {
    /// Name of the table; `normalisation` for the fits.
    pub name: String,
    /// What it is, in words.
    pub approximation: String,
    /// Domain by input.
    pub ranges: BTreeMap<&'static str, [f64; 2]>,
    /// Bytes of texels; the most that there can be where `bytes_at_most`.
    pub bytes: u64,
    /// Whether the bake chooses the size.
    pub bytes_at_most: bool,
    /// The error that the scene allows; `None` where it sets no limit.
    pub expected_error: Option<f64>,
    /// Expected time on one core.
    pub seconds: f64,
}

/// An effect that the scene calls for: the jobs, and their sum.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Effect {
    /// Its name.
    pub effect: EffectName,
    /// The materials that call for it, and why: one sentence each.
    pub because: Vec<String>,
    /// Hull of the jobs' domains, by input.
    pub ranges: BTreeMap<&'static str, [f64; 2]>,
    /// The jobs' approximations in words.
    pub approximation: String,
    /// Bytes of texels of all jobs; the most that there can be where `bytes_at_most`.
    pub bytes: u64,
    /// Whether the bake chooses the size of a table.
    pub bytes_at_most: bool,
    /// The largest error that the scene allows any of the jobs; `None` where one of them has no limit.
    pub expected_error: Option<f64>,
    /// Expected time of all jobs and of their report on one core.
    pub seconds: f64,
    /// The jobs one by one.
    pub jobs: Vec<JobSummary>,
}

/// An effect that is left out.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LeftOut {
    /// Its name.
    pub effect: EffectName,
    /// Why: not called for, or called for and not available in this version.
    pub reason: String,
}

/// The reflection effect, where a rough material calls for it.
pub(super) fn reflection(scene: &Scene, tables: &[TableJob], fit: Option<&FitJob>) -> Option<Effect> {
    let because: Vec<String> = rough(scene)
        .map(|(_, m, range)| {
            let (name, kind, forms) = (&m.name, m.kind.name(), forms(&m.wants));
            let roughness = range_text(range, scene.alpha);
            format!("{name}: {kind} with a rough specular lobe (roughness {roughness}) wants {forms}")
        })
        .collect();
    if because.is_empty() {
        return None;
    }
    let seconds = work::table_seconds(tables);
    let summaries = tables.iter().zip(seconds).map(|(job, seconds)| table_summary(job, seconds));
    let jobs: Vec<JobSummary> = summaries.chain(fit.map(fit_summary)).collect();
    let mut ranges: BTreeMap<&'static str, [f64; 2]> = BTreeMap::new();
    for (&input, &range) in jobs.iter().flat_map(|job| &job.ranges) {
        let hull = ranges.entry(input).or_insert(range);
        *hull = [hull[0].min(range[0]), hull[1].max(range[1])];
    }
    Some(Effect {
        effect: EffectName::Reflection,
        because,
        ranges,
        approximation: jobs.iter().map(|j| j.approximation.as_str()).collect::<Vec<_>>().join("; "),
        bytes: jobs.iter().map(|j| j.bytes).sum(),
        bytes_at_most: jobs.iter().any(|j| j.bytes_at_most),
        expected_error: jobs.iter().try_fold(0.0_f64, |worst, j| j.expected_error.map(|e| worst.max(e))),
        seconds: jobs.iter().map(|j| j.seconds).sum::<f64>() + work::REPORT_S,
        jobs,
    })
}

/// A roughness range, and what it is widened to where it is too narrow for a job.
fn range_text(range: [f64; 2], map: AlphaMap) -> String {
    let [lo, hi] = range;
    let own = if lo == hi { format!("{lo}") } else { format!("{lo} to {hi}") };
    let job = widened(range, map);
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
        // Where a table is judged, whatever the fits' domain of mu is.
        ranges: BTreeMap::from([("mu", [1e-3, 1.0]), ("roughness", job.roughness)]),
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
    let average = if job.average { " and of the average albedo" } else { "" };
    let norms: Vec<&str> = job.norms.iter().map(|n| n.name()).collect();
    JobSummary {
        name: "normalisation".into(),
        approximation: format!(
            "fits of the normalisation{average}, {ops} operations, {}",
            norms.join(" and ")
        ),
        ranges: BTreeMap::from([("mu", job.mu), ("roughness", job.roughness)]),
        bytes: 0,
        bytes_at_most: false,
        expected_error: job.max_error,
        seconds: work::fit_seconds(job),
    }
}

/// Why an effect is left out.
pub(super) fn reason(effect: EffectName, scene: &Scene) -> String {
    let lacks = match effect {
        EffectName::Reflection => return no_reflection(scene),
        EffectName::DiffuseCoupling => return diffuse_coupling(scene),
        EffectName::Anisotropy => "is anisotropic",
        EffectName::Glass => "transmits light",
        EffectName::Sheen => "has a sheen layer",
        EffectName::Clearcoat => "has a clear coat",
        EffectName::OrenNayar => "has a rough diffuse base",
        EffectName::Parallax => "calls for it: the scene has no probe",
        EffectName::Occlusion => "has an occlusion map",
    };
    format!("no material {lacks}")
}

fn no_reflection(scene: &Scene) -> String {
    if scene.materials.is_empty() {
        return "the scene has no materials".into();
    }
    let names = named(scene.materials.iter());
    let stay = if scene.materials.len() == 1 { "stays" } else { "stay" };
    format!("no material has a rough specular lobe: {names} {stay} below alpha 0.0001, which is smooth")
}

fn diffuse_coupling(scene: &Scene) -> String {
    let mut dielectrics = scene.materials.iter().filter(|m| m.kind == Kind::Dielectric).peekable();
    if dielectrics.peek().is_none() {
        return "no material is a dielectric with a diffuse base".into();
    }
    let names = named(dielectrics);
    format!("called for by {names} (the diffuse base of a dielectric); not available in this version")
}

/// The first names, and how many more there are.
fn named<'a>(materials: impl Iterator<Item = &'a Material>) -> String {
    let names: Vec<&str> = materials.map(|m| m.name.as_str()).collect();
    let mut text = names.iter().take(NAMED).map(|n| format!("`{n}`")).collect::<Vec<_>>().join(", ");
    if names.len() > NAMED {
        text += &format!(" and {} more", names.len() - NAMED);
    }
    text
}
