//! `ggx-glass-aniso` against what is known of it otherwise.

use lobefit_math::ops;
use lobefit_truth::integrate::aniso::{self, glass::glass as of};
use lobefit_truth::integrate::glass::{Side, glass};
use lobefit_truth::integrate::monte_carlo::{aniso_glass, sobol};
use lobefit_truth::optics::Smith;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};

const TOLERANCE: f64 = 1e-6;

/// Widths, mu, azimuth and ior of random points, the widths apart by up to 100.
fn drawn(index: u64) -> ([f64; 2], [f64; 2], f64) {
    let mut random = Pcg64::seed_from_u64(7_000 + index);
    let mut log = |low: f64, high: f64| low * ops::pow(high / low, random.random());
    let (x, ratio, mu) = (log(0.01, 1.0), log(0.01, 1.0), log(0.01, 1.0));
    let (phi, ior) = (log(0.01, FRAC_PI_2), 1.0 + log(0.01, 2.0));
    let narrow = (x * ratio).max(0.01);
    (if index.is_multiple_of(2) { [x, narrow] } else { [narrow, x] }, [mu, phi], ior)
}

/// Every one of some random points, in both forms and from both sides.
fn each(points: u64, check: impl Fn(Smith, Side, ([f64; 2], [f64; 2], f64)) + Sync) {
    (0..points).into_par_iter().for_each(|i| {
        let smith = Smith::ALL[(i / 2 % 2) as usize];
        check(smith, Side::ALL[(i / 4 % 2) as usize], drawn(i));
    });
}

#[test]
fn monte_carlo_agrees_up_to_widths_of_1_to_100() {
    each(128, |smith, side, (alpha, view, ior)| {
        let value = of(smith, alpha, view, (ior, side), TOLERANCE).expect("in the domain");
        assert!((value.e + value.loss - 1.0).abs() < 2.0 * TOLERANCE, "{value:?}");
        let [r, t, loss] = aniso_glass(smith, alpha, view, (ior, side), sobol(1 << 16, 5)).expect("drawn");
        for (name, drawn, value) in [("R", r, value.r), ("T", t, value.t), ("loss", loss, value.loss)] {
            let bound = 6.0 * drawn.standard_error + TOLERANCE;
            let off = (drawn.value - value).abs();
            assert!(off < bound, "{name} {smith:?} {side:?} {alpha:?} {view:?} {ior}: {off:e} of {bound:e}");
        }
    });
}

#[test]
fn equal_widths_are_glass_whatever_the_azimuth() {
    each(64, |smith, side, ([alpha, _], [mu, phi], ior)| {
        let round = of(smith, [alpha; 2], [mu, phi], (ior, side), TOLERANCE).expect("in the domain");
        let known = glass(smith, alpha, mu, ior, side, 1e-8).expect("in the domain");
        for (a, b) in [(round.r, known.r), (round.t, known.t), (round.loss, known.loss)] {
            assert!((a - b).abs() < round.error + 1e-8, "{side:?} {alpha} {mu} {ior}: {round:?} {known:?}");
        }
    });
}

#[test]
fn it_is_even_about_both_tangents_and_a_quarter_turn_swaps_the_widths() {
    each(32, |smith, side, (alpha, [mu, phi], ior)| {
        let at = |alpha, phi| of(smith, alpha, [mu, phi], (ior, side), TOLERANCE).expect("in the domain");
        let [x, y] = alpha;
        let first = at(alpha, phi);
        for other in [at(alpha, -phi), at(alpha, PI - phi), at(alpha, PI + phi), at([y, x], FRAC_PI_2 - phi)]
        {
            let off = (first.r - other.r).abs().max((first.t - other.t).abs());
            assert!(off < first.error + other.error, "{side:?} {alpha:?} {mu} {phi} {ior}: {off:e}");
        }
    });
}

#[test]
fn what_it_reflects_and_refracts_of_no_contrast_is_all_refracted() {
    each(24, |smith, side, (alpha, view, _)| {
        let at = |ior| of(smith, alpha, view, (ior, side), TOLERANCE).expect("in the domain");
        let value = at(1.0);
        assert_eq!(value.r, 0.0);
        // The straight direction has the view's own Lambda.
        let [mu, phi] = view;
        let (sin_phi, cos_phi) = ops::sincos(phi);
        let (x, y) = (alpha[0] * cos_phi, alpha[1] * sin_phi);
        let tan2 = (x * x + y * y) * (1.0 - mu) * (1.0 + mu) / (mu * mu);
        let lambda = 0.5 * ((1.0 + tan2).sqrt() - 1.0);
        let lit = smith.lit_given_visible(lambda, lambda);
        assert!((value.t - lit).abs() < value.error, "{alpha:?} {view:?}: {} {lit}", value.t);
        assert!((at(1.0 + 1e-9).t - lit).abs() < 1e-3, "{side:?} {alpha:?} {view:?}");
    });
}

/// Where every facet reflects totally, and where F is known, the reflection is that of F = 1.
#[test]
fn total_reflection_is_the_albedo_of_the_lobe_that_reflects_all() {
    for smith in Smith::ALL {
        for phi in [0.0, 0.4, FRAC_PI_2] {
            let (alpha, mu) = ([0.02, 0.01], 0.1);
            let value = of(smith, alpha, [mu, phi], (4.0, Side::Inside), TOLERANCE).expect("in the domain");
            let known = aniso::aniso(smith, alpha, mu, Some(phi), 1e-9).expect("in the domain");
            // All facets but those in the tail, farther than a radian from the normal.
            assert!((value.r - known.e).abs() < 2e-3, "{phi}: {value:?} {known:?}");
        }
    }
}

/// The values beside its own bound, from rules of twice the nodes at a finer tolerance.
#[test]
fn error_is_a_bound() {
    let above = |i: &u64| {
        let (smith, side) = (Smith::ALL[(i / 2 % 2) as usize], Side::ALL[(i / 4 % 2) as usize]);
        let (alpha, view, ior) = drawn(500 + i);
        let coarse = of(smith, alpha, view, (ior, side), 1e-4).expect("in the domain");
        let Ok(fine) = of(smith, alpha, view, (ior, side), 1e-9) else { return false };
        (coarse.r - fine.r).abs().max((coarse.t - fine.t).abs()) > coarse.error + 1e-9
    };
    let count = (0..80).into_par_iter().filter(above).count();
    assert_eq!(count, 0, "of 80 are off by more than their error");
}

#[test]
fn a_smooth_surface_is_fresnel_and_what_lies_outside_the_domain_is_refused() {
    let at = |alpha, mu, ior| of(Smith::Correlated, alpha, [mu, 0.3], (ior, Side::Outside), TOLERANCE);
    let smooth = at([0.0; 2], 1.0, 1.5).expect("in the domain");
    assert!((smooth.r - 0.04).abs() < 1e-15 && smooth.e == 1.0, "{smooth:?}");
    let refused =
        [at([0.0, 0.1], 0.5, 1.5), at([0.1; 2], 0.0, 1.5), at([0.1; 2], 0.5, 4.5), at([5.0; 2], 0.5, 1.5)];
    for (value, input) in refused.into_iter().zip(["alpha_x", "mu", "ior", "alpha_x"]) {
        let text = value.expect_err("outside").to_string();
        assert!(text.contains("ggx-glass-aniso") && text.contains(input), "{text}");
    }
}
