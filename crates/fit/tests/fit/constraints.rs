//! Coefficients within constraints: known optima, brute force, what cannot be kept.
#![allow(clippy::disallowed_methods)]

use crate::fit_support;

use fit_support::{furnace, hypothesis, parse};
use lobefit_fit::{
    Condition, Constraint, FitError, Fitted, Gap, Goal, Options, Samples, Termination, optimise, round_to_f32,
};
use lobefit_shade::Hypothesis;

const LINE: &str = "override a: f32 = 0.3; override b: f32 = 0.9; fn f(x: f32) -> f32 { return a + b * x; }";

fn grid(n: usize) -> Vec<f64> {
    (0..n).map(|i| i as f64 / (n - 1) as f64).collect()
}

fn curve(n: usize, f: impl Fn(f64) -> f64) -> Samples {
    let x = grid(n);
    Samples { scale: vec![1.0; n], target: x.iter().map(|&x| f(x)).collect(), inputs: vec![x] }
}

fn constraint(name: &str, condition: Condition) -> Constraint {
    Constraint { name: name.to_string(), condition }
}

fn equal(at: &[(f64, f64)]) -> Constraint {
    let (points, values) = at.iter().copied().unzip();
    constraint("exact at the ends", Condition::Equal { points: vec![points], values })
}

fn fit(h: &Hypothesis, samples: &Samples, constraints: &[Constraint], goal: Goal) -> Fitted {
    let fitted =
        optimise(h, samples, constraints, &Options::new(goal)).unwrap_or_else(|e| panic!("{goal}: {e}"));
    println!("{goal}: {fitted:?}");
    assert!(fitted.termination.is_converged(), "{goal}: {fitted:?}");
    fitted
}

fn close(found: &[f64], expected: &[f64], tolerance: f64) {
    let off = found.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(off < tolerance && found.len() == expected.len(), "{found:?} instead of {expected:?}");
}

#[test]
fn a_line_that_is_pinned_at_both_ends_is_the_chord() {
    for goal in [Goal::Max, Goal::Rms, Goal::Power(6.0)] {
        let fitted = fit(&parse(LINE), &curve(201, |x| x * x), &[equal(&[(0.0, 0.0), (1.0, 1.0)])], goal);
        close(&fitted.coefficients, &[0.0, 1.0], 1e-9);
        assert!((fitted.max - 0.25).abs() < 1e-9);
        assert_eq!(fitted.constraints.len(), 1);
        let held = &fitted.constraints[0];
        assert!(held.worst <= held.tolerance && held.tolerance < 1e-6 && held.points == 2, "{held:?}");
    }
}

#[test]
fn lines_on_one_side_of_a_parabola() {
    // Above: the chord, x; below: the tangent in the middle, x - 1/4. Both are off by 1/4.
    let samples = curve(401, |x| x * x);
    let side = |above: bool| {
        let (points, values) = (samples.inputs.clone(), samples.target.clone());
        constraint(
            "one side",
            if above { Condition::AtLeast { points, values } } else { Condition::AtMost { points, values } },
        )
    };
    let above = fit(&parse(LINE), &samples, &[side(true)], Goal::Max);
    close(&above.coefficients, &[0.0, 1.0], 1e-6);
    let below = fit(&parse(LINE), &samples, &[side(false)], Goal::Max);
    close(&below.coefficients, &[-0.25, 1.0], 1e-5);
    // Least squares from above touches at both ends as well; from below at x with equal weight on
    // both sides: 1/2.
    close(&fit(&parse(LINE), &samples, &[side(true)], Goal::Rms).coefficients, &[0.0, 1.0], 1e-6);
    close(&fit(&parse(LINE), &samples, &[side(false)], Goal::Rms).coefficients, &[-0.25, 1.0], 1e-4);
    for fitted in [above, below] {
        assert!((fitted.max - 0.25).abs() < 1e-6);
        // Kept after rounding to f32, by the caller's own arithmetic.
        let [a, b] = round_to_f32(&fitted.coefficients).unwrap()[..] else { panic!() };
        let off = |x: &f64| f64::from(a) + f64::from(b) * x - x * x;
        let held = &fitted.constraints[0];
        let wrong =
            samples.inputs[0].iter().map(|x| if fitted.coefficients[0] < -0.1 { off(x) } else { -off(x) });
        let wrong = wrong.fold(0.0, f64::max);
        assert!(wrong <= held.tolerance && (wrong - held.worst).abs() < 1e-12, "{wrong} {held:?}");
    }
}

#[test]
fn a_constraint_that_is_kept_anyway_changes_nothing() {
    let samples = curve(201, |x| x * x);
    let loose = constraint("loose", Condition::AtLeast { points: vec![grid(11)], values: vec![-1.0; 11] });
    for goal in [Goal::Max, Goal::Rms, Goal::Power(8.0)] {
        let (free, kept) = (
            fit(&parse(LINE), &samples, &[], goal),
            fit(&parse(LINE), &samples, std::slice::from_ref(&loose), goal),
        );
        close(&kept.coefficients, &free.coefficients, 1e-5);
        assert_eq!(kept.constraints[0].worst, 0.0);
        assert_ne!(kept.termination, Termination::Constrained);
    }
}

#[test]
fn exponentials_through_two_points_agree_with_brute_force() {
    let h = parse(
        "override a: f32 = 1.0; override b: f32 = 1.0; override c: f32 = 0.1;
         fn f(x: f32) -> f32 { return a * exp(-b * x) + c; }",
    );
    let truth = |x: f64| 1.0 / (1.0 + 4.0 * x);
    let samples = curve(101, truth);
    let pins = [(0.0, 1.0), (1.0, 0.2)];
    // The pins leave b alone: a = 0.8 / (1 - exp(-b)), c = 1 - a.
    let value = |b: f64, goal: Goal| {
        let a = 0.8 / (1.0 - (-b).exp());
        let r: Vec<f64> = grid(101).iter().map(|x| a * (-b * x).exp() + 1.0 - a - truth(*x)).collect();
        match goal {
            Goal::Max => r.iter().fold(0.0_f64, |m, r| m.max(r.abs())),
            Goal::Rms => (r.iter().map(|r| r * r).sum::<f64>() / 101.0).sqrt(),
            Goal::Power(p) => (r.iter().map(|r| r.abs().powf(p)).sum::<f64>() / 101.0).powf(1.0 / p),
        }
    };
    for goal in [Goal::Max, Goal::Rms, Goal::Power(4.0), Goal::Power(20.0)] {
        let fitted = fit(&h, &samples, &[equal(&pins)], goal);
        // Everywhere in steps of 0.01, and beside the least of these in steps of 0.0001.
        let coarse: Vec<f64> = (1..2000).map(|i| value(f64::from(i) * 1e-2, goal)).collect();
        let least = (1..2000).min_by(|i, j| coarse[i - 1].total_cmp(&coarse[j - 1])).unwrap() as f64 * 1e-2;
        let beside = (-100..=100).map(|i| value(least + f64::from(i) * 1e-4, goal));
        let best = beside.fold(f64::INFINITY, f64::min);
        assert!((fitted.value / best - 1.0).abs() < 1e-5, "{goal}: {} instead of {best}", fitted.value);
        assert_eq!(fitted.termination, Termination::Constrained);
    }
}

#[test]
fn a_cubic_rises_where_it_has_to() {
    let h = parse(
        "override a: f32; override b: f32; override c: f32; override d: f32;
         fn f(x: f32) -> f32 { return a + x * (b + x * (c + x * d)); }",
    );
    let samples = curve(201, |x| (5.0 * x).sin() * 0.3 + x);
    let x = grid(101);
    let rising =
        constraint("rising", Condition::Rising { from: vec![x[..100].to_vec()], to: vec![x[1..].to_vec()] });
    for goal in [Goal::Max, Goal::Rms] {
        let free = fit(&h, &samples, &[], goal);
        let fitted = fit(&h, &samples, std::slice::from_ref(&rising), goal);
        let falls = |fitted: &Fitted| {
            let f = |x: f64| h.tape().at(&[x], &fitted.coefficients);
            x.windows(2).map(|pair| f(pair[0]) - f(pair[1])).fold(0.0, f64::max)
        };
        assert!(falls(&free) > 1e-4 && falls(&fitted) < 1e-9, "{} {}", falls(&free), falls(&fitted));
        // A rising function is off by half of the deepest fall of what it imitates: 0.0554 from
        // x = 0.4601 to 0.7965.
        assert!(fitted.max > 0.0554 && fitted.max < 0.1 && fitted.value > free.value, "{fitted:?} {free:?}");
        let end = if goal == Goal::Max { Termination::GlobalMinimax } else { Termination::Constrained };
        assert_eq!(fitted.termination, end);
    }
}

#[test]
fn a_normalisation_stays_above_one_and_exact_at_an_edge() {
    let h = hypothesis("ggx_norm_q13");
    let samples = furnace(&h, 40, true);
    let free = fit(&h, &samples, &[], Goal::Max);
    // A normalisation below 1 takes energy: at least 1 / E is the conservative side.
    let points: Vec<Vec<f64>> = samples.inputs.clone();
    let values = samples.scale.iter().map(|e| 1.0 / e - 0.015).collect();
    let low = constraint("at most 0.015 below 1/E", Condition::AtLeast { points, values });
    let fitted = fit(&h, &samples, &[low], Goal::Max);
    assert!(fitted.max > free.max && fitted.max < 2.0 * free.max, "{} {}", fitted.max, free.max);
    assert!(matches!(fitted.gap, Gap::Local(_) | Gap::Global(_)));
    for held in &fitted.constraints {
        assert!(held.worst <= held.tolerance && held.tolerance < 1e-5, "{held:?}");
    }
}

#[test]
fn what_cannot_be_kept_is_named_with_its_place() {
    let samples = curve(51, |x| x * x);
    let low = |value: f64| {
        constraint("high", Condition::AtLeast { points: vec![vec![0.0, 0.5]], values: vec![value; 2] })
    };
    let high = constraint("low", Condition::AtMost { points: vec![vec![0.5]], values: vec![0.5] });
    for goal in [Goal::Max, Goal::Rms, Goal::Power(4.0)] {
        let error =
            optimise(&parse(LINE), &samples, &[low(1.0), high.clone()], &Options::new(goal)).unwrap_err();
        let FitError::Unsatisfiable { at, by, .. } = &error else { panic!("{error}") };
        assert_eq!(at, "x = 0.5");
        // Halfway between the two.
        assert!((by - 0.25).abs() < 1e-3, "{error}");
    }
    let through = parse("override a: f32; fn f(x: f32) -> f32 { return a * x; }");
    let error = optimise(&through, &samples, &[equal(&[(0.0, 1.0)])], &Options::new(Goal::Rms)).unwrap_err();
    assert_eq!(
        error.to_string(),
        "constraint `exact at the ends`: no coefficients of f were found that keep it; at x = 0 it stays 1.000e0 off; \
         loosen it, take another constraint away, or give the formula more freedom"
    );
    // A formula without parameters keeps a constraint or does not.
    let fixed = parse("fn f(x: f32) -> f32 { return x; }");
    assert!(optimise(&fixed, &samples, &[equal(&[(0.5, 0.5)])], &Options::new(Goal::Max)).is_ok());
    let error = optimise(&fixed, &samples, &[equal(&[(0.5, 0.75)])], &Options::new(Goal::Max)).unwrap_err();
    assert!(matches!(error, FitError::Unsatisfiable { by, .. } if (by - 0.25).abs() < 1e-12), "{error}");
}

#[test]
fn constraints_of_the_wrong_shape_are_refused() {
    let refused = |condition: Condition| {
        let constraints = [constraint("edge", condition)];
        optimise(&parse(LINE), &curve(9, |x| x), &constraints, &Options::new(Goal::Max))
            .unwrap_err()
            .to_string()
    };
    let at = |points: Vec<Vec<f64>>, values: Vec<f64>| refused(Condition::Equal { points, values });
    assert_eq!(at(vec![], vec![1.0]), "constraint `edge`: columns of inputs of f: 0 given, 1 expected");
    assert_eq!(at(vec![vec![]], vec![]), "constraint `edge`: input x: points: 0 given, 1 expected");
    assert_eq!(
        at(vec![vec![0.5]], vec![1.0, 2.0]),
        "constraint `edge`: input x: points: 1 given, 2 expected"
    );
    assert_eq!(
        at(vec![vec![0.5, f64::NAN]], vec![1.0, 2.0]),
        "constraint `edge`: input x, sample 1: value NaN is not finite"
    );
    assert_eq!(
        refused(Condition::Rising { from: vec![vec![0.0, 0.1]], to: vec![vec![0.5]] }),
        "constraint `edge`: input x: points: 1 given, 2 expected"
    );
    let error = optimise(&parse(LINE), &curve(9, |x| x), &[], &Options::new(Goal::Power(1.5))).unwrap_err();
    assert_eq!(
        error.to_string(),
        "the power of a p-norm is 1.5: it must lie in 2 .. 1000; the limit of large powers is the goal max"
    );
}
