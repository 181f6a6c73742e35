//! `beckmann-glass` against an integral over the slopes of facets and Monte Carlo, in its limits, by
//! the reciprocity of transmission; and the kernel of tables against it.

#![allow(clippy::disallowed_methods)]

use std::f64::consts::PI;

use lobefit_truth::integrate::glass::Side;
use lobefit_truth::integrate::glass::table::{Energies, Kernel};
use lobefit_truth::integrate::monte_carlo::{Draw, Points, Run};
use lobefit_truth::optics::Smith;
use lobefit_truth::optics::beckmann::Beckmann;
use lobefit_truth::points;
use lobefit_truth::quantity::{BECKMANN_GLASS, Choice, GGX_GLASS, Variant};

/// Rough and less so, upright and grazing, across the critical angle and near the matched index.
const PLACES: [[f64; 3]; 5] =
    [[0.5, 0.7, 1.5], [1.0, 0.2, 1.5], [0.15, 0.6, 1.8], [0.3, 0.95, 1.1], [0.7, 0.4, 2.5]];

fn variant(smith: Smith, side: Side) -> Variant {
    let mut variant = Variant::from(smith);
    assert!(variant.choose(Choice::Side, side.name()));
    variant
}

/// R, T, E, loss and error.
fn truth(smith: Smith, place: &[f64], side: Side) -> Vec<f64> {
    BECKMANN_GLASS.at(&variant(smith, side), place, 1e-8).expect("in the domain")
}

fn lambda(alpha: f64, cosine: f64) -> f64 {
    let cosine = cosine.abs().min(1.0 - 1e-15);
    let c = cosine / (alpha * ((1.0 - cosine) * (1.0 + cosine)).sqrt());
    if c > 6.0 { 0.0 } else { 0.5 * ((-c * c).exp() / (c * PI.sqrt()) - lobefit_math::ops::erfc(c)) }
}

/// R and T by a plain sum over slopes (x, y) in units of alpha: facets have the density exp(-x^2 - y^2)/pi,
/// and the view sees (v.h)/(mu h_z) G2 of each; Fresnel from its two polarisations.
fn by_slopes(smith: Smith, [alpha, mu, ior]: [f64; 3], side: Side) -> [f64; 2] {
    // Next to total reflection Fresnel's term has the slope of a root.
    const N: i32 = 380;
    // Beyond lies 1e-9.
    const REACH: f64 = 4.5;
    let eta = if side == Side::Outside { 1.0 / ior } else { ior };
    let (sine, of_view) = ((1.0 - mu * mu).sqrt(), lambda(alpha, mu));
    let step = REACH / f64::from(N);
    let mut sums = [0.0; 2];
    for i in -N..N {
        for j in 0..N {
            let (x, y) = ((f64::from(i) + 0.5) * step, (f64::from(j) + 0.5) * step);
            let length = (1.0 + alpha * alpha * (x * x + y * y)).sqrt();
            let normal = [-alpha * x / length, -alpha * y / length, 1.0 / length];
            let c = sine * normal[0] + mu * normal[2];
            if c <= 0.0 {
                continue;
            }
            let weight = 2.0 * step * step * (-x * x - y * y).exp() / PI * c * length / mu;
            let square = 1.0 - eta * eta * (1.0 - c * c);
            let c_t = square.max(0.0).sqrt();
            let s = ((eta * c - c_t) / (eta * c + c_t)).powi(2);
            let p = ((c - eta * c_t) / (c + eta * c_t)).powi(2);
            let fresnel = if square > 0.0 { 0.5 * (s + p) } else { 1.0 };
            let lights = [2.0 * c * normal[2] - mu, eta * mu - (eta * c - c_t) * normal[2]];
            for ((sum, light), share) in sums.iter_mut().zip(lights).zip([fresnel, 1.0 - fresnel]) {
                let of_light = lambda(alpha, light);
                let shadowing = match smith {
                    Smith::Correlated => 1.0 / (1.0 + of_view + of_light),
                    Smith::Separable => 1.0 / ((1.0 + of_view) * (1.0 + of_light)),
                };
                *sum += if light > 0.0 { weight * share * shadowing } else { 0.0 };
            }
        }
    }
    sums
}

#[test]
fn it_is_the_integral_over_slopes() {
    for (k, place) in PLACES.iter().enumerate() {
        for (side, smith) in Side::ALL.into_iter().zip([Smith::ALL[k % 2], Smith::ALL[(k + 1) % 2]]) {
            let (exact, sum) = (truth(smith, place, side), by_slopes(smith, *place, side));
            for (k, value) in sum.into_iter().enumerate() {
                assert!((exact[k] - value).abs() < 1e-4, "{smith:?} {place:?} {side:?}: {exact:?} {sum:?}");
            }
        }
    }
}

/// Next to ior = 1 facets at grazing pass from the one side of the critical angle to the other within a
/// narrow band of azimuths.
#[test]
fn the_promise_is_kept_in_the_corners_of_the_domain() {
    for ((alpha, mu), ior) in [1.0, 0.03, 1e-4]
        .into_iter()
        .flat_map(|alpha| [1e-6, 3e-6, 1e-5, 1e-3].map(|mu| (alpha, mu)))
        .flat_map(|place| [1.0 + 1e-7, 1.00001, 1.0001, 1.001, 4.0].map(|ior| (place, ior)))
    {
        for (side, smith) in Side::ALL.into_iter().zip(Smith::ALL) {
            let [r, t, e, loss, error] = truth(smith, &[alpha, mu, ior], side)[..] else { panic!("outputs") };
            let place = format!("{smith:?} {alpha} {mu} {ior} {side:?}: {r} {t} {loss} {error}");
            assert!(error <= 1e-8 && r >= 0.0 && t >= 0.0 && (e + loss - 1.0).abs() < 1e-12, "{place}");
            if alpha == 1.0 {
                let [r_by_slopes, t_by_slopes] = by_slopes(smith, [alpha, mu, ior], side);
                let off = (r - r_by_slopes).abs().max((t - t_by_slopes).abs());
                assert!(off < 1e-4, "{place}; by slopes {r_by_slopes} {t_by_slopes}");
            }
        }
    }
}

#[test]
fn monte_carlo_agrees_within_its_error() {
    let run = Run { samples: 1 << 14, seed: 3, points: Points::Sobol, draw: Draw::VisibleNormal };
    for (k, place) in PLACES.iter().enumerate() {
        let (smith, side) = (Smith::ALL[k % 2], Side::ALL[k / 2 % 2]);
        let exact = truth(smith, place, side);
        let drawn = BECKMANN_GLASS.second_opinion(&variant(smith, side), place, run).expect("samples");
        for (exact, drawn) in exact.iter().zip(&drawn) {
            let off = (exact - drawn.value).abs();
            assert!(off < 5.0 * drawn.standard_error + 1e-9, "{place:?}: {exact} {drawn:?}");
        }
    }
}

#[test]
fn energies_are_kept_and_limits_reached() {
    for side in Side::ALL {
        for place in &PLACES {
            let [correlated, separable] = Smith::ALL.map(|smith| truth(smith, place, side));
            let room = if place[0] < 0.5 { 1e-8 } else { 0.0 };
            assert!(separable[2] < correlated[2] + room && correlated[2] < 1.0 + room, "{place:?}");
            assert!(
                (correlated[2] + correlated[3] - 1.0).abs() < 1e-8,
                "{place:?}: the loss is its own integral"
            );
        }
        // As alpha falls both distributions become the smooth interface; the loss goes as D does.
        let [smooth, mirror] = [1e-3, 0.0].map(|alpha| truth(Smith::Correlated, &[alpha, 0.6, 1.5], side));
        assert!((smooth[0] - mirror[0]).abs() < 1e-4 && smooth[3] < 1e-8, "{smooth:?} {mirror:?}");
        // At the matched index nothing is reflected.
        let matched = truth(Smith::Separable, &[0.5, 0.4, 1.0], side);
        let straight = 1.0 / (1.0 + lambda(0.5, 0.4));
        assert!(matched[0].abs() < 1e-9 && (matched[1] - straight).abs() < 1e-8, "{matched:?} {straight}");
        // A surface of Beckmann with the same alpha has less in its tail.
        let ggx =
            GGX_GLASS.at(&variant(Smith::Correlated, side), &[0.3, 0.5, 1.5], 1e-8).expect("in the domain");
        assert!(truth(Smith::Correlated, &[0.3, 0.5, 1.5], side)[3] < ggx[3]);
    }
}

/// What a beam sends through the interface does not depend on its direction: the means over cosines differ by
/// the square of the index.
#[test]
fn transmission_is_reciprocal() {
    const N: usize = 400;
    for smith in Smith::ALL {
        let mu: Vec<f64> = (0..N).map(|i| (i as f64 + 0.5) / N as f64).collect();
        let points =
            points::Points::new([("alpha", vec![0.5; N]), ("mu", mu.clone()), ("ior", vec![1.6; N])]);
        let sides = BECKMANN_GLASS.both_sides(smith, &points, 1e-7).expect("in the domain");
        let mean = |t: &[f64]| 2.0 * t.iter().zip(&mu).map(|(t, mu)| t * mu).sum::<f64>() / N as f64;
        let [outside, inside] = sides.map(|truth| mean(&truth.columns[1]));
        assert!((outside - 1.6 * 1.6 * inside).abs() < 1e-5, "{smith:?}: {outside} {inside}");
    }
}

/// The cosine of a ray refracted straight down may be one rounding above 1.
#[test]
fn the_kernel_of_tables_is_finite_where_nothing_bends() {
    for tolerance in [1e-3, 1e-4, 1e-6] {
        let kernel = Kernel::of(Beckmann, Smith::Correlated, tolerance).expect("a tolerance");
        let iors: Vec<f64> = (0..200).map(|k| 1.0 + f64::exp(-30.0 + 0.15 * f64::from(k))).collect();
        let mut found = vec![Energies::default(); iors.len()];
        for alpha in [4e-4, 1e-3, 0.01, 0.1, 1.0] {
            kernel.energies(alpha, 1.0, &iors, &mut found).expect("in the domain");
            for (ior, e) in iors.iter().zip(&found) {
                let within = e.e().iter().all(|e| (0.3..=1.0 + tolerance).contains(e));
                assert!(within, "{tolerance} {alpha} {ior}: {e:?}");
            }
        }
    }
}

#[test]
fn the_kernel_of_tables_keeps_its_tolerances() {
    for (smith, tolerance) in [(Smith::Correlated, 1e-4), (Smith::Separable, 1e-6)] {
        let kernel = Kernel::of(Beckmann, smith, tolerance).expect("a tolerance");
        let hard = [[0.81, 0.002, 1.37], [0.086, 0.824, 1.75], [0.117, 0.122, 1.0038], [4e-4, 0.3, 1.5]];
        for [alpha, mu, ior] in hard.into_iter().chain(PLACES) {
            let mut found = [Energies::default()];
            kernel.energies(alpha, mu, &[ior], &mut found).expect("in the domain");
            for (k, side) in Side::ALL.into_iter().enumerate() {
                let exact = truth(smith, &[alpha, mu, ior], side);
                let off = (found[0].r[k] - exact[0]).abs().max((found[0].t[k] - exact[1]).abs());
                assert!(off < tolerance, "{smith:?} {tolerance} {alpha} {mu} {ior} {side:?}: {off}");
            }
        }
    }
}
