//! The solvers: planted models, known minimax problems, named terminations, bad data, determinism.
#![allow(clippy::disallowed_methods)]

use crate::fit_support;

use fit_support::{furnace, hypothesis, parse};
use lobefit_fit::{FitError, Fitted, Goal, Norm, Options, Samples, Termination, optimise, round_to_f32};
use lobefit_shade::{Hypothesis, ShadeError, measure, round_up};

fn grid(n: usize) -> Vec<f64> {
    (0..n).map(|i| i as f64 / (n - 1) as f64).collect()
}

/// Samples of values on [0, 1].
fn curve(n: usize, f: impl Fn(f64) -> f64) -> Samples {
    let x = grid(n);
    Samples { scale: vec![1.0; n], target: x.iter().map(|&x| f(x)).collect(), inputs: vec![x] }
}

fn fit(hypothesis: &Hypothesis, samples: &Samples, norm: Norm) -> Fitted {
    optimise(hypothesis, samples, &[], &Options::new(norm)).unwrap_or_else(|e| panic!("{e}"))
}

/// Models with parameters that were planted, and starts that are off: formula, truth.
const PLANTED: [(&str, &[f64]); 6] = [
    (
        "override a: f32 = 1.0; override b: f32 = 1.0; fn f(x: f32) -> f32 { return a * exp(-b * x); }",
        &[2.5, 4.0],
    ),
    (
        "override a: f32 = 1.0; override b: f32 = 3.0; override c: f32 = 0.5; override d: f32 = 10.0;
         fn f(x: f32) -> f32 { return a * exp(-b * x) + c * exp(-d * x); }",
        &[1.5, 1.0, 2.0, 8.0],
    ),
    (
        "override a: f32; override b: f32; override c: f32; override d: f32;
         fn f(x: f32) -> f32 { return (a + b * x) / (1.0 + x * (c + d * x)); }",
        &[0.7, -0.4, 3.0, 5.0],
    ),
    ("override a: f32; override p: f32; fn f(x: f32) -> f32 { return a * pow(x + 0.1, p); }", &[1.7, 2.6]),
    (
        "override a: f32 = 0.5; override b: f32 = 5.0; override c: f32 = 0.5;
         fn f(x: f32) -> f32 { return a / (1.0 + exp(-b * (x - c))); }",
        &[1.25, 12.0, 0.4],
    ),
    (
        // units of 1e6 and 1e-6
        "override a: f32 = 2e6; override b: f32 = 1e-6; fn f(x: f32) -> f32 { return a * x / (1.0 + b * a * x) ; }",
        &[3.5e6, 2.5e-7],
    ),
];

#[test]
fn planted_parameters_are_recovered() {
    for (source, truth) in PLANTED {
        let hypothesis = parse(source);
        let samples = curve(200, |x| hypothesis.tape().at(&[x], truth));
        let fitted = fit(&hypothesis, &samples, Norm::Rms);
        assert!(fitted.termination.is_converged(), "{source}: {:?}", fitted.termination);
        let mut found = fitted.coefficients.clone();
        if found.len() == 4 && source.contains("exp(-d") && found[1] > found[3] {
            found.rotate_left(2);
        }
        for (found, truth) in found.iter().zip(truth) {
            assert!((found / truth - 1.0).abs() < 1e-8, "{source}: {:?}", fitted.coefficients);
        }
    }
}

#[test]
fn perturbed_starts_find_the_same_fit() {
    let source = std::fs::read_to_string(fit_support::folder().join("ggx_norm_q13.wgsl")).unwrap();
    let plain: String = source
        .lines()
        .map(|line| match line.split_once(" = ") {
            Some((head, _)) if line.starts_with("override") => format!("{head} = 1.0;\n"),
            _ => format!("{line}\n"),
        })
        .collect();
    let (published, naive) = (hypothesis("ggx_norm_q13"), parse(&plain));
    let samples = furnace(&published, 48, true);
    for norm in [Norm::Rms, Norm::Max] {
        let (a, b) = (fit(&published, &samples, norm), fit(&naive, &samples, norm));
        for (a, b) in a.coefficients.iter().zip(&b.coefficients) {
            assert!((a / b - 1.0).abs() < 1e-3, "{norm:?}: {a} {b}");
        }
        assert!((a.max / b.max - 1.0).abs() < 1e-4 && (a.rms / b.rms - 1.0).abs() < 1e-4);
    }
}

#[test]
fn the_best_straight_line_to_a_parabola_is_found() {
    let line =
        parse("override a: f32 = 0.3; override b: f32 = 0.9; fn f(x: f32) -> f32 { return a + b * x; }");
    let samples = curve(1025, |x| x * x);
    let best = fit(&line, &samples, Norm::Max);
    assert_eq!(best.termination, Termination::GlobalMinimax);
    assert!((best.max - 0.125).abs() < 1e-7, "{best:?}");
    assert!(
        (best.coefficients[0] + 0.125).abs() < 1e-6 && (best.coefficients[1] - 1.0).abs() < 1e-6,
        "{best:?}"
    );
    assert!(best.gap.value().is_some_and(|gap| gap < 1e-6), "{best:?}");
    let square = fit(&line, &samples, Norm::Rms);
    // least squares: x - 1/6, the line of smallest mean square on the continuum
    assert!((square.coefficients[1] - 1.0).abs() < 1e-3 && square.rms < best.rms && square.max > best.max);
}

/// Extremes of the residual of equal size and alternating sign.
fn equioscillations(hypothesis: &Hypothesis, fitted: &Fitted, samples: &Samples) -> usize {
    let residual = |i: usize| {
        samples.scale[i] * hypothesis.tape().at(&[samples.inputs[0][i]], &fitted.coefficients)
            - samples.target[i]
    };
    let (mut count, mut last) = (0, 0.0);
    for i in 0..samples.len() {
        let r = residual(i);
        if r.abs() > fitted.max * (1.0 - 1e-3) && r.signum() != last {
            (count, last) = (count + 1, r.signum());
        }
    }
    count
}

#[test]
fn minimax_fits_equioscillate() {
    // A polynomial of degree 4 has 5 parameters and 6 extremes; a rational (2, 2) has 5 and 6.
    let polynomial = parse(
        "override a: f32; override b: f32; override c: f32; override d: f32; override e: f32;
         fn f(x: f32) -> f32 { return a + x * (b + x * (c + x * (d + x * e))); }",
    );
    let rational = parse(
        "override a: f32 = 1.0; override b: f32 = 0.5; override c: f32 = 0.1; override d: f32 = -0.5; override e: f32 = 0.1;
         fn f(x: f32) -> f32 { return (a + x * (b + x * c)) / (1.0 + x * (d + x * e)); }",
    );
    for (hypothesis, known) in [(&polynomial, 2.7e-5), (&rational, 9e-6)] {
        let samples = curve(2001, f64::exp);
        let fitted = fit(hypothesis, &samples, Norm::Max);
        assert_eq!(fitted.termination, Termination::GlobalMinimax, "{fitted:?}");
        assert!(fitted.bound.is_some_and(|bound| bound > fitted.max * (1.0 - 1e-4)), "{fitted:?}");
        assert!(fitted.max < known * 1.1, "{fitted:?}");
        assert!(equioscillations(hypothesis, &fitted, &samples) >= 6, "{fitted:?}");
    }
    // Scaled residuals: relative error of a reciprocal's line, max |(a + b x)(1 + x) - 1|
    let line = parse("override a: f32; override b: f32; fn f(x: f32) -> f32 { return a + b * x; }");
    let x = grid(4001);
    let samples =
        Samples { scale: x.iter().map(|x| 1.0 + x).collect(), target: vec![1.0; x.len()], inputs: vec![x] };
    let fitted = fit(&line, &samples, Norm::Max);
    // Chebyshev: the parabola (a + b x)(1 + x) - 1 equioscillates at 0, 1/2, 1 with error 1/17
    assert!((fitted.max - 1.0 / 17.0).abs() < 1e-7, "{fitted:?}");
}

#[test]
fn terminations_are_named() {
    let line = "override a: f32; override b: f32; fn f(x: f32) -> f32 { return a + b * x; }";
    let samples = curve(50, |x| 2.0 - 3.0 * x);
    assert_eq!(fit(&parse(line), &samples, Norm::Rms).termination, Termination::ZeroResidual);
    assert_eq!(fit(&parse(line), &samples, Norm::Max).termination, Termination::ZeroResidual);
    let twice = parse("override a: f32; override b: f32; fn f(x: f32) -> f32 { return (a + b) * x + 1.0; }");
    let bent = curve(50, |x| x * x);
    for norm in [Norm::Rms, Norm::Max] {
        assert_eq!(fit(&twice, &bent, norm).termination, Termination::RankDeficient { rank: 1 });
        let constant = parse("fn f(x: f32) -> f32 { return 0.5 * x; }");
        let measured = fit(&constant, &bent, norm);
        assert_eq!((measured.termination, measured.max), (Termination::NoParameters, 0.5));
        let few = curve(2, |x| x);
        let cubic = parse(
            "override a: f32; override b: f32; override c: f32; fn f(x: f32) -> f32 { return a + x * (b + c * x); }",
        );
        let fitted = fit(&cubic, &few, norm);
        assert_eq!((fitted.termination, fitted.coefficients), (Termination::TooFewSamples, vec![1.0; 3]));
        assert!(!fitted.termination.is_converged());
    }
    let slow =
        parse("override a: f32; override b: f32; fn f(x: f32) -> f32 { return a * exp(b * x * 9.0); }");
    let options = Options { iterations: 2, starts: 1, ..Options::new(Norm::Rms) };
    let capped = optimise(&slow, &curve(50, |x| (7.0 * x).sin()), &[], &options).unwrap();
    assert_eq!(capped.termination, Termination::IterationCap);
    // Equal samples and constant data are data.
    let flat = Samples { inputs: vec![vec![0.5; 20]], scale: vec![1.0; 20], target: vec![0.25; 20] };
    let fitted = fit(&parse(line), &flat, Norm::Rms);
    assert_eq!(fitted.termination, Termination::RankDeficient { rank: 1 });
    assert!(fitted.max < 1e-14);
}

#[test]
fn bad_data_are_refused_with_their_place() {
    let line = parse("override a: f32; fn f(x: f32) -> f32 { return a * x; }");
    let refused = |change: &dyn Fn(&mut Samples)| {
        let mut samples = curve(50, |x| x);
        change(&mut samples);
        optimise(&line, &samples, &[], &Options::new(Norm::Rms)).unwrap_err().to_string()
    };
    assert_eq!(refused(&|s| s.target[17] = f64::NAN), "target, sample 17: value NaN is not finite");
    assert_eq!(refused(&|s| s.scale[3] = f64::INFINITY), "scale, sample 3: value inf is not finite");
    assert_eq!(refused(&|s| s.inputs[0][9] = f64::NAN), "input x, sample 9: value NaN is not finite");
    assert_eq!(
        refused(&|s| {
            s.scale.pop();
        }),
        "f: samples of scale: 49 given, 50 expected"
    );
    assert_eq!(refused(&|s| s.inputs.clear()), "f: columns of inputs: 0 given, 1 expected");
    assert_eq!(refused(&|s| *s = curve(0, |x| x)), "f: samples: 0 given, 1 expected");
    let log = parse("override a: f32 = -1.0; fn f(x: f32) -> f32 { return log(x) + a; }");
    let error = optimise(&log, &curve(50, |x| x), &[], &Options::new(Norm::Max)).unwrap_err();
    assert!(matches!(error, FitError::Undefined { .. }), "{error}");
    let (place, rest) =
        error.to_string().split_once(" is ").map(|(a, b)| (a.to_string(), b.to_string())).unwrap();
    assert!(place.starts_with("test.wgsl:1:") && place.contains("log(x)"), "{place}");
    assert_eq!(
        rest,
        "negative and infinite at x = 0, in function f with the parameters at their declared starts; no start does better: declare others \
         (`override NAME: f32 = VALUE;`), or narrow the domain"
    );
    let pole = parse(
        "override a: f32 = 0.5; override b: f32 = 0.01; fn f(x: f32) -> f32 { return a / (x - 0.5 + b * b * x * 0.001); }",
    );
    let error = optimise(&pole, &curve(50, |x| x), &[], &Options::new(Norm::Rms)).unwrap_err();
    assert!(matches!(error, FitError::PoleAtStart { .. }), "{error}");
    let told = error.to_string();
    for words in
        ["x - 0.5 + b * b * x * 0.001", "declared starts", "changes sign", "x = 0.5", "override NAME"]
    {
        assert!(told.contains(words), "{words}: {told}");
    }
}

#[test]
fn a_fit_never_hides_a_pole_between_samples() {
    // 1 / (x - 1/2) is best imitated by putting the pole where no sample is; the search may not
    // cross it.
    let pole =
        parse("override c: f32 = 2.0; override a: f32 = 1.0; fn f(x: f32) -> f32 { return a / (x - c); }");
    let samples = curve(40, |x| 1.0 / (x - 0.51));
    let fitted = fit(&pole, &samples, Norm::Rms);
    let c = fitted.coefficients[0];
    assert!(!(0.0..=1.0).contains(&c), "{fitted:?}");
}

#[test]
fn fits_do_not_depend_on_threads() {
    let q = hypothesis("ggx_norm_q13");
    let samples = furnace(&q, 40, true);
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| [Norm::Rms, Norm::Max].map(|norm| fit(&q, &samples, norm)))
    };
    let one = run(1);
    for threads in [2, 3, 7] {
        let other = run(threads);
        for (a, b) in one.iter().zip(&other) {
            let bits = |f: &Fitted| f.coefficients.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(a), bits(b), "{threads} threads");
            assert_eq!(a, b);
        }
    }
}

#[test]
fn scaling_the_units_scales_the_fit() {
    let source = |unit: &str| {
        format!(
            "override a: f32 = {unit}; override b: f32 = 1.0; override c: f32 = 1.0;
             fn f(x: f32) -> f32 {{ return a * (1.0 + b * x) / (1.0 + c * x); }}"
        )
    };
    let truth = |x: f64| (1.0 + x).ln() + 0.1;
    let plain = fit(&parse(&source("1.0")), &curve(100, truth), Norm::Rms);
    for (unit, factor) in [("1e6", 1e6), ("1e-6", 1e-6)] {
        let scaled = fit(&parse(&source(unit)), &curve(100, |x| factor * truth(x)), Norm::Rms);
        assert!((scaled.rms / plain.rms / factor - 1.0).abs() < 1e-10, "{unit}: {scaled:?} {plain:?}");
        assert!((scaled.coefficients[0] / plain.coefficients[0] / factor - 1.0).abs() < 1e-6);
    }
}

#[test]
fn measured_errors_are_those_of_f32() {
    let q = hypothesis("ggx_norm_q13");
    let samples = furnace(&q, 64, true);
    let fitted = fit(&q, &samples, Norm::Max);
    let rounded = round_to_f32(&fitted.coefficients).unwrap();
    let inputs: Vec<Vec<f32>> =
        samples.inputs.iter().map(|column| column.iter().map(|x| *x as f32).collect()).collect();
    let measured = measure(q.tape(), &rounded, &inputs, &samples.scale, &samples.target).unwrap();
    assert!((measured.max_abs - fitted.max).abs() < 3e-6 && (measured.rms - fitted.rms).abs() < 1e-6);
    assert_eq!(measured.max_abs, measured.max_rel);
    assert_eq!(measured.points, samples.len());
    let worst = q.tape().at(&[inputs[0][measured.worst], inputs[1][measured.worst]], &rounded);
    assert_eq!((samples.scale[measured.worst] * f64::from(worst) - 1.0).abs(), measured.max_abs);
    let mut bad = samples.scale.clone();
    bad[5] = f64::NAN;
    let error = measure(q.tape(), &rounded, &inputs, &bad, &samples.target).unwrap_err();
    assert_eq!(error.to_string(), "ggx_norm_q13: scale, sample 5: value NaN is not finite");
    assert!(measure(q.tape(), &rounded, &[vec![], vec![]], &[], &[]).is_err());
}

#[test]
fn bounds_are_rounded_up() {
    for (x, digits, expected) in [
        (0.02061, 3, 0.0207),
        (0.0206, 3, 0.0206),
        (0.999_96, 4, 1.0),
        (1.234e-7, 3, 1.24e-7),
        (9.991, 3, 10.0),
        (123456.0, 2, 130000.0),
    ] {
        assert_eq!(round_up(x, digits), expected);
    }
    for i in 1..2000 {
        let x = f64::from(i).sqrt() * 1e-3;
        let up = round_up(x, 4);
        assert!(up >= x && up <= x * 1.0011);
    }
    assert!(
        round_up(f64::NAN, 3).is_nan() && round_up(f64::INFINITY, 3).is_infinite() && round_up(0.0, 3) == 0.0
    );
}

#[test]
fn rounding_refuses_what_is_no_f32() {
    assert_eq!(round_to_f32(&[0.1, 1e-31, -1e-40]).unwrap(), [0.1, 0.0, 0.0]);
    assert!(matches!(
        round_to_f32(&[1.0, 1e39]),
        Err(FitError::Shade(ShadeError::NotFinite { index: 1, .. }))
    ));
    assert!(round_to_f32(&[f64::NAN]).is_err());
}

#[test]
fn undetermined_parameters_are_named() {
    let bent = curve(50, |x| x * x + 0.3);
    let told = |source: &str, goal: Goal| {
        let fitted = optimise(&parse(source), &bent, &[], &Options::new(goal)).unwrap();
        (fitted.rank, fitted.undetermined)
    };
    for goal in [Goal::Rms, Goal::Max, Goal::Power(4.0)] {
        let sum = "override a: f32; override b: f32; override c: f32; fn f(x: f32) -> f32 { return (a + b) * x + c; }";
        let coincide = "`a` and `b` coincide: only a combination of them is determined".to_string();
        assert_eq!(told(sum, goal), (2, vec![coincide]));
        let idle = "override a: f32; override b: f32; fn f(x: f32) -> f32 { return a + 0.0 * b * x; }";
        assert_eq!(told(idle, goal), (1, vec!["`b` does not matter".to_string()]));
        let product = "override a: f32; override b: f32; override c: f32 = 2.0; override d: f32 = 0.5;
                       fn f(x: f32) -> f32 { return a * b + exp(-c * d * x); }";
        let (rank, words) = told(product, goal);
        assert_eq!(rank, 2);
        assert_eq!(words.len(), 2);
        assert!(words[0].starts_with("`a` and `b`") && words[1].starts_with("`c` and `d`"), "{words:?}");
        let three = "override a: f32; override b: f32; override c: f32; fn f(x: f32) -> f32 { return (a + b - c) * x; }";
        let words = "`a`, `b` and `c` coincide: only fewer combinations of them are determined".to_string();
        assert_eq!(told(three, goal), (1, vec![words]));
        let line = "override a: f32; override b: f32; fn f(x: f32) -> f32 { return a + b * x; }";
        assert_eq!(told(line, goal), (2, vec![]));
    }
}

#[test]
fn p_norms_are_minimised_in_their_own_right() {
    // The constant of least p-norm on 0, 0, 0, 1: c with 3 c^(p-1) = (1 - c)^(p-1),
    // c = 1 / (1 + 3^(1/(p-1))).
    let constant = parse("override a: f32 = 0.9; fn f(x: f32) -> f32 { return a + 0.0 * x; }");
    let samples =
        Samples { inputs: vec![vec![0.0; 4]], scale: vec![1.0; 4], target: vec![0.0, 0.0, 0.0, 1.0] };
    for p in [2.0, 2.5, 3.0, 4.0, 8.0, 33.0, 100.0] {
        let fitted = optimise(&constant, &samples, &[], &Options::new(Goal::Power(p))).unwrap();
        let c = 1.0 / (1.0 + 3.0_f64.powf(1.0 / (p - 1.0)));
        assert!(fitted.termination.is_converged(), "{p}: {fitted:?}");
        assert!((fitted.coefficients[0] - c).abs() < 1e-9, "{p}: {fitted:?} instead of {c}");
        let value = ((3.0 * c.powf(p) + (1.0 - c).powf(p)) / 4.0).powf(1.0 / p);
        assert!((fitted.value / value - 1.0).abs() < 1e-12);
    }
    // Between least squares and minimax, towards which it tends; all of it on a rational form from
    // its declared start.
    let q = hypothesis("ggx_norm_q13");
    let samples = furnace(&q, 40, true);
    let at = |goal: Goal| optimise(&q, &samples, &[], &Options::new(goal)).unwrap();
    let (square, largest) = (at(Goal::Rms), at(Goal::Max));
    let mut last = square.max;
    for p in [4.0, 16.0, 64.0, 256.0] {
        let fitted = at(Goal::Power(p));
        println!(
            "p = {p}: value {} max {} {:?} {}",
            fitted.value, fitted.max, fitted.termination, fitted.evaluations
        );
        assert!(fitted.termination.is_converged(), "{fitted:?}");
        assert!(fitted.max < last && fitted.max >= largest.max * (1.0 - 1e-9), "{fitted:?}");
        assert!(fitted.rms > square.rms && fitted.value <= fitted.max && fitted.value > fitted.rms);
        last = fitted.max;
    }
    assert!(last < 1.02 * largest.max, "{last} {}", largest.max);
}

#[test]
fn weights_multiply_scale_and_target() {
    let line = parse("override a: f32; override b: f32; fn f(x: f32) -> f32 { return a + b * x; }");
    let plain = curve(41, |x| x * x);
    let weight = |i: usize| 1.0 + (i % 3) as f64;
    let weighted = Samples {
        scale: (0..41).map(weight).collect(),
        target: plain.target.iter().enumerate().map(|(i, t)| weight(i) * t).collect(),
        ..plain.clone()
    };
    // A sample of weight w in the maximum, and in a p-norm, is a residual w times as large; in
    // least squares, w^2 samples.
    let mut repeated = Samples { inputs: vec![vec![]], scale: vec![], target: vec![] };
    for i in 0..41 {
        for _ in 0..(weight(i) * weight(i)) as usize {
            repeated.inputs[0].push(plain.inputs[0][i]);
            repeated.scale.push(1.0);
            repeated.target.push(plain.target[i]);
        }
    }
    let (a, b) = (fit(&line, &weighted, Norm::Rms), fit(&line, &repeated, Norm::Rms));
    assert!(a.coefficients.iter().zip(&b.coefficients).all(|(a, b)| (a - b).abs() < 1e-10), "{a:?} {b:?}");
    let heavy = fit(&line, &weighted, Norm::Max);
    let off = |i: usize| {
        weight(i) * (heavy.coefficients[0] + heavy.coefficients[1] * plain.inputs[0][i] - plain.target[i])
    };
    assert!((0..41).all(|i| off(i).abs() <= heavy.max * (1.0 + 1e-9)));
    assert!((0..41).filter(|&i| off(i).abs() > heavy.max * (1.0 - 1e-6)).all(|i| weight(i) == 3.0));
}

#[test]
fn residuals_scaled_by_a_million_give_the_same_coefficients() {
    let q = hypothesis("ggx_norm_q13");
    let plain = furnace(&q, 32, true);
    for goal in [Goal::Rms, Goal::Max, Goal::Power(8.0)] {
        let base = optimise(&q, &plain, &[], &Options::new(goal)).unwrap();
        for factor in [1e6, 1e-6] {
            let times = |column: &[f64]| column.iter().map(|x| factor * x).collect::<Vec<f64>>();
            let samples = Samples {
                inputs: plain.inputs.clone(),
                scale: times(&plain.scale),
                target: times(&plain.target),
            };
            let scaled = optimise(&q, &samples, &[], &Options::new(goal)).unwrap();
            assert!((scaled.value / base.value / factor - 1.0).abs() < 1e-8, "{goal}: {scaled:?} {base:?}");
            for (a, b) in scaled.coefficients.iter().zip(&base.coefficients) {
                assert!((a / b - 1.0).abs() < 1e-5, "{goal} {factor}: {a} {b}");
            }
        }
    }
}

/// A parameter that the value does not depend on stays where it is declared, whatever is minimised,
/// and the result names it.
#[test]
fn a_parameter_that_does_not_matter_stays_and_is_reported() {
    for idle in ["0.0 * k", "k * max(x - 2.0, 0.0)"] {
        let formula = format!(
            "override a: f32 = 1.0; override k: f32 = 0.5; fn f(x: f32) -> f32 {{ return a * x + {idle}; }}"
        );
        let hypothesis = parse(&formula);
        let samples = curve(50, |x| 0.3 + x * x);
        for goal in [Goal::Max, Goal::Rms, Goal::Power(8.0)] {
            let fitted =
                optimise(&hypothesis, &samples, &[], &Options::new(goal)).unwrap_or_else(|e| panic!("{e}"));
            assert!(fitted.termination.is_converged(), "{idle} {goal:?}: {:?}", fitted.termination);
            assert!(fitted.coefficients[1].abs() < 10.0, "{idle} {goal:?}: {:?}", fitted.coefficients);
            assert_eq!(fitted.undetermined, ["`k` does not matter"], "{idle} {goal:?}");
            assert_eq!(fitted.rank, 1, "{idle} {goal:?}");
        }
    }
}

#[test]
fn a_coefficient_beyond_f32_is_refused_by_its_name() {
    let hypothesis = parse("override far: f32 = 1.0; fn f(x: f32) -> f32 { return far * x; }");
    let samples = curve(20, |x| 1e60 * x);
    let error =
        optimise(&hypothesis, &samples, &[], &Options::new(Norm::Rms)).expect_err("no f32").to_string();
    assert!(error.contains("`far`") && error.len() < 100, "{error}");
}

/// The squares of a gradient beyond 1e154 are infinite where its entries and the residual are not:
/// such coefficients are refused as others are at which a sample is not finite.
#[test]
fn a_gradient_without_a_finite_length_is_refused() {
    let source =
        "override a: f32 = 1.0; override b: f32 = 500.0; override c: f32 = 1.0; override d: f32 = 1.0;
        fn f(x: f32) -> f32 { return a * exp(b * x) + c * x * x + d * x; }";
    let samples = curve(200, |x| (2.0 * x).exp() + 0.5 * x * x - x);
    let fitted = fit(&parse(source), &samples, Norm::Rms);
    for (found, truth) in fitted.coefficients.iter().zip([1.0, 2.0, 0.5, -1.0]) {
        assert!((found - truth).abs() < 1e-9, "{fitted:?}");
    }
}

/// At one roughness a formula for all of them lies in a long curved valley, along which steps in k
/// drag the other coefficients by thousands.
#[test]
fn a_narrow_domain_ends_at_a_minimum_in_few_steps() {
    let formula = parse(
        "override c0: f32 = -0.42; override c1: f32 = 6.2; override c2: f32 = 0.27; override c3: f32 = -12.0;
         override c4: f32 = 12.2; override c5: f32 = -8.0; override c6: f32 = 15.0; override c7: f32 = 2.2;
         override k: f32 = 2.2;
         fn f(alpha: f32, mu: f32) -> f32 {
             let inverse = 1.0 / (mu + k * alpha);
             let ratio = alpha * inverse;
             return 1.0 + ratio * (c0 + ratio * (c1 + alpha * (c2 + mu * (c4 + mu * (c5 + alpha * (c6
                 + mu * c7)))) + ratio * c3));
         }",
    );
    let (mut alphas, mut mus) = (Vec::new(), Vec::new());
    for alpha in [0.156, 0.16, 0.164] {
        for mu in grid(200) {
            alphas.push(alpha);
            mus.push(0.01 + 0.99 * mu);
        }
    }
    let value = |(a, mu): (&f64, &f64)| 1.0 + 0.5 * a * (-2.0 * mu).exp() / (a + mu * mu + 0.3 * mu);
    let target = alphas.iter().zip(&mus).map(value).collect::<Vec<f64>>();
    let samples = Samples { scale: vec![1.0; target.len()], target, inputs: vec![alphas, mus] };
    let options = Options { starts: 1, ..Options::new(Norm::Max) };
    let fitted = optimise(&formula, &samples, &[], &options).unwrap();
    assert_eq!(fitted.termination, Termination::Minimax, "{fitted:?}");
    assert!(fitted.evaluations < 150, "{fitted:?}");
}
