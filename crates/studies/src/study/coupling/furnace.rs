//! The couplings in light of radiance 1 from everywhere.

use std::f64::consts::PI;
use std::sync::Arc;

use rayon::prelude::*;

use super::Compared;
use super::candidates::Candidate;
use super::parameters::Furnace;
use crate::study::StudyError;
use crate::study::coupling::findings::{FurnaceStrip, FurnaceStripRow};
use crate::study::coupling::surface::measure::{Rules, TOLERANCE};
use crate::study::coupling::surface::{Albedos, Lobe, Surface};
use lobefit::data::{AlphaMap, Smith};

/// Spheres of every lobe and reflectance; white bases.
pub(super) fn strips(furnace: &Furnace, compared: &[Compared]) -> Result<Vec<FurnaceStrip>, StudyError> {
    let under = || compared.iter().flat_map(|c| furnace.f0.iter().map(move |&f0| (c, f0)));
    let mut strips: Vec<FurnaceStrip> =
        under().map(|(c, f0)| empty(furnace, c, f0, shown(c.lobe, f0, compared[0].lobe, furnace))).collect();
    for &roughness in &furnace.roughness {
        let alpha = AlphaMap::RoughnessSquared.alpha(roughness);
        let albedos = Arc::new(Albedos::new(Smith::Correlated, alpha)?);
        let rules: Vec<Rules> = furnace.mu.par_iter().map(|&mu| Rules::new(alpha, mu)).collect();
        for (strip, (Compared { lobe, candidates }, f0)) in strips.iter_mut().zip(under()) {
            let columns: Vec<Result<Vec<f64>, StudyError>> = candidates
                .par_iter()
                .map(|candidate| column(candidate, (roughness, f0, *lobe), &albedos, (&furnace.mu, &rules)))
                .collect();
            for (row, albedo) in strip.rows.iter_mut().zip(columns) {
                let albedo = albedo?;
                row.worst.push(farthest(&albedo));
                row.albedo.push(albedo);
            }
        }
    }
    Ok(strips)
}

/// Whether the page shows the spheres: all under the first lobe, those of one dielectric and of
/// f0 = 1 under the others.
fn shown(lobe: Lobe, f0: f64, first: Lobe, furnace: &Furnace) -> bool {
    lobe == first || f0 == furnace.shown_f0 || f0 == 1.0
}

fn empty(furnace: &Furnace, compared: &Compared, f0: f64, shown: bool) -> FurnaceStrip {
    let row =
        |c: &Candidate| FurnaceStripRow { name: c.name().into(), worst: Vec::new(), albedo: Vec::new() };
    FurnaceStrip {
        lobe: compared.lobe.name().into(),
        f0,
        roughness: furnace.roughness.clone(),
        drawn: furnace.drawn.clone(),
        rows: compared.candidates.iter().map(row).collect(),
        mu: furnace.mu.clone(),
        shown,
    }
}

/// Albedos over mu: the lobe's, which is known, and the base's, which follows where the coupling
/// knows the view alone and is integrated where not.
fn column(
    candidate: &Candidate,
    (roughness, f0, lobe): (f64, f64, Lobe),
    albedos: &Arc<Albedos>,
    (mu, rules): (&[f64], &[Rules]),
) -> Result<Vec<f64>, StudyError> {
    let surface = Surface::with(&candidate.material(roughness, f0, lobe, [1.0; 3]), Arc::clone(albedos))?;
    let view_alone = |mu: f64| {
        let view = [((1.0 - mu) * (1.0 + mu)).sqrt(), 0.0, mu];
        surface.specular_albedo(mu)[0] + PI * surface.parts([0.0, 0.0, 1.0], view).base[0]
    };
    let albedo = |(&mu, rules): (&f64, &Rules)| {
        if candidate.directional() {
            Ok(surface.specular_albedo(mu)[0] + rules.base(&surface, TOLERANCE)?[0].value)
        } else {
            Ok(view_alone(mu))
        }
    };
    mu.iter().zip(rules).map(albedo).collect()
}

/// The departure from 1 with the largest magnitude.
fn farthest(albedo: &[f64]) -> f64 {
    albedo.iter().map(|a| a - 1.0).fold(0.0, |m: f64, d| if d.abs() > m.abs() { d } else { m })
}
