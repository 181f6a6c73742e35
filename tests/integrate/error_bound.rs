//! The error column is a bound: against a rule with four times the nodes at 10 000 random points,
//! half of them crowded towards grazing and half towards normal incidence.
#![allow(
    clippy::disallowed_methods,
    reason = "a test may use the platform's functions: its tolerances allow for them"
)]

use lobefit::data::Smith;
use lobefit_truth::integrate::reflection::{Effort, TOLERANCE, at_effort, loss, reflection, split};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

struct Trial {
    alpha: f64,
    mu: f64,
    bound: f64,
    error: f64,
    loss_bound: f64,
    loss_error: f64,
}

fn trial(index: u64, smith: Smith) -> Trial {
    let mut random = Pcg64::seed_from_u64(index);
    let alpha = 10_f64.powf(-4.0 * random.random::<f64>());
    let near = 10_f64.powf(-4.0 * random.random::<f64>());
    let mu = if index.is_multiple_of(2) { near } else { (1.0 - near).max(1e-4) };
    let ladder = Effort::ladder();
    let value = at_effort(smith, alpha, mu, &ladder[0], &ladder[1]).expect("finite");
    let (e, b) = split(smith, alpha, mu, &ladder[3]);
    let taken = loss(smith, alpha, mu, &ladder[3].outer);
    let errors = [value.e - e, value.b - b, value.a - (e - b), value.loss - taken];
    Trial {
        alpha,
        mu,
        bound: value.error,
        error: errors.iter().fold(0.0, |worst, x| x.abs().max(worst)),
        loss_bound: value.loss_error,
        loss_error: (value.loss / taken - 1.0).abs(),
    }
}

#[test]
fn error_is_a_bound_and_not_a_wasteful_one() {
    for smith in [Smith::Correlated, Smith::Separable] {
        let trials: Vec<Trial> = (0..10_000_u64).into_par_iter().map(|i| trial(i, smith)).collect();
        let above = trials.iter().filter(|t| t.error > t.bound || t.loss_error > t.loss_bound).count();
        assert!(above <= 10, "{smith:?}: {above} of 10 000 above their bound");
        // Not wastefully large: within a thousand times the error, or a hundredth of the promise,
        // where rounding rules.
        let wide = trials.iter().filter(|t| t.bound > (1e3 * t.error).max(1e-2 * TOLERANCE)).count();
        assert!(wide <= 1000, "{smith:?}: {wide} of 10 000 bounds are wasteful");
        let worst = trials.iter().max_by(|a, b| a.error.total_cmp(&b.error)).expect("trials");
        assert!(worst.error < 1e-12, "{smith:?}: {:e} at {} {}", worst.error, worst.alpha, worst.mu);
        println!("{smith:?}: above {above}, wide {wide}, worst {:e}", worst.error);
    }
}

#[test]
fn the_promise_holds_where_it_is_given() {
    let points: Vec<(f64, f64)> = (0..400_u64)
        .map(|i| {
            let mut random = Pcg64::seed_from_u64(1_000_000 + i);
            (10_f64.powf(-4.0 * random.random::<f64>()), 10_f64.powf(-4.0 * random.random::<f64>()))
        })
        .chain([(1e-4, 1e-4), (1e-4, 1.0), (1.0, 1e-4), (1.0, 1.0)])
        .collect();
    let promise = lobefit_promises::quantity("ggx-reflection");
    for smith in [Smith::Correlated, Smith::Separable] {
        for (alpha, mu) in &points {
            let value = reflection(smith, *alpha, *mu, TOLERANCE).expect("the promise");
            let kept = value.error <= promise.absolute && Some(value.loss_error) <= promise.loss_relative;
            assert!(kept, "{smith:?} {alpha} {mu}: {value:?}");
        }
    }
}
