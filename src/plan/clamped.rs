//! What a shader errs by that clamps roughness to the range that a scene promises, at the roughness that is
//! left out of it.

use crate::scene::Scene;
use crate::scene::limits::SLICED_ALPHA;
use lobefit_math::ops;
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::points::Points;
use lobefit_truth::quantity::{GGX_GLASS, GGX_REFLECTION, Quantity, Variant};

/// Cosines between those of the scene.
const COSINES: usize = 48;

/// Parts into which the roughness beyond an end of the range is cut.
const PARTS: usize = 4;

/// Tolerance of the albedos.
const TOLERANCE: f64 = 1e-4;

/// The largest error of E where roughness is clamped, and its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clamped {
    /// |E(clamped) - E|.
    pub error: f64,
    /// The roughness that is clamped.
    pub roughness: f64,
    /// Cosine of the view.
    pub mu: f64,
}

impl Clamped {
    /// The worst of the materials of these names, where their texels are over the roughness `all`: of E of
    /// GGX's lobe that reflects, of glass of E = R + T from either side at the ends of its indices of
    /// refraction.
    ///
    /// # Errors
    /// A truth that cannot be integrated.
    pub fn of(scene: &Scene, names: &[String], all: [f64; 2]) -> Result<Option<Clamped>, IntegrateError> {
        let mut worst: Option<Clamped> = None;
        let mut known = Vec::new();
        for material in scene.materials.iter().filter(|material| names.contains(&material.name)) {
            let iors = material.ior.filter(|_| material.lobe().is_glass());
            // Many materials are alike.
            if known.contains(&(material.roughness, iors)) {
                continue;
            }
            known.push((material.roughness, iors));
            let ranges = [material.roughness, all];
            let Some([low, high]) = iors else {
                worst = worse(worst, clamped(scene, (GGX_REFLECTION, None), ranges)?);
                continue;
            };
            let ends = if low == high { vec![low] } else { vec![low, high] };
            for (side, ior) in Side::ALL.into_iter().flat_map(|side| ends.iter().map(move |ior| (side, *ior)))
            {
                worst = worse(worst, clamped(scene, (GGX_GLASS, Some((side, ior))), ranges)?);
            }
        }
        Ok(worst)
    }
}

fn worse(a: Option<Clamped>, b: Option<Clamped>) -> Option<Clamped> {
    a.into_iter().chain(b).reduce(|a, b| if b.error > a.error { b } else { a })
}

/// The worst of one lobe, whose roughness is clamped to a range; none where nothing lies beyond it.
fn clamped(
    scene: &Scene,
    (quantity, from): (&dyn Quantity, Option<(Side, f64)>),
    [[low, high], [least, most]]: [[f64; 2]; 2],
) -> Result<Option<Clamped>, IntegrateError> {
    let [first, last] = scene.mu.map(ops::log);
    let mut places = Vec::new();
    for (end, beyond) in [(low, least.min(low)), (high, most.max(high))].into_iter().filter(|(a, b)| a != b) {
        for part in 1..=PARTS {
            let roughness = end + (beyond - end) * part as f64 / PARTS as f64;
            for i in 0..=COSINES {
                let mu = ops::exp(first + (last - first) * i as f64 / COSINES as f64)
                    .clamp(scene.mu[0], scene.mu[1]);
                places.push((roughness, end, mu));
            }
        }
    }
    if places.is_empty() {
        return Ok(None);
    }
    let alphas = places.iter().flat_map(|(roughness, end, _)| [*roughness, *end]);
    let alphas: Vec<f64> = alphas.map(|r| scene.alpha.alpha(r).max(SLICED_ALPHA)).collect();
    let mus = places.iter().flat_map(|(.., mu)| [*mu; 2]).collect();
    let mut columns = vec![("alpha", alphas), ("mu", mus)];
    columns.extend(from.map(|(_, ior)| ("ior", vec![ior; 2 * places.len()])));
    let variant =
        Variant { smith: Some(scene.smith), side: from.map(|(side, _)| side), ..Variant::default() };
    let [albedos] = quantity.truth(&variant, &Points::new(columns), &["E"], TOLERANCE)?.arrays();
    let off = |(pair, place): (&[f64], &(f64, f64, f64))| Clamped {
        error: (pair[0] - pair[1]).abs(),
        roughness: place.0,
        mu: place.2,
    };
    let all = albedos.chunks_exact(2).zip(&places).map(off);
    Ok(all.reduce(|a, b| if b.error > a.error { b } else { a }))
}
