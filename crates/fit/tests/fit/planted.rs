//! A thousand models with parameters planted at random: found again, whatever the norm.
#![allow(clippy::disallowed_methods)]

use crate::fit_support;

use fit_support::parse;
use lobefit_fit::{Goal, Options, Samples, optimise};

/// A congruential generator (Knuth's MMIX): the same models on every run.
struct Random(u64);

impl Random {
    /// Uniform in [low, high).
    fn within(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Formula of x, starts, and the ranges that parameters are planted in.
struct Family {
    body: &'static str,
    starts: &'static [f32],
    ranges: &'static [[f64; 2]],
}

const FAMILIES: [Family; 4] = [
    Family {
        body: "p0 + x * (p1 + x * (p2 + p3 * x))",
        starts: &[0.0, 0.0, 0.0, 0.0],
        ranges: &[[-2.0, 2.0], [-2.0, 2.0], [-2.0, 2.0], [-2.0, 2.0]],
    },
    Family {
        body: "(p0 + p1 * x) / (1.0 + p2 * x)",
        starts: &[1.0, 0.0, 0.0],
        ranges: &[[0.5, 2.0], [-2.0, 2.0], [-0.8, 4.0]],
    },
    Family {
        body: "p0 * exp2(-p1 * x) + p2",
        starts: &[1.0, 1.0, 0.0],
        ranges: &[[0.5, 2.0], [0.5, 6.0], [-1.0, 1.0]],
    },
    Family {
        body: "(p0 + p1 * x) / (1.0 + x * (p2 + p3 * x))",
        starts: &[1.0, 0.0, 0.0, 0.0],
        ranges: &[[0.5, 2.0], [-2.0, 2.0], [0.0, 3.0], [0.0, 3.0]],
    },
];

#[test]
fn a_thousand_planted_models_are_found_again() {
    let mut random = Random(20_261_121);
    let x: Vec<f64> = (0..24).map(|i| f64::from(i) / 23.0).collect();
    for case in 0..1000 {
        let family = &FAMILIES[case % FAMILIES.len()];
        let goal = if (case / FAMILIES.len()).is_multiple_of(2) { Goal::Rms } else { Goal::Max };
        let declared: Vec<String> =
            family.starts.iter().enumerate().map(|(i, s)| format!("override p{i}: f32 = {s:?};")).collect();
        let source = format!("{} fn f(x: f32) -> f32 {{ return {}; }}", declared.join(" "), family.body);
        let formula = parse(&source);
        let planted: Vec<f64> = family.ranges.iter().map(|[low, high]| random.within(*low, *high)).collect();
        let target: Vec<f64> = x.iter().map(|x| formula.tape().at(&[*x], &planted)).collect();
        let size = target.iter().fold(0.0_f64, |top, t| top.max(t.abs()));
        let samples = Samples { inputs: vec![x.clone()], scale: vec![1.0; x.len()], target };
        let fitted = optimise(&formula, &samples, &[], &Options { starts: 4, ..Options::new(goal) })
            .unwrap_or_else(|e| panic!("case {case}, {planted:?}: {e}"));
        assert!(
            fitted.termination.is_converged() && fitted.max <= 1e-6 * size,
            "case {case}, {goal}, {planted:?}: {fitted:?}"
        );
        // Between the samples too.
        for i in 0..23 {
            let at = [(f64::from(i) + 0.5) / 23.0];
            let (found, truth) =
                (formula.tape().at(&at, &fitted.coefficients), formula.tape().at(&at, &planted));
            assert!(
                (found - truth).abs() <= 1e-6 * size,
                "case {case}, {planted:?} at {at:?}: {found} {truth}"
            );
        }
    }
}
