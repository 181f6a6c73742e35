//! Starts with a pole among the samples: no obstacle where the best of all coefficients can be had
//! without them, else named.
#![allow(clippy::disallowed_methods)]

use crate::fit_support;

use fit_support::parse;
use lobefit_fit::{
    Condition, Constraint, FitError, Fitted, Gap, Goal, Options, Samples, Termination, optimise,
};

fn curve(n: usize, f: impl Fn(f64) -> f64) -> Samples {
    let x: Vec<f64> = (0..n).map(|i| i as f64 / (n - 1) as f64).collect();
    Samples { scale: vec![1.0; n], target: x.iter().map(|&x| f(x)).collect(), inputs: vec![x] }
}

/// (a + b x)/(1 + c x) with c at `start`; at -20 the pole stays in (0, 1) for all starts around it.
fn rational(start: f32) -> String {
    format!(
        "override a: f32 = 1.0; override b: f32 = 1.0; override c: f32 = {start:?};
         fn f(x: f32) -> f32 {{ return (a + b * x) / (1.0 + c * x); }}"
    )
}

fn fit(source: &str, samples: &Samples, constraints: &[Constraint], goal: Goal) -> Result<Fitted, FitError> {
    optimise(&parse(source), samples, constraints, &Options::new(goal))
}

#[test]
fn a_rational_form_is_fitted_whatever_its_declared_starts() {
    let samples = curve(301, |x| (1.0 + 3.0 * x).ln());
    let pin = Constraint {
        name: "0 at 0".into(),
        condition: Condition::Equal { points: vec![vec![0.0]], values: vec![0.0] },
    };
    for constraints in [&[][..], &[pin]] {
        for goal in [Goal::Max, Goal::Rms, Goal::Power(6.0)] {
            let near = fit(&rational(1.0), &samples, constraints, goal).unwrap_or_else(|e| panic!("{e}"));
            let pole = fit(&rational(-20.0), &samples, constraints, goal).unwrap_or_else(|e| panic!("{e}"));
            assert!((pole.value / near.value - 1.0).abs() < 1e-5, "{goal}: {pole:?} {near:?}");
            assert_eq!(pole.termination == Termination::GlobalMinimax, goal == Goal::Max, "{pole:?}");
        }
    }
}

#[test]
fn a_denominator_that_is_negative_throughout_is_found_without_a_start() {
    let samples = curve(101, |x| 1.0 / (x - 1.5));
    let source = "override a: f32 = 1.0; override b: f32 = -0.5; fn f(x: f32) -> f32 { return a / (x + b); }";
    let options = Options { starts: 1, ..Options::new(Goal::Max) };
    let fitted = optimise(&parse(source), &samples, &[], &options).unwrap_or_else(|e| panic!("{e}"));
    assert!(fitted.max < 1e-9 && (fitted.coefficients[1] + 1.5).abs() < 1e-8, "{fitted:?}");
}

#[test]
fn a_pole_of_the_starts_is_named_with_the_divisor_and_the_remedy() {
    let samples = curve(101, |x| 1.0 + x);
    let source = "override a: f32 = 1.0; override c: f32 = -5.0;\n\
        fn f(x: f32) -> f32 { return a / (1.0 + c * c * c * x); }";
    let error = fit(source, &samples, &[], Goal::Max).expect_err("a pole");
    let FitError::PoleAtStart { place, .. } = &error else { panic!("{error:?}") };
    assert_eq!((place.line, place.excerpt.as_str()), (2, "1.0 + c * c * c * x"));
    let told = error.to_string();
    for words in
        ["with the parameters at their declared starts", "x = 0.01", "declare starts", "override NAME"]
    {
        assert!(told.contains(words), "{words}: {told}");
    }
}

/// (1 + a x)/(d + b x) over points in pairs x, -x: their denominators sum to 2 d, so that they
/// cannot all be negative. However small d is, multipliers prove it, and the best of the positive
/// side is the best of all.
#[test]
fn a_side_without_coefficients_is_excluded_by_proof() {
    let x: Vec<f64> = (1..=20).flat_map(|i| [f64::from(i) / 20.0, -f64::from(i) / 20.0]).collect();
    let target = x.iter().map(|x| 1.0 + x * x * x).collect();
    let samples = Samples { scale: vec![1.0; x.len()], target, inputs: vec![x] };
    for least in ["1e-6", "1.0"] {
        let source = format!(
            "override a: f32 = 0.0; override b: f32 = 0.0; fn f(x: f32) -> f32 {{ return (1.0 + a * x) / ({least} + b * x); }}"
        );
        let fitted = fit(&source, &samples, &[], Goal::Max).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(fitted.termination, Termination::GlobalMinimax, "{least}: {fitted:?}");
        assert!(matches!(fitted.gap, Gap::Global(gap) if gap <= 1e-4), "{least}: {fitted:?}");
    }
}
