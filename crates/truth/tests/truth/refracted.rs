//! The width of the refracted lobe against facets drawn one by one, its limits, the second opinion,
//! and what `error` says.
#![allow(clippy::disallowed_methods)]

use lobefit_truth::integrate::monte_carlo::sobol;
use lobefit_truth::optics::Smith;
use lobefit_truth::points::Points;
use lobefit_truth::quantity::{Quantity, RefractedWidth};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

type Vector = [f64; 3];

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn at(smith: Smith, x: [f64; 3], tolerance: f64) -> [f64; 3] {
    let v = RefractedWidth.at(&smith.into(), &x, tolerance).unwrap_or_else(|e| panic!("{e}"));
    [v[0], v[1], v[2]]
}

/// Snell's law about a normal that faces the view.
fn refracted(view: Vector, normal: Vector, ior: f64) -> Vector {
    let cosine = dot(view, normal);
    let inside = (1.0 - (1.0 - cosine * cosine) / (ior * ior)).sqrt();
    [0, 1, 2].map(|i| (cosine / ior - inside) * normal[i] - view[i] / ior)
}

/// The share of the transmitted energy within `radius` of the refraction at the mean normal, with its
/// standard error: facets of D cos, of which each counts by what Smith's masking and shadowing leave of
/// it (Walter et al. 2007, eq. 41: weights, not visible normals).
fn share(smith: Smith, [alpha, mu, ior]: [f64; 3], radius: f64, seed: u64) -> [f64; 2] {
    const FACETS: usize = 1 << 17;
    let view = [(1.0 - mu * mu).sqrt(), 0.0, mu];
    let axis = refracted(view, [0.0, 0.0, 1.0], ior);
    let lambda = |z: f64| 0.5 * ((1.0 + alpha * alpha * (1.0 - z * z) / (z * z)).sqrt() - 1.0);
    let mut random = Pcg64::seed_from_u64(seed);
    let (mut all, mut within, mut squares) = (0.0, 0.0, [0.0; 3]);
    for _ in 0..FACETS {
        let (u, turn): (f64, f64) = (random.random(), std::f64::consts::TAU * random.random::<f64>());
        let z = 1.0 / (1.0 + alpha * alpha * u / (1.0 - u)).sqrt();
        let flat = (1.0 - z * z).sqrt();
        let facet = [flat * turn.cos(), flat * turn.sin(), z];
        let cosine = dot(view, facet);
        if cosine <= 0.0 {
            continue;
        }
        let light = refracted(view, facet, ior);
        if light[2] >= 0.0 {
            continue;
        }
        let inside = -dot(light, facet);
        let (s, p) = (
            (cosine - ior * inside) / (cosine + ior * inside),
            (ior * cosine - inside) / (ior * cosine + inside),
        );
        let (of_view, of_light) = (lambda(mu), lambda(-light[2]));
        let seen = match smith {
            Smith::Correlated => 1.0 / (1.0 + of_view + of_light),
            Smith::Separable => 1.0 / ((1.0 + of_view) * (1.0 + of_light)),
        };
        let energy = (1.0 - 0.5 * (s * s + p * p)) * seen * cosine / (mu * z);
        let inner = if dot(light, axis) > radius.cos() { energy } else { 0.0 };
        all += energy;
        within += inner;
        squares = [squares[0] + energy * energy, squares[1] + inner * inner, squares[2] + energy * inner];
    }
    let share = within / all;
    // The variance of a ratio.
    let variance = squares[1] - 2.0 * share * squares[2] + share * share * squares[0];
    [share, variance.sqrt() / all]
}

/// The share of a prefiltered lobe's energy within `radius` of its axis: light that facets of D cos
/// mirror face on, weighted by its cosine.
fn prefiltered(alpha: f64, radius: f64) -> f64 {
    const FACETS: usize = 1 << 16;
    let (mut all, mut within) = (0.0, 0.0);
    for i in 0..FACETS {
        let u = (i as f64 + 0.5) / FACETS as f64;
        let angle = 2.0 * (alpha * (u / (1.0 - u)).sqrt()).atan();
        let weight = angle.cos().max(0.0);
        all += weight;
        within += if angle < radius { weight } else { 0.0 };
    }
    within / all
}

#[test]
fn half_of_the_energy_of_facets_lies_within_the_radius() {
    let mut places = Vec::new();
    for alpha in [0.003, 0.05, 0.3, 1.0] {
        for mu in [0.05, 0.3, 0.8, 1.0] {
            places.extend([1.02, 1.33, 1.5, 2.4].map(|ior| [alpha, mu, ior]));
        }
    }
    let check = |(i, x): (usize, &[f64; 3])| {
        for smith in [Smith::Correlated, Smith::Separable] {
            let [roughness, radius, _] = at(smith, *x, 1e-6);
            let [found, error] = share(smith, *x, radius, i as u64);
            assert!((found - 0.5).abs() < 4.5 * error, "{smith:?} {x:?}: {found} +- {error} within {radius}");
            assert!(error < 0.01, "{x:?}: {error}");
            let found = prefiltered(roughness * roughness, radius);
            let bound = if roughness < 1.0 { (found - 0.5).abs() < 1e-4 } else { found > 0.5 };
            assert!(bound, "{smith:?} {x:?}: roughness {roughness} has {found} within {radius}");
        }
    };
    places.par_iter().enumerate().for_each(check);
}

#[test]
fn narrow_lobes_have_the_stated_limit() {
    for ior in [1.0001, 1.1, 1.5, 3.0] {
        for mu in [1.0, 0.7, 0.2, 0.1_f64] {
            let inside = (1.0 - (1.0 - mu * mu) / (ior * ior)).sqrt();
            let across = (inside - mu / ior).powi(2);
            let along = across / (inside * inside);
            let sum = along + across;
            let rho = ((sum + (sum * sum + 12.0 * along * across).sqrt()) / 6.0).sqrt();
            let (alpha, limit) = (1e-4_f64, (0.5 * rho).sqrt());
            let found = at(Smith::Correlated, [alpha, mu, ior], 1e-8)[0] / alpha.sqrt();
            assert!((found / limit - 1.0).abs() < 1e-4, "{mu} {ior}: {found} {limit}");
            if mu == 1.0 {
                assert!((limit - ((ior - 1.0) / (2.0 * ior)).sqrt()).abs() < 1e-12, "{ior}");
            }
        }
    }
    assert_eq!(at(Smith::Separable, [0.0, 0.5, 1.5], 1e-8), [0.0; 3]);
    assert_eq!(at(Smith::Separable, [0.5, 0.5, 1.0], 1e-8), [0.0; 3]);
}

#[test]
fn the_error_holds() {
    for smith in [Smith::Correlated, Smith::Separable] {
        let off = |index: &u64| {
            let mut random = Pcg64::seed_from_u64(9_000 + index);
            let mut between = |low: f64, high: f64| low * (high / low).powf(random.random());
            let x = [between(1e-3, 1.0), between(1e-3, 1.0), 1.0 + between(1e-2, 2.0)];
            let [fine, coarse] = [1e-9, 1e-5].map(|tolerance| at(smith, x, tolerance));
            let off = (0..2).map(|k| (fine[k] - coarse[k]).abs()).fold(0.0, f64::max);
            if off > coarse[2] + fine[2] {
                println!("{smith:?} {x:?}: {off:e} of {:e}", coarse[2]);
            }
            off > coarse[2] + fine[2]
        };
        let above = (0..150_u64).into_par_iter().filter(off).count();
        assert!(above <= 1, "{smith:?}: {above} of 150");
    }
}

/// The figure of the rule for many points.
#[test]
fn many_points_are_nearer_than_they_say() {
    const POINTS: u32 = 1000;
    let lattice = |step: f64| (0..POINTS).map(move |i| (0.5 + step * f64::from(i)).fract());
    let points = Points::new([
        ("alpha", lattice(0.618).map(|x| (x * x).max(1e-4)).collect::<Vec<f64>>()),
        ("mu", lattice(0.7548).map(|x| 0.01 + 0.99 * x * x).collect()),
        ("ior", lattice(0.5698).map(|x| 1.05 + 0.95 * x).collect()),
    ]);
    let smith = Smith::Correlated.into();
    let of = |tolerance: f64| {
        let outputs = ["roughness_refracted"];
        let [column] = RefractedWidth.truth(&smith, &points, &outputs, tolerance).expect("values").arrays();
        column
    };
    let (quick, exact) = (of(1e-5), of(1e-7));
    let worst = quick.iter().zip(&exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    println!("{worst:e}");
    assert!(worst < 2e-6, "{worst:e}");
}

#[test]
fn samples_agree() {
    for (seed, x) in [[0.1, 0.5, 1.5], [1.0, 1.0, 1.3], [0.01, 0.05, 2.0]].into_iter().enumerate() {
        for smith in [Smith::Correlated, Smith::Separable] {
            let run = sobol(1 << 16, seed as u64);
            let sampled = RefractedWidth.second_opinion(&smith.into(), &x, run).expect("samples");
            for (found, exact) in sampled.iter().zip(at(smith, x, 1e-8)) {
                let off = (found.value - exact).abs();
                assert!(off <= 5.0 * found.standard_error, "{x:?}: {off:e} of {found:?}");
                assert!(found.standard_error < 2e-3 * exact, "{x:?}: {found:?}");
            }
        }
    }
}

#[test]
fn inputs_outside_the_domain_are_refused() {
    let smith = Smith::Correlated.into();
    for (x, input) in [
        ([1.1, 0.5, 1.5], "alpha"),
        ([1e-5, 0.5, 1.5], "alpha"),
        ([0.5, -0.1, 1.5], "mu"),
        ([0.5, 0.5, 0.9], "ior"),
        ([0.5, 0.5, f64::NAN], "ior"),
    ] {
        let error = RefractedWidth.at(&smith, &x, 1e-6).expect_err("outside").to_string();
        assert!(error.contains(input), "{error}");
    }
    let error = RefractedWidth.at(&smith, &[0.5, 0.5, 1.5], 1e-17).expect_err("finer than any rule");
    assert!(error.to_string().contains("tolerance 1e-17"), "{error}");
}
