//! E and B of the interpolant against integrals with bounds of their own.

use lobefit_truth::integrate::reflection::{Interpolant, Known, reflection};
use lobefit_truth::optics::Smith;
use lobefit_truth::optics::distribution::Ggx;
use lobefit_truth::quantity::GGX_REFLECTION;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

#[test]
fn the_interpolant_is_within_its_stated_error() {
    for smith in [Smith::Correlated, Smith::Separable] {
        let known = GGX_REFLECTION.known(smith, true);
        let off = |index: u64| {
            let mut random = Pcg64::seed_from_u64(31_000_000 + index);
            let mut log = || lobefit_math::ops::exp(-4.0 * std::f64::consts::LN_10 * random.random::<f64>());
            let (alpha, near) = (log().max(1e-4), log().max(1e-4));
            let mu = if index.is_multiple_of(2) { near } else { (1.0 - near).max(1e-4) };
            let truth = reflection(smith, alpha, mu, 1e-10).expect("in the domain");
            let (e, b) = known.at(alpha, mu).expect("in the domain");
            ((e - truth.e).abs().max((b - truth.b).abs()), alpha, mu)
        };
        let worst = (0..20_000_u64)
            .into_par_iter()
            .map(off)
            .reduce(|| (0.0, 0.0, 0.0), |a, b| if a.0 >= b.0 { a } else { b });
        println!("{smith:?}: {worst:?}");
        assert!(worst.0 <= Interpolant::<Ggx>::ERROR, "{smith:?}: {worst:?}");
    }
}

#[test]
fn the_interpolant_ends_with_its_domain() {
    let known = GGX_REFLECTION.known(Smith::Correlated, false);
    for (alpha, mu) in [(1e-4, 1e-4), (1.0, 1.0), (1e-4, 1.0), (1.0, 1e-4), (0.3, 0.7)] {
        let (e, b) = known.at(alpha, mu).expect("in the domain");
        let truth = reflection(Smith::Correlated, alpha, mu, 1e-10).expect("in the domain");
        assert!((e - truth.e).abs() <= Interpolant::<Ggx>::ERROR && b.is_nan(), "{alpha} {mu}: {e}");
    }
    for (alpha, mu) in [(9e-5, 0.5), (0.5, 9e-5), (1.1, 0.5), (0.5, f64::NAN)] {
        assert!(known.at(alpha, mu).is_none(), "{alpha} {mu}");
    }
}

/// The polynomials do not depend on who asks first, so neither do the values.
#[test]
fn tiles_are_the_same_whoever_asks() {
    let asked = Interpolant::new(Ggx, Smith::Correlated, false);
    let covered = Interpolant::new(Ggx, Smith::Correlated, false);
    covered.cover(&[(1e-4, 1.0), (0.5, 0.5)]);
    for (alpha, mu) in [(0.5, 0.5), (1e-4, 1.0), (0.02, 0.3)] {
        assert_eq!(asked.at(alpha, mu).map(|v| v.0.to_bits()), covered.at(alpha, mu).map(|v| v.0.to_bits()));
    }
}
