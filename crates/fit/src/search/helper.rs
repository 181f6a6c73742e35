//! Functions of the inputs that may be factors of a form's terms.

use lobefit_math::ops;

/// A kind of helper; `axis` counts from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Helper {
    /// 1 - x: one operation.
    Complement {
        /// Axis of x.
        axis: u8,
    },
    /// sqrt(x): four operations.
    Root {
        /// Axis of x.
        axis: u8,
    },
    /// 2^(-k x) with a constant k: five operations.
    Decay {
        /// Axis of x.
        axis: u8,
        /// Power of x.
        power: u8,
    },
    /// 1 / (x + k y^p) with a constant k: five operations. With p the power that makes both of one
    /// order, x and y^p times this are homogeneous of degree 0.
    Reciprocal {
        /// Axis of x.
        x: u8,
        /// Axis of y.
        y: u8,
        /// p.
        power: u8,
    },
    /// 1 / sqrt(x + k y^p) with a constant k: five operations.
    RootReciprocal {
        /// Axis of x.
        x: u8,
        /// Axis of y.
        y: u8,
        /// p.
        power: u8,
    },
}

/// A helper with its constant, in units of 2^(1/4): k = 2^(step/4). 0 where it has none.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Instance {
    pub kind: Helper,
    pub step: i8,
}

/// Steps of a constant that are tried first.
const FIRST: [i8; 4] = [-4, 0, 4, 8];

/// Largest magnitude of a step.
const LAST: i8 = 24;

impl Helper {
    /// Whether it has a constant.
    pub(super) fn has_constant(self) -> bool {
        !matches!(self, Helper::Complement { .. } | Helper::Root { .. })
    }

    /// What a search begins with.
    pub(super) fn instances(self) -> Vec<Instance> {
        if !self.has_constant() {
            return vec![Instance { kind: self, step: 0 }];
        }
        FIRST.iter().map(|step| Instance { kind: self, step: *step }).collect()
    }

    /// Its values, from the axes' columns.
    pub(super) fn values(self, axes: &[Vec<f64>], k: f64) -> Vec<f64> {
        let one = |axis: u8, f: &dyn Fn(f64) -> f64| axes[usize::from(axis)].iter().map(|x| f(*x)).collect();
        let sums = |x: u8, y: u8, power: u8| {
            let pairs = axes[usize::from(x)].iter().zip(&axes[usize::from(y)]);
            pairs.map(move |(x, y)| x + k * raised(*y, power))
        };
        match self {
            Helper::Complement { axis } => one(axis, &|x| 1.0 - x),
            Helper::Root { axis } => one(axis, &f64::sqrt),
            Helper::Decay { axis, power } => one(axis, &|x| ops::exp2(-k * raised(x, power))),
            Helper::Reciprocal { x, y, power } => sums(x, y, power).map(f64::recip).collect(),
            Helper::RootReciprocal { x, y, power } => sums(x, y, power).map(|s| 1.0 / s.sqrt()).collect(),
        }
    }

    /// What it is, for documentation.
    pub(super) fn words(self) -> &'static str {
        match self {
            Helper::Complement { .. } => "the complement of an input",
            Helper::Root { .. } => "the root of an input",
            Helper::Decay { .. } => "an exponential",
            Helper::Reciprocal { .. } => "a reciprocal",
            Helper::RootReciprocal { .. } => "an inverse square root",
        }
    }

    /// Name in a formula.
    pub(super) fn name(self) -> &'static str {
        match self {
            Helper::Complement { .. } => "rest",
            Helper::Root { .. } => "root",
            Helper::Decay { .. } => "decay",
            Helper::Reciprocal { .. } => "inverse",
            Helper::RootReciprocal { .. } => "inverse_root",
        }
    }
}

impl Instance {
    /// Its constant.
    pub fn constant(self) -> f64 {
        ops::exp2(f64::from(self.step) / 4.0)
    }

    /// The same with a constant next to its own.
    pub fn neighbours(self) -> Vec<Instance> {
        if !self.kind.has_constant() {
            return Vec::new();
        }
        let steps = [-3, -1, 1, 3].map(|d| self.step + d);
        steps.into_iter().filter(|s| s.abs() <= LAST).map(|step| Instance { step, ..self }).collect()
    }

    /// Its values, from the axes' columns. None where they are not finite.
    pub fn column(self, axes: &[Vec<f64>]) -> Option<Vec<f64>> {
        let column = self.kind.values(axes, self.constant());
        column.iter().all(|v| v.is_finite()).then_some(column)
    }
}

/// Every element times the n-th power of a factor of its own. Eight powers rise side by side: one waits for
/// every product.
pub(super) fn multiply(column: &mut [f64], factor: &[f64], n: u8) {
    let (mut blocks, factors) = (column.chunks_exact_mut(8), factor.chunks_exact(8));
    let rest = factors.remainder();
    for (block, x) in blocks.by_ref().zip(factors) {
        let mut powers = [1.0; 8];
        for _ in 0..n {
            powers.iter_mut().zip(x).for_each(|(power, x)| *power *= x);
        }
        block.iter_mut().zip(powers).for_each(|(c, power)| *c *= power);
    }
    blocks.into_remainder().iter_mut().zip(rest).for_each(|(c, x)| *c *= raised(*x, n));
}

/// x^n by multiplication.
fn raised(x: f64, n: u8) -> f64 {
    (0..n).fold(1.0, |product, _| product * x)
}
