//! Starts whose signs are not those declared, and ties among the best.
#![allow(clippy::disallowed_methods)]

use crate::fit_support;

use fit_support::parse;
use lobefit_fit::{Condition, Constraint, Goal, Options, Samples, optimise};

fn grid(f: impl Fn(f64, f64) -> f64) -> Samples {
    let at = |i: usize| 0.05 + 0.95 * i as f64 / 15.0;
    let places: Vec<(f64, f64)> = (0..256).map(|k| (at(k / 16), at(k % 16))).collect();
    Samples {
        inputs: vec![places.iter().map(|p| p.0).collect(), places.iter().map(|p| p.1).collect()],
        scale: vec![1.0; places.len()],
        target: places.iter().map(|p| f(p.0, p.1)).collect(),
    }
}

/// Planted exponents of every combination of signs are found from declared ones that are all
/// positive.
#[test]
fn the_signs_of_exponents_are_found() {
    let formula = "override c: f32 = 1.0; override p: f32 = 1.0; override q: f32 = 1.0;
        fn f(x: f32, y: f32) -> f32 { return 1.0 + c * pow(x, p) * pow(y, q); }";
    for [p, q] in [[1.6, 0.7], [-1.6, 0.7], [1.2, -0.9], [-1.3, -0.8], [-0.6, -2.1]] {
        let samples = grid(|x, y| 1.0 + 0.7 * x.powf(p) * y.powf(q));
        for goal in [Goal::Rms, Goal::Max] {
            let fitted = optimise(&parse(formula), &samples, &[], &Options::new(goal)).expect("a fit");
            let [_, a, b] = fitted.coefficients[..] else { panic!("{fitted:?}") };
            assert!((a - p).abs() < 1e-5 && (b - q).abs() < 1e-5, "{p} {q} {goal}: {fitted:?}");
        }
    }
}

/// The same inside exponentials and of more exponents than are combined; from one start alone
/// nothing is turned.
#[test]
fn signs_inside_exponentials_are_found() {
    let formula = "override a: f32 = 4.0; override b: f32 = 4.0; override c: f32 = 4.0; override d: f32 = 4.0;
        fn f(x: f32, y: f32) -> f32 { return exp2(a * x) + exp2(b * y) * x + exp2(c * x * y) + y * exp2(d * x * x); }";
    let samples = grid(|x, y| {
        (-5.0 * x).exp2() + (-4.0 * y).exp2() * x + (-3.0 * x * y).exp2() + y * (-4.5 * x * x).exp2()
    });
    let found = |starts: usize| {
        let options = Options { starts, ..Options::new(Goal::Rms) };
        optimise(&parse(formula), &samples, &[], &options).expect("a fit").rms
    };
    assert!(found(8) < 1e-6, "{}", found(8));
}

fn line(count: usize, target: impl Fn(f64) -> f64) -> Samples {
    let x: Vec<f64> = (0..count).map(|i| i as f64 / (count - 1) as f64).collect();
    Samples { target: x.iter().map(|x| target(*x)).collect(), scale: vec![1.0; count], inputs: vec![x] }
}

const BENT: &str = "override a: f32 = 0.5; override b: f32 = -0.4;
    fn f(x: f32) -> f32 { return x * (a + b * (1.0 - x)); }";

/// At x = 0 the formula is 0 and errs by 1 whatever its parameters are: of all that err no more,
/// the least squares are taken.
#[test]
fn of_equal_largest_errors_the_least_square_is_taken() {
    let samples = line(101, |x| if x == 0.0 { 1.0 } else { 0.3 * x + 0.1 * x * (1.0 - x) });
    let fitted = optimise(&parse(BENT), &samples, &[], &Options::new(Goal::Max)).expect("a fit");
    let [a, b] = fitted.coefficients[..] else { panic!("{fitted:?}") };
    assert!((a - 0.3).abs() < 1e-6 && (b - 0.1).abs() < 1e-6, "{fitted:?}");
    assert!((fitted.max - 1.0).abs() < 1e-9 && fitted.termination.is_converged(), "{fitted:?}");
}

/// A ceiling of 1/2 under a target of x makes the error at x = 1 a half: a is 1/2, and b as large
/// as the ceiling lets it be.
#[test]
fn of_equal_largest_errors_within_a_range_the_least_square_is_taken() {
    let samples = line(101, |x| x);
    let condition = Condition::AtMost { points: samples.inputs.clone(), values: vec![0.5; 101] };
    let ceiling = Constraint { name: "ceiling".into(), condition };
    let fitted = optimise(&parse(BENT), &samples, std::slice::from_ref(&ceiling), &Options::new(Goal::Max))
        .expect("a fit");
    let [a, b] = fitted.coefficients[..] else { panic!("{fitted:?}") };
    // 1/2 x + b x (1 - x) <= 1/2 at the last place before 1.
    assert!((a - 0.5).abs() < 1e-5 && (b - 0.5 / 0.99).abs() < 1e-4, "{fitted:?}");
    assert!((fitted.max - 0.5).abs() < 1e-5, "{fitted:?}");
}

/// What the samples do not see and a constraint does is determined.
#[test]
fn a_constraint_determines_what_the_samples_do_not_see() {
    let formula = parse(
        "override a: f32 = 0.5; override b: f32 = 0.5; fn f(x: f32) -> f32 { return a * x + b * max(x - 2.0, 0.0); }",
    );
    let samples = line(50, |x| x * x);
    let condition = Condition::Equal { points: vec![vec![3.0]], values: vec![4.0] };
    let exact = Constraint { name: "4 at 3".into(), condition };
    for goal in [Goal::Max, Goal::Rms] {
        let free = optimise(&formula, &samples, &[], &Options::new(goal)).expect("a fit");
        assert_eq!((free.rank, free.undetermined.len()), (1, 1), "{free:?}");
        let held =
            optimise(&formula, &samples, std::slice::from_ref(&exact), &Options::new(goal)).expect("a fit");
        assert_eq!((held.rank, held.undetermined.len()), (2, 0), "{held:?}");
    }
}
