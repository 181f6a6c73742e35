//! Footprints on slanted walls against the exact ones without slant, against an independent
//! integration over places of the wall, and the fetches that come nearest against the study's
//! figures.

use std::f64::consts::PI;

use lobefit::effects::parallax::taps::best::{Found, best_taps};
use lobefit::effects::parallax::taps::least::least;
use lobefit_math::ops::{cos, sin, sincos};
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::optics::footprint::RuleTap;
use lobefit_truth::optics::kernel::Kernel;
use lobefit_truth::quantity::footprint::measures;
use lobefit_truth::quantity::footprint::slant::{
    Case, Nearest, Normal, Resolution, Slant, Stand, best_width,
};
use nalgebra::{DMatrix, DVector};

fn degrees(x: f64) -> f64 {
    x * PI / 180.0
}

fn case(alpha: f64, slant: Slant, resolution: Resolution) -> Case {
    Case::new(Kernel::HalfCosine, alpha, slant, resolution).expect("within the domain")
}

#[test]
fn without_slant_distances_are_those_of_the_radial_footprint() {
    for kernel in Kernel::ALL {
        for (alpha, rho, fetched) in [(0.1, 0.5, 0.06), (0.3, 0.25, 0.09), (0.02, 1.5, 0.03), (0.6, 1.0, 0.5)]
        {
            let stand = |distance| Stand { distance, slant: 0.0 };
            let slant = Slant { shading: stand(rho), probe: stand(1.0), azimuth: 0.0 };
            let exact = measures(&kernel, alpha, rho, fetched).expect("measures");
            let case = Case::new(kernel.clone(), alpha, slant, Resolution::FINE).expect("a case");
            let off = case.off(&case.normalised(case.straight(fetched)).expect("a fetch"));
            // lobes that do not end in 0 at the horizon lose their tails past the last row: 1/300
            // of the height
            let tail = if kernel == Kernel::HalfCosine { 2e-4 } else { 3e-3 };
            let place = format!("{kernel:?} alpha {alpha} rho {rho}: {off:?} against {exact:?}");
            assert!((off.tv - exact.tv).abs() < tail, "{place}");
            assert!((off.l2 / exact.l2 - 1.0).abs() < 1e-3 + tail, "{place}");
            assert!((off.max / exact.max - 1.0).abs() < 2e-2, "{place}");
            assert!((off.distance / exact.encircled - 1.0).abs() < 1e-3 + 10.0 * tail, "{place}");
        }
    }
}

/// Energy per wall area as the study writes it, over the unnormalised densities of the printed
/// formulas.
fn per_area(alpha: f64, from: [f64; 3], axis: [f64; 3], [x, y]: [f64; 2]) -> f64 {
    let v = [x - from[0], y - from[1], -from[2]];
    let square: f64 = v.iter().map(|c| c * c).sum();
    let cosine = v.iter().zip(axis).map(|(a, b)| a * b).sum::<f64>() / square.sqrt();
    // GGX over half the angle: c^2 = (1 + cos)/2
    let half = 0.5 * (1.0 + cosine);
    let spread = half * alpha * alpha + (1.0 - half);
    cosine.max(0.0) / (spread * spread) * from[2] / (square * square.sqrt())
}

/// Total variation by Gauss-like midpoints over x = scale sinh(s), y = scale sinh(t): nothing of
/// the library's coordinates.
fn variation(target: impl Fn([f64; 2]) -> f64, fetch: impl Fn([f64; 2]) -> f64, scale: f64, n: usize) -> f64 {
    let reach = 11.0;
    let node = |i: usize| {
        let s = reach * (2.0 * (i as f64 + 0.5) / n as f64 - 1.0);
        let (e, f) = (lobefit_math::ops::exp(s), lobefit_math::ops::exp(-s));
        (scale * 0.5 * (e - f), scale * 0.5 * (e + f))
    };
    let nodes: Vec<(f64, f64)> = (0..n).map(node).collect();
    let sum = |f: &dyn Fn([f64; 2]) -> f64| -> f64 {
        nodes
            .iter()
            .flat_map(|a| nodes.iter().map(move |b| (a, b)))
            .map(|(a, b)| f([a.0, b.0]) * a.1 * b.1)
            .sum()
    };
    let (t, f) = (sum(&target), sum(&fetch));
    0.5 * sum(&|place| (target(place) / t - fetch(place) / f).abs())
}

#[test]
fn total_variation_is_that_of_an_independent_integration() {
    for (alpha, psi_s, d_s, psi_p, azimuth) in [
        (0.1, 60.0, 1.0, 0.0, 0.0),
        (0.3, 72.0, 1.0, 0.0, 0.0),
        (0.05, 40.0, 0.5, 55.0, 70.0),
        (0.2, 75.0, 1.4, 30.0, 180.0),
    ] {
        let (psi_s, psi_p, azimuth) = (degrees(psi_s), degrees(psi_p), degrees(azimuth));
        let slant = Slant {
            shading: Stand { distance: d_s, slant: psi_s },
            probe: Stand { distance: 1.0, slant: psi_p },
            azimuth,
        };
        let case = case(alpha, slant, Resolution::FINE);
        let fetched = 0.7 * alpha;
        let off = case.off(&case.normalised(case.straight(fetched)).expect("a fetch"));
        let s = [-d_s * sin(psi_s), 0.0, d_s * cos(psi_s)];
        let (y, x) = sincos(azimuth);
        let p = [-sin(psi_p) * x, -sin(psi_p) * y, cos(psi_p)];
        let back = |v: [f64; 3], d: f64| v.map(|c| -c / d);
        let independent = variation(
            |at| per_area(alpha, s, back(s, d_s), at),
            |at| per_area(fetched, p, back(p, 1.0), at),
            0.3 * alpha,
            1400,
        );
        assert!((off.tv - independent).abs() < 1e-3, "{alpha} {slant:?}: {} against {independent}", off.tv);
    }
}

#[test]
fn coarse_and_fine_agree() {
    for (alpha, psi) in [(1e-3, 45.0), (0.1, 72.0), (0.1, 80.0), (0.45, 60.0)] {
        let slant = Slant::in_front(degrees(psi));
        let taps = [-0.8, 0.7].map(|c| RuleTap { tilt: c * alpha, width: 0.75, weight: 0.5 });
        let off = |resolution| {
            let case = case(alpha, slant, resolution);
            case.off(&case.fetched(&taps).expect("fetches"))
        };
        let (coarse, fine) = (off(Resolution::COARSE), off(Resolution::FINE));
        let finest = off(Resolution { step: 0.03, angles: 256 });
        assert!((fine.tv - finest.tv).abs() < 1e-3, "alpha {alpha} psi {psi}: {fine:?} {finest:?}");
        assert!(
            (fine.distance / finest.distance - 1.0).abs() < 2e-3,
            "alpha {alpha} psi {psi}: {fine:?} {finest:?}"
        );
        assert!((coarse.tv - finest.tv).abs() < 1.2e-2, "alpha {alpha} psi {psi}: {coarse:?} {finest:?}");
    }
}

#[test]
fn the_derivatives_are_those_of_the_distance() {
    let case = case(0.2, Slant::in_front(degrees(65.0)), Resolution::COARSE);
    let at = [[-0.9, -0.2, 0.3], [0.6, -0.4, -0.2], [1.4, 0.1, -0.5]];
    let here = case.squares(&at).expect("inside");
    for (tap, part) in (0..3).flat_map(|t| (0..3).map(move |p| (t, p))) {
        let moved = |by: f64| {
            let mut at = at;
            at[tap][part] += by;
            case.squares(&at).expect("inside").value
        };
        let slope = (moved(1e-4) - moved(-1e-4)) / 2e-4;
        let stated = 2.0 * here.gradient[3 * part + tap];
        assert!((slope - stated).abs() < 1e-3 * here.value.sqrt(), "tap {tap} part {part}: {slope} {stated}");
    }
}

/// The study's table: alpha, slant, total variation of the same width, of the best one, of 2, 3, 4
/// and 8 fetches.
const TABLE: [(f64, f64, [f64; 6]); 6] = [
    (0.1, 30.0, [0.075, 0.067, 0.039, 0.023, 0.017, 0.018]),
    (0.1, 60.0, [0.289, 0.243, 0.158, 0.101, 0.064, 0.029]),
    (0.1, 72.0, [0.443, 0.375, 0.246, 0.171, 0.119, 0.049]),
    (0.1, 80.0, [0.583, 0.505, 0.323, 0.236, 0.195, 0.072]),
    (0.3, 60.0, [0.319, 0.312, 0.118, 0.082, 0.072, 0.067]),
    (0.3, 72.0, [0.444, 0.433, 0.166, 0.116, 0.092, 0.087]),
];

#[test]
fn fetches_come_as_near_as_the_study_says() {
    for (alpha, slants) in [(0.1, &[30.0, 45.0, 60.0, 72.0, 80.0][..]), (0.3, &[40.0, 60.0, 72.0])] {
        let counts = [2, 3, 4, 8];
        let mut last: Vec<Option<Found>> = vec![None; counts.len()];
        for &psi in slants {
            let slant = Slant::in_front(degrees(psi));
            let fine = case(alpha, slant, Resolution::FINE);
            let search = case(alpha, slant, Resolution { step: 0.14, angles: 64 });
            let found: Vec<Found> = counts
                .iter()
                .zip(&last)
                .map(|(n, last)| best_taps(&search, *n, last.as_ref()).expect("fetches"))
                .collect();
            if let Some((.., stated)) = TABLE.iter().find(|(a, p, _)| (*a, *p) == (alpha, psi)) {
                let same = fine.off(&fine.normalised(fine.straight(alpha)).expect("a fetch"));
                let (_, best) = best_width(&fine, Nearest::Variation).expect("a width");
                let mut tv = vec![same.tv, best.tv];
                tv.extend(found.iter().map(|f| fine.off(&fine.fetched(&f.taps).expect("fetches")).tv));
                assert!((tv[0] - stated[0]).abs() < 1.5e-3, "{tv:?}");
                // it is the H^-1 norm that is least, and the study's were on the probe's sphere
                let leeway = if alpha > 0.2 { 1.06 } else { 1.01 };
                for (got, stated) in tv.iter().zip(stated).skip(1) {
                    assert!(
                        *got < stated * leeway + 5e-4,
                        "alpha {alpha} psi {psi}: {tv:?} against {stated}"
                    );
                }
            }
            last = found.into_iter().map(Some).collect();
        }
    }
}

/// (x - 3)^2 + (x y - 1)^2, and nothing of the third parameter.
fn bent(p: &[f64]) -> Option<Normal> {
    let (x, y) = (p[0], p[1]);
    Normal::of(&[x - 3.0, x * y - 1.0], &[vec![1.0, y], vec![0.0, x], vec![0.0, 0.0]])
}

#[test]
fn a_search_comes_to_rest_or_says_that_it_does_not() {
    let found = least(bent, &[1.0, 2.0, 0.7], 100).expect("a search");
    assert!(found.settled && found.value < 1e-12, "{found:?}");
    assert!((found.at[0] - 3.0).abs() < 1e-5 && (found.at[1] - 1.0 / 3.0).abs() < 1e-5, "{found:?}");
    assert_eq!(found.at[2], 0.7, "what has no effect stays");
    let cut = least(bent, &[1.0, 2.0, 0.7], 2).expect("a search");
    assert!(!cut.settled && cut.value > found.value, "{cut:?}");
    // where nothing has an effect there is nothing to seek
    let flat = least(|_| Normal::of(&[2.0], &[vec![0.0], vec![0.0]]), &[1.0, 1.0], 9).expect("a search");
    assert!(flat.settled && flat.at == [1.0, 1.0] && flat.value == 4.0, "{flat:?}");
}

#[test]
fn a_search_that_cannot_be_solved_is_an_error() {
    let refused = least(|_| None, &[0.5], 9);
    assert!(matches!(refused, Err(IntegrateError::Search { .. })), "{refused:?}");
    // a Hessian of no sum of squares
    let saddle = |p: &[f64]| {
        let hessian = DMatrix::from_row_slice(2, 2, &[1.0, 9.0, 9.0, 1.0]) * -1.0;
        Some(Normal { value: 2.0 + p[0], gradient: DVector::from_vec(vec![1.0, 1.0]), hessian })
    };
    let failed = least(saddle, &[0.25, 4.0], 9).expect_err("no step").to_string();
    for part in ["slanted footprint", "[0.25, 4.0]", "no sum of squares"] {
        assert!(failed.contains(part), "{failed}");
    }
}
