//! `sheen-charlie` with the shadowing of its authors in place of Neubelt's visibility: E of the lobe
//! D/(4 mu mu_l (1 + Lambda(mu) + Lambda(mu_l))), without their softer terminator.
//!
//! Lambda is finite at grazing view, so that E grows like 1/mu below mu = 1e-9 and has no value at 0.

use std::sync::LazyLock;

use super::facets::View;
use crate::integrate::{IntegrateError, PanelRule};
use crate::quantity::{Choice, Input, Quantity, Variant};
use lobefit_math::gauss::Gauss;

/// The directional albedo of Charlie with Estevez and Kulla's own Lambda (2017).
#[derive(Clone, Copy, Debug)]
pub struct EstevezKulla;

/// Rules over the polar angle of the facet and over each part of its azimuth.
type Rules = (PanelRule, Gauss);

/// Rules of which each has more nodes than the one before.
fn ladder() -> &'static [Rules; 3] {
    static LADDER: LazyLock<[Rules; 3]> =
        LazyLock::new(|| [(8, 12), (16, 24), (32, 48)].map(|(m, n)| (PanelRule::new(m), Gauss::new(n))));
    &LADDER
}

impl Quantity for EstevezKulla {
    fn name(&self) -> &'static str {
        "sheen-charlie"
    }

    fn inputs(&self) -> &'static [Input] {
        const { &[Input::new("alpha", [1e-4, 1.0]), Input::new("mu", [1e-6, 1.0])] }
    }

    fn outputs(&self) -> &'static [&'static str] {
        &["E", "error"]
    }

    fn choices(&self) -> &'static [Choice] {
        &[]
    }

    fn tolerance(&self, _: &Variant) -> f64 {
        1e-5
    }

    fn smallest_alpha(&self) -> f64 {
        1e-4
    }

    fn changes_at_alpha(&self) -> bool {
        false
    }

    fn at(&self, _: &Variant, x: &[f64], tolerance: f64) -> Result<Vec<f64>, IntegrateError> {
        let (quantity, [alpha, mu]) = (self.name(), [x[0], x[1]]);
        for (input, value) in self.inputs().iter().zip(x) {
            if !(input.domain[0]..=input.domain[1]).contains(value) {
                let (input, domain) = (input.name, "is outside the domain of Estevez and Kulla's shadowing");
                return Err(IntegrateError::Domain { quantity, input, value: *value, domain });
            }
        }
        let place = || format!("alpha = {alpha:?}, mu = {mu:?}");
        let by = |(rule, azimuth): &'static Rules| View::shadowed(alpha, mu, azimuth).albedo(rule);
        let mut coarse = by(&ladder()[0]);
        let mut reached = f64::INFINITY;
        for rules in &ladder()[1..] {
            let fine = by(rules);
            // Lambda is no analytic function: the difference itself bounds the error.
            reached = (fine - coarse).abs();
            if !fine.is_finite() {
                return Err(IntegrateError::NotFinite { quantity, place: place() });
            }
            if reached <= tolerance {
                return Ok(vec![fine, reached]);
            }
            coarse = fine;
        }
        Err(IntegrateError::Tolerance { quantity, place: place(), reached, tolerance })
    }
}
