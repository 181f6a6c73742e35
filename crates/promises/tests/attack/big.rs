//! Numbers of 300 bits: what cancels in a textbook's form costs them nothing that a test would see.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;

type Float = FBig<HalfEven, 2>;

/// Bits of a mantissa: the square of 1e-24, which is the least difference that the attacks make, has
/// 140 bits left.
const BITS: usize = 300;

/// A number; exponents neither overflow nor underflow.
#[derive(Clone, Debug)]
pub struct Big(Float);

impl From<f64> for Big {
    /// Of a finite number; -0 is 0.
    fn from(x: f64) -> Big {
        Big(Float::try_from(x).expect("finite").with_precision(BITS).value())
    }
}

/// An operator between numbers, references to them and f64.
macro_rules! operator {
    ($($name:ident $call:ident),*) => { $(
        impl<T: Into<Big>> $name<T> for Big {
            type Output = Big;
            fn $call(self, other: T) -> Big {
                Big($name::$call(self.0, other.into().0))
            }
        }
        impl<T: Into<Big>> $name<T> for &Big {
            type Output = Big;
            fn $call(self, other: T) -> Big {
                Big($name::$call(&self.0, other.into().0))
            }
        }
        impl $name<Big> for f64 {
            type Output = Big;
            fn $call(self, other: Big) -> Big {
                Big($name::$call(Big::from(self).0, other.0))
            }
        }
        impl $name<&Big> for f64 {
            type Output = Big;
            fn $call(self, other: &Big) -> Big {
                Big($name::$call(Big::from(self).0, &other.0))
            }
        }
    )* };
}
operator!(Add add, Sub sub, Mul mul, Div div);

impl From<&Big> for Big {
    fn from(x: &Big) -> Big {
        x.clone()
    }
}

impl Neg for Big {
    type Output = Big;
    fn neg(self) -> Big {
        Big(-self.0)
    }
}

impl PartialEq for Big {
    fn eq(&self, other: &Big) -> bool {
        self.0 == other.0
    }
}

impl PartialOrd for Big {
    fn partial_cmp(&self, other: &Big) -> Option<Ordering> {
        self.0.partial_cmp(&other.0)
    }
}

impl Big {
    pub fn pi() -> Big {
        Big(Float::pi(BITS))
    }

    pub fn sqrt(&self) -> Big {
        Big(self.0.sqrt())
    }

    pub fn square(&self) -> Big {
        Big(&self.0 * &self.0)
    }

    pub fn fifth_power(&self) -> Big {
        self.square().square() * self
    }

    pub fn exp(&self) -> Big {
        Big(self.0.exp())
    }

    /// Of a number above 0.
    pub fn ln(&self) -> Big {
        Big(self.0.ln())
    }

    pub fn sin_cos(&self) -> [Big; 2] {
        let (sine, cosine) = self.0.sin_cos();
        [Big(sine), Big(cosine)]
    }

    pub fn asin(&self) -> Big {
        Big(self.0.asin())
    }

    pub fn abs(&self) -> Big {
        if self.0 < Float::ZERO { Big(-self.0.clone()) } else { self.clone() }
    }

    pub fn max(self, other: impl Into<Big>) -> Big {
        let other = other.into();
        if self < other { other } else { self }
    }

    pub fn is_zero(&self) -> bool {
        self.0 == Float::ZERO
    }

    /// The nearest f64; infinite or 0 beyond its range.
    pub fn to_f64(&self) -> f64 {
        self.0.to_f64().value()
    }
}
