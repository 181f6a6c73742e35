//! A dense dual simplex for programs of few variables and many rows, which are priced by a
//! callback: the rows are never stored.
//!
//! minimise c x subject to a_i x <= b_i. A vertex is the solution of k active rows; y >= 0 with
//! c + sum y_i a_i = 0 proves that no x that keeps the active rows has a smaller c x. The most
//! violated row enters, the active row whose y reaches 0 first leaves.

/// Rows of a program.
pub(super) trait Rows {
    /// Name of a row.
    type Id: Copy + PartialEq;
    /// The row that `x` violates most, by a measure that is comparable between rows; none if all
    /// hold.
    fn worst(&mut self, x: &[f64]) -> Option<Self::Id>;
    /// Writes the coefficients of a row and gives its right side.
    fn row(&self, id: Self::Id, into: &mut [f64]) -> f64;
    /// No solution that is looked for has a magnitude of this variable above this.
    fn reach(&self, variable: usize) -> f64;
}

/// Why a program has no solution.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Failure {
    /// The rows contradict one another, by multipliers that prove it for the rows as they are in
    /// floating point: what combining them may have rounded is counted, what computing their
    /// entries has rounded is not.
    Infeasible,
    /// The rows seem to contradict one another, but rounding could account for it.
    Unproven,
    /// The active rows became dependent in floating point, or the steps were used up.
    Numerical,
}

/// A vertex that keeps all rows.
pub(super) struct Vertex<I> {
    pub x: Vec<f64>,
    /// Active rows with their multipliers.
    pub active: Vec<(I, f64)>,
}

/// Steps per variable before the solver gives up.
const STEPS: usize = 200;

/// Updates of the inverse before it is computed anew.
const FRESH: usize = 24;

/// Multipliers above minus this count as non-negative.
const NONNEGATIVE: f64 = 1e-12;

/// A pivot below this part of the largest is not taken.
const PIVOT: f64 = 1e-9;

/// Solves: minimise the last variable. `start` are k rows with non-negative multipliers; where
/// their multipliers are not, `fallback` is used.
pub(super) fn minimise_last<R: Rows>(
    rows: &mut R,
    start: &[R::Id],
    fallback: &[R::Id],
) -> Result<Vertex<R::Id>, Failure> {
    let k = fallback.len();
    let mut basis = Basis::of(rows, start, k)
        .filter(|b| b.multipliers().iter().all(|y| *y >= -NONNEGATIVE))
        .or_else(|| Basis::of(rows, fallback, k))
        .ok_or(Failure::Numerical)?;
    let mut entering = vec![0.0; k];
    for _ in 0..STEPS * k {
        let x = basis.vertex();
        let Some(id) = rows.worst(&x) else {
            if basis.updates > 0 {
                // The answer is that of a fresh inverse.
                basis = Basis::of(rows, &basis.active, k).ok_or(Failure::Numerical)?;
                continue;
            }
            let active = basis.active.iter().copied().zip(basis.multipliers()).collect();
            return Ok(Vertex { x, active });
        };
        if basis.active.contains(&id) {
            return Err(Failure::Numerical);
        }
        let bound = rows.row(id, &mut entering);
        let Some(leaving) = basis.leaving(&entering) else { return Err(basis.contradiction(rows, id)) };
        basis.exchange(leaving, id, &entering, bound);
        if basis.updates >= FRESH {
            basis = Basis::of(rows, &basis.active, k).ok_or(Failure::Numerical)?;
        }
    }
    Err(Failure::Numerical)
}

/// Rows combined with multipliers y >= 0: c + sum y a, and sum y b, each with what rounding may
/// have done to it. The rows' entries are taken as exact.
struct Combined {
    left: Vec<f64>,
    left_error: Vec<f64>,
    right: f64,
    right_error: f64,
}

impl Combined {
    fn of<R: Rows>(rows: &R, multipliers: impl Iterator<Item = (R::Id, f64)>, cost: Vec<f64>) -> Combined {
        let k = cost.len();
        let mut all = Combined { left: cost, left_error: vec![0.0; k], right: 0.0, right_error: 0.0 };
        // Running error bound (Higham 2002, section 3.3): each product and each sum rounds by at
        // most half an epsilon of itself.
        let add = |sum: &mut f64, error: &mut f64, product: f64| {
            *sum += product;
            *error += 0.5 * f64::EPSILON * (product.abs() + sum.abs());
        };
        let mut row = vec![0.0; k];
        for (id, y) in multipliers.filter(|(_, y)| *y > 0.0) {
            let bound = rows.row(id, &mut row);
            for (j, a) in row.iter().enumerate() {
                add(&mut all.left[j], &mut all.left_error[j], y * a);
            }
            add(&mut all.right, &mut all.right_error, y * bound);
        }
        all
    }

    /// For every x within reach that keeps the rows, c x is at least this: c x >= (c + sum y a)
    /// x - sum y b.
    fn least<R: Rows>(&self, rows: &R) -> f64 {
        let left = self.left.iter().zip(&self.left_error).enumerate();
        let lost: f64 = left.map(|(j, (v, error))| (v.abs() + error) * rows.reach(j)).sum();
        -self.right - self.right_error - lost
    }
}

impl<I: Copy + PartialEq> Vertex<I> {
    /// What no x within reach that keeps the rows has a smaller last variable than, by the
    /// multipliers alone, rounding counted.
    pub fn proven<R: Rows<Id = I>>(&self, rows: &R) -> f64 {
        let mut cost = vec![0.0; self.x.len()];
        cost[self.x.len() - 1] = 1.0;
        Combined::of(rows, self.active.iter().copied(), cost).least(rows)
    }
}

/// k active rows and the inverse of their matrix.
struct Basis<I> {
    k: usize,
    active: Vec<I>,
    right: Vec<f64>,
    /// Row by row: entry (variable, active row).
    inverse: Vec<f64>,
    updates: usize,
}

impl<I: Copy + PartialEq> Basis<I> {
    /// None if the rows are not k independent ones.
    fn of<R: Rows<Id = I>>(rows: &R, active: &[I], k: usize) -> Option<Basis<I>> {
        if active.len() != k {
            return None;
        }
        let mut matrix = vec![0.0; k * k];
        let right = active.iter().zip(matrix.chunks_mut(k)).map(|(id, row)| rows.row(*id, row)).collect();
        let inverse = invert(matrix, k)?;
        Some(Basis { k, active: active.to_vec(), right, inverse, updates: 0 })
    }

    fn vertex(&self) -> Vec<f64> {
        let dot = |row: &[f64]| row.iter().zip(&self.right).map(|(a, b)| a * b).sum();
        self.inverse.chunks(self.k).map(dot).collect()
    }

    /// c + sum y_i a_i = 0 with c the last unit vector.
    fn multipliers(&self) -> Vec<f64> {
        self.inverse[(self.k - 1) * self.k..].iter().map(|v| -v).collect()
    }

    /// The active row that leaves when one with these coefficients enters; none if no x keeps it
    /// beside the active ones.
    fn leaving(&self, entering: &[f64]) -> Option<usize> {
        let w = self.shares(entering);
        let top = w.iter().fold(0.0_f64, |m, w| m.max(w.abs()));
        let y = self.multipliers();
        let ratio = |j: usize| y[j].max(0.0) / w[j];
        let usable = |j: &usize| w[*j] > PIVOT * top;
        let least = (0..self.k).filter(usable).map(ratio).fold(f64::INFINITY, f64::min);
        // Of equals the largest pivot, for its stability.
        let ties = (0..self.k).filter(usable).filter(|&j| ratio(j) <= least + NONNEGATIVE);
        ties.reduce(|best, j| if w[j] > w[best] { j } else { best })
    }

    /// Whether a row that nothing leaves for contradicts the active ones: it is minus a combination
    /// of theirs with multipliers y >= 0, and the right sides so combined are below 0 (Farkas).
    fn contradiction<R: Rows<Id = I>>(&self, rows: &R, id: I) -> Failure {
        let mut row = vec![0.0; self.k];
        rows.row(id, &mut row);
        let shares = self.shares(&row);
        let top = shares.iter().fold(1.0_f64, |m, w| m.max(w.abs()));
        let share = |w: &f64| if -w > PIVOT * top { -w } else { 0.0 };
        let combined = Combined::of(
            rows,
            self.active.iter().copied().zip(shares.iter().map(share)).chain([(id, 1.0)]),
            vec![0.0; self.k],
        );
        if combined.least(rows) > 0.0 { Failure::Infeasible } else { Failure::Unproven }
    }

    /// A row's coefficients as a combination of the active ones.
    fn shares(&self, row: &[f64]) -> Vec<f64> {
        let mut shares = vec![0.0; self.k];
        for (a, inverse) in row.iter().zip(self.inverse.chunks(self.k)) {
            shares.iter_mut().zip(inverse).for_each(|(s, v)| *s += a * v);
        }
        shares
    }

    fn exchange(&mut self, leaving: usize, id: I, entering: &[f64], bound: f64) {
        let w = self.shares(entering);
        for row in self.inverse.chunks_mut(self.k) {
            let pivot = row[leaving] / w[leaving];
            row.iter_mut().zip(&w).for_each(|(v, w)| *v -= w * pivot);
            row[leaving] = pivot;
        }
        self.active[leaving] = id;
        self.right[leaving] = bound;
        self.updates += 1;
    }
}

/// The inverse of a k x k matrix by elimination with row pivots; none if it is singular in floating
/// point.
fn invert(mut a: Vec<f64>, k: usize) -> Option<Vec<f64>> {
    let mut inverse = vec![0.0; k * k];
    (0..k).for_each(|i| inverse[i * k + i] = 1.0);
    for column in 0..k {
        let size = |row: &usize| a[row * k + column].abs();
        let pivot = (column..k).max_by(|i, j| size(i).total_cmp(&size(j)))?;
        let value = a[pivot * k + column];
        if value.abs() <= f64::MIN_POSITIVE || !value.is_finite() {
            return None;
        }
        for j in 0..k {
            a.swap(pivot * k + j, column * k + j);
            inverse.swap(pivot * k + j, column * k + j);
        }
        for j in 0..k {
            a[column * k + j] /= value;
            inverse[column * k + j] /= value;
        }
        for i in (0..k).filter(|&i| i != column) {
            let factor = a[i * k + column];
            if factor == 0.0 {
                continue;
            }
            for j in 0..k {
                a[i * k + j] -= factor * a[column * k + j];
                inverse[i * k + j] -= factor * inverse[column * k + j];
            }
        }
    }
    inverse.iter().all(|v| v.is_finite()).then_some(inverse)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows by index, kept as (coefficients, right side).
    struct Listed(Vec<(Vec<f64>, f64)>);

    impl Rows for Listed {
        type Id = usize;
        fn worst(&mut self, x: &[f64]) -> Option<usize> {
            let over = |(a, b): &(Vec<f64>, f64)| a.iter().zip(x).map(|(a, x)| a * x).sum::<f64>() - b;
            let worst = (0..self.0.len()).max_by(|i, j| over(&self.0[*i]).total_cmp(&over(&self.0[*j])))?;
            (over(&self.0[worst]) > 1e-12).then_some(worst)
        }
        fn row(&self, id: usize, into: &mut [f64]) -> f64 {
            into.copy_from_slice(&self.0[id].0);
            self.0[id].1
        }
        fn reach(&self, _: usize) -> f64 {
            1e6
        }
    }

    #[test]
    fn a_small_program_is_solved_and_a_contradiction_named() {
        // min y: y >= x - 1, y >= -x, y >= -10, |x| <= 5: y = -1/2 at x = 1/2
        let mut rows = Listed(vec![
            (vec![-1.0, 0.0], 5.0),
            (vec![0.0, -1.0], 10.0),
            (vec![1.0, 0.0], 5.0),
            (vec![1.0, -1.0], 1.0),
            (vec![-1.0, -1.0], 0.0),
        ]);
        let vertex = minimise_last(&mut rows, &[], &[0, 1]).map_err(|e| format!("{e:?}")).expect("feasible");
        assert!((vertex.x[0] - 0.5).abs() < 1e-14 && (vertex.x[1] + 0.5).abs() < 1e-14, "{:?}", vertex.x);
        assert!(vertex.active.iter().all(|(id, y)| *id >= 3 && (*y - 0.5).abs() < 1e-14));
        rows.0.push((vec![-1.0, 0.0], -6.0));
        assert_eq!(minimise_last(&mut rows, &[], &[0, 1]).err(), Some(Failure::Infeasible));
        // The same contradiction with a way out 1e5 away, along a pivot too small to be taken: not
        // called one.
        let far = Listed(vec![
            (vec![-1.0, 0.0, 0.0], 1e6),
            (vec![0.0, 1.0, 0.0], 1.0),
            (vec![0.0, 0.0, -1.0], 0.0),
            (vec![-1e-10, -1.0, 0.0], -1.00001),
        ]);
        let solved = minimise_last(&mut Listed(far.0.clone()), &[], &[0, 1, 2]);
        assert_eq!(solved.err(), Some(Failure::Unproven));
        let mut nearer = far;
        nearer.0[3].1 = -1.001;
        assert_eq!(minimise_last(&mut nearer, &[], &[0, 1, 2]).err(), Some(Failure::Infeasible));
        assert_eq!(invert(vec![1.0, 2.0, 2.0, 4.0], 2), None);
    }
}
