//! Surfaces that are a metal in part: the lobes of metal and dielectric are one but for their Fresnel terms
//! and what compensates them, and that is no linear function of f0. So f0 cannot be mixed first, as it can
//! be without compensation.

use crate::approximate::Region;
use crate::effects::BakeError;
use crate::scene::{Material, Mixed};
use lobefit_shade::Source;
use lobefit_shade::code::{CodeError, Language};
use lobefit_truth::points::Points;
use lobefit_truth::quantity::{Quantity, Specular, Variant};

/// The functions, without their comments.
pub const TEXT: &str = include_str!("mixed.wgsl");

/// Their names.
pub const NAMES: [&str; 3] = ["ggx_mixed_normalised", "ggx_mixed_compensated", "ggx_mixed_single"];

/// Places along each axis of the shortcut's error.
const SIDE: usize = 33;
const MIXES: usize = 17;

/// The function of a surface whose dielectric's lobe is multiplied so.
pub fn name(specular: Specular) -> &'static str {
    match specular {
        Specular::Normalised => NAMES[0],
        Specular::Compensated => NAMES[1],
        Specular::Single => NAMES[2],
    }
}

/// What mixing f0 first is off by.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Shortcut {
    /// The largest error of what a white environment sends back, negative where it is too dark.
    pub error: f64,
    /// The roughness, mu and metalness where it is.
    pub at: [f64; 3],
}

/// What it is off by over a region, at the worst of the materials.
///
/// # Errors
/// A truth that cannot be integrated.
pub fn shortcut(
    quantity: &dyn Quantity,
    variant: &Variant,
    (region, materials): (&Region, &[(&Material, &Mixed)]),
) -> Result<Shortcut, BakeError> {
    let along = |[low, high]: [f64; 2], i: usize, n: usize| low + (high - low) * i as f64 / (n - 1) as f64;
    let roughness: Vec<f64> = (0..SIDE).map(|i| along(region.roughness, i, SIDE)).collect();
    let alpha: Vec<f64> = roughness.iter().map(|r| region.alpha_map.alpha(*r)).collect();
    let mu: Vec<f64> = (0..SIDE).map(|i| along(region.mu, i, SIDE)).collect();
    let points = Points::product(&[("alpha", &alpha), ("mu", &mu)]);
    let truth = quantity.truth(variant, &points, &["E", "A", "B"], quantity.tolerance_of_many(variant))?;
    let [e, a, b] = truth.arrays();
    let mut worst = Shortcut::default();
    for (material, mixed) in materials {
        for (metal, dielectric) in material.f0.into_iter().flatten().zip(mixed.f0) {
            for (i, ((e, a), b)) in e.iter().zip(&a).zip(&b).enumerate() {
                let single = |f0: f64| f0 * a + b;
                let compensated = |f0: f64| single(f0) * (1.0 + f0 * (1.0 / e - 1.0));
                let below = match mixed.specular {
                    Specular::Normalised => single(dielectric) / e,
                    Specular::Compensated => compensated(dielectric),
                    Specular::Single => single(dielectric),
                };
                for m in (0..MIXES).map(|k| along(mixed.metalness, k, MIXES)) {
                    let both = below + m * (compensated(metal) - below);
                    let error = compensated(dielectric + m * (metal - dielectric)) - both;
                    if error.abs() > worst.error.abs() {
                        worst = Shortcut { error, at: [roughness[i % SIDE], mu[i / SIDE], m] };
                    }
                }
            }
        }
    }
    Ok(worst)
}

/// The function in a language.
///
/// # Errors
/// A text that does not parse, a defect of this program.
pub fn printed(
    language: Language,
    specular: Specular,
    (compensation, shortcut): (&str, &Shortcut),
) -> Result<String, BakeError> {
    let source = Source::parse("mixed.wgsl", TEXT).map_err(CodeError::from)?;
    let [roughness, mu, metalness] = shortcut.at.map(|x| lobefit_shade::round_up(x, 3));
    let (error, how) = (
        lobefit_shade::round_up(shortcut.error.abs(), 3),
        if shortcut.error < 0.0 { "dark" } else { "bright" },
    );
    let dielectric = match specular {
        Specular::Normalised => "n",
        Specular::Compensated => "1 + f0 (n - 1)",
        Specular::Single => "nothing",
    };
    let text = format!(
        "Fresnel's term (Schlick's) with the energy compensation of a surface that is a metal to the share metalness and a dielectric\n\
         else, per colour channel: multiply D and the visibility, which both share, by it. That is the mix of the two finished lobes.\n\
         schlick is (1 - v_dot_h)^5, n what `{compensation}` gives; the dielectric's lobe is multiplied by {dielectric}. Its error is that of n\n\
         at most, of each lobe. A compensated lobe of the mixed f0 in its place is too {how} in a white environment, by up to {error}\n\
         (measured at {SIDE} x {SIDE} x {MIXES} places; worst at roughness {roughness}, n_dot_v {mu}, metalness {metalness})."
    );
    let header: Vec<String> = text.lines().map(String::from).collect();
    Ok(format!("\n{}", source.print(language, name(specular), &header)?))
}
