//! The effect `anisotropy`: tables of E of the anisotropic reflection lobe over mu, roughness and anisotropy, as the mean over the
//! azimuth of the view or with it.

mod path_tracer;
mod points;
mod table;
mod truth;

use super::context::Context;
use super::demand::{Demand, Job};
use super::effect::Note;
use super::table::{self as tables, TableJob};
use super::who::{about, is_rough, named, reasons, stay_smooth, verb};
use super::{BakeError, Called, Effect, JobSummary, Made};
use crate::data::Layout;
use crate::scene::{Lobe, Material, Scene};
pub use path_tracer::{NOTE as PATH_TRACER_NOTE, SIZE as PATH_TRACER_SIZE, axes as path_tracer_axes};
pub use points::Judge;
pub use table::{build, sources};
pub use truth::{AzimuthMap, at_azimuths, azimuth_map, means, means_on};

/// The quantity of this effect.
pub const QUANTITY: &str = "ggx-reflection-aniso";

/// The effect.
pub struct Anisotropy;

/// Seconds on one core of a sampled texel of the azimuth mean: integrated for 1e-6 on Chebyshev nodes, interpolated, encoded. This and
/// the next four from bakes of the path tracer's and of the default sizes beside one of 8x8x4.
const SAMPLED_S: f64 = 3.8e-6;
/// The same of an optimised texel, whose targets are integrated for 1e-5.
const OPTIMISED_S: f64 = 1.5e-6;
/// Seconds of a texel with its azimuth: eight interpolated values and their cubic.
const AZIMUTH_S: f64 = 7.5e-6;
/// Seconds of the truth at the points where one table is measured: of the azimuth mean, and with the azimuth.
const TRUTH_S: f64 = 0.6;
const AZIMUTH_TRUTH_S: f64 = 1.5;
/// Seconds of the study of what ignoring the azimuth costs.
const STUDY_S: f64 = 2.5;

impl Effect for Anisotropy {
    fn name(&self) -> &'static str {
        "anisotropy"
    }

    fn demands(&self, scene: &Scene) -> Vec<Demand> {
        tables::demands(scene, Lobe::Anisotropic)
    }

    fn left_out(&self, scene: &Scene) -> String {
        let anisotropic = scene.materials.iter().filter(|m| m.lobe() == Lobe::Anisotropic);
        let (rough, smooth): (Vec<&Material>, Vec<&Material>) = anisotropic.partition(|m| is_rough(scene, m));
        let rough = about(&rough, |m| format!("{} {} no table of it", named(m), verb(m, "want")));
        match reasons([rough, about(&smooth, stay_smooth)]) {
            Some(why) => format!("no anisotropic material calls for it: {why}"),
            None => "no material is anisotropic".into(),
        }
    }

    fn expects(&self, scene: &Scene, jobs: &[Job]) -> Vec<JobSummary> {
        tables::summaries(scene, jobs, |i, jobs| {
            let job = &jobs[i];
            let (texel, truth) = match job.layout {
                Layout::Optimised | Layout::Homogeneous | Layout::Plain | Layout::PlainSquared => {
                    (OPTIMISED_S, TRUTH_S)
                }
                Layout::PathTracer => (SAMPLED_S, TRUTH_S),
                Layout::Azimuth => (AZIMUTH_S, AZIMUTH_TRUTH_S),
            };
            job.texels() as f64 * texel + truth
        })
    }

    fn report_seconds(&self, scene: &Scene, jobs: &[Job]) -> f64 {
        let own = |job: &Job| TableJob::of(scene, job).is_ok_and(|job| job.layout != Layout::PathTracer);
        tables::REPORT_S + if jobs.iter().any(own) { STUDY_S } else { 0.0 }
    }

    fn prefixes(&self) -> &'static [&'static str] {
        &["ggx_aniso_", tables::PATH_TRACER]
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
                &["anisotropy"],
                &[
                    "anisotropy a in [0, 1] makes alpha_x = alpha/s and alpha_y = alpha s with s = sqrt(1 - 0.9 a); cos2_phi is the",
                    "squared cosine of the view's azimuth from the alpha_x axis.",
                ],
            ),
        ]
    }

    fn bake(&self, called: &Called, context: &Context) -> Result<Made, BakeError> {
        tables::bake::bake(called, context)
    }
}
