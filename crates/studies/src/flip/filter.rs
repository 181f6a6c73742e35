//! The blur of the eye and the detectors of edges and points, all of them sums of separable
//! kernels.

use rayon::prelude::*;

use lobefit_math::ops;

/// A plane of values, row by row.
pub(super) type Plane = Vec<f64>;

/// Weights of a centred window of odd length.
type Kernel = Vec<f64>;

/// Terms a sqrt(pi/b) exp(-pi^2 d^2/b) of the eye's response to an achromatic, a red-green and a
/// blue-yellow point in degrees: pairs (a, b) (2020, table 1).
const RESPONSE: [&[(f64, f64)]; 3] = [&[(1.0, 0.0047)], &[(1.0, 0.0053)], &[(34.1, 0.04), (13.5, 0.025)]];

/// Width of the detectors in degrees, twice their standard deviation (2020, section 4.2).
const DETECTOR: f64 = 0.082;

/// Standard deviations after which a kernel ends.
const REACH: f64 = 3.0;

/// The kernels at a resolution.
pub(super) struct Filters {
    /// For each channel, weighted kernels, to be applied along both axes.
    blur: [Vec<(f64, Kernel)>; 3],
    /// A Gaussian, its first derivative and its second.
    detector: [Kernel; 3],
}

impl Filters {
    /// The kernels for a number of pixels per degree of visual angle.
    pub fn new(pixels_per_degree: f64) -> Filters {
        Filters { blur: blur(pixels_per_degree), detector: detector(pixels_per_degree) }
    }

    /// The picture as the eye resolves it.
    pub fn blurred(&self, planes: &[Plane; 3], width: usize) -> [Plane; 3] {
        [0, 1, 2].map(|channel| {
            let plane = &planes[channel];
            let mut sum = vec![0.0; plane.len()];
            for (weight, kernel) in &self.blur[channel] {
                let part = both(plane, width, kernel, kernel);
                sum.iter_mut().zip(&part).for_each(|(s, p)| *s += weight * p);
            }
            sum
        })
    }

    /// Strength of edges and of points in a plane of luminance in [0, 1].
    pub fn features(&self, plane: &Plane, width: usize) -> [Plane; 2] {
        let [gauss, first, second] = &self.detector;
        [first, second].map(|kernel| {
            let along = both(plane, width, kernel, gauss);
            let across = both(plane, width, gauss, kernel);
            along.iter().zip(&across).map(|(x, y)| (x * x + y * y).sqrt()).collect()
        })
    }
}

fn blur(resolution: f64) -> [Vec<(f64, Kernel)>; 3] {
    let square = std::f64::consts::PI * std::f64::consts::PI;
    // One reach for all channels, that of the widest term.
    let widest = RESPONSE.iter().flat_map(|terms| terms.iter()).map(|t| t.1).fold(0.0, f64::max);
    let reach = (REACH * (widest / (2.0 * square)).sqrt() * resolution).ceil();
    RESPONSE.map(|terms| {
        let parts: Vec<(f64, Kernel)> = terms
            .iter()
            .map(|&(a, b)| {
                let kernel = window(reach, |x| ops::exp(-square * x * x / (b * resolution * resolution)));
                (a * (std::f64::consts::PI / b).sqrt(), kernel)
            })
            .collect();
        let volume = |(weight, kernel): &(f64, Kernel)| {
            let side: f64 = kernel.iter().sum();
            weight * side * side
        };
        let total: f64 = parts.iter().map(volume).sum();
        parts.into_iter().map(|(weight, kernel)| (weight / total, kernel)).collect()
    })
}

fn detector(resolution: f64) -> [Kernel; 3] {
    let deviation = 0.5 * DETECTOR * resolution;
    let square = deviation * deviation;
    let reach = (REACH * deviation).ceil();
    let gauss = |x: f64| ops::exp(-x * x / (2.0 * square));
    let total: f64 = window(reach, gauss).iter().sum();
    [
        window(reach, |x| gauss(x) / total),
        balanced(window(reach, |x| -x * gauss(x))),
        balanced(window(reach, |x| (x * x / square - 1.0) * gauss(x))),
    ]
}

fn window(reach: f64, f: impl Fn(f64) -> f64) -> Kernel {
    let reach = reach as i32;
    (-reach..=reach).map(|i| f(f64::from(i))).collect()
}

/// The weights scaled so that the positive ones add up to 1 and the negative ones to -1.
fn balanced(kernel: Kernel) -> Kernel {
    let above: f64 = kernel.iter().filter(|w| **w > 0.0).sum();
    let below: f64 = kernel.iter().filter(|w| **w < 0.0).sum();
    kernel.into_iter().map(|w| if w > 0.0 { w / above } else { -w / below }).collect()
}

/// A kernel along the rows, then one along the columns; beyond its border a picture continues as
/// its border.
fn both(plane: &Plane, width: usize, along: &Kernel, across: &Kernel) -> Plane {
    let height = plane.len() / width;
    let mut rows = vec![0.0; plane.len()];
    let reach = along.len() / 2;
    rows.par_chunks_mut(width).zip(plane.par_chunks(width)).for_each(|(out, line)| {
        let beside = |value: f64| std::iter::repeat_n(value, reach);
        let padded: Vec<f64> =
            beside(line[0]).chain(line.iter().copied()).chain(beside(line[width - 1])).collect();
        for (k, w) in along.iter().enumerate() {
            out.iter_mut().zip(&padded[k..]).for_each(|(o, r)| *o += w * r);
        }
    });
    let mut columns = vec![0.0; plane.len()];
    columns.par_chunks_mut(width).enumerate().for_each(|(y, out)| {
        for (w, i) in taps(across, y, height) {
            out.iter_mut().zip(&rows[i * width..]).for_each(|(o, r)| *o += w * r);
        }
    });
    columns
}

/// Weights of a kernel centred on `at` with the places that they stand for.
fn taps(kernel: &Kernel, at: usize, size: usize) -> impl Iterator<Item = (f64, usize)> {
    let reach = kernel.len() / 2;
    kernel.iter().enumerate().map(move |(k, &w)| (w, (at + k).saturating_sub(reach).min(size - 1)))
}
