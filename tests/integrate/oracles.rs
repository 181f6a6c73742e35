//! The truth against closed forms, published high-precision values, limits and identities.
#![allow(
    clippy::disallowed_methods,
    reason = "a test may use the platform's functions: its tolerances allow for them"
)]

use lobefit::data::Smith;
use lobefit_truth::integrate::reflection::{TOLERANCE, average, reflection};

const BOTH: [Smith; 2] = [Smith::Correlated, Smith::Separable];

/// loss(mu, 1) = mu ln(1 + 1/mu) for the correlated form, E = 2 (1 - ln 2)/(1 + mu) for the
/// separable one: at alpha = 1 the BRDF times cosine is mu_l / (2 pi (mu_v + mu_l)), respectively 2
/// mu_l / (pi (1 + mu_v)(1 + mu_l)) / 2.
#[test]
fn alpha_one_has_a_closed_form() {
    for i in 0..=1000 {
        let mu = f64::from(i) / 1000.0;
        let mu = mu * mu;
        let value = reflection(Smith::Correlated, 1.0, mu, TOLERANCE).expect("in the domain");
        let loss = if mu == 0.0 { 0.0 } else { mu * (1.0 / mu).ln_1p() };
        assert!((value.loss - loss).abs() <= value.error.max(1e-13), "mu {mu}: {} {loss}", value.loss);
        assert!((value.loss - loss).abs() <= 1e-10 * loss, "relative, mu {mu}: {} {loss}", value.loss);
        assert!((value.e - (1.0 - loss)).abs() <= value.error, "mu {mu}: {}", value.e);
        let value = reflection(Smith::Separable, 1.0, mu, TOLERANCE).expect("in the domain");
        let e = 2.0 * (1.0 - std::f64::consts::LN_2) / (1.0 + mu);
        assert!((value.e - e).abs() <= value.error, "separable, mu {mu}: {} {e}", value.e);
        assert!((value.loss - (1.0 - e)).abs() <= value.error, "separable, mu {mu}: {}", value.loss);
    }
}

#[test]
fn average_at_alpha_one() {
    let value = average(Smith::Correlated, 1.0, TOLERANCE).expect("in the domain");
    let e_avg = 4.0 / 3.0 * (1.0 - std::f64::consts::LN_2);
    assert!((value.e_avg - e_avg).abs() <= 1e-13, "{} {e_avg}", value.e_avg);
    // separable: 2 int 2 (1 - ln 2) mu / (1 + mu) dmu = 4 (1 - ln 2)^2
    let value = average(Smith::Separable, 1.0, TOLERANCE).expect("in the domain");
    let e_avg = 4.0 * (1.0 - std::f64::consts::LN_2) * (1.0 - std::f64::consts::LN_2);
    assert!((value.e_avg - e_avg).abs() <= 1e-13, "{} {e_avg}", value.e_avg);
}

/// One-dimensional integrals at normal incidence, to 18 digits at 30 digits of working precision.
#[test]
fn loss_at_normal_incidence() {
    for (alpha, loss) in [
        (0.5, 0.312_151_484_889_763_627),
        (0.1, 0.011_695_943_479_387_957_5),
        (0.04, 0.001_702_533_733_800_821_73),
        (0.01, 1.014_435_939_773_060_41e-4),
        (1e-3, 1.001_351_303_056_955_94e-6),
        (1e-4, 1.000_133_582_140_067_51e-8),
    ] {
        let value = reflection(Smith::Correlated, alpha, 1.0, TOLERANCE).expect("in the domain");
        assert!((value.loss / loss - 1.0).abs() <= 1e-12, "alpha {alpha}: {:e} {loss:e}", value.loss);
        assert!((value.e - (1.0 - loss)).abs() <= 1e-13, "alpha {alpha}: {}", value.e);
    }
}

/// alpha << mu: loss -> alpha^2 (1 + 1/mu^2) / 2 with a relative remainder O(alpha/mu).
#[test]
fn small_alpha_limit_of_the_loss() {
    for i in 0..32 {
        let mu = 0.05 + 0.95 * f64::from(i) / 31.0;
        let (mut ratio, mut bound) = ([0.0; 3], [0.0; 3]);
        for (k, alpha) in [1e-4, 1e-5, 1e-6].into_iter().enumerate() {
            let value = reflection(Smith::Correlated, alpha, mu, TOLERANCE).expect("in the domain");
            ratio[k] = value.loss / (0.5 * alpha * alpha * (1.0 + 1.0 / (mu * mu))) - 1.0;
            bound[k] = 4.0 * alpha / mu;
            assert!(ratio[k].abs() <= bound[k], "alpha {alpha}, mu {mu}: {:e}", ratio[k]);
        }
        assert!(
            ratio[2].abs() <= 0.2 * ratio[1].abs().max(1e-9),
            "mu {mu}: the remainder shrinks with alpha, {ratio:?}"
        );
    }
}

#[test]
fn values_known_from_two_routes() {
    for (alpha, mu, e) in
        [(0.1, 0.1, 0.8834550018671), (0.3, 0.5, 0.8217110031508), (1e-4, 1e-4, 0.8920754826538)]
    {
        let value = reflection(Smith::Correlated, alpha, mu, TOLERANCE).expect("in the domain");
        assert!((value.e - e).abs() < 1e-12, "E({alpha}, {mu}) = {}", value.e);
    }
    // B to the six digits at hand.
    for (alpha, mu, b) in [
        (0.01, 0.01, 0.767624),
        (0.01, 0.35, 0.115936),
        (0.2, 0.1, 0.174357),
        (0.2, 0.7, 0.004653),
        (1.0, 0.01, 0.042780),
        (1.0, 0.35, 0.006559),
    ] {
        let value = reflection(Smith::Correlated, alpha, mu, TOLERANCE).expect("in the domain");
        assert!((value.b - b).abs() < 5.1e-7, "B({alpha}, {mu}) = {}", value.b);
    }
}

/// E and the loss are integrals of different integrands over different ranges: by the weak white
/// furnace they add up to 1.
#[test]
fn albedo_and_loss_close() {
    for smith in BOTH {
        for i in 0..=28 {
            for j in 0..=40 {
                let alpha = 10_f64.powf(-7.0 * f64::from(i) / 28.0);
                let mu = 10_f64.powf(-10.0 * f64::from(j) / 40.0);
                let value = reflection(smith, alpha, mu, TOLERANCE).expect("in the domain");
                let gap = (value.e + value.loss - 1.0).abs();
                assert!(gap <= 2.0 * value.error && gap < 5e-15, "{smith:?} {alpha} {mu}: {gap:e}");
                assert!((value.a + value.b - value.e).abs() < 1e-15, "E = A + B");
                assert!(value.b > 0.0 && value.a > -value.error, "{smith:?} {alpha} {mu}: {value:?}");
            }
        }
    }
}

/// E_avg by another rule over another variable: Gauss in ln(mu) over octaves, from the quantity
/// itself.
#[test]
fn averages_are_the_means_of_the_quantity() {
    let rule = lobefit_math::gauss::Gauss::new(24);
    for smith in BOTH {
        for alpha in [1e-4, 1e-3, 0.03, 0.2, 0.5, 0.9, 1.0] {
            let (mut e_avg, mut loss_avg) = (0.0, 0.0);
            let mut high = 1.0_f64;
            while high > 1e-9 {
                let low = 0.5 * high;
                e_avg += rule.integrate(low.ln(), high.ln(), |x| {
                    2.0 * x.exp() * x.exp() * at(smith, alpha, x.exp()).e
                });
                loss_avg += rule.integrate(low.ln(), high.ln(), |x| {
                    2.0 * x.exp() * x.exp() * at(smith, alpha, x.exp()).loss
                });
                high = low;
            }
            let value = average(smith, alpha, TOLERANCE).expect("in the domain");
            assert!(value.error <= TOLERANCE, "{smith:?} {alpha}: {value:?}");
            assert!(
                (value.e_avg - e_avg).abs() <= value.error.max(1e-12),
                "{smith:?} {alpha}: {value:?} {e_avg}"
            );
            assert!(
                (value.loss_avg / loss_avg - 1.0).abs() <= 1e-9,
                "{smith:?} {alpha}: {value:?} {loss_avg}"
            );
        }
    }
}

fn at(smith: Smith, alpha: f64, mu: f64) -> lobefit_truth::integrate::reflection::Reflection {
    reflection(smith, alpha, mu.min(1.0), TOLERANCE).expect("in the domain")
}

#[test]
fn ends_of_the_domain_are_values() {
    for smith in BOTH {
        for mu in [0.0, 0.25, 1.0] {
            let mirror = reflection(smith, 0.0, mu, TOLERANCE).expect("alpha = 0 is a mirror");
            let b = (1.0 - mu) * (1.0 - mu) * (1.0 - mu) * (1.0 - mu) * (1.0 - mu);
            assert_eq!((mirror.e, mirror.loss, mirror.b, mirror.a), (1.0, 0.0, b, 1.0 - b));
        }
        // mu = 0 continues mu -> 0, and a nearly smooth lobe continues the mirror.
        let (edge, near) = (reflection(smith, 0.5, 0.0, 1e-10), reflection(smith, 0.5, 1e-9, 1e-10));
        let (edge, near) = (edge.expect("mu = 0"), near.expect("mu = 1e-9"));
        assert!((edge.e - near.e).abs() < 1e-7 && (edge.b - near.b).abs() < 1e-6, "{edge:?} {near:?}");
        let smooth = reflection(smith, 1e-7, 0.5, 1e-10).expect("alpha = 1e-7");
        assert!((smooth.e - 1.0).abs() < 1e-12 && (smooth.b - 0.03125).abs() < 1e-9, "{smooth:?}");
    }
    for mu in [5e-324, 1e-300, 1e-160, 1e-100, 1e-50] {
        let value = reflection(Smith::Correlated, 0.5, mu, 1e-10).expect("any mu in [0, 1]");
        assert!((value.e - 1.0).abs() < 1e-12 && value.loss < 1e-15, "mu {mu:e}: {value:?}");
    }
    let edge = reflection(Smith::Correlated, 0.5, 0.0, 1e-10).expect("mu = 0");
    assert!((edge.e - 1.0).abs() < 1e-12 && edge.loss == 0.0, "{edge:?}");
}

/// At alpha = 1 the half vector's density is 1/pi, and at mu = 0 B = int (1 - v.h)^5 over the
/// facets that are seen is 1/21.
#[test]
fn bias_at_grazing_view_is_within_its_error() {
    let edge = reflection(Smith::Correlated, 1.0, 0.0, 1e-10).expect("mu = 0");
    assert!((edge.b - 1.0 / 21.0).abs() <= edge.error, "{edge:?}");
}

#[test]
fn bad_inputs_are_named() {
    let (neither, outside) = ("is neither 0 nor in [1e-7, 1]", "is outside [0, 1]");
    for (alpha, mu, name, fault) in [
        (f64::NAN, 0.5, "alpha", neither),
        (-0.1, 0.5, "alpha", neither),
        (1.1, 0.5, "alpha", neither),
        (1e-300, 0.5, "alpha", "alpha = 1e-300 is neither 0 nor in [1e-7, 1]"),
        (0.5, 1.5, "mu", outside),
        (0.5, f64::NAN, "mu", outside),
    ] {
        let error =
            reflection(Smith::Correlated, alpha, mu, 1e-10).expect_err("outside the domain").to_string();
        assert!(error.contains(&format!("{name} = ")) && error.ends_with(fault), "{error}");
    }
    let error = reflection(Smith::Correlated, 0.5, 0.5, 1e-18).expect_err("below rounding").to_string();
    assert!(error.contains("tolerance"), "{error}");
}
