//! Ends that look like minima to first order: products and powers of parameters that start, or end,
//! at 0.
#![allow(clippy::disallowed_methods)]

use crate::fit_support;

use fit_support::parse;
use lobefit_fit::{
    Condition, Constraint, Fitted, Goal, Options, Samples, SecondOrder, Termination, optimise,
};

fn curve(n: usize, f: impl Fn(f64) -> f64) -> Samples {
    let x: Vec<f64> = (0..n).map(|i| i as f64 / (n - 1) as f64).collect();
    Samples { scale: vec![1.0; n], target: x.iter().map(|&x| f(x)).collect(), inputs: vec![x] }
}

/// From the declared start alone.
fn fit(source: &str, samples: &Samples, goal: Goal) -> Fitted {
    let options = Options { starts: 1, ..Options::new(goal) };
    optimise(&parse(source), samples, &[], &options).unwrap_or_else(|e| panic!("{source}: {e}"))
}

const GOALS: [Goal; 3] = [Goal::Rms, Goal::Power(8.0), Goal::Max];

#[test]
fn a_product_that_starts_at_a_saddle_leaves_it() {
    let declared = |starts: [f32; 3], body: &str| {
        let [a, b, c] = starts;
        format!(
            "override a: f32 = {a:?}; override b: f32 = {b:?}; override c: f32 = {c:?}; fn f(x: f32) -> f32 {{ return {body}; }}"
        )
    };
    let up = curve(101, |x| 1.0 + 0.5 * x * (-2.0 * x).exp2());
    let down = curve(101, |x| 1.0 - 0.3 * x);
    for (source, samples) in [
        // All derivatives are 0: the product's by a and b, and that by c.
        (declared([0.0, 0.0, 1.0], "1.0 + a * b * x * exp2(-c * x)"), &up),
        // The saddle is of third order: so are the second derivatives.
        (declared([0.0, 0.0, 0.0], "1.0 + a * b * c * x"), &down),
        // A square can leave 0 either way, and must leave it.
        (declared([0.0, 0.0, 1.0], "1.0 - a * a * x + 0.0 * b * c"), &down),
        // Not at 0: the product of two differences.
        (declared([2.0, -1.0, 0.0], "1.0 + (a - 2.0) * (b + 1.0) * x + c * x * x"), &down),
    ] {
        for goal in GOALS {
            let fitted = fit(&source, samples, goal);
            assert!(fitted.max < 1e-6, "{goal}: {source}: {fitted:?}");
            assert!(fitted.termination.is_converged(), "{goal}: {source}: {fitted:?}");
        }
    }
}

/// Where the residuals cannot vanish, the end is as good as that of the same family without the
/// product.
#[test]
fn beyond_a_saddle_lies_the_minimum_of_the_product() {
    let samples = curve(101, |x| (1.0 + 3.0 * x).ln());
    let plain = "override a: f32 = 0.5; override b: f32 = 0.5; fn f(x: f32) -> f32 { return a + b * x; }";
    let product = "override a: f32 = 0.5; override b: f32 = 0.0; override c: f32 = 0.0;
        fn f(x: f32) -> f32 { return a + b * c * x; }";
    for goal in GOALS {
        let (plain, product) = (fit(plain, &samples, goal), fit(product, &samples, goal));
        assert!((product.value / plain.value - 1.0).abs() < 1e-4, "{goal}: {product:?} {plain:?}");
        assert!(product.termination.is_converged(), "{goal}: {product:?}");
    }
}

/// A minimum at which derivatives vanish for good is one: nothing is gained beside it.
#[test]
fn a_minimum_with_vanishing_derivatives_stays_one() {
    let source =
        "override a: f32 = 0.0; override b: f32 = 0.5; fn f(x: f32) -> f32 { return b + a * a * x; }";
    // Only a negative a * a could follow the slope.
    let samples = curve(101, |x| 1.0 - 0.5 * x);
    for goal in GOALS {
        let fitted = fit(source, &samples, goal);
        assert!(fitted.coefficients[0].abs() < 1e-3, "{goal}: {fitted:?}");
        assert!(
            !matches!(fitted.termination, Termination::Saddle | Termination::Stalled),
            "{goal}: {fitted:?}"
        );
        assert!((fitted.coefficients[1] - 0.75).abs() < 1e-3, "{goal}: {fitted:?}");
    }
}

/// b c times values to which the targets are orthogonal: its least squares are at 0, where nothing
/// is gained to first order, but the largest residual falls from 1 to 0.85 at b c = 0.15. Without a
/// saddle to leave, the better coefficients are kept, but not called a minimum.
#[test]
fn the_better_coefficients_are_kept_where_no_saddle_may_be_left() {
    let source = "override b: f32 = 0.0; override c: f32 = 0.0; fn f(x: f32) -> f32 { return b * c * x; }";
    let samples = Samples {
        scale: vec![1.0; 4],
        target: vec![1.0, 0.25, 0.0, 0.0],
        inputs: vec![vec![1.0, -4.0, 0.0, 0.0]],
    };
    let fitted = |saddles| {
        let options = Options { starts: 1, saddles, ..Options::new(Goal::Max) };
        optimise(&parse(source), &samples, &[], &options).unwrap_or_else(|e| panic!("{e}"))
    };
    let (stopped, free) = (fitted(0), fitted(6));
    assert_eq!(stopped.termination, Termination::Saddle, "{stopped:?}");
    assert!(!stopped.termination.is_converged());
    assert!(free.termination.is_converged(), "{free:?}");
    for fitted in [stopped, free] {
        assert!((fitted.max - 0.85).abs() < 1e-4, "{fitted:?}");
    }
}

/// Least squares, likewise: from a product at 0 to what it is good for.
#[test]
fn least_squares_keep_the_better_coefficients_too() {
    let source = "override a: f32 = 0.5; override b: f32 = 0.0; override c: f32 = 0.0; fn f(x: f32) -> f32 { return a + b * c * x; }";
    let samples = curve(101, |x| (1.0 + 3.0 * x).ln());
    for goal in [Goal::Rms, Goal::Power(8.0)] {
        let options = Options { starts: 1, saddles: 0, ..Options::new(goal) };
        let stopped = optimise(&parse(source), &samples, &[], &options).unwrap_or_else(|e| panic!("{e}"));
        let free = fit(source, &samples, goal);
        assert!((stopped.value / free.value - 1.0).abs() < 1e-4, "{goal}: {stopped:?} {free:?}");
        // A climb through the norms begins beyond the saddle.
        let named = stopped.stages[0].end;
        assert_eq!(named, Termination::Saddle, "{goal}: {stopped:?}");
    }
}

/// At a = b = 0 under a ceiling: the derivatives by both vanish, and a b > 0 lowers the mean square
/// within the ceiling.
#[test]
fn saddles_within_constraints_are_left() {
    let formula = "override a: f32 = 0.0; override b: f32 = 0.0; override c: f32 = 1.0;
        fn f(x: f32) -> f32 { return x * (c + a * b * (1.0 - x)); }";
    let samples = curve(101, |x| x);
    let condition = Condition::AtMost { points: samples.inputs.clone(), values: vec![0.5; 101] };
    let ceiling = [Constraint { name: "ceiling".into(), condition }];
    let from = |saddles: usize| {
        let options = Options { starts: 1, saddles, ..Options::new(Goal::Rms) };
        optimise(&parse(formula), &samples, &ceiling, &options).expect("a fit")
    };
    let fitted = from(6);
    // With a = b = 0 it is 0.29; with c = 1/2 and a b = 1/2 the ceiling is reached.
    assert!(fitted.rms < 0.226 && fitted.termination.is_converged(), "{fitted:?}");
    assert!(fitted.constraints.iter().all(|held| held.worst <= held.tolerance), "{fitted:?}");
    assert_eq!(from(0).termination, Termination::Saddle);
}

/// Where the formula is not finite a step beside its minimum there are no second derivatives: the
/// end is not said to be checked.
#[test]
fn a_minimum_beside_the_end_of_the_reals_is_not_said_to_be_checked() {
    let near = "override a: f32 = 2e-5; fn f(x: f32) -> f32 { return 0.001 * sqrt(a) * x; }";
    let far = "override a: f32 = 2.0; fn f(x: f32) -> f32 { return 0.001 * sqrt(a) * x; }";
    let even = |slope: f64| {
        let samples = curve(101, |x| 1.0 + slope * (2.0 * x - 1.0));
        let inputs = samples.inputs.iter().map(|column| column.iter().map(|x| 2.0 * x - 1.0).collect());
        Samples { inputs: inputs.collect(), ..samples }
    };
    for (source, least, second_order) in
        [(near, 1e-5_f64, SecondOrder::NotChecked), (far, 1.0, SecondOrder::Checked)]
    {
        for goal in [Goal::Rms, Goal::Power(4.0)] {
            let fitted = fit(source, &even(1e-3 * least.sqrt()), goal);
            assert!(fitted.termination.is_converged(), "{goal}: {fitted:?}");
            assert_eq!(fitted.second_order, second_order, "{goal}: {fitted:?}");
        }
    }
    let exact = fit(far, &even(1e-3), Goal::Max);
    assert_eq!(exact.second_order, SecondOrder::Unused, "programs do not use second derivatives");
}
