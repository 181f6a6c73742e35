//! `sheen-charlie` with the shadowing of its authors in place of Neubelt's visibility: E of the lobe
//! D/(4 mu mu_l (1 + Lambda(mu) + Lambda(mu_l))), without their softer terminator.
//!
//! Lambda is finite at grazing view, so that E grows like 1/mu below mu = 1e-9 and has no value at 0.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use rayon::prelude::*;

use super::facets::View;
use crate::integrate::{Goal, IntegrateError, PanelRule};
use crate::quantity::{Asked, Facts, Input, Quantity, Truth, Variant};
use lobefit_math::gauss::Gauss;
use lobefit_math::ops;

/// Their a, b, c, d, e at alpha = 0 and at alpha = 1 (Estevez and Kulla 2017, table 1).
const FITTED: [[f64; 5]; 2] =
    [[25.3245, 3.32435, 0.16801, -1.27393, -4.85967], [21.5473, 3.82987, 0.19823, -1.97760, -4.32054]];

/// Nodes of each half of Lambda, over the fourth root of the cosine's distance from its end:
/// cubics between them leave 1e-8 of it where mu > 1e-4, and what lies below hardly is lit.
const NODES: usize = 512;

/// The Lambda of a width, tabulated: e^L(mu) below mu = 1/2, e^(2 L(1/2) - L(1 - mu)) above, whose
/// second derivative jumps there. L(x) = a/(1 + b x^c) + d x + e, its constants blended by
/// (1 - alpha)^2 (Estevez and Kulla 2017, sec. 3).
#[derive(Clone, Debug)]
pub(super) struct Lambda {
    pub alpha: f64,
    halves: [Vec<f64>; 2],
}

impl Lambda {
    /// Of a width in [0, 1].
    fn new(alpha: f64) -> Lambda {
        let smooth = (1.0 - alpha) * (1.0 - alpha);
        let [a, b, c, d, e] = [0, 1, 2, 3, 4].map(|k| smooth * FITTED[0][k] + (1.0 - smooth) * FITTED[1][k]);
        let exponent = |x: f64| a / (1.0 + b * ops::pow(x, c)) + d * x + e;
        let middle = exponent(0.5);
        let root = |i: usize| i as f64 / (NODES - 1) as f64;
        let of = |i: usize| exponent(0.5 * root(i) * root(i) * root(i) * root(i));
        let low = (0..NODES).map(|i| ops::exp(of(i))).collect();
        let high = (0..NODES).map(|i| ops::exp(2.0 * middle - of(i))).collect();
        Lambda { alpha, halves: [low, high] }
    }

    /// Of a cosine in [0, 1].
    pub(super) fn at(&self, cosine: f64) -> f64 {
        let (half, x) =
            if cosine < 0.5 { (&self.halves[0], cosine) } else { (&self.halves[1], 1.0 - cosine) };
        let place = (2.0 * x).sqrt().sqrt() * (NODES - 1) as f64;
        let first = (place as usize).saturating_sub(1).min(NODES - 4);
        let u = place - first as f64;
        let [v, w, z] = [u - 1.0, u - 2.0, u - 3.0];
        let ends = u * w * z * half[first + 1] - u * v * z * half[first + 2];
        0.5 * ends + (u * v * w * half[first + 3] - v * w * z * half[first]) / 6.0
    }
}

/// The directional albedo of Charlie with Estevez and Kulla's own Lambda (2017).
#[derive(Clone, Copy, Debug)]
pub struct EstevezKulla;

/// Largest error of [`Quantity::truth`] at many points, by the second of the rules.
const MANY_ERROR: f64 = 1e-5;

/// Rules over the polar angle of the facet and over each part of its azimuth.
type Rules = (PanelRule, Gauss);

/// Rules of which each has more nodes than the one before.
fn ladder() -> &'static [Rules; 3] {
    static LADDER: LazyLock<[Rules; 3]> =
        LazyLock::new(|| [(8, 12), (16, 24), (32, 48)].map(|(m, n)| (PanelRule::new(m), Gauss::new(n))));
    &LADDER
}

/// E by a rule.
fn albedo(lambda: &Lambda, mu: f64, (rule, azimuth): &'static Rules) -> f64 {
    View::shadowed(lambda, mu, azimuth).albedo(rule)
}

impl EstevezKulla {
    /// Refuses inputs outside the domain.
    fn check(self, alpha: f64, mu: f64) -> Result<(), IntegrateError> {
        let domain = "is outside the domain of Estevez and Kulla's shadowing";
        let checked = |(input, x): (&Input, f64)| {
            (input.name, x, (input.domain[0]..=input.domain[1]).contains(&x), domain)
        };
        IntegrateError::outside(self.name(), self.inputs().iter().zip([alpha, mu]).map(checked))
    }
}

impl Quantity for EstevezKulla {
    fn facts(&self) -> &Facts {
        const {
            &Facts {
                name: "sheen-charlie",
                inputs: &[Input::new("alpha", [1e-4, 1.0]), Input::new("mu", [1e-6, 1.0])],
                outputs: &["E", "error"],
                tolerance: MANY_ERROR,
                smallest_alpha: 1e-4,
                changes_at_alpha: false,
                ..Facts::NONE
            }
        }
    }

    fn at(&self, _: &Variant, x: &[f64], tolerance: f64) -> Result<Vec<f64>, IntegrateError> {
        let (quantity, [alpha, mu]) = (self.name(), [x[0], x[1]]);
        self.check(alpha, mu)?;
        let place = || format!("alpha = {alpha:?}, mu = {mu:?}");
        let lambda = Lambda::new(alpha);
        // Lambda is no analytic function: the difference itself bounds the error.
        let bounded = |coarse: &f64, fine: &f64| {
            let error = (fine - coarse).abs();
            fine.is_finite().then(|| (vec![*fine, error], error))
        };
        let goal = Goal { quantity, place: &place, tolerance };
        goal.climb(ladder(), |rules| Ok(albedo(&lambda, mu, rules)), bounded)
    }

    fn many(&self, asked: &Asked) -> Result<Option<Truth>, IntegrateError> {
        if asked.tolerance < MANY_ERROR || asked.outputs != ["E"] {
            return Ok(None);
        }
        let [alphas, mus] = asked.columns(self)?;
        let places: Vec<(&f64, &f64)> = alphas.iter().zip(mus).collect();
        places.iter().try_for_each(|(alpha, mu)| self.check(**alpha, **mu))?;
        let widths: BTreeMap<u64, f64> = alphas.iter().map(|alpha| (alpha.to_bits(), *alpha)).collect();
        let widths: Vec<(u64, f64)> = widths.into_iter().collect();
        let lambdas = widths.into_par_iter().map(|(bits, alpha)| (bits, Lambda::new(alpha)));
        let lambdas: BTreeMap<u64, Lambda> = lambdas.collect::<Vec<_>>().into_iter().collect();
        let one = |(alpha, mu): &(&f64, &f64)| [albedo(&lambdas[&alpha.to_bits()], **mu, &ladder()[1])];
        let rows: Vec<[f64; 1]> = places.par_iter().map(one).collect();
        Ok(Some(Truth::of_rows(&rows, MANY_ERROR, rows.len() as u64)))
    }
}
