//! What accuracy costs in seconds, as measured on one machine: not reproducible, so kept apart from
//! the findings.

use serde::Serialize;

use super::Origin;
use crate::data::{Smith, Use};

/// Measured times, offline and at run time.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Timings {
    /// What made it.
    pub origin: Origin,
    /// The machine, in words.
    pub device: String,
    /// Whole tables against the path tracer's estimator; none where the scene calls for no such
    /// table.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tables: Option<TimedTables>,
    /// Bakes of each effect by itself; none of a scene of one effect.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub effects: Option<TimedEffects>,
    /// Time per evaluation of each approximation.
    pub evaluations: Vec<TimedApproximation>,
    /// The lookups of the scene's probes.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub lookups: Vec<TimedLookup>,
}

/// Bakes of each effect by itself beside that of all.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TimedEffects {
    /// Each effect of the plan.
    pub alone: Vec<TimedEffect>,
    /// Seconds of a bake of all.
    pub all: f64,
}

/// What a bake of one effect takes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TimedEffect {
    /// Its name.
    pub effect: String,
    /// Seconds of the whole process.
    pub seconds: f64,
}

/// What the lookup of a probe takes at a pixel, without its fetches.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TimedLookup {
    /// Proxy, edges and fetches, in words.
    pub lookup: String,
    /// Texture fetches.
    pub fetches: u32,
    /// Nanoseconds per pixel in f64, measured.
    pub nanoseconds: f64,
}

/// What one approximation takes at run time.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TimedApproximation {
    /// Name of the approximation.
    pub name: String,
    /// Quantity that it approximates.
    pub quantity: String,
    /// Column of the quantity.
    pub column: String,
    /// What it is used as; decides what its error means.
    #[serde(rename = "use")]
    pub used_as: Use,
    /// Nanoseconds per evaluation, measured.
    pub nanoseconds: f64,
    /// Operations by the model of [`crate::data::Cost`].
    pub ops: u32,
    /// Largest error of its use.
    pub max_error: f64,
    /// Somebody else's.
    pub published: bool,
    /// A table, not a formula.
    pub table: bool,
}

/// The three tables of the path tracer: reflection over mu, roughness and anisotropy; rough glass
/// from either side over mu, alpha and the index of refraction.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TimedTables {
    /// Threads at work.
    pub threads: usize,
    /// Texels of the three together.
    pub texels: u64,
    /// One run for each accuracy asked for and Smith form.
    pub runs: Vec<TimedTableRun>,
    /// The path tracer's method on the same cores.
    pub estimator: TimedEstimator,
}

/// All three tables to one accuracy.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TimedTableRun {
    /// Instructions that the kernels were allowed: `best`, `at most AVX2`, `baseline`.
    pub instructions: &'static str,
    /// Largest error asked for at a texel.
    pub tolerance: f64,
    /// Shadowing form.
    pub smith: Smith,
    /// Seconds of the reflection table, its check against direct integration included.
    pub reflection_seconds: f64,
    /// Seconds of both glass tables, their check included.
    pub glass_seconds: f64,
    /// Integrand evaluations.
    pub evaluations: u64,
    /// Worst difference at the texels that were integrated directly.
    pub worst: f64,
    /// How many those are.
    pub checked: u64,
}

impl TimedTableRun {
    /// Seconds of all three tables.
    pub fn seconds(&self) -> f64 {
        self.reflection_seconds + self.glass_seconds
    }
}

/// Random visible normals, as the path tracer draws them.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TimedEstimator {
    /// Samples a second on all threads: reflection, glass.
    pub samples_per_second: [f64; 2],
    /// Root mean square of a sample's standard deviation over the texels tried: reflection, glass.
    pub deviation: [f64; 2],
    /// Samples a texel in the path tracer.
    pub samples_per_texel: f64,
    /// Seconds for all texels at that number, extrapolated from the rate.
    pub seconds: f64,
}
