//! Formulas measured in f16 and with products contracted into additions.

use crate::fit_support;

use fit_support::parse;
use half::f16;
use lobefit_shade::{Hypothesis, Op, Precision, ShadeError, measure_in};

/// Points on [0, 1], exact in f16.
fn points() -> Vec<f32> {
    (0..=256).map(|i| i as f32 / 256.0).collect()
}

/// The value at each point, by way of the errors against 0 at one point at a time.
fn values(h: &Hypothesis, coefficients: &[f32], x: &[f32], precision: Precision) -> Vec<f64> {
    let value = |&x: &f32| {
        let measured = measure_in(h.tape(), coefficients, &[vec![x]], &[1.0], &[0.0], 1, precision)
            .unwrap_or_else(|e| panic!("{e}"));
        measured.0.mean
    };
    x.iter().map(value).collect()
}

#[test]
fn f16_rounds_every_operation() {
    let h = parse("override a: f32; fn f(x: f32) -> f32 { return (a * x + 0.3) * x; }");
    let half = f16::from_f32;
    let a = 0.7_f32;
    let expected: Vec<f64> =
        points().iter().map(|&x| ((half(a) * half(x) + half(0.3)) * half(x)).to_f64()).collect();
    assert_eq!(values(&h, &[a], &points(), Precision::F16), expected);
    // Inputs are rounded as well.
    let off = 0.1_f32;
    let expected = ((half(a) * half(off) + half(0.3)) * half(off)).to_f64();
    assert_eq!(values(&h, &[a], &[off], Precision::F16), [expected]);
}

#[test]
fn contraction_rounds_a_product_and_its_sum_once() {
    let h = parse("override a: f32; fn f(x: f32) -> f32 { return 0.3 - a * x; }");
    let a = 0.7_f32;
    let expected: Vec<f64> = points().iter().map(|x| f64::from((-a).mul_add(*x, 0.3))).collect();
    assert_eq!(values(&h, &[a], &points(), Precision::F32Fused), expected);
    let plain: Vec<f64> = points().iter().map(|x| f64::from(0.3 - a * x)).collect();
    assert_eq!(values(&h, &[a], &points(), Precision::F32), plain);
    assert_ne!(plain, expected);
    // f16: the exact sum is a multiple of 2^-24 * 2^-11 below 2: 48 bits, exact in f64.
    let wide = |x: f32| f64::from(f16::from_f32(x));
    let expected: Vec<f64> =
        points().iter().map(|&x| f16::from_f64(wide(0.3) - wide(a) * wide(x)).to_f64()).collect();
    assert_eq!(values(&h, &[a], &points(), Precision::F16Fused), expected);
}

/// Where products stand in sums: on either side, subtracted, negated, shared, used otherwise too.
const SUMS: [(&str, usize); 8] = [
    ("a * x + 1.5", 1),
    ("1.5 - a * x", 1),
    ("a * x - x", 1),
    ("x + -(a * x)", 1),
    ("a * x + x * x", 1),
    ("(a * x + 1.0) / (a * x - 3.0)", 2),
    ("(a * x + 1.0) * (a * x)", 0),
    ("a * x / (1.0 + x) + 1.0", 0),
];

#[test]
fn what_the_cost_model_fuses_is_contracted_and_keeps_its_value() {
    for (expression, fused) in SUMS {
        let h = parse(&format!("override a: f32 = 0.7; fn f(x: f32) -> f32 {{ return {expression}; }}"));
        let contracted = h.tape().contracted();
        let count = contracted.ops().iter().filter(|op| matches!(op, Op::Fma(..))).count();
        assert_eq!(count, fused, "{expression}: {:?}", contracted.ops());
        for x in points() {
            let at = |tape: &lobefit_shade::Tape| tape.at(&[f64::from(x)], &[0.7]);
            assert!((at(h.tape()) - at(&contracted)).abs() < 1e-15, "{expression} at {x}");
        }
    }
}

#[test]
fn halves_that_overflow_are_refused_by_name() {
    let message = |source: &str, coefficient: f32, x: f32| {
        let h = parse(source);
        let measured = measure_in(h.tape(), &[coefficient], &[vec![x]], &[1.0], &[0.0], 1, Precision::F16);
        let error = measured.unwrap_err();
        assert!(matches!(error, ShadeError::Unrepresentable { .. } | ShadeError::Unmeasurable { .. }));
        error.to_string()
    };
    let line = "override a: f32; fn f(x: f32) -> f32 { return a * x; }";
    assert_eq!(
        message(line, 1e5, 1.0),
        "f: coefficient 100000 is infinite in f16, whose largest number is 65504; scale the formula, or measure it in f32"
    );
    assert_eq!(
        message(line, 1.0, 7e4),
        "f: input x = 70000 is infinite in f16, whose largest number is 65504; narrow the domain, or measure it in f32"
    );
    assert_eq!(
        message(line, 300.0, 300.0),
        "test.wgsl:1:47: `a * x` is infinite in f16 at x = 300, in function f; narrow the domain, scale the formula, or measure it in f32"
    );
    let literal = "override a: f32; fn f(x: f32) -> f32 { return a / (x + 1e6); }";
    assert_eq!(
        message(literal, 1.0, 1.0),
        "f: at 1:56, the literal 1000000 is infinite in f16, whose largest number is 65504; scale the formula, or measure it in f32"
    );
}

/// 3 x 683 + 2^-20 = 2049.00000095 lies just above the tie between 2048 and 2050.
#[test]
fn a_fused_sum_in_f16_is_rounded_once() {
    let h = parse("override a: f32; override b: f32; fn f(x: f32) -> f32 { return a * x + b; }");
    let (small, one) = (1.0_f32 / 1_048_576.0, 683.0_f32);
    for (a, b, expected) in [
        (3.0, small, 2050.0),
        (3.0, -small, 2048.0),
        (-3.0, -small, -2050.0),
        (-3.0, small, -2048.0),
        (3.0, 0.0, 2048.0),
    ] {
        assert_eq!(values(&h, &[a, b], &[one], Precision::F16Fused), [expected], "{a} {b}");
    }
}
