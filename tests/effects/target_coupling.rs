//! Targets of `--use coupling`, against the integral itself.

use std::collections::BTreeMap;

use lobefit::approximate::target::{Target, TargetSpec};
use lobefit::data::{AlphaMap, Smith};
use lobefit_shade::Hypothesis;
use lobefit_truth::quantity::coupling::{Specular, TOLERANCE, coupling};
use lobefit_truth::quantity::{self, COUPLING, Variant};

fn spec(quantity: &str, specular: Option<Specular>) -> TargetSpec {
    TargetSpec {
        quantity: quantity::find(quantity).expect("a quantity"),
        column: None,
        used_as: None,
        variant: Variant { specular, ..Smith::Separable.into() },
        alpha_map: AlphaMap::RoughnessSquared,
        domain: BTreeMap::new(),
    }
}

#[test]
fn a_coupling_target_is_the_factor_of_the_integral() {
    let source = "fn f(alpha: f32, mu: f32, f0: f32) -> f32 { return alpha + mu + f0; }";
    let formula = Hypothesis::parse("f.wgsl", source).expect("a formula");
    let places = [[0.02, 0.01], [0.02, 1.0], [0.3, 0.2], [0.5, 0.7], [0.8, 0.05], [1.0, 1.0]];
    let f0 = [0.0, 0.04, 0.5, 1.0];
    for specular in Specular::ALL {
        let target = Target::new(&spec("diffuse-coupling", Some(specular)), &formula).expect("a target");
        assert_eq!(target.used_as, COUPLING);
        let sampled = target.at(&places.map(|p| p.to_vec()), &f0).expect("a truth");
        assert_eq!(sampled.target.len(), places.len() * f0.len());
        let at = |i: usize, name: &str| sampled.points.column(name).expect("a column")[i];
        for i in 0..sampled.target.len() {
            let (alpha, mu, f0) = (at(i, "alpha"), at(i, "mu"), at(i, "f0"));
            let truth =
                coupling(Smith::Separable, alpha, mu, f0, specular, TOLERANCE).expect("in the domain");
            assert_eq!(sampled.scale[i], 1.0);
            let off = (sampled.target[i] - truth.value).abs();
            assert!(
                off <= target.truth_error(),
                "{specular:?} alpha {alpha} mu {mu} f0 {f0}: off by {off:e}"
            );
        }
    }
}
