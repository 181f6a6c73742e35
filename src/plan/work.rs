//! The work model: how long the jobs last.
//!
//! An estimate for people who wait, not a promise: counts are those of the jobs' main loops; times are CPU seconds of a
//! release build on one core, from bakes of scenes that differ in one job, and vary by half with the load beside them.

use super::job::{FitJob, TableJob, VolumeJob, VolumeSpan};
use crate::data::{Layout, Serves, VolumeLayout};

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
/// Normalisations with free parameters that are compiled in.
const NORMALISATIONS: usize = 14;
/// The same of the average albedo.
const AVERAGES: usize = 1;
/// Published formulas: measured in every fit job, not fitted.
const PUBLISHED: usize = 12;
/// Seconds of one optimisation with its restarts: a round figure between the forms of one parameter and of twenty.
const OPTIMISE_S: f64 = 0.05;

/// Seconds of a texel of the azimuth mean of an anisotropic lobe, integrated for 1e-6 on Chebyshev nodes and interpolated:
/// 0.5 s for 64x64x32. Measured of a prototype, like the next two.
const ANISO_TEXEL_S: f64 = 3.8e-6;
/// Seconds of a texel of an anisotropic lobe with its azimuth: one direct integral, some 2e3 evaluations at 8 ns.
const AZIMUTH_TEXEL_S: f64 = 20e-6;
/// Seconds of a texel of glass, integrated for 1e-6 at the nodes of alpha and interpolated: 0.6 s for 2 x 128x128x32.
const GLASS_TEXEL_S: f64 = 0.6e-6;
/// What a table costs in a layout of ours, whose texels are optimised and whose lookup is judged, in multiples of its
/// texels' integrals. A guess, until such a bake is measured.
const OPTIMISED: f64 = 4.0;

/// Seconds of the report of the effect: its studies and pictures.
pub(super) const REPORT_S: f64 = 0.7;
/// The same of each of the effects whose tables have three axes. A guess, until such a bake is measured.
pub(super) const VOLUME_REPORT_S: f64 = 0.5;

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
    let texel = match (job.span, job.layout) {
        (VolumeSpan::Anisotropy(_), VolumeLayout::Azimuth) => AZIMUTH_TEXEL_S,
        (VolumeSpan::Anisotropy(_), _) => ANISO_TEXEL_S,
        (VolumeSpan::Ior(_), _) => GLASS_TEXEL_S,
    };
    let work = if job.layout == VolumeLayout::PathTracer { 1.0 } else { OPTIMISED };
    job.texels() as f64 * texel * work
}

/// Seconds of a fit job on one core: the truth at the points of the certificates, which all normalisations share; the
/// searches; a certificate for every fit, for the saturating form of every normalisation, and for the published formulas.
pub(super) fn fit_seconds(job: &FitJob) -> f64 {
    let normalisations = NORMALISATIONS + job.hypotheses.len();
    let averages = if job.average { AVERAGES } else { 0 };
    let searches = ((normalisations + averages) * job.norms.len()) as f64;
    let certificates = searches + (normalisations + PUBLISHED) as f64;
    CERTIFIED * E_S + searches * OPTIMISE_S + certificates * CERTIFIED * EVALUATION_S
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::reflection::{Region, catalogue_sources, certification};
    use crate::scene::Scene;

    #[test]
    fn the_counts_are_those_of_the_program() {
        assert_eq!(NORMALISATIONS + AVERAGES + PUBLISHED, catalogue_sources().count());
        let alpha_map = crate::data::AlphaMap::default();
        let region = Region { roughness: [0.02, 1.0], mu: [0.01, 1.0], alpha_map };
        for (log2, counted) in [(17, JUDGED), (20, CERTIFIED)] {
            let points = certification(&region, log2).len() as f64;
            assert!((points / counted - 1.0).abs() < 0.01, "{points} points, {counted} in the model");
        }
    }

    /// 9 CPU seconds were measured of the bake of the built-in scene on one core.
    #[test]
    fn the_built_in_scene_is_estimated_within_a_factor_of_two() {
        let plan = crate::plan::plan(&Scene::built_in().expect("the built-in scene"));
        let seconds = plan.effects[0].seconds;
        assert!((4.5..18.0).contains(&seconds), "{seconds}");
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
