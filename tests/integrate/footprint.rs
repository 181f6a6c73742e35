//! `parallax-alpha` and its lobes against independent means: adaptive quadrature of densities, a
//! brute search of the best width, and the properties that hold whatever the numbers are.

use lobefit_math::ops::{atan, cos, exp, exp2, log, sin, tan};
use lobefit_truth::optics::kernel::Kernel;
use lobefit_truth::quantity::footprint::{Adjusted, TOLERANCE, adjusted, best, measures};

/// Simpson's rule, halved until it is exact: nothing of the library's rules.
fn simpson(f: &dyn Fn(f64) -> f64, a: f64, b: f64, tolerance: f64) -> f64 {
    fn go(f: &dyn Fn(f64) -> f64, a: f64, b: f64, [fa, fm, fb]: [f64; 3], tolerance: f64, depth: u32) -> f64 {
        let (m, h) = (0.5 * (a + b), b - a);
        let (l, r) = (f(0.5 * (a + m)), f(0.5 * (m + b)));
        let (whole, halves) =
            (h / 6.0 * (fa + 4.0 * fm + fb), h / 12.0 * (fa + 4.0 * l + 2.0 * fm + 4.0 * r + fb));
        if depth == 0 || (halves - whole).abs() < 15.0 * tolerance {
            return halves + (halves - whole) / 15.0;
        }
        go(f, a, m, [fa, l, fm], 0.5 * tolerance, depth - 1)
            + go(f, m, b, [fm, r, fb], 0.5 * tolerance, depth - 1)
    }
    go(f, a, b, [f(a), f(0.5 * (a + b)), f(b)], tolerance, 40)
}

/// GGX's distribution of normals as it is printed (Walter et al. 2007, eq. 33), without its
/// constant.
fn d(alpha: f64, theta: f64) -> f64 {
    let (c, s) = (cos(theta), sin(theta));
    let spread = c * c * alpha * alpha + s * s;
    1.0 / (spread * spread)
}

fn density(kernel: &Kernel, alpha: f64, theta: f64) -> f64 {
    match kernel {
        Kernel::Ndf => d(alpha, theta),
        Kernel::Half => d(alpha, 0.5 * theta),
        Kernel::HalfCosine => d(alpha, 0.5 * theta) * cos(theta).max(0.0),
        other => panic!("{other:?} has no formula"),
    }
}

/// The share of energy within theta, over ln theta so that narrow lobes are as easy as wide ones.
fn encircled(kernel: &Kernel, alpha: f64, theta: f64) -> f64 {
    let whole = |to: f64| {
        let f = |x: f64| density(kernel, alpha, exp(x)) * sin(exp(x)) * exp(x);
        let from = log(alpha) - 14.0;
        let peak = alpha * alpha * density(kernel, alpha, 0.0);
        simpson(&|x| f(x) / peak, from, log(to), 1e-13)
    };
    whole(theta) / whole(std::f64::consts::FRAC_PI_2)
}

#[test]
fn closed_forms_are_the_integrals_of_their_densities() {
    let mut worst = 0.0_f64;
    for kernel in &Kernel::ALL {
        for alpha in [1e-4, 0.01, 0.2, 0.5, 0.70, 0.71, 0.9, 0.999, 1.0] {
            for share in [0.1, 1.0, 10.0] {
                let theta = 2.0 * atan(alpha * share);
                if theta < 1.57 {
                    let off = kernel.lobe(alpha).encircled(tan(theta)) - encircled(kernel, alpha, theta);
                    assert!(off.abs() < 1e-9, "{kernel:?} alpha {alpha}, theta {theta}: {off:e}");
                    worst = worst.max(off.abs());
                }
            }
            let lobe = kernel.lobe(alpha);
            assert_eq!((lobe.encircled(0.0), lobe.encircled(f64::INFINITY)), (0.0, 1.0));
        }
    }
    println!("closed forms of encircled energy: within {worst:.1e} of adaptive quadrature");
}

#[test]
fn slopes_are_the_derivatives_of_encircled_energy() {
    for kernel in &Kernel::ALL {
        for alpha in [0.01, 0.3, 0.8, 1.0] {
            let lobe = kernel.lobe(alpha);
            for t in [0.003, 0.1, 0.7, 3.0, 40.0] {
                let h = 1e-3;
                let off = [2.0, 1.0, -1.0, -2.0].map(|k: f64| lobe.encircled(t * exp(k * h)));
                let difference = (8.0 * (off[1] - off[2]) - (off[0] - off[3])) / (12.0 * h);
                let slope = lobe.slope(t);
                assert!((slope - difference).abs() < 1e-9, "{kernel:?} {alpha} {t}: {slope} {difference}");
            }
        }
    }
}

/// The squared distance of encircled energies by a fine sum that reaches far.
fn distance(kernel: &Kernel, alpha: f64, rho: f64, fetched: f64) -> f64 {
    let (target, fetch) = (kernel.lobe(alpha), kernel.lobe(fetched));
    let from = log(alpha * rho.min(1.0)) - 14.0;
    let to = log(rho.max(1.0)) + 14.0;
    (0..=4000)
        .map(|i| exp(from + (to - from) * f64::from(i) / 4000.0))
        .map(|radius| target.encircled(radius / rho) - fetch.encircled(radius))
        .map(|off| off * off)
        .sum::<f64>()
        * (to - from)
        / 4000.0
}

#[test]
fn no_width_of_a_fine_grid_is_better() {
    for kernel in &Kernel::ALL {
        for (alpha, rho) in
            [(0.01, 0.03), (0.04, 8.0), (0.25, 0.25), (0.25, 2.0), (0.5, 1.4), (0.9, 0.1), (1.0, 0.5)]
        {
            let found = adjusted(kernel, alpha, rho, TOLERANCE).expect("a value");
            let least = distance(kernel, alpha, rho, found.alpha);
            let widths = (0..4000).map(|i| exp(-14.0 * (1.0 - f64::from(i) / 3999.0)));
            let better = widths.map(|width| (width, distance_coarse(kernel, alpha, rho, width)));
            let (width, grid) = better.fold((0.0, f64::INFINITY), |a, b| if b.1 < a.1 { b } else { a });
            assert!(
                least <= grid * (1.0 + 1e-9),
                "{kernel:?} {alpha} {rho}: {found:?}, but {width} has {grid:e}"
            );
            // A minimum: neighbours at a promised error's multiple are not better.
            for factor in [1.0 - 1e-5, 1.0 + 1e-5] {
                let beside = found.alpha * factor;
                assert!(found.saturated || distance(kernel, alpha, rho, beside) >= least, "{alpha} {rho}");
            }
        }
    }
}

/// [`distance`] on a tenth of the radii, for scanning.
fn distance_coarse(kernel: &Kernel, alpha: f64, rho: f64, fetched: f64) -> f64 {
    let (target, fetch) = (kernel.lobe(alpha), kernel.lobe(fetched));
    let from = log(alpha * rho.min(1.0)) - 14.0;
    let to = log(rho.max(1.0)) + 14.0;
    let square = |i: u32| {
        let radius = exp(from + (to - from) * f64::from(i) / 200.0);
        let off = target.encircled(radius / rho) - fetch.encircled(radius);
        off * off
    };
    (0..=200).map(square).sum::<f64>() * (to - from) / 200.0
}

/// (1/2) int |W_t - W_c| over the wall by brute force.
fn variation(kernel: &Kernel, alpha: f64, rho: f64, fetched: f64) -> f64 {
    let (target, fetch) = (kernel.lobe(alpha), kernel.lobe(fetched));
    let from = log(fetched.min(alpha * rho)) - 12.0;
    let to = log(rho.max(1.0)) + 20.0;
    let energies = (0..=200_000).map(|i| {
        let radius = exp(from + (to - from) * f64::from(i) / 200_000.0);
        target.encircled(radius / rho) - fetch.encircled(radius)
    });
    let energies: Vec<f64> = energies.collect();
    0.5 * energies.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum::<f64>()
}

#[test]
fn total_variation_is_that_of_a_brute_sum() {
    for kernel in &Kernel::ALL {
        for (alpha, rho, fetched) in
            [(0.04, 0.25, 0.01), (0.25, 0.25, 0.2), (0.3, 3.0, 1.0), (1.0, 0.1, 0.05)]
        {
            let (tv, brute) = (
                measures(kernel, alpha, rho, fetched).expect("values").tv,
                variation(kernel, alpha, rho, fetched),
            );
            assert!((tv - brute).abs() < 1e-7, "{kernel:?} {alpha} {rho} {fetched}: {tv} {brute}");
        }
    }
}

fn value(alpha: f64, rho: f64) -> Adjusted {
    adjusted(&Kernel::HalfCosine, alpha, rho, TOLERANCE).expect("a value")
}

/// Published best widths of this kernel (three digits of a study by another implementation).
#[test]
fn best_widths_are_those_of_the_study() {
    let rhos = [1.0 / 16.0, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0];
    for (alpha, row) in [
        (0.04, [0.0025, 0.0098, 0.0198, 0.04, 0.0826, 0.179, 0.435]),
        (0.16, [0.0089, 0.0363, 0.0746, 0.16, 0.379, 1.0, 1.0]),
        (0.25, [0.0130, 0.0534, 0.112, 0.25, 0.676, 1.0, 1.0]),
        (0.49, [0.0215, 0.0902, 0.197, 0.49, 1.0, 1.0, 1.0]),
        (1.0, [0.0316, 0.137, 0.317, 1.0, 1.0, 1.0, 1.0]),
    ] {
        for (rho, printed) in rhos.into_iter().zip(row) {
            let found = value(alpha, rho).alpha;
            assert!(
                (found / printed - 1.0).abs() < 0.02,
                "alpha {alpha}, rho {rho}: {found}, printed {printed}"
            );
        }
    }
}

#[test]
fn the_same_distance_changes_nothing_and_more_of_either_widens() {
    for alpha in [1e-6, 1e-3, 0.1, 0.5, 1.0] {
        let same = value(alpha, 1.0);
        assert!(
            (same.alpha / alpha - 1.0).abs() < 1e-7 && same.tv < 1e-7 && !same.saturated,
            "{alpha}: {same:?}"
        );
    }
    let widths = |points: &mut dyn Iterator<Item = (f64, f64)>| -> Vec<f64> {
        points.map(|(a, r)| value(a, r).alpha).collect()
    };
    let by_rho = widths(&mut (0..40).map(|i| (0.3, exp2(-19.5 + 0.53 * f64::from(i)))));
    let by_alpha = widths(&mut (0..40).map(|i| (exp2(-0.49 * f64::from(i)), 0.3)));
    assert!(by_rho.windows(2).all(|w| w[0] < w[1]), "{by_rho:?}");
    assert!(by_alpha.windows(2).all(|w| w[0] > w[1]), "{by_alpha:?}");
}

#[test]
fn ends_of_the_domain_are_finite_and_reach_their_limits() {
    for rho in [1e-6, 1.0, 1e3] {
        assert_eq!(value(0.0, rho), Adjusted { alpha: 0.0, tv: 0.0, saturated: false, error: 0.0 });
        for alpha in [1e-6, 1.0] {
            let found = value(alpha, rho);
            assert!(found.alpha > 0.0 && found.alpha <= 1.0 && (0.0..=1.0).contains(&found.tv), "{found:?}");
            // Narrow lobes from near: nothing but the scale is left.
            if rho * alpha < 1e-5 && alpha < 1e-5 {
                assert!((found.alpha / (rho * alpha) - 1.0).abs() < 1e-3, "{found:?}");
            }
        }
    }
    assert!(value(1.0, 1e3).saturated && !value(1.0, 1.0).saturated && value(1.0, 1.01).saturated);
    for (alpha, rho) in
        [(-0.1, 1.0), (1e-7, 1.0), (1.1, 1.0), (f64::NAN, 1.0), (0.5, 0.0), (0.5, 1e4), (0.5, f64::NAN)]
    {
        assert!(adjusted(&Kernel::HalfCosine, alpha, rho, TOLERANCE).is_err(), "{alpha} {rho}");
    }
}

#[test]
fn the_coarse_rule_for_many_points_is_as_good() {
    let mut worst = 0.0_f64;
    for i in 0..300 {
        let (alpha, rho) = (exp2(-0.05 * f64::from(i)), exp2(-6.0 + 0.03 * f64::from(i)));
        let (fine, (coarse, saturated)) =
            (value(alpha, rho), best(&Kernel::HalfCosine, alpha, rho).expect("a value"));
        assert_eq!(saturated, fine.saturated, "{alpha} {rho}");
        worst = worst.max((coarse / fine.alpha - 1.0).abs());
    }
    assert!(worst < TOLERANCE, "{worst:e}");
    println!("the coarse rule: within {worst:.1e} of the fine one");
}

#[test]
fn quantiles_invert_the_energy_of_a_cone() {
    for kernel in &Kernel::ALL {
        for alpha in [1e-6, 1e-3, 0.04, 0.3, 0.7, 0.999, 1.0, 1.5] {
            let lobe = kernel.lobe(alpha);
            for i in 0..=200 {
                let energy = f64::from(i) / 200.0;
                let u = lobe.quantile(energy);
                assert!((0.0..=1.0).contains(&u), "{kernel:?} {alpha} {energy}: {u}");
                // tan(theta) of tan^2(theta/2)
                let found = lobe.encircled(2.0 * u.sqrt() / (1.0 - u));
                assert!((found - energy).abs() < 1e-12, "{kernel:?} {alpha}: {energy}, {found}");
            }
        }
    }
}

#[test]
fn the_density_per_solid_angle_is_that_of_the_formula() {
    for kernel in &Kernel::ALL {
        for alpha in [0.01, 0.2, 0.8, 1.0] {
            let lobe = kernel.lobe(alpha);
            let at = |theta: f64| {
                let half = tan(0.5 * theta);
                lobe.per_solid_angle(half * half)
            };
            let f = |theta: f64| 2.0 * std::f64::consts::PI * at(theta) * sin(theta);
            let whole = simpson(&f, 0.0, 0.1, 1e-12) + simpson(&f, 0.1, std::f64::consts::FRAC_PI_2, 1e-12);
            assert!((whole - 1.0).abs() < 1e-9, "{kernel:?} {alpha}: {whole}");
            let ratio = |theta: f64| at(theta) / density(kernel, alpha, theta);
            assert!((ratio(0.3) / ratio(1.2) - 1.0).abs() < 1e-9, "{kernel:?} {alpha}");
        }
    }
}
