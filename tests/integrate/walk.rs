//! The random walk on the Smith microsurface.

use lobefit::data::Smith;
use lobefit_math::ops;
use lobefit_truth::integrate::monte_carlo::Sampled;
use lobefit_truth::integrate::reflection;
use lobefit_truth::integrate::walk::{BINS, Walks, walk};
use lobefit_truth::optics::fresnel;

const WALKS: Walks = Walks { paths: 1 << 18, seed: 7 };

fn agrees(found: Sampled, truth: f64, what: &str) {
    let off = (found.value - truth).abs();
    assert!(off <= 4.0 * found.standard_error, "{what}: {found:?}, truth {truth}");
}

/// What leaves after one bounce is the integral of single scattering with correlated shadowing,
/// whose formula the walk does not know; what leaves after any number is all of it.
#[test]
fn one_bounce_is_single_scattering_and_all_bounces_are_white() {
    for (alpha, mu) in [(0.05, 0.04), (0.3, 0.2), (0.3, 0.9), (1.0, 0.1), (1.0, 1.0)] {
        let f0 = 0.04;
        let walked = walk(alpha, [mu; 2], WALKS, &|c| [1.0, fresnel::schlick(f0, 1.0 - c), 0.5]).unwrap();
        let truth = reflection::reflection(Smith::Correlated, alpha, mu, 1e-9).unwrap();
        let at = format!("alpha {alpha}, mu {mu}");
        agrees(walked.bounces[0][0], truth.e, &at);
        agrees(walked.multiple[0], truth.loss, &at);
        agrees(walked.bounces[0][1], f0 * truth.a + truth.b, &at);
        agrees(walked.albedo[0], 1.0, &at);
        // the errors are small enough to tell the two forms of shadowing apart wherever they differ
        assert!(walked.bounces[0][0].standard_error < 5e-4, "{walked:?}");
        // grey facets: the n-th bounce has the energy of the white one, halved n times
        for n in 0..3 {
            let (white, grey) = (walked.bounces[n][0], walked.bounces[n][2]);
            let halved = white.value * ops::pow(0.5, n as f64 + 1.0);
            assert!((grey.value - halved).abs() < 1e-12, "{at}: bounce {n}");
        }
        let bins: f64 = walked.lights.iter().map(|bin| bin[0].value).sum();
        assert!((bins - walked.multiple[0].value).abs() < 1e-12, "{at}");
        let bins: f64 = walked.single_lights.iter().map(|bin| bin[1].value).sum();
        assert!((bins - walked.bounces[0][1].value).abs() < 1e-12, "{at}");
    }
}

/// The average over the hemisphere.
#[test]
fn the_average_is_the_integral() {
    for alpha in [0.2, 0.7] {
        let walked = walk(alpha, [0.0, 1.0], WALKS, &|_| [1.0; 3]).unwrap();
        let truth = reflection::average(Smith::Correlated, alpha, 1e-9).unwrap();
        agrees(walked.bounces[0][0], truth.e_avg, &format!("alpha {alpha}"));
        agrees(walked.albedo[0], 1.0, &format!("alpha {alpha}"));
    }
}

/// Light that leaves after two bounces or more goes from one set of directions to another as it
/// goes back: the walk is reciprocal, which nothing in its making forces.
#[test]
fn several_bounces_are_reciprocal() {
    let walks = Walks { paths: 1 << 19, seed: 11 };
    let edges = |bin: usize| [bin as f64 / BINS as f64, (bin + 1) as f64 / BINS as f64];
    // energy that enters through a bin, int mu dmu
    let entering = |bin: usize| 0.5 * (edges(bin)[1] * edges(bin)[1] - edges(bin)[0] * edges(bin)[0]);
    let bins = [1, 5, 10, 15];
    let from = bins
        .map(|bin| walk(0.8, edges(bin), walks, &|c| [1.0, fresnel::schlick(0.5, 1.0 - c), 0.3]).unwrap());
    for (i, a) in bins.iter().enumerate() {
        for (j, b) in bins.iter().enumerate().skip(i + 1) {
            for channel in 0..3 {
                let (there, back) = (from[i].lights[*b][channel], from[j].lights[*a][channel]);
                let (x, y) = (there.value * entering(*a), back.value * entering(*b));
                let (dx, dy) = (there.standard_error * entering(*a), back.standard_error * entering(*b));
                let spread = (dx * dx + dy * dy).sqrt();
                assert!((x - y).abs() < 4.0 * spread, "{a} {b} channel {channel}: {x} {y} +- {spread}");
                assert!(spread < 0.05 * x, "{a} {b}: {x} +- {spread} tells nothing");
            }
        }
    }
}

/// A smooth surface is a mirror: one bounce, nothing lost.
#[test]
fn smooth_surfaces_bounce_once() {
    let walked = walk(1e-5, [0.5; 2], Walks { paths: 1 << 14, seed: 1 }, &|_| [1.0; 3]).unwrap();
    assert!((walked.bounces[0][0].value - 1.0).abs() < 1e-6, "{walked:?}");
    assert!(walked.multiple[0].value < 1e-6);
}

#[test]
fn threads_do_not_change_a_bit() {
    let walks = Walks { paths: 1 << 12, seed: 3 };
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| walk(0.6, [0.3; 2], walks, &|c| [1.0, 0.9, fresnel::conductor(0.2, 3.0, c)]).unwrap())
    };
    let one = run(1);
    assert_eq!(one, run(3));
    assert_eq!(one, run(8));
}

#[test]
fn bad_inputs_are_refused_by_name() {
    let refused = |alpha, mu, paths, f: f64| {
        walk(alpha, mu, Walks { paths, seed: 0 }, &|_| [f; 3]).unwrap_err().to_string()
    };
    assert!(refused(0.0, [0.5; 2], 64, 1.0).contains("alpha = 0.0"));
    assert!(refused(f64::NAN, [0.5; 2], 64, 1.0).contains("alpha = NaN"));
    assert!(refused(0.5, [0.5, 1.5], 64, 1.0).contains("mu = 1.5"));
    assert!(refused(0.5, [0.0; 2], 64, 1.0).contains("mu = 0.0"));
    assert!(refused(0.5, [0.6, 0.5], 64, 1.0).contains("mu = 0.5"));
    assert!(refused(0.5, [0.5; 2], 31, 1.0).contains("paths"));
    assert!(refused(0.5, [0.5; 2], 64, 1.1).contains("reflectance = 1.1"));
}
