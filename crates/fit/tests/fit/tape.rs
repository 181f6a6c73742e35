//! The evaluator: values against hand-written Rust, derivatives against differences, bounds,
//! operation counts.
#![allow(clippy::disallowed_methods)]

use crate::fit_support;

use fit_support::parse;
use lobefit_shade::{Interval, Tape};

/// A function of two inputs and two parameters, written by hand.
type ByHand = fn(f64, f64, f64, f64) -> f64;

/// Bodies of `f(x, y)` with parameters a and b, and the same in Rust. Inputs and parameters lie in
/// [0.1, 1.1].
fn cases() -> Vec<(&'static str, ByHand)> {
    vec![
        ("return a * x + b / y - x * y;", |x, y, a, b| a * x + b / y - x * y),
        ("return (1.0 + a * x) / (y + b * x * x);", |x, y, a, b| (1.0 + a * x) / (y + b * x * x)),
        ("return pow(x + a, y * b) + exp(-a * x) + exp2(b * y);", |x, y, a, b| {
            (x + a).powf(y * b) + (-a * x).exp() + (b * y).exp2()
        }),
        ("return log(a + x) * log2(b + y) + sin(a * x) * cos(b * y);", |x, y, a, b| {
            (a + x).ln() * (b + y).log2() + (a * x).sin() * (b * y).cos()
        }),
        ("return sqrt(a * x) + inverseSqrt(b + y) + fma(a, x, b);", |x, y, a, b| {
            (a * x).sqrt() + 1.0 / (b + y).sqrt() + a.mul_add(x, b)
        }),
        ("return min(a * x, b * y) + max(x, a) * abs(x - b) + clamp(a * y, 0.25, 0.5);", |x, y, a, b| {
            (a * x).min(b * y) + x.max(a) * (x - b).abs() + (a * y).clamp(0.25, 0.5)
        }),
        ("return mix(a, b * x, y) + smoothstep(0.0, a + 1.0, x) + saturate(b * y * 2.0);", |x, y, a, b| {
            let t = (x / (a + 1.0)).clamp(0.0, 1.0);
            a * (1.0 - y) + b * x * y + t * t * (3.0 - 2.0 * t) + (b * y * 2.0).clamp(0.0, 1.0)
        }),
        ("return step(0.5, x) * a + sign(y - 0.5) * b + floor(3.0 * x) * a;", |x, y, a, b| {
            let step = if 0.5 <= x { 1.0 } else { 0.0 };
            step * a + (y - 0.5).signum() * b + (3.0 * x).floor() * a
        }),
        (
            "if x > y { return a * x; } var s = b; if y > 0.5 { s *= x; } else { return s - a; } return s + y * a;",
            |x, y, a, b| {
                if x > y {
                    return a * x;
                }
                if y > 0.5 { b * x + y * a } else { b - a }
            },
        ),
        (
            "let t = true; let f = !t; return select(a, x, f || x < y) * select(b, y, t || x < y)
                + select(x, y, t && x < y) - select(a, b, f && x < y) + select(x, b, !(t && !(x < y)) || y > 0.875);",
            |x, y, a, b| {
                let less = x < y;
                (if less { x } else { a }) * y + if less { y } else { x } - a + if less || y > 0.875 { b } else { x }
            },
        ),
        (
            "return pow(a - x, 3.0) + pow(b * y, 5.0) + select(a, b * b, x < y && !(y < 0.3));",
            |x, y, a, b| (a - x).powi(3) + (b * y).powi(5) + if x < y && y >= 0.3 { b * b } else { a },
        ),
    ]
}

fn tape(body: &str) -> Tape {
    parse(&format!("override a: f32; override b: f32; fn f(x: f32, y: f32) -> f32 {{ {body} }}"))
        .tape()
        .clone()
}

fn point(i: usize) -> [f64; 4] {
    [1usize, 2, 3, 4].map(|k| 0.1 + ((i * 7 + k) as f64 * [0.618, 0.755, 0.324, 0.877][k - 1]).fract())
}

#[test]
fn values_are_those_of_hand_written_rust() {
    for (body, by_hand) in cases() {
        let tape = tape(body);
        for i in 0..1000 {
            let [x, y, a, b] = point(i);
            let (found, expected) = (tape.at(&[x, y], &[a, b]), by_hand(x, y, a, b));
            assert!(
                (found - expected).abs() <= 2e-15 * expected.abs().max(1.0),
                "{body} at {x} {y} {a} {b}: {found} {expected}"
            );
        }
        // Blocks, partial blocks and parallel tasks give what single points give.
        let columns: Vec<Vec<f64>> = (0..2).map(|k| (0..10_001).map(|i| point(i)[k]).collect()).collect();
        let all = tape.evaluate(&columns, &[0.3, 0.7]).unwrap();
        for (i, value) in all.iter().enumerate() {
            assert_eq!(value.to_bits(), tape.at(&[columns[0][i], columns[1][i]], &[0.3, 0.7]).to_bits());
        }
    }
}

#[test]
fn gradients_are_those_of_differences() {
    for (body, _) in cases() {
        let tape = tape(body);
        for i in 0..200 {
            let [x, y, a, b] = point(i);
            let gradient = tape.gradient_at(&[x, y], &[a, b]);
            let at = |da: f64, db: f64| tape.at(&[x, y], &[a + da, b + db]);
            for (found, shift) in gradient.iter().zip([(1e-5, 0.0), (0.0, 1e-5)]) {
                let difference = (at(shift.0, shift.1) - at(-shift.0, -shift.1)) / 2e-5;
                let kink = (at(shift.0, shift.1) + at(-shift.0, -shift.1) - 2.0 * at(0.0, 0.0)).abs() > 1e-8;
                assert!(
                    kink || (found - difference).abs() < 1e-7 * difference.abs().max(1.0),
                    "{body}: {found} {difference}"
                );
            }
        }
    }
}

#[test]
fn bounds_hold_every_f32_value() {
    for (body, _) in cases() {
        let tape = tape(body);
        for i in 0..60 {
            let [x, y, a, b] = point(i).map(|v| f64::from(v as f32));
            let width = [0.0, 1e-4, 0.05][i % 3];
            let region = [Interval::new(x, x + width), Interval::new(y, y + 2.0 * width)];
            let bounds = *tape.bounds(&region, &[a, b]).last().unwrap();
            for k in 0..50 {
                let inside = |r: Interval, t: f64| {
                    ((r.lo + (r.hi - r.lo) * t.fract()) as f32).clamp(r.lo as f32, r.hi as f32)
                };
                let inputs = [inside(region[0], k as f64 * 0.618), inside(region[1], k as f64 * 0.755)];
                let value = f64::from(tape.at(&inputs, &[a as f32, b as f32]));
                assert!(bounds.lo <= value && value <= bounds.hi, "{body}: {value} outside {bounds:?}");
            }
        }
    }
}

#[test]
fn not_a_number_is_passed_on() {
    for body in [
        "return min(x, 0.5);",
        "return min(0.5, x);",
        "return max(x, 0.5);",
        "return max(0.5, x);",
        "return saturate(x);",
        "return clamp(x, 0.0, 0.5);",
        "return select(1.0, 2.0, x < 0.5);",
        "if x == 1.0 { return 0.0; } return 1.0;",
        "return step(0.5, x);",
        "return sign(x);",
        "return select(1.0, 2.0, !(x > 0.5) || y > 2.0);",
        "return smoothstep(0.0, 1.0, x);",
    ] {
        let tape = parse(&format!("fn f(x: f32, y: f32) -> f32 {{ {body} }}")).tape().clone();
        assert!(tape.at(&[f64::NAN, 0.5], &[]).is_nan(), "{body}");
        assert!(tape.at(&[f32::NAN, 0.5], &[]).is_nan(), "{body}");
    }
}

#[test]
fn operations_are_counted_by_the_model() {
    for (expression, ops) in [
        ("x + y", 1),
        ("x * y + 1.0", 1),
        ("1.0 - x * y", 1),
        ("-(x * y) + 1.0", 1),
        ("x * y + x * y * y", 2),
        ("x * x + y * y", 2),
        ("(x * y + 1.0) * (x * y)", 3),
        ("(x * y + 1.0) * (x * y - 1.0)", 3),
        ("1.0 / x", 4),
        ("y / x", 5),
        ("y / x + 1.0", 5),
        ("y / x + x / 3.0", 6),
        ("y / x + 1.0 / x", 5),
        ("sqrt(x) + inverseSqrt(y)", 9),
        ("exp2(x)", 4),
        ("exp(x) + log(y)", 11),
        ("log2(x)", 4),
        ("pow(x, y)", 9),
        ("pow(x, 5.0)", 3),
        ("saturate(-abs(x))", 0),
        ("clamp(x, 0.0, 1.0)", 0),
        ("clamp(x, 0.1, 1.0)", 2),
        ("select(x, y, x < y)", 2),
        ("mix(x, y, 0.25)", 2),
        ("mix(x, y, x)", 3),
        ("fma(x, y, 1.0)", 1),
        ("a * b * x", 1),
        ("exp(a) * x + b * b", 1),
        ("sin(x) + cos(x)", 9),
        ("min(x, y) * max(x, y)", 3),
        ("floor(x) + sign(y)", 4),
    ] {
        let parameters =
            ["a", "b"].iter().filter(|p| expression.split(|c: char| !c.is_alphanumeric()).any(|w| w == **p));
        let declared: String = parameters.map(|p| format!("override {p}: f32;\n")).collect();
        let source = format!("{declared}fn f(x: f32, y: f32) -> f32 {{ return {expression}; }}");
        assert_eq!(parse(&source).tape().cost_ops(), ops, "{expression}");
    }
}
