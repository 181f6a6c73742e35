//! Formulas measured in f16 and with products contracted into additions.

use crate::fit_support;

use fit_support::parse;
use half::f16;
use lobefit_shade::tape::Half;
use lobefit_shade::{Hypothesis, Op, Precision, Real, ShadeError, measure_in};

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

#[test]
fn numbers_are_rounded_to_half_precision_as_elsewhere() {
    let same = |x: f32| {
        let (ours, theirs) = (Half::nearest(x).to_f32(), f16::from_f32(x).to_f32());
        assert!(
            ours.to_bits() == theirs.to_bits() || ours.is_nan() && theirs.is_nan(),
            "{x:e}: {ours} {theirs}"
        );
    };
    (0..u32::MAX - 1009).step_by(1009).for_each(|bits| same(f32::from_bits(bits)));
    // every number of half precision, the ties beside it, and their neighbours
    for bits in 0..=u16::MAX {
        let x = f16::from_bits(bits);
        let tie = 0.5 * (x.to_f32() + f16::from_bits(bits.wrapping_add(1)).to_f32());
        [x.to_f32(), tie, tie.next_up(), tie.next_down()].into_iter().for_each(same);
    }
}

/// A number of half precision in units of 2^-48, in which sums and products of such numbers are
/// whole.
fn units(x: f16) -> i128 {
    let magnitude = x.to_bits() & 0x7fff;
    let (exponent, fraction) = (i128::from(magnitude >> 10), i128::from(magnitude & 0x3ff));
    let (significand, shift) = if exponent == 0 { (fraction, 24) } else { (fraction + 1024, 23 + exponent) };
    let value = significand << shift;
    if x.is_sign_negative() { -value } else { value }
}

/// No other number of half precision is nearer to x y + z, and of two as near the result is even.
#[test]
fn fused_sums_are_the_nearest_numbers_of_half_precision() {
    let mut state = 1_u64;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f16::from_bits(((state >> 33) as u16 % 0x7c00) | ((state >> 48) as u16 & 0x8000))
    };
    for _ in 0..1_000_000 {
        let [x, y, z] = [next(), next(), next()];
        let half = |x: f16| Half::nearest(x.to_f32());
        let found = half(x).fma(half(y), half(z)).to_f32();
        let exact = ((units(x) * units(y)) >> 48) + units(z);
        let found = f16::from_f32(found);
        if found.is_infinite() {
            assert!(exact.abs() >= units(f16::MAX) + (units(f16::MAX) - units(f16::from_bits(0x7bfe))) / 2);
            continue;
        }
        let off = |x: f16| (units(x) - exact).abs();
        for other in [found.to_bits().wrapping_add(1), found.to_bits().wrapping_sub(1)] {
            let other = f16::from_bits(other);
            if other.is_finite() && other.is_sign_negative() == found.is_sign_negative() {
                let even = found.to_bits() & 1 == 0;
                assert!(off(found) < off(other) || off(found) == off(other) && even, "{x} {y} {z}: {found}");
            }
        }
    }
}
