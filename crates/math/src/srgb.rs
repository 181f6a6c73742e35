//! The transfer curve of sRGB (IEC 61966-2-1), of values in [0, 1].

use crate::ops::pow;

/// The linear value of an encoded one.
pub fn decoded(x: f64) -> f64 {
    if x <= 0.04045 { x / 12.92 } else { pow((x + 0.055) / 1.055, 2.4) }
}

/// The encoded value of a linear one.
pub fn encoded(x: f64) -> f64 {
    if x <= 0.04045 / 12.92 { x * 12.92 } else { 1.055 * pow(x, 1.0 / 2.4) - 0.055 }
}
