//! E_avg between widths, from an interpolant.

use rayon::prelude::*;

use super::{Counter, Region};
use crate::data::Smith;
use lobefit_math::chebyshev::{self, Chebyshev};
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::integrate::reflection::{TOLERANCE, average};

/// Nodes of the interpolant of E_avg over ln(alpha), in which it is analytic: within 1e-9 for alpha in [1e-4, 1] (tested below).
pub const AVERAGE_NODES: usize = 48;

/// Smallest alpha of the interpolant; E_avg is 1 within 1e-13 below.
const AVERAGE_SMALLEST: f64 = 1e-7;

/// E_avg of a width within the region, by interpolation.
pub(crate) fn average_truth(
    smith: Smith,
    region: &Region,
    counter: &Counter,
) -> Result<impl Fn(f64) -> f64 + Sync + use<>, IntegrateError> {
    let [low, high] = region.alpha().map(|a| lobefit_math::ops::log(a.max(AVERAGE_SMALLEST)));
    let nodes = chebyshev::nodes(low, high, AVERAGE_NODES);
    counter.add(nodes.len());
    let value = |x: &f64| average(smith, lobefit_math::ops::exp(*x).min(1.0), TOLERANCE).map(|v| v.e_avg);
    let values: Vec<Result<f64, IntegrateError>> = nodes.par_iter().map(value).collect();
    let interpolant = Chebyshev::new(low, high, values.into_iter().collect::<Result<_, _>>()?);
    Ok(move |alpha: f64| interpolant.at(lobefit_math::ops::log(alpha.max(AVERAGE_SMALLEST)).clamp(low, high)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::AlphaMap;

    #[test]
    fn the_interpolant_of_the_average_is_within_its_bound() {
        for (smith, alpha_map) in
            [(Smith::Correlated, AlphaMap::RoughnessSquared), (Smith::Separable, AlphaMap::Roughness)]
        {
            let region = Region { roughness: [1e-2, 1.0], mu: [0.01, 1.0], alpha_map };
            let truth = average_truth(smith, &region, &Counter::default()).expect("in the domain");
            let [low, high] = region.alpha();
            for i in 0..200 {
                let t = (f64::from(i) + 0.37) / 200.0;
                let alpha = lobefit_math::ops::pow(low, 1.0 - t) * lobefit_math::ops::pow(high, t);
                let exact = average(smith, alpha, TOLERANCE).expect("in the domain").e_avg;
                assert!((truth(alpha) - exact).abs() < 1e-9, "{smith:?} {alpha}: {} {exact}", truth(alpha));
            }
        }
    }
}
