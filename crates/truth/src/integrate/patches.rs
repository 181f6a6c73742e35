//! A smooth function of two variables at millions of places: polynomials on patches, each checked
//! against the function.
//!
//! A patch that misses one of its checked places is halved across the variable in which its series
//! falls more slowly. The work of one rectangle is done on one thread, so that threads may wait for
//! it.

use std::f64::consts::PI;

use lobefit_math::ops;

/// Chebyshev nodes of a patch along each variable.
const NODES: usize = 12;

/// Longest side of a patch: poles at a distance of pi/2 are then at 2.6 half sides, and the series
/// fall by 5.4 a term.
const LONGEST: f64 = 1.2;

/// Shortest side: a patch that misses its places at this size is a defect of the function.
const SHORTEST: f64 = 1e-3;

/// Places that are checked, in a square of side 2: the corners, and points between the nodes.
const CHECKS: [[f64; 2]; 12] = [
    [-1.0, -1.0],
    [1.0, -1.0],
    [-1.0, 1.0],
    [1.0, 1.0],
    [0.0, 1.0],
    [0.0, -1.0],
    [1.0, 0.0],
    [-1.0, 0.0],
    [0.13, 0.13],
    [0.92, -0.51],
    [-0.92, 0.51],
    [-0.51, -0.92],
];

/// Two values of a function over a rectangle.
#[derive(Clone, Debug)]
pub struct Patches {
    over: Rectangle,
    tree: Tree,
}

/// A place where no polynomial follows the function, and how far the last was off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Missed {
    /// The place, in the variables.
    pub place: [f64; 2],
    /// The difference.
    pub off: f64,
}

#[derive(Clone, Debug)]
enum Tree {
    Patch(Box<Patch>),
    Cut { axis: usize, at: f64, halves: Box<[Tree; 2]> },
}

/// A rectangle of the variables.
#[derive(Clone, Copy, Debug)]
struct Rectangle {
    low: [f64; 2],
    high: [f64; 2],
}

/// Chebyshev coefficients by term of y, then of x.
type Series = [[f64; NODES]; NODES];

/// Series over a rectangle, one for each value.
#[derive(Clone, Debug)]
struct Patch {
    over: Rectangle,
    series: Vec<Series>,
}

/// The function with what is asked of its polynomials.
struct Source<'a, F> {
    at: &'a F,
    /// How many of the two values.
    count: usize,
    /// Largest difference at a checked place.
    tolerance: f64,
}

impl Patches {
    /// The first `count` values of a function over [low, high], within `tolerance` of it at the
    /// places that are checked. The function must be smooth to less than that.
    ///
    /// # Errors
    /// A place where no polynomial follows the function.
    pub fn new(
        [low, high]: [[f64; 2]; 2],
        count: usize,
        tolerance: f64,
        at: &impl Fn([f64; 2]) -> [f64; 2],
    ) -> Result<Patches, Missed> {
        let over = Rectangle { low, high };
        Ok(Patches { over, tree: grown(&Source { at, count, tolerance }, over)? })
    }

    /// The values; NaN outside the rectangle, and for a value that was not asked for.
    pub fn at(&self, place: [f64; 2]) -> [f64; 2] {
        let inside = |axis: usize| (self.over.low[axis]..=self.over.high[axis]).contains(&place[axis]);
        if !(inside(0) && inside(1)) {
            return [f64::NAN; 2];
        }
        let mut tree = &self.tree;
        loop {
            match tree {
                Tree::Patch(patch) => return patch.at(place),
                Tree::Cut { axis, at, halves } => tree = &halves[usize::from(place[*axis] > *at)],
            }
        }
    }
}

/// The patches of a rectangle.
fn grown<F: Fn([f64; 2]) -> [f64; 2]>(source: &Source<F>, over: Rectangle) -> Result<Tree, Missed> {
    let sides = [0, 1].map(|axis| over.high[axis] - over.low[axis]);
    let longer = usize::from(sides[1] > sides[0]);
    let axis = if sides[longer] > LONGEST {
        longer
    } else {
        let patch = Patch::new(source, over);
        let off = patch.checked(source);
        if off <= source.tolerance {
            return Ok(Tree::Patch(Box::new(patch)));
        }
        let axis = patch.slower();
        if sides[axis].is_nan() || sides[axis] < SHORTEST || off.is_nan() {
            return Err(Missed { place: over.low, off });
        }
        axis
    };
    let at = 0.5 * (over.low[axis] + over.high[axis]);
    let (mut below, mut above) = (over, over);
    (below.high[axis], above.low[axis]) = (at, at);
    Ok(Tree::Cut { axis, at, halves: Box::new([grown(source, below)?, grown(source, above)?]) })
}

impl Rectangle {
    /// The place at coordinates in a square of side 2.
    fn place(&self, unit: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|k| {
            let (low, high) = (self.low[k], self.high[k]);
            (0.5 * (low + high) + 0.5 * (high - low) * unit[k]).clamp(low, high)
        })
    }
}

/// The i-th of the zeros of the Chebyshev polynomial of degree [`NODES`], as an angle.
fn angle(i: usize) -> f64 {
    PI * (i as f64 + 0.5) / NODES as f64
}

impl Patch {
    fn new<F: Fn([f64; 2]) -> [f64; 2]>(source: &Source<F>, over: Rectangle) -> Patch {
        let node =
            |i: usize| (source.at)(over.place([ops::cos(angle(i % NODES)), ops::cos(angle(i / NODES))]));
        let values: Vec<[f64; 2]> = (0..NODES * NODES).map(node).collect();
        let cosines: [[f64; NODES]; NODES] =
            std::array::from_fn(|term| std::array::from_fn(|node| ops::cos(term as f64 * angle(node))));
        let series = |k: usize| {
            let along_x: Series =
                std::array::from_fn(|row| transformed(&cosines, |column| values[row * NODES + column][k]));
            let mut out = [[0.0; NODES]; NODES];
            for term in 0..NODES {
                let column = transformed(&cosines, |row| along_x[row][term]);
                (0..NODES).for_each(|row| out[row][term] = column[row]);
            }
            out
        };
        Patch { over, series: (0..source.count).map(series).collect() }
    }

    fn at(&self, place: [f64; 2]) -> [f64; 2] {
        let unit = [0, 1].map(|k| {
            let (low, high) = (self.over.low[k], self.over.high[k]);
            if high > low { (2.0 * place[k] - low - high) / (high - low) } else { 0.0 }
        });
        let [x, y] = unit.map(polynomials);
        let sum = |series: &Series| {
            let mut along_x = [0.0; NODES];
            for (row, weight) in series.iter().zip(&y) {
                for i in 0..NODES {
                    along_x[i] += weight * row[i];
                }
            }
            along_x.iter().zip(&x).map(|(term, t)| term * t).sum::<f64>()
        };
        [0, 1].map(|k| self.series.get(k).map_or(f64::NAN, sum))
    }

    /// Largest difference from the function at the places that are checked.
    fn checked<F: Fn([f64; 2]) -> [f64; 2]>(&self, source: &Source<F>) -> f64 {
        let off = |unit: &[f64; 2]| {
            let place = self.over.place(*unit);
            let (found, exact) = (self.at(place), (source.at)(place));
            let off = (0..source.count).map(|k| (found[k] - exact[k]).abs());
            worst(off.map(|x| if x.is_finite() { x } else { f64::NAN }))
        };
        worst(CHECKS.iter().map(off))
    }

    /// The variable whose last two terms are larger.
    fn slower(&self) -> usize {
        let mut tails = [0.0; 2];
        for series in &self.series {
            for i in 0..NODES {
                for last in [NODES - 2, NODES - 1] {
                    tails[0] += series[i][last].abs();
                    tails[1] += series[last][i].abs();
                }
            }
        }
        usize::from(tails[1] > tails[0])
    }
}

/// The largest, or NaN where there is one.
fn worst(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |worst, x| if x > worst || x.is_nan() { x } else { worst })
}

/// Chebyshev coefficients from values at the nodes.
fn transformed(cosines: &[[f64; NODES]; NODES], value: impl Fn(usize) -> f64) -> [f64; NODES] {
    std::array::from_fn(|term| {
        let sum: f64 = (0..NODES).map(|node| value(node) * cosines[term][node]).sum();
        sum * if term == 0 { 1.0 } else { 2.0 } / NODES as f64
    })
}

/// The Chebyshev polynomials at t.
fn polynomials(t: f64) -> [f64; NODES] {
    let mut out = [1.0; NODES];
    out[1] = t;
    for i in 2..NODES {
        out[i] = 2.0 * t * out[i - 1] - out[i - 2];
    }
    out
}
