//! E and B at millions of points, from patches of polynomials.
//!
//! Over x = ln(alpha) and y = ln(mu/(1.6 - mu)) both are analytic: the layer mu ~ alpha has its branch points at mu = +-i alpha, pi/2 from
//! the real axis in either variable, and 1.6 spreads the end at mu = 1, beyond which the square root of the sine lies.

use super::effort::Effort;
use super::{albedo_of, split_of};
use crate::integrate::IntegrateError;
use crate::integrate::patches::Patches;
use crate::optics::Smith;
use crate::optics::distribution::Distribution;
use lobefit_math::ops;

/// Largest difference from the integral at the points of a patch that are checked: half of [`Interpolant::ERROR`].
const CHECKED: f64 = 1e-9;

/// E and B over ranges of alpha and mu.
#[derive(Clone, Debug)]
pub struct Interpolant(Patches);

impl Interpolant {
    /// Smallest alpha and mu.
    pub const SMALLEST: f64 = 1e-4;

    /// Largest error of E and of B, measured at random points by `tests/integrate/interpolant.rs`.
    pub const ERROR: f64 = 2e-9;

    /// E, and B where `split` says so, for alpha and mu in ranges, low end first, both in [[`Interpolant::SMALLEST`], 1]. E alone takes a
    /// fiftieth of the time; B is then NaN.
    ///
    /// # Errors
    /// A range outside the domain; integrals that no polynomial follows.
    pub fn new<D: Distribution>(
        lobe: impl Fn(f64) -> D + Sync,
        smith: Smith,
        [alpha, mu]: [[f64; 2]; 2],
        split: bool,
    ) -> Result<Interpolant, IntegrateError> {
        let quantity = "the interpolant of E and B";
        for (input, range) in [("alpha", alpha), ("mu", mu)] {
            if !(Self::SMALLEST <= range[0] && range[0] <= range[1] && range[1] <= 1.0) {
                let domain = "is outside [1e-4, 1] or not a range";
                return Err(IntegrateError::Domain { quantity, input, value: range[0], domain });
            }
        }
        // Both errors below 1e-11, so that the values are smooth: a jump between rules looks like a patch that is too long.
        let effort = Effort::new(16, 12.0);
        let at = |place: [f64; 2]| {
            let [alpha, mu] = physical(place);
            if split {
                split_of(smith, lobe(alpha), mu, &effort).into()
            } else {
                [albedo_of(smith, lobe(alpha), mu, &effort.outer), 0.0]
            }
        };
        let over = [variables(alpha[0], mu[0]), variables(alpha[1], mu[1])];
        let patches = Patches::new(over, 1 + usize::from(split), CHECKED, &at).map_err(|missed| {
            let [alpha, mu] = physical(missed.place);
            let place = format!("alpha = {alpha:?}, mu = {mu:?}");
            IntegrateError::Tolerance { quantity, place, reached: missed.off, tolerance: CHECKED }
        })?;
        Ok(Interpolant(patches))
    }

    /// E and B; NaN outside the ranges.
    pub fn at(&self, alpha: f64, mu: f64) -> (f64, f64) {
        self.0.at(variables(alpha, mu)).into()
    }
}

fn variables(alpha: f64, mu: f64) -> [f64; 2] {
    [ops::log(alpha), ops::log(mu / (1.6 - mu))]
}

/// alpha and mu of the variables; rounding does not carry them beyond 1.
fn physical([x, y]: [f64; 2]) -> [f64; 2] {
    let ratio = ops::exp(y);
    [ops::exp(x).min(1.0), (1.6 * ratio / (1.0 + ratio)).min(1.0)]
}
