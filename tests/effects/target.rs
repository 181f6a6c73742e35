//! Targets: what a formula is fitted on, and the other points that it is certified at.

use std::collections::{BTreeMap, BTreeSet};

use lobefit::approximate::Memo;
use lobefit::approximate::target::{Sampled, Target, TargetError, TargetSpec};
use lobefit::data::{AlphaMap, Smith, Use};
use lobefit_shade::Hypothesis;
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::points::Points;
use lobefit_truth::quantity::{self, COUPLING, Variant};

fn spec(quantity: &str) -> TargetSpec {
    TargetSpec {
        quantity: quantity::find(quantity).expect("a quantity"),
        column: None,
        used_as: None,
        variant: Smith::Correlated.into(),
        alpha_map: AlphaMap::RoughnessSquared,
        domain: BTreeMap::new(),
    }
}

fn formula(arguments: &str) -> Hypothesis {
    let declared: Vec<String> = arguments.split(' ').map(|a| format!("{a}: f32")).collect();
    let sum = arguments.replace(' ', " + ");
    let source = format!("fn f({}) -> f32 {{ return {sum}; }}", declared.join(", "));
    Hypothesis::parse("f.wgsl", &source).expect("a formula")
}

fn bits(points: &Points) -> Vec<Vec<u64>> {
    (0..points.len()).map(|i| points.columns().map(|(_, c)| c[i].to_bits()).collect()).collect()
}

/// Samples inside the box that are certified at too. On its faces the lattices may meet, in corners
/// and in a few places more.
fn shared(target: &Target, fitted: &Sampled, measured: &Sampled) -> usize {
    let known: BTreeSet<Vec<u64>> = bits(&fitted.points).into_iter().collect();
    let ends: Vec<(String, [f64; 2])> =
        target.spans().into_iter().map(|s| (s.name, s.range.map(|x| f64::from(x as f32)))).collect();
    let face = |i: usize| {
        let axes = ends.iter().filter(|(name, _)| name != "f0");
        let mut at = axes.map(|(name, range)| (measured.points.column(name).expect("a column")[i], range));
        at.any(|(x, range)| range.contains(&x))
    };
    let rows = bits(&measured.points);
    (0..rows.len()).filter(|&i| known.contains(&rows[i]) && !face(i)).count()
}

#[test]
fn points_of_measurement_are_no_samples_and_edges_are_among_both() {
    for (quantity, arguments) in [("ggx-reflection", "alpha mu"), ("ggx-average", "alpha")] {
        let target = Target::new(&spec(quantity), &formula(arguments)).expect("a target");
        let (even, edged, measured) = (
            target.even(&Memo::default()).expect("E"),
            target.edged(&Memo::default()).expect("E"),
            target.measured(&Memo::default()).expect("E"),
        );
        // A million f32 values of one axis are so many of all that a few samples are among them.
        let most = if quantity == "ggx-average" { measured.points.len() / 10_000 } else { 0 };
        assert!(shared(&target, &even, &measured) <= most, "{quantity}");
        assert!(shared(&target, &edged, &measured) <= most, "{quantity}");
        for sampled in [&edged, &measured] {
            for span in target.spans() {
                let column = sampled.points.column(&span.name).expect("a column");
                for end in span.range {
                    assert!(column.contains(&f64::from(end as f32)), "{quantity}: {} = {end}", span.name);
                }
            }
        }
        assert!(measured.points.uniform * 2 > measured.points.len() / 2, "{quantity}");
        assert_eq!(measured.scale.len(), measured.points.len());
    }
}

/// Residuals that the truth leaves, at a few points of every use, by the quantity itself.
#[test]
fn scale_and_target_are_those_of_the_use() {
    let at = |sampled: &Sampled, i: usize, name: &str| sampled.points.column(name).expect("a column")[i];
    let truth = |sampled: &Sampled, i: usize| {
        let inputs = [at(sampled, i, "alpha"), at(sampled, i, "mu")];
        let v =
            quantity::GGX_REFLECTION.at(&Smith::Correlated.into(), &inputs, 1e-10).expect("in the domain");
        (v[0], v[1], v[2])
    };
    let places: Vec<Vec<f64>> = [[0.1, 0.02], [0.4, 0.3], [1.0, 0.9]].map(|p| p.to_vec()).to_vec();
    for (used_as, arguments) in
        [(Use::VALUE, "alpha mu"), (Use::NORMALISATION, "alpha mu"), (Use::F0_BLEND, "alpha mu f0")]
    {
        let spec = TargetSpec { used_as: Some(used_as), ..spec("ggx-reflection") };
        let target = Target::new(&spec, &formula(arguments)).expect("a target");
        let sampled = target.at(&places, &[0.25, 1.0]).expect("a truth");
        for i in 0..sampled.points.len() {
            let (e, a, b) = truth(&sampled, i);
            let (scale, wanted) = match used_as {
                Use::NORMALISATION => (e, 1.0),
                Use::F0_BLEND => (1.0, at(&sampled, i, "f0") * a + b),
                _ => (1.0, e),
            };
            assert!((sampled.scale[i] - scale).abs() < 2e-7, "{used_as:?} {i}: {}", sampled.scale[i]);
            assert!((sampled.target[i] - wanted).abs() < 2e-7, "{used_as:?} {i}: {}", sampled.target[i]);
        }
        assert_eq!(sampled.points.len(), if used_as == Use::F0_BLEND { 6 } else { 3 });
    }
}

/// The mean square over all f0 of an error that is affine in f0 is that over the values that stand
/// for all.
#[test]
fn four_values_of_f0_stand_for_all() {
    let target = Target::new(&spec("ggx-reflection"), &formula("mu f0")).expect("a target");
    assert!(target.affine);
    let measured = target.measured(&Memo::default()).expect("E and B");
    let f0 = measured.points.column("f0").expect("f0");
    let mean: Vec<f64> = {
        let mut values: Vec<f64> = f0[..measured.points.uniform].to_vec();
        values.sort_by(f64::total_cmp);
        values.dedup();
        values
    };
    let square = |a: f64, b: f64| mean.iter().map(|x| (a + b * x) * (a + b * x)).sum::<f64>() / 2.0;
    for (a, b) in [(1.0, 0.0), (0.3, -0.7), (0.0, 2.0)] {
        let exact = a * a + a * b + b * b / 3.0;
        assert!((square(a, b) - exact).abs() < 1e-6, "{a} {b}: {} {exact}", square(a, b));
    }
    let rest: BTreeSet<u64> = f0[measured.points.uniform..].iter().map(|x| x.to_bits()).collect();
    assert_eq!(rest, [0.0_f64, 1.0].iter().map(|x| x.to_bits()).collect());
    let curved = Hypothesis::parse("f.wgsl", "fn f(mu: f32, f0: f32) -> f32 { return mu * f0 * f0; }")
        .expect("a formula");
    let target = Target::new(&spec("ggx-reflection"), &curved).expect("a target");
    assert!(!target.affine);
    let (edged, measured) =
        (target.edged(&Memo::default()).expect("E"), target.measured(&Memo::default()).expect("E"));
    assert_eq!(shared(&target, &edged, &measured), 0);
}

#[test]
fn blends_are_affine_in_f0_and_powers_of_it_are_not() {
    for (body, expected) in [
        ("mix(mu, 1.0 - mu, f0)", true),
        ("f0 * mu + (1.0 - f0) * mu * mu", true),
        ("-f0 / mu", true),
        ("mu", true),
        ("f0 * f0 * mu", false),
        ("mu / (1.0 + f0)", false),
        ("max(f0, mu)", false),
        ("sqrt(f0) + mu", false),
    ] {
        let source = format!("fn f(mu: f32, f0: f32) -> f32 {{ return {body}; }}");
        let formula = Hypothesis::parse("f.wgsl", &source).expect("a formula");
        let target = Target::new(&spec("ggx-reflection"), &formula).expect("a target");
        assert_eq!(target.affine, expected, "{body}");
    }
}

/// Up to the rounding of f0 to f32, and of each of its powers.
#[test]
fn means_over_the_values_of_f0_are_those_of_powers() {
    let domain = [("f0", [0.25, 0.75]), ("mu", [0.5, 0.5]), ("roughness", [0.5, 0.5])];
    let domain = domain.map(|(input, range)| (input.to_string(), range)).into();
    let spec = TargetSpec { domain, ..spec("ggx-reflection") };
    let curved = Hypothesis::parse("f.wgsl", "fn f(f0: f32) -> f32 { return f0 * f0; }");
    let target = Target::new(&spec, &curved.expect("a formula")).expect("a target");
    let even = target.even(&Memo::default()).expect("E and B");
    let measured = target.measured(&Memo::default()).expect("E and B");
    let measured = &measured.points.column("f0").expect("f0")[..measured.points.uniform];
    for (values, degree) in [(even.points.column("f0").expect("f0"), 5), (measured, 3)] {
        for k in 0..=degree {
            let power = |x: f64| (0..k).fold(1.0, |p, _| p * x);
            let mean = values.iter().map(|x| power(*x)).sum::<f64>() / values.len() as f64;
            let exact = (power(0.75) * 0.75 - power(0.25) * 0.25) / (0.5 * f64::from(k + 1));
            let rounding = f64::from(k) * f64::from(f32::EPSILON) / 2.0;
            assert!((mean - exact).abs() < 1e-14 + rounding, "degree {k}: {mean} {exact}");
        }
    }
}

#[test]
fn a_generic_quantity_is_sampled_over_all_its_inputs() {
    let variant = Variant { side: Some(Side::Outside), ..Smith::Correlated.into() };
    let domain = BTreeMap::from([("ior".to_string(), [1.5, 1.5]), ("roughness".to_string(), [0.3, 0.4])]);
    let spec = TargetSpec { variant: variant.clone(), domain, column: Some("T".into()), ..spec("ggx-glass") };
    let target = Target::new(&spec, &formula("roughness mu ior")).expect("a target");
    assert!(target.is_dear());
    let sampled = target.at(&[vec![0.35, 0.5, 1.5]], &[1.0]).expect("T");
    let alpha = sampled.points.column("alpha").expect("alpha")[0];
    let exact = quantity::GGX_GLASS.at(&variant, &[alpha, 0.5, 1.5], 1e-8).expect("T");
    assert!((sampled.target[0] - exact[1]).abs() < 1e-6, "{} {}", sampled.target[0], exact[1]);
}

#[test]
fn bad_targets_are_refused_with_the_setting() {
    let range = |input: &str, range: [f64; 2]| BTreeMap::from([(input.to_string(), range)]);
    let cases: [(TargetSpec, &str, &str); 8] = [
        (TargetSpec { column: Some("F".into()), ..spec("ggx-reflection") }, "mu", "E, A, B, loss"),
        (
            TargetSpec { domain: range("mu", [0.5, 0.1]), ..spec("ggx-reflection") },
            "mu",
            "domain mu=0.5..0.1",
        ),
        (TargetSpec { domain: range("mu", [0.0, 1.5]), ..spec("ggx-reflection") }, "mu", "[0, 1]"),
        (TargetSpec { domain: range("ior", [1.0, 1.5]), ..spec("ggx-reflection") }, "mu", "no such input"),
        (TargetSpec { used_as: Some(Use::F0_BLEND), ..spec("ggx-reflection") }, "mu", "argument f0"),
        (TargetSpec { used_as: Some(COUPLING), ..spec("ggx-reflection") }, "mu", "diffuse-coupling"),
        (spec("ggx-glass"), "mu", "outside, inside"),
        (spec("ggx-average"), "mu", "`mu`"),
    ];
    for (spec, arguments, words) in cases {
        let error = Target::new(&spec, &formula(arguments)).expect_err(words).to_string();
        assert!(error.contains(words), "{error}");
    }
}

/// A lattice of one axis has as many points as one of two, and one without a range is a point.
#[test]
fn an_axis_of_one_value_does_not_square_the_lattice() {
    let fixed = |inputs: &[&str]| {
        let domain = inputs.iter().map(|input| (input.to_string(), [0.5, 0.5])).collect();
        let spec = TargetSpec { domain, ..spec("ggx-reflection") };
        let target = Target::new(&spec, &formula("alpha mu")).expect("a target");
        [target.even(&Memo::default()).expect("E"), target.edged(&Memo::default()).expect("E")]
            .map(|sampled| sampled.points.len())
    };
    let [even, edged] = fixed(&[]);
    for inputs in [["roughness"], ["mu"]] {
        let [one, with_edges] = fixed(&inputs);
        assert!(one > 100 && one <= 2 * even, "{inputs:?}: {one} {even}");
        assert!(with_edges > 100 && with_edges <= 2 * edged, "{inputs:?}: {with_edges} {edged}");
    }
    assert_eq!(fixed(&["roughness", "mu"])[0], 1);
}

/// Sheen is not defined at alpha = 0, and 0.001 is the roughness of its smallest alpha.
#[test]
fn an_edge_is_compared_with_the_range_of_its_own_input() {
    let sheen = Target::new(&spec("sheen-charlie"), &formula("alpha mu")).expect("a target");
    let names = ["alpha".to_string(), "mu".to_string()];
    for (input, at, words) in [
        ("roughness", 0.0, "0 is not in [0.001, 1]"),
        ("roughness", 1.5, "1.5 is not in"),
        ("alpha", 1e-7, "0.0000001 is not in [0.000001, 1]"),
        ("alpha", -0.25, "-0.25 is not in [0.000001, 1]"),
        ("alpha", 1.5, "1.5 is not in"),
    ] {
        let error = sheen.edge(&names, "f", (input, at), Some(1.0)).expect_err(words).to_string();
        assert!(error.contains(words), "{error}");
    }
    let (columns, values) = sheen.edge(&names, "f", ("alpha", 0.25), Some(1.0)).expect("inside");
    assert!(columns[0].iter().all(|alpha| *alpha == 0.25) && !values.is_empty());
}

/// Only inputs without a truth are mended by other ranges.
#[test]
fn a_truth_that_misses_its_tolerance_is_not_called_a_matter_of_ranges() {
    let misses = TargetError::Integrate(IntegrateError::Tolerance {
        quantity: "ggx-reflection",
        place: "alpha = 0.5".into(),
        reached: 1e-5,
        tolerance: 1e-7,
    });
    let outside = TargetError::Integrate(IntegrateError::Domain {
        quantity: "ggx-reflection",
        input: "alpha",
        value: 2.0,
        domain: "is outside [0, 1]",
    });
    assert!(
        misses.to_string().starts_with("ggx-reflection at alpha = 0.5: error bound")
            && !misses.names_a_setting()
    );
    let told = outside.to_string();
    assert!(
        told.starts_with("domain: ") && told.ends_with("give ranges that leave such inputs out"),
        "{told}"
    );
    assert!(outside.names_a_setting());
}
