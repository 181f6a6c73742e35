//! What `error` says, measured: |value - truth| is within it at all but few of random points.
//! `tests/integrate/error_bound.rs` has `ggx-reflection` at 10 000 points,
//! `tests/integrate/lobes.rs` glass and the anisotropic lobe; here are the other quantities.

#![allow(clippy::disallowed_methods)]

use lobefit_math::gauss::Gauss;
use lobefit_math::panels;
use lobefit_truth::integrate::brdf::{Brdf, albedo as albedo_of_brdf};
use lobefit_truth::integrate::reflection::{Effort, albedo, loss, split};
use lobefit_truth::optics::Smith;
use lobefit_truth::optics::beckmann::Beckmann;
use lobefit_truth::optics::distribution::Distribution;
use lobefit_truth::optics::ggx::Vec3;
use lobefit_truth::optics::kernel::Kernel;
use lobefit_truth::quantity::Specular;
use lobefit_truth::quantity::sheen::lobe as sheen;
use lobefit_truth::quantity::{
    BECKMANN_REFLECTION, DiffuseCoupling, GgxAverage, ParallaxAlpha, Quantity, SheenCharlie, Variant,
};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

/// Random points of each quantity and variant.
const POINTS: u64 = 400;

/// Points of a quantity at which a value is off its truth by more than its error and `slack`, the
/// truth's own.
fn above<const N: usize>(
    quantity: &'static dyn Quantity,
    variant: &Variant,
    [low, high]: [[f64; N]; 2],
    slack: f64,
    truth: impl Fn([f64; N]) -> f64 + Sync,
) -> usize {
    let is_above = |index: &u64| {
        let mut random = Pcg64::seed_from_u64(4_000 + index);
        let x: [f64; N] = std::array::from_fn(|k| low[k] * (high[k] / low[k]).powf(random.random()));
        let tolerance = quantity.tolerance(variant);
        let value = quantity.at(variant, &x, tolerance).expect("in the domain");
        let error = value[value.len() - 1];
        assert!(error <= tolerance, "{quantity:?} {x:?}: {error:e}");
        let off = (value[0] - truth(x)).abs();
        if off > error + slack {
            println!("{quantity:?} {x:?}: {off:e} of {error:e}");
        }
        off > error + slack
    };
    (0..POINTS).into_par_iter().filter(is_above).count()
}

/// E_avg by rules of four times the nodes on panels ten times as fine.
fn average(smith: Smith, alpha: f64) -> f64 {
    let (rule, cuts) = (Gauss::new(32), panels::from_zero(1.0, 1e-4 * alpha));
    let at = |mu: f64| mu * albedo(smith, alpha, mu, &Effort::ladder()[3].outer);
    2.0 * cuts.windows(2).map(|cut| rule.integrate(cut[0], cut[1], at)).sum::<f64>()
}

#[test]
fn errors_of_averages_and_couplings_hold() {
    for smith in [Smith::Correlated, Smith::Separable] {
        let of = above(&GgxAverage, &smith.into(), [[1e-4], [1.0]], 0.0, |[alpha]| average(smith, alpha));
        assert!(of <= 1, "{smith:?}: {of} averages");
        for specular in Specular::ALL {
            let variant = Variant { specular: Some(specular), ..smith.into() };
            let truth = |[alpha, mu, f0]: [f64; 3]| {
                let effort = &Effort::ladder()[3];
                let ((e, b), lost) = (split(smith, alpha, mu, effort), loss(smith, alpha, mu, &effort.outer));
                let (g, a1) = (1.0 - f0, 1.0 - b / e);
                match specular {
                    Specular::Single => lost + g * (e - b),
                    Specular::Normalised => g * a1,
                    Specular::Compensated => g * (a1 + lost * (1.0 - g * a1)),
                }
            };
            let of = above(&DiffuseCoupling, &variant, [[1e-4, 1e-4, 0.01], [1.0; 3]], 0.0, truth);
            assert!(of <= 1, "{smith:?} {specular:?}: {of} factors");
        }
    }
}

#[test]
fn errors_of_beckmann_and_sheen_hold() {
    // The slack is the error of an integral over lights that knows nothing of the lobe but its
    // width.
    let slack = 2e-9;
    for smith in [Smith::Correlated, Smith::Separable] {
        let truth = |[alpha, mu]: [f64; 2]| {
            let lobe = Beckmann(alpha);
            let weighted = move |v: Vec3, l: Vec3| {
                let (of_view, of_light) = (lobe.lambda(v[2]), lobe.lambda(l[2]));
                let g2 = match smith {
                    Smith::Correlated => 1.0 / (1.0 + of_view + of_light),
                    Smith::Separable => 1.0 / ((1.0 + of_view) * (1.0 + of_light)),
                };
                lobe.density(half(v, l)) * g2 / (4.0 * v[2])
            };
            integral(Brdf { weighted: Box::new(weighted), width: alpha }, mu)
        };
        let of = above(BECKMANN_REFLECTION, &smith.into(), [[1e-2, 1e-2], [1.0; 2]], slack, truth);
        assert!(of <= 1, "{smith:?}: {of} of Beckmann");
    }
    let truth = |[alpha, mu]: [f64; 2]| {
        let weighted =
            move |v: Vec3, l: Vec3| sheen::distribution(alpha, half(v, l)) * sheen::lit(v[2], l[2]) / 4.0;
        integral(Brdf { weighted: Box::new(weighted), width: 1e-3 }, mu)
    };
    let of = above(&SheenCharlie, &Variant::default(), [[0.1, 1e-2], [1.0; 2]], slack, truth);
    assert!(of <= 1, "{of} of sheen");
}

fn integral(brdf: Brdf, mu: f64) -> f64 {
    albedo_of_brdf("a BRDF", &brdf, mu, 1e-9).expect("an integral").value
}

fn half(v: Vec3, l: Vec3) -> Vec3 {
    let sum = [v[0] + l[0], v[1] + l[1], v[2] + l[2]];
    let length = (sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]).sqrt();
    sum.map(|x| x / length)
}

/// The width where the squared distance of encircled energies over a fine sum is stationary, sought
/// about a start by the secant rule.
fn stationary(kernel: &Kernel, [alpha, rho]: [f64; 2], start: f64) -> f64 {
    let target = kernel.lobe(alpha);
    let (from, to) = ((alpha * rho.min(1.0)).ln() - 14.0, rho.max(1.0).ln() + 14.0);
    let radii: Vec<f64> = (0..=2000).map(|i| (from + (to - from) * f64::from(i) / 2000.0).exp()).collect();
    let slope = |x: f64| -> f64 {
        let [below, at, above] = [x - 1e-4, x, x + 1e-4].map(|x| kernel.lobe(x.exp()));
        let off = |r: &f64| target.encircled(r / rho) - at.encircled(*r);
        radii.iter().map(|r| off(r) * (above.encircled(*r) - below.encircled(*r))).sum()
    };
    let (mut a, mut b) = (start.ln() - 1e-3, start.ln() + 1e-3);
    for _ in 0..8 {
        let (f, g) = (slope(a), slope(b));
        if g == f {
            break;
        }
        (a, b) = (b, b - g * (b - a) / (g - f));
    }
    b.exp()
}

#[test]
fn errors_of_widths_hold() {
    for kernel in Kernel::ALL {
        let variant = Variant { kernel: Some(kernel.clone()), ..Variant::default() };
        let truth = |x: [f64; 2]| {
            let found = ParallaxAlpha.at(&variant, &x, ParallaxAlpha.tolerance(&variant)).expect("a width");
            // Saturated: the width is 1 by definition.
            if found[2] == 1.0 { 1.0 } else { stationary(&kernel, x, found[0]) }
        };
        let of = above(&ParallaxAlpha, &variant, [[1e-2, 1.0 / 16.0], [1.0, 8.0]], 1e-8, truth);
        assert!(of <= 1, "{kernel:?}: {of} widths");
    }
}
