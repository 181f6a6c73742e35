//! `beckmann-reflection` against integrals that share nothing with it: over the slopes of facets,
//! in a plain adaptive rule, with Lambda as its own integral; and against Monte Carlo, limits and
//! the weak white furnace.

#![allow(clippy::disallowed_methods)]

use std::f64::consts::PI;

use lobefit_truth::integrate::monte_carlo;
use lobefit_truth::optics::Smith;
use lobefit_truth::optics::beckmann::Beckmann;
use lobefit_truth::optics::distribution::Distribution;
use lobefit_truth::quantity::BECKMANN_REFLECTION;

/// Adaptive Simpson's rule.
fn simpson(f: &dyn Fn(f64) -> f64, [a, b]: [f64; 2], tolerance: f64) -> f64 {
    fn halve(
        f: &dyn Fn(f64) -> f64,
        x: [f64; 3],
        y: [f64; 3],
        whole: f64,
        tolerance: f64,
        depth: u32,
    ) -> f64 {
        let (left, right) = (0.5 * (x[0] + x[1]), 0.5 * (x[1] + x[2]));
        let (fl, fr) = (f(left), f(right));
        let sixth = (x[2] - x[0]) / 12.0;
        let (first, second) = (sixth * (y[0] + 4.0 * fl + y[1]), sixth * (y[1] + 4.0 * fr + y[2]));
        let off = first + second - whole;
        if depth == 0 || off.abs() <= 15.0 * tolerance {
            return first + second + off / 15.0;
        }
        halve(f, [x[0], left, x[1]], [y[0], fl, y[1]], first, 0.5 * tolerance, depth - 1)
            + halve(f, [x[1], right, x[2]], [y[1], fr, y[2]], second, 0.5 * tolerance, depth - 1)
    }
    let panels = 16;
    let step = (b - a) / f64::from(panels);
    let panel = |i: i32| {
        let x = [0.0, 0.5, 1.0].map(|part| a + step * (f64::from(i) + part));
        let y = x.map(f);
        halve(f, x, y, step / 6.0 * (y[0] + 4.0 * y[1] + y[2]), tolerance / f64::from(panels), 30)
    };
    (0..panels).map(panel).sum()
}

/// Lambda = int_(cot theta)^inf (x - cot theta) P(x) dx / cot theta of normal slopes (Heitz 2014,
/// eq. 66).
fn lambda(alpha: f64, mu: f64) -> f64 {
    let cot = mu / ((1.0 - mu) * (1.0 + mu)).sqrt();
    let slopes = |x: f64| (x - cot) * (-(x * x) / (alpha * alpha)).exp() / (alpha * PI.sqrt());
    simpson(&slopes, [cot, cot.max(0.0) + 7.0 * alpha], 1e-13) / cot
}

/// E, B and loss over visible slopes (x, y), in units of alpha: the weight of a facet is (1 - x tan
/// theta) exp(-x^2 - y^2)/pi G1.
fn by_slopes(smith: Smith, alpha: f64, mu: f64) -> [f64; 3] {
    let sine = ((1.0 - mu) * (1.0 + mu)).sqrt();
    let of_view = lambda(alpha, mu);
    let g1 = 1.0 / (1.0 + of_view);
    let weights = |x: f64, y: f64| -> [f64; 3] {
        let length = (1.0 + alpha * alpha * (x * x + y * y)).sqrt();
        let visible = (mu - alpha * x * sine) / mu;
        if visible <= 0.0 {
            return [0.0; 3];
        }
        let vh = mu * visible / length;
        let light = 2.0 * vh / length - mu;
        let weight = g1 * visible * (-(x * x) - y * y).exp() / PI;
        if light <= 0.0 {
            return [0.0, 0.0, weight];
        }
        let of_light = Beckmann(alpha).lambda(light.min(1.0));
        let kept = match smith {
            Smith::Correlated => (1.0 + of_view) / (1.0 + of_view + of_light),
            Smith::Separable => 1.0 / (1.0 + of_light),
        };
        [weight * kept, weight * kept * (1.0 - vh).powi(5), weight * (1.0 - kept)]
    };
    [0, 1, 2].map(|k| {
        let line = |y: f64| {
            let end = (mu / (alpha * sine)).min(6.0);
            // The light is at its horizon where 2 (mu - a x sin)/(1 + a^2 (x^2 + y^2)) = mu.
            let (q, p) = (sine / (alpha * mu), (1.0 / (alpha * alpha)) - y * y);
            let root = (q * q + p).max(0.0).sqrt();
            let mut cuts = vec![-6.0, -q - root, -q + root, end];
            cuts.retain(|x| (-6.0..=end).contains(x));
            cuts.sort_by(f64::total_cmp);
            cuts.windows(2).map(|w| simpson(&|x| weights(x, y)[k], [w[0], w[1]], 1e-11)).sum::<f64>()
        };
        2.0 * simpson(&line, [0.0, 6.0], 1e-10)
    })
}

fn at(smith: Smith, alpha: f64, mu: f64) -> [f64; 5] {
    let v = BECKMANN_REFLECTION.at(&smith.into(), &[alpha, mu], 1e-10).expect("a value");
    [v[0], v[1], v[2], v[3], v[4]]
}

#[test]
fn values_are_those_of_an_integral_over_slopes() {
    for (alpha, mu) in [(1.0, 0.9), (1.0, 0.1), (0.5, 0.5), (0.3, 0.05), (0.1, 0.3), (0.1, 0.02)] {
        for smith in Smith::ALL {
            let ([e, _, b, loss, error], [of_e, of_b, of_loss]) =
                (at(smith, alpha, mu), by_slopes(smith, alpha, mu));
            for (value, other) in [(e, of_e), (b, of_b), (loss, of_loss)] {
                assert!((value - other).abs() < error + 1e-8, "{smith:?} {alpha} {mu}: {value} {other}");
            }
        }
    }
}

#[test]
fn values_are_those_of_monte_carlo() {
    let run = monte_carlo::sobol(1 << 16, 7);
    for (alpha, mu) in [(1.0, 1.0), (0.7, 0.3), (0.3, 0.02), (0.1, 0.1), (0.01, 0.005), (1e-3, 1.0)] {
        for smith in Smith::ALL {
            let v = at(smith, alpha, mu);
            let sampled =
                BECKMANN_REFLECTION.second_opinion(&smith.into(), &[alpha, mu], run).expect("samples");
            for (value, sampled) in v.iter().zip(sampled) {
                let off = (value - sampled.value).abs();
                assert!(
                    off < 5.0 * sampled.standard_error + v[4],
                    "{smith:?} {alpha} {mu}: {value} {sampled:?}"
                );
            }
        }
    }
}

/// E and loss are integrals of their own, and add up to 1 by the weak white furnace; from
/// mirror-like to rough, to grazing view.
#[test]
fn energy_is_whole() {
    for alpha in [1e-7, 1e-4, 1e-2, 0.05, 0.2, 0.6, 1.0] {
        for mu in [0.0, 1e-12, 1e-6, 1e-3, 0.03, 0.3, 0.8, 1.0] {
            for smith in Smith::ALL {
                let [e, a, b, loss, error] = at(smith, alpha, mu);
                assert!(
                    (e + loss - 1.0).abs() <= 2.0 * error,
                    "{smith:?} {alpha} {mu}: {e} + {loss}, {error:e}"
                );
                assert!((a + b - e).abs() < 1e-15 && b > 0.0 && loss >= 0.0, "{smith:?} {alpha} {mu}");
            }
        }
    }
}

/// What leaves a lobe as alpha goes to 0 is a mirror's; at mu = 0 the correlated form loses
/// nothing.
#[test]
fn limits_are_reached() {
    for mu in [0.01_f64, 0.3, 1.0] {
        let [e, a, b, loss, _] = at(Smith::Correlated, 0.0, mu);
        assert_eq!((e, loss), (1.0, 0.0));
        let near = at(Smith::Correlated, 1e-6, mu);
        for (value, limit) in near.into_iter().zip([e, a, b, loss]) {
            assert!((value - limit).abs() < 1e-8, "{mu}: {value} {limit}");
        }
    }
    for alpha in [1e-3, 0.1, 1.0] {
        let [e, _, _, loss, error] = at(Smith::Correlated, alpha, 0.0);
        assert!((e - 1.0).abs() <= error && loss == 0.0, "{alpha}: {e} {loss}");
    }
}

/// Relative, where the loss is anything but an underflow: the light that a smooth lobe loses at
/// normal incidence leaves facets steeper than 45 degrees, exp(-1/alpha^2) of all, and the little
/// that is shadowed before.
#[test]
fn small_losses_are_relative() {
    for alpha in [0.15, 0.2, 0.3] {
        let [.., loss, _] = at(Smith::Separable, alpha, 1.0);
        let weight = |t: f64| {
            // t = tan^2 of the facet: its light is at cos 2 theta.
            let light = (1.0 - t) / (1.0 + t);
            let shadowed = if light > 0.0 {
                let of_light = Beckmann(alpha).lambda(light);
                of_light / (1.0 + of_light)
            } else {
                1.0
            };
            shadowed * (-t / (alpha * alpha)).exp() / (alpha * alpha)
        };
        let scale = 1e-10 * loss;
        let expected = simpson(&weight, [0.0, 1.0], scale)
            + simpson(&weight, [1.0, 2.0], scale)
            + (-2.0 / (alpha * alpha)).exp();
        assert!((loss / expected - 1.0).abs() < 1e-6, "{alpha}: {loss:e} {expected:e}");
    }
}

#[test]
fn a_negligible_loss_does_not_hold_up_a_value() {
    for (alpha, mu) in [(9.5e-5, 0.005_37), (1e-3, 0.05), (0.01, 0.3)] {
        let [e, _, _, loss, error] = at(Smith::Correlated, alpha, mu);
        assert!((e + loss - 1.0).abs() <= error && loss < 1e-12, "{alpha} {mu}: {e} {loss}");
    }
}

#[test]
fn projected_area_of_the_normals_is_one() {
    for alpha in [0.05, 0.3, 1.0] {
        let polar = |theta: f64| {
            let normal = [theta.sin(), 0.0, theta.cos()];
            2.0 * PI * theta.sin() * theta.cos() * Beckmann(alpha).density(normal)
        };
        let whole = simpson(&polar, [0.0, 0.5 * PI - 1e-9], 1e-12);
        assert!((whole - 1.0).abs() < 1e-9, "{alpha}: {whole}");
    }
}

#[test]
fn lambda_is_the_integral_over_slopes() {
    for (alpha, mu) in [(1.0, 0.9), (1.0, 0.01), (0.3, 0.2), (0.1, 0.15), (0.05, 0.08)] {
        let (closed, other) = (Beckmann(alpha).lambda(mu), lambda(alpha, mu));
        assert!((closed - other).abs() < 1e-9 * (1.0 + other), "{alpha} {mu}: {closed} {other}");
    }
}
