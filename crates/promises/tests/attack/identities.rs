//! What must be so whatever the formula: energies that close, limits, and one function by others.

use std::f64::consts::PI;

use lobefit_math::gauss::Gauss;
use lobefit_math::lanes::{self, LANES};
use lobefit_math::{ops, sum};
use lobefit_truth::integrate::Estimate;
use lobefit_truth::optics::{Smith, diffuse, footprint, fresnel, ggx, multiscatter};
use lobefit_truth::quantity::{GgxReflectionAniso, Quantity, Variant, sheen};

fn close(a: f64, b: f64, part: f64) {
    assert!((a - b).abs() <= part * b.abs(), "{a:e}, not {b:e}");
}

#[test]
fn shadowings_follow_from_one_another() {
    for smith in Smith::ALL {
        for (alpha, mu_v, mu_l) in [(0.3, 0.2, 0.7), (1e-9, 0.5, 0.1), (1e-4, 1e-3, 0.9), (1.0, 0.05, 0.05)] {
            let [s_v, s_l] = [mu_v, mu_l].map(|mu| ggx::stretched_length(alpha, mu));
            let [of_v, of_l] = [mu_v, mu_l].map(|mu| ggx::lambda(alpha, mu));
            let lit = smith.lit_given_visible(of_v, of_l) / (1.0 + of_v);
            close(4.0 * mu_v * mu_l * ggx::visibility(smith, mu_v, s_v, mu_l, s_l), lit, 1e-14);
            let lift = alpha * alpha * (1.0 - mu_l) * (1.0 + mu_l) / (s_l + mu_l);
            let shadowed = smith.shadowed_given_visible(of_v, of_l) / (1.0 + of_v);
            close(mu_v * smith.shadowed_over_cosine(mu_v, s_v, mu_l, s_l, lift), shadowed, 1e-12);
        }
    }
}

#[test]
fn normals_of_a_view_from_above_have_the_slopes_of_the_distribution() {
    for v in [1e-18, 1e-9, 0.3, 0.999] {
        for alpha in [1e-4, 0.2, 1.0] {
            let n = ggx::visible_normal([alpha; 2], [0.0, 0.0, 1.0], 0.1, v);
            let slope2 = (n[0] * n[0] + n[1] * n[1]) / (n[2] * n[2] * alpha * alpha);
            close(slope2, v / (1.0 - v), 1e-12);
        }
    }
}

#[test]
fn energies_close() {
    // Losses that are the same everywhere: the lobe is Lambert's, of that albedo.
    close(PI * multiscatter::kulla_conty(0.3, 0.3, 0.3), 0.3, 1e-15);
    assert!(multiscatter::kulla_conty(0.3, 0.3, f64::NAN).is_nan());
    assert!(diffuse::kelemen(0.3, 0.3, f64::NAN).is_nan());
    // An index of 1 + d, to the first order: |d|^2 (1 + cos^2(2 theta))/(8 cos^4(theta)).
    let (c, d) = (0.7, 1e-11);
    let twice: f64 = 2.0 * c * c - 1.0;
    let limit = 2.0 * d * d * (1.0 + twice * twice) / (8.0 * c * c * c * c);
    close(fresnel::conductor(1.0 + d, d, c), limit, 1e-6);
    assert_eq!(footprint::width(1.0, 1e6), 1.0, "as wide as a lobe gets");
    let (rule, alpha) = (Gauss::new(64), 0.3);
    let area =
        rule.integrate(0.0, 1.0, |sine| 2.0 * PI * sine * sheen::lobe::distribution(alpha, [sine, 0.0, 0.0]));
    close(area, 1.0, 1e-6);
    close(sheen::lobe::distribution(alpha, [1.0, 0.0, 0.0]), (2.0 + 1.0 / alpha) / (2.0 * PI), 1e-15);
}

#[test]
fn sums_keep_their_digits() {
    let values = vec![0.1; 1 << 20];
    close(sum::pairwise(&values), 0.1 * f64::from(1 << 20), 1e-14);
    close(sum::mean(&values), 0.1, 1e-14);
    close(sum::standard_error(&[1.0, 4.0]), 1.5, 1e-15);
    for i in 1..2_000 {
        let x = 1e-3 * f64::from(i);
        close(lanes::ln(&[lanes::exp(&[x; LANES])[0]; LANES])[0], x, 1e-14 / x.min(1.0));
    }
}

#[test]
fn an_error_is_no_less_than_the_square_of_the_difference() {
    for difference in [1e-3, 1e-5, 1e-7] {
        let [quick, slow] =
            [Estimate::from_pair, Estimate::from_slow_pair].map(|of| of(1.0, 1.0 + difference, 1.0).error);
        assert!(quick >= difference * difference && slow >= 0.04 * difference, "{quick:e} {slow:e}");
    }
}

/// E as the mean of what is lit of visible facets, over a lattice of them.
#[test]
fn anisotropic_energy_is_what_visible_facets_send_out() {
    const SIDE: usize = 400;
    for (alpha, mu, phi) in [([0.05, 0.8], 0.3, 0.2), ([0.8, 0.05], 0.3, 0.2), ([0.4, 0.1], 0.05, 1.2)] {
        let sine = f64::sqrt(1.0 - mu * mu);
        let view = [sine * ops::cos(phi), sine * ops::sin(phi), mu];
        for smith in Smith::ALL {
            let mut mean = 0.0;
            for i in 0..SIDE * SIDE {
                let at = |k: usize| (k as f64 + 0.5) / SIDE as f64;
                let (light, _) =
                    ggx::mirror(view, ggx::visible_normal(alpha, view, at(i / SIDE), at(i % SIDE)));
                if light[2] > 0.0 {
                    let [of_v, of_l] = [view, light].map(|x| ggx::lambda_towards(alpha, x));
                    mean += smith.lit_given_visible(of_v, of_l) / (SIDE * SIDE) as f64;
                }
            }
            let variant = Variant::from(smith);
            let e =
                GgxReflectionAniso.at(&variant, &[alpha[0], alpha[1], mu, phi], 1e-8).expect("a truth")[0];
            assert!((mean - e).abs() < 2e-3, "{smith:?} {alpha:?} {mu} {phi}: {mean} {e}");
        }
    }
}
