//! Seconds of hot kernels: `cargo bench -p lobefit-fit`. The first nine are those whose instructions
//! `tests/kernels` holds to a record.

#[path = "../tests/kernels/kernel.rs"]
mod kernel;

use divan::Bencher;
use divan::counter::ItemsCount;
use lobefit_truth::integrate::monte_carlo::{Draw, Points, Run};
use lobefit_truth::optics::Smith;
use lobefit_truth::quantity::{DiffuseCoupling, GGX_REFLECTION, Quantity, Specular, Variant};

fn main() {
    divan::main();
}

/// Kernels by their names.
#[divan::bench(args = kernel::KERNELS.map(|(name, _)| name))]
fn counted(bencher: Bencher, name: &str) {
    let found = kernel::KERNELS.iter().find(|(known, _)| *known == name);
    let (_, kernel) = found.expect("the names are those of the list");
    bencher.bench(kernel);
}

/// The factor of a diffuse base at a point.
#[divan::bench]
fn coupling() -> f64 {
    let mut variant = Variant::from(Smith::Correlated);
    variant.specular = Some(Specular::Normalised);
    DiffuseCoupling.at(&variant, &[0.3, 0.4, 0.04], 1e-9).expect("in the domain")[0]
}

/// Samples of the albedo, of each draw.
#[divan::bench(args = Draw::ALL)]
fn monte_carlo(bencher: Bencher, draw: Draw) {
    sampled(bencher, Points::Sobol, draw);
}

/// Samples of the albedo, of each kind of points.
#[divan::bench(args = Points::ALL)]
fn sequences(bencher: Bencher, points: Points) {
    sampled(bencher, points, Draw::VisibleNormal);
}

fn sampled(bencher: Bencher, points: Points, draw: Draw) {
    let run = Run { samples: 1 << 14, seed: 1, points, draw };
    let variant = Variant::from(Smith::Correlated);
    let sample =
        || GGX_REFLECTION.second_opinion(&variant, &[0.3, 0.4], run).expect("in the domain")[0].value;
    bencher.counter(ItemsCount::new(run.samples)).bench(sample);
}
