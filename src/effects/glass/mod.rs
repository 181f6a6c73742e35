//! The effect `glass`: tables of R + T of a rough dielectric interface over mu, roughness and index of refraction, one for rays from
//! outside and one for rays from inside.

mod path_tracer;
mod table;

use rayon::prelude::*;

use super::context::Context;
use super::demand::{Demand, Job};
use super::effect::Note;
use super::table as tables;
use super::who::stay_smooth;
use super::{BakeError, Called, Effect, JobSummary, Made as Baked};
use crate::data::Layout;
use crate::data::Smith;
use crate::effects::table::{Made, Points};
use crate::scene::{Lobe, Material, Scene};
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::integrate::glass::table::{Energies, Kernel};

pub use path_tracer::{
    NOTE as PATH_TRACER_NOTE, SIZE as PATH_TRACER_SIZE, axes as path_tracer_axes, grid as path_tracer_grid,
};
pub use table::{build, sources};

/// The quantity of this effect.
pub const QUANTITY: &str = "ggx-glass";

/// The effect.
pub struct Glass;

/// Seconds on one core of a sampled and of an optimised texel of one side, and of the truth at the points where a table is measured.
const SAMPLED_S: f64 = 0.45e-6;
const OPTIMISED_S: f64 = 4.6e-6;
const TRUTH_S: f64 = 0.3;

impl Effect for Glass {
    fn name(&self) -> &'static str {
        "glass"
    }

    fn demands(&self, scene: &Scene) -> Vec<Demand> {
        tables::demands(scene, Lobe::Glass)
    }

    fn left_out(&self, scene: &Scene) -> String {
        let glass: Vec<&Material> = scene.materials.iter().filter(|m| m.lobe() == Lobe::Glass).collect();
        if glass.is_empty() {
            return "no material transmits light".into();
        }
        format!("no glass is rough: {}", stay_smooth(&glass))
    }

    fn expects(&self, scene: &Scene, jobs: &[Job]) -> Vec<JobSummary> {
        tables::summaries(scene, jobs, |i, jobs| {
            let job = &jobs[i];
            let texel = if job.layout == Layout::PathTracer { SAMPLED_S } else { OPTIMISED_S };
            job.texels() as f64 * texel + TRUTH_S
        })
    }

    fn report_seconds(&self, _: &Scene, _: &[Job]) -> f64 {
        tables::REPORT_S
    }

    fn prefixes(&self) -> &'static [&'static str] {
        &["ggx_glass_", tables::PATH_TRACER]
    }

    fn lobe(&self, scene: &Scene) -> String {
        super::ggx(scene)
    }

    fn notes(&self) -> &'static [Note] {
        &[
            super::NOTE_PATH_TRACER,
            super::NOTE_F0,
            super::NOTE_LOOKUP,
            (
                &["ior: f32", "float ior"],
                &["ior is the index of refraction, inside over outside, for rays from either side."],
            ),
        ]
    }

    fn bake(&self, called: &Called, context: &Context) -> Result<Baked, BakeError> {
        tables::bake::bake(called, context)
    }
}

/// Tolerance of the truths that lookups are judged against.
const JUDGED: f64 = 1e-6;

/// E from outside and from inside at every point.
#[derive(Clone, Debug, PartialEq)]
pub struct Truth {
    /// From outside.
    pub outside: Vec<f64>,
    /// From inside.
    pub inside: Vec<f64>,
    /// What it took.
    pub made: Made,
}

impl Truth {
    /// Integrates at every point, within 1e-6.
    pub fn at(smith: Smith, points: &Points) -> Result<Truth, IntegrateError> {
        let inputs: Vec<[f64; 3]> =
            points.all.iter().map(|p| [f64::from(p.alpha), f64::from(p.mu), f64::from(p.ior)]).collect();
        let (both, evaluations) = energies(smith, &inputs, JUDGED)?;
        Ok(Truth {
            outside: both.iter().map(|e| e[0]).collect(),
            inside: both.iter().map(|e| e[1]).collect(),
            made: Made { evaluations, integration: JUDGED },
        })
    }

    /// Of one side.
    pub fn of(&self, side: Side) -> &[f64] {
        match side {
            Side::Outside => &self.outside,
            Side::Inside => &self.inside,
        }
    }
}

/// Points of one task: work is cut by index alone.
const CHUNK: usize = 256;

/// E of both sides at (alpha, mu, ior), and the evaluations that took. Neighbours of the same alpha and mu share their rings.
fn energies(
    smith: Smith,
    inputs: &[[f64; 3]],
    tolerance: f64,
) -> Result<(Vec<[f64; 2]>, u64), IntegrateError> {
    let kernel = Kernel::new(smith, tolerance)?;
    let parts: Vec<(Vec<[f64; 2]>, u64)> = inputs
        .par_chunks(CHUNK)
        .map(|chunk| {
            let mut evaluations = 0;
            let mut values = Vec::with_capacity(chunk.len());
            for same in chunk.chunk_by(|a, b| a[..2] == b[..2]) {
                let iors: Vec<f64> = same.iter().map(|[_, _, ior]| *ior).collect();
                let mut energies = vec![Energies::default(); iors.len()];
                evaluations += kernel.energies(same[0][0], same[0][1], &iors, &mut energies)?;
                values.extend(energies.iter().map(Energies::e));
            }
            Ok((values, evaluations))
        })
        .collect::<Result<_, IntegrateError>>()?;
    let evaluations = parts.iter().map(|(_, n)| n).sum();
    Ok((parts.into_iter().flat_map(|(values, _)| values).collect(), evaluations))
}
