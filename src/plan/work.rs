//! The work model: how many evaluations a job takes, and how long they last.
//!
//! An estimate for people who wait, not a promise: the count is that of the jobs' main loops, and the time of one
//! evaluation was measured on one core of a 2-core x86-64 virtual machine in a release build.

use super::job::{FitJob, TableJob};

/// Nanoseconds of one truth (E, A, B and loss at a point with its error bound) on the reference core.
const TRUTH_NS: f64 = 5_000.0;
/// Truths per texel: the texel itself and the off-grid points over which its lookup is optimised and judged.
const TRUTHS_PER_TEXEL: f64 = 17.0;
/// Texels of the squares that are tried one after the other where the size is left open: 16^2 + 32^2 + 64^2 + 128^2.
const AUTO_TEXELS: f64 = 21_760.0;
/// Truths of a fit: the grid fitted on.
const FIT_TRUTHS: f64 = 4_096.0;
/// Points of a certificate, each a truth interpolated from the grid and one evaluation of every fit.
const CERTIFICATE_POINTS: f64 = 1_048_576.0;
/// Nanoseconds of one point of a certificate.
const CERTIFICATE_NS: f64 = 100.0;
/// Hypotheses that are compiled in, about.
const OWN_HYPOTHESES: usize = 12;
/// Seconds of one optimisation, restarts and polish included.
const OPTIMISE_S: f64 = 0.15;

/// Side of the square that an open size is expected to end at.
const AUTO_SIDE: u64 = 32;

/// Seconds of a table job on one core.
pub(super) fn table_seconds(job: &TableJob) -> f64 {
    let texels = match (job.columns, job.rows) {
        (Some(columns), Some(rows)) => columns as f64 * rows as f64,
        _ => AUTO_TEXELS,
    };
    texels * TRUTHS_PER_TEXEL * TRUTH_NS * 1e-9
}

/// Bytes of a table's texels; of the expected size where it is open.
pub(super) fn table_bytes(job: &TableJob) -> u64 {
    let side = |n: Option<usize>| n.map_or(AUTO_SIDE, |n| n as u64);
    side(job.columns) * side(job.rows) * job.serves.channels() * job.format.bytes()
}

/// Seconds of a fit job on one core.
pub(super) fn fit_seconds(job: &FitJob) -> f64 {
    let fits = (OWN_HYPOTHESES + job.hypotheses.len()) as f64 * job.norms.len() as f64;
    FIT_TRUTHS * TRUTH_NS * 1e-9 + fits * (OPTIMISE_S + CERTIFICATE_POINTS * CERTIFICATE_NS * 1e-9)
}
