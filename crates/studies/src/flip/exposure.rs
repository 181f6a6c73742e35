//! HDR-FLIP: the largest LDR-FLIP over the exposures at which the reference can be shown.

use super::difference::Seen;
use super::filter::Filters;
use super::{ErrorMap, FlipError, light, of_one_size, resolution};
use lobefit::report::{Image, luminance};
use lobefit_math::ops;

/// Narkowicz's fit of the ACES film curve with the exposure of 0.6 that goes before it, (k0
/// x^2 + k1 x + k2)/(k3 x^2 + k4 x + k5): the tone mapper of the paper.
const ACES: [f64; 6] = [0.6 * 0.6 * 2.51, 0.6 * 0.03, 0.0, 0.6 * 0.6 * 2.43, 0.6 * 0.59, 0.14];

/// Shown value that is bright: the brightest pixel has it at the first exposure, the median at the
/// last (2021, section 3).
const BRIGHT: f64 = 0.85;

/// Least median that is taken for one, 2^-23: below, a reference that is black in half of its
/// pixels would have no last exposure.
const LEAST_MEDIAN: f64 = 1.0 / 8_388_608.0;

/// Most light of a channel of a picture of high dynamic range: a factor of 1e8 below the end of
/// f64, which a luminance must not reach.
const LIGHT: (f64, &str) = (1e300, "a number from 0 to 1e300");

/// The exposures of a comparison, in stops (powers of two).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exposures {
    /// The darkest.
    pub start: f64,
    /// The brightest.
    pub stop: f64,
    /// How many, evenly spaced with both ends; at least 2.
    pub count: usize,
}

impl Exposures {
    /// Those that the paper chooses for a reference.
    ///
    /// # Errors
    /// A reference that has no light: no exposure shows it.
    pub fn of(reference: &Image) -> Result<Exposures, FlipError> {
        let mut light: Vec<f64> = reference.pixels.iter().map(|&p| luminance(p)).collect();
        light.sort_by(f64::total_cmp);
        let (brightest, half) = (light.last().copied().unwrap_or(0.0), light.len() / 2);
        if brightest <= 0.0 {
            let message = "the reference is black everywhere, so no exposure can be chosen";
            return Err(FlipError(message.into()));
        }
        // The upper of the two in the middle, as the authors' program takes it.
        let median = light[half];
        let bright = shown_as(BRIGHT);
        // Logarithms apart: the quotient by a subnormal number overflows.
        let stops = |light: f64| ops::log2(bright) - ops::log2(light);
        let (start, stop) = (stops(brightest), stops(median.max(LEAST_MEDIAN)));
        Ok(Exposures { start, stop, count: ((stop - start).ceil() as usize).max(2) })
    }

    /// The exposures in stops, from the darkest.
    pub fn all(self) -> impl Iterator<Item = f64> {
        let last = (self.count.max(2) - 1) as f64;
        (0..self.count).map(move |i| self.start + (self.stop - self.start) * (i as f64 / last))
    }
}

/// A reference as the eye sees it at every exposure of [`Exposures::of`], made once and compared with
/// many pictures by HDR-FLIP.
pub struct Reference {
    /// Its exposures.
    pub exposures: Exposures,
    filters: Filters,
    size: (usize, usize),
    /// It at each exposure, in stops.
    seen: Vec<(f64, Seen)>,
}

impl Reference {
    /// A reference whose channels lie in [0, 1e300].
    ///
    /// # Errors
    /// A channel that is negative, above 1e300 or not a number, a black reference, a resolution that
    /// is none.
    pub fn new(reference: &Image, pixels_per_degree: f64) -> Result<Reference, FlipError> {
        resolution(pixels_per_degree)?;
        light("reference", reference, LIGHT)?;
        let (filters, exposures) = (Filters::new(pixels_per_degree), Exposures::of(reference)?);
        let at = |stops: f64| (stops, Seen::new(&shown(reference, stops), &filters));
        let seen = exposures.all().map(at).collect();
        Ok(Reference { exposures, size: (reference.width, reference.height), seen, filters })
    }

    /// The largest difference of each pixel over the exposures.
    ///
    /// # Errors
    /// A picture of another size; a channel that is negative, above 1e300 or not a number.
    pub fn against(&self, test: &Image) -> Result<ErrorMap, FlipError> {
        of_one_size(self.size, test)?;
        light("test", test, LIGHT)?;
        let (width, height) = self.size;
        let mut worst = ErrorMap { width, height, values: vec![0.0; width * height] };
        for (stops, reference) in &self.seen {
            let values = reference.difference(&Seen::new(&shown(test, *stops), &self.filters));
            worst.values.iter_mut().zip(&values).for_each(|(w, v)| *w = w.max(*v));
        }
        Ok(worst)
    }
}

/// A picture at an exposure, in stops, through the tone mapper: every channel in [0, 1]. The
/// exposure is of 1080 at most, either way, as all of [`Exposures::of`] are.
pub fn shown(image: &Image, stops: f64) -> Image {
    // In two steps where 2^stops is no normal number.
    let (first, second) = if stops.abs() < 1000.0 { (stops, 0.0) } else { (stops / 2.0, stops / 2.0) };
    let gains = [ops::exp2(first), ops::exp2(second)];
    let pixels = image.pixels.iter().map(|p| p.map(|x| mapped(gains[0] * x * gains[1]))).collect();
    Image { width: image.width, height: image.height, pixels }
}

/// The tone mapper, cut to [0, 1]; numerator and denominator over x^2 where x is large, so that
/// neither overflows.
fn mapped(x: f64) -> f64 {
    let [k0, k1, k2, k3, k4, k5] = ACES;
    let y = if x > 1.0 {
        let r = 1.0 / x;
        (k0 + r * (k1 + r * k2)) / (k3 + r * (k4 + r * k5))
    } else {
        (x * (k0 * x + k1) + k2) / (x * (k3 * x + k4) + k5)
    };
    y.clamp(0.0, 1.0)
}

/// The light that the tone mapper shows as `y`, below the curve's end k0/k3: the positive root of
/// its quadratic.
fn shown_as(y: f64) -> f64 {
    let [k0, k1, k2, k3, k4, k5] = ACES;
    let (a, b, c) = (k0 - y * k3, k1 - y * k4, k2 - y * k5);
    (-b + (b * b - 4.0 * a * c).sqrt()) / (2.0 * a)
}
