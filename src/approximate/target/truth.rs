//! The truth at points: a quantity's column, or the E and B that a use is made of.

use super::points::{Effort, MANY};
use super::{Target, TargetError};
use crate::approximate::Memo;
use crate::store::Key;
use lobefit_truth::optics::kernel::Kernel;
use lobefit_truth::points::Points;
use lobefit_truth::quantity::{Excuse, Quantity, Truth};

/// An f32 next to an end of a range may lie outside of it by this part.
const ROUNDING: f64 = 1e-6;

/// Points by the microseconds that a truth takes about: less than one, one, some ten, a hundred, a
/// thousand, and more.
const INTERPOLATED: Effort = Effort { lattice: 257, log2: MANY };
const CHEAP: Effort = Effort { lattice: 96 * 96, log2: MANY };
const SPLIT: Effort = Effort { lattice: 96 * 96, log2: 17 };
const MODERATE: Effort = Effort { lattice: 64 * 64, log2: 15 };
const SOUGHT: Effort = Effort { lattice: 40 * 40, log2: 12 };
const DEAR: Effort = Effort { lattice: 1500, log2: 11 };

/// Up to so many points are those about a worst one, which a certificate that is kept stands for.
const FEW: usize = 128;

/// Places of the quantity where many values of f0 stand for each.
const SPLIT_CURVED: Effort = Effort { lattice: 48 * 48, log2: 15 };

impl Target {
    /// The quantity that is integrated, and its outputs: E and B where f0 is an input, of which
    /// the values are made; else the column, and where points are left out, the output that says
    /// so.
    fn asked(&self) -> (&'static dyn Quantity, Vec<&'static str>) {
        match self.over_f0 {
            Some(over) => (over.lobe, vec!["E", "B"]),
            None => (
                self.quantity,
                [Some(self.column), self.excuse().map(|e| e.output)].into_iter().flatten().collect(),
            ),
        }
    }

    /// Which points are left out.
    pub(super) fn excuse(&self) -> Option<&'static Excuse> {
        self.quantity.excused(self.column).filter(|_| self.over_f0.is_none())
    }

    pub(super) fn effort(&self) -> Effort {
        let (quantity, outputs) = self.asked();
        match quantity.microseconds(&outputs) {
            x if x < 1.0 => INTERPOLATED,
            x if x < 10.0 => CHEAP,
            x if x < 100.0 && self.f0.is_some() && !self.affine => SPLIT_CURVED,
            x if x < 100.0 => SPLIT,
            x if x < 1e3 => MODERATE,
            x if x < 1e4 => SOUGHT,
            _ => DEAR,
        }
    }

    /// Whether a truth takes so long that pictures have to do with few.
    pub fn is_dear(&self) -> bool {
        self.effort() == DEAR
    }

    /// Whether a truth takes a thousand microseconds or more.
    pub(super) fn is_sought(&self) -> bool {
        self.effort().log2 <= SOUGHT.log2
    }

    /// Whether a truth takes a hundred microseconds or more.
    pub(super) fn is_moderate(&self) -> bool {
        self.effort().log2 <= MODERATE.log2
    }

    /// A bound on the error of the truths.
    pub fn truth_error(&self) -> f64 {
        self.asked().0.tolerance_of_many(&self.variant)
    }

    /// The truth at points, which is looked for before it is integrated where that takes longer.
    pub(super) fn known(&self, points: &Points, memo: &Memo) -> Result<Truth, TargetError> {
        if self.effort().log2 == MANY {
            return self.truth(points);
        }
        let asked = format!("{:?} {:?} {:?}", self.asked(), self.variant, self.truth_error());
        let named = points
            .columns()
            .fold(Key::of("truth").with(&asked), |key, (name, column)| key.with(name).numbers(column));
        memo.truth(named, points.len() > FEW, || self.truth(points))
    }

    /// The truth at points: the columns of [`Target::asked`].
    pub(super) fn truth(&self, points: &Points) -> Result<Truth, TargetError> {
        let (quantity, outputs) = self.asked();
        let inside = |input: &str, column: &[f64]| rounded(quantity, input, column);
        let columns = points.columns().map(|(name, column)| (name, inside(name, column)));
        Ok(quantity.truth(&self.variant, &Points::new(columns), &outputs, self.truth_error())?)
    }

    /// The lobe that a chain is prefiltered with.
    pub fn kernel(&self) -> &Kernel {
        self.variant.kernel()
    }
}

/// Values of an input; one that lies outside the quantity's domain by the rounding of an f32 alone
/// is taken for the end.
fn rounded(quantity: &dyn Quantity, name: &str, column: &[f64]) -> Vec<f64> {
    let Some(input) = quantity.inputs().iter().find(|input| input.name == name) else {
        return column.to_vec();
    };
    let [low, high] = input.domain;
    let inside = |x: &f64| {
        let end = x.clamp(low, high);
        if (x - end).abs() <= ROUNDING * end.abs() { end } else { *x }
    };
    column.iter().map(inside).collect()
}
