//! The colour of rough metals: light that met several facets is more saturated, and models differ
//! in how much.

use rayon::prelude::*;
use serde::Serialize;

use super::{Lobe, Material, Surface, SurfaceError};
use lobefit::data::AlphaMap;
use lobefit_truth::integrate::walk::{CHANNELS, Walked, Walks, walk};
use lobefit_truth::optics::fresnel;

/// A metal by its complex index of refraction in red, green and blue.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Metal {
    /// Its name.
    pub name: &'static str,
    /// Real part.
    pub eta: [f64; CHANNELS],
    /// Extinction coefficient.
    pub k: [f64; CHANNELS],
}

/// Gold and copper: measured spectra reduced to three channels (about 650, 550 and 450 nm), as
/// pbrt's and Mitsuba's users pass them around.
pub const METALS: [Metal; 2] = [
    Metal { name: "gold", eta: [0.143, 0.375, 1.442], k: [3.983, 2.386, 1.603] },
    Metal { name: "copper", eta: [0.200, 0.924, 1.102], k: [3.912, 2.452, 2.142] },
];

impl Metal {
    /// Reflectance at normal incidence.
    pub fn f0(&self) -> [f64; CHANNELS] {
        std::array::from_fn(|c| fresnel::f0_of_conductor(self.eta[c], self.k[c]))
    }

    /// Reflectance at a cosine.
    pub fn reflectance(&self, cosine: f64) -> [f64; CHANNELS] {
        std::array::from_fn(|c| fresnel::conductor(self.eta[c], self.k[c], cosine))
    }
}

/// One metal at one roughness under one model: what a convex body of it sends back on average in an
/// environment of radiance 1.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ColourRow {
    /// The metal.
    pub metal: String,
    /// Roughness; alpha is its square.
    pub roughness: f64,
    /// The model: a lobe, or the random walk with the Fresnel it used.
    pub model: String,
    /// Albedo by channel.
    pub albedo: [f64; CHANNELS],
    /// Standard error of the albedo; 0 where it was integrated.
    pub standard_error: [f64; CHANNELS],
    /// 1 less the smallest over the largest channel.
    pub saturation: f64,
    /// Bound on the standard error of the saturation.
    pub saturation_error: f64,
}

/// Name of the walk with Schlick's Fresnel, which the lobes have too.
pub const WALK_SCHLICK: &str = "random walk";
/// Name of the walk with the exact Fresnel of a conductor.
pub const WALK_EXACT: &str = "random walk, exact Fresnel";

/// Every metal at every roughness: lobes by quadrature, correlated shadowing, and the random walk
/// with as many paths as given each.
///
/// # Errors
/// A roughness whose alpha is outside the range of surfaces; too few paths.
pub fn colour_table(
    metals: &[Metal],
    roughness: &[f64],
    walks: Walks,
) -> Result<Vec<ColourRow>, SurfaceError> {
    let places: Vec<(&Metal, f64)> =
        metals.iter().flat_map(|metal| roughness.iter().map(move |r| (metal, *r))).collect();
    let rows: Vec<Result<Vec<ColourRow>, SurfaceError>> =
        places.par_iter().map(|(metal, roughness)| at(metal, *roughness, walks)).collect();
    Ok(rows.into_iter().collect::<Result<Vec<_>, _>>()?.concat())
}

fn at(metal: &Metal, roughness: f64, walks: Walks) -> Result<Vec<ColourRow>, SurfaceError> {
    let (alpha, f0) = (AlphaMap::RoughnessSquared.alpha(roughness), metal.f0());
    let row = |model: &str, albedo: [f64; CHANNELS], standard_error: [f64; CHANNELS]| {
        let (saturation, saturation_error) = saturation(&albedo, &standard_error);
        let (metal, model) = (metal.name.to_string(), model.to_string());
        ColourRow { metal, roughness, model, albedo, standard_error, saturation, saturation_error }
    };
    let mut rows = Vec::new();
    let mut albedos = None;
    for lobe in Lobe::ALL {
        let material = Material::metal(alpha, f0, lobe);
        let surface = match albedos.take() {
            Some(albedos) => Surface::with(&material, albedos)?,
            None => Surface::new(&material)?,
        };
        rows.push(row(lobe.name(), surface.left_average().map(|left| 1.0 - left), [0.0; CHANNELS]));
        albedos = Some(surface.albedos().clone());
    }
    let over = [0.0, 1.0];
    let schlick = walk(alpha, over, walks, &|c| f0.map(|f0| fresnel::schlick(f0, 1.0 - c)))?;
    let exact = walk(alpha, over, walks, &|c| metal.reflectance(c))?;
    for (name, Walked { albedo, .. }) in [(WALK_SCHLICK, schlick), (WALK_EXACT, exact)] {
        rows.push(row(name, albedo.map(|x| x.value), albedo.map(|x| x.standard_error)));
    }
    Ok(rows)
}

/// 1 - min/max with a bound on its standard error, whatever the channels' correlation.
fn saturation(albedo: &[f64; CHANNELS], error: &[f64; CHANNELS]) -> (f64, f64) {
    let pick = |better: fn(f64, f64) -> bool| {
        (1..CHANNELS).fold(0, |best, c| if better(albedo[c], albedo[best]) { c } else { best })
    };
    let (low, high) = (pick(|a, b| a < b), pick(|a, b| a > b));
    if albedo[high] <= 0.0 {
        return (0.0, 0.0);
    }
    let ratio = albedo[low] / albedo[high];
    (1.0 - ratio, (error[low] + ratio * error[high]) / albedo[high])
}
