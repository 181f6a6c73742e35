//! The work model: how long the jobs last.
//!
//! An estimate for people who wait, not a promise: counts are those of the jobs' main loops; times were measured on one
//! core of a shared 2-core x86-64 virtual machine in a release build and vary by half with its load.

use super::job::{FitJob, TableJob};
use crate::data::Serves;

/// Seconds of one truth E.
const E_S: f64 = 0.65e-6;
/// Seconds of one truth E and B.
const SPLIT_S: f64 = 7.5e-6;
/// Seconds of one texel of a table: some 17 truths and its share of the optimisation.
const TEXEL_S: f64 = 330e-6;
/// Points at which the tables of a region are judged.
const JUDGED: f64 = 221_000.0;
/// Texels of the squares that are tried one after the other where the size is left open and 32x32 is found enough:
/// 16^2 + 32^2.
const AUTO_TEXELS: f64 = 1_280.0;
/// Side of the square that an open size is expected to end at.
const AUTO_SIDE: u64 = 32;
/// Points of a certificate of a fit.
const CERTIFIED: f64 = 1_048_576.0;
/// Seconds of one evaluation of one fit in its certificate.
const EVALUATION_S: f64 = 20e-9;
/// Hypotheses that are compiled in, about.
const OWN_HYPOTHESES: usize = 12;
/// Seconds of one optimisation with its restarts: a round figure between the forms of one parameter and of twenty.
const OPTIMISE_S: f64 = 0.15;

/// Seconds of each table job on one core. The truth at the points of a region is computed once, for the first of the
/// tables that are judged there.
pub(super) fn table_seconds(jobs: &[TableJob]) -> Vec<f64> {
    let mut seen: Vec<[f64; 2]> = Vec::new();
    let mut seconds = Vec::with_capacity(jobs.len());
    for job in jobs {
        let texels = match (job.columns, job.rows) {
            (Some(columns), Some(rows)) => columns as f64 * rows as f64,
            _ => AUTO_TEXELS,
        };
        let mut total = texels * TEXEL_S;
        if !seen.contains(&job.roughness) {
            seen.push(job.roughness);
            let split = |j: &TableJob| j.roughness == job.roughness && j.serves == Serves::SplitSum;
            total += JUDGED * if jobs.iter().any(split) { SPLIT_S } else { E_S };
        }
        seconds.push(total);
    }
    seconds
}

/// Bytes of a table's texels; of the expected size where it is open.
pub(super) fn table_bytes(job: &TableJob) -> u64 {
    let side = |n: Option<usize>| n.map_or(AUTO_SIDE, |n| n as u64);
    side(job.columns) * side(job.rows) * job.serves.channels() * job.format.bytes()
}

/// Seconds of a fit job on one core.
pub(super) fn fit_seconds(job: &FitJob) -> f64 {
    let fits = (OWN_HYPOTHESES + job.hypotheses.len()) as f64 * job.norms.len() as f64;
    CERTIFIED * E_S + fits * (OPTIMISE_S + CERTIFIED * EVALUATION_S)
}
