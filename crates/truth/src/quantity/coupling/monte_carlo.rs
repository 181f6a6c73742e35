//! The factor by Monte Carlo, from the albedo of the lobe above.

use super::integral::{Specular, Split, check_f0, factor};
use crate::integrate::monte_carlo::{Run, Sampled, reflection};
use crate::integrate::{Estimate, IntegrateError};
use crate::optics::Smith;

/// Estimates `diffuse-coupling` at alpha in [1e-7, 1], mu in (0, 1]. The errors of E, A and the
/// loss add up: the spread is an upper bound.
pub fn coupling(
    smith: Smith,
    alpha: f64,
    mu: f64,
    f0: f64,
    specular: Specular,
    run: Run,
) -> Result<Sampled, IntegrateError> {
    check_f0(f0)?;
    let lobe = reflection(smith, alpha, mu, run)?;
    let part = |x: Sampled| Estimate { value: x.value, error: x.standard_error };
    let split = Split { e: part(lobe.e), a: part(lobe.a), loss: part(lobe.loss) };
    let factor = factor(&split, f0, specular);
    Ok(Sampled { value: factor.value, standard_error: factor.error })
}
