//! `sheen-estevez-kulla`: `sheen-charlie` with the shadowing of its authors in place of Neubelt's
//! visibility: E of the lobe D/(4 mu mu_l (1 + Lambda(mu) + Lambda(mu_l))), without their softer
//! terminator.
//!
//! Lambda is finite at grazing view, so that E grows like 1/mu below mu = 1e-9 and has no value at 0.

use std::sync::{LazyLock, OnceLock};

use rayon::prelude::*;

use super::facets::View;
use super::monte_carlo;
use crate::integrate::monte_carlo::{Run, Sampled};
use crate::integrate::{Goal, IntegrateError, PanelRule};
use crate::quantity::{Asked, Facts, Input, Quantity, Truth, Variant, check_domain};
use lobefit_math::chebyshev::{self, Chebyshev};
use lobefit_math::gauss::Gauss;
use lobefit_math::ops;

/// Their a, b, c, d, e at alpha = 0 and at alpha = 1 (Estevez and Kulla 2017, table 1).
const FITTED: [[f64; 5]; 2] =
    [[25.3245, 3.32435, 0.16801, -1.27393, -4.85967], [21.5473, 3.82987, 0.19823, -1.97760, -4.32054]];

/// Nodes of each half of Lambda, over the fourth root of the cosine's distance from its end:
/// cubics between them leave 1e-8 of it where mu > 1e-4, and what lies below hardly is lit.
const NODES: usize = 512;

/// e^L(mu) below mu = 1/2, e^(2 L(1/2) - L(1 - mu)) above, whose second derivative jumps there. L(x) =
/// a/(1 + b x^c) + d x + e, its constants blended by (1 - alpha)^2 (Estevez and Kulla 2017, sec. 3).
#[derive(Clone, Copy, Debug)]
pub(super) struct Fitted {
    pub alpha: f64,
    constants: [f64; 5],
}

impl Fitted {
    /// Of a width in [0, 1].
    pub(super) fn new(alpha: f64) -> Fitted {
        let smooth = (1.0 - alpha) * (1.0 - alpha);
        let constants = [0, 1, 2, 3, 4].map(|k| smooth * FITTED[0][k] + (1.0 - smooth) * FITTED[1][k]);
        Fitted { alpha, constants }
    }

    fn exponent(&self, x: f64) -> f64 {
        let [a, b, c, d, e] = self.constants;
        a / (1.0 + b * ops::pow(x, c)) + d * x + e
    }

    /// Of a cosine in [0, 1], and of the cosine as far from 1 as it is from 0.
    fn both(&self, x: f64) -> [f64; 2] {
        let of = self.exponent(x);
        [ops::exp(of), ops::exp(2.0 * self.exponent(0.5) - of)]
    }

    /// Lambda of a cosine in [0, 1].
    pub(super) fn at(&self, cosine: f64) -> f64 {
        if cosine < 0.5 { self.both(cosine)[0] } else { self.both(1.0 - cosine)[1] }
    }
}

/// The Lambda of a width, tabulated for lights.
#[derive(Clone, Debug)]
pub(super) struct Lambda {
    pub fitted: Fitted,
    halves: [Vec<f64>; 2],
}

impl Lambda {
    fn new(alpha: f64) -> Lambda {
        let fitted = Fitted::new(alpha);
        let root = |i: usize| i as f64 / (NODES - 1) as f64;
        let of = |i: usize| fitted.both(0.5 * root(i) * root(i) * root(i) * root(i));
        let (low, high) = (0..NODES).map(of).map(|[low, high]| (low, high)).unzip();
        Lambda { fitted, halves: [low, high] }
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

/// Largest error of [`Quantity::truth`] at many points: a panel is within 6e-6, most of it of its rule.
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

/// Cuts of the domain over alpha and mu: between them E is smooth over the logarithm of each. Lambda of
/// the view is not at its middle.
const CUTS: [&[f64]; 2] = [
    &[1e-4, 4e-4, 1.6e-3, 6.4e-3, 0.0256, 0.1024, 0.32, 1.0],
    &[1e-6, 1e-5, 1e-4, 1e-3, 4e-3, 0.016, 0.05, 0.15, 0.5, 1.0],
];

/// Nodes along a side of a panel.
const SIDE: usize = 16;

/// E over a panel, in Chebyshev points of the logarithms of alpha and mu.
#[derive(Debug)]
struct Panel {
    alphas: Vec<f64>,
    /// Over mu, for each of the alphas.
    rows: Vec<Chebyshev>,
}

impl Panel {
    fn new([alpha, mu]: [[f64; 2]; 2]) -> Panel {
        let nodes = |[low, high]: [f64; 2]| chebyshev::nodes(ops::log(low), ops::log(high), SIDE);
        let (alphas, mus) = (nodes(alpha), nodes(mu));
        let row = |log_alpha: &f64| {
            let lambda = Lambda::new(ops::exp(*log_alpha).clamp(alpha[0], alpha[1]));
            let at = |log_mu: &f64| albedo(&lambda, ops::exp(*log_mu).clamp(mu[0], mu[1]), &ladder()[1]);
            Chebyshev::new(mus[0], mus[SIDE - 1], mus.par_iter().map(at).collect())
        };
        Panel { rows: alphas.par_iter().map(row).collect(), alphas }
    }

    /// E at a place of the panel.
    fn at(&self, alpha: f64, mu: f64) -> f64 {
        let weights = chebyshev::weights(&self.alphas, ops::log(alpha));
        let values = chebyshev::all_at(&self.rows, ops::log(mu));
        weights.iter().zip(values).map(|(weight, value)| weight * value).sum()
    }
}

/// The panel at a place of the domain, made where it is first asked for.
fn panel(place: [f64; 2]) -> &'static Panel {
    const OF: usize = CUTS[1].len() - 1;
    static PANELS: [OnceLock<Panel>; (CUTS[0].len() - 1) * OF] =
        [const { OnceLock::new() }; (CUTS[0].len() - 1) * OF];
    let [alpha, mu] =
        [0, 1].map(|k| CUTS[k].partition_point(|cut| *cut <= place[k]).clamp(1, CUTS[k].len() - 1) - 1);
    PANELS[alpha * OF + mu]
        .get_or_init(|| Panel::new([[CUTS[0][alpha], CUTS[0][alpha + 1]], [CUTS[1][mu], CUTS[1][mu + 1]]]))
}

impl Quantity for EstevezKulla {
    fn facts(&self) -> &Facts {
        const {
            &Facts {
                name: "sheen-estevez-kulla",
                inputs: &[Input::new("alpha", [1e-4, 1.0]), Input::new("mu", [1e-6, 1.0])],
                outputs: &["E", "error"],
                tolerance: MANY_ERROR,
                smallest_alpha: 1e-4,
                changes_at_alpha: false,
                remark: "E of sheen-charlie with the shadowing of its authors; it grows at grazing, and exceeds 1",
                ..Facts::NONE
            }
        }
    }

    fn at(&self, _: &Variant, x: &[f64], tolerance: f64) -> Result<Vec<f64>, IntegrateError> {
        check_domain(self, x)?;
        let (quantity, [alpha, mu]) = (self.name(), [x[0], x[1]]);
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
        let one = |(alpha, mu): (&f64, &f64)| {
            check_domain(self, &[*alpha, *mu])?;
            Ok([panel([*alpha, *mu]).at(*alpha, *mu)])
        };
        let rows: Vec<[f64; 1]> =
            alphas.par_iter().zip(mus).map(one).collect::<Result<_, IntegrateError>>()?;
        Ok(Some(Truth::of_rows(&rows, MANY_ERROR, rows.len() as u64)))
    }

    fn tolerance_of_many(&self, _: &Variant) -> f64 {
        MANY_ERROR
    }

    fn microseconds(&self, _: &[&str]) -> f64 {
        2.0
    }

    fn second_opinion(&self, _: &Variant, x: &[f64], run: Run) -> Result<Vec<Sampled>, IntegrateError> {
        check_domain(self, x)?;
        Ok(vec![monte_carlo::shadowed(x[0], x[1], run)?])
    }
}
