//! Quantities by name: each is a value of the list [`QUANTITIES`], with its inputs, its outputs, the variants that it really has,
//! its truth and, where it has one, its second opinion by Monte Carlo.
//!
//! A quantity is added by a file here that implements [`Quantity`] and by a line of the list.

mod aniso;
mod average;
mod coupling;
mod glass;
mod parallax;
mod reflection;
mod sheen;
mod variant;

pub use aniso::GgxReflectionAniso;
pub use average::GgxAverage;
pub use coupling::DiffuseCoupling;
pub use glass::GgxGlass;
pub use parallax::ParallaxAlpha;
pub use reflection::{BECKMANN_REFLECTION, GGX_REFLECTION, Reflection};
pub use sheen::SheenCharlie;
pub use variant::{Choice, Variant};

use crate::integrate::IntegrateError;
use crate::integrate::monte_carlo::{Run, Sampled};

/// An input: a number of a range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Input {
    /// Its name, in files of points the name of its column.
    pub name: &'static str,
    /// Smallest and largest value.
    pub domain: [f64; 2],
    /// Whether it may be absent. [`Quantity::at`] then takes a NaN in its place, and the truth is the mean over the input.
    pub optional: bool,
}

impl Input {
    /// An input that must be given.
    pub const fn new(name: &'static str, domain: [f64; 2]) -> Input {
        Input { name, domain, optional: false }
    }
}

/// The GGX width alpha in [0, 1]; 0 is a mirror.
pub(crate) const ALPHA: Input = Input::new("alpha", [0.0, 1.0]);

/// Cosine of the angle between view and normal.
pub(crate) const MU: Input = Input::new("mu", [0.0, 1.0]);

/// A function with a truth.
pub trait Quantity: Sync {
    /// Its name, as `ggx-reflection`.
    fn name(&self) -> &'static str;

    /// Its inputs, in the order in which [`Quantity::at`] takes them.
    fn inputs(&self) -> &'static [Input];

    /// Its outputs, in the order in which [`Quantity::at`] gives them; the last is the error.
    fn outputs(&self) -> &'static [&'static str];

    /// What a variant of it says. Nothing else of a [`Variant`] is looked at.
    fn choices(&self) -> &'static [Choice];

    /// The largest error where no tolerance is asked for: the quantity's promise.
    fn tolerance(&self, variant: &Variant) -> f64;

    /// The smallest alpha above 0 at which there is a truth. At 0 itself, a mirror, there may be one all the same.
    fn smallest_alpha(&self) -> f64;

    /// A remark for who lists the quantities; empty where inputs and outputs say all.
    fn remark(&self) -> &'static str {
        ""
    }

    /// The outputs at one point by quadrature. The last is the estimated error of the others, at most `tolerance`: from two rules of which
    /// one has twice the nodes, it holds at all but 1 of 1000 points (`tests/integrate/error_bound.rs`).
    ///
    /// # Errors
    /// An input outside of its domain, a variant that leaves a choice open, a tolerance that the largest rule does not reach.
    fn at(&self, variant: &Variant, x: &[f64], tolerance: f64) -> Result<Vec<f64>, IntegrateError>;

    /// The outputs without the error at one point by Monte Carlo, which shares nothing with the quadrature but definitions.
    ///
    /// # Errors
    /// As [`Quantity::at`]; an input at a limit that cannot be sampled; a quantity that is no integral.
    fn second_opinion(&self, variant: &Variant, x: &[f64], run: Run) -> Result<Vec<Sampled>, IntegrateError> {
        let _ = (variant, x, run);
        Err(IntegrateError::NoSecondOpinion { quantity: self.name() })
    }

    /// Whether its variants say this.
    fn has(&self, choice: Choice) -> bool {
        self.choices().contains(&choice)
    }
}

impl std::fmt::Debug for dyn Quantity {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

impl PartialEq for dyn Quantity {
    fn eq(&self, other: &dyn Quantity) -> bool {
        self.name() == other.name()
    }
}

/// Every quantity of this version.
pub static QUANTITIES: [&dyn Quantity; 8] = [
    &GGX_REFLECTION,
    &GgxReflectionAniso,
    &GgxAverage,
    &GgxGlass,
    &SheenCharlie,
    &DiffuseCoupling,
    &ParallaxAlpha,
    &BECKMANN_REFLECTION,
];

/// The quantity of a name.
pub fn find(name: &str) -> Option<&'static dyn Quantity> {
    QUANTITIES.iter().copied().find(|quantity| quantity.name() == name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_quantity_has_a_name_of_its_own_and_an_error() {
        for quantity in QUANTITIES {
            assert!(find(quantity.name()).is_some_and(|found| found == quantity), "{quantity:?}");
            assert_eq!(quantity.outputs().last(), Some(&"error"), "{quantity:?}");
        }
    }

    #[test]
    fn a_variant_that_leaves_a_choice_open_is_refused() {
        for quantity in QUANTITIES {
            let x: Vec<f64> = quantity.inputs().iter().map(|input| input.domain[1].min(1.0)).collect();
            let open = quantity.at(&Variant::default(), &x, 1e-3);
            let asked = quantity.choices().iter().any(|choice| !choice.is_optional());
            assert_eq!(matches!(open, Err(IntegrateError::Variant { .. })), asked, "{quantity:?}");
        }
    }
}
