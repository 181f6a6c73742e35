//! Texel values of a table of any number of axes, optimised for its linear lookup: bilinear of two
//! axes, trilinear of three.
//!
//! The samples lie on a lattice that divides every cell. The texels start exact at their nodes and
//! are relaxed: each texel moves by part of half the sum of the largest and the smallest error in
//! the cells around it, which balances the two. One step solves the problem for a parabola. The
//! error falls to about half of what exact values leave. On the 2-D tables of GGX a hundred rounds
//! end 0.1 to 0.6 % below sixty of Lawson's iteration for linear Chebyshev approximation.

use std::ops::Range;

use rayon::prelude::*;

/// A lattice of samples over a table; the first axis is the fastest.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Lattice {
    /// Texels along each axis, two or more.
    pub size: Vec<usize>,
    /// Samples from one texel to the next along each axis, one or more.
    pub per_cell: Vec<usize>,
    /// Samples before the first and after the last texel of each axis, where a lookup clamps to it.
    pub beyond: Vec<usize>,
}

impl Lattice {
    /// Samples along each axis.
    pub fn samples(&self) -> Vec<usize> {
        (0..self.size.len()).map(|axis| self.along(axis)).collect()
    }

    /// Position in texels of a sample along an axis: below 0 before the first texel.
    pub fn position(&self, axis: usize, sample: usize) -> f64 {
        (sample as f64 - self.beyond[axis] as f64) / self.per_cell[axis] as f64
    }

    /// Samples along an axis.
    fn along(&self, axis: usize) -> usize {
        (self.size[axis] - 1) * self.per_cell[axis] + 1 + 2 * self.beyond[axis]
    }

    /// The texel before a sample and the fraction to the next.
    fn cell(&self, axis: usize, sample: usize) -> (usize, f64) {
        let (step, size) = (self.per_cell[axis], self.size[axis]);
        let sample = sample.saturating_sub(self.beyond[axis]).min((size - 1) * step);
        let base = (sample / step).min(size - 2);
        (base, (sample - base * step) as f64 / step as f64)
    }

    /// Samples that a texel takes part in.
    fn support(&self, axis: usize, texel: usize) -> Range<usize> {
        let (step, beyond) = (self.per_cell[axis], self.beyond[axis]);
        let middle = beyond + texel * step;
        let first = if texel == 0 { 0 } else { middle - (step - 1) };
        let last = texel + 1 == self.size[axis];
        first..if last { self.along(axis) } else { middle + step }
    }
}

/// What the lookup must return at the samples of a lattice.
#[derive(Clone, Debug, PartialEq)]
pub struct Wanted {
    /// Values.
    pub targets: Vec<f64>,
    /// Factor in [0, 1] from an error of the lookup to the error that counts: 0 where nothing is
    /// looked up.
    pub weights: Vec<f64>,
}

/// Part of the balancing step that is taken: neighbours move too.
const DAMPING: f64 = 0.7;

/// Improves `start`, values exact at the texels, in `rounds` of relaxation. Returns the texels with
/// the smallest maximum of weight |lookup - target| met on the way, and that maximum; never worse
/// than `start`. The bits do not depend on the thread count.
///
/// # Panics
/// If a slice's length is not that of the lattice, or the lattice is thinner than two texels.
pub fn optimise(lattice: &Lattice, start: &[f64], wanted: &Wanted, rounds: usize) -> (Vec<f64>, f64) {
    let count: usize = lattice.samples().iter().product();
    assert_eq!([lattice.per_cell.len(), lattice.beyond.len()], [lattice.size.len(); 2], "axes");
    assert!(lattice.size.iter().all(|n| *n >= 2) && lattice.per_cell.iter().all(|n| *n >= 1));
    assert_eq!(start.len(), lattice.size.iter().product::<usize>(), "texels");
    assert_eq!((wanted.targets.len(), wanted.weights.len()), (count, count), "samples");
    let grid = Grid::new(lattice);
    let mut texels = start.to_vec();
    let mut best = (start.to_vec(), f64::INFINITY);
    for round in 0..=rounds {
        let (largest, around) = grid.residuals(&texels, wanted);
        if round == 0 || largest < best.1 {
            best.0.copy_from_slice(&texels);
            best.1 = largest;
        }
        for (texel, Extremes { low, high }) in texels.iter_mut().zip(around) {
            *texel -= DAMPING * 0.5 * (low + high);
        }
    }
    best
}

/// What the lookup of some texels returns at every sample.
pub fn looked_up(lattice: &Lattice, texels: &[f64]) -> Vec<f64> {
    let mut samples = Vec::with_capacity(lattice.samples().iter().product());
    Grid::new(lattice).fill(lattice.size.len(), texels, &mut samples);
    samples
}

/// The smallest and the largest of some errors.
#[derive(Clone, Copy)]
struct Extremes {
    low: f64,
    high: f64,
}

impl Extremes {
    const NONE: Extremes = Extremes { low: f64::INFINITY, high: f64::NEG_INFINITY };

    fn and(&mut self, other: Extremes) {
        self.low = if other.low < self.low { other.low } else { self.low };
        self.high = if other.high > self.high { other.high } else { self.high };
    }
}

/// The cells of a lattice's samples, and the samples of its texels, along each axis.
struct Grid {
    size: Vec<usize>,
    cells: Vec<Vec<(usize, f64)>>,
    supports: Vec<Vec<Range<usize>>>,
}

impl Grid {
    fn new(lattice: &Lattice) -> Grid {
        let cells = |axis: usize| (0..lattice.along(axis)).map(|sample| lattice.cell(axis, sample)).collect();
        let supports =
            |axis: usize| (0..lattice.size[axis]).map(|texel| lattice.support(axis, texel)).collect();
        let axes = 0..lattice.size.len();
        let (cells, supports) = (axes.clone().map(cells).collect(), axes.map(supports).collect());
        Grid { size: lattice.size.clone(), cells, supports }
    }

    /// The largest magnitude of weight (lookup - target), and its extremes around every texel.
    fn residuals(&self, texels: &[f64], wanted: &Wanted) -> (f64, Vec<Extremes>) {
        let last = self.size.len() - 1;
        let stride = wanted.targets.len() / self.cells[last].len();
        let targets = wanted.targets.par_chunks(stride).zip(wanted.weights.par_chunks(stride));
        let parts: Vec<(f64, Vec<Extremes>)> = targets
            .zip(&self.cells[last])
            .map(|(wanted, cell)| self.around(last, &between(texels, self.size[last], *cell), wanted))
            .collect();
        let largest = parts.iter().map(|(largest, _)| *largest).fold(0.0, f64::max);
        let length = texels.len() / self.size[last];
        let merged = |samples: &Range<usize>| {
            let mut around = vec![Extremes::NONE; length];
            for (_, part) in &parts[samples.clone()] {
                around.iter_mut().zip(part).for_each(|(all, one)| all.and(*one));
            }
            around
        };
        let around: Vec<Vec<Extremes>> = self.supports[last].par_iter().map(merged).collect();
        (largest, around.concat())
    }

    /// The same over the first `axes` axes, of some texels, targets and weights.
    fn around(
        &self,
        axes: usize,
        texels: &[f64],
        (targets, weights): (&[f64], &[f64]),
    ) -> (f64, Vec<Extremes>) {
        let Some(last) = axes.checked_sub(1) else {
            let error = weights[0] * (texels[0] - targets[0]);
            return (error.abs(), vec![Extremes { low: error, high: error }]);
        };
        if last == 0 {
            return self.along_line(texels, (targets, weights));
        }
        let stride = targets.len() / self.cells[last].len();
        let samples = targets.chunks_exact(stride).zip(weights.chunks_exact(stride));
        let (mut largest, mut around) = (0.0_f64, vec![Extremes::NONE; texels.len()]);
        let length = texels.len() / self.size[last];
        for (sample, (wanted, cell)) in samples.zip(&self.cells[last]).enumerate() {
            let (worst, part) = self.around(last, &between(texels, self.size[last], *cell), wanted);
            largest = largest.max(worst);
            // A sample takes part in no texels but the two of its cell.
            let near = cell.0..cell.0 + 2;
            for texel in near.filter(|texel| self.supports[last][*texel].contains(&sample)) {
                let all = &mut around[texel * length..(texel + 1) * length];
                all.iter_mut().zip(&part).for_each(|(all, one)| all.and(*one));
            }
        }
        (largest, around)
    }

    /// The same along the first axis.
    fn along_line(&self, texels: &[f64], (targets, weights): (&[f64], &[f64])) -> (f64, Vec<Extremes>) {
        let mut largest = 0.0_f64;
        let mut errors = Vec::with_capacity(targets.len());
        for (((base, f), target), weight) in self.cells[0].iter().zip(targets).zip(weights) {
            let found = texels[*base] + (texels[base + 1] - texels[*base]) * f;
            let error = weight * (found - target);
            largest = largest.max(error.abs());
            errors.push(error);
        }
        let extremes = |samples: &Range<usize>| {
            let mut all = Extremes::NONE;
            errors[samples.clone()].iter().for_each(|error| all.and(Extremes { low: *error, high: *error }));
            all
        };
        (largest, self.supports[0].iter().map(extremes).collect())
    }

    /// Looks up every sample of the first `axes` axes.
    fn fill(&self, axes: usize, texels: &[f64], samples: &mut Vec<f64>) {
        match axes.checked_sub(1) {
            None => samples.extend_from_slice(texels),
            Some(last) => {
                for cell in &self.cells[last] {
                    self.fill(last, &between(texels, self.size[last], *cell), samples);
                }
            }
        }
    }
}

/// Between two neighbours of `count` equal parts, which lie one after the other.
fn between(values: &[f64], count: usize, (base, f): (usize, f64)) -> Vec<f64> {
    let length = values.len() / count;
    let (low, high) = values[base * length..(base + 2) * length].split_at(length);
    low.iter().zip(high).map(|(a, b)| a + (b - a) * f).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lattice(size: &[usize], per_cell: &[usize]) -> Lattice {
        Lattice { size: size.to_vec(), per_cell: per_cell.to_vec(), beyond: vec![0; size.len()] }
    }

    /// Values of a function of positions in texels at the texels, and at the samples.
    fn wanted(lattice: &Lattice, f: impl Fn(&[f64]) -> f64) -> (Vec<f64>, Wanted) {
        let values = |per_cell: &[usize]| -> Vec<f64> {
            let beyond =
                if per_cell == lattice.per_cell { lattice.beyond.clone() } else { vec![0; per_cell.len()] };
            let grid = Lattice { size: lattice.size.clone(), per_cell: per_cell.to_vec(), beyond };
            let place = |mut i: usize| -> Vec<f64> {
                let along = |(axis, n): (usize, usize)| {
                    let at = grid.position(axis, i % n);
                    i /= n;
                    at
                };
                grid.samples().into_iter().enumerate().map(along).collect()
            };
            (0..grid.samples().iter().product()).map(|i| f(&place(i))).collect()
        };
        let targets = values(&lattice.per_cell);
        let weights = vec![1.0; targets.len()];
        (values(&vec![1; lattice.size.len()]), Wanted { targets, weights })
    }

    /// Of one to four axes.
    fn lattices() -> [Lattice; 4] {
        [
            lattice(&[9], &[4]),
            lattice(&[6, 5], &[4, 3]),
            lattice(&[5, 4, 3], &[2, 3, 4]),
            lattice(&[4, 3, 3, 2], &[2, 2, 3, 2]),
        ]
    }

    #[test]
    fn what_is_linear_along_each_axis_is_left_alone() {
        for lattice in lattices() {
            let f = |x: &[f64]| x.iter().fold(1.0, |product, x| product * (1.0 + 0.1 * x));
            let (start, wanted) = wanted(&lattice, f);
            let (texels, error) = optimise(&lattice, &start, &wanted, 10);
            assert!(error < 1e-14, "{error}");
            assert!(texels.iter().zip(&start).all(|(a, b)| (a - b).abs() < 1e-13));
        }
    }

    /// Parabolas along all axes: interpolation errs by h^2 f''/8 for each axis to one side at the
    /// middle of a cell; shifting every texel by half of the sum halves it, and nothing does
    /// better.
    #[test]
    fn a_paraboloid_reaches_half_the_interpolation_error() {
        for lattice in [lattice(&[9], &[16]), lattice(&[9, 6], &[2, 2]), lattice(&[9, 6, 5], &[2, 2, 2])] {
            let (start, wanted) = wanted(&lattice, |x| x.iter().map(|x| x * x).sum());
            let least = 0.125 * lattice.size.len() as f64;
            let (_, before) = optimise(&lattice, &start, &wanted, 0);
            let (_, after) = optimise(&lattice, &start, &wanted, 20);
            assert!(
                (before - 2.0 * least).abs() < 1e-12 && (least..1.003 * least).contains(&after),
                "{after}"
            );
        }
    }

    /// Beyond the first and the last texel a lookup clamps: half of the slope's rise over half a
    /// cell is left there, where exact texels leave all of it.
    #[test]
    fn a_clamped_end_is_balanced() {
        for lattice in [lattice(&[9], &[8]), lattice(&[9, 5], &[8, 4])] {
            let beyond = lattice.per_cell.iter().map(|n| n / 2).collect();
            let lattice = Lattice { beyond, ..lattice };
            assert_eq!((lattice.position(0, 0), lattice.samples()[0]), (-0.5, 73));
            let (start, wanted) = wanted(&lattice, |x| lobefit_math::ops::exp(-x[0]));
            let (_, before) = optimise(&lattice, &start, &wanted, 0);
            let (_, after) = optimise(&lattice, &start, &wanted, 60);
            assert!((before - (lobefit_math::ops::exp(0.5) - 1.0)).abs() < 1e-12, "{before}");
            assert!((after - 0.5 * before).abs() < 0.1 * before, "{after} {before}");
        }
    }

    #[test]
    fn never_worse_than_the_start_and_the_same_on_any_number_of_threads() {
        for lattice in lattices() {
            let f = |x: &[f64]| x.iter().enumerate().map(|(k, x)| (x - 1.3 - k as f64 * 0.2).abs()).sum();
            let (start, mut wanted) = wanted(&lattice, f);
            for (i, weight) in wanted.weights.iter_mut().enumerate() {
                *weight = (i % 7) as f64 / 6.0;
            }
            let run = || optimise(&lattice, &start, &wanted, 15);
            let (_, before) = optimise(&lattice, &start, &wanted, 0);
            let pool = |n| rayon::ThreadPoolBuilder::new().num_threads(n).build().expect("a pool");
            let (one, three) = (pool(1).install(run), pool(3).install(run));
            assert_eq!(one, three);
            assert!(one.1 < 0.95 * before, "{} {before}", one.1);
        }
    }

    #[test]
    fn texels_that_no_sample_touches_stay_as_they_are() {
        for lattice in [lattice(&[8, 4], &[4, 4]), lattice(&[8, 3, 3], &[2, 2, 2])] {
            let (start, mut wanted) = wanted(&lattice, |x| x.iter().map(|x| x * x).sum());
            let columns = lattice.samples()[0];
            for (i, weight) in wanted.weights.iter_mut().enumerate() {
                *weight = if i % columns >= 4 * lattice.per_cell[0] { 1.0 } else { 0.0 };
            }
            let (texels, _) = optimise(&lattice, &start, &wanted, 8);
            for i in (0..texels.len()).filter(|i| i % 8 < 4) {
                assert_eq!(texels[i], start[i], "{i}");
            }
        }
    }
}
