//! Two routes: quadrature over polar angles in closed azimuth, and Monte Carlo over visible normals
//! or over lights.

use lobefit::data::Smith;
use lobefit_truth::integrate::monte_carlo::{self, Draw, Points, Run, Sampled};
use lobefit_truth::integrate::reflection::{TOLERANCE, average, reflection};

fn run(samples: u64, seed: u64, points: Points, draw: Draw) -> Run {
    Run { samples, seed, points, draw }
}

/// z-scores of many estimates: standard normal in the mean of squares, none beyond 5.5 (32
/// replicas: Student's t with 31 degrees of freedom, two-sided 5e-6).
fn assert_scores(scores: &[f64]) {
    let mean_square = scores.iter().map(|z| z * z).sum::<f64>() / scores.len() as f64;
    let worst = scores.iter().fold(0.0_f64, |a, z| a.max(z.abs()));
    assert!(worst < 5.5, "worst z {worst} of {scores:?}");
    assert!((0.3..2.0).contains(&mean_square), "mean square of z {mean_square}");
}

fn score(sampled: Sampled, truth: f64) -> f64 {
    (sampled.value - truth) / sampled.standard_error
}

#[test]
fn sobol_and_quadrature_agree() {
    for smith in [Smith::Correlated, Smith::Separable] {
        let mut scores = Vec::new();
        for (index, alpha) in [1e-3, 0.01, 0.1, 0.4, 1.0].into_iter().enumerate() {
            for (shift, mu) in [1e-3, 0.02, 0.2, 0.7, 0.999].into_iter().enumerate() {
                let settings = run(1 << 17, (10 * index + shift) as u64, Points::Sobol, Draw::VisibleNormal);
                let guess = monte_carlo::reflection(smith, alpha, mu, settings).expect("in the domain");
                let truth = reflection(smith, alpha, mu, TOLERANCE).expect("in the domain");
                scores.push(score(guess.e, truth.e));
                scores.push(score(guess.b, truth.b));
                assert!((guess.e.value + guess.loss.value - 1.0).abs() < 1e-12);
                assert!(guess.e.standard_error < 2e-4, "{alpha} {mu}: {:?}", guess.e);
            }
        }
        assert_scores(&scores);
    }
}

#[test]
fn every_estimator_aims_at_the_same_truth() {
    let (alpha, mu) = (0.3, 0.4);
    let truth = reflection(Smith::Correlated, alpha, mu, TOLERANCE).expect("in the domain");
    let mut errors = Vec::new();
    for (points, draw) in [
        (Points::Random, Draw::UniformLight),
        (Points::Random, Draw::VisibleNormal),
        (Points::Sobol, Draw::VisibleNormal),
    ] {
        let settings = run(1 << 18, 3, points, draw);
        let guess = monte_carlo::reflection(Smith::Correlated, alpha, mu, settings).expect("in the domain");
        assert!(score(guess.e, truth.e).abs() < 5.5, "{points:?} {draw:?}: {guess:?}");
        assert!(score(guess.a, truth.a).abs() < 5.5, "{points:?} {draw:?}: {guess:?}");
        errors.push(guess.e.standard_error);
    }
    assert!(
        errors[0] > 3.0 * errors[1] && errors[1] > 3.0 * errors[2],
        "each is better than the last: {errors:?}"
    );
}

/// Negative control: the test above can see a wrong lobe.
#[test]
fn the_other_shadowing_form_is_told_apart() {
    let settings = run(1 << 17, 1, Points::Sobol, Draw::VisibleNormal);
    let guess = monte_carlo::reflection(Smith::Separable, 0.5, 0.2, settings).expect("in the domain");
    let truth = reflection(Smith::Correlated, 0.5, 0.2, TOLERANCE).expect("in the domain");
    assert!(score(guess.e, truth.e).abs() > 100.0);
}

#[test]
fn averages_agree() {
    for (seed, alpha) in [0.02, 0.2, 0.6, 1.0].into_iter().enumerate() {
        for smith in [Smith::Correlated, Smith::Separable] {
            let settings = run(1 << 17, seed as u64, Points::Sobol, Draw::VisibleNormal);
            let (e_avg, loss_avg) = monte_carlo::average(smith, alpha, settings).expect("in the domain");
            let truth = average(smith, alpha, TOLERANCE).expect("in the domain");
            assert!(score(e_avg, truth.e_avg).abs() < 5.5, "{alpha}: {e_avg:?} {truth:?}");
            assert!(score(loss_avg, truth.loss_avg).abs() < 5.5, "{alpha}: {loss_avg:?} {truth:?}");
        }
    }
}

#[test]
fn same_seed_same_bits_and_limits_are_refused() {
    let settings = run(1 << 12, 9, Points::Sobol, Draw::VisibleNormal);
    let pool = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
    let with =
        |threads| pool(threads).install(|| monte_carlo::reflection(Smith::Correlated, 0.2, 0.3, settings));
    assert_eq!(with(1), with(3));
    for (alpha, mu, samples, word) in
        [(0.0, 0.5, 64, "alpha"), (0.5, 0.0, 64, "mu"), (0.5, 0.5, 31, "samples")]
    {
        let settings = run(samples, 9, Points::Sobol, Draw::VisibleNormal);
        let error = monte_carlo::reflection(Smith::Correlated, alpha, mu, settings).expect_err("refused");
        assert!(error.to_string().contains(word), "{error}");
    }
}
