//! The BRDF that calls a fit of E, in every language, and what a furnace makes of it. Its formulas
//! are those of `eon.wgsl`.

use crate::approximate::{Fit, FitStageError};
use crate::data::ARGUMENT_NAMES;
use crate::effects::BakeError;
use lobefit_math::gauss::Gauss;
use lobefit_shade::code::{CodeError, Float, Language};
use lobefit_shade::{ShadeError, Source};
use lobefit_truth::points::Points;
use lobefit_truth::quantity::eon::{albedo, average};

/// The functions, with E as a call.
pub const TEXT: &str = include_str!("eon.wgsl");

/// Names of the functions, in the order of the text.
pub const NAMES: [&str; 3] = ["eon_average", "eon_single", BRDF];

/// The base.
pub const BRDF: &str = "eon_brdf";

/// Functions that are written out in those that call them.
const INSIDE: [&str; 3] = ["lost", "bounced", "e"];

/// Roughnesses and views at which the furnace is lit, and nodes of its average.
const SIDE: usize = 65;
const NODES: usize = 32;

/// The functions about the fit, which they call by its name: of a fit in f32, for at a small roughness
/// the lobe of several bounces is a quotient of numbers that f16 does not hold.
///
/// # Errors
/// A text that does not parse, a defect of this program; a fit that cannot be evaluated.
pub fn in_language(language: Language, fit: &Fit) -> Result<String, BakeError> {
    if fit.hypothesis.float() != Float::F32 {
        return Ok(String::new());
    }
    let source = about(fit.hypothesis.name()).map_err(CodeError::from)?;
    let mut text = String::new();
    for name in NAMES {
        let printed = match name {
            BRDF => source.print(language, name, &header(fit)?)?,
            _ => source.print_documented(language, name)?,
        };
        text += &format!("\n{printed}");
    }
    Ok(text)
}

/// What a card says of them.
///
/// # Errors
/// A fit that cannot be evaluated.
pub fn said(fit: &Fit) -> Result<String, BakeError> {
    if fit.hypothesis.float() != Float::F32 {
        return Ok(String::new());
    }
    let (error, _) = furnace(fit)?;
    Ok(format!("{BRDF} is the whole base, all bounces together: a white one sends back 1 within {error}."))
}

/// The text with the fit in place of E.
fn about(fit: &str) -> Result<Source, ShadeError> {
    // the fit's name and arguments; what it computes is printed elsewhere
    let stands = format!("fn {fit}(roughness: f32, mu: f32) -> f32 {{ return roughness + mu; }}");
    let called = format!("fn e(roughness: f32, mu: f32) -> f32 {{ return {fit}(roughness, mu); }}");
    let source = Source::parse("eon.wgsl", &format!("{TEXT}\n{stands}\n{called}"))?;
    Ok(source.inlined(|name| INSIDE.contains(&name)).trimmed().with_arguments(&ARGUMENT_NAMES))
}

/// What the BRDF is and how much of the light it sends back.
fn header(fit: &Fit) -> Result<Vec<String>, BakeError> {
    let (error, [roughness, mu]) = furnace(fit)?;
    let text = format!(
        "The BRDF of a rough diffuse base of this albedo per colour channel, 1/sr, all bounces together: with E from {}.\n\
         l_dot_v is the cosine between light and view. Reciprocal. albedo in [0, 1]; roughness 0 is Lambert's albedo/pi.\n\
         Energy: in a white environment a white base sends back 1, within {error} (measured at {SIDE} x {SIDE} places; worst\n\
         at roughness {roughness}, n_dot_v {mu}); an albedo below 1 scales less than the whole of it.",
        fit.hypothesis.name()
    );
    Ok(text.lines().map(String::from).collect())
}

/// The largest distance from 1 of what a white base sends back in a white environment over the
/// domain of a fit of E, and the roughness and mu at which it is: the single-scattering lobe sends
/// back the true E, the others (1 - fit) times the ratio of what all lights lose by the fit and by
/// the average.
fn furnace(fit: &Fit) -> Result<(f32, [f32; 2]), BakeError> {
    let domain = &fit.approximation.certificate.domain;
    let [roughness, mu] = ["roughness", "mu"].map(|name| domain[name]);
    let rule = Gauss::new(NODES);
    let lights: Vec<f64> = rule.nodes.iter().map(|x| 0.5 + 0.5 * x).collect();
    let mut worst = (0.0, [0.0; 2]);
    for i in 0..SIDE {
        let at = |range: [f64; 2], k: usize| range[0] + (range[1] - range[0]) * k as f64 / (SIDE - 1) as f64;
        let r = at(roughness, i);
        let views: Vec<f64> = (0..SIDE).map(|k| at(mu, k)).collect();
        let all: Vec<f64> = lights.iter().chain(&views).copied().collect();
        let points = Points::new([("roughness", vec![r; all.len()]), ("mu", all)]);
        let e = fit.values_for(&points, 1.0).map_err(FitStageError::from)?;
        let (of_lights, of_views) = e.split_at(NODES);
        let weighted = rule.weights.iter().zip(&lights).zip(of_lights);
        let lost: f64 = weighted.map(|((w, mu), e)| w * mu * (1.0 - f64::from(*e))).sum();
        let [_, truly] = average(r);
        for (mu, e) in views.iter().zip(of_views) {
            let [single, _] = albedo(r, *mu);
            let several = if truly > 0.0 { (1.0 - f64::from(*e)) * lost / truly } else { 0.0 };
            let error = (single + several - 1.0).abs();
            if !error.is_finite() {
                let name = fit.hypothesis.name();
                return Err(BakeError::Internal(format!("{name} is not finite at {r}, {mu}")));
            }
            if error > worst.0 {
                worst = (error, [r, *mu]);
            }
        }
    }
    Ok((lobefit_shade::round_up(worst.0, 3) as f32, worst.1.map(|x| x as f32)))
}
