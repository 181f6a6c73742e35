//! The couplings under an environment, compared with the exact one.

use std::sync::Arc;

use rayon::prelude::*;

use super::Compared;
use super::candidates::{Candidate, RECIPROCAL, REFERENCE};
use super::parameters::Lit;
use crate::flip::{self, ErrorMap};
use crate::render::{Materials, inside, spheres};
use crate::study::StudyError;
use crate::study::coupling::findings::{LitRow, LitStrip};
use crate::study::coupling::surface::{Albedos, Base, Coupling, Facet, Side, Surface};
use lobefit::data::{AlphaMap, Smith};
use lobefit::report::Image;
use lobefit_truth::optics::ggx::Vec3;

/// Spheres of every lobe and reflectance.
pub(super) fn strips(lit: &Lit, compared: &[Compared]) -> Result<Vec<LitStrip>, StudyError> {
    let under = || compared.iter().flat_map(|c| lit.f0.iter().map(move |&f0| (c, f0)));
    let mut strips: Vec<LitStrip> =
        under().map(|(c, f0)| empty(lit, c, f0, lit.shown_of(c.lobe, f0).is_some())).collect();
    for &roughness in &lit.roughness {
        let alpha = AlphaMap::RoughnessSquared.alpha(roughness);
        let albedos = Arc::new(Albedos::new(Smith::Correlated, alpha)?);
        for (strip, (compared, _)) in strips.iter_mut().zip(under()) {
            column(strip, lit, compared, roughness, &albedos)?;
        }
    }
    Ok(strips)
}

fn empty(lit: &Lit, compared: &Compared, f0: f64, shown: bool) -> LitStrip {
    let row = |candidate: &Candidate| LitRow {
        name: candidate.name().into(),
        flip: Vec::new(),
        flip_reciprocal: Vec::new(),
        error: Vec::new(),
        pictures: Vec::new(),
        maps: Vec::new(),
    };
    LitStrip {
        lobe: compared.lobe.name().into(),
        f0,
        roughness: lit.roughness.clone(),
        noise: Vec::new(),
        flip_of_noise: Vec::new(),
        rows: compared.candidates.iter().map(row).collect(),
        shown,
    }
}

/// Adds the spheres of one roughness.
fn column(
    strip: &mut LitStrip,
    lit: &Lit,
    Compared { lobe, candidates }: &Compared,
    roughness: f64,
    albedos: &Arc<Albedos>,
) -> Result<(), StudyError> {
    let surface = |c: &Candidate| {
        Surface::with(&c.material(roughness, strip.f0, *lobe, lit.albedo), Arc::clone(albedos))
    };
    let surfaces = Surfaces(candidates.iter().map(surface).collect::<Result<_, _>>()?);
    let shown = spheres(&lit.environment, albedos.alpha, &surfaces, &lit.settings);
    let prepare = |picture: &Image| flip::Reference::new(picture, lit.pixels_per_degree);
    let reference = prepare(&shown[REFERENCE].mean())?;
    let halves = [prepare(&shown[REFERENCE].0[0])?, prepare(&shown[REFERENCE].0[1])?];
    let reciprocal = prepare(&shown[RECIPROCAL].mean())?;
    let sphere = inside(&lit.settings);
    let mean = |map: &ErrorMap| {
        let on: Vec<f64> =
            map.values.iter().zip(&sphere).filter(|(_, inside)| **inside).map(|(v, _)| *v).collect();
        lobefit_math::sum::mean(&on)
    };
    let measured: Vec<Result<Measured, StudyError>> = shown
        .par_iter()
        .map(|own| {
            let whole = own.mean();
            let map = reference.against(&whole)?;
            let by_half = [0, 1].map(|i| halves[i].against(&own.0[i]));
            let [first, second] = by_half.map(|half| half.map(|map| mean(&map)));
            Ok(Measured {
                flip: mean(&map),
                reciprocal: mean(&reciprocal.against(&whole)?),
                error: (first? - second?).abs() / 2.0,
                picture: flip::shown(&whole, lit.stops),
                map: map.values,
            })
        })
        .collect();
    let few = lit.shown_of(*lobe, strip.f0).is_some_and(|shown| shown.few);
    for ((row, measured), candidate) in strip.rows.iter_mut().zip(measured).zip(candidates) {
        let measured = measured?;
        row.flip.push(measured.flip);
        row.flip_reciprocal.push(measured.reciprocal);
        row.error.push(measured.error);
        if strip.shown && (!few || candidate.telling(candidates)) {
            row.pictures.push(measured.picture);
            row.maps.push(measured.map);
        }
    }
    let [error, light] = shown[REFERENCE].noise();
    strip.noise.push((error / light).sqrt());
    strip.flip_of_noise.push(mean(&halves[0].against(&shown[REFERENCE].0[1])?));
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

/// Materials that differ in their coupling alone: they share the specular part.
struct Surfaces(Vec<Surface>);

impl Surfaces {
    /// The direction that a light comes from as a surface knows it: the same for all but those
    /// whose factor is their own there too.
    fn light<'a>(surface: &Surface, common: &'a Side, own: &'a mut Side) -> &'a Side {
        match surface.material().base {
            Some(Base { coupling: Coupling::Symmetrised(_), .. }) => {
                *own = surface.own_side(common);
                own
            }
            _ => common,
        }
    }
}

impl Materials for Surfaces {
    fn count(&self) -> usize {
        self.0.len()
    }

    fn shade(&self, view: Vec3, lights: &[(Vec3, [f64; 3])], sums: &mut [[f64; 3]]) {
        let views: Vec<Side> = self.0.iter().map(|s| s.side(view[2])).collect();
        for &(light, weight) in lights {
            let (side, facet) = (self.0[0].side(light[2]), Facet::between(light, view));
            let specular = self.0[0].specular(&side, &views[0], &facet);
            for ((sum, surface), own) in sums.iter_mut().zip(&self.0).zip(&views) {
                let mut apart = side;
                let from = Self::light(surface, &side, &mut apart);
                let base = surface.base(from, own, &facet);
                *sum = [0, 1, 2].map(|c| sum[c] + (specular[c] + base[c]) * weight[c]);
            }
        }
    }
}
