//! E and B of the interpolant against integrals with bounds of their own.

use lobefit_truth::integrate::reflection::{Interpolant, reflection};
use lobefit_truth::optics::Smith;
use lobefit_truth::optics::distribution::Ggx;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

#[test]
fn the_interpolant_is_within_its_stated_error() {
    for smith in [Smith::Correlated, Smith::Separable] {
        let known = Interpolant::new(Ggx, smith, [[1e-4, 1.0], [1e-4, 1.0]], true).expect("in the domain");
        let off = |index: u64| {
            let mut random = Pcg64::seed_from_u64(31_000_000 + index);
            let mut log = || lobefit_math::ops::exp(-4.0 * std::f64::consts::LN_10 * random.random::<f64>());
            let (alpha, near) = (log().max(1e-4), log().max(1e-4));
            let mu = if index % 2 == 0 { near } else { (1.0 - near).max(1e-4) };
            let truth = reflection(smith, alpha, mu, 1e-10).expect("in the domain");
            let (e, b) = known.at(alpha, mu);
            ((e - truth.e).abs().max((b - truth.b).abs()), alpha, mu)
        };
        let worst = (0..20_000_u64)
            .into_par_iter()
            .map(off)
            .reduce(|| (0.0, 0.0, 0.0), |a, b| if a.0 >= b.0 { a } else { b });
        println!("{smith:?}: {worst:?}");
        assert!(worst.0 <= Interpolant::ERROR, "{smith:?}: {worst:?}");
    }
}

#[test]
fn a_point_outside_is_no_number() {
    let known =
        Interpolant::new(Ggx, Smith::Correlated, [[0.1, 0.2], [0.5, 1.0]], true).expect("in the domain");
    assert!(
        known.at(0.15, 0.7).0.is_finite()
            && known.at(0.1, 0.5).1.is_finite()
            && known.at(0.2, 1.0).1.is_finite()
    );
    assert!(known.at(0.3, 0.7).0.is_nan() && known.at(0.15, 0.4).1.is_nan());
    assert!(Interpolant::new(Ggx, Smith::Correlated, [[1e-5, 0.2], [0.5, 1.0]], true).is_err());
    assert!(Interpolant::new(Ggx, Smith::Correlated, [[0.2, 0.1], [0.5, 1.0]], true).is_err());
}
