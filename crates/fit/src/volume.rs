//! Texel values of a table of three axes, optimised for the trilinear lookup.
//!
//! The samples lie on a lattice that divides every cell. A table of half a million texels is too large for the exact
//! Chebyshev approximation of [`super::texels`]; the values are relaxed instead: each texel moves by half of the largest plus
//! the smallest error in the cells around it, which puts those two in balance. One step solves the problem for a parabola;
//! a dozen settle a table. The error falls to about half of what values exact at the texels leave.

use rayon::prelude::*;

/// A lattice of samples over a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Lattice {
    /// Texels along each axis, two or more; the first axis fastest.
    pub size: [usize; 3],
    /// Samples from one texel to the next along each axis, one or more.
    pub per_cell: [usize; 3],
}

impl Lattice {
    /// Samples along each axis.
    pub fn samples(&self) -> [usize; 3] {
        [0, 1, 2].map(|k| (self.size[k] - 1) * self.per_cell[k] + 1)
    }

    /// Position in texels of a sample along an axis.
    pub fn position(&self, axis: usize, sample: usize) -> f64 {
        sample as f64 / self.per_cell[axis] as f64
    }

    /// The texel before a sample and the fraction to the next.
    fn cell(&self, axis: usize, sample: usize) -> (usize, f64) {
        let base = (sample / self.per_cell[axis]).min(self.size[axis] - 2);
        (base, (sample - base * self.per_cell[axis]) as f64 / self.per_cell[axis] as f64)
    }

    /// Samples that a texel takes part in.
    fn support(&self, axis: usize, texel: usize) -> std::ops::Range<usize> {
        let (middle, reach) = (texel * self.per_cell[axis], self.per_cell[axis] - 1);
        middle.saturating_sub(reach)..(middle + reach + 1).min(self.samples()[axis])
    }
}

/// What the lookup must return at the samples of a lattice, the first axis fastest.
#[derive(Clone, Debug, PartialEq)]
pub struct Wanted {
    /// Values.
    pub targets: Vec<f64>,
    /// Whether the error at a sample counts: false where nobody looks.
    pub counts: Vec<bool>,
}

/// Part of the balancing step that is taken: neighbours move too.
const DAMPING: f64 = 0.7;

/// Improves `start`, values exact at the texels, in `rounds` of relaxation. Returns the texels with the smallest maximum of
/// |lookup - target| met on the way, and that maximum; never worse than `start`. The bits do not depend on the thread count.
///
/// # Panics
/// If a slice's length is not that of the lattice, or the lattice is thinner than two texels.
pub fn optimise(lattice: Lattice, start: &[f64], wanted: &Wanted, rounds: usize) -> (Vec<f64>, f64) {
    let count: usize = lattice.samples().iter().product();
    assert!(lattice.size.iter().all(|n| *n >= 2) && lattice.per_cell.iter().all(|n| *n >= 1));
    assert_eq!(start.len(), lattice.size.iter().product::<usize>(), "texels");
    assert_eq!((wanted.targets.len(), wanted.counts.len()), (count, count), "samples");
    let mut errors = vec![0.0; count];
    let mut texels = start.to_vec();
    let mut best = (start.to_vec(), residuals(lattice, &texels, wanted, &mut errors));
    for _ in 0..rounds {
        relax(lattice, &errors, &mut texels);
        let largest = residuals(lattice, &texels, wanted, &mut errors);
        if largest < best.1 {
            best.0.copy_from_slice(&texels);
            best.1 = largest;
        }
    }
    best
}

/// lookup - target at every sample that counts, 0 at the others; returns the largest magnitude.
fn residuals(lattice: Lattice, texels: &[f64], wanted: &Wanted, errors: &mut [f64]) -> f64 {
    let [columns, rows, _] = lattice.samples();
    let plane = columns * rows;
    let planes = errors
        .par_chunks_mut(plane)
        .zip(wanted.targets.par_chunks(plane))
        .zip(wanted.counts.par_chunks(plane));
    let worst: Vec<f64> = planes
        .enumerate()
        .map(|(k, ((errors, targets), counts))| {
            let slice = blend(texels, lattice.size[0] * lattice.size[1], lattice.cell(2, k));
            let mut worst = 0.0_f64;
            for j in 0..rows {
                let row = blend(&slice, lattice.size[0], lattice.cell(1, j));
                for i in 0..columns {
                    let ((column, f), at) = (lattice.cell(0, i), j * columns + i);
                    let value = row[column] + (row[column + 1] - row[column]) * f;
                    errors[at] = if counts[at] { value - targets[at] } else { 0.0 };
                    worst = worst.max(errors[at].abs());
                }
            }
            worst
        })
        .collect();
    worst.into_iter().fold(0.0, f64::max)
}

/// Between two neighbouring slices, or rows, of `length` values.
fn blend(values: &[f64], length: usize, (base, f): (usize, f64)) -> Vec<f64> {
    let (low, high) = values[base * length..(base + 2) * length].split_at(length);
    low.iter().zip(high).map(|(a, b)| a + (b - a) * f).collect()
}

/// Moves every texel towards the balance of the extreme errors around it.
fn relax(lattice: Lattice, errors: &[f64], texels: &mut [f64]) {
    let [columns, rows, _] = lattice.samples();
    let planes: Vec<Vec<Ends>> =
        errors.par_chunks(columns * rows).map(|plane| around_rows(lattice, plane)).collect();
    texels.par_chunks_mut(lattice.size[0] * lattice.size[1]).enumerate().for_each(|(slice, texels)| {
        for (i, texel) in texels.iter_mut().enumerate() {
            let Ends { low, high } = ends(planes[lattice.support(2, slice)].iter().map(|plane| plane[i]));
            *texel -= DAMPING * 0.5 * (low + high);
        }
    });
}

/// The smallest and the largest of some errors.
#[derive(Clone, Copy)]
struct Ends {
    low: f64,
    high: f64,
}

fn ends(of: impl Iterator<Item = Ends>) -> Ends {
    of.fold(Ends { low: f64::INFINITY, high: f64::NEG_INFINITY }, |all, one| Ends {
        low: all.low.min(one.low),
        high: all.high.max(one.high),
    })
}

/// The extreme errors of one plane of samples around every texel of a slice: along columns first, then rows.
fn around_rows(lattice: Lattice, plane: &[f64]) -> Vec<Ends> {
    let ([width, height, _], columns) = (lattice.size, lattice.samples()[0]);
    let spans: Vec<_> = (0..width).map(|column| lattice.support(0, column)).collect();
    let around = |row: &[f64]| -> Vec<Ends> {
        let one = |e: &f64| Ends { low: *e, high: *e };
        spans.iter().map(|span| ends(row[span.clone()].iter().map(one))).collect()
    };
    let narrow: Vec<Vec<Ends>> = plane.chunks_exact(columns).map(around).collect();
    let texel = |row, column: usize| ends(narrow[lattice.support(1, row)].iter().map(|line| line[column]));
    (0..height)
        .flat_map(|row| (0..width).map(move |column| (row, column)))
        .map(|(r, c)| texel(r, c))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wanted(lattice: Lattice, f: impl Fn([f64; 3]) -> f64) -> (Vec<f64>, Wanted) {
        let values = |step: [usize; 3]| -> Vec<f64> {
            let [x, y, z] = [0, 1, 2].map(|k| (lattice.size[k] - 1) * step[k] + 1);
            let at = |axis: usize, i: usize| i as f64 / step[axis] as f64;
            (0..x * y * z).map(|i| f([at(0, i % x), at(1, i / x % y), at(2, i / x / y)])).collect()
        };
        let targets = values(lattice.per_cell);
        let counts = vec![true; targets.len()];
        (values([1; 3]), Wanted { targets, counts })
    }

    #[test]
    fn a_trilinear_function_is_left_alone() {
        let lattice = Lattice { size: [5, 4, 3], per_cell: [2, 3, 4] };
        let f = |[x, y, z]: [f64; 3]| 1.0 + 0.3 * x - 0.2 * y + 0.1 * z + 0.05 * x * y * z;
        let (start, wanted) = wanted(lattice, f);
        let (texels, error) = optimise(lattice, &start, &wanted, 10);
        assert!(error < 1e-14, "{error}");
        assert!(texels.iter().zip(&start).all(|(a, b)| (a - b).abs() < 1e-13));
    }

    /// Parabolas along all three axes: interpolation errs by 3 h^2 f''/8 to one side at the middle of a cell; shifting every texel by half
    /// of it halves it.
    #[test]
    fn a_paraboloid_reaches_half_the_interpolation_error() {
        let lattice = Lattice { size: [9, 6, 5], per_cell: [2, 2, 2] };
        let (start, wanted) = wanted(lattice, |[x, y, z]| x * x + y * y + z * z);
        let (_, before) = optimise(lattice, &start, &wanted, 0);
        let (_, after) = optimise(lattice, &start, &wanted, 20);
        assert!((before - 0.75).abs() < 1e-12 && (0.375..0.376).contains(&after), "{before} {after}");
    }

    #[test]
    fn never_worse_than_the_start_and_the_same_on_any_number_of_threads() {
        let lattice = Lattice { size: [6, 5, 4], per_cell: [3, 2, 2] };
        let f = |[x, y, z]: [f64; 3]| ((x - 2.3).abs() + 0.3 * y) * (1.0 + (z - 1.7).abs());
        let (start, mut wanted) = wanted(lattice, f);
        for (i, counts) in wanted.counts.iter_mut().enumerate() {
            *counts = i % 7 != 0;
        }
        let run = || optimise(lattice, &start, &wanted, 15);
        let (_, before) = optimise(lattice, &start, &wanted, 0);
        let pool = |n| rayon::ThreadPoolBuilder::new().num_threads(n).build().expect("a pool");
        let (one, three) = (pool(1).install(run), pool(3).install(run));
        assert_eq!(one, three);
        assert!(one.1 < 0.9 * before, "{} {before}", one.1);
    }

    #[test]
    fn texels_nobody_looks_at_keep_their_value() {
        let lattice = Lattice { size: [8, 3, 3], per_cell: [2, 2, 2] };
        let (start, mut wanted) = wanted(lattice, |[x, y, z]| x * x + y + z);
        for (i, counts) in wanted.counts.iter_mut().enumerate() {
            *counts = i % 15 >= 8;
        }
        let (texels, _) = optimise(lattice, &start, &wanted, 8);
        for i in (0..texels.len()).filter(|i| i % 8 < 4) {
            assert_eq!(texels[i], start[i], "{i}");
        }
    }
}
