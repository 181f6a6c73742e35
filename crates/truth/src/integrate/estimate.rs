//! A value with the bound of its error, and the panel rule that gives both.

use super::count;
use lobefit_math::gauss::Gauss;
use lobefit_math::lanes::{self, F8, LANES};

/// A value and a bound on |value - truth|.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Estimate {
    /// The value.
    pub value: f64,
    /// Bound of its absolute error.
    pub error: f64,
}

/// Rounding, relative to the size of the terms. Measured over alpha in [1e-7, 1] and mu in [1e-10,
/// 1]: E + loss = 1 to 1e-15; B differs from a rule with four times the nodes by up to 4e-14.
const ROUNDING: f64 = 6e-14;

/// The smallest part of the difference of two rules that a bound of slow rules keeps. Where a
/// singularity has a small amplitude, the difference is small before the rules converge, and a power
/// of it promises too much: of 7000 random points of the anisotropic and the glass lobe, an error
/// was at most a fiftieth of the difference (`tests/integrate/lobes.rs` has the worst).
const LEAST: f64 = 1.0 / 25.0;

impl Estimate {
    /// The same with more rounding: for values that are sums of sums.
    pub fn with_rounding(self, times: f64, scale: f64) -> Estimate {
        Estimate { error: self.error + (times - 1.0) * ROUNDING * scale, ..self }
    }

    /// [`Estimate::from_pair`] where twice the nodes do not square the error, because a singularity
    /// lies near: the bound falls with the power 1.5 of the difference. The factor 20 is empirical
    /// (`tests/integrate/lobes.rs`).
    pub fn from_slow_pair(coarse: f64, fine: f64, scale: f64) -> Estimate {
        let difference = (fine - coarse).abs();
        let error = difference * (20.0 * (difference / scale).sqrt()).clamp(LEAST, 1.0) + ROUNDING * scale;
        Estimate { value: fine, error }
    }

    /// The finer of two values with a bound from their difference.
    ///
    /// The finer rule has twice the nodes, so where the rules converge geometrically its error is
    /// about the square of the coarse one's (relative to `scale`, the size of the integrand's
    /// terms). The factor 30 is empirical: with it the bound held in 19 992 of 20 000 random points
    /// (`tests/integrate/error_bound.rs`).
    pub fn from_pair(coarse: f64, fine: f64, scale: f64) -> Estimate {
        let difference = (fine - coarse).abs();
        let error = difference * (30.0 * difference / scale).min(1.0) + ROUNDING * scale;
        Estimate { value: fine, error }
    }
}

/// Eight values of an integrand at once; implementations mark `at` as `#[inline(always)]`.
pub trait Integrand {
    /// The values.
    fn at(&self, x: &F8) -> F8;
}

struct Function<'a, F>(&'a F);

impl<F: Fn(&F8) -> F8> Integrand for Function<'_, F> {
    #[inline(always)]
    fn at(&self, x: &F8) -> F8 {
        self.0(x)
    }
}

/// Gauss nodes per panel, in blocks of eight lanes.
#[derive(Clone, Debug)]
pub struct PanelRule {
    nodes: Vec<F8>,
    weights: Vec<F8>,
}

impl PanelRule {
    /// A rule of `n` nodes per panel, `n` a multiple of eight.
    ///
    /// # Panics
    /// If `n` is not a positive multiple of eight: it never depends on input.
    pub fn new(n: usize) -> PanelRule {
        assert!(n > 0 && n.is_multiple_of(LANES), "a panel rule has a multiple of {LANES} nodes, not {n}");
        let rule = Gauss::new(n);
        let blocks = |x: &[f64]| x.as_chunks::<LANES>().0.to_vec();
        PanelRule { nodes: blocks(&rule.nodes), weights: blocks(&rule.weights) }
    }

    /// Nodes per panel.
    pub fn nodes(&self) -> usize {
        self.nodes.len() * LANES
    }

    /// Integral of `f` over [a, b].
    #[inline(always)]
    pub fn panel(&self, a: f64, b: f64, f: &impl Fn(&F8) -> F8) -> f64 {
        self.panel_of(a, b, &Function(f))
    }

    /// Integral of an integrand over [a, b]: [`PanelRule::panel`] where the integrand must be
    /// compiled for the instructions of its caller, which a closure outside of the caller's body is
    /// not.
    #[inline(always)]
    pub fn panel_of(&self, a: f64, b: f64, integrand: &impl Integrand) -> f64 {
        count::add(self.nodes());
        let (half, middle) = (0.5 * (b - a), 0.5 * (a + b));
        let mut total = 0.0;
        for (nodes, weights) in self.nodes.iter().zip(&self.weights) {
            let mut x = [0.0; LANES];
            for i in 0..LANES {
                x[i] = middle + half * nodes[i];
            }
            let mut y = integrand.at(&x);
            for i in 0..LANES {
                y[i] *= weights[i];
            }
            total += lanes::sum(&y);
        }
        half * total
    }

    /// Calls `f` with every node of [a, b] and its weight.
    pub fn each(&self, a: f64, b: f64, mut f: impl FnMut(f64, f64)) {
        count::add(self.nodes());
        let (half, middle) = (0.5 * (b - a), 0.5 * (a + b));
        for (nodes, weights) in self.nodes.iter().zip(&self.weights) {
            for (node, weight) in nodes.iter().zip(weights) {
                f(middle + half * node, half * weight);
            }
        }
    }

    /// Integral of `f` over all panels between the `cuts`.
    #[inline(always)]
    pub fn panels(&self, cuts: &[f64], f: &impl Fn(&F8) -> F8) -> f64 {
        cuts.windows(2).map(|cut| self.panel(cut[0], cut[1], f)).sum()
    }

    /// Integrals over all panels between the `cuts` of functions that share most of their work.
    #[inline(always)]
    pub fn panels_of_all<const N: usize>(&self, cuts: &[f64], f: &impl Fn(&F8) -> [F8; N]) -> [f64; N] {
        let mut sums = [0.0; N];
        for cut in cuts.windows(2) {
            count::add(self.nodes());
            let (half, middle) = (0.5 * (cut[1] - cut[0]), 0.5 * (cut[0] + cut[1]));
            let mut totals = [0.0; N];
            for (nodes, weights) in self.nodes.iter().zip(&self.weights) {
                let mut x = [0.0; LANES];
                for i in 0..LANES {
                    x[i] = middle + half * nodes[i];
                }
                for (mut y, total) in f(&x).into_iter().zip(&mut totals) {
                    for i in 0..LANES {
                        y[i] *= weights[i];
                    }
                    *total += lanes::sum(&y);
                }
            }
            for (sum, total) in sums.iter_mut().zip(totals) {
                *sum += half * total;
            }
        }
        sums
    }
}
