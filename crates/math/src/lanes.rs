//! Eight values at a time as plain arrays: the loops below have no branches and no calls, so the
//! compiler turns them into whatever vector instructions the target has, with the same bits on
//! every target.

/// Width of a block of lanes.
pub const LANES: usize = 8;

/// Eight values.
pub type F8 = [f64; LANES];

/// 1.5 * 2^52 + 1023: adding it rounds to an integer and leaves that integer, biased for an
/// exponent field, in the low bits of the mantissa.
const ROUND: f64 = 6_755_399_441_056_767.0;
/// ln 2 split so that k * LN2_HI is exact for |k| < 2^11 (Cody and Waite).
const LN2_HI: f64 = 6.931_471_803_691_238e-1;
const LN2_LO: f64 = 1.908_214_929_270_588e-10;

/// exp of eight values in [-700, 700], within 2 ulp (tested against `libm`); outside it is
/// meaningless.
#[inline(always)]
pub fn exp(x: &F8) -> F8 {
    let mut out = [0.0; LANES];
    for i in 0..LANES {
        out[i] = exp_of(x[i]);
    }
    out
}

/// [`exp`] of one value, for a loop over lanes.
#[inline(always)]
pub fn exp_of(x: f64) -> f64 {
    let shifted = x * std::f64::consts::LOG2_E + ROUND;
    let k = shifted - ROUND;
    let r = (x - k * LN2_HI) - k * LN2_LO;
    let scale = f64::from_bits(shifted.to_bits() << 52);
    taylor(r) * scale
}

/// exp(r) for |r| <= ln(2)/2 by its Taylor series to degree 13 (remainder 4e-18), Estrin's
/// grouping.
#[inline(always)]
fn taylor(r: f64) -> f64 {
    let r2 = r * r;
    let r4 = r2 * r2;
    let a = (1.0 + r) + r2 * (1.0 / 2.0 + r * (1.0 / 6.0));
    let b = (1.0 / 24.0 + r * (1.0 / 120.0)) + r2 * (1.0 / 720.0 + r * (1.0 / 5_040.0));
    let c = (1.0 / 40_320.0 + r * (1.0 / 362_880.0)) + r2 * (1.0 / 3_628_800.0 + r * (1.0 / 39_916_800.0));
    let d = 1.0 / 479_001_600.0 + r * (1.0 / 6_227_020_800.0);
    a + r4 * (b + r4 * (c + r4 * d))
}

/// Bits of 1 less those of sqrt(1/2): added to a number's bits, it carries the exponent of the
/// mantissa in [sqrt(1/2), sqrt(2)).
const CENTRE: u64 = 0x3ff0_0000_0000_0000 - 0x3fe6_a09e_667f_3bcd;
/// The bits of 2^52: or'ed with an integer below 2^52 they make the float 2^52 + integer.
const INTEGER: u64 = 0x4330_0000_0000_0000;

/// Natural logarithm of eight positive normal numbers, within 2 ulp (tested against `libm`);
/// elsewhere it is meaningless.
#[inline(always)]
pub fn ln(x: &F8) -> F8 {
    let mut out = [0.0; LANES];
    for i in 0..LANES {
        let bits = x[i].to_bits();
        let exponent = bits.wrapping_add(CENTRE) >> 52;
        let k = f64::from_bits(exponent | INTEGER) - (4_503_599_627_370_496.0 + 1023.0);
        let mantissa = f64::from_bits(bits.wrapping_sub(exponent << 52).wrapping_add(1023 << 52));
        out[i] = k * LN2_HI - (ln_tail(mantissa - 1.0, k) - (mantissa - 1.0));
    }
    out
}

/// f - ln(1 + f) - k LN2_LO for 1 + f in [sqrt(1/2), sqrt(2)): with s = f/(2 + f), ln(1 + f) = 2
/// atanh(s) = f - f^2/2 + s (f^2/2 + r), r = 2 s^2 (1/3 + s^2/5 + ...), cut where the next term is
/// below 1e-18 (s^2 <= 0.0295).
#[inline(always)]
fn ln_tail(f: f64, k: f64) -> f64 {
    let s = f / (2.0 + f);
    let z = s * s;
    let z2 = z * z;
    let a = 2.0 / 3.0 + z * (2.0 / 5.0);
    let b = 2.0 / 7.0 + z * (2.0 / 9.0);
    let c = 2.0 / 11.0 + z * (2.0 / 13.0);
    let d = 2.0 / 15.0 + z * (2.0 / 17.0);
    let e = 2.0 / 19.0 + z * (2.0 / 21.0);
    let r = z * (a + z2 * (b + z2 * (c + z2 * (d + z2 * e))));
    let half = 0.5 * f * f;
    half - (s * (half + r) + k * LN2_LO)
}

/// Sine and cosine of 2 pi x of eight numbers in [0, 1], within 3e-14 (tested against `libm`).
#[inline(always)]
pub fn sincos_turns(x: &F8) -> (F8, F8) {
    let (mut sines, mut cosines) = ([0.0; LANES], [0.0; LANES]);
    for i in 0..LANES {
        // The nearest quarter; its number is left in the low bits, as in `exp`.
        let shifted = 4.0 * x[i] + ROUND;
        let quarter = shifted.to_bits().wrapping_sub(1023);
        let r = (x[i] - 0.25 * (shifted - ROUND)) * (2.0 * std::f64::consts::PI);
        let z = r * r;
        let sine = 1.0 / 362_880.0 - z * (1.0 / 39_916_800.0 - z * (1.0 / 6_227_020_800.0));
        let sine = r * (1.0 - z * (1.0 / 6.0 - z * (1.0 / 120.0 - z * (1.0 / 5_040.0 - z * sine))));
        let cosine = 1.0 / 3_628_800.0 - z * (1.0 / 479_001_600.0 - z * (1.0 / 87_178_291_200.0));
        let cosine = 1.0 / 24.0 - z * (1.0 / 720.0 - z * (1.0 / 40_320.0 - z * cosine));
        let cosine = 1.0 - z * (0.5 - z * cosine);
        let (s, c) = if quarter & 1 == 0 { (sine, cosine) } else { (cosine, -sine) };
        (sines[i], cosines[i]) = if quarter & 2 == 0 { (s, c) } else { (-s, -c) };
    }
    (sines, cosines)
}

/// Sum of eight values in a fixed tree.
#[inline(always)]
pub fn sum(x: &F8) -> f64 {
    ((x[0] + x[4]) + (x[2] + x[6])) + ((x[1] + x[5]) + (x[3] + x[7]))
}

/// Sum of `f` over all values, in lanes.
#[inline(always)]
pub fn total(values: &[f64], f: impl Fn(f64) -> f64) -> f64 {
    let (blocks, rest) = values.as_chunks::<LANES>();
    let mut sums = [0.0; LANES];
    for block in blocks {
        for i in 0..LANES {
            sums[i] += f(block[i]);
        }
    }
    sum(&sums) + rest.iter().map(|x| f(*x)).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ops;

    #[test]
    fn exp_is_within_two_ulp() {
        for step in 0..200_000 {
            let x = -60.0 + 120.0 * f64::from(step) / 200_000.0;
            let got = exp(&[x; LANES])[0];
            let want = ops::exp(x);
            let off = (got - want).abs() / (want * f64::EPSILON);
            assert!(off <= 2.0, "exp({x}): {off} eps");
        }
        assert_eq!(exp(&[0.0; LANES])[3], 1.0);
    }

    #[test]
    fn sines_and_cosines_of_turns_are_within_their_bound() {
        for step in 0..=200_000 {
            let x = f64::from(step) / 200_000.0;
            let (got, want) = (sincos_turns(&[x; LANES]), ops::sincos(2.0 * std::f64::consts::PI * x));
            let off = (got.0[4] - want.0).abs().max((got.1[4] - want.1).abs());
            assert!(off <= 3e-14, "{x}: {off:e}");
        }
    }

    #[test]
    fn ln_is_within_two_ulp() {
        for step in 0..200_000 {
            let x = ops::exp(-40.0 + 80.0 * f64::from(step) / 200_000.0);
            let (got, want) = (ln(&[x; LANES])[5], ops::log(x));
            // At x = 1 both are 0.
            let off = (got - want).abs() / (want.abs().max(1e-300) * f64::EPSILON);
            assert!(off <= 2.0, "ln({x}): {off} eps");
        }
        for step in 0..200_000 {
            let x = 0.5 + f64::from(step) / 100_000.0;
            let (got, want) = (ln(&[x; LANES])[5], ops::log(x));
            let off = (got - want).abs() / (want.abs().max(1e-300) * f64::EPSILON);
            assert!(off <= 2.0, "ln({x}): {off} eps");
        }
        for x in [1e-300, 1e300, f64::MIN_POSITIVE, f64::MAX] {
            let (got, want) = (ln(&[x; LANES])[0], ops::log(x));
            assert!((got - want).abs() <= 2.0 * f64::EPSILON * want.abs(), "{x}: {got} against {want}");
        }
        assert_eq!(ln(&[1.0; LANES])[2], 0.0);
    }

    #[test]
    fn exp_reaches_the_ends_of_its_range() {
        for x in [-700.0, 700.0, -1e-300, 1e-17] {
            let (got, want) = (exp(&[x; LANES])[0], ops::exp(x));
            assert!((got - want).abs() <= 2.0 * f64::EPSILON * want, "{x}: {got} against {want}");
        }
    }
}
