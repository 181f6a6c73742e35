//! What rough materials want of the lobe that only reflects: tables and one family of fits.

use std::collections::BTreeMap;

use super::{AVERAGES, BLENDS, NORMALISATIONS, RIVALS, SEEDS};
use crate::data::{AlphaMap, Smith, TexelFormat};
use crate::effects::demand::{Demand, Goals, JUDGED_MU, Job, Span};
use crate::effects::who::{about, is_rough, named, reasons, rough, stay_smooth, verb};
use crate::effects::{BakeError, JobSummary};
use crate::scene::{Layout, Lobe, Material, Scene, Serves, TableWant, Wants};

/// Seconds of one truth E.
const E_S: f64 = 0.65e-6;
/// Seconds of one truth E and B.
const SPLIT_S: f64 = 7e-6;
/// Seconds of one optimised texel of a table of E: some 17 truths and its share of the optimisation.
const TEXEL_E_S: f64 = 45e-6;
/// The same of a table of E and B.
const TEXEL_SPLIT_S: f64 = 370e-6;
/// Points at which the tables of a region are judged: 2^17 uniform, half as many in the layer, and the edges.
const JUDGED: f64 = 221_000.0;
/// Texels of the squares that are tried one after the other where the size is left open and 32x32 is found enough:
/// 16^2 + 32^2.
const AUTO_TEXELS: f64 = 1_280.0;
/// Side of the largest square that is tried for an open size.
const AUTO_SIDE: u64 = 128;
/// Points of a certificate of a fit: 2^20 uniform, half as many in the layer, and the edges.
const CERTIFIED: f64 = 1.6e6;
/// Seconds of one evaluation of one formula in its certificate.
const EVALUATION_S: f64 = 30e-9;
/// Seconds of one optimisation with its restarts: a round figure between the forms of one parameter and of twenty.
const OPTIMISE_S: f64 = 0.05;

/// Seconds of the truth of the fits of f0 A + B, and of one of them.
const BLEND_TRUTH_S: f64 = 3.3;
const BLEND_FIT_S: f64 = 0.2;
/// Name of the job of fits: one for the whole scene, because a fit over the hull of the ranges holds in each of them.
const FITS: &str = "normalisation";

/// One table to bake, for all materials that want the same size, format, layout and use.
#[derive(Clone, Debug, PartialEq)]
pub struct TableJob {
    /// Name, unique in its plan: `ggx-dfg-correlated-32x32`, and what differs from the defaults appended
    /// (`-f32`, `-plain`, `-split-sum`); `auto` in place of the size where the bake chooses it.
    pub name: String,
    /// Shadowing form.
    pub smith: Smith,
    /// How roughness becomes alpha.
    pub alpha_map: AlphaMap,
    /// Texels along mu; `None`: the bake chooses the smallest of 16, 32, 64, 128 squares that meets `max_error`.
    pub columns: Option<usize>,
    /// Texels along roughness; `None` exactly where `columns` is.
    pub rows: Option<usize>,
    /// How a texel is stored.
    pub format: TexelFormat,
    /// Coordinates.
    pub layout: Layout,
    /// What it is looked up for.
    pub serves: Serves,
    /// Roughness range: the hull of the materials' rough ranges, at least `ROUGHNESS_WIDTH_MIN` wide.
    pub roughness: [f64; 2],
    /// Limit on the lookup error: the strictest of the materials'. Always given where the size is not.
    pub max_error: Option<f64>,
    /// The materials that set `max_error`, with the field of each: `gold (materials[0].wants.table.max_error)`.
    pub limited_by: String,
}

/// What the materials of the fits want beside normalisations.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FitJob {
    /// Also fit E_avg(alpha).
    pub average: bool,
    /// Also fit f0 A + B.
    pub blend: bool,
    /// The user's hypothesis files, relative to the scene file, each once.
    pub hypotheses: Vec<String>,
}

/// Demands for tables and for fits, of each material that is rough.
pub(super) fn demands(scene: &Scene) -> Vec<Demand> {
    let of_material = |(of, material, range): (usize, &Material, [f64; 2])| {
        let demand = |job, rank, what, mu, goals| {
            let roughness = Span::roughness(range, scene.alpha);
            Demand {
                job,
                rank,
                of,
                item: 0,
                name: material.name.clone(),
                field: format!("materials[{of}].wants.{what}"),
                because: because(material, roughness),
                spans: BTreeMap::from([("mu", Span::new(mu)), ("roughness", roughness)]),
                goals,
            }
        };
        let table = material.wants.table.as_ref().map(|want| {
            demand(table_name(scene.smith, want), 0, "table", JUDGED_MU, Goals::error(want.max_error))
        });
        let fit = material.wants.fit.as_ref().map(|want| {
            let goals = Goals { max_ops: want.max_ops, max_error: want.max_error, norms: want.norms.clone() };
            demand(FITS.into(), 1, "fit", scene.mu, goals)
        });
        [table, fit]
    };
    rough(scene).flat_map(of_material).flatten().collect()
}

fn because(material: &Material, roughness: Span) -> String {
    let (name, kind, forms) = (&material.name, material.kind.name(), forms(&material.wants));
    let ignored = if material.anisotropy[1] > 0.0 {
        "; its anisotropy is left out of them: `wants.tables` makes tables that have it"
    } else {
        ""
    };
    let range = roughness.text();
    format!("{name}: {kind} with a rough specular lobe (roughness {range}) wants {forms}{ignored}")
}

/// The forms of approximation of the isotropic lobe that a material wants, in words. It wants at least one.
fn forms(wants: &Wants) -> &'static str {
    match (wants.table.is_some(), wants.fit.is_some()) {
        (true, true) => "a table and fits",
        (true, false) => "a table",
        (false, _) => "fits",
    }
}

/// Says everything that tells two tables of a scene apart, and the defaults not at all.
fn table_name(smith: Smith, want: &TableWant) -> String {
    let mut name = format!("ggx-dfg-{}-", smith.name());
    match want.size {
        Some([columns, rows]) => name += &format!("{columns}x{rows}"),
        None => name += "auto",
    }
    if want.format != TexelFormat::F16 {
        name = format!("{name}-{}", want.format.name());
    }
    if want.layout != Layout::default() {
        name = format!("{name}-{}", want.layout.name());
    }
    if want.serves != Default::default() {
        name = format!("{name}-{}", want.serves.name());
    }
    name
}

/// Why no material calls for it.
pub(super) fn left_out(scene: &Scene) -> String {
    if scene.materials.is_empty() {
        return "the scene has no materials".into();
    }
    let (rough, smooth): (Vec<&Material>, Vec<&Material>) =
        scene.materials.iter().partition(|m| is_rough(scene, m));
    if rough.is_empty() {
        return format!("no material has a rough specular lobe: {}", stay_smooth(&smooth));
    }
    // What is rough and wants neither table nor fits is anisotropic or glass.
    let (glass, anisotropic): (Vec<&Material>, Vec<&Material>) =
        rough.into_iter().partition(|m| m.lobe() == Lobe::Glass);
    let unwanted = |m: &[&Material]| {
        format!("{} {} anisotropic and {} tables of that", named(m), verb(m, "are"), verb(m, "want"))
    };
    let why = reasons([
        about(&anisotropic, unwanted),
        about(&glass, |m| format!("{} {} light", named(m), verb(m, "transmit"))),
        about(&smooth, stay_smooth),
    ]);
    format!("no material wants a table or fits of a lobe that only reflects: {}", why.unwrap_or_default())
}

/// The jobs of tables, and that of fits.
pub(super) fn parted(jobs: &[Job]) -> (&[Job], Option<&Job>) {
    match jobs.split_last() {
        Some((fits, tables)) if fits.name == FITS => (tables, Some(fits)),
        _ => (jobs, None),
    }
}

impl TableJob {
    /// The table of a job.
    ///
    /// # Errors
    /// A job of other demands than this effect's: a defect of the effect.
    pub fn of(scene: &Scene, job: &Job) -> Result<TableJob, BakeError> {
        let wants = |demand: &Demand| scene.materials.get(demand.of)?.wants.table.as_ref();
        let lacks = || BakeError::Internal(format!("{}: no table is wanted", job.name));
        let want = job.demands.first().and_then(wants).ok_or_else(lacks)?;
        Ok(TableJob {
            name: job.name.clone(),
            smith: scene.smith,
            alpha_map: scene.alpha,
            columns: want.size.map(|s| s[0]),
            rows: want.size.map(|s| s[1]),
            format: want.format,
            layout: want.layout,
            serves: want.serves,
            roughness: job.range("roughness")?,
            max_error: job.goals.max_error,
            limited_by: job.limited_by(),
        })
    }

    /// Those of all jobs of tables.
    ///
    /// # Errors
    /// As [`TableJob::of`].
    pub fn all(scene: &Scene, jobs: &[Job]) -> Result<Vec<TableJob>, BakeError> {
        parted(jobs).0.iter().map(|job| TableJob::of(scene, job)).collect()
    }

    /// Bytes of its texels; of the largest size where it is open.
    fn bytes(&self) -> u64 {
        let side = |n: Option<usize>| n.map_or(AUTO_SIDE, |n| n as u64);
        side(self.columns) * side(self.rows) * self.serves.channels() * self.format.bytes()
    }
}

impl FitJob {
    /// What the materials of a job of fits want.
    pub fn of(scene: &Scene, job: &Job) -> FitJob {
        let wants = |demand: &Demand| scene.materials.get(demand.of)?.wants.fit.as_ref();
        let mut fits = FitJob::default();
        for want in job.demands.iter().filter_map(wants) {
            fits.average |= want.average;
            fits.blend |= want.blend;
            let new = want.hypotheses.iter().filter(|path| !fits.hypotheses.contains(path));
            let new: Vec<String> = new.cloned().collect();
            fits.hypotheses.extend(new);
        }
        fits
    }
}

/// What a plan says of the tables and of the fits.
pub(super) fn summaries(scene: &Scene, jobs: &[Job]) -> Vec<JobSummary> {
    let (tables, fits) = parted(jobs);
    let known: Vec<(&Job, TableJob)> =
        tables.iter().filter_map(|job| Some((job, TableJob::of(scene, job).ok()?))).collect();
    let seconds = table_seconds(&known.iter().map(|(_, table)| table.clone()).collect::<Vec<_>>());
    let tables = known.iter().zip(seconds).map(|((job, table), seconds)| table_summary(job, table, seconds));
    tables.chain(fits.map(|job| fit_summary(scene, job))).collect()
}

fn table_summary(job: &Job, table: &TableJob, seconds: f64) -> JobSummary {
    let (format, layout, serves) = (table.format.name(), table.layout.name(), table.serves.name());
    let size = match (table.columns, table.rows) {
        (Some(columns), Some(rows)) => format!("{columns}x{rows}"),
        _ => "of the smallest sufficient size".into(),
    };
    JobSummary {
        name: job.name.clone(),
        approximation: format!("table {size} {format}, {layout} layout, for {serves}"),
        ranges: job.ranges.clone(),
        bytes: table.bytes(),
        bytes_at_most: table.columns.is_none(),
        expected_error: job.goals.max_error,
        seconds,
    }
}

fn fit_summary(scene: &Scene, job: &Job) -> JobSummary {
    let wants = FitJob::of(scene, job);
    let more = match (wants.average, wants.blend) {
        (true, true) => ", of the average albedo and of f0 A + B",
        (true, false) => " and of the average albedo",
        (false, true) => " and of f0 A + B",
        (false, false) => "",
    };
    JobSummary::fits(job, &format!("the normalisation{more}"), fit_seconds(job, &wants))
}

/// Seconds of each table job on one core. The truth at the points of a region is computed once, for the first of the
/// tables that are measured there.
fn table_seconds(jobs: &[TableJob]) -> Vec<f64> {
    let mut seen: Vec<[f64; 2]> = Vec::new();
    let mut seconds = Vec::with_capacity(jobs.len());
    for job in jobs {
        let texels = match (job.columns, job.rows) {
            (Some(columns), Some(rows)) => columns as f64 * rows as f64,
            _ => AUTO_TEXELS,
        };
        let mut total = texels * texel_seconds(job);
        if !seen.contains(&job.roughness) {
            seen.push(job.roughness);
            let split = |j: &TableJob| j.roughness == job.roughness && j.serves == Serves::SplitSum;
            total += JUDGED * if jobs.iter().any(split) { SPLIT_S } else { E_S };
        }
        seconds.push(total);
    }
    seconds
}

/// Seconds of a texel: optimised in the homogeneous layout, one sample in the plain ones.
fn texel_seconds(job: &TableJob) -> f64 {
    match (job.layout, job.serves) {
        (Layout::Homogeneous, Serves::Albedo) => TEXEL_E_S,
        (Layout::Homogeneous, Serves::SplitSum) => TEXEL_SPLIT_S,
        (_, Serves::Albedo) => E_S,
        (_, Serves::SplitSum) => SPLIT_S,
    }
}

/// Seconds of a fit job on one core: the truth at the points of the certificates, which all normalisations share; the
/// searches; a certificate for every fit, for the saturating form of every normalisation, and for the published formulas.
fn fit_seconds(job: &Job, wants: &FitJob) -> f64 {
    let norms = job.goals.norms.len();
    let normalisations = NORMALISATIONS.len() + wants.hypotheses.len();
    let averages = if wants.average { AVERAGES.len() } else { 0 };
    let searches = ((normalisations + averages) * norms) as f64;
    let certificates = searches + (normalisations + SEEDS.len() + RIVALS.len()) as f64;
    let blends = if wants.blend { BLEND_TRUTH_S + (BLENDS.len() * norms) as f64 * BLEND_FIT_S } else { 0.0 };
    CERTIFIED * E_S + searches * OPTIMISE_S + certificates * CERTIFIED * EVALUATION_S + blends
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::approximate::{Region, certification};

    #[test]
    fn the_counts_are_those_of_the_program() {
        let alpha_map = AlphaMap::default();
        let region = Region { roughness: [0.02, 1.0], mu: [0.01, 1.0], alpha_map };
        for (log2, counted) in [(17, JUDGED), (20, CERTIFIED)] {
            let points = certification(&region, log2).len() as f64;
            assert!((points / counted - 1.0).abs() < 0.01, "{points} points, {counted} in the model");
        }
    }
}
