//! The arithmetic of a tape in f32 and f64.
//!
//! Sums, products, quotients, square roots, fma and floor are IEEE 754; the transcendental
//! functions are libm's of the same width, without contraction or reassociation anywhere, so that
//! plain Rust in the same order gives the same bits.

use super::{BinaryOp, UnaryOp};
use lobefit_math::ops;

/// f32, f64 or [`Half`](super::Half).
pub trait Real:
    Copy
    + Send
    + Sync
    + PartialOrd
    + std::ops::Add<Output = Self>
    + std::ops::Sub<Output = Self>
    + std::ops::Mul<Output = Self>
    + std::ops::Div<Output = Self>
    + std::ops::Neg<Output = Self>
{
    /// 0
    const ZERO: Self;
    /// 1
    const ONE: Self;
    /// Not a number.
    const NAN: Self;
    /// A literal of the formula.
    fn literal(x: f32) -> Self;
    /// x y + z, rounded once.
    fn fma(self, y: Self, z: Self) -> Self;
    /// |x|
    fn magnitude(self) -> Self;
    /// Largest integer not above x.
    fn whole(self) -> Self;
    /// Square root.
    fn root(self) -> Self;
    /// e^x
    fn e_power(self) -> Self;
    /// 2^x
    fn two_power(self) -> Self;
    /// Natural logarithm.
    fn natural_log(self) -> Self;
    /// Binary logarithm.
    fn binary_log(self) -> Self;
    /// Sine.
    fn sine(self) -> Self;
    /// Cosine.
    fn cosine(self) -> Self;
    /// x^y
    fn power(self, y: Self) -> Self;
}

macro_rules! real {
    ($t:ty, $literal:expr, $exp:path, $exp2:path, $log:path, $log2:path, $sin:path, $cos:path, $pow:path) => {
        impl Real for $t {
            const ZERO: $t = 0.0;
            const ONE: $t = 1.0;
            const NAN: $t = <$t>::NAN;
            #[inline(always)]
            fn literal(x: f32) -> $t {
                $literal(x)
            }
            #[inline(always)]
            fn fma(self, y: $t, z: $t) -> $t {
                self.mul_add(y, z)
            }
            #[inline(always)]
            fn magnitude(self) -> $t {
                self.abs()
            }
            #[inline(always)]
            fn whole(self) -> $t {
                self.floor()
            }
            #[inline(always)]
            fn root(self) -> $t {
                self.sqrt()
            }
            fn e_power(self) -> $t {
                $exp(self)
            }
            fn two_power(self) -> $t {
                $exp2(self)
            }
            fn natural_log(self) -> $t {
                $log(self)
            }
            fn binary_log(self) -> $t {
                $log2(self)
            }
            fn sine(self) -> $t {
                $sin(self)
            }
            fn cosine(self) -> $t {
                $cos(self)
            }
            fn power(self, y: $t) -> $t {
                $pow(self, y)
            }
        }
    };
}

real!(f64, f64::from, ops::exp, ops::exp2, ops::log, ops::log2, ops::sin, ops::cos, ops::pow);
real!(f32, f32::from, ops::expf, ops::exp2f, ops::logf, ops::log2f, ops::sinf, ops::cosf, ops::powf);

/// One operand.
#[inline(always)]
pub(super) fn unary<R: Real>(op: UnaryOp, x: R) -> R {
    match op {
        UnaryOp::Negate => -x,
        UnaryOp::Abs => x.magnitude(),
        UnaryOp::Saturate => {
            if x < R::ZERO {
                R::ZERO
            } else if x > R::ONE {
                R::ONE
            } else {
                x
            }
        }
        UnaryOp::Floor => x.whole(),
        UnaryOp::Sign => {
            if x > R::ZERO {
                R::ONE
            } else if x < R::ZERO {
                -R::ONE
            } else {
                x
            }
        }
        UnaryOp::Sqrt => x.root(),
        UnaryOp::InverseSqrt => R::ONE / x.root(),
        UnaryOp::Exp => x.e_power(),
        UnaryOp::Exp2 => x.two_power(),
        UnaryOp::Log => x.natural_log(),
        UnaryOp::Log2 => x.binary_log(),
        UnaryOp::Sin => x.sine(),
        UnaryOp::Cos => x.cosine(),
        UnaryOp::Not => R::ONE - x,
    }
}

/// Two operands.
#[inline(always)]
pub(super) fn binary<R: Real>(op: BinaryOp, x: R, y: R) -> R {
    match op {
        BinaryOp::Add => x + y,
        BinaryOp::Subtract => x - y,
        BinaryOp::Multiply => x * y,
        BinaryOp::Divide => x / y,
        BinaryOp::Min => pick(y < x, x, y),
        BinaryOp::Max => pick(y > x, x, y),
        BinaryOp::Pow => x.power(y),
        BinaryOp::Less => truth(x < y, x, y),
        BinaryOp::LessEqual => truth(x <= y, x, y),
        BinaryOp::Equal => truth(x == y, x, y),
        BinaryOp::And => x * y,
        BinaryOp::Or => pick(y > x, x, y),
    }
}

/// y if `second` holds or y is not a number, else x.
#[inline(always)]
#[allow(clippy::eq_op)]
fn pick<R: Real>(second: bool, x: R, y: R) -> R {
    if second || y != y { y } else { x }
}

/// 1 or 0, or not a number if an operand is none.
#[inline(always)]
#[allow(clippy::eq_op)]
fn truth<R: Real>(holds: bool, x: R, y: R) -> R {
    if x != x || y != y {
        R::NAN
    } else if holds {
        R::ONE
    } else {
        R::ZERO
    }
}

/// accept where the condition is 1, reject where it is 0, else not a number.
#[inline(always)]
pub(super) fn select<R: Real>(condition: R, accept: R, reject: R) -> R {
    if condition == R::ONE {
        accept
    } else if condition == R::ZERO {
        reject
    } else {
        R::NAN
    }
}
