//! The natural logarithm of eight values at a time, as [`super::lanes`] does exp.

use super::lanes::{F8, LANES};

/// Bits of sqrt(1/2): numbers with mantissas from there to sqrt(2) keep their logarithm's argument near 1.
const ROOT_HALF: u64 = 0x3fe6_a09e_667f_3bcd;
/// 2^52 + 2^51: adding it to a small integer leaves that integer in the low bits of the mantissa.
const SHIFT: f64 = 6_755_399_441_055_744.0;
/// ln 2 split so that k * LN2_HI is exact for |k| < 2^11 (Cody and Waite).
const LN2_HI: f64 = 6.931_471_803_691_238e-1;
const LN2_LO: f64 = 1.908_214_929_270_588e-10;

/// ln of eight normal positive values, within 3e-16 of max(|ln x|, 1) (tested against `libm`); of anything else it is meaningless.
#[inline(always)]
pub fn ln(x: &F8) -> F8 {
    let mut out = [0.0; LANES];
    for i in 0..LANES {
        // x = 2^k m with m in [sqrt(1/2), sqrt(2)): the exponent's field, biased to stay positive, then as a float.
        let shifted = x[i].to_bits().wrapping_sub(ROOT_HALF).wrapping_add(1 << 62);
        let biased = f64::from_bits((shifted >> 52) | SHIFT.to_bits());
        let k = biased - (SHIFT + 1024.0);
        let m = f64::from_bits((shifted & 0x000f_ffff_ffff_ffff).wrapping_add(ROOT_HALF));
        out[i] = k * LN2_HI + (mantissa(m) + k * LN2_LO);
    }
    out
}

/// ln(m) = 2 atanh(s), s = (m-1)/(m+1), |s| <= 0.1716: the series to s^21 leaves 2e-19.
#[inline(always)]
fn mantissa(m: f64) -> f64 {
    let s = (m - 1.0) / (m + 1.0);
    let z = s * s;
    let z2 = z * z;
    let z4 = z2 * z2;
    let a = (1.0 / 3.0 + z * (1.0 / 5.0)) + z2 * (1.0 / 7.0 + z * (1.0 / 9.0));
    let b = (1.0 / 11.0 + z * (1.0 / 13.0)) + z2 * (1.0 / 15.0 + z * (1.0 / 17.0));
    let c = 1.0 / 19.0 + z * (1.0 / 21.0);
    let tail = a + z4 * (b + z4 * c);
    2.0 * (s + s * z * tail)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::ops;

    #[test]
    fn ln_agrees_with_libm() {
        let mut worst = 0.0_f64;
        for step in 0..200_000 {
            let x = ops::exp(-600.0 + 1200.0 * f64::from(step) / 200_000.0);
            for x in [x, 1.0 + 1e-3 * (x.min(2.0) - 1.0)] {
                let (got, want) = (ln(&[x; LANES])[5], ops::log(x));
                worst = worst.max((got - want).abs() / want.abs().max(1.0));
            }
        }
        assert!(worst <= 3e-16, "worst {worst:e}");
        assert_eq!(ln(&[1.0; LANES])[0], 0.0);
        assert_eq!(ln(&[f64::MIN_POSITIVE; LANES])[0], ops::log(f64::MIN_POSITIVE));
    }
}
