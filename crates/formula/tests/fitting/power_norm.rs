//! A p-norm with a weight of f0, against a sum of our own.

#![allow(clippy::disallowed_methods)]

use std::collections::BTreeMap;

use lobefit::approximate::target::{Target, TargetSpec};
use lobefit::data::{AlphaMap, Smith, Use};
use lobefit_fit::Goal;
use lobefit_formula::fitting::{Job, fit};
use lobefit_shade::{Hypothesis, Precision};
use lobefit_truth::quantity;

/// A constant for f0 A + B, in a p-norm weighted by f0: the mean over f0 has to be that of the
/// weighted powers, which two values of f0 cannot stand for. Against a sum of our own.
#[test]
fn a_p_norm_with_a_weight_of_f0_is_taken_over_all_f0() {
    let source = "override c: f32 = 0.5;\nfn f(f0: f32) -> f32 { return c + 0.0 * f0; }\n";
    let hypothesis = Hypothesis::parse("f.wgsl", source).expect("a formula");
    let spec = TargetSpec {
        quantity: quantity::find("ggx-reflection").expect("a quantity"),
        column: None,
        used_as: Some(Use::F0_BLEND),
        variant: Smith::Separable.into(),
        alpha_map: AlphaMap::RoughnessSquared,
        domain: BTreeMap::new(),
    };
    let p = 4.0;
    let job = Job {
        hypothesis: hypothesis.clone(),
        spec,
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
    // The sum of powers is convex: its slope is 0 at its one minimum.
    let slope = |c: f64| -> f64 {
        let power = |(t, w): (&f64, &f64)| w.powf(p) * (c - t).abs().powf(p - 1.0) * (c - t).signum();
        all.target.iter().zip(&weights).map(power).sum()
    };
    let (mut low, mut best) = (0.4, 1.0);
    assert!(slope(low) < 0.0 && slope(best) > 0.0);
    for _ in 0..20 {
        let middle = 0.5 * (low + best);
        if slope(middle) < 0.0 { low = middle } else { best = middle }
    }
    assert!((c - best).abs() < 2e-3, "{c}, by an own sum {best}");
}
