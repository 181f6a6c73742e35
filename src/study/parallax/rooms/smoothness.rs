//! Creases: errors in the second differences of what is displayed.

use super::view::Pixel;
use crate::math::{ops, sum};
use crate::report::{Image, luminance};

/// Mean absolute error of the second differences, in steps of displayed luminance in [0, 1].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Creases {
    /// Where the mirror rays of neighbours meet two walls: the edges of the proxy in the picture.
    pub edges: f64,
    /// Farther than a pixel from there.
    pub elsewhere: f64,
}

/// A displayed value is about this power of light (sRGB's curve).
const DISPLAY: f64 = 1.0 / 2.2;

/// Of two pictures as shown. 0 where a picture has no such pixels.
pub(super) fn creases(test: &Image, reference: &Image, pixels: &[Pixel]) -> Creases {
    let side = test.width;
    let shown = |image: &Image| -> Vec<f64> {
        image.pixels.iter().map(|&pixel| ops::pow(luminance(pixel), DISPLAY)).collect()
    };
    let (test, reference) = (shown(test), shown(reference));
    let second =
        |values: &[f64], i: usize, step: usize| values[i - step] - 2.0 * values[i] + values[i + step];
    let (mut edges, mut elsewhere) = (Vec::new(), Vec::new());
    for row in 2..side - 2 {
        for column in 2..side - 2 {
            let i = row * side + column;
            let near = |k: usize| {
                [i - k, i + k, i - k * side, i + k * side].iter().all(|&j| pixels[j].place.is_some())
            };
            if pixels[i].place.is_none() || !near(1) || !near(2) {
                continue;
            }
            let crossed = |k: usize| {
                [i - k, i + k, i - k * side, i + k * side].iter().any(|&j| pixels[j].met != pixels[i].met)
            };
            let error = [1, side].map(|step| (second(&test, i, step) - second(&reference, i, step)).abs());
            let error = 0.5 * (error[0] + error[1]);
            match (crossed(1), crossed(2)) {
                (true, _) => edges.push(error),
                (false, false) => elsewhere.push(error),
                (false, true) => {}
            }
        }
    }
    let mean = |errors: &[f64]| if errors.is_empty() { 0.0 } else { sum::mean(errors) };
    Creases { edges: mean(&edges), elsewhere: mean(&elsewhere) }
}
