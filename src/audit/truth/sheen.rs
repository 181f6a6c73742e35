//! Charlie sheen over alpha and mu: a value takes so little that every point is integrated.

use rayon::prelude::*;

use super::{Lobe, Truth, Values};
use crate::audit::AuditError;
use crate::audit::axis::Input;
use crate::audit::column::{self, Column};
use crate::integrate::sheen::{SMALLEST_ALPHA, albedo};

/// Least alpha that is judged: below it E at grazing view has no bound.
const LEAST_ALPHA: f64 = 1e-4;

/// Error of a value, relative to E, which is at most 40 here.
const BOUND: f64 = 4e-10;

struct Sheen {
    lobes: Vec<Lobe>,
}

/// `sheen-charlie`: E.
pub(crate) fn sheen() -> impl Truth {
    Sheen { lobes: vec![Lobe { smith: None, side: None }] }
}

impl Truth for Sheen {
    fn quantity(&self) -> &'static str {
        "sheen-charlie"
    }

    fn inputs(&self) -> &'static [Input] {
        &[Input::Alpha, Input::Mu]
    }

    fn lobes(&self) -> &[Lobe] {
        &self.lobes
    }

    fn columns(&self) -> &'static [Column] {
        &column::ALBEDO
    }

    fn range(&self, input: Input) -> [f64; 2] {
        if input == Input::Alpha { [LEAST_ALPHA, 1.0] } else { [0.0, 1.0] }
    }

    fn quick(&self, _: usize, at: &[&[f64]]) -> Values {
        let row = |mu: &f64| -> Values {
            at[0].iter().map(|a| [albedo(a.clamp(SMALLEST_ALPHA, 1.0), mu.clamp(0.0, 1.0)), 0.0]).collect()
        };
        at[1].par_iter().map(row).collect::<Vec<Values>>().into_iter().flatten().collect()
    }

    fn exact(&self, lobe: usize, at: &[&[f64]]) -> Result<Values, AuditError> {
        Ok(self.quick(lobe, at))
    }

    fn bound(&self) -> f64 {
        BOUND
    }
}
