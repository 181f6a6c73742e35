//! Kernels given as tables against the lobes that were tabulated: energies in closed form, best
//! widths by a brute search of them.

use std::f64::consts::PI;

use lobefit_math::ops::{atan, cos, exp, log, pow, tan};
use lobefit_truth::optics::kernel::{Kernel, TableLobe, tabulated};
use lobefit_truth::quantity::footprint::{TOLERANCE, adjusted, best, measures, quick_error, usual_tolerance};

/// A lobe that is none of GGX's, and vanishes at the horizon but at alpha 1: cos^n(theta), n = 1/(2
/// A) - 1/2. Its energy is 1 - cos^(n+1).
fn power(alpha: f64) -> f64 {
    0.5 / (alpha * alpha) - 0.5
}

fn within_power(alpha: f64, t: f64) -> f64 {
    1.0 - pow(1.0 / (1.0 + t * t), 0.5 * (power(alpha) + 1.0))
}

/// Angles of even share of the energy of GGX's lobe, which crowd where lobes are.
fn angles(alpha: f64, count: usize) -> Vec<f64> {
    let a2 = alpha * alpha;
    let at = |i: usize| {
        // even in the square root of what is left: more of them in the tail
        let rest = 1.0 - i as f64 / (count - 1) as f64;
        let x = 1.0 - rest * rest;
        2.0 * atan((a2 * x / (1.0 + a2 - x)).sqrt())
    };
    (0..count).map(at).collect()
}

fn table(name: &str, widths: &[f64], count: usize, density: impl Fn(f64, f64) -> f64) -> Kernel {
    let lobe = |&alpha: &f64| {
        let theta = angles(alpha, count);
        let density = theta.iter().map(|theta| 7.5 * density(alpha, *theta)).collect();
        TableLobe { alpha, theta, density }
    };
    let lobes: Vec<TableLobe> = widths.iter().map(lobe).collect();
    tabulated(name, &lobes).unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// Widths of roughness 0.1 to 1.
fn widths(count: usize) -> Vec<f64> {
    let at = |i: usize| 0.1 + 0.9 * i as f64 / (count - 1) as f64;
    (0..count).map(|i| at(i) * at(i)).collect()
}

fn phong(widths: &[f64], count: usize) -> Kernel {
    table("phong", widths, count, |alpha, theta| pow(cos(theta).max(0.0), power(alpha)))
}

fn ggx(alpha: f64, theta: f64) -> f64 {
    let half = tan(0.5 * theta);
    pow((1.0 + half * half) / (alpha * alpha + half * half), 2.0)
}

/// The lobe that the table's coordinate is made of comes back whole, at any width.
#[test]
fn a_table_of_the_half_angle_lobe_is_exact_at_any_width() {
    // D(theta/2) in terms of u: 1/(A cos^2 + sin^2)^2, as ggx() is
    let given = table("half-again", &[0.04, 0.3, 1.0], 33, ggx);
    for alpha in [1e-3, 0.04, 0.1, 0.55, 1.0, 1.3] {
        for k in 0..60 {
            let t = alpha * exp(0.2 * f64::from(k) - 6.0);
            let [table, formula] = [given.clone(), Kernel::Half].map(|kernel| kernel.lobe(alpha));
            let off = [table.encircled(t) - formula.encircled(t), table.slope(t) - formula.slope(t)];
            assert!(off.iter().all(|x| x.abs() < 1e-13), "alpha {alpha}, tangent {t}: {off:?}");
        }
    }
}

/// Another lobe, at its widths and between them: the error of a table falls as one of its angles
/// and of its widths does.
#[test]
fn energies_of_a_table_converge_to_those_of_its_lobe() {
    let worst = |kernel: Kernel, alphas: &[f64]| {
        let mut worst = 0.0_f64;
        for &alpha in alphas {
            for k in 0..80 {
                let t = alpha * exp(0.1 * f64::from(k) - 4.0);
                worst = worst.max((kernel.lobe(alpha).encircled(t) - within_power(alpha, t)).abs());
            }
        }
        worst
    };
    let at_widths: Vec<f64> = [17, 33, 65].map(|count| worst(phong(&widths(9), count), &widths(9))).into();
    println!("energies of a tabulated cos^n at its widths, 17, 33 and 65 angles: within {at_widths:?}");
    assert!(
        at_widths[2] < 1e-5 && at_widths[2] < 0.25 * at_widths[1] && at_widths[1] < 0.2 * at_widths[0],
        "{at_widths:?}"
    );
    let between: Vec<f64> = widths(64).into_iter().filter(|alpha| *alpha > 0.0101).collect();
    let off: Vec<f64> = [5, 9, 17].map(|count| worst(phong(&widths(count), 65), &between)).into();
    println!("between 5, 9 and 17 widths: within {off:?}");
    assert!(off[2] < 1e-3 && off[2] < 0.4 * off[1] && off[1] < 0.5 * off[0], "{off:?}");
}

/// The best width of a tabulated half-cosine lobe is the formula's; of cos^n that of a brute search
/// over its energies in closed form.
#[test]
fn best_widths_of_a_table_are_those_of_its_lobe() {
    let cosine =
        table("cosine-again", &widths(17), 129, |alpha, theta| ggx(alpha, theta) * cos(theta).max(0.0));
    let (mut worst, mut variation) = (0.0_f64, 0.0_f64);
    for alpha in widths(7) {
        for rho in [0.3, 0.7, 1.0, 1.8, 6.0] {
            let found = adjusted(&cosine, alpha, rho, 1e-6).unwrap_or_else(|e| panic!("{e}"));
            let formula =
                adjusted(&Kernel::HalfCosine, alpha, rho, TOLERANCE).unwrap_or_else(|e| panic!("{e}"));
            if found.alpha > 0.01 {
                worst = worst.max((found.alpha / formula.alpha - 1.0).abs());
                variation = variation.max((found.tv - formula.tv).abs());
            }
            assert_eq!(found.saturated, formula.saturated, "alpha {alpha}, rho {rho}");
        }
    }
    println!(
        "best width of a tabulated half-cosine lobe: within {worst:.1e} of itself, total variation {variation:.1e}"
    );
    assert!(worst < 3e-3 && variation < 1e-3);

    let lobes = phong(&widths(33), 129);
    for (alpha, rho) in [(0.04, 0.6), (0.25, 0.4), (0.25, 1.7), (0.5, 0.8)] {
        let found = adjusted(&lobes, alpha, rho, 1e-6).unwrap_or_else(|e| panic!("{e}"));
        let brute = brute(alpha, rho);
        assert!(
            (found.alpha / brute - 1.0).abs() < 3e-3,
            "alpha {alpha}, rho {rho}: {} {brute}",
            found.alpha
        );
    }
}

/// The width of least squared distance over ln R, by trying widths 0.1 % apart on a rule of its
/// own.
fn brute(alpha: f64, rho: f64) -> f64 {
    // The energy without within_power's power of each radius, which no width changes.
    let at = |k: i32| {
        let radius = exp(0.02 * f64::from(k));
        (within_power(alpha, radius / rho), -log(1.0 + radius * radius))
    };
    let rule: Vec<(f64, f64)> = (-700..700).map(at).collect();
    let distance = |width: f64| {
        let half = 0.5 * (power(width) + 1.0);
        rule.iter().map(|(target, log)| target - (1.0 - exp(half * log))).map(|d| d * d).sum::<f64>()
    };
    let widths = (0..4000).map(|k| alpha * rho * exp(0.001 * f64::from(k - 2000))).filter(|w| *w < 1.0);
    widths.min_by(|a, b| distance(*a).total_cmp(&distance(*b))).unwrap_or(1.0)
}

/// A Gaussian that is cut at 1.5 alpha, and a cone: their densities end with a jump.
fn cut(name: &str, flat: bool) -> Kernel {
    let lobe = |alpha: f64| {
        let theta: Vec<f64> = (0..40).map(|i| 1.5 * alpha * f64::from(i) / 39.0).collect();
        let of = |t: &f64| if flat { 1.0 } else { exp(-t * t / (alpha * alpha)) };
        let density = theta.iter().map(of).collect();
        TableLobe { alpha, theta, density }
    };
    tabulated(name, &[0.04, 0.2, 1.0].map(lobe)).unwrap_or_else(|e| panic!("{e}"))
}

/// What is promised holds: the error stated bounds the distance to a rule of much finer steps, and
/// that of `best` is what is said of it.
#[test]
fn errors_of_a_table_are_bounds() {
    let coarse = phong(&widths(5), 12);
    for (name, kernel, fine) in [
        ("coarse", coarse.clone(), 1e-5),
        ("cut", cut("cut", false), 1e-3),
        ("cone", cut("cone", true), 1e-3),
    ] {
        let mut worst = 0.0_f64;
        for alpha in widths(7) {
            for rho in [0.2, 0.3, 0.9, 1.4] {
                let [loose, tight] = [10.0 * fine, fine].map(|t| adjusted(&kernel, alpha, rho, t));
                let (loose, tight) =
                    (loose.unwrap_or_else(|e| panic!("{e}")), tight.unwrap_or_else(|e| panic!("{e}")));
                assert!(loose.error <= 10.0 * fine && tight.error <= fine);
                let apart = (loose.alpha / tight.alpha - 1.0).abs();
                assert!(
                    apart <= loose.error + tight.error,
                    "{name}, alpha {alpha}, rho {rho}: {loose:?} {tight:?}"
                );
                let quick = best(&kernel, alpha, rho).unwrap_or_else(|e| panic!("{e}")).0;
                worst = worst.max((quick / tight.alpha - 1.0).abs());
            }
        }
        println!("best widths of a {name} table by the quick rule: within {worst:.1e}");
        assert!(worst < quick_error(&kernel), "{name}: {worst}");
    }
    assert!(!coarse.is_cut() && cut("cone", true).is_cut());
    assert_eq!([coarse, cut("cut", false)].map(|kernel| usual_tolerance(&kernel)), [1e-4, 1e-3]);
}

/// The total variation of lobes with noise from angle to angle is that of a sum of steps much finer
/// than the noise.
#[test]
fn noise_of_a_table_is_seen_in_the_total_variation() {
    let noisy = table("noisy", &widths(6), 400, |alpha, theta| {
        let noise = lobefit_math::ops::sin(1e5 * theta / alpha + 7.0 * alpha);
        ggx(alpha, theta) * cos(theta).max(0.0) * (1.0 + 0.02 * noise)
    });
    for (alpha, rho, fetched) in [(0.2, 0.5, 0.11), (0.2, 1.05, 0.21), (0.7, 0.9, 0.6)] {
        let found = measures(&noisy, alpha, rho, fetched).unwrap_or_else(|e| panic!("{e}")).tv;
        let (target, fetch) = (noisy.lobe(alpha), noisy.lobe(fetched));
        let off = |k: i32| {
            let radius = exp(5e-4 * f64::from(k));
            target.encircled(radius / rho) - fetch.encircled(radius)
        };
        let sum: f64 = (-30_000..20_000).map(|k| (off(k + 1) - off(k)).abs()).sum();
        assert!(
            (found / (0.5 * sum) - 1.0).abs() < 0.03,
            "alpha {alpha}, rho {rho}: {found} against {}",
            0.5 * sum
        );
    }
}

#[test]
fn quantiles_and_densities_belong_to_the_energies() {
    // of the last angle, 1.2, beyond which there is nothing
    let short = |alpha: f64| {
        let theta: Vec<f64> = (0..40).map(|i| 1.2 * f64::from(i) / 39.0).collect();
        let density = theta.iter().map(|theta| exp(-theta * theta / (alpha * alpha))).collect();
        TableLobe { alpha, theta, density }
    };
    let kernel = tabulated("short", &[short(0.3), short(1.0)]).unwrap_or_else(|e| panic!("{e}"));
    for alpha in [0.1, 0.3, 0.7, 1.0] {
        let lobe = kernel.lobe(alpha);
        assert_eq!((lobe.encircled(0.0), lobe.encircled(f64::INFINITY)), (0.0, 1.0));
        let mut last = 0.0;
        for i in 1..=100 {
            let energy = f64::from(i) / 101.0;
            let u = lobe.quantile(energy);
            assert!(u > last, "alpha {alpha}: quantiles rise");
            let t = tan(2.0 * atan(u.sqrt()));
            assert!((lobe.encircled(t) - energy).abs() < 1e-10, "alpha {alpha}, energy {energy}");
            last = u;
        }
        let count = 200_000;
        let h = 1.0 / f64::from(count);
        let ring = |i: i32| {
            let u = h * (f64::from(i) + 0.5);
            lobe.per_solid_angle(u) * 4.0 * PI / ((1.0 + u) * (1.0 + u)) * h
        };
        let whole: f64 = (0..count).map(ring).sum();
        assert!((whole - 1.0).abs() < 1e-5, "alpha {alpha}: {whole}");
        let last = pow(tan(0.6), 2.0);
        if alpha >= 0.3 {
            assert_eq!(kernel.lobe(1.0).per_solid_angle(last + 1e-6), 0.0);
        }
    }
}

#[test]
fn every_measure_of_a_table_is_finite_at_the_ends() {
    let lobes = phong(&widths(9), 33);
    for alpha in [1e-6, 1e-3, 0.5, 1.0] {
        for rho in [1e-5, 1e-2, 1.0, 1e3] {
            let (width, _) = best(&lobes, alpha, rho).unwrap_or_else(|e| panic!("{e}"));
            assert!(width > 0.0 && width <= 1.0, "alpha {alpha}, rho {rho}: {width}");
            let found = measures(&lobes, alpha, rho, width).unwrap_or_else(|e| panic!("{e}"));
            let all = [found.tv, found.l2, found.max, found.encircled];
            assert!(all.iter().all(|x| x.is_finite() && *x >= 0.0), "alpha {alpha}, rho {rho}: {found:?}");
            if rho == 1.0 {
                assert!(
                    (width / alpha - 1.0).abs() < 1e-4 && found.tv < 1e-4,
                    "alpha {alpha}: {width} {found:?}"
                );
            }
        }
    }
}

/// Equal tables are one kernel whoever gives them; any other is another.
#[test]
fn kernels_are_known_by_what_they_hold() {
    let [a, b] = [0, 1].map(|_| phong(&widths(5), 16));
    assert_eq!(a, b);
    let other = phong(&widths(5), 17);
    assert_ne!(a, other);
    assert_eq!(a.name(), other.name());
    assert_ne!(a.word(), other.word());
    for kernel in Kernel::ALL {
        assert_eq!(Kernel::of(kernel.word()), Some(kernel));
    }
    assert_eq!(Kernel::of(a.word()), None);
    assert!(log(a.lobe(0.5).encircled(0.2)).is_finite());
}
