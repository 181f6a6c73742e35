//! The published figures of the width of a fetch: mean and largest total variation over nineteen
//! roughnesses and twenty-nine ratios.
#![allow(
    clippy::disallowed_methods,
    reason = "a test may use the platform's functions: its tolerances allow for them"
)]

use std::sync::OnceLock;

use crate::baked_support::assert_promised;
use lobefit::approximate::{Emission, Entry, FitSet, Memo, place};
use lobefit::data::{AlphaMap, Norm};
use lobefit::effects::parallax::{Cell, Grid, HYPOTHESES, PUBLISHED, ParallaxSpec, Spread, fit_all};
use lobefit_shade::Hypothesis;
use lobefit_truth::optics::kernel::Kernel;
use lobefit_truth::points::Points;
use lobefit_truth::quantity::{ParallaxAlpha, Quantity, Variant};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

fn grid() -> &'static Grid {
    static GRID: OnceLock<Grid> = OnceLock::new();
    GRID.get_or_init(|| {
        Grid::new(Kernel::HalfCosine, AlphaMap::RoughnessSquared, [0.1, 1.0], [1.0 / 16.0, 8.0], [19, 29])
            .expect("a grid")
    })
}

/// Cells nearer to the wall than the probe.
fn near(cell: &Cell) -> bool {
    cell.rho < 0.999
}

/// Cells farther than the probe that one fetch can serve.
fn far(cell: &Cell) -> bool {
    cell.rho > 1.001 && !cell.saturated
}

fn spread(entry: &Entry, coefficients: &[f32], wanted: fn(&Cell) -> bool) -> Spread {
    let hypothesis = Hypothesis::parse(entry.file, entry.source).expect("parses");
    let widths = grid().widths(&hypothesis, coefficients).expect("widths");
    grid().spread(&widths, wanted).expect("measured").expect("cells")
}

fn close(found: f64, printed: f64, unit: f64) -> bool {
    (found - printed).abs() <= unit.max(0.02 * printed)
}

#[test]
fn published_formulas_have_the_errors_that_were_measured_of_them() {
    for (name, near_mean, near_max, far_mean, far_max) in [
        ("parallax_none", 0.584, 0.904, 0.394, 0.789),
        ("parallax_frostbite", 0.367, 0.882, 0.394, 0.789),
        ("parallax_scaled", 0.098, 0.323, 0.052, 0.172),
    ] {
        let entry = PUBLISHED.iter().find(|entry| entry.name() == name).expect("in the catalogue");
        let (near, far) = (spread(entry, &[], near), spread(entry, &[], far));
        println!("{name}: {near:?} {far:?}");
        assert!(close(near.mean, near_mean, 1e-3) && close(near.max, near_max, 1e-3), "{name}: {near:?}");
        assert!(close(far.mean, far_mean, 1e-3) && close(far.max, far_max, 1e-3), "{name}: {far:?}");
    }
}

#[test]
fn the_rational_form_keeps_its_bars_and_the_optimum_lies_below_it() {
    let entry = &HYPOTHESES[0];
    assert_eq!(entry.name(), "parallax_1");
    let (near_one, far_one) = (spread(entry, &[1.0], near), spread(entry, &[1.0], far));
    println!("k = 1: {near_one:?} {far_one:?}");
    assert!(near_one.mean <= 0.0185 && near_one.max <= 0.045, "{near_one:?}");
    assert!(close(far_one.mean, 0.0143, 1e-4) && close(far_one.max, 0.038, 1e-3), "{far_one:?}");
    let best: Vec<f64> = grid().cells.iter().map(|cell| cell.best).collect();
    let least = grid().spread(&best, near).expect("measured").expect("cells");
    println!("optimum: {least:?}");
    assert!(close(least.mean, 0.0144, 1e-4) && close(least.max, 0.034, 1e-3), "{least:?}");
    // the difference of encircled energies is what the best width makes least, in mean and cell by
    // cell
    let [mean, max] = least.encircled;
    assert!(
        0.0 < mean && mean < near_one.encircled[0] && max < near_one.encircled[1],
        "{least:?} {near_one:?}"
    );
    for [mean, max] in [least.l2, least.largest, near_one.l2, near_one.largest] {
        assert!(0.0 < mean && mean < max && max < 0.5, "{least:?} {near_one:?}");
    }
}

fn fits() -> &'static FitSet {
    static FITS: OnceLock<FitSet> = OnceLock::new();
    FITS.get_or_init(|| {
        let spec = ParallaxSpec {
            kernel: Kernel::HalfCosine,
            alpha_map: AlphaMap::RoughnessSquared,
            roughness: [0.1, 1.0],
            rho: [1.0 / 16.0, 8.0],
            max_ops: None,
            norms: vec![Norm::Max, Norm::Rms],
            emission: Emission::default(),
        };
        fit_all(&spec, &Memo::default()).expect("fits")
    })
}

/// Peaks lie between the few points that are measured: at other places no fit errs by more than it
/// states.
#[test]
fn certificates_hold_between_the_points_that_are_measured() {
    let mut random = Pcg64::seed_from_u64(7);
    let mut places = Points::default();
    for _ in 0..1 << 13 {
        let roughness = (0.1 + 0.9 * random.random::<f64>()) as f32;
        let rho = (2_f64.powf(-4.0 + 7.0 * random.random::<f64>())) as f32;
        let alpha = f64::from(AlphaMap::RoughnessSquared.alpha_f32(roughness));
        places.push([("roughness", f64::from(roughness)), ("alpha", alpha), ("rho", f64::from(rho))]);
    }
    // The worst place that an attack on the sampled certificates found.
    places.push([("roughness", 0.739_202_3), ("alpha", 0.54642), ("rho", 1.36741)]);
    let asked = Points::new(["alpha", "rho"].map(|name| (name, places.column(name).expect(name).to_vec())));
    let tolerance = ParallaxAlpha.tolerance_of_many(&Variant::default());
    let truth = ParallaxAlpha
        .truth(&Variant::default(), &asked, &["alpha_adjusted", "saturated"], tolerance)
        .expect("widths");
    for fit in &fits().fits {
        let inputs: Vec<Vec<f32>> =
            fit.hypothesis.inputs().iter().map(|name| places.column_f32(name).expect(name)).collect();
        let values = fit.hypothesis.tape().evaluate(&inputs, &fit.coefficients()).expect("finite");
        let errors =
            values.iter().zip(&truth.columns[0]).map(|(f, truth)| (f64::from(*f) / truth - 1.0).abs());
        let open = errors.zip(&truth.columns[1]).enumerate().filter(|(_, (_, saturated))| **saturated == 0.0);
        let (at, worst) = open.map(|(i, (e, _))| (i, e)).max_by(|a, b| a.1.total_cmp(&b.1)).expect("open");
        println!("{:?} {tolerance}", place(&places, at));
        let Certified { max, .. } = certified(fit);
        println!("{}: {worst} of {max} {:?}", fit.approximation.name, fit.approximation.certificate.at);
        assert!(worst <= max && worst > 0.5 * max, "{}: {worst} {max}", fit.approximation.name);
    }
}

#[test]
fn fits_are_no_worse_than_the_constants_that_were_rounded() {
    let set = fits();
    assert!(set.dropped.is_empty(), "{:?}", set.dropped);
    assert_promised("tests/effects/parallax.rs", &set.fits);
    for fit in &set.fits {
        let widths = grid().widths(&fit.hypothesis, &fit.coefficients()).expect("widths");
        let [near, far] = [near, far]
            .map(|w: fn(&Cell) -> bool| grid().spread(&widths, w).expect("measured").expect("cells"));
        let Certified { ops, max, rms } = certified(fit);
        println!(
            "{}: {ops} operations, relative {max} rms {rms}; TV near {near:?}, far {far:?}",
            fit.approximation.name
        );
        if fit.emitted {
            assert!(near.mean <= 0.0185 && near.max <= 0.045, "{}: {near:?}", fit.approximation.name);
        }
    }
}

struct Certified {
    ops: u32,
    max: f64,
    rms: f64,
}

fn certified(fit: &lobefit::approximate::Fit) -> Certified {
    let (cost, certificate) = (&fit.approximation.cost, &fit.approximation.certificate);
    Certified { ops: cost.ops, max: certificate.max_abs, rms: certificate.rms }
}

/// Corrections compose: a fetch of a fetch is that of the product of the ratios. The rational form
/// has that exactly.
#[test]
fn the_rational_form_is_a_flow() {
    let hypothesis = Hypothesis::parse(HYPOTHESES[0].file, HYPOTHESES[0].source).expect("parses");
    let width = |alpha: f64, rho: f64| {
        hypothesis.tape().evaluate(&[vec![alpha], vec![rho]], &[1.0]).expect("finite")[0]
    };
    for alpha in [1e-4, 0.01, 0.2, 0.6, 1.0] {
        for (first, second) in [(0.3, 0.2), (0.5, 1.6), (0.1, 9.0), (0.9, 1.05)] {
            let (twice, once) = (width(width(alpha, first), second), width(alpha, first * second));
            assert!((twice - once).abs() <= 1e-12 * once, "{alpha} {first} {second}: {twice} {once}");
        }
    }
}
