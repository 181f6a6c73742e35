//! One pair of pictures to a map of differences.

use rayon::prelude::*;

use super::ErrorMap;
use super::colour::{difference, largest, opponent, seen};
use super::filter::{Filters, Plane};
use lobefit::report::Image;
use lobefit_math::ops;

/// LDR-FLIP of two pictures whose channels lie in [0, 1]: the difference in colour, raised to 1
/// less the difference in features.
pub(super) fn map(reference: &Image, test: &Image, filters: &Filters) -> ErrorMap {
    let (width, height) = (reference.width, reference.height);
    let [reference, test] = [reference, test].map(|image| Seen::new(image, filters));
    ErrorMap { width, height, values: reference.difference(&test) }
}

/// A picture as the eye gets it.
pub(super) struct Seen {
    /// Perceived colour of the blurred picture.
    blurred: Vec<[f64; 3]>,
    features: [Plane; 2],
}

impl Seen {
    pub fn new(image: &Image, filters: &Filters) -> Seen {
        let opponents: Vec<[f64; 3]> = image.pixels.iter().map(|&p| opponent(p)).collect();
        let planes = [0, 1, 2].map(|channel| opponents.iter().map(|p| p[channel]).collect::<Plane>());
        let luminance = planes[0].iter().map(|y| (y + 16.0) / 116.0).collect();
        let blurred = filters.blurred(&planes, image.width);
        let colour = |i: usize| seen([0, 1, 2].map(|channel| blurred[channel][i]));
        Seen {
            features: filters.features(&luminance, image.width),
            blurred: (0..image.pixels.len()).into_par_iter().map(colour).collect(),
        }
    }

    /// The difference of each pixel from another picture of the same size.
    pub fn difference(&self, test: &Seen) -> Vec<f64> {
        let largest = largest();
        let pixels = 0..self.blurred.len();
        let values = pixels.into_par_iter().map(|i| {
            let colour = difference(self.blurred[i], test.blurred[i], largest);
            ops::pow(colour, 1.0 - feature(self, test, i))
        });
        values.collect()
    }
}

/// The larger of the differences in edges and in points, in [0, 1]: over sqrt 2, the strongest that
/// a detector in two directions gives, and raised to q_f = 1/2 (2020, section 4.2).
fn feature(reference: &Seen, test: &Seen, i: usize) -> f64 {
    let strength = |kind: usize| (reference.features[kind][i] - test.features[kind][i]).abs();
    (strength(0).max(strength(1)) * std::f64::consts::FRAC_1_SQRT_2).sqrt()
}
