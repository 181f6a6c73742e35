//! The sheen albedo: closed forms at the ends, an independent formulation over lights, Monte Carlo,
//! and the promise of the bound.
#![allow(
    clippy::disallowed_methods,
    reason = "a test may use the platform's functions: its tolerances allow for them"
)]

use std::f64::consts::PI;

use lobefit_math::gauss::Gauss;
use lobefit_math::{ops, panels};
use lobefit_truth::integrate::monte_carlo::sobol;
use lobefit_truth::quantity::sheen::{TOLERANCE, albedo, sheen};
use rayon::prelude::*;

const ALPHAS: [f64; 9] = [1e-6, 1e-4, 1e-3, 0.01, 0.05, 0.2, 0.45, 0.8, 1.0];
const COSINES: [f64; 12] = [0.0, 1e-30, 1e-6, 1e-3, 0.02, 0.1, 0.3, 0.6, 0.89, 0.91, 0.999, 1.0];

/// E over the light's polar angle and azimuth psi from the mirror direction: (2 + p)/(8 pi) int
/// mu_l/(mu + mu_l - mu mu_l) X^(p/2), with X = sin^2(theta_h) = 1 - (mu + mu_l)^2/q,
/// q = |v + l|^2. X is singular where l mirrors v, q small where both graze.
fn over_lights(alpha: f64, mu: f64) -> f64 {
    let (p, rule) = (1.0 / alpha, Gauss::new(24));
    let sine = |x: f64| ((1.0 - x) * (1.0 + x)).sqrt();
    let ring = |mu_l: f64| {
        let swing = 4.0 * sine(mu) * sine(mu_l);
        let sum2 = (mu + mu_l) * (mu + mu_l);
        // 2 (1 + mu mu_l - s s_l) = 2 (mu + mu_l)^2/(1 + mu mu_l + s s_l)
        let nearest = 2.0 * sum2 / (1.0 + mu * mu_l + 0.25 * swing);
        let at = |psi: f64| {
            let half = (0.5 * psi).sin();
            (0.5 * p * (-sum2 / (nearest + swing * half * half)).max(-1.0).ln_1p()).exp()
        };
        let near = graded(0.0, 0.5 * PI, 1e-9);
        let far = graded(PI, 0.5 * PI, 1e-2);
        let sum = |cuts: &[f64]| cuts.windows(2).map(|c| rule.integrate(c[0], c[1], at)).sum::<f64>();
        2.0 * (sum(&near) + sum(&far))
    };
    let light = |mu_l: f64| mu_l / (mu + mu_l - mu * mu_l) * ring(mu_l);
    let mut total = 0.0;
    let ranges = [
        graded(0.0, 0.5 * mu, 1e-6 * mu.min(alpha)),
        graded(mu, -0.5 * mu, 1e-7 * mu),
        graded(mu, 1.0 - mu, 1e-7 * mu),
    ];
    for cuts in &ranges {
        total += cuts.windows(2).map(|c| rule.integrate(c[0], c[1], light).abs()).sum::<f64>();
    }
    (2.0 + p) / (8.0 * PI) * total
}

/// Cuts from `from` over `length` (either way), graded towards `from`.
fn graded(from: f64, length: f64, scale: f64) -> Vec<f64> {
    let direction = length.signum();
    if length == 0.0 {
        vec![]
    } else {
        panels::from_zero(length.abs(), scale).iter().map(|x| from + direction * x).collect()
    }
}

#[test]
fn another_formulation_gives_the_same() {
    let points: Vec<(f64, f64)> = [1e-3, 0.02, 0.13, 0.3, 0.7, 1.0]
        .into_iter()
        .flat_map(|alpha| [1e-3, 0.03, 0.2, 0.5, 0.85, 0.95, 1.0].map(|mu| (alpha, mu)))
        .collect();
    points.par_iter().for_each(|&(alpha, mu)| {
        let (value, other) = (sheen(alpha, mu, TOLERANCE).expect("in the domain"), over_lights(alpha, mu));
        let difference = (value.value - other).abs();
        assert!(difference <= value.error + 1e-11 * other, "{alpha} {mu}: {value:?}, over lights {other}");
        assert!(difference <= 1e-9 * other, "{alpha} {mu}: {value:?}, over lights {other}, relatively");
    });
}

#[test]
fn the_ends_have_their_closed_forms() {
    for alpha in ALPHAS {
        let p = 1.0 / alpha;
        let grazing = sheen(alpha, 0.0, TOLERANCE).expect("in the domain");
        // The difference of two logarithms loses what they have before the point.
        let logarithms = ops::lgamma(0.5 * (p + 3.0)) - ops::lgamma(0.5 * (p + 4.0));
        let exact = (2.0 + p) / (2.0 * PI.sqrt()) * logarithms.exp();
        let lost = 1e-15 * (1.0 + ops::lgamma(0.5 * (p + 4.0)).abs()) * exact;
        assert!((grazing.value - exact).abs() <= grazing.error + lost, "{alpha}: {grazing:?}, not {exact}");
        let normal = sheen(alpha, 1.0, TOLERANCE).expect("in the domain");
        let exact = (-(0.5 * p + 1.0)).exp2() / (0.5 * p + 2.0);
        assert!(
            (normal.value - exact).abs() <= normal.error + 1e-13 * exact,
            "{alpha}: {normal:?}, not {exact}"
        );
    }
    let whole = sheen(0.5, 0.0, TOLERANCE).expect("in the domain");
    assert!(
        (whole.value - 0.75).abs() <= whole.error,
        "alpha 1/2: Gamma(5/2)/Gamma(3) 2/sqrt(pi) = 3/4, not {whole:?}"
    );
    let flat = sheen(1.0, 0.0, TOLERANCE).expect("in the domain");
    assert!((flat.value - 2.0 / PI).abs() <= flat.error, "{flat:?}");
}

/// The value that the notes on other people's tables give, and that E has no ceiling.
#[test]
fn energy_above_one_is_not_clamped() {
    let value = sheen(1e-3, 1e-3, TOLERANCE).expect("in the domain").value;
    assert!((value - 11.5).abs() < 0.05, "{value}");
    assert!(sheen(1e-6, 0.0, TOLERANCE).expect("in the domain").value > 398.0);
}

#[test]
fn the_bound_holds_and_is_also_a_relative_one() {
    let points: Vec<(f64, f64)> = ALPHAS.iter().flat_map(|&alpha| COSINES.map(|mu| (alpha, mu))).collect();
    for &(alpha, mu) in &points {
        let value = sheen(alpha, mu, TOLERANCE).expect("the promise");
        let loose = sheen(alpha, mu, 1e-3).expect("the promise");
        let tight = sheen(alpha, mu, 3e-11 * value.value.max(1.0)).expect("a tenth of the promise");
        assert!(value.error <= TOLERANCE && value.value >= 0.0);
        for one in [value, loose] {
            let difference = (one.value - tight.value).abs();
            assert!(difference <= one.error + tight.error, "{alpha} {mu}: {one:?} {tight:?}");
        }
        let quick = albedo(alpha, mu);
        assert!(
            (quick - tight.value).abs() <= 1e-11 * tight.value + 1e-300,
            "{alpha} {mu}: {quick} {tight:?}"
        );
    }
}

/// E falls with mu where the lobe is a rim, and is smooth across the change of formulas for R.
#[test]
fn nothing_jumps_where_the_formulas_change() {
    for alpha in [0.02, 0.2, 1.0] {
        let at = |mu: f64| sheen(alpha, mu, TOLERANCE).expect("in the domain").value;
        for mu in [0.9, 1e-18, 0.5] {
            let step = 1e-9 * mu;
            let (below, here, above) = (at(mu - step), at(mu), at(mu + step));
            let bend = (below - 2.0 * here + above).abs();
            assert!(bend <= 1e-13 * here, "alpha {alpha}, mu {mu}: {below} {here} {above}");
        }
    }
}

#[test]
fn sampling_agrees() {
    let mut squares = Vec::new();
    for (i, alpha) in [1e-3, 0.05, 0.2, 0.6, 1.0].into_iter().enumerate() {
        for (j, mu) in [0.0, 1e-3, 0.05, 0.4, 0.9].into_iter().enumerate() {
            let truth = sheen(alpha, mu, TOLERANCE).expect("in the domain").value;
            let guess = lobefit_truth::quantity::sheen::monte_carlo::sheen(
                alpha,
                mu,
                sobol(1 << 16, (10 * i + j) as u64),
            )
            .expect("in the domain");
            let z = (guess.value - truth) / guess.standard_error;
            assert!(z.abs() < 5.5, "{alpha} {mu}: {guess:?} of {truth}");
            squares.push(z * z);
        }
    }
    let mean = squares.iter().sum::<f64>() / squares.len() as f64;
    assert!((0.2..2.0).contains(&mean), "mean square of z {mean}");
}

#[test]
fn inputs_outside_the_domain_are_refused() {
    for (alpha, mu, named) in [
        (0.0, 0.5, "alpha = 0.0 is outside [1e-6, 1]"),
        (1.5, 0.5, "alpha = 1.5 is outside"),
        (f64::NAN, 0.5, "alpha = NaN is outside"),
        (0.5, -1e-9, "mu = -1e-9 is outside [0, 1]"),
        (0.5, f64::NAN, "mu = NaN is outside"),
    ] {
        let error = sheen(alpha, mu, TOLERANCE).expect_err("refused").to_string();
        assert!(error.contains(named), "{error}");
        assert!(lobefit_truth::quantity::sheen::monte_carlo::sheen(alpha, mu, sobol(64, 0)).is_err());
    }
    let error = sheen(0.5, 0.5, 1e-30).expect_err("refused").to_string();
    assert!(error.contains("tolerance 1e-30"), "{error}");
}
