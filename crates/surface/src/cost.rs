//! What a lobe and a coupling cost a shader, counted on the formula that it would run.
//!
//! Counted is one channel of specular and diffuse, from what every shader has at hand (D V F and F
//! of the facet, rho/pi, f0, the cosines, roughness, constants of the material) and from texels of
//! A and B, beyond the bare sum specular + diffuse.

use crate::SurfaceError;
use crate::material::{Coupling, Factor, Lobe};
use lobefit_shade::Hypothesis;
use lobefit_shade::ShadeError;

/// What a shader takes beyond the bare sum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cost {
    /// Operations of one channel.
    pub ops: u32,
    /// Texels read.
    pub fetches: u32,
}

/// Arguments of every formula. `specular` is D V F, `diffuse` rho/pi, `fresnel` F(v.h); a and b are
/// texels of A and B at l and v, `series` the colour of the second lobe, `second` that over pi
/// times the average loss, `scale` one over what a coupling divides by.
const ARGUMENTS: &str = "specular: f32, diffuse: f32, f0: f32, fresnel: f32, roughness: f32, alpha: f32, mu_l: f32, mu_v: f32, a_l: f32, b_l: f32, \
                         a_v: f32, b_v: f32, series: f32, second: f32, scale: f32";

const HELPERS: [(&str, &str); 3] = [
    (
        "half_power",
        "fn half_power(mu: f32) -> f32 { let x = 1.0 - 0.5 * mu; let y = x * x; return 1.0 - y * y * x; }\n",
    ),
    (
        "dassault",
        "fn left_of(mu: f32, smooth_part: f32) -> f32 { let x = 1.0 - mu; let y = x * x; \
         return (1.0 - y * y * x) * smooth_part + 0.95238 * (1.0 - smooth_part); }\n\
         fn dassault(alpha: f32, mu_l: f32, mu_v: f32, f0: f32) -> f32 { let x = 1.0 - alpha; let y = x * x; let s = y * y * x; \
         return (1.0 - f0) * left_of(mu_l, s) * left_of(mu_v, s) / (1.0 + (0.33263 * alpha + 0.072359) * f0); }\n",
    ),
    ("weight", "fn weight(mu: f32) -> f32 { let x = 1.0 - mu; let y = x * x; return y * y * x; }\n"),
];

/// Operations and texels of a lobe over a base with this coupling; none: without a base.
///
/// # Errors
/// A formula that does not parse, a defect of this program; a coupling whose formula came without
/// its cost.
pub fn cost(lobe: Lobe, coupling: Option<&Coupling>) -> Result<Cost, SurfaceError> {
    let whole = formula(lobe, coupling)?.tape().cost_ops();
    let bare = u32::from(coupling.is_some());
    Ok(Cost { ops: whole - bare + extra(coupling)?, fetches: texels(lobe, coupling) })
}

/// The formula that is counted: f(l, v) of one channel. The value of a [`Coupling::Factor`] is its
/// argument `scale`, the values and the scale of a [`Coupling::Symmetrised`] are `series`, `second`
/// and `scale`.
///
/// # Errors
/// A formula that does not parse, a defect of this program.
pub fn formula(lobe: Lobe, coupling: Option<&Coupling>) -> Result<Hypothesis, SurfaceError> {
    let parsed: Result<Hypothesis, ShadeError> = Hypothesis::parse("shade.wgsl", &source(lobe, coupling));
    parsed.map_err(|e| SurfaceError::Formula(Box::new(e)))
}

/// The text of [`formula`].
pub fn source(lobe: Lobe, coupling: Option<&Coupling>) -> String {
    let base =
        coupling.map_or(String::new(), |coupling| format!(" + diffuse * ({})", factor(lobe, coupling)));
    let value = format!("{}{base}", boosted(lobe));
    // the dialect refuses functions that nothing calls
    let called: String =
        HELPERS.iter().filter(|(name, _)| value.contains(name)).map(|(_, text)| *text).collect();
    format!("{called}fn shade({ARGUMENTS}) -> f32 {{ return {value}; }}\n")
}

/// The specular part.
fn boosted(lobe: Lobe) -> String {
    match lobe {
        Lobe::Single => "specular".into(),
        Lobe::Normalised => "specular / (a_v + b_v)".into(),
        Lobe::Compensated => "specular * (1.0 + f0 * (1.0 / (a_v + b_v) - 1.0))".into(),
        Lobe::KullaConty | Lobe::KullaContyOnce => {
            "specular + (1.0 - (a_l + b_l)) * (1.0 - (a_v + b_v)) * second".into()
        }
    }
}

/// What the lobe leaves at one side.
fn left(lobe: Lobe, side: char) -> String {
    let (a, b) = (format!("a_{side}"), format!("b_{side}"));
    let own = format!("(f0 * {a} + {b})");
    match lobe {
        Lobe::Single => format!("(1.0 - {own})"),
        Lobe::Normalised => format!("((1.0 - f0) * ({a} / ({a} + {b})))"),
        Lobe::Compensated => format!("(1.0 - {own} * (1.0 + f0 * (1.0 / ({a} + {b}) - 1.0)))"),
        Lobe::KullaConty | Lobe::KullaContyOnce => format!("(1.0 - {own} - (1.0 - ({a} + {b})) * series)"),
    }
}

/// The factor of the base; that of a formula is counted by its own hypothesis, and names stand for
/// its values here.
fn factor(lobe: Lobe, coupling: &Coupling) -> String {
    match coupling {
        Coupling::None => "1.0".into(),
        Coupling::OneMinusF0 => "1.0 - f0".into(),
        Coupling::OneMinusFresnel => "(1.0 - f0) * (1.0 - weight(mu_v))".into(),
        Coupling::FresnelProduct => "(1.0 - f0) * 1.05 * (1.0 - weight(mu_l)) * (1.0 - weight(mu_v))".into(),
        Coupling::HalfVector => "1.0 - fresnel".into(),
        Coupling::AshikhminShirley => "(1.0 - f0) * 1.2173913 * half_power(mu_l) * half_power(mu_v)".into(),
        Coupling::Dassault => "dassault(alpha, mu_l, mu_v, f0)".into(),
        Coupling::SchlickRoughness => "1.0 - (f0 + (max(1.0 - roughness, f0) - f0) * weight(mu_v))".into(),
        // mix(1 - F, 1 - f0, roughness) with Schlick's F, multiplied out
        Coupling::Pesce => "(1.0 - f0) * (1.0 - weight(mu_v) * (1.0 - roughness))".into(),
        Coupling::OneMinusOwnSpecular => left(lobe, 'v'),
        // `scale` is 1/left_avg, or 1/(1 - rho taken_avg): a constant of the material
        Coupling::Kelemen | Coupling::Interreflected => {
            format!("{} * {} * scale", left(lobe, 'l'), left(lobe, 'v'))
        }
        Coupling::Factor(_) => "scale".into(),
        Coupling::Symmetrised(_) => "scale * series * second".into(),
    }
}

fn extra(coupling: Option<&Coupling>) -> Result<u32, SurfaceError> {
    match coupling {
        Some(Coupling::Factor(factor)) => operations_of(factor),
        // with a max of each cosine where the formula is not made for all of them
        Some(Coupling::Symmetrised(factor)) => {
            Ok(2 * (operations_of(factor)? + u32::from(factor.least_mu() > 0.0)))
        }
        _ => Ok(0),
    }
}

fn operations_of(factor: &Factor) -> Result<u32, SurfaceError> {
    factor.ops().ok_or_else(|| SurfaceError::Factor {
        name: factor.name().to_string(),
        what: "operations".into(),
        wanted: "a number".into(),
        found: "none".into(),
    })
}

/// Texels of (A, B) that are read: at the view, and at the light.
fn texels(lobe: Lobe, coupling: Option<&Coupling>) -> u32 {
    let both = matches!(lobe, Lobe::KullaConty | Lobe::KullaContyOnce)
        || matches!(coupling, Some(Coupling::Kelemen | Coupling::Interreflected));
    let one = lobe != Lobe::Single || matches!(coupling, Some(Coupling::OneMinusOwnSpecular));
    if both { 2 } else { u32::from(one) }
}
