//! The arithmetic of a tape in f16: every operation is rounded to half precision, subnormals kept.
//!
//! A number of half precision is held as the f32 that it is. Sums, products, quotients and square
//! roots are taken in f32 and rounded again, which gives the correctly rounded result since 24 >= 2
//! * 11 + 2 bits (Figueroa 1995); the transcendental functions are libm's in f32, rounded.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::Real;

/// A number of half precision.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Half(f32);

/// Bits of an f32's fraction that an f16 lacks.
const LOST: u32 = 13;

/// The smallest normal f16, 2^-14, and the first number beyond the largest one after rounding, 2^16.
const NORMAL: f32 = 1.0 / 16384.0;
const BEYOND: f32 = 65536.0;

/// Its neighbours are as far apart as subnormal f16 are, 2^-24.
const SUBNORMAL: f32 = 0.75;

impl Half {
    /// The nearest number of half precision, the even one of two; infinite from 65520 on.
    #[inline(always)]
    pub fn nearest(x: f32) -> Half {
        let bits = x.to_bits();
        let up = ((1 << (LOST - 1)) - 1) + ((bits >> LOST) & 1);
        let normal = f32::from_bits(bits.wrapping_add(up) & !((1 << LOST) - 1));
        let normal = if normal.abs() >= BEYOND { f32::INFINITY.copysign(x) } else { normal };
        let subnormal = ((x.abs() + SUBNORMAL) - SUBNORMAL).copysign(x);
        let rounded = if x.abs() < NORMAL { subnormal } else { normal };
        Half(if x.is_nan() { x } else { rounded })
    }

    /// The same number.
    pub fn to_f32(self) -> f32 {
        self.0
    }
}

macro_rules! rounded {
    ($operation:ident, $name:ident, $sign:tt) => {
        impl $operation for Half {
            type Output = Half;
            #[inline(always)]
            fn $name(self, other: Half) -> Half {
                Half::nearest(self.0 $sign other.0)
            }
        }
    };
}

rounded!(Add, add, +);
rounded!(Sub, sub, -);
rounded!(Mul, mul, *);
rounded!(Div, div, /);

impl Neg for Half {
    type Output = Half;
    #[inline(always)]
    fn neg(self) -> Half {
        Half(-self.0)
    }
}

impl Real for Half {
    const ZERO: Half = Half(0.0);
    const ONE: Half = Half(1.0);
    const NAN: Half = Half(f32::NAN);

    #[inline(always)]
    fn literal(x: f32) -> Half {
        Half::nearest(x)
    }

    /// The product is exact in f32; the sum is rounded to odd there, so that the last rounding sees
    /// on which side of a tie it lies (Boldo & Melquiond 2008).
    #[inline(always)]
    fn fma(self, y: Half, z: Half) -> Half {
        let (product, z) = (self.0 * y.0, z.0);
        let sum = product + z;
        let back = sum - product;
        let lost = (product - (sum - back)) + (z - back);
        let bits = sum.to_bits();
        let odd = if (lost > 0.0) == (sum > 0.0) { bits.wrapping_add(1) } else { bits.wrapping_sub(1) };
        let exact = lost == 0.0 || !sum.is_finite() || bits & 1 == 1;
        Half::nearest(if exact { sum } else { f32::from_bits(odd) })
    }

    #[inline(always)]
    fn magnitude(self) -> Half {
        Half(self.0.abs())
    }

    #[inline(always)]
    fn whole(self) -> Half {
        Half::nearest(self.0.floor())
    }

    #[inline(always)]
    fn root(self) -> Half {
        Half::nearest(self.0.sqrt())
    }

    fn e_power(self) -> Half {
        Half::nearest(self.0.e_power())
    }

    fn two_power(self) -> Half {
        Half::nearest(self.0.two_power())
    }

    fn natural_log(self) -> Half {
        Half::nearest(self.0.natural_log())
    }

    fn binary_log(self) -> Half {
        Half::nearest(self.0.binary_log())
    }

    fn sine(self) -> Half {
        Half::nearest(self.0.sine())
    }

    fn cosine(self) -> Half {
        Half::nearest(self.0.cosine())
    }

    fn power(self, y: Half) -> Half {
        Half::nearest(self.0.power(y.0))
    }
}
