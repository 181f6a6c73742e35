//! The diffuse factors against their textbook forms: spec + factor = 1, by quadrature and with
//! sampled albedos.

use lobefit::data::Smith;
use lobefit_truth::integrate::monte_carlo::{self, sobol};
use lobefit_truth::integrate::reflection::{self, reflection};
use lobefit_truth::quantity::coupling::{Specular, TOLERANCE, coupling};

const SPECULARS: [Specular; 3] = [Specular::Single, Specular::Normalised, Specular::Compensated];
const ALPHAS: [f64; 6] = [0.0, 1e-4, 0.01, 0.2, 0.6, 1.0];
const COSINES: [f64; 6] = [0.0, 1e-4, 0.03, 0.3, 0.8, 1.0];
const F0S: [f64; 5] = [0.0, 0.04, 0.2, 0.5, 1.0];

/// Albedo of the specular lobe as renderers write it.
fn albedo(specular: Specular, f0: f64, e: f64, b: f64) -> f64 {
    let bare = f0 * (e - b) + b;
    match specular {
        Specular::Single => bare,
        Specular::Normalised => bare / e,
        Specular::Compensated => bare * (1.0 + f0 * (1.0 / e - 1.0)),
    }
}

#[test]
fn specular_and_factor_make_one() {
    for smith in [Smith::Correlated, Smith::Separable] {
        for (alpha, mu) in ALPHAS.iter().flat_map(|&alpha| COSINES.map(|mu| (alpha, mu))) {
            let lobe = reflection(smith, alpha, mu, reflection::TOLERANCE).expect("in the domain");
            for (specular, f0) in SPECULARS.iter().flat_map(|&specular| F0S.map(|f0| (specular, f0))) {
                let factor = coupling(smith, alpha, mu, f0, specular, TOLERANCE).expect("in the domain");
                let rest = 1.0 - albedo(specular, f0, lobe.e, lobe.b);
                let difference = (factor.value - rest).abs();
                assert!(
                    difference <= factor.error + 8.0 * lobe.error + 1e-15,
                    "{smith:?} {specular:?} alpha {alpha} mu {mu} f0 {f0}: {factor:?}, not {rest}"
                );
                assert!(factor.error <= TOLERANCE && factor.value <= 1.0 + 1e-12);
            }
        }
    }
}

/// The small factor of a smooth metal is its loss, which 1 - (f0 A + B) cancels away.
#[test]
fn a_smooth_metal_keeps_its_loss() {
    let lobe = reflection(Smith::Correlated, 1e-4, 0.9, 1e-12).expect("in the domain");
    let factor =
        coupling(Smith::Correlated, 1e-4, 0.9, 1.0, Specular::Single, TOLERANCE).expect("in the domain");
    assert_eq!(factor.value, lobe.loss);
    assert!(
        (factor.value / 1.117_283_950_617e-8 - 1.0).abs() < 1e-3,
        "alpha^2 (1 + 1/mu^2)/2, not {factor:?}"
    );
    for specular in [Specular::Normalised, Specular::Compensated] {
        let factor = coupling(Smith::Correlated, 0.3, 0.4, 1.0, specular, TOLERANCE).expect("in the domain");
        assert_eq!(factor.value, 0.0);
    }
}

/// Sampled E and B, put into the textbook's form here, agree with the factor; and the sampled
/// factor does.
#[test]
fn sampling_agrees() {
    for (seed, (alpha, mu)) in [(0.05, 0.1), (0.3, 0.4), (0.7, 0.9), (1.0, 0.05)].into_iter().enumerate() {
        let run = sobol(1 << 16, seed as u64);
        let lobe = monte_carlo::reflection(Smith::Correlated, alpha, mu, run).expect("in the domain");
        for (specular, f0) in SPECULARS.iter().flat_map(|&specular| F0S.map(|f0| (specular, f0))) {
            let truth =
                coupling(Smith::Correlated, alpha, mu, f0, specular, TOLERANCE).expect("in the domain");
            let rest = 1.0 - albedo(specular, f0, lobe.e.value, lobe.b.value);
            let spread = 5.5 * 8.0 * (lobe.e.standard_error + lobe.b.standard_error);
            assert!((rest - truth.value).abs() <= spread && spread < 0.02, "{alpha} {mu} {f0} {specular:?}");
            let sampled = lobefit_truth::quantity::coupling::monte_carlo::coupling(
                Smith::Correlated,
                alpha,
                mu,
                f0,
                specular,
                run,
            )
            .expect("in the domain");
            assert!((sampled.value - truth.value).abs() <= 5.5 * sampled.standard_error + truth.error);
        }
    }
}

#[test]
fn inputs_outside_the_domain_are_refused() {
    for (alpha, mu, f0, named) in [
        (0.5, 0.5, 1.5, "diffuse-coupling: f0 = 1.5 is outside [0, 1]"),
        (0.5, 0.5, f64::NAN, "f0 = NaN"),
        (2.0, 0.5, 0.5, "alpha = 2.0"),
        (0.5, -1.0, 0.5, "mu = -1.0"),
    ] {
        let result = coupling(Smith::Correlated, alpha, mu, f0, Specular::Single, TOLERANCE);
        let error = result.expect_err("refused").to_string();
        assert!(error.contains(named), "{error}");
    }
}
