//! Texel values optimised for the lookup: those whose bilinear interpolation has the smallest maximum error over a dense
//! set of samples, instead of those that are exact at the texels.
//!
//! The lookup is linear in the texels, so this is linear Chebyshev approximation. It is solved by Lawson's iteration
//! (Lawson 1961; Rice and Usow 1968): least squares whose weights are multiplied by the residuals they leave. Each least
//! squares problem has a nine-point stencil for a matrix and is solved by conjugate gradients from the last solution.

/// One dense sample of the function that the table must return.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TexelSample {
    /// Position in texels along the columns, in [0, columns - 1].
    pub x: f64,
    /// Position in texels along the rows, in [0, rows - 1].
    pub y: f64,
    /// Value wanted.
    pub target: f64,
    /// Factor from an error of the lookup to the error that counts; not negative.
    pub weight: f64,
}

/// Iterations of Lawson's algorithm: its error falls by a fixed factor each; measured on GGX tables it is within 3 % of its
/// limit after 60.
const ITERATIONS: usize = 60;

/// Weight of the starting values in the least squares, relative to the mean diagonal: it decides the texels that no sample
/// touches, and nothing else.
const TIE: f64 = 1e-7;

/// The interpolation weights of a sample: its cell's first texel and the fractions.
struct Stencil {
    cell: usize,
    weights: [f64; 4],
}

/// Improves `start` (row by row, `columns` times rows values, exact at the texels) for the lookup at `samples`.
///
/// Returns the texels with the smallest maximum of weight |lookup - target| met on the way, and that maximum; never worse
/// than `start`. Deterministic and sequential.
///
/// # Panics
/// If `start` is not a whole number of at least two rows of at least two columns.
pub fn optimise(columns: usize, start: &[f64], samples: &[TexelSample]) -> (Vec<f64>, f64) {
    assert!(
        columns >= 2 && start.len().is_multiple_of(columns) && start.len() >= 2 * columns,
        "a table of 2 x 2 or more"
    );
    let rows = start.len() / columns;
    let stencils: Vec<Stencil> = samples.iter().map(|s| stencil(s, columns, rows)).collect();
    let mut weights: Vec<f64> = samples.iter().map(|s| s.weight * s.weight).collect();
    let mut texels = start.to_vec();
    let mut best = (texels.clone(), worst(&residuals(columns, &texels, &stencils, samples)));
    for _ in 0..ITERATIONS {
        let system = System::assemble(columns, start, &stencils, samples, &weights);
        system.solve(&mut texels);
        let errors = residuals(columns, &texels, &stencils, samples);
        let largest = worst(&errors);
        if largest < best.1 {
            best = (texels.clone(), largest);
        }
        if largest == 0.0 {
            break;
        }
        for (weight, error) in weights.iter_mut().zip(&errors) {
            *weight *= error.abs() / largest;
        }
        // Lawson's weights sum to a constant; without this they would all underflow in the end.
        let mean = weights.iter().sum::<f64>() / weights.len() as f64;
        weights.iter_mut().for_each(|w| *w /= mean);
    }
    best
}

fn stencil(sample: &TexelSample, columns: usize, rows: usize) -> Stencil {
    let split = |x: f64, n: usize| {
        let base = x.floor().clamp(0.0, (n - 2) as f64);
        (base as usize, (x - base).clamp(0.0, 1.0))
    };
    let ((column, fx), (row, fy)) = (split(sample.x, columns), split(sample.y, rows));
    let weights = [(1.0 - fx) * (1.0 - fy), fx * (1.0 - fy), (1.0 - fx) * fy, fx * fy];
    Stencil { cell: row * columns + column, weights }
}

fn lookup(columns: usize, texels: &[f64], at: &Stencil) -> f64 {
    let t = &texels[at.cell..];
    at.weights[0] * t[0] + at.weights[1] * t[1] + at.weights[2] * t[columns] + at.weights[3] * t[columns + 1]
}

fn residuals(columns: usize, texels: &[f64], stencils: &[Stencil], samples: &[TexelSample]) -> Vec<f64> {
    let pairs = stencils.iter().zip(samples);
    pairs.map(|(at, s)| s.weight * (lookup(columns, texels, at) - s.target)).collect()
}

fn worst(errors: &[f64]) -> f64 {
    errors.iter().fold(0.0, |worst, e| e.abs().max(worst))
}

/// Normal equations of one weighted least squares problem: a symmetric matrix with nine entries a row, of which the upper
/// five are stored (self, east, south-west, south, south-east).
struct System {
    columns: usize,
    entries: Vec<[f64; 5]>,
    right: Vec<f64>,
}

impl System {
    fn assemble(
        columns: usize,
        start: &[f64],
        stencils: &[Stencil],
        samples: &[TexelSample],
        weights: &[f64],
    ) -> System {
        let mut system =
            System { columns, entries: vec![[0.0; 5]; start.len()], right: vec![0.0; start.len()] };
        for ((at, sample), weight) in stencils.iter().zip(samples).zip(weights) {
            let w = at.weights.map(|x| x * weight);
            let [a, b, c, d] = at.weights;
            let (i, j) = (at.cell, at.cell + columns);
            add(&mut system.entries[i], [w[0] * a, w[0] * b, 0.0, w[0] * c, w[0] * d]);
            add(&mut system.entries[i + 1], [w[1] * b, 0.0, w[1] * c, w[1] * d, 0.0]);
            add(&mut system.entries[j], [w[2] * c, w[2] * d, 0.0, 0.0, 0.0]);
            add(&mut system.entries[j + 1], [w[3] * d, 0.0, 0.0, 0.0, 0.0]);
            for (texel, w) in [i, i + 1, j, j + 1].into_iter().zip(w) {
                system.right[texel] += w * sample.target;
            }
        }
        let tie = TIE * system.entries.iter().map(|e| e[0]).sum::<f64>() / start.len() as f64;
        for ((entry, right), value) in system.entries.iter_mut().zip(&mut system.right).zip(start) {
            entry[0] += tie;
            *right += tie * value;
        }
        system
    }

    fn times(&self, x: &[f64], out: &mut [f64]) {
        let (n, columns) = (x.len(), self.columns);
        out.fill(0.0);
        for (i, entry) in self.entries.iter().enumerate() {
            out[i] += entry[0] * x[i];
            for (k, offset) in [1, columns - 1, columns, columns + 1].into_iter().enumerate() {
                let j = i + offset;
                if j < n {
                    out[i] += entry[k + 1] * x[j];
                    out[j] += entry[k + 1] * x[i];
                }
            }
        }
    }

    /// Conjugate gradients with the diagonal as preconditioner, from the values in `x`, to 1e-12 of the right-hand side.
    fn solve(&self, x: &mut [f64]) {
        let n = x.len();
        let mut product = vec![0.0; n];
        self.times(x, &mut product);
        let mut residual: Vec<f64> = self.right.iter().zip(&product).map(|(b, a)| b - a).collect();
        let precondition =
            |r: &[f64]| -> Vec<f64> { r.iter().zip(&self.entries).map(|(r, e)| r / e[0]).collect() };
        let mut z = precondition(&residual);
        let mut direction = z.clone();
        let mut energy = dot(&residual, &z);
        let goal = 1e-24 * dot(&self.right, &precondition(&self.right));
        for _ in 0..4 * n {
            if energy <= goal {
                return;
            }
            self.times(&direction, &mut product);
            let step = energy / dot(&direction, &product);
            for i in 0..n {
                x[i] += step * direction[i];
                residual[i] -= step * product[i];
            }
            z = precondition(&residual);
            let next = dot(&residual, &z);
            let ratio = next / energy;
            for i in 0..n {
                direction[i] = z[i] + ratio * direction[i];
            }
            energy = next;
        }
    }
}

fn add(entry: &mut [f64; 5], values: [f64; 5]) {
    for (e, v) in entry.iter_mut().zip(values) {
        *e += v;
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(columns: usize, rows: usize, per_cell: usize, f: impl Fn(f64, f64) -> f64) -> Vec<TexelSample> {
        let mut samples = Vec::new();
        for j in 0..=(rows - 1) * per_cell {
            for i in 0..=(columns - 1) * per_cell {
                let (x, y) = (i as f64 / per_cell as f64, j as f64 / per_cell as f64);
                samples.push(TexelSample { x, y, target: f(x, y), weight: 1.0 });
            }
        }
        samples
    }

    fn exact(columns: usize, rows: usize, f: impl Fn(f64, f64) -> f64) -> Vec<f64> {
        (0..columns * rows).map(|i| f((i % columns) as f64, (i / columns) as f64)).collect()
    }

    #[test]
    fn a_bilinear_function_is_left_alone() {
        let f = |x: f64, y: f64| 1.0 + 0.3 * x - 0.2 * y + 0.05 * x * y;
        let start = exact(6, 5, f);
        let (texels, error) = optimise(6, &start, &grid(6, 5, 4, f));
        assert!(error < 1e-14);
        assert!(texels.iter().zip(&start).all(|(a, b)| (a - b).abs() < 1e-12));
    }

    /// A parabola per cell: interpolation errs by h^2 f''/8 to one side; shifting every texel by half of it halves it, and
    /// nothing does better.
    #[test]
    fn a_parabola_reaches_half_the_interpolation_error() {
        let f = |x: f64, _: f64| x * x;
        let start = exact(9, 2, f);
        let (_, error) = optimise(9, &start, &grid(9, 2, 16, f));
        assert!((0.125..0.1265).contains(&error), "{error}");
    }

    #[test]
    fn untouched_texels_keep_their_value() {
        let f = |x: f64, y: f64| x * x + y;
        let start = exact(8, 4, f);
        let samples: Vec<_> = grid(8, 4, 4, f).into_iter().filter(|s| s.x >= 4.0).collect();
        let (texels, _) = optimise(8, &start, &samples);
        for row in 0..4 {
            for column in 0..3 {
                assert!((texels[row * 8 + column] - start[row * 8 + column]).abs() < 1e-9);
            }
        }
    }
}
