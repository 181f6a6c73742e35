//! Every public function of numbers at 100 000 points that aim at trouble, beside its textbook form in
//! 320 bits: within what `docs/promises.json` says of it, NaN for a NaN, and no worse on the ends.

mod arithmetic;
mod big;
mod identities;
mod optics;
mod points;
mod quantities;
mod samplers;

use std::collections::BTreeSet;

use big::Big;
use lobefit_promises::{FLOOR, Function, function, promises};
use rand::SeedableRng;
use rand_pcg::Pcg64;
use rayon::prelude::*;

/// Points of a function.
const TRIALS: u64 = 100_000;

/// A function.
type Ours = Box<dyn Fn(&[f64]) -> Vec<f64> + Sync>;
type Exact = Box<dyn Fn(&[Big]) -> Vec<Big> + Sync>;

/// A function of the list of promises and its truth, of the same inputs.
pub(crate) struct Attack {
    name: &'static str,
    ours: Ours,
    exact: Exact,
}

impl Attack {
    pub(crate) fn of(
        name: &'static str,
        ours: impl Fn(&[f64]) -> Vec<f64> + Sync + 'static,
        exact: impl Fn(&[Big]) -> Vec<Big> + Sync + 'static,
    ) -> Attack {
        Attack { name, ours: Box::new(ours), exact: Box::new(exact) }
    }

    /// The largest error at a point over what is promised.
    fn off(&self, promise: &Function, x: &[f64]) -> f64 {
        let big: Vec<Big> = x.iter().map(|x| Big::from(*x)).collect();
        let of = |(ours, exact): (f64, &Big)| {
            let bar = promise.relative * exact.abs().to_f64() + promise.absolute + FLOOR;
            let off = if ours.is_finite() { (Big::from(ours) - exact).abs().to_f64() } else { f64::INFINITY };
            let off = if off == 0.0 { 0.0 } else { off / bar };
            if off.is_nan() { f64::INFINITY } else { off }
        };
        let ours = (self.ours)(x);
        let exact = (self.exact)(&big);
        assert_eq!(ours.len(), exact.len(), "{}", self.name);
        ours.into_iter().zip(&exact).map(of).fold(0.0, f64::max)
    }
}

/// A number of trials, times `LOBEFIT_TRIALS` where that is set: more by night, fewer where defects are
/// planted.
pub(crate) fn trials(usual: u64) -> u64 {
    let times: f64 =
        std::env::var("LOBEFIT_TRIALS").map_or(1.0, |text| text.parse().expect("LOBEFIT_TRIALS"));
    ((usual as f64 * times) as u64).max(1)
}

fn all() -> Vec<Attack> {
    [arithmetic::attacks(), optics::attacks()].into_iter().flatten().collect()
}

#[test]
fn every_function_keeps_its_promise_where_it_is_hardest() {
    let mut broken = Vec::new();
    for (number, attack) in all().iter().enumerate() {
        let promise = function(attack.name);
        let trial = |index: u64| {
            let mut random = Pcg64::seed_from_u64((number as u64) << 32 | index);
            let x = points::draw(&mut random, &promise.inputs);
            (attack.off(promise, &x), x)
        };
        let worse = |a: (f64, Vec<f64>), b: (f64, Vec<f64>)| if b.0 > a.0 { b } else { a };
        let first = (0.0, Vec::new());
        let (off, x) = (0..trials(TRIALS)).into_par_iter().map(trial).reduce(|| first.clone(), worse);
        println!("{}: {off:.2} of its promise at {x:?}", attack.name);
        if off > 1.0 {
            broken.push(format!("{}: {off:.3e} of its promise at {x:?}", attack.name));
        }
    }
    assert!(broken.is_empty(), "{broken:#?}");
}

#[test]
fn a_nan_of_any_input_is_a_nan() {
    let mut lost = Vec::new();
    for attack in all().iter().filter(|attack| !function(attack.name).inside_alone) {
        let inputs = &function(attack.name).inputs;
        let middle: Vec<f64> = inputs.iter().map(|range| 0.5 * (range.1 + range.2)).collect();
        for k in 0..inputs.len() {
            let at = |value: f64| {
                let mut x = middle.clone();
                x[k] = value;
                (x.clone(), (attack.ours)(&x))
            };
            // An input that the value does not depend on, as the view's Lambda of a separable form.
            if at(inputs[k].1).1 == at(inputs[k].2).1 {
                continue;
            }
            let (x, found) = at(f64::NAN);
            if !found.iter().any(|x| x.is_nan()) {
                lost.push(format!("{}: {x:?} gives {found:?}", attack.name));
            }
        }
    }
    assert!(lost.is_empty(), "{lost:#?}");
}

#[test]
fn no_promise_is_without_its_attack() {
    let attacked: BTreeSet<&str> = all().iter().map(|attack| attack.name).collect();
    let promised: BTreeSet<&str> = promises().functions.iter().map(|f| f.name.as_str()).collect();
    assert_eq!(attacked, promised);
}
