//! The arithmetic of a tape in f16: every operation is rounded to half precision, subnormals kept.
//!
//! Sums, products, quotients and square roots are taken in f32 and rounded again, which gives the
//! correctly rounded result since 24 >= 2 * 11 + 2 bits (Figueroa 1995); the transcendental
//! functions are libm's in f32, rounded.

use half::f16;

use super::Real;
use lobefit_math::ops;

/// A function of f32, its result rounded.
fn through(x: f16, f: impl Fn(f32) -> f32) -> f16 {
    f16::from_f32(f(x.to_f32()))
}

/// Rounded to odd in f32: a number that is no f32 becomes the one of its two neighbours whose last
/// bit is 1. |x| is at most 2^33 and not below 2^-48 but for 0: no f32 overflows or is subnormal.
fn odd(x: f64) -> f32 {
    let near = x as f32;
    let wide = f64::from(near);
    if wide == x || !x.is_finite() {
        return near;
    }
    let towards_zero = if wide.abs() > x.abs() { near.to_bits() - 1 } else { near.to_bits() };
    f32::from_bits(towards_zero | 1)
}

impl Real for f16 {
    const ZERO: f16 = f16::ZERO;
    const ONE: f16 = f16::ONE;
    const NAN: f16 = f16::NAN;

    fn literal(x: f32) -> f16 {
        f16::from_f32(x)
    }

    /// The product is exact in f64; the sum is rounded to odd there and again in f32, so that the
    /// last rounding sees on which side of a tie it lies (Boldo & Melquiond 2008). Not from f64 at
    /// once: where a host converts in hardware, that goes through f32, to even.
    fn fma(self, y: f16, z: f16) -> f16 {
        let (product, z) = (self.to_f64() * y.to_f64(), z.to_f64());
        let sum = product + z;
        let back = sum - product;
        let lost = (product - (sum - back)) + (z - back);
        if lost == 0.0 || !sum.is_finite() || sum.to_bits() & 1 == 1 {
            return f16::from_f32(odd(sum));
        }
        f16::from_f32(odd(if lost > 0.0 { sum.next_up() } else { sum.next_down() }))
    }

    fn magnitude(self) -> f16 {
        through(self, f32::abs)
    }

    fn whole(self) -> f16 {
        through(self, f32::floor)
    }

    fn root(self) -> f16 {
        through(self, f32::sqrt)
    }

    fn e_power(self) -> f16 {
        through(self, ops::expf)
    }

    fn two_power(self) -> f16 {
        through(self, ops::exp2f)
    }

    fn natural_log(self) -> f16 {
        through(self, ops::logf)
    }

    fn binary_log(self) -> f16 {
        through(self, ops::log2f)
    }

    fn sine(self) -> f16 {
        through(self, ops::sinf)
    }

    fn cosine(self) -> f16 {
        through(self, ops::cosf)
    }

    fn power(self, y: f16) -> f16 {
        f16::from_f32(ops::powf(self.to_f32(), y.to_f32()))
    }
}
