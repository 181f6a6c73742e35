//! The anisotropic and the glass lobe: limits, symmetries, identities, an independent Monte Carlo,
//! and their error bounds.
#![allow(
    clippy::disallowed_methods,
    reason = "a test may use the platform's functions: its tolerances allow for them"
)]

use lobefit::data::Smith;
use lobefit_math::gauss::Gauss;
use lobefit_truth::integrate::aniso::{self, aniso};
use lobefit_truth::integrate::glass::{self, Side, glass};
use lobefit_truth::integrate::monte_carlo::{self, Sampled, sobol};
use lobefit_truth::integrate::reflection::reflection;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

const BOTH: [Smith; 2] = [Smith::Correlated, Smith::Separable];
const SIDES: [Side; 2] = [Side::Outside, Side::Inside];

fn score(sampled: Sampled, truth: f64) -> f64 {
    (sampled.value - truth) / sampled.standard_error
}

/// None beyond 5.5 standard errors, and their mean square that of a normal variable.
fn assert_scores(scores: &[f64]) {
    let mean_square = scores.iter().map(|z| z * z).sum::<f64>() / scores.len() as f64;
    assert!(scores.iter().all(|z| z.abs() < 5.5), "{scores:?}");
    assert!((0.25..2.0).contains(&mean_square), "mean square of z {mean_square}");
}

/// A random point of the promised domain.
fn anisotropic_point(index: u64) -> ([f64; 2], f64, f64) {
    let mut random = Pcg64::seed_from_u64(index);
    let alpha_x = 1e-3 * 3e3_f64.powf(random.random());
    let ratio = 100_f64.powf(2.0 * random.random::<f64>() - 1.0);
    let mu = 1e-3_f64.powf(random.random());
    let phi = 7.0 * random.random::<f64>();
    ([alpha_x, (alpha_x * ratio).clamp(1e-3, 3.0)], mu, phi)
}

fn glass_point(index: u64) -> (f64, f64, f64, Side) {
    let mut random = Pcg64::seed_from_u64(index);
    let alpha = 1e-3_f64.powf(random.random());
    let mu = 1e-3_f64.powf(random.random());
    let ior = 1.0 + 1e-4 * 2e4_f64.powf(random.random::<f64>());
    (alpha, mu, ior, SIDES[(index % 2) as usize])
}

#[test]
fn equal_alphas_are_the_isotropic_lobe() {
    for smith in BOTH {
        for (alpha, mu) in [(1e-3, 1e-3), (1e-3, 1.0), (0.01, 0.02), (0.3, 0.5), (1.0, 0.001), (1.0, 0.7)] {
            let exact = reflection(smith, alpha, mu, 1e-10).expect("in the domain");
            for phi in [Some(0.0), Some(0.4), Some(-2.0), None] {
                let value = aniso(smith, [alpha; 2], mu, phi, aniso::TOLERANCE).expect("in the domain");
                assert!((value.e - exact.e).abs() < 1e-12, "{smith:?} {alpha} {mu} {phi:?}: {value:?}");
                assert!(
                    (value.loss / exact.loss - 1.0).abs() < 1e-9,
                    "{smith:?} {alpha} {mu} {phi:?}: {value:?}"
                );
            }
        }
    }
}

#[test]
fn anisotropy_is_symmetric_and_closes() {
    for smith in BOTH {
        for index in 0..30 {
            let (alpha, mu, phi) = anisotropic_point(index);
            let at = |alpha, phi| aniso(smith, alpha, mu, Some(phi), aniso::TOLERANCE).expect("the promise");
            let value = at(alpha, phi);
            let gap = (value.e + value.loss - 1.0).abs();
            assert!(
                gap < 1e-10 && gap <= 2.0 * value.error,
                "{smith:?} {alpha:?} {mu} {phi}: {gap:e} {value:?}"
            );
            let turned = at([alpha[1], alpha[0]], phi + 0.5 * std::f64::consts::PI);
            assert!(
                (turned.e - value.e).abs() < 2e-9,
                "swapping the axes is a quarter turn: {value:?} {turned:?}"
            );
            assert!((at(alpha, -phi).e - value.e).abs() < 2e-9 && value.loss_error < 1e-6, "{value:?}");
        }
    }
}

/// The mean over the azimuth against a plain rule over many azimuths.
#[test]
fn the_mean_over_the_azimuth_is_that() {
    for (alpha, mu) in [([1.0, 0.1], 0.1), ([0.1, 0.05], 0.3), ([0.3, 0.02], 0.05)] {
        let mean = aniso(Smith::Correlated, alpha, mu, None, aniso::TOLERANCE).expect("in the domain");
        let count = 300;
        let sum: f64 = (0..count)
            .into_par_iter()
            .map(|i| {
                let phi = 0.5 * std::f64::consts::PI * (f64::from(i) + 0.5) / f64::from(count);
                aniso(Smith::Correlated, alpha, mu, Some(phi), 1e-6).expect("in the domain").e
            })
            .collect::<Vec<f64>>()
            .iter()
            .sum();
        assert!(
            (mean.e - sum / f64::from(count)).abs() < 1e-7,
            "{alpha:?} {mu}: {mean:?} {}",
            sum / f64::from(count)
        );
    }
}

#[test]
fn monte_carlo_agrees_with_the_anisotropic_lobe() {
    for smith in BOTH {
        let scores: Vec<f64> = (0..24_u64)
            .flat_map(|index| {
                let (alpha, mu, phi) = anisotropic_point(1000 + index);
                let phi = (index % 3 != 0).then_some(phi);
                let alpha = alpha.map(|a| a.max(0.01));
                let [e, loss] =
                    monte_carlo::aniso(smith, alpha, mu, phi, sobol(1 << 16, index)).expect("in the domain");
                let truth = aniso(smith, alpha, mu, phi, 1e-7).expect("in the domain");
                [score(e, truth.e), score(loss, truth.loss)]
            })
            .collect();
        assert_scores(&scores);
    }
}

#[test]
fn monte_carlo_agrees_with_glass() {
    for smith in BOTH {
        let scores: Vec<f64> = (0..40_u64)
            .flat_map(|index| {
                let (alpha, mu, ior, side) = glass_point(index);
                let alpha = alpha.max(0.01);
                let run = sobol(1 << 16, index);
                let [r, t, loss] =
                    monte_carlo::glass(smith, alpha, mu, ior, side, run).expect("in the domain");
                let truth = glass(smith, alpha, mu, ior, side, glass::TOLERANCE).expect("in the domain");
                [score(r, truth.r), score(t, truth.t), score(loss, truth.loss)]
            })
            .collect();
        assert_scores(&scores);
    }
}

/// ior = 1 lets everything that is not masked straight through, R = 0: T = G2/G1.
#[test]
fn glass_of_index_one_is_a_masked_nothing() {
    for (alpha, mu) in [(1.0_f64, 0.2), (0.3, 0.7), (0.01, 0.05), (1.0, 1.0)] {
        let tan2 = alpha * alpha * (1.0 - mu * mu) / (mu * mu);
        let lambda = 0.5 * ((1.0 + tan2).sqrt() - 1.0);
        for side in SIDES {
            let correlated = glass(Smith::Correlated, alpha, mu, 1.0, side, 1e-10).expect("in the domain");
            let exact = (1.0 + lambda) / (1.0 + 2.0 * lambda);
            assert!(
                correlated.r == 0.0 && (correlated.t - exact).abs() < 1e-12,
                "{alpha} {mu}: {correlated:?}"
            );
            let separable = glass(Smith::Separable, alpha, mu, 1.0, side, 1e-10).expect("in the domain");
            assert!((separable.t - 1.0 / (1.0 + lambda)).abs() < 1e-12, "{alpha} {mu}: {separable:?}");
            // and the next indices continue it
            let near = glass(Smith::Correlated, alpha, mu, 1.000_001, side, 1e-10).expect("in the domain");
            assert!((near.e - correlated.e).abs() < 1e-3, "{alpha} {mu}: {near:?}");
        }
    }
}

/// alpha = 0 is the smooth interface, and a nearly smooth one continues it.
#[test]
fn smooth_glass_is_fresnel() {
    for side in SIDES {
        for mu in [0.2, 0.5, 0.9, 1.0] {
            let smooth = glass(Smith::Correlated, 0.0, mu, 1.5, side, 1e-10).expect("alpha = 0");
            assert!((smooth.r + smooth.t - 1.0).abs() < 1e-15 && smooth.loss == 0.0);
            let near = glass(Smith::Correlated, 1e-4, mu, 1.5, side, 1e-8).expect("alpha = 1e-4");
            assert!((near.r - smooth.r).abs() < 1e-5, "{side:?} {mu}: {near:?} {smooth:?}");
        }
        let normal = glass(Smith::Correlated, 0.0, 1.0, 1.5, side, 1e-10).expect("alpha = 0");
        assert!((normal.r - 0.04).abs() < 1e-15);
    }
}

/// Reciprocity of the transmission lobe: 2 int T_in mu dmu = n^-2 2 int T_out mu dmu.
#[test]
fn transmission_is_reciprocal() {
    let rule = Gauss::new(20);
    let [correlated, separable] = BOTH;
    for (smith, cases) in [(correlated, &[(1.02_f64, 0.3), (2.0, 0.5)][..]), (separable, &[(1.5, 1.0)])] {
        for &(ior, alpha) in cases {
            let critical = (1.0 - 1.0 / (ior * ior)).sqrt();
            let turn = (1.0 / ior).max(critical);
            let mean = |side| {
                let mut cuts = vec![1e-6, 1e-4, 1e-3, 1e-2, 0.05];
                // The singular cosines, approached from both sides.
                for at in [critical, 1.0 / ior, turn, (2.0 * critical * critical - 1.0).abs()] {
                    for step in [0.2, 0.05, 0.01, 0.002, 4e-4, 0.0] {
                        cuts.extend([at - step, at + step]);
                    }
                }
                cuts.retain(|c| (1e-6..1.0).contains(c));
                cuts.push(1.0);
                cuts.sort_by(f64::total_cmp);
                let pairs: Vec<[f64; 2]> =
                    cuts.windows(2).map(|w| [w[0], w[1]]).filter(|w| w[1] - w[0] > 1e-12).collect();
                let parts: Vec<f64> = pairs
                    .par_iter()
                    .map(|w| {
                        rule.integrate(w[0], w[1], |mu| {
                            2.0 * mu * glass(smith, alpha, mu, ior, side, 1e-7).expect("in").t
                        })
                    })
                    .collect();
                parts.iter().sum::<f64>()
            };
            let (inside, outside) = (mean(Side::Inside), mean(Side::Outside));
            let gap = inside - outside / (ior * ior);
            assert!(gap.abs() < 2e-9, "{smith:?} {ior} {alpha}: {gap:e}");
        }
    }
}

/// Points that a search for broken bounds found: at each, the pair of rules differs by less than its
/// finer rule errs by the square law.
#[test]
fn error_columns_are_bounds_where_two_rules_err_alike() {
    for (alpha, mu, phi) in [
        (
            [2.305_541_204_704_004_3, 0.496_963_600_593_302_86],
            0.011_089_568_027_419_76,
            0.372_186_502_603_526,
        ),
        (
            [2.932_071_738_077_47, 0.300_505_862_079_207_26],
            0.004_313_587_774_673_272,
            0.533_003_798_336_989_1,
        ),
        ([0.176_420_282_389_214_3, 3.151_913_726_009_204], 0.003_209_052_467_673_675, 0.280_927_634_693_738),
    ] {
        let value = aniso(Smith::Separable, alpha, mu, Some(phi), aniso::TOLERANCE).expect("the promise");
        let finer = aniso::with_nodes(Smith::Separable, alpha, mu, phi, 48).expect("in the domain");
        let error = (value.e - finer.e).abs().max((value.loss - finer.loss).abs());
        assert!(error <= value.error, "{alpha:?} {mu} {phi}: {error:e} {:e}", value.error);
    }
    for (alpha, mu, ior) in [
        (0.024_202_153_117_226_267, 0.827_996_636_339_067_8, 2.306_667_986_900_82),
        (0.018_352_324_462_158_297, 0.856_030_502_459_525_1, 3.343_371_223_446_271),
    ] {
        let value =
            glass(Smith::Correlated, alpha, mu, ior, Side::Inside, glass::TOLERANCE).expect("promise");
        let finer = glass::with_nodes(Smith::Correlated, alpha, mu, ior, Side::Inside, 48).expect("in");
        let error = (value.r - finer.r).abs().max((value.loss - finer.loss).abs());
        assert!(error <= value.error, "{alpha} {mu} {ior}: {error:e} {:e}", value.error);
    }
}

#[test]
fn error_columns_are_bounds() {
    for smith in BOTH {
        let above: usize = (0..150_u64)
            .into_par_iter()
            .map(|index| {
                let (alpha, mu, ior, side) = glass_point(5000 + index);
                let value = glass(smith, alpha, mu, ior, side, glass::TOLERANCE).expect("the promise");
                assert!(value.error <= glass::TOLERANCE && (value.e + value.loss - 1.0).abs() < 1e-12);
                let finer = glass::with_nodes(smith, alpha, mu, ior, side, 48).expect("in the domain");
                let error = (value.r - finer.r)
                    .abs()
                    .max((value.t - finer.t).abs())
                    .max((value.loss - finer.loss).abs());
                if error > value.error {
                    println!("glass {alpha} {mu} {ior} {side:?} {error:e} {:e}", value.error);
                }
                usize::from(error > value.error)
            })
            .sum();
        assert_eq!(above, 0, "{smith:?}: glass above its bound");
        let above: usize = (0..150_u64)
            .into_par_iter()
            .map(|index| {
                let (alpha, mu, phi) = anisotropic_point(9000 + index);
                let value = aniso(smith, alpha, mu, Some(phi), aniso::TOLERANCE).expect("the promise");
                let finer = aniso::with_nodes(smith, alpha, mu, phi, 48).expect("in the domain");
                let error = (value.e - finer.e).abs().max((value.loss - finer.loss).abs());
                if error > value.error {
                    println!("aniso {alpha:?} {mu} {phi} {error:e} {:e}", value.error);
                }
                usize::from(error > value.error)
            })
            .sum();
        assert_eq!(above, 0, "{smith:?}: anisotropic above its bound");
    }
}
