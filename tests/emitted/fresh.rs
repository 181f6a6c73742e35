//! Certificates at more points than a run of the tests has time for: `.ci/nightly` runs these.

use std::ops::Range;

use crate::emit_support;
use lobefit::approximate::Fit;
use lobefit::data::Smith;
use lobefit_truth::points::Points;
use lobefit_truth::quantity::{self, Variant};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// Points at once.
const CHUNK: usize = 1 << 20;

/// Of how many chunks one is tried: all, or with `LOBEFIT_TRIALS=0.1` every tenth.
fn every() -> usize {
    let part = std::env::var("LOBEFIT_TRIALS").map_or(1.0, |text| text.parse().expect("LOBEFIT_TRIALS"));
    (1.0_f64 / part).round().max(1.0) as usize
}

/// Holds each fit at points of its quantity's inputs to its certificate, with what the truth there is off
/// by.
fn held(fits: &[(&Fit, &[String])], of: &str, column: &str, points: &Points, roughness: &[f32]) {
    let quantity = quantity::find(of).expect("a quantity");
    let variant = Variant::from(Smith::Correlated).of(quantity.choices());
    let truth = quantity.truth(&variant, points, &[column], 1e-7).expect("truths");
    for (fit, inputs) in fits {
        let input = |name: &String| match name.as_str() {
            "roughness" => roughness.to_vec(),
            other => points.column_f32(other).expect("a column"),
        };
        let inputs: Vec<Vec<f32>> = inputs.iter().map(input).collect();
        let values = fit.hypothesis.tape().evaluate(&inputs, &fit.coefficients()).expect("finite");
        let stated = fit.approximation.certificate.max_abs;
        for (i, (value, truth)) in values.iter().zip(&truth.columns[0]).enumerate() {
            let [scale, target] = fit.approximation.used_as.residual.scaled(*truth);
            let error = (scale * f64::from(*value) - target).abs();
            let name = &fit.approximation.name;
            let at = || inputs.iter().map(|column| column[i]).collect::<Vec<f32>>();
            assert!(error <= stated * 1.0001 + 2e-7, "{name}: {error:e} of {stated:e} at {:?}", at());
        }
    }
}

/// Emitted fits of a column, with their inputs.
fn of_column(of: &str, column: &str) -> Vec<(&'static Fit, Vec<String>)> {
    let all = emit_support::emitted().into_iter();
    let named =
        all.filter(|(fit, ..)| fit.approximation.quantity == of && fit.approximation.column == column);
    named.map(|(fit, _, inputs)| (fit, inputs)).collect()
}

/// The widths of roughnesses, as emitted code makes them.
fn widths(roughness: &[f32]) -> Vec<f64> {
    roughness.iter().map(|r| f64::from(r * r)).collect()
}

#[test]
#[ignore = "2^26 points take half an hour; .ci/nightly runs it"]
fn nightly_certificates_hold_at_fresh_points() {
    let fits = of_column("ggx-reflection", "E");
    let fits: Vec<(&Fit, &[String])> = fits.iter().map(|(fit, inputs)| (*fit, inputs.as_slice())).collect();
    assert!(!fits.is_empty());
    let mut random = Pcg64::seed_from_u64(26);
    for _ in (0..(1 << 26) / CHUNK).step_by(every()) {
        let mut draw = |low: f32| (0..CHUNK).map(|_| low + (1.0 - low) * random.random::<f32>()).collect();
        let (roughness, mu): (Vec<f32>, Vec<f32>) = (draw(0.02), draw(0.01));
        let mu: Vec<f64> = mu.into_iter().map(f64::from).collect();
        let points = Points::new([("alpha", widths(&roughness)), ("mu", mu)]);
        held(&fits, "ggx-reflection", "E", &points, &roughness);
    }
}

#[test]
#[ignore = "all 47 million floats of the domain take half an hour; .ci/nightly runs it"]
fn nightly_functions_of_one_input_hold_at_every_float() {
    let fits = of_column("ggx-average", "E_avg");
    let fits: Vec<(&Fit, &[String])> = fits.iter().map(|(fit, inputs)| (*fit, inputs.as_slice())).collect();
    assert!(!fits.is_empty());
    let all: Range<u32> = 0.02_f32.to_bits()..1.0_f32.to_bits() + 1;
    for first in all.clone().step_by(CHUNK).step_by(every()) {
        let last = (first + CHUNK as u32).min(all.end);
        let roughness: Vec<f32> = (first..last).map(f32::from_bits).collect();
        let points = Points::new([("alpha", widths(&roughness))]);
        held(&fits, "ggx-average", "E_avg", &points, &roughness);
    }
}
