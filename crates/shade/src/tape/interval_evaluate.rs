//! A tape over a box of inputs.

use super::{BinaryOp, Interval, Op, Tape, UnaryOp};
use lobefit_math::ops;

const FALSE: Interval = Interval { lo: 0.0, hi: 0.0 };
const TRUE: Interval = Interval { lo: 1.0, hi: 1.0 };
const EITHER: Interval = Interval { lo: 0.0, hi: 1.0 };

impl Tape {
    /// Bounds of every operation's f32 value over a box of inputs (f32 values, in order); the last
    /// is the result's.
    ///
    /// An operation that may leave the reals has bounds without end.
    pub fn bounds(&self, inputs: &[Interval], coefficients: &[f64]) -> Vec<Interval> {
        let mut values: Vec<Interval> = Vec::with_capacity(self.ops.len());
        for op in &self.ops {
            let v = |n: u32| values[n as usize];
            values.push(match *op {
                Op::Input(i) => inputs[usize::from(i)],
                Op::Parameter(i) => Interval::point(coefficients[usize::from(i)]),
                Op::Literal(x) => Interval::point(f64::from(x)),
                Op::Unary(code, a) => unary(code, v(a)),
                Op::Binary(BinaryOp::Multiply, a, b) if a == b => v(a).mul_same_sign(v(a)),
                Op::Binary(code, a, b) => binary(code, v(a), v(b)),
                Op::Fma(a, b, c) => v(a).fma(v(b), v(c)),
                Op::Select(condition, accept, reject) => match v(condition) {
                    TRUE => v(accept),
                    FALSE => v(reject),
                    _ => v(accept).hull(v(reject)),
                },
            });
        }
        values
    }

    /// Which operations the result needs, given their bounds: the branch that a decided condition
    /// leaves out is not needed.
    pub fn needed(&self, bounds: &[Interval]) -> Vec<bool> {
        let mut needed = vec![false; self.ops.len()];
        if let Some(last) = needed.last_mut() {
            *last = true;
        }
        for (node, op) in self.ops.iter().enumerate().rev() {
            if !needed[node] {
                continue;
            }
            match *op {
                Op::Select(c, accept, reject) => {
                    needed[c as usize] = true;
                    needed[accept as usize] |= bounds[c as usize] != FALSE;
                    needed[reject as usize] |= bounds[c as usize] != TRUE;
                }
                _ => op.operands().for_each(|n| needed[n as usize] = true),
            }
        }
        needed
    }
}

fn unary(code: UnaryOp, x: Interval) -> Interval {
    match code {
        UnaryOp::Negate => x.negate(),
        UnaryOp::Abs => x.abs(),
        UnaryOp::Saturate => x.increasing(|x| x.clamp(0.0, 1.0)),
        UnaryOp::Floor => x.increasing(f64::floor),
        UnaryOp::Sign => x.increasing(|x| if x == 0.0 { 0.0 } else { x.signum() }),
        UnaryOp::Sqrt => x.nonnegative().increasing(f64::sqrt),
        UnaryOp::InverseSqrt => x.inverse_sqrt(),
        UnaryOp::Exp => x.transcendental(ops::exp),
        UnaryOp::Exp2 => x.transcendental(ops::exp2),
        UnaryOp::Log => x.nonnegative().transcendental(ops::log),
        UnaryOp::Log2 => x.nonnegative().transcendental(ops::log2),
        UnaryOp::Sin => x.wave(ops::sin),
        UnaryOp::Cos => x.wave(ops::cos),
        UnaryOp::Not => TRUE.minus(x),
    }
}

fn binary(code: BinaryOp, x: Interval, y: Interval) -> Interval {
    match code {
        BinaryOp::Add => x.plus(y),
        BinaryOp::Subtract => x.minus(y),
        BinaryOp::Multiply | BinaryOp::And => x.times(y),
        BinaryOp::Divide => x.over(y),
        BinaryOp::Min => Interval { lo: x.lo.min(y.lo), hi: x.hi.min(y.hi) },
        BinaryOp::Max | BinaryOp::Or => Interval { lo: x.lo.max(y.lo), hi: x.hi.max(y.hi) },
        BinaryOp::Pow => x.power(y, ops::pow),
        BinaryOp::Less => decide(x.hi < y.lo, x.lo >= y.hi),
        BinaryOp::LessEqual => decide(x.hi <= y.lo, x.lo > y.hi),
        BinaryOp::Equal => {
            let one = x.lo == x.hi && y.lo == y.hi && x.lo == y.lo;
            decide(one, x.hi < y.lo || y.hi < x.lo)
        }
    }
}

fn decide(holds: bool, fails: bool) -> Interval {
    match (holds, fails) {
        (true, _) => TRUE,
        (_, true) => FALSE,
        _ => EITHER,
    }
}
