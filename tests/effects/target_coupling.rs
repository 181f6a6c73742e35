//! Targets of `--use coupling` and the weights of f0, against the integral itself.

#![allow(clippy::disallowed_methods)]

use std::collections::BTreeMap;

use lobefit::approximate::target::{Target, TargetSpec};
use lobefit::data::{AlphaMap, Smith, Use};
use lobefit::fitting::{Job, fit};
use lobefit_fit::Goal;
use lobefit_shade::{Hypothesis, Precision};
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

/// A constant for f0 A + B, in a p-norm weighted by f0: the mean over f0 has to be that of the
/// weighted powers, which two values of f0 cannot stand for. Against a sum of our own.
#[test]
fn a_p_norm_with_a_weight_of_f0_is_taken_over_all_f0() {
    let source = "override c: f32 = 0.5;\nfn f(f0: f32) -> f32 { return c + 0.0 * f0; }\n";
    let hypothesis = Hypothesis::parse("f.wgsl", source).expect("a formula");
    let spec = spec("ggx-reflection", None);
    let p = 4.0;
    let job = Job {
        hypothesis: hypothesis.clone(),
        spec: TargetSpec { used_as: Some(Use::F0_BLEND), ..spec.clone() },
        goals: vec![Goal::Power(p)],
        weight: Some("f0 * f0".into()),
        demands: Vec::new(),
        precisions: vec![Precision::F32],
        starts: 4,
        allow_undetermined: true,
        limit: None,
        languages: Vec::new(),
        command: String::new(),
    };
    let found = fit(&job).expect("a fit").fits.remove(0);
    let c = found.fitted.coefficients[0];
    // 40 x 40 cells of roughness and mu, 101 values of f0.
    let target = Target::new(&job.spec, &hypothesis).expect("a target");
    let centre = |low: f64, i: usize| low + (1.0 - low) * (i as f64 + 0.5) / 40.0;
    let places: Vec<Vec<f64>> = (0..1600).map(|i| vec![centre(0.02, i / 40), centre(0.01, i % 40)]).collect();
    let f0: Vec<f64> = (0..101).map(|i| (f64::from(i) + 0.5) / 101.0).collect();
    let all = target.at(&places, &f0).expect("a truth");
    let weights: Vec<f64> = all.points.column("f0").expect("f0").iter().map(|f| f.powi(2)).collect();
    let norm = |c: f64| -> f64 {
        all.target.iter().zip(&weights).map(|(t, w)| (w * (c - t)).abs().powf(p)).sum::<f64>()
    };
    let best = (0..=4000).map(|i| 0.4 + 0.6 * f64::from(i) / 4000.0);
    let best = best.reduce(|a, b| if norm(b) < norm(a) { b } else { a }).expect("a minimum");
    assert!((c - best).abs() < 2e-3, "{c}, by an own sum {best}");
}
