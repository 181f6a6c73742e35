//! E of the anisotropic reflection lobe at many points against the reference integrator: hard
//! corners, symmetries, bits and costs.

use lobefit::data::Smith;
use lobefit_math::ops;
use lobefit_truth::integrate::aniso::fast::{self, Many, Place, many};
use lobefit_truth::integrate::aniso::{self};
use lobefit_truth::integrate::{IntegrateError, PanelRule, Path, reflection};
use lobefit_truth::points::Points;
use lobefit_truth::quantity::{GgxReflectionAniso, Quantity};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

const BOTH: [Smith; 2] = [Smith::Separable, Smith::Correlated];

/// The path tracer's texels, every `step`-th along each axis: columns of mu fastest, then alpha.
fn path_tracer(step: usize) -> Vec<Place> {
    let unit =
        |low: f64, high: f64| (0..64).step_by(step).map(move |i| (f64::from(i) / 64.0).clamp(low, high));
    let mut places = Vec::new();
    for z in (0..32).step_by(step) {
        let aspect = (1.0 - 0.9 * (f64::from(z) / 32.0).sqrt()).sqrt();
        for alpha in unit(1e-4, 1.0) {
            let alpha = [(alpha / aspect).max(1e-4), (alpha * aspect).max(1e-4)];
            places.extend(unit(1e-4, 0.9999).map(|mu| Place { alpha, mu, phi: None }));
        }
    }
    places
}

/// `count` random places of alpha and mu from these values to 1, and of any aspect in [0.1, 10].
fn scattered(count: usize, [alpha, mu]: [f64; 2], azimuth: bool) -> Vec<Place> {
    let mut random = Pcg64::seed_from_u64(23);
    let mut one = || {
        let (alpha, mu) = (ops::pow(alpha, random.random()), ops::pow(mu, random.random()));
        let aspect = ops::pow(0.1, random.random::<f64>() - 0.5);
        let phi = azimuth.then(|| 6.3 * random.random::<f64>());
        Place { alpha: [alpha / aspect, alpha * aspect], mu, phi }
    };
    (0..count).map(|_| one()).collect()
}

/// Random ones of the values are the reference's within the tolerance.
fn judge(smith: Smith, places: &[Place], found: &[f64], count: usize, tolerance: f64) {
    let mut random = Pcg64::seed_from_u64(11);
    let drawn: Vec<usize> = (0..count).map(|_| random.random_range(0..places.len())).collect();
    for i in drawn.into_iter().chain([0, 1, places.len() - 1]) {
        let Place { alpha, mu, phi } = places[i];
        let truth = aniso::aniso(smith, alpha, mu, phi, 1e-7).expect("the reference reaches 1e-7");
        // Written so that a value that is not a number fails.
        let off = (found[i] - truth.e).abs();
        assert!(off <= tolerance, "{smith:?} {tolerance:e} at {:?}: {off:e}", places[i]);
    }
}

fn of(smith: Smith, places: &[Place], tolerance: f64) -> Many {
    many(Path::Best, smith, places, tolerance).expect("values")
}

#[test]
fn the_path_tracers_texels_are_within_their_tolerance() {
    let places = path_tracer(1);
    for smith in BOTH {
        for (tolerance, most, count) in [(1e-4, 2e7, 5), (1e-6, 1.2e8, 40)] {
            let found = of(smith, &places, tolerance);
            assert!(found.worst <= tolerance && found.checked >= 2000, "{:e} {}", found.worst, found.checked);
            assert!((found.evaluations as f64) < most, "{} evaluations", found.evaluations);
            judge(smith, &places, &found.e, count, tolerance);
        }
    }
}

#[test]
fn scattered_points_are_within_their_tolerance() {
    for smith in BOTH {
        for (places, tolerance) in [
            (scattered(40_000, [4e-4, 1e-3], true), 1e-5),
            (scattered(20_000, [1e-2, 1e-2], false), 1e-6),
            (scattered(300, [4e-4, 1e-3], false), 1e-6),
        ] {
            let found = of(smith, &places, tolerance);
            assert!(found.worst <= tolerance);
            judge(smith, &places, &found.e, 60, tolerance);
        }
    }
}

/// Narrow along one axis and wide across it, at grazing views: E from the interpolants, and the
/// loss point by point.
#[test]
fn hard_corners_are_those_of_every_point_alone() {
    let at = |i: usize, n: usize| i as f64 / (n - 1) as f64;
    let mus: Vec<f64> = (0..30).map(|i| ops::pow(2e-4, 1.0 - at(i, 30))).collect();
    let widths: Vec<f64> = (0..20).map(|i| (0.02 * ops::pow(50.0, at(i, 20))).min(1.0)).collect();
    let phis: Vec<f64> = (0..12).map(|i| std::f64::consts::FRAC_PI_2 * at(i, 12)).collect();
    let axes: [(&str, &[f64]); 4] =
        [("mu", &mus), ("alpha_x", &widths), ("alpha_y", &widths), ("phi", &phis)];
    for smith in BOTH {
        for (points, tolerance) in [(Points::product(&axes[..3]), 1e-6), (Points::product(&axes), 1e-5)] {
            let truth = |points: &Points, output: &str| {
                let truth = GgxReflectionAniso.truth(&smith.into(), points, &[output], tolerance);
                let [column] = truth.expect("in the domain").arrays();
                column
            };
            let column = |name: &str| points.column(name).expect("a column");
            let hard = |i: usize| {
                let pair = [column("alpha_x")[i], column("alpha_y")[i]];
                let corner = [0, 1].map(|k| [pair[k], pair[1 - k]]).contains(&[widths[0], widths[19]]);
                corner && column("mu")[i] < 0.01 && i.is_multiple_of(3)
            };
            let marks: Vec<bool> = (0..points.len()).map(hard).collect();
            let (e, loss) = (truth(&points, "E"), truth(&points.marked(&marks), "loss"));
            assert!(loss.len() > 5, "{}", loss.len());
            for (i, loss) in (0..points.len()).filter(|i| marks[*i]).zip(loss) {
                let phi = points.column("phi").map_or(f64::NAN, |phi| phi[i]);
                let x = [column("alpha_x")[i], column("alpha_y")[i], column("mu")[i], phi];
                let exact = GgxReflectionAniso.at(&smith.into(), &x, 1e-7).expect("a value");
                let off = [e[i] - exact[0], loss - exact[1], 1.0 - e[i] - loss].map(f64::abs);
                assert!(off.iter().all(|off| *off <= tolerance), "{smith:?} {x:?}: {off:?}");
            }
        }
    }
}

#[test]
fn without_anisotropy_e_is_the_isotropic_albedo_at_any_azimuth() {
    let rule = PanelRule::new(32);
    for smith in BOTH {
        let mut places: Vec<Place> =
            path_tracer(3).into_iter().filter(|place| place.alpha[0] == place.alpha[1]).collect();
        for phi in [None, Some(1.0)] {
            places.iter_mut().for_each(|place| place.phi = phi);
            let found = of(smith, &places, 1e-6);
            for (place, e) in places.iter().zip(&found.e) {
                let off = (e - reflection::albedo(smith, place.alpha[0], place.mu, &rule)).abs();
                assert!(off <= 2e-6, "{smith:?} {place:?}: {off:e}");
            }
        }
    }
}

#[test]
fn the_axes_swap() {
    for smith in BOTH {
        let places = scattered(6000, [0.05, 0.02], false);
        let swapped: Vec<Place> =
            places.iter().map(|place| Place { alpha: [place.alpha[1], place.alpha[0]], ..*place }).collect();
        let (a, b) = (of(smith, &places, 1e-5), of(smith, &swapped, 1e-5));
        for (a, b) in a.e.iter().zip(&b.e) {
            assert!((a - b).abs() < 1e-12, "{smith:?}: {a} {b}");
        }
        let at = |alpha, phi| {
            let place = Place { alpha, mu: 0.2, phi: Some(phi) };
            fast::one(Path::Best, smith, &place, 1e-7).expect("a value").value
        };
        assert!((at([0.8, 0.2], 0.3) - at([0.2, 0.8], std::f64::consts::FRAC_PI_2 - 0.3)).abs() < 1e-14);
        assert!((at([0.8, 0.2], 0.3) - at([0.8, 0.2], std::f64::consts::PI + 0.3)).abs() < 1e-14);
    }
}

#[test]
fn points_agree_with_the_reference() {
    for smith in BOTH {
        for place in scattered(60, [0.01, 0.01], true) {
            let truth = aniso::aniso(smith, place.alpha, place.mu, place.phi, 1e-7).expect("the reference").e;
            let value = fast::one(Path::Best, smith, &place, 1e-6).expect("a value").value;
            assert!((value - truth).abs() < 5e-6, "{smith:?} {place:?}: {:e}", value - truth);
        }
    }
}

#[test]
fn bits_depend_on_neither_threads_nor_instructions() {
    for azimuth in [false, true] {
        let places = if azimuth { scattered(6000, [0.3, 0.3], true) } else { path_tracer(9) };
        let bits = |path, threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
            let found = pool.install(|| many(path, Smith::Correlated, &places, 1e-4)).expect("values");
            let mut bits: Vec<u64> = found.e.iter().map(|e| e.to_bits()).collect();
            bits.extend([found.worst.to_bits(), found.evaluations]);
            bits
        };
        let best = bits(Path::Best, 1);
        assert_eq!(best, bits(Path::Best, 3));
        assert_eq!(best, bits(Path::Avx2, 2));
        assert_eq!(best, bits(Path::Baseline, 2));
    }
}

#[test]
fn points_outside_the_fast_domain_are_integrated_alone_or_refused() {
    let truth = |alpha_x: f64, mu: f64| {
        let columns = [("alpha_x", vec![alpha_x, 0.5]), ("alpha_y", vec![0.5; 2]), ("mu", vec![mu; 2])];
        GgxReflectionAniso.truth(&Smith::Separable.into(), &Points::new(columns), &["E"], 1e-6)
    };
    for (alpha_x, mu) in [(0.0011, 0.3), (0.4, 0.0), (0.4, 5e-5)] {
        let [e] = truth(alpha_x, mu).expect("in the domain").arrays();
        let exact = aniso::aniso(Smith::Separable, [alpha_x, 0.5], mu, None, 1e-7).expect("the reference").e;
        assert!((e[0] - exact).abs() <= 1e-6, "{alpha_x} {mu}: {} {exact}", e[0]);
    }
    for (alpha_x, mu) in [(9.0, 0.3), (f64::NAN, 0.3), (-1.0, 0.3), (0.5, 1.5)] {
        assert!(matches!(truth(alpha_x, mu), Err(IntegrateError::Domain { .. })), "{alpha_x} {mu}");
    }
    let place = |mu, phi| Place { alpha: [0.5; 2], mu, phi };
    assert!(fast::one(Path::Best, Smith::Separable, &place(5e-5, None), 1e-6).is_err());
    assert!(fast::one(Path::Best, Smith::Separable, &place(0.5, Some(f64::NAN)), 1e-6).is_err());
}
