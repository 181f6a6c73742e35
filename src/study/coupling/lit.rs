//! The couplings under an environment, compared with the exact one.

use std::sync::Arc;

use rayon::prelude::*;

use super::candidates::{Candidate, RECIPROCAL, REFERENCE};
use super::parameters::{Lit, Parameters};
use crate::effects::surface::{Albedos, Lobe, Side, Surface};
use crate::optics::ggx::Vec3;
use crate::report::flip::{self, ErrorMap};
use crate::report::render::{Halves, Materials, inside, spheres};
use crate::report::{Image, LitRow, LitStrip};
use crate::study::StudyError;

/// Spheres of every lobe and reflectance.
pub(super) fn strips(parameters: &Parameters, candidates: &[Candidate]) -> Result<Vec<LitStrip>, StudyError> {
    let lit = &parameters.lit;
    let mut strips: Vec<LitStrip> = parameters
        .lobes
        .iter()
        .flat_map(|&lobe| lit.f0.iter().map(move |&f0| (lobe, f0)))
        .map(|(lobe, f0)| empty(parameters, candidates, lobe, f0))
        .collect();
    for &roughness in &lit.roughness {
        let albedos = Arc::new(Albedos::new(crate::data::Smith::Correlated, roughness * roughness, None)?);
        for (i, strip) in strips.iter_mut().enumerate() {
            let lobe = parameters.lobes[i / lit.f0.len()];
            column(strip, lit, candidates, lobe, roughness, &albedos)?;
        }
    }
    Ok(strips)
}

fn empty(parameters: &Parameters, candidates: &[Candidate], lobe: Lobe, f0: f64) -> LitStrip {
    let lit = &parameters.lit;
    let row = |candidate: &Candidate| LitRow {
        name: candidate.name().into(),
        flip: Vec::new(),
        flip_reciprocal: Vec::new(),
        error: Vec::new(),
        pictures: Vec::new(),
        maps: Vec::new(),
    };
    LitStrip {
        lobe: lobe.name().into(),
        f0,
        roughness: lit.roughness.clone(),
        noise: Vec::new(),
        flip_of_noise: Vec::new(),
        rows: candidates.iter().map(row).collect(),
        shown: lobe == parameters.lobes[0] && f0 == lit.shown_f0,
    }
}

/// Adds the spheres of one roughness.
fn column(
    strip: &mut LitStrip,
    lit: &Lit,
    candidates: &[Candidate],
    lobe: Lobe,
    roughness: f64,
    albedos: &Arc<Albedos>,
) -> Result<(), StudyError> {
    let surface = |c: &Candidate| {
        Surface::with(&c.material(roughness, strip.f0, lobe, lit.albedo), Arc::clone(albedos))
    };
    let surfaces = Surfaces(candidates.iter().map(surface).collect::<Result<_, _>>()?);
    let shown = spheres(&lit.environment, roughness * roughness, &surfaces, &lit.settings);
    let reference = Compared::new(&shown[REFERENCE]);
    let reciprocal = Compared::new(&shown[RECIPROCAL]);
    let sphere = inside(&lit.settings);
    let mean = |map: &ErrorMap| {
        let on: Vec<f64> =
            map.values.iter().zip(&sphere).filter(|(_, inside)| **inside).map(|(v, _)| *v).collect();
        crate::math::sum::mean(&on)
    };
    let flip = |a: &Image, b: &Image| flip::hdr(a, b, lit.pixels_per_degree);
    let measured: Vec<Result<Measured, StudyError>> = shown
        .par_iter()
        .map(|halves| {
            let own = Compared::new(halves);
            let (map, exposures) = flip(&reference.whole, &own.whole)?;
            let by_half = [0, 1].map(|i| flip(&reference.halves[i], &own.halves[i]));
            let [first, second] = by_half.map(|half| half.map(|(map, _)| mean(&map)));
            Ok(Measured {
                flip: mean(&map),
                reciprocal: mean(&flip(&reciprocal.whole, &own.whole)?.0),
                error: (first? - second?).abs() / 2.0,
                picture: flip::shown(&own.whole, (exposures.start + exposures.stop) / 2.0),
                map: map.values,
            })
        })
        .collect();
    for (row, measured) in strip.rows.iter_mut().zip(measured) {
        let measured = measured?;
        row.flip.push(measured.flip);
        row.flip_reciprocal.push(measured.reciprocal);
        row.error.push(measured.error);
        if strip.shown {
            row.pictures.push(measured.picture);
            row.maps.push(measured.map);
        }
    }
    let [error, light] = shown[REFERENCE].noise();
    strip.noise.push((error / light).sqrt());
    strip.flip_of_noise.push(mean(&flip(&reference.halves[0], &reference.halves[1])?.0));
    Ok(())
}

/// One coupling of one sphere.
struct Measured {
    flip: f64,
    reciprocal: f64,
    error: f64,
    picture: Image,
    map: Vec<f64>,
}

/// A picture with its halves.
struct Compared {
    whole: Image,
    halves: [Image; 2],
}

impl Compared {
    fn new(shown: &Halves) -> Compared {
        Compared { whole: shown.mean(), halves: shown.0.clone() }
    }
}

/// Materials that differ in their coupling alone: what is known of a light is the same for all of them.
struct Surfaces(Vec<Surface>);

impl Materials for Surfaces {
    fn count(&self) -> usize {
        self.0.len()
    }

    fn shade(&self, view: Vec3, lights: &[(Vec3, [f64; 3])], sums: &mut [[f64; 3]]) {
        let views: Vec<Side> = self.0.iter().map(|s| s.side(view[2])).collect();
        for &(light, weight) in lights {
            let side = self.0[0].side(light[2]);
            for ((sum, surface), own) in sums.iter_mut().zip(&self.0).zip(&views) {
                let parts = surface.between(&side, own, light, view);
                *sum = [0, 1, 2].map(|c| sum[c] + (parts.specular[c] + parts.base[c]) * weight[c]);
            }
        }
    }
}
