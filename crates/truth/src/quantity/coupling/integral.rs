//! `diffuse-coupling`: what a specular lobe over a white diffuse base leaves for it, 1 less the
//! albedo of the specular lobe.
//!
//! With the split albedo E = A + B, L = 1 - E, g = 1 - f0 and a1 = A/E (Schlick's Fresnel with
//! F90 = 1):
//! - `single`, the bare lobe f0 A + B: the factor is L + g A;
//! - `normalised`, divided by E (Pesce 2019): g a1;
//! - `compensated`, times 1 + f0 (1/E - 1) (Turquin 2019; Fdez-Aguera 2019): g (a1 + L (1 - g a1)).
//!
//! Every term is positive, so nothing cancels but what A lost to B. Ends: at f0 = 1 only `single`
//! leaves light, L; at alpha = 0 all three are g (1 - (1 - mu)^5); at mu = 0 what is lost is 0 for
//! correlated shadowing.

use serde::{Deserialize, Serialize};

use crate::integrate::reflection::{Reflection, reflection};
use crate::integrate::{Estimate, IntegrateError};
use crate::optics::Smith;
use crate::quantity::{F0Form, Parts};

/// What multiplies the specular lobe.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Specular {
    /// Nothing: single scattering.
    Single,
    /// 1/E.
    #[default]
    Normalised,
    /// 1 + f0 (1/E - 1).
    Compensated,
}

impl Specular {
    /// All of them, in the order of the quantity's words.
    pub const ALL: [Specular; 3] = [Specular::Single, Specular::Normalised, Specular::Compensated];

    /// The word used in scenes, as input of `diffuse-coupling`, and in names of functions.
    pub fn name(self) -> &'static str {
        match self {
            Specular::Single => "single",
            Specular::Normalised => "normalised",
            Specular::Compensated => "compensated",
        }
    }

    /// What the factor is made of.
    pub fn form(self) -> F0Form {
        match self {
            Specular::Single => F0Form::Rest,
            Specular::Normalised => F0Form::Share,
            Specular::Compensated => F0Form::Recycled,
        }
    }

    /// What the lobe is multiplied by, as a formula.
    pub fn formula(self) -> &'static str {
        match self {
            Specular::Single => "1",
            Specular::Normalised => "1/E",
            Specular::Compensated => "1 + f0 (1/E - 1)",
        }
    }
}

/// The tolerance of a value by default: the promise for alpha, mu in [1e-4, 1].
pub const TOLERANCE: f64 = 1e-9;

/// Largest growth of the error of E, A and L on the way to a factor: a1 has (error of A + a1 error
/// of E)/E, and E is nowhere below 0.3 (1 - ln 2 at alpha = mu = 1, either form of shadowing); the
/// loss adds its own.
const GROWTH: f64 = 8.0;

/// Integrates `diffuse-coupling` at alpha in {0} or [1e-7, 1], mu and f0 in [0, 1], to an absolute
/// `tolerance`.
///
/// Errors: as of [`reflection`]; f0 outside [0, 1].
pub fn coupling(
    smith: Smith,
    alpha: f64,
    mu: f64,
    f0: f64,
    specular: Specular,
    tolerance: f64,
) -> Result<Estimate, IntegrateError> {
    check_f0(f0)?;
    let lobe = reflection(smith, alpha, mu, tolerance / GROWTH)?;
    Ok(factor(&Split::of(&lobe), f0, specular))
}

/// The parts of a split albedo with the bounds of their errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Split {
    /// Directional albedo.
    pub e: Estimate,
    /// Schlick's scale.
    pub a: Estimate,
    /// 1 - E.
    pub loss: Estimate,
}

impl Split {
    /// The parts of an integrated lobe.
    pub fn of(lobe: &Reflection) -> Split {
        let with = |value| Estimate { value, error: lobe.error };
        Split { e: with(lobe.e), a: with(lobe.a), loss: with(lobe.loss) }
    }
}

/// The factor of a split albedo at f0 in [0, 1], with the bound of its error; E above 0.
pub fn factor(split: &Split, f0: f64, specular: Specular) -> Estimate {
    let Split { e, a, loss } = split;
    let g = 1.0 - f0;
    let share = a.value / e.value;
    let share_error = (a.error + share * e.error) / e.value;
    let error = match specular {
        Specular::Single => loss.error + g * a.error,
        Specular::Normalised => g * share_error,
        Specular::Compensated => g * (share_error * (1.0 - g * loss.value) + (1.0 - g * share) * loss.error),
    };
    let parts = Parts { e: e.value, a: a.value, b: e.value - a.value, loss: loss.value };
    Estimate { value: specular.form().value(parts, f0), error }
}

/// Refuses f0 outside [0, 1].
pub(super) fn check_f0(f0: f64) -> Result<(), IntegrateError> {
    let inside = (0.0..=1.0).contains(&f0);
    IntegrateError::outside("diffuse-coupling", [("f0", f0, inside, "is outside [0, 1]")])
}
