//! The effect `anisotropy`: tables of E of the anisotropic reflection lobe over mu, roughness and
//! anisotropy, as the mean over the azimuth of the view or with it.
//!
//! | table | size | columns | rows | slices | texel |
//! |---|---|---|---|---|---|
//! | azimuth mean | 64 x 64 x 32 | mu, `homogeneous` | roughness | anisotropy, `aspect` | loss |
//! | with azimuth | 64 x 16 x 16 | the same | roughness | anisotropy, `aspect` | cubic of the azimuth |
//!
//! With the azimuth, `homogeneous` takes the alpha towards the view.

mod path_tracer;
mod points;
mod table;
mod truth;
mod ways;

use super::demand::Job;
use super::effect::Profile;
use super::table::{
    BakedTable, BuildError, Family, Further, LookupPoints, Made, RUN, Region, Sliced, Spec, TableJob, Truths,
    WaysFinding,
};
use super::who::{about, is_rough, named, reasons, stay_smooth, verb};
use super::{BakeError, NOTE_F0, NOTE_LOOKUP, NOTE_PATH_TRACER, ggx};
use crate::approximate::Memo;
use crate::data::{Layout, Serves, Smith, Table};
use crate::effects::Albedo;
use crate::scene::{Lobe, Material, Scene};
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::integrate::monte_carlo;
pub use lobefit_truth::optics::azimuth::Azimuth;
use path_tracer::NOTE as PATH_TRACER_NOTE;
pub use points::judged;
pub use table::{aniso_axes, azimuth_axes, path_tracer};
pub use truth::truths;

/// The quantity of this effect.
pub const QUANTITY: &str = "ggx-reflection-aniso";

/// The effect.
pub struct Anisotropy;

/// Seconds on one core of a sampled texel of the azimuth mean: integrated for 1e-6 on Chebyshev
/// nodes, interpolated, encoded. This and the next four from bakes of the path tracer's and of the
/// default sizes beside one of 8x8x4.
const SAMPLED_S: f64 = 3.8e-6;
/// The same of an optimised texel, whose targets are integrated for 1e-5.
const OPTIMISED_S: f64 = 1.5e-6;
/// Seconds of a texel with its azimuth: eight interpolated values and their cubic.
const AZIMUTH_S: f64 = 7.5e-6;
/// Seconds of the truth at the points where one table is measured: of the azimuth mean, and with
/// the azimuth.
const TRUTH_S: f64 = 0.6;
const AZIMUTH_TRUTH_S: f64 = 1.5;
/// Seconds of the study of what ignoring the azimuth costs.
const STUDY_S: f64 = 2.5;

impl Family for Anisotropy {
    fn prefix(&self, layout: Layout) -> &'static str {
        match layout {
            Layout::Azimuth => "ggx-aniso-azimuth",
            Layout::PathTracer => "path-tracer-reflection",
            _ => "ggx-aniso",
        }
    }

    fn role(&self, layout: Layout, _: Serves) -> &'static str {
        match layout {
            Layout::Azimuth => "ggx_aniso_azimuth_albedo",
            Layout::PathTracer => "path_tracer_reflection_albedo",
            _ => "ggx_aniso_albedo",
        }
    }

    fn described(&self, job: &TableJob, _: Option<Side>) -> String {
        let azimuth =
            if job.want.layout == Layout::Azimuth { " with its azimuth" } else { ", mean over the azimuth" };
        format!("of the anisotropic lobe{azimuth}")
    }

    fn seconds(&self, i: usize, jobs: &[TableJob]) -> f64 {
        let (texel, truth) = match jobs[i].want.layout {
            Layout::PathTracer => (SAMPLED_S, TRUTH_S),
            Layout::Azimuth => (AZIMUTH_S, AZIMUTH_TRUTH_S),
            _ => (OPTIMISED_S, TRUTH_S),
        };
        jobs[i].texels() as f64 * texel + truth
    }

    fn note(&self, layout: Layout) -> Option<&'static str> {
        (layout == Layout::PathTracer).then_some(PATH_TRACER_NOTE)
    }

    fn build(&self, spec: &Spec, memo: &Memo) -> Result<(Vec<Table>, Made), BuildError> {
        memo.add(spec.size.iter().product());
        table::build(spec)
    }

    fn finer(&self, job: &TableJob, _: &[TableJob]) -> bool {
        job.want.layout == Layout::Azimuth
    }

    fn points(&self, region: &Region, azimuth: bool) -> Result<LookupPoints, BuildError> {
        judged(region, azimuth)
    }

    fn truths(
        &self,
        smith: Smith,
        points: &LookupPoints,
        _: bool,
        memo: &Memo,
    ) -> Result<Truths, IntegrateError> {
        let (e, made, interpolants) = truths(smith, points)?;
        memo.add(e.len());
        let further = move |_, points: &LookupPoints, memo: &Memo| {
            memo.add(points.len());
            Ok(Albedo { e: truth::further(smith, points, &interpolants)?, b: Vec::new() })
        };
        Ok(Truths { sides: vec![Albedo { e, b: Vec::new() }], made, further: Further::new(further) })
    }
}

impl Sliced for Anisotropy {
    fn profile(&self) -> &Profile {
        const {
            &Profile {
                name: "anisotropy",
                prefixes: &["ggx_aniso_", "path_tracer_"],
                lobe: ggx,
                notes: &[
                    NOTE_PATH_TRACER,
                    NOTE_F0,
                    NOTE_LOOKUP,
                    (
                        &["anisotropy"],
                        &[
                            "anisotropy a in [0, 1] makes alpha_x = alpha/s and alpha_y = alpha s with s = sqrt(1 - 0.9 a); cos2_phi is the",
                            "squared cosine of the view's azimuth from the alpha_x axis.",
                        ],
                    ),
                ],
                ..Profile::NONE
            }
        }
    }

    fn lobe(&self) -> Lobe {
        Lobe::Anisotropic
    }

    fn lobe_text(&self) -> &'static str {
        "a rough anisotropic lobe"
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

    fn study_seconds(&self, scene: &Scene, jobs: &[Job]) -> f64 {
        let own = |job: &Job| TableJob::of(scene, job).is_ok_and(|job| job.want.layout != Layout::PathTracer);
        if jobs.iter().any(own) { STUDY_S } else { 0.0 }
    }

    fn shown(&self) -> &'static [f64] {
        &[0.0, 0.5, 1.0]
    }

    fn title(&self, slice: f64, _: Option<Side>) -> String {
        format!("Metal, anisotropy {slice} (mean over the azimuth)")
    }

    fn layer(&self, slice: f64) -> f64 {
        slice * slice
    }

    fn path_tracer_error(&self, [x, alpha, z]: [f64; 3]) -> Result<f64, IntegrateError> {
        let aspect = (1.0 - 0.9 * z.sqrt()).sqrt();
        let sampled = monte_carlo::aniso(Smith::Separable, [alpha / aspect, alpha * aspect], x, None, RUN)?;
        Ok(sampled[0].standard_error)
    }

    fn ways(&self, tables: &[BakedTable]) -> Result<Vec<WaysFinding>, BakeError> {
        ways::findings(tables)
    }
}
