//! Intervals of f32 values: bounds that hold for the arithmetic as emitted, not only for real
//! numbers.
//!
//! Rounding to nearest is monotone, so the f32 result of an exactly rounded operation lies between
//! its real bounds rounded down and up to f32, and a bound that is itself an f32 (1 - 1 = 0) is
//! kept. Divisions get 3 more ulp (2.5 by WGSL's accuracy table), transcendental functions 8,
//! pow 64.

/// A closed interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Lower end.
    pub lo: f64,
    /// Upper end.
    pub hi: f64,
}

/// Any value.
const WHOLE: Interval = Interval { lo: f64::NEG_INFINITY, hi: f64::INFINITY };

/// Ulps that an implementation may be off by, beyond correct rounding.
const DIVISION: u32 = 3;
const TRANSCENDENTAL: u32 = 8;
const POWER: u32 = 64;

impl Interval {
    /// The f32 values between `lo` and `hi`.
    pub fn new(lo: f64, hi: f64) -> Interval {
        outward(lo, hi, 0)
    }

    /// One value.
    pub fn point(x: f64) -> Interval {
        Interval { lo: x, hi: x }
    }

    /// Whether it holds every value that may be 0 or flushed to it.
    pub fn may_vanish(self) -> bool {
        let tiny = f64::from(f32::MIN_POSITIVE);
        !(self.lo >= tiny || self.hi <= -tiny)
    }

    /// Smallest interval that holds both.
    pub fn hull(self, other: Interval) -> Interval {
        Interval { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi) }
    }

    /// -x
    pub fn negate(self) -> Interval {
        Interval { lo: -self.hi, hi: -self.lo }
    }

    /// |x|
    pub fn abs(self) -> Interval {
        let lo = if self.lo <= 0.0 && self.hi >= 0.0 { 0.0 } else { self.lo.abs().min(self.hi.abs()) };
        Interval { lo, hi: self.lo.abs().max(self.hi.abs()) }
    }

    /// x + y
    pub fn plus(self, y: Interval) -> Interval {
        outward(self.lo + y.lo, self.hi + y.hi, 0)
    }

    /// x - y
    pub fn minus(self, y: Interval) -> Interval {
        self.plus(y.negate())
    }

    /// x y
    pub fn times(self, y: Interval) -> Interval {
        let (lo, hi) = corners(self, y, |a, b| a * b);
        outward(lo, hi, 0)
    }

    /// x y of factors that have one sign between them: a square, without the negative values of a
    /// product.
    pub fn mul_same_sign(self, y: Interval) -> Interval {
        self.abs().times(y.abs())
    }

    /// x y + z, rounded once. Products of f32 are exact in f64.
    pub fn fma(self, y: Interval, z: Interval) -> Interval {
        let (lo, hi) = corners(self, y, |a, b| a * b);
        outward(lo + z.lo, hi + z.hi, 0)
    }

    /// x / y; any value if y may vanish.
    pub fn over(self, y: Interval) -> Interval {
        if y.may_vanish() {
            return WHOLE;
        }
        let (lo, hi) = corners(self, y, |a, b| a / b);
        outward(lo, hi, DIVISION)
    }

    /// A nondecreasing function with exact or correctly rounded values.
    pub fn increasing(self, f: impl Fn(f64) -> f64) -> Interval {
        outward(f(self.lo), f(self.hi), 0)
    }

    /// A nondecreasing transcendental function.
    pub fn transcendental(self, f: impl Fn(f64) -> f64) -> Interval {
        outward(f(self.lo), f(self.hi), TRANSCENDENTAL)
    }

    /// The part above 0, for functions of nonnegative numbers.
    pub fn nonnegative(self) -> Interval {
        Interval { lo: self.lo.max(0.0), hi: self.hi.max(0.0) }
    }

    /// 1 / sqrt(x); any value if x may vanish.
    pub fn inverse_sqrt(self) -> Interval {
        if self.lo < f64::from(f32::MIN_POSITIVE) {
            return WHOLE;
        }
        outward(1.0 / self.hi.sqrt(), 1.0 / self.lo.sqrt(), TRANSCENDENTAL)
    }

    /// x^y for x >= 0; monotone in each, so its extremes are at corners.
    pub fn power(self, y: Interval, power: impl Fn(f64, f64) -> f64) -> Interval {
        let (lo, hi) = corners(self.nonnegative(), y, power);
        outward(lo.max(0.0), hi, POWER)
    }

    /// A function of slope at most 1 with values in [-1, 1].
    pub fn wave(self, f: impl Fn(f64) -> f64) -> Interval {
        let radius = 0.5 * (self.hi - self.lo);
        let middle = f(self.lo + radius);
        if middle.is_finite() && radius < 2.0 {
            outward((middle - radius).max(-1.0), (middle + radius).min(1.0), TRANSCENDENTAL)
        } else {
            Interval { lo: -1.0, hi: 1.0 }
        }
    }
}

/// Least and largest value at the corners of x times y; infinite where one is undefined.
fn corners(x: Interval, y: Interval, f: impl Fn(f64, f64) -> f64) -> (f64, f64) {
    let values = [f(x.lo, y.lo), f(x.lo, y.hi), f(x.hi, y.lo), f(x.hi, y.hi)];
    if values.iter().any(|v| v.is_nan()) {
        return (f64::NEG_INFINITY, f64::INFINITY);
    }
    let lo = values.iter().copied().fold(f64::INFINITY, f64::min);
    (lo, values.iter().copied().fold(f64::NEG_INFINITY, f64::max))
}

/// The bounds rounded outward to f32, then by `ulps` more; the sign of a bound is kept.
fn outward(lo: f64, hi: f64, ulps: u32) -> Interval {
    if lo.is_nan() || hi.is_nan() {
        return WHOLE;
    }
    let down = round_down(lo, ulps);
    let up = -round_down(-hi, ulps);
    let lo = if lo >= 0.0 { down.max(0.0) } else { down };
    let hi = if hi <= 0.0 { up.min(0.0) } else { up };
    Interval { lo, hi }
}

fn round_down(x: f64, ulps: u32) -> f64 {
    let mut rounded = x as f32;
    if f64::from(rounded) > x {
        rounded = rounded.next_down();
    }
    for _ in 0..ulps {
        rounded = rounded.next_down();
    }
    f64::from(rounded)
}
