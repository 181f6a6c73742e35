//! The shadowings that renderers pair with GGX and with Charlie beside Smith's and Neubelt's,
//! against sums over facets that share nothing with the integrators: midpoints over the drawing of
//! normals, the light as a vector.

use lobefit_math::ops;
use lobefit_truth::integrate::monte_carlo::{self, Draw, Run};
use lobefit_truth::optics::Smith;
use lobefit_truth::points::Points;
use lobefit_truth::quantity::EstevezKulla;
use lobefit_truth::quantity::{Quantity, SCHLICK_SMITH, Variant};
use rayon::prelude::*;
use std::f64::consts::PI;

/// Midpoints along each side of the square that facets are drawn from.
const SIDE: usize = 1200;

/// Sums a function of the facet (its cosine and sine, and the cosine of its azimuth from the view)
/// over the unit square; `cosine` draws the facet's cosine, with a weight.
fn mean<const N: usize>(
    cosine: impl Fn(f64) -> (f64, f64) + Sync,
    value: impl Fn(f64, f64, f64) -> [f64; N] + Sync,
) -> [f64; N] {
    let at = |i: usize| (i as f64 + 0.5) / SIDE as f64;
    let row = |i: usize| {
        let (c, weight) = cosine(at(i));
        let s = ((1.0 - c) * (1.0 + c)).sqrt();
        let mut sum = [0.0; N];
        for j in 0..SIDE {
            for (sum, v) in sum.iter_mut().zip(value(c, s, ops::cos(PI * at(j)))) {
                *sum += weight * v / (SIDE * SIDE) as f64;
            }
        }
        sum
    };
    let rows: Vec<[f64; N]> = (0..SIDE).into_par_iter().map(row).collect();
    rows.into_iter().fold([0.0; N], |mut sum, row| {
        sum.iter_mut().zip(row).for_each(|(sum, v)| *sum += v);
        sum
    })
}

/// v.h and the light's cosine of a facet.
fn mirrored(mu: f64, c: f64, s: f64, azimuth: f64) -> (f64, f64) {
    let y = mu * c + ((1.0 - mu) * (1.0 + mu)).sqrt() * s * azimuth;
    (y, 2.0 * y * c - mu)
}

/// E and B of GGX with a G2 of the cosines of view and light by drawing D cos, as the tables of games are
/// made; more of the numbers lie near 1, where the tail is drawn.
fn ggx(alpha: f64, mu: f64, g2: impl Fn(f64, f64) -> f64 + Sync) -> [f64; 2] {
    let cosine = |w: f64| {
        let u = 1.0 - w * w * w;
        (((1.0 - u) / (1.0 + (alpha * alpha - 1.0) * u)).sqrt(), 3.0 * w * w)
    };
    mean(cosine, |c, s, azimuth| {
        let (y, mu_l) = mirrored(mu, c, s, azimuth);
        if y <= 0.0 || mu_l <= 0.0 {
            return [0.0; 2];
        }
        let kept = g2(mu, mu_l) * y / (c * mu);
        [kept, kept * ops::pow(1.0 - y, 5.0)]
    })
}

#[test]
fn schlick_smith_is_what_its_formula_draws() {
    let ks = [
        |alpha: f64| 0.5 * alpha,
        |alpha: f64| (alpha.sqrt() + 1.0) * (alpha.sqrt() + 1.0) / 8.0,
        |alpha: f64| alpha,
    ];
    for (quantity, k) in SCHLICK_SMITH.iter().zip(ks) {
        for (alpha, mu) in [(0.01, 0.7), (0.09, 0.2), (0.3, 0.04), (0.6, 0.95), (1.0, 0.5)] {
            let variant = Variant::from(Smith::Separable);
            let found = quantity.at(&variant, &[alpha, mu], 1e-9).expect("a truth");
            let g1 = |x: f64| x / (x * (1.0 - k(alpha)) + k(alpha));
            let [e, b] = ggx(alpha, mu, |v, l| g1(v) * g1(l));
            assert!(
                (found[0] - e).abs() < 4e-5 && (found[2] - b).abs() < 4e-5,
                "{alpha} {mu}: {found:?} {e} {b}"
            );
            assert!((found[0] + found[3] - 1.0).abs() < 1e-14, "the loss is what is left: {found:?}");
            // Lights drawn evenly, for visible normals have another masking.
            let run = Run {
                samples: 1 << 14,
                seed: 7,
                points: monte_carlo::Points::Sobol,
                draw: Draw::VisibleNormal,
            };
            let drawn = quantity.second_opinion(&variant, &[alpha, mu], run).expect("samples")[0];
            let off = (drawn.value - e).abs();
            assert!(off < 5.0 * drawn.standard_error + 4e-5, "{alpha} {mu}: {drawn:?} {e}");
        }
        // A mirror keeps G1 of the view and of the light.
        let g1 = 0.3 / (0.3 * (1.0 - k(0.0)) + k(0.0));
        let mirror = quantity.at(&Variant::from(Smith::Separable), &[0.0, 0.3], 1e-9).expect("a mirror");
        assert!((mirror[0] - g1 * g1).abs() < 1e-15, "{mirror:?}");
        let near = quantity.at(&Variant::from(Smith::Separable), &[1e-6, 0.3], 1e-9).expect("a truth");
        assert!((mirror[0] - near[0]).abs() < 1e-3, "{mirror:?} {near:?}");
    }
}

/// G2 = 4 (n.l) (n.v) V, of V = 1/2 over a mix by alpha of 2 (n.l) (n.v) and n.l + n.v (Hammon 2017).
#[test]
fn the_joint_form_without_roots_is_what_its_formula_draws() {
    for (alpha, mu) in [(0.01, 0.7), (0.09, 0.2), (0.3, 0.04), (0.6, 0.95), (1.0, 0.5)] {
        let found =
            SCHLICK_SMITH[0].at(&Variant::from(Smith::Correlated), &[alpha, mu], 1e-9).expect("a truth");
        let [e, b] = ggx(alpha, mu, |v, l| 2.0 * v * l / (2.0 * v * l * (1.0 - alpha) + (v + l) * alpha));
        assert!(
            (found[0] - e).abs() < 4e-5 && (found[2] - b).abs() < 4e-5,
            "{alpha} {mu}: {found:?} {e} {b}"
        );
    }
}

/// Estevez and Kulla's Lambda (2017), written out.
fn lambda(cosine: f64, alpha: f64) -> f64 {
    let t = (1.0 - alpha) * (1.0 - alpha);
    let of = |smooth: f64, rough: f64| rough + t * (smooth - rough);
    let l = |x: f64| {
        of(25.3245, 21.5473) / (1.0 + of(3.32435, 3.82987) * ops::pow(x, of(0.16801, 0.19823)))
            + of(-1.27393, -1.97760) * x
            + of(-4.85967, -4.32054)
    };
    ops::exp(if cosine < 0.5 { l(cosine) } else { 2.0 * l(0.5) - l(1.0 - cosine) })
}

#[test]
fn estevez_and_kulla_s_shadowing_is_what_its_formula_sums_to() {
    let mut worst = 0.0_f64;
    for (alpha, mu) in [(0.02, 0.1), (0.05, 0.6), (0.3, 0.03), (0.3, 0.8), (1.0, 0.4), (0.7, 1.0)] {
        let p = 1.0 / alpha;
        // D over the angle: 2 pi of azimuths are twice those of a half.
        let angle = |u: f64| (ops::cos(0.5 * PI * u), 0.5 * PI * 2.0 * PI);
        let [e] = mean(angle, |c, s, azimuth| {
            let (y, mu_l) = mirrored(mu, c, s, azimuth);
            if y <= 0.0 || mu_l <= 0.0 {
                return [0.0];
            }
            let d = (2.0 + p) * ops::pow(s, p) / (2.0 * PI);
            [d * s * y / (mu * (1.0 + lambda(mu, alpha) + lambda(mu_l, alpha)))]
        });
        let found = EstevezKulla.at(&Variant::default(), &[alpha, mu], 1e-5).expect("a truth");
        println!("{alpha} {mu}: {found:?} {e}");
        worst = worst.max((found[0] - e).abs());
    }
    assert!(worst < 2e-5, "{worst:e}");
    let refused = EstevezKulla.at(&Variant::default(), &[0.3, 0.0], 1e-5);
    assert!(refused.is_err_and(|e| e.to_string().contains("mu")));
}

#[test]
fn estevez_and_kulla_s_shadowing_has_a_truth_everywhere() {
    let at = |i: usize, low: f64| ops::pow(low, i as f64 / 15.0);
    let one = |i: usize| {
        let (alpha, mu) = (at(i % 16, 1e-4), at(i / 16, 1e-6));
        EstevezKulla.at(&Variant::default(), &[alpha, mu], 1e-5).map(|v| v[1])
    };
    let errors: Vec<f64> = (0..256).into_par_iter().map(one).collect::<Result<_, _>>().expect("truths");
    println!("{:e}", errors.into_iter().fold(0.0, f64::max));
}

/// Over every panel of the interpolant, and at its corners.
#[test]
fn many_points_of_estevez_and_kulla_s_are_those_of_one() {
    const N: usize = 73;
    let at = |i: usize, low: f64| ops::pow(low, i as f64 / (N - 1) as f64);
    let alphas: Vec<f64> = (0..N).map(|i| at(i, 1e-4)).collect();
    let mus: Vec<f64> = (0..N).map(|i| at(i, 1e-6)).collect();
    let points = Points::product(&[("alpha", &alphas), ("mu", &mus)]);
    let many = EstevezKulla.truth(&Variant::default(), &points, &["E"], 1e-5).expect("truths");
    let off = |k: usize| {
        let x = [alphas[k % N], mus[k / N]];
        let one = EstevezKulla
            .at(&Variant::default(), &x, 1e-6)
            .or_else(|_| EstevezKulla.at(&Variant::default(), &x, 1e-5));
        (one.expect("a truth")[0] - many.columns[0][k]).abs()
    };
    let worst = (0..N * N).into_par_iter().map(off).reduce(|| 0.0, f64::max);
    println!("{worst:e}");
    assert!(worst <= 6e-6, "{worst:e}");
}

/// Facets drawn one by one, with Lambda itself at every cosine: the quadrature has it in a table.
#[test]
fn estevez_and_kulla_s_shadowing_is_what_samples_find() {
    for x in [
        [2e-4, 2e-6],
        [1e-3, 5e-5],
        [0.01, 0.01],
        [0.05, 0.3],
        [0.3, 1e-5],
        [0.3, 0.499],
        [1.0, 0.51],
        [1.0, 0.99],
    ] {
        let exact = EstevezKulla.at(&Variant::default(), &x, 1e-5).expect("a truth");
        let run =
            Run { samples: 1 << 18, seed: 7, points: monte_carlo::Points::Sobol, draw: Draw::UniformLight };
        let found = EstevezKulla.second_opinion(&Variant::default(), &x, run).expect("samples")[0];
        let off = (found.value - exact[0]).abs();
        println!("{x:?}: {exact:?} {found:?}");
        assert!(off <= 4.5 * found.standard_error + exact[1], "{x:?}: {exact:?} {found:?}");
        assert!(found.standard_error < 2e-3 * exact[0].max(0.1), "{x:?}: {found:?}");
    }
}
