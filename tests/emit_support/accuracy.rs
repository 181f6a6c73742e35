//! How far two machines may lie apart: a running error analysis of a formula's tape at one point.

use lobefit_shade::{BinaryOp, Op, Tape, UnaryOp};

/// Largest relative error of one operation.
#[derive(Clone, Copy)]
pub struct Arithmetic {
    /// Of sums, differences and products.
    rounding: f64,
    /// Of quotients.
    division: f64,
}

/// One unit in the last place is at most 2^-23 of the number.
const ULP: f64 = 1.0 / 8_388_608.0;

/// IEEE 754, to nearest: half a unit.
pub const CPU: Arithmetic = Arithmetic { rounding: 0.5 * ULP, division: 0.5 * ULP };

/// WGSL, "Floating Point Evaluation": sums, differences and products are correctly rounded, in a
/// direction that is not said, so within one unit; x / y within 2.5. Contraction and reassociation
/// are allowed only where they lose no accuracy.
pub const WGSL: Arithmetic = Arithmetic { rounding: ULP, division: 2.5 * ULP };

/// What a flush of subnormal numbers to zero takes from a result or an operand.
const FLUSH: f64 = f32::MIN_POSITIVE as f64;

/// A bound on |value computed - exact value| of a tape at a point, if every operation keeps to its
/// accuracy. With x the exact operand and e the bound of what was computed of it:
/// - sum: ex + ey, and one rounding of at most |x + y| + ex + ey;
/// - product: |x| ey + |y| ex + ex ey, and one rounding of it all;
/// - quotient: (ex + |x/y| ey)/(|y| - ey), and the division's error of it all.
///
/// # Panics
/// At an operation whose accuracy is not stated here, and where a divisor's error reaches the
/// divisor.
pub fn bound(tape: &Tape, inputs: &[f32], coefficients: &[f32], arithmetic: Arithmetic) -> f64 {
    let mut done: Vec<(f64, f64)> = Vec::with_capacity(tape.ops().len());
    for op in tape.ops() {
        let of = |n: &u32| done[*n as usize];
        let rounded = |x: f64, e: f64, unit: f64| (x, e + unit * (x.abs() + e) + FLUSH);
        let value = match op {
            Op::Input(i) => (f64::from(inputs[usize::from(*i)]), 0.0),
            Op::Parameter(i) => (f64::from(coefficients[usize::from(*i)]), 0.0),
            Op::Literal(x) => (f64::from(*x), 0.0),
            Op::Unary(UnaryOp::Negate, a) => (-of(a).0, of(a).1),
            Op::Binary(code, a, b) => {
                let ((x, ex), (y, ey)) = (of(a), of(b));
                match code {
                    BinaryOp::Add => rounded(x + y, ex + ey, arithmetic.rounding),
                    BinaryOp::Subtract => rounded(x - y, ex + ey, arithmetic.rounding),
                    BinaryOp::Multiply => {
                        rounded(x * y, x.abs() * ey + y.abs() * ex + ex * ey, arithmetic.rounding)
                    }
                    BinaryOp::Divide => {
                        assert!(y.abs() > ey, "{}: a divisor of {y} within {ey}", tape.function());
                        let e = (ex + (x / y).abs() * ey) / (y.abs() - ey);
                        rounded(x / y, e, arithmetic.division)
                    }
                    other => panic!("{}: state the accuracy of {other:?} in WGSL", tape.function()),
                }
            }
            other => panic!("{}: state the accuracy of {other:?} in WGSL", tape.function()),
        };
        done.push(value);
    }
    done[done.len() - 1].1
}

/// Whether a formula divides.
pub fn divides(tape: &Tape) -> bool {
    tape.ops().iter().any(|op| matches!(op, Op::Binary(BinaryOp::Divide, ..)))
}
