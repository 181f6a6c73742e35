//! Surfaces that are a metal in part: the lobes of metal and dielectric are one but for their Fresnel terms
//! and what compensates them, and that is no linear function of f0. So f0 cannot be mixed first, as it can
//! be without compensation.

use crate::approximate::Region;
use crate::effects::BakeError;
use crate::scene::{Material, Mixed};
use lobefit_math::ops;
use lobefit_shade::Source;
use lobefit_shade::code::{CodeError, Language};
use lobefit_truth::points::Points;
use lobefit_truth::quantity::{Quantity, Specular, Variant};

/// The functions, without their comments.
pub const TEXT: &str = include_str!("mixed.wgsl");

/// Their names.
pub const NAMES: [&str; 3] = ["ggx_mixed_normalised", "ggx_mixed_compensated", "ggx_mixed_single"];

/// Places along each axis of the shortcut's error.
const SIDE: usize = 65;

/// The function of a surface whose dielectric's lobe is multiplied so.
pub fn name(specular: Specular) -> &'static str {
    match specular {
        Specular::Normalised => NAMES[0],
        Specular::Compensated => NAMES[1],
        Specular::Single => NAMES[2],
    }
}

/// What mixing f0 first loses.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Shortcut {
    /// The largest part of the light of a white environment that is missing.
    pub lost: f64,
    /// The roughness, mu and metalness where it is.
    pub at: [f64; 3],
}

/// What it loses for a material over its part of a region, beside the mix of two lobes that are both
/// compensated as a metal's is. With k = 1/E - 1 such a lobe sends back (f0 A + B)(1 + f0 k), whose only
/// square of f0 is k A: of f0 mixed by a share m it lacks m (1 - m) k A times the square of the difference.
///
/// # Errors
/// A truth that cannot be integrated.
pub fn shortcut(
    quantity: &dyn Quantity,
    variant: &Variant,
    (region, material, mixed): (&Region, &Material, &Mixed),
) -> Result<Shortcut, BakeError> {
    let part = |i: usize| i as f64 / (SIDE - 1) as f64;
    let own = material.rough_range(region.alpha_map).unwrap_or(region.roughness);
    let roughness: Vec<f64> = (0..SIDE).map(|i| own[0] + (own[1] - own[0]) * part(i)).collect();
    let alpha: Vec<f64> = roughness.iter().map(|r| region.alpha_map.alpha(*r)).collect();
    // By their logarithm: narrow lobes lose most near grazing.
    let [low, high] = region.mu;
    let mu: Vec<f64> = (0..SIDE).map(|i| low * ops::pow(high / low, part(i))).collect();
    let points = Points::product(&[("alpha", &alpha), ("mu", &mu)]);
    let truth = quantity.truth(variant, &points, &["E", "A"], quantity.tolerance_of_many(variant))?;
    let [e, a] = truth.arrays();
    let apart = material.f0.into_iter().flatten().zip(mixed.f0).map(|(metal, dielectric)| metal - dielectric);
    let apart = apart.fold(0.0, |most: f64, apart| most.max(apart * apart));
    let m = 0.5_f64.clamp(mixed.metalness[0], mixed.metalness[1]);
    let mut worst = Shortcut::default();
    for (i, (e, a)) in e.iter().zip(&a).enumerate() {
        let lost = m * (1.0 - m) * apart * a * (1.0 / e - 1.0);
        if lost > worst.lost {
            worst = Shortcut { lost, at: [roughness[i % SIDE], mu[i / SIDE], m] };
        }
    }
    Ok(worst)
}

/// The function in a language.
///
/// # Errors
/// A text that does not parse, a defect of this program.
pub fn printed(language: Language, specular: Specular, shortcut: &Shortcut) -> Result<String, BakeError> {
    let source = Source::parse("mixed.wgsl", TEXT).map_err(CodeError::from)?;
    let dielectric = match specular {
        Specular::Normalised => "multiplied by n",
        Specular::Compensated => "multiplied by 1 + f0 (n - 1)",
        Specular::Single => "left as it is",
    };
    let mut text = format!(
        "Fresnel's term (Schlick's) with the energy compensation of a surface that is a metal to the share metalness and a dielectric\n\
         else, per colour channel: multiply D and the visibility, which both share, by it. That is the mix of the two finished lobes.\n\
         schlick is (1 - v_dot_h)^5, n the energy compensation N, or 1/E of a table; the dielectric's lobe is {dielectric}.\n\
         The error of each lobe is that of n at most, relative."
    );
    if shortcut.lost > 0.0 {
        let [lost, roughness, mu, metalness] =
            [shortcut.lost, shortcut.at[0], shortcut.at[1], shortcut.at[2]]
                .map(|x| lobefit_shade::round_up(x, 3));
        text += &format!(
            " A lobe of f0 mixed first, compensated by that f0, lacks\n\
             up to {lost} of the light of a white environment beside the mix of two lobes that are compensated alike (at {SIDE} x {SIDE} places;\n\
             worst at roughness {roughness}, n_dot_v {mu}, metalness {metalness})."
        );
    }
    let header: Vec<String> = text.lines().map(String::from).collect();
    Ok(format!("\n{}", source.print(language, name(specular), &header)?))
}
