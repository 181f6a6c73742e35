//! E of the Oren-Nayar lobe against extended precision, the integral of its BRDF, its average, and
//! samples.

use lobefit_math::gauss::Gauss;
use lobefit_truth::integrate::brdf;
use lobefit_truth::integrate::monte_carlo::{Draw, Points, Run};
use lobefit_truth::quantity::eon::{albedo, average};
use lobefit_truth::quantity::{EonSingle, Quantity, Variant};

/// Roughness, mu, E and 1 - E by the formula of the paper (Portsmouth, Kutz and Hill 2024, G of Fujii's
/// lobe) in 40 digits, by mpmath.
const EXACT: [[f64; 4]; 8] = [
    [1.0, 1.0, 0.776_522_067_008_268_3, 0.223_477_932_991_731_66],
    [1.0, 1e-8, 0.999_999_997_528_253_5, 2.471_746_518_859_934e-9],
    [0.5, 0.001, 0.999_860_803_166_946_2, 1.391_968_330_538_321_8e-4],
    [0.25, 0.3, 0.975_824_169_498_846_1, 2.417_583_050_115_393_6e-2],
    [1.0, 0.5, 0.865_319_548_261_148_4, 0.134_680_451_738_851_6],
    [1e-6, 0.7, 0.999_999_765_477_380_1, 2.345_226_198_969_535e-7],
    [0.75, 0.999_999, 0.822_473_221_027_094, 0.177_526_778_972_906],
    [0.1, 0.05, 0.998_420_240_248_056_5, 1.579_759_751_943_551e-3],
];

#[test]
fn the_closed_form_is_that_of_the_paper() {
    for [roughness, mu, e, loss] in EXACT {
        let found = albedo(roughness, mu);
        assert!((found[0] - e).abs() < 4e-16, "{roughness} {mu}: {found:?}");
        assert!((found[1] / loss - 1.0).abs() < 2e-15, "{roughness} {mu}: {found:?}, not {loss}");
    }
    for x in [0.0, 0.3, 1.0] {
        assert_eq!((albedo(x, 0.0), albedo(0.0, x)), ([1.0, 0.0], [1.0, 0.0]), "grazing, and Lambert's lobe");
    }
}

#[test]
fn the_albedo_is_the_integral_of_the_lobe_and_the_average_that_of_the_albedo() {
    let (at, rule) = (|x: f64| 0.5 + 0.5 * x, Gauss::new(64));
    for roughness in [0.0, 0.01, 0.4, 1.0] {
        for mu in [0.01, 0.1, 0.3, 0.8, 1.0] {
            let lobe = EonSingle.brdf(&Variant::default(), &[roughness, mu]).expect("in the domain");
            let found = brdf::albedo("eon-single", &lobe, mu, 1e-4).expect("an integral");
            let off = (found.value - albedo(roughness, mu)[0]).abs();
            assert!(off <= 2.0 * found.error.max(1e-6), "{roughness} {mu}: {off:e} of {:e}", found.error);
        }
        let mean = |k: usize| -> f64 {
            let pairs = rule.nodes.iter().zip(&rule.weights);
            pairs.map(|(x, w)| w * at(*x) * albedo(roughness, at(*x))[k]).sum()
        };
        for (k, exact) in average(roughness).into_iter().enumerate() {
            assert!((mean(k) - exact).abs() < 1e-7, "{roughness}: {} {exact}", mean(k));
        }
    }
}

#[test]
fn samples_agree() {
    for (seed, x) in [[1.0, 1.0], [0.5, 0.1], [0.2, 0.6], [1.0, 0.0]].into_iter().enumerate() {
        let run =
            Run { samples: 1 << 14, seed: seed as u64, points: Points::Sobol, draw: Draw::UniformLight };
        let sampled = EonSingle.second_opinion(&Variant::default(), &x, run).expect("samples");
        for (found, exact) in sampled.iter().zip(albedo(x[0], x[1])) {
            let off = (found.value - exact).abs();
            assert!(off <= 5.0 * found.standard_error + 1e-12, "{x:?}: {off:e} of {found:?}");
        }
    }
}

#[test]
fn inputs_outside_the_domain_are_refused() {
    for (x, input) in [([1.1, 0.5], "roughness"), ([0.5, -0.1], "mu"), ([f64::NAN, 0.5], "roughness")] {
        let error = EonSingle.at(&Variant::default(), &x, 1e-9).expect_err("outside").to_string();
        assert!(error.contains(input), "{error}");
    }
    let error = EonSingle.at(&Variant::default(), &[0.5, 0.5], 1e-16).expect_err("finer than the rounding");
    assert!(error.to_string().contains("2e-15"), "{error}");
}
