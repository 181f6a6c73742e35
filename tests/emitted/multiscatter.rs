//! The reciprocal lobe of the light that is lost between facets, as emitted.
#![allow(clippy::disallowed_methods)]

use crate::emit_support;

use std::f64::consts::PI;
use std::sync::LazyLock;

use emit_support::example::{baked, compiled, function, text};
use lobefit::bake::Baked;
use lobefit::data::{Form, Smith};
use lobefit::effects::table::{Lookup, Point};
use lobefit_math::gauss::Gauss;
use lobefit_shade::Source;
use lobefit_shade::code::Language;
use lobefit_truth::integrate::reflection::{self, Effort};
use lobefit_truth::optics::fresnel;

/// The bake of steel that wants this.
fn steel(wants: &str) -> Baked {
    baked(&format!(
        r#"{{"schema_version": 1, "name": "steel", "reports": false, "materials": [{{"name": "steel", "kind": "metal", "f0": [0.56, 0.57, 0.58],
            "roughness": [0.1, 1], "wants": {wants}}}]}}"#
    ))
}

static STEEL: LazyLock<Baked> =
    LazyLock::new(|| steel(r#"{"fit": {"max_error": 0.012, "multiscatter": true}}"#));

/// An emitted function of these arguments.
fn emitted<const N: usize>(name: &str, arguments: [&'static str; N]) -> impl Fn([f64; N]) -> f64 {
    let source = Source::parse("lobefit.wgsl", &text(&STEEL, Language::Wgsl)).expect("it parses");
    let function = function(&source, name);
    move |values| {
        let given: Vec<(&str, f64)> = arguments.into_iter().zip(values).collect();
        function(&given)
    }
}

fn lobe() -> impl Fn([f64; 4]) -> f64 {
    emitted("ggx_multiscatter_lobe", ["f_avg", "e_v", "e_l", "e_avg"])
}

/// E of the lobe with F = 1.
fn albedo(roughness: f64, mu: f64) -> f64 {
    reflection::albedo(Smith::Correlated, roughness * roughness, mu, &Effort::ladder()[1].outer)
}

/// What the lobe sends back of a white environment towards a view, by the rule of 40 nodes.
fn sent_back(lobe: impl Fn(f64) -> f64) -> f64 {
    Gauss::new(40).integrate(0.0, 1.0, |mu| 2.0 * PI * mu * lobe(mu))
}

#[test]
fn lobe_and_lost_light_make_a_white_furnace() {
    let tabulated = steel(r#"{"tables": [{"size": [32, 32]}]}"#);
    let [baked] = &tabulated.tables[..] else { panic!("a table of E") };
    let Form::Table(table) = &baked.approximation.form else { panic!("texels") };
    let lookup = Lookup::new(table, baked.decode).expect("of its decoding");
    let held = |roughness: f64, mu: f64| {
        let (roughness, mu) = (roughness as f32, mu as f32);
        f64::from(lookup.at(&Point { roughness, alpha: roughness * roughness, mu, ..Point::default() }).e)
    };
    let (lobe, average) = (lobe(), emitted("ggx_average_albedo", ["roughness"]));
    let (mut exact, mut by_table) = (0.0_f64, [(0.0, 0.0, 0.0); 2]);
    for roughness in [0.1, 0.25, 0.5, 0.75, 1.0] {
        let mean = Gauss::new(40).integrate(0.0, 1.0, |mu| 2.0 * mu * albedo(roughness, mu));
        for mu in [0.02, 0.1, 0.3, 0.7, 1.0] {
            let (view, e_avg) = (albedo(roughness, mu), average([roughness]));
            let white = sent_back(|light| lobe([1.0, view, albedo(roughness, light), mean]));
            exact = exact.max((view + white - 1.0).abs());
            let white = sent_back(|light| lobe([1.0, held(roughness, mu), held(roughness, light), e_avg]));
            let off = (view + white - 1.0).abs();
            // Where little is lost, what is lost on average divides the table's error.
            let worst = &mut by_table[usize::from(roughness < 0.25)];
            *worst = if off > worst.0 { (off, roughness, mu) } else { *worst };
            // Each bounce from the second on is tinted once more: the sum of them, one by one.
            let tinted = sent_back(|light| lobe([0.6, view, albedo(roughness, light), mean]));
            let bounces = (0..200).map(|k| 0.6 * 0.6 * mean * (0.6 * (1.0 - mean)).powi(k));
            let expected = (1.0 - view) * bounces.sum::<f64>();
            assert!((tinted - expected).abs() < 2e-5, "{roughness} {mu}: {tinted} {expected}");
        }
    }
    println!(
        "furnace: exact arguments within {exact:.1e}, by a table within {by_table:.4?} at roughness, mu"
    );
    assert!(exact < 2e-5, "{exact:e}");
    assert!(by_table[0].0 < 1e-3 && by_table[1].0 < 0.025, "{by_table:?}");
}

#[test]
fn directions_can_be_exchanged_and_nothing_is_added_where_nothing_is_lost() {
    let lobe = lobe();
    for [view, light, mean] in [[0.4, 0.9, 0.6], [0.95, 0.97, 0.96], [0.5, 1.0, 0.8]] {
        let [there, back] = [[0.7, view, light, mean], [0.7, light, view, mean]].map(&lobe);
        assert!((there - back).abs() <= 1e-6 * there, "{there} {back}");
    }
    assert_eq!(lobe([1.0, 1.0, 1.0, 1.0]), 0.0);
    // Where nothing is lost, errors of both E leave little: here the energy of a lobe that is the same
    // everywhere.
    for e_avg in [1.0, 1.0005] {
        let left = PI * lobe([1.0, 0.9995, 0.9995, e_avg]);
        assert!(left > 0.0 && left < 0.002, "{e_avg}: {left}");
    }
    assert_eq!(lobe([0.0, 0.5, 0.5, 0.6]), 0.0);
}

#[test]
fn means_of_fresnel_factors_are_their_integrals() {
    let (schlick, tinted) =
        (emitted("fresnel_average_schlick", ["f0"]), emitted("fresnel_average_f82", ["f0", "f82"]));
    let at = |mu: f64, f0: f64| f0 + (1.0 - f0) * (1.0 - mu).powi(5);
    let mean = |f: &dyn Fn(f64) -> f64| Gauss::new(16).integrate(0.0, 1.0, |mu| 2.0 * mu * f(mu));
    for f0 in [0.04, 0.56, 0.95] {
        assert!((schlick([f0]) - mean(&|mu| at(mu, f0))).abs() < 1e-6);
        for f82 in [0.2, 0.8, 1.0] {
            let edge = 1.0 / 7.0;
            let less = at(edge, f0) * (1.0 - f82) / (edge * (1.0 - edge).powi(6));
            let exact = mean(&|mu| at(mu, f0) - less * mu * (1.0 - mu).powi(6));
            assert!((tinted([f0, f82]) - exact).abs() < 1e-6, "{f0} {f82}");
        }
    }
}

/// The figures of docs/scene.md: of Schlick's term with the same f0 too.
#[test]
fn the_mean_of_a_conductor_is_that_of_the_exact_term() {
    let (exact, by_schlick) =
        (emitted("fresnel_conductor", ["eta", "k", "cosine"]), emitted("fresnel_average_schlick", ["f0"]));
    let mean = emitted("fresnel_average_conductor", ["eta", "k"]);
    let (mut worst, mut schlick) = (0.0_f64, 0.0_f64);
    for eta in [0.05, 0.18, 0.5, 1.0, 1.6, 2.5, 4.0, 6.0] {
        for k in [1.0, 1.5, 2.0, 3.5, 6.0, 10.0] {
            let at = |mu: f64| fresnel::conductor(eta, k, mu);
            for mu in [0.01, 0.2, 0.7, 1.0] {
                assert!((exact([eta, k, mu]) - at(mu)).abs() < 2e-4, "{eta} {k} {mu}");
            }
            // The root of mu takes the bend towards grazing out.
            let found = Gauss::new(64).integrate(0.0, 1.0, |x| 4.0 * x * x * x * at(x * x));
            worst = worst.max((mean([eta, k]) - found).abs());
            schlick = schlick.max((by_schlick([at(1.0)]) - found).abs());
        }
    }
    println!("mean of conductors within {worst:.4}, by Schlick's term within {schlick:.3}");
    assert!(worst < 0.0018 && worst > 0.0012, "{worst}");
    assert!(schlick > 0.06, "{schlick}");
}

#[test]
fn the_average_is_called_for_the_lobe() {
    let call = STEEL.calls.iter().find(|call| call.function == "ggx_average_albedo").expect("a call");
    assert_eq!(call.then.as_deref(), Some("ggx_multiscatter_lobe"));
    assert_eq!(call.around[0].value.as_deref(), Some("e_avg"));
}

#[test]
fn compilers_take_the_files() {
    compiled(&STEEL);
}
