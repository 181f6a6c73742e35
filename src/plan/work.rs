//! The work model: how long the jobs last.
//!
//! An estimate for people who wait, not a promise: counts are those of the jobs' main loops; times are CPU seconds of a
//! release build on one core, from bakes of scenes that differ in one job, and vary by half with the load beside them.

use super::job::{CouplingJob, FitJob, ParallaxJob, SheenJob, TableJob, VolumeJob, VolumeSpan};
use crate::data::{Layout, Serves, VolumeLayout};
use crate::effects::reflection::{AVERAGES, BLENDS, NORMALISATIONS, RIVALS, SEEDS};
use crate::effects::{coupling, parallax, sheen};

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
/// Seconds of the truth of the fits of the sheen, and of one of them.
const SHEEN_TRUTH_S: f64 = 2.0;
const SHEEN_FIT_S: f64 = 0.15;
/// Seconds of the truths of the fits of a coupling and of their pictures, and of one of the fits.
const COUPLING_TRUTH_S: f64 = 3.3;
const COUPLING_FIT_S: f64 = 0.2;
/// Seconds of the truths of the fits of a lookup and of their grid, and of one of the fits with its total variation there.
const PARALLAX_TRUTH_S: f64 = 0.35;
const PARALLAX_FIT_S: f64 = 0.02;

/// Seconds of a sampled texel of the azimuth mean of an anisotropic lobe: integrated for 1e-6 on Chebyshev nodes, interpolated,
/// encoded. This and the next five from bakes of the path tracer's and of the default sizes beside one of 8x8x4.
const ANISO_SAMPLED_S: f64 = 3.8e-6;
/// The same of an optimised texel, whose targets are integrated for 1e-5.
const ANISO_OPTIMISED_S: f64 = 1.5e-6;
/// Seconds of a texel of an anisotropic lobe with its azimuth: eight interpolated values and their cubic.
const AZIMUTH_TEXEL_S: f64 = 7.5e-6;
/// Seconds of a sampled texel of one side of glass.
const GLASS_SAMPLED_S: f64 = 0.45e-6;
/// The same of an optimised texel.
const GLASS_OPTIMISED_S: f64 = 4.6e-6;
/// Seconds of the truth at the points where one table is judged: of the azimuth mean, with the azimuth, and of one side of glass.
const JUDGED_ANISO_S: f64 = 0.6;
const JUDGED_AZIMUTH_S: f64 = 1.5;
const JUDGED_GLASS_S: f64 = 0.3;

/// Seconds of the report of the effect: its studies and pictures.
pub(super) const REPORT_S: f64 = 0.7;
/// The same of each of the effects whose tables have three axes.
const VOLUME_REPORT_S: f64 = 0.3;
/// The same of lookups.
pub(super) const PARALLAX_REPORT_S: f64 = 0.2;
/// Seconds of the study of what ignoring the azimuth costs.
const AZIMUTH_STUDY_S: f64 = 2.5;

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

/// Bytes of a table's texels; of the largest size where it is open.
pub(super) fn table_bytes(job: &TableJob) -> u64 {
    let side = |n: Option<usize>| n.map_or(AUTO_SIDE, |n| n as u64);
    side(job.columns) * side(job.rows) * job.serves.channels() * job.format.bytes()
}

/// Bytes of the texels of one table of the job, all channels.
pub(super) fn volume_bytes(job: &VolumeJob) -> u64 {
    job.texels() as u64 * job.layout.channels() * job.format.bytes()
}

/// Seconds of one table of the job on one core.
pub(super) fn volume_seconds(job: &VolumeJob) -> f64 {
    let (texel, judged) = match (job.span, job.layout) {
        (VolumeSpan::Anisotropy(_), VolumeLayout::Optimised) => (ANISO_OPTIMISED_S, JUDGED_ANISO_S),
        (VolumeSpan::Anisotropy(_), VolumeLayout::PathTracer) => (ANISO_SAMPLED_S, JUDGED_ANISO_S),
        (VolumeSpan::Anisotropy(_), VolumeLayout::Azimuth) => (AZIMUTH_TEXEL_S, JUDGED_AZIMUTH_S),
        (VolumeSpan::Ior(_), VolumeLayout::PathTracer) => (GLASS_SAMPLED_S, JUDGED_GLASS_S),
        (VolumeSpan::Ior(_), _) => (GLASS_OPTIMISED_S, JUDGED_GLASS_S),
    };
    job.texels() as f64 * texel + judged
}

/// Seconds of the report of an effect with these jobs: the azimuth is studied where a table of an anisotropic lobe lies in a layout
/// of ours.
pub(super) fn volume_report_seconds<'a>(mut jobs: impl Iterator<Item = &'a VolumeJob>) -> f64 {
    let studied = |job: &VolumeJob| {
        matches!(job.span, VolumeSpan::Anisotropy(_)) && job.layout != VolumeLayout::PathTracer
    };
    VOLUME_REPORT_S + if jobs.any(studied) { AZIMUTH_STUDY_S } else { 0.0 }
}

/// Seconds of a fit job on one core: the truth at the points of the certificates, which all normalisations share; the
/// searches; a certificate for every fit, for the saturating form of every normalisation, and for the published formulas.
pub(super) fn fit_seconds(job: &FitJob) -> f64 {
    let normalisations = NORMALISATIONS.len() + job.hypotheses.len();
    let averages = if job.average { AVERAGES.len() } else { 0 };
    let searches = ((normalisations + averages) * job.norms.len()) as f64;
    let certificates = searches + (normalisations + SEEDS.len() + RIVALS.len()) as f64;
    let blends =
        if job.blend { BLEND_TRUTH_S + (BLENDS.len() * job.norms.len()) as f64 * BLEND_FIT_S } else { 0.0 };
    CERTIFIED * E_S + searches * OPTIMISE_S + certificates * CERTIFIED * EVALUATION_S + blends
}

/// Seconds of the fits of the sheen on one core.
pub(super) fn sheen_seconds(job: &SheenJob) -> f64 {
    SHEEN_TRUTH_S + (sheen::HYPOTHESES.len() * job.norms.len()) as f64 * SHEEN_FIT_S
}

/// Seconds of the fits of a coupling on one core.
pub(super) fn coupling_seconds(job: &CouplingJob) -> f64 {
    let fits = coupling::hypotheses(job.specular).len() * job.norms.len();
    COUPLING_TRUTH_S + fits as f64 * COUPLING_FIT_S
}

/// Seconds of the fits of lookups on one core.
pub(super) fn parallax_seconds(job: &ParallaxJob) -> f64 {
    let fits = parallax::HYPOTHESES.len() * job.norms.len() + parallax::RIVALS.len();
    PARALLAX_TRUTH_S + fits as f64 * PARALLAX_FIT_S
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::approximate::{Region, certification};
    use crate::scene::Scene;

    #[test]
    fn the_counts_are_those_of_the_program() {
        let alpha_map = crate::data::AlphaMap::default();
        let region = Region { roughness: [0.02, 1.0], mu: [0.01, 1.0], alpha_map };
        for (log2, counted) in [(17, JUDGED), (20, CERTIFIED)] {
            let points = certification(&region, log2).len() as f64;
            assert!((points / counted - 1.0).abs() < 0.01, "{points} points, {counted} in the model");
        }
    }

    /// CPU seconds of `bake --only EFFECT --threads 1` of the built-in scene.
    #[test]
    fn the_built_in_scene_is_estimated_within_a_factor_of_one_and_a_half() {
        let plan = crate::plan::plan(&Scene::built_in().expect("the built-in scene"));
        let measured = [
            ("reflection", 9.2),
            ("anisotropy", 6.3),
            ("glass", 6.1),
            ("diffuse-coupling", 6.9),
            ("parallax", 0.9),
        ];
        let within = |estimate: f64, measured: f64| (measured / 1.5..measured * 1.5).contains(&estimate);
        assert_eq!(plan.effects.len(), measured.len());
        for (effect, (name, seconds)) in plan.effects.iter().zip(measured) {
            assert_eq!(effect.effect.name(), name);
            assert!(within(effect.seconds, seconds), "{name}: {} for {seconds}", effect.seconds);
        }
        let all: f64 = plan.effects.iter().map(|effect| effect.seconds).sum();
        assert!(within(all, 28.5), "{all}");
    }

    #[test]
    fn a_table_with_the_azimuth_has_four_channels() {
        let text = r#"{"schema_version":1,"materials":[{"name":"m","kind":"metal","f0":1,"anisotropy":0.5,"roughness":1,
            "wants":{"tables":[{"layout":"azimuth","size":[8,6,4]}]}}]}"#;
        let plan = crate::plan::plan(&Scene::from_json(text.as_bytes(), "test").expect("a scene"));
        assert_eq!(plan.effects[0].bytes, 8 * 6 * 4 * 4 * 2);
    }

    #[test]
    fn more_work_takes_longer() {
        let job = |wants: &str| {
            let text = format!(
                r#"{{"schema_version":1,"materials":[{{"name":"m","kind":"metal","f0":1,"roughness":[0.02,1],"wants":{wants}}}]}}"#
            );
            crate::plan::plan(&Scene::from_json(text.as_bytes(), "test").expect("a scene")).effects[0].seconds
        };
        let table = |size: &str, more: &str| job(&format!(r#"{{"table":{{"size":{size}{more}}}}}"#));
        assert!(table("[32,32]", "") < table("[64,64]", ""));
        assert!(table("[32,32]", "") < table("[32,32]", r#","serves":"split-sum""#));
        assert!(table("[512,512]", r#","layout":"plain""#) < table("[512,512]", ""));
        let fit = |more: &str| job(&format!(r#"{{"fit":{{{more}}}}}"#));
        assert!(fit(r#""norms":["max"]"#) < fit(r#""norms":["max","rms"]"#));
        assert!(fit("") < fit(r#""average":true"#));
        assert!(fit("") < fit(r#""hypotheses":["a.wgsl"]"#));
    }

    #[test]
    fn more_work_takes_longer_with_three_axes() {
        let glass = |tables: &str| {
            let text = format!(
                r#"{{"schema_version":1,"materials":[{{"name":"m","kind":"glass","ior":1.5,"roughness":1,"wants":{{"tables":[{tables}]}}}}]}}"#
            );
            crate::plan::plan(&Scene::from_json(text.as_bytes(), "test").expect("a scene")).effects[0].seconds
        };
        assert!(glass("{}") < glass(r#"{},{"layout":"path-tracer"}"#));
        assert!(glass(r#"{"layout":"path-tracer"}"#) < glass("{}"));
        assert!(glass(r#"{"size":[64,64,32]}"#) < glass(r#"{"size":[64,64,33]}"#));
    }
}
