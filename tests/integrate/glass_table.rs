//! The fast tables of `ggx-glass`: against the truth, by identities and limits, and the same bits
//! however they are computed.
#![allow(
    clippy::disallowed_methods,
    reason = "a test may use the platform's functions: its tolerances allow for them"
)]

use lobefit::data::Smith;
use lobefit_math::gauss::Gauss;
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::integrate::Path;
use lobefit_truth::integrate::glass::table::{Effort, Energies, GlassGrid, Kernel, MU, Tabulated, tabulate};
use lobefit_truth::integrate::glass::{Side, glass};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

const BOTH: [Smith; 2] = [Smith::Correlated, Smith::Separable];
const SIDES: [Side; 2] = [Side::Outside, Side::Inside];

/// The sources' grid: mu, alpha and ior of a column, a row and a slice.
fn mu(column: usize) -> f64 {
    let x = column as f64 / 127.0;
    (x * x).clamp(0.01, 0.9999)
}

fn alphas() -> Vec<f64> {
    (0..128).map(|y| (f64::from(y) / 127.0).clamp(0.01, 1.0)).collect()
}

fn iors() -> Vec<f64> {
    (0..32).map(|z| 1.0 + (f64::from(z) / 31.0).clamp(1e-4, 1.0)).collect()
}

fn sources(smith: Smith, tolerance: f64) -> Result<Tabulated, IntegrateError> {
    let (alphas, iors) = (alphas(), iors());
    let mu = |column: usize, _: f64, _: f64| mu(column);
    tabulate(&GlassGrid { smith, alphas: &alphas, columns: 128, iors: &iors, mu: &mu, tolerance })
}

fn one(kernel: &Kernel, alpha: f64, mu: f64, ior: f64) -> Energies {
    let mut out = [Energies::default()];
    kernel.energies(alpha, mu, &[ior], &mut out).expect("in the domain");
    out[0]
}

/// Texels of the sources' grid: random ones, and those next to the critical angles and in the
/// corners.
fn texels(random: usize) -> Vec<[usize; 3]> {
    let mut source = Pcg64::seed_from_u64(3);
    let mut below = |n: f64| (source.random::<f64>() * n) as usize;
    let mut texels: Vec<[usize; 3]> =
        (0..random).map(|_| [below(128.0), below(128.0), below(32.0)]).collect();
    for (z, ior) in iors().into_iter().enumerate() {
        let critical = (1.0 / ior).asin();
        for (i, angle) in [(1.0 / ior).acos(), critical, (std::f64::consts::FRAC_PI_2 - 2.0 * critical).abs()]
            .into_iter()
            .enumerate()
        {
            let x = (angle.cos().clamp(0.0, 1.0).sqrt() * 127.0).round() as usize;
            texels.push([x, [0, 5, 60, 127][(z + i) % 4], z]);
        }
    }
    for z in [0, 31] {
        texels.extend([[0, 0, z], [127, 0, z], [0, 127, z], [127, 127, z], [13, 1, z], [126, 60, z]]);
    }
    texels
}

#[test]
fn texels_are_the_truth_within_the_tolerance() {
    let (alphas, iors) = (alphas(), iors());
    for (smith, tolerance) in [(Smith::Separable, 1e-6), (Smith::Correlated, 1e-6), (Smith::Separable, 1e-4)]
    {
        let table = sources(smith, tolerance).expect("within the tolerance");
        assert!(table.checked.texels > 2000 && table.checked.worst <= tolerance, "{:?}", table.checked);
        if tolerance == 1e-6 {
            assert!(table.evaluations < 100_000_000, "{} evaluations", table.evaluations);
        }
        for [x, y, z] in texels(40) {
            let at = x + 128 * (y + 128 * z);
            for (side, value) in SIDES.into_iter().zip([table.outside[at], table.inside[at]]) {
                let truth = glass(smith, alphas[y], mu(x), iors[z], side, 1e-8).expect("in the domain");
                let difference = (value - truth.e).abs();
                assert!(
                    difference <= tolerance,
                    "{smith:?} column {x} row {y} slice {z} {side:?}: {value} against {}, {difference:e}",
                    truth.e
                );
            }
        }
    }
}

/// Random points of the whole domain, by the kernel itself, R and T apart; every fifth at the
/// smallest mu.
#[test]
fn the_whole_domain_is_within_the_tolerance() {
    let mut random = Pcg64::seed_from_u64(5);
    for smith in BOTH {
        let kernels: Vec<(f64, Kernel)> = [1e-4, 1e-6, 1e-8]
            .into_iter()
            .map(|tolerance| (tolerance, Kernel::new(smith, tolerance).expect("a tolerance")))
            .collect();
        for i in 0..75 {
            let alpha = 4e-4_f64.powf(random.random());
            let mu = if i % 5 == 0 { MU[0] } else { MU[0].powf(random.random()) };
            let ior = 1.0 + 1e-4 * 2e4_f64.powf(random.random::<f64>());
            let truth = SIDES.map(|side| glass(smith, alpha, mu, ior, side, 1e-8).expect("in the domain"));
            for (tolerance, kernel) in &kernels {
                let value = one(kernel, alpha, mu, ior);
                for side in 0..2 {
                    for difference in [value.r[side] - truth[side].r, value.t[side] - truth[side].t] {
                        assert!(
                            difference.abs() <= *tolerance,
                            "{smith:?} {alpha} {mu} {ior} {:?}: {difference:e} beyond {tolerance:e}",
                            SIDES[side]
                        );
                    }
                }
            }
        }
    }
}

/// 2 int T_in mu dmu = n^-2 2 int T_out mu dmu, for any symmetric G2. Panels end at the critical
/// angles.
#[test]
fn transmission_is_reciprocal_on_average() {
    let rule = Gauss::new(24);
    for smith in BOTH {
        let kernel = Kernel::new(smith, 1e-8).expect("a tolerance");
        for (alpha, ior) in [(0.3, 1.5), (0.7, 1.02), (0.05, 2.0)] {
            let sine: f64 = 1.0 / ior;
            let cosine = (1.0 - sine * sine).sqrt();
            let mut cuts = [1e-3, 0.05, sine, cosine, 0.5 * (1.0 + sine.max(cosine)), 1.0];
            cuts.sort_by(f64::total_cmp);
            let mut averages = [0.0; 2];
            for cut in cuts.windows(2) {
                for (side, average) in averages.iter_mut().enumerate() {
                    // mu = cut[0] + length z^2 (3 - 2 z), graded at both ends
                    let length = cut[1] - cut[0];
                    *average += rule.integrate(0.0, 1.0, |z| {
                        let mu = cut[0] + length * z * z * (3.0 - 2.0 * z);
                        2.0 * mu * one(&kernel, alpha, mu, ior).t[side] * length * 6.0 * z * (1.0 - z)
                    });
                }
            }
            let difference = (averages[1] - averages[0] / (ior * ior)).abs();
            // mu below 1e-3 is left out: at most 1e-6 on either side.
            assert!(difference < 1e-6, "{smith:?} {alpha} {ior}: {averages:?}");
        }
    }
}

/// As ior -> 1 nothing is reflected and the straight light is shadowed: (1 + L)/(1 + 2 L) or
/// 1/(1 + L), and the kernel follows the truth there.
#[test]
fn an_index_of_one_is_the_limit() {
    for smith in BOTH {
        let kernel = Kernel::new(smith, 1e-7).expect("a tolerance");
        for (alpha, mu) in [(0.5_f64, 0.3_f64), (0.02, 0.01), (1.0, 1.0), (4e-4, 1e-3)] {
            let tangent2 = alpha * alpha * (1.0 - mu * mu) / (mu * mu);
            let l = tangent2 / (2.0 * (1.0 + (1.0 + tangent2).sqrt()));
            let limit =
                if smith == Smith::Correlated { (1.0 + l) / (1.0 + 2.0 * l) } else { 1.0 / (1.0 + l) };
            let exact = one(&kernel, alpha, mu, 1.0);
            assert_eq!(exact.r, [0.0; 2]);
            assert!(exact.t.iter().all(|t| (t - limit).abs() < 1e-14), "{exact:?} {limit}");
            for excess in [1e-12, 1e-8, 1e-6] {
                let e = one(&kernel, alpha, mu, 1.0 + excess).e();
                for (side, e) in SIDES.into_iter().zip(e) {
                    let truth = glass(smith, alpha, mu, 1.0 + excess, side, 1e-8).expect("in the domain").e;
                    assert!(
                        (e - truth).abs() < 1e-7,
                        "{smith:?} {alpha} {mu} {excess} {side:?}: {e} {truth}"
                    );
                }
            }
        }
    }
}

/// A grid of which mu moves with alpha and with the index of refraction, columns and rows in no
/// order, and a slice of index 1.
#[test]
fn a_grid_may_move_with_alpha_and_ior() {
    let alphas: Vec<f64> = (0..40).map(|y| 1e-3_f64.powf(f64::from((y * 7) % 40) / 39.0)).collect();
    let iors = [1.3, 1.0, 2.5];
    let mu = |x: usize, alpha: f64, ior: f64| {
        let u = (x as f64 + 0.5) / 12.0;
        let bent = alpha * u * u / (1.0 + alpha - u * u) / ior;
        bent.clamp(1e-3, 1.0)
    };
    for smith in BOTH {
        let grid = GlassGrid { smith, alphas: &alphas, columns: 12, iors: &iors, mu: &mu, tolerance: 1e-5 };
        let table = tabulate(&grid).expect("within the tolerance");
        for (x, y, z) in [(0, 3, 0), (11, 39, 2), (5, 17, 1), (8, 0, 2), (2, 26, 0)] {
            let at = x + 12 * (y + 40 * z);
            let mu = mu(x, alphas[y], iors[z]);
            for (side, value) in SIDES.into_iter().zip([table.outside[at], table.inside[at]]) {
                let truth = glass(smith, alphas[y], mu, iors[z], side, 1e-8).expect("in the domain").e;
                assert!((value - truth).abs() < 1e-5, "{smith:?} {x} {y} {z} {side:?}: {value} {truth}");
            }
        }
    }
}

#[test]
fn the_bits_do_not_depend_on_threads() {
    let (alphas, iors) = ([0.01, 0.02, 0.3, 0.31, 0.5, 0.9], [1.0001, 1.5, 2.0]);
    let mu = |x: usize, _: f64, _: f64| mu(5 * x);
    let grid = GlassGrid {
        smith: Smith::Correlated,
        alphas: &alphas,
        columns: 26,
        iors: &iors,
        mu: &mu,
        tolerance: 1e-5,
    };
    let run = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| tabulate(&grid)).expect("within the tolerance")
    };
    assert_eq!(run(1), run(3));
}

/// AVX-512, AVX2 and the baseline: those that this machine has.
#[test]
fn the_bits_do_not_depend_on_the_instruction_set() {
    let iors = iors();
    for smith in BOTH {
        let kernel = |path| Kernel::new(smith, 1e-6).expect("a tolerance").on(path);
        let (best, others) = (kernel(Path::Best), [kernel(Path::Avx2), kernel(Path::Baseline)]);
        for (alpha, mu) in [(0.01, 0.01), (0.01, 0.9999), (0.2, 0.5), (1.0, 0.01), (1.0, 0.9), (4e-4, 1e-3)] {
            let values = |kernel: &Kernel| {
                let mut out = vec![Energies::default(); iors.len()];
                let evaluations = kernel.energies(alpha, mu, &iors, &mut out).expect("in the domain");
                let bits =
                    out.iter().flat_map(|e| [e.r, e.t]).flatten().map(f64::to_bits).collect::<Vec<_>>();
                (bits, evaluations)
            };
            let expected = values(&best);
            for other in &others {
                assert!(values(other) == expected, "{smith:?} {alpha} {mu}: {other:?} differs");
            }
        }
    }
}

/// What eight lanes or the rules would cut off is refused.
#[test]
fn efforts_that_would_lose_nodes_are_refused_by_name() {
    let kernel = || Kernel::new(Smith::Correlated, 1e-4).expect("a tolerance");
    let known = kernel().effort();
    let same = kernel().with(known).expect("a tier");
    assert_eq!(one(&same, 0.3, 0.4, 1.5), one(&kernel(), 0.3, 0.4, 1.5));
    for (effort, name) in [
        (Effort { ring_panel: 20, ..known }, "ring_panel"),
        (Effort { ring_panel: 104, ..known }, "ring_panel"),
        (Effort { near: 0, ..known }, "near"),
        (Effort { near: 4, ..known }, "near"),
        (Effort { panel: 97, ..known }, "panel"),
        (Effort { ring: 0, ..known }, "ring"),
        (Effort { longest: f64::NAN, ..known }, "longest"),
        (Effort { longest: 0.0, ..known }, "longest"),
        (Effort { azimuth: [f64::NAN, 1.0], ..known }, "azimuth"),
        (Effort { azimuth: [5.0, -1.0], ..known }, "azimuth"),
    ] {
        let error = kernel().with(effort).expect_err("refused");
        assert!(matches!(error, IntegrateError::Option { option, .. } if option == name), "{error}");
    }
}

#[test]
fn inputs_outside_the_domain_are_refused_by_name() {
    let kernel = Kernel::new(Smith::Correlated, 1e-5).expect("a tolerance");
    for (alpha, mu, ior, name) in [
        (0.0, 0.5, 1.5, "alpha"),
        (f64::NAN, 0.5, 1.5, "alpha"),
        (0.5, 0.0, 1.5, "mu"),
        (0.5, MU[0] * (1.0 - 1e-12), 1.5, "mu"),
        (0.5, f64::NAN, 1.5, "mu"),
        (0.5, 0.5, 0.9, "ior"),
        (0.5, 0.5, f64::NAN, "ior"),
    ] {
        let error =
            kernel.energies(alpha, mu, &[1.2, ior], &mut [Energies::default(); 2]).expect_err("refused");
        assert!(matches!(error, IntegrateError::Domain { input, .. } if input == name), "{error}");
    }
    for tolerance in [1e-9, 0.5, f64::NAN, -1.0] {
        let error = Kernel::new(Smith::Separable, tolerance).expect_err("refused");
        assert!(error.to_string().contains("tolerance"), "{error}");
    }
    let mu = |_: usize, _: f64, _: f64| 0.5;
    let grid = |alphas| GlassGrid {
        smith: Smith::Separable,
        alphas,
        columns: 2,
        iors: &[1.5],
        mu: &mu,
        tolerance: 1e-4,
    };
    assert!(tabulate(&grid(&[0.1, f64::NAN, 0.3])).is_err());
    assert!(tabulate(&grid(&[])).expect("an empty table").outside.is_empty());
}
