//! The truth of every quantity at many points against its value at each, which has a bound of its
//! own.

use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::optics::Smith;
use lobefit_truth::points::Points;
use lobefit_truth::quantity::Specular;
use lobefit_truth::quantity::{GgxAverage, QUANTITIES, Quantity, Variant, find};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

/// Points of the fast ways, which begin at 30 000, and how many of them are compared.
const MANY: usize = 31_000;
const COMPARED: usize = 400;

/// The same of a quantity of which a value takes ten milliseconds or more.
const DEAR: usize = 40;

fn variant(smith: Smith) -> Variant {
    let (side, specular) = (Some(Side::Inside), Some(Specular::Compensated));
    Variant { smith: Some(smith), side, specular, kernel: None }
}

/// Random points: widths and cosines logarithmic from 1e-4 or from the domain's end, other inputs
/// even.
fn points(quantity: &dyn Quantity, count: usize) -> Points {
    let column = |(k, input): (usize, &lobefit_truth::quantity::Input)| {
        let mut random = Pcg64::seed_from_u64(77 + k as u64);
        let least = if input.name == "alpha" { quantity.smallest_alpha() } else { 0.0 };
        let [low, high] = [input.domain[0].max(1e-4).max(least), input.domain[1].min(2.0)];
        let value = |x: f64| match input.name {
            "phi" => 1.5 * x,
            _ => lobefit_math::ops::exp(lobefit_math::ops::log(low) + lobefit_math::ops::log(high / low) * x)
                .clamp(low, high),
        };
        (input.name, (0..count).map(|_| value(random.random())).collect())
    };
    Points::new(quantity.inputs().iter().enumerate().map(column))
}

/// R alone is made as R beside T, of either side.
#[test]
fn reflected_energy_alone_is_that_of_both() {
    let glass = find("ggx-glass").expect("a quantity");
    let points = points(glass, COMPARED);
    for side in [Side::Outside, Side::Inside] {
        let variant = Variant { side: Some(side), ..Smith::Correlated.into() };
        let of = |outputs: &[&str]| glass.truth(&variant, &points, outputs, 1e-6).expect("values").columns;
        assert!(of(&["R"])[0] == of(&["R", "T"])[0], "{side:?}");
    }
}

#[test]
fn many_points_are_within_the_tolerance_that_was_asked_for() {
    for quantity in QUANTITIES {
        let of = |smith| variant(smith).of(quantity.choices());
        let [correlated, separable] = [Smith::Correlated, Smith::Separable].map(of);
        // A quantity without a shadowing form has one variant.
        let other = (separable != correlated).then_some(separable);
        for variant in std::iter::once(correlated).chain(other) {
            let tolerance = quantity.tolerance_of_many(&variant);
            let outputs = &quantity.outputs()[..1];
            let dear = quantity.microseconds(outputs) > 50.0;
            let points = points(quantity, if dear { COMPARED } else { MANY });
            let truth = quantity.truth(&variant, &points, outputs, tolerance).expect("in the domain");
            assert!(truth.error <= tolerance, "{quantity:?}");
            let columns: Vec<&[f64]> = points.columns().map(|(_, column)| column).collect();
            let off = |i: usize| {
                let x: Vec<f64> = columns.iter().map(|column| column[i]).collect();
                let exact = quantity.at(&variant, &x, tolerance).expect("a value")[0];
                (truth.columns[0][i] - exact).abs()
            };
            let all = quantity.microseconds(quantity.outputs());
            let compared = if all > 1e4 { DEAR } else { COMPARED };
            let worst = (0..compared).into_par_iter().map(off).reduce(|| 0.0, f64::max);
            println!("{quantity:?} {variant:?}: {worst:e} of {tolerance:e}");
            assert!(worst <= tolerance, "{quantity:?} {variant:?}: {worst:e}");
        }
    }
}

#[test]
fn e_and_b_of_many_points_are_within_the_tolerance() {
    for quantity in QUANTITIES.iter().filter(|quantity| quantity.outputs().contains(&"B")) {
        for (smith, count) in [(Smith::Correlated, MANY), (Smith::Separable, COMPARED)] {
            let points = points(*quantity, count);
            let tolerance = quantity.tolerance_of_many(&smith.into());
            let truth =
                quantity.truth(&smith.into(), &points, &["A", "B"], tolerance).expect("in the domain");
            let [alpha, mu] = ["alpha", "mu"].map(|name| points.column(name).expect("a column"));
            let off = |i: usize| {
                let exact = quantity.at(&smith.into(), &[alpha[i], mu[i]], 1e-9).expect("a value");
                [0, 1].map(|k| (truth.columns[k][i] - exact[1 + k]).abs()).into_iter().fold(0.0, f64::max)
            };
            let worst = (0..COMPARED).into_par_iter().map(off).reduce(|| 0.0, f64::max);
            println!("{quantity:?} {smith:?}: {worst:e}");
            assert!(worst <= tolerance, "{quantity:?} {smith:?}: {worst:e}");
        }
    }
}

#[test]
fn averages_of_a_wide_range_are_within_their_error() {
    let alpha: Vec<f64> = (0..400).map(|i| lobefit_math::ops::exp(-16.1 * f64::from(i) / 399.0)).collect();
    for smith in [Smith::Correlated, Smith::Separable] {
        let points = Points::new([("alpha", alpha.clone())]);
        let truth = GgxAverage.truth(&smith.into(), &points, &["E_avg"], 1e-7).expect("in the domain");
        alpha.par_iter().zip(&truth.columns[0]).for_each(|(alpha, found)| {
            let exact = GgxAverage.at(&smith.into(), &[*alpha], 1e-9).expect("a value")[0];
            assert!((found - exact).abs() <= truth.error, "{smith:?} {alpha}: {found} {exact}");
        });
    }
}

#[test]
fn a_missing_column_is_refused() {
    for quantity in QUANTITIES {
        let variant = variant(Smith::Correlated);
        let truth = |points: &Points, output: &str| quantity.truth(&variant, points, &[output], 1e-3);
        assert!(
            truth(&Points::new([("roughness", vec![0.5])]), quantity.outputs()[0]).is_err(),
            "{quantity:?}"
        );
        assert!(truth(&points(quantity, 2), "colour").is_err(), "{quantity:?}");
    }
}

#[test]
fn every_quantity_has_a_name_of_its_own_and_an_error() {
    for quantity in QUANTITIES {
        assert!(find(quantity.name()).is_some_and(|found| found == quantity), "{quantity:?}");
        assert_eq!(quantity.outputs().last(), Some(&"error"), "{quantity:?}");
    }
}

#[test]
fn a_variant_that_leaves_a_choice_open_is_refused() {
    for quantity in QUANTITIES {
        let x: Vec<f64> = quantity.inputs().iter().map(|input| input.domain[1].min(1.0)).collect();
        let open = quantity.at(&Variant::default(), &x, 1e-3);
        let asked = quantity.choices().iter().any(|choice| !choice.is_optional());
        assert_eq!(matches!(open, Err(IntegrateError::Variant { .. })), asked, "{quantity:?}");
    }
}
