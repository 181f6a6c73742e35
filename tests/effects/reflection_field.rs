//! The truth that approximations are judged against is within its stated error.

use lobefit::data::Smith;
use lobefit_truth::integrate::reflection::{Effort, albedo, reflection, split};
use lobefit_truth::quantity::TRUTH_ERROR;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

#[test]
fn eight_nodes_a_panel_are_within_the_stated_error() {
    for smith in [Smith::Correlated, Smith::Separable] {
        let worst = (0..6_000_u64)
            .into_par_iter()
            .map(|index| {
                let mut random = Pcg64::seed_from_u64(7_000_000 + index);
                let mut log = || random.random::<f64>() * -4.0 * std::f64::consts::LN_10;
                let (alpha, near) = (lobefit_math::ops::exp(log()), lobefit_math::ops::exp(log()));
                let mu = if index % 2 == 0 { near } else { (1.0 - near).max(1e-4) };
                let truth = reflection(smith, alpha, mu, 1e-10).expect("in the domain");
                let effort = &Effort::ladder()[0];
                let (e, b) = split(smith, alpha, mu, effort);
                assert_eq!(e, albedo(smith, alpha, mu, &effort.outer));
                (e - truth.e).abs().max((b - truth.b).abs())
            })
            .reduce(|| 0.0, f64::max);
        println!("{smith:?}: {worst:e}");
        assert!(worst <= TRUTH_ERROR, "{smith:?}: {worst:e}");
        assert!(worst >= 0.1 * TRUTH_ERROR, "the stated error is not wasteful: {worst:e}");
    }
}
