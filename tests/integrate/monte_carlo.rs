//! Two routes: quadrature over polar angles in closed azimuth, and Monte Carlo over visible normals
//! or over lights.

use lobefit::data::Smith;
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::integrate::monte_carlo::{self, Draw, Points, Run, Sampled};
use lobefit_truth::integrate::reflection::{TOLERANCE, average, reflection};
use lobefit_truth::quantity::{
    BECKMANN_GLASS, BECKMANN_REFLECTION, GGX_GLASS, GGX_REFLECTION, GgxAverage, GgxReflectionAniso, Quantity,
    Variant,
};

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

/// Every way to draw and every kind of points, at an easy and at a hard point of each lobe: E, A, B and
/// loss lie about those of the quadrature as their standard errors say.
#[test]
fn every_estimator_aims_at_the_same_truth() {
    let variant = Smith::Correlated.into();
    let mut scores = Vec::new();
    for quantity in [GGX_REFLECTION as &dyn Quantity, BECKMANN_REFLECTION] {
        for at in [[0.5, 0.7], [0.1, 0.15]] {
            let truth = quantity.at(&variant, &at, TOLERANCE).expect("in the domain");
            for draw in quantity.draws() {
                for points in Points::ALL {
                    let settings = run(1 << 16, scores.len() as u64, points, *draw);
                    let guess = quantity.second_opinion(&variant, &at, settings).expect("in the domain");
                    scores.extend(guess.iter().zip(&truth).map(|(guess, truth)| score(*guess, *truth)));
                }
            }
        }
    }
    assert_eq!(scores.len(), 4 * 4 * 3 * 4, "points of lobes, draws, sequences, outputs");
    assert_scores(&scores);
}

/// Anisotropic lobes at a fixed azimuth and over all, averages, and glass from either side.
#[test]
fn every_draw_aims_at_the_truth_of_other_lobes() {
    let mut glass = Variant::from(Smith::Correlated);
    glass.side = Some(Side::Inside);
    let cases: [(&dyn Quantity, Variant, Vec<f64>); 5] = [
        (&GgxReflectionAniso, Smith::Separable.into(), vec![0.2, 0.6, 0.5, 0.4]),
        (&GgxReflectionAniso, Smith::Correlated.into(), vec![0.1, 0.4, 0.2, f64::NAN]),
        (&GgxAverage, Smith::Correlated.into(), vec![0.6]),
        (GGX_GLASS, glass.clone(), vec![0.3, 0.5, 1.5]),
        (BECKMANN_GLASS, glass, vec![0.3, 0.8, 1.4]),
    ];
    let mut scores = Vec::new();
    for (quantity, variant, at) in &cases {
        let truth = quantity.at(variant, at, quantity.tolerance(variant)).expect("in the domain");
        for (seed, draw) in quantity.draws().iter().enumerate() {
            for points in Points::ALL {
                let settings = run(1 << 15, seed as u64, points, *draw);
                let guess = quantity.second_opinion(variant, at, settings).expect("in the domain");
                scores.extend(guess.iter().zip(&truth).map(|(guess, truth)| score(*guess, *truth)));
            }
        }
    }
    assert_scores(&scores);
}

/// Each way to draw has less noise than the one before; strata take more of it, Sobol points still more.
#[test]
fn better_draws_and_better_points_err_less() {
    let error = |points, draw| {
        let settings = run(1 << 16, 3, points, draw);
        let guess = monte_carlo::reflection(Smith::Correlated, 0.3, 0.4, settings).expect("in the domain");
        guess.e.standard_error
    };
    let [uniform, cosine, normal, visible] = Draw::ALL.map(|draw| error(Points::Random, draw));
    assert!(uniform > 3.0 * visible && cosine > 2.0 * visible && normal > visible, "{normal} {visible}");
    let [random, stratified, sobol] = Points::ALL.map(|points| error(points, Draw::VisibleNormal));
    assert!(random > 3.0 * stratified && stratified > 1.5 * sobol, "{random} {stratified} {sobol}");
}

/// A light alone does not say which facet refracts towards it.
#[test]
fn glass_draws_normals_alone() {
    let settings = run(1 << 10, 1, Points::Random, Draw::CosineLight);
    let error = monte_carlo::glass(Smith::Correlated, 0.3, 0.5, 1.5, Side::Outside, settings);
    let error = error.expect_err("refused").to_string();
    assert!(error.contains("draw = cosine"), "{error}");
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
