//! Every quantity and variant over its whole closed domain: a value within its promise, finite, with no
//! negative energy; and where it has a second opinion, the same value by Monte Carlo.

use std::panic::{AssertUnwindSafe, catch_unwind};

use lobefit_math::ops;
use lobefit_promises::{Range, promises, quantity};
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::integrate::monte_carlo::{Draw, Points, Run};
use lobefit_truth::quantity::{Input, QUANTITIES, Quantity, Variant};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

use crate::{points, trials};

/// Points of each variant at which the quadrature is tried.
const TRIALS: u64 = 120;

/// Points of each variant that are sampled too.
const SAMPLED: u64 = 10;

/// What fits in all replicas of a run at a point.
const SAMPLES: u64 = 1 << 15;

/// Standard errors of 32 replicas that one value of some thousand stays within.
const SIGMAS: f64 = 6.0;

fn variants(quantity: &dyn Quantity) -> Vec<Variant> {
    let mut all = vec![Variant::default()];
    for choice in quantity.choices() {
        let with = |variant: &Variant| {
            let words = choice.words().into_iter();
            let chosen = words.map(|word| {
                let mut variant = variant.clone();
                assert!(variant.choose(*choice, word));
                variant
            });
            chosen.collect::<Vec<_>>()
        };
        all = all.iter().flat_map(with).collect();
    }
    all
}

/// Every quantity with every variant.
fn all() -> Vec<(&'static dyn Quantity, Variant)> {
    QUANTITIES.iter().flat_map(|q| variants(*q).into_iter().map(move |variant| (*q, variant))).collect()
}

/// Outputs that are parts of the light that arrives.
const ENERGIES: [&str; 12] =
    ["E", "A", "B", "R", "T", "loss", "E_avg", "loss_avg", "T_avg", "factor", "escape", "K_single"];

/// What is wrong with the values at a point. Beyond what is promised, an error that says what the largest
/// rule reached is right too.
fn wrong(quantity: &dyn Quantity, variant: &Variant, x: &[f64], is_promised: bool) -> Option<String> {
    let tolerance = quantity.tolerance(variant);
    let values = match catch_unwind(AssertUnwindSafe(|| quantity.at(variant, x, tolerance))) {
        Ok(Ok(values)) => values,
        Ok(Err(IntegrateError::Tolerance { .. })) if !is_promised => return None,
        Ok(Err(error)) => return Some(error.to_string()),
        Err(_) => return Some("a panic".into()),
    };
    let error = values[values.len() - 1];
    if values.iter().any(|v| !v.is_finite()) || error > tolerance || error < 0.0 {
        return Some(format!("{values:?}"));
    }
    let dark = quantity.outputs().iter().zip(&values);
    let mut dark = dark.filter(|(name, value)| ENERGIES.contains(name) && **value < -error);
    dark.next().map(|(name, value)| format!("{name} = {value:e}"))
}

/// The domain of a quantity above its mirrors.
fn whole(of: &dyn Quantity) -> Vec<Range> {
    let range = |input: &Input| {
        let least = if input.name.starts_with("alpha") { of.smallest_alpha() } else { f64::MIN };
        Range(input.name.into(), input.domain[0].max(least).max(-10.0), input.domain[1].min(1e3))
    };
    of.inputs().iter().map(range).collect()
}

#[test]
fn every_quantity_has_a_value_all_over_its_domain() {
    let trials: Vec<(usize, u64)> =
        (0..all().len()).flat_map(|k| (0..trials(TRIALS)).map(move |i| (k, i))).collect();
    let all = all();
    let broken: Vec<String> = trials
        .par_iter()
        .filter_map(|(k, index)| {
            let (of, variant) = &all[*k];
            let mut random = Pcg64::seed_from_u64((*k as u64) << 32 | index);
            let is_promised = index % 3 > 0;
            let inputs = if is_promised { quantity(of.name()).inputs.clone() } else { whole(*of) };
            let mut x = points::draw(&mut random, &inputs);
            // A mirror, where the quantity has one.
            if index % 16 == 0 && of.inputs()[0].name == "alpha" && of.inputs()[0].domain[0] == 0.0 {
                x[0] = 0.0;
            }
            let words = |what| format!("{of:?} {variant:?} at {x:?}: {what}");
            wrong(*of, variant, &x, is_promised).map(words)
        })
        .collect();
    assert!(broken.is_empty(), "{} of {}: {broken:#?}", broken.len(), trials.len());
}

/// The largest number of standard errors between the two routes at a point; `None` where the second has
/// none.
fn apart(of: &dyn Quantity, variant: &Variant, x: &[f64], seed: u64) -> Option<f64> {
    let run = Run { samples: SAMPLES, seed, points: Points::Sobol, draw: Draw::VisibleNormal };
    let sampled = match of.second_opinion(variant, x, run) {
        Err(IntegrateError::NoSecondOpinion { .. }) => return None,
        sampled => sampled.expect("samples"),
    };
    let values = of.at(variant, x, of.tolerance(variant)).expect("a truth");
    let error = values[values.len() - 1];
    let off = sampled.iter().zip(&values).map(|(sampled, value)| {
        let off = (sampled.value - value).abs() - error - 1e-13;
        let off = if off <= 0.0 { 0.0 } else { off / sampled.standard_error };
        if off.is_nan() { f64::INFINITY } else { off }
    });
    Some(off.fold(0.0, f64::max))
}

#[test]
fn two_routes_to_every_quantity_agree() {
    let (mut broken, mut compared) = (Vec::new(), 0);
    for (k, (of, variant)) in all().iter().enumerate() {
        let at = |index: u64| {
            let mut random = Pcg64::seed_from_u64(9_000 + 100 * k as u64 + index);
            // Of the usual range, and alpha from 0.01: what is sampled of narrower lobes errs by more than
            // its standard error says.
            let x: Vec<f64> = (of.inputs().iter())
                .map(|input| {
                    let [low, high] = input.usual;
                    let low = if input.name.starts_with("alpha") { low.max(0.01) } else { low.max(1e-3) };
                    low * ops::pow(high / low, random.random())
                })
                .collect();
            apart(*of, variant, &x, index).map(|off| (off, x))
        };
        let found: Vec<(f64, Vec<f64>)> = (0..trials(SAMPLED)).into_par_iter().filter_map(at).collect();
        compared += found.len();
        broken.extend(found.into_iter().filter(|(off, _)| *off > SIGMAS).map(|found| (of.name(), found)));
    }
    println!("{compared} values compared");
    assert!(broken.is_empty() && compared as u64 > trials(100), "{compared}: {broken:#?}");
}

#[test]
fn what_lies_outside_is_refused_by_name() {
    for (of, variant) in all() {
        let promise = promises().quantities.iter().find(|q| q.name == of.name()).expect("a promise");
        for (k, Range(name, ..)) in promise.inputs.iter().enumerate() {
            let inside: Vec<f64> = promise.inputs.iter().map(|r| r.1 + 0.5 * (r.2.min(4.0) - r.1)).collect();
            let beyond = 2.0 * of.inputs()[k].domain[1];
            for bad in [beyond, f64::NEG_INFINITY, f64::NAN] {
                if of.inputs()[k].optional && bad.is_nan() {
                    continue;
                }
                let mut x = inside.clone();
                x[k] = bad;
                let error = of.at(&variant, &x, of.tolerance(&variant)).expect_err("outside").to_string();
                assert!(error.contains(name.as_str()), "{of:?} {name} = {bad}: {error}");
            }
        }
    }
}
