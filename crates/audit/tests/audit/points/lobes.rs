//! Tables of other shadowings than Smith's and Neubelt's, made as their authors make them.

use lobefit::data::Smith;
use lobefit_audit::audit::{Audit, AuditedTable, Column, Fit, Fixed, Form, Registration, Scale};
use lobefit_math::ops;
use lobefit_truth::quantity::EstevezKulla;
use lobefit_truth::quantity::{Quantity, SCHLICK_SMITH, Variant};

use super::{N, at};
use crate::support::{axes, both, columns, half, refused, rising, said, says, shipped};

/// Of so many texels along each axis.
fn square(size: usize, channels: Vec<(&str, Vec<f64>)>) -> AuditedTable {
    shipped(&[size; 2], channels)
}

fn of(form: Option<&str>) -> Fixed {
    Fixed { form: form.map(|word| Form::find(word).expect("a form")), ..Fixed::default() }
}

fn run(shipped: &AuditedTable, quantity: &str, form: Option<&str>) -> Audit {
    crate::support::run(shipped, quantity, &of(form))
}

/// A and B by `samples` points of Hammersley's set drawn from D, with Schlick's G1 of a k: the loop
/// of Karis' course notes (2013).
pub fn karis(mu: f64, roughness: f64, k: f64, samples: u32) -> [f64; 2] {
    let alpha = roughness * roughness;
    let g1 = |x: f64| x / (x * (1.0 - k) + k);
    let view = [(1.0 - mu * mu).sqrt(), mu];
    let mut sums = [0.0; 2];
    for i in 0..samples {
        let (u, v) = (f64::from(i) / f64::from(samples), f64::from(i.reverse_bits()) / 4294967296.0);
        let phi = 2.0 * std::f64::consts::PI * u;
        let cosine = ((1.0 - v) / (1.0 + (alpha * alpha - 1.0) * v)).sqrt();
        let sine = (1.0 - cosine * cosine).sqrt();
        let y = view[0] * sine * ops::cos(phi) + view[1] * cosine;
        let mu_l = 2.0 * y * cosine - mu;
        if mu_l > 0.0 {
            let kept = g1(mu) * g1(mu_l) * y.max(0.0) / (cosine * mu);
            let weight = ops::pow(1.0 - y.clamp(0.0, 1.0), 5.0);
            sums[0] += (1.0 - weight) * kept / f64::from(samples);
            sums[1] += weight * kept / f64::from(samples);
        }
    }
    sums
}

fn lut(k: impl Fn(f64) -> f64) -> AuditedTable {
    let at = |i: usize| (i as f64 + 0.5) / 32.0;
    let texel = |i: usize| karis(at(i % 32), at(i / 32), k(at(i / 32)), 1024);
    let texels: Vec<[f64; 2]> = (0..1024).map(texel).collect();
    let channel = |k: usize| texels.iter().map(|t| half(t[k])).collect();
    square(32, vec![("R", channel(0)), ("G", channel(1))])
}

/// The most copied LUT of all "fits no convention, do not ship".
#[test]
fn point_04_karis_lut_is_what_it_is() {
    let lut = lut(|r| 0.5 * r * r);
    let found = run(&lut, "ggx-reflection", None);
    assert_eq!(found.best().lobe.form.word, "schlick");
    assert_eq!((found.fit, columns(&found)), (Fit::Whole, vec![Some(Column::A), Some(Column::B)]));
    assert_eq!(axes(&found), rising(&[Scale::Mu, Scale::Roughness], Registration::Centre));
    assert!(found.margin > 2.0 && found.worst() < 0.02, "{} {}", found.margin, found.worst());
    // Its distance from correlated GGX is said, and fails a limit until it is said to be meant.
    says(
        &found.verdict(None),
        "PASS",
        &[
            "Schlick-Smith with k = alpha/2",
            "read plainly (height-correlated Smith), it is off by at most 0.3",
        ],
    );
    let (lobe, off) = found.departure.as_ref().expect("another lobe");
    assert!(lobe.form.word == "correlated" && (0.3..0.4).contains(off), "{lobe:?} {off}");
    let plain = found.plain.as_ref().expect("the name stands for another lobe");
    assert!(plain.options == "--smith schlick" && plain.max == *off, "{plain:?}");
    says(
        &found.verdict(Some(0.05)),
        "FAIL",
        &["read plainly", "Schlick-Smith with k = alpha/2", "`--smith schlick`"],
    );
    let meant = run(&lut, "ggx-reflection", Some("schlick"));
    assert!(meant.plain.is_none(), "{:?}", meant.plain);
    says(&meant.verdict(Some(0.05)), "PASS", &["Held against height-correlated Smith"]);
}

#[test]
fn point_04_the_other_ks_are_told_apart() {
    for (word, k) in [
        ("schlick-lights", &(|r: f64| (r + 1.0) * (r + 1.0) / 8.0) as &dyn Fn(f64) -> f64),
        ("schlick-alpha", &|r: f64| r * r),
    ] {
        let found = run(&lut(k), "ggx-reflection", None);
        assert_eq!((found.best().lobe.form.word, found.fit), (word, Fit::Whole));
    }
}

/// Between end points, with mu clamped and alpha, "no texel lies in the domain": where this lobe sends
/// nothing, at mu 0, a ratio of two columns is 0/0, which ranked before every number.
#[test]
fn a_lobe_that_is_dark_at_grazing_is_recognised_between_end_points() {
    let at = |i: usize| i as f64 / 31.0;
    let both = |i: usize| {
        let (mu, alpha) = (at(i % 32).max(1e-3), (at(i / 32) * at(i / 32)).max(1e-4));
        let of = SCHLICK_SMITH[1].at(&Smith::Separable.into(), &[alpha, mu], 1e-7).unwrap();
        [of[1], of[2]]
    };
    let texels: Vec<[f64; 2]> = (0..1024).map(both).collect();
    let channel = |k: usize| texels.iter().map(|t| f64::from(t[k] as f32)).collect();
    let made = square(32, vec![("R", channel(0)), ("G", channel(1))]);
    for fixed in
        [Fixed::default(), Fixed { registrations: Some(vec![Registration::Endpoint]), ..Fixed::default() }]
    {
        let found = crate::support::run(&made, "ggx-reflection", &fixed);
        assert_eq!(found.best().lobe.form.word, "schlick-lights", "{}", said(&found));
        assert!(found.worst() < 1e-3, "{}", said(&found));
    }
}

/// Unreal's own LUT "fits no convention".
#[test]
fn the_joint_form_without_roots_is_recognised() {
    let at = |i: usize| (i as f64 + 0.5) / 32.0;
    let both = |i: usize| {
        let (mu, alpha) = (at(i % 32), at(i / 32) * at(i / 32));
        let of = SCHLICK_SMITH[0].at(&Smith::Correlated.into(), &[alpha, mu], 1e-7).unwrap();
        [of[1], of[2]]
    };
    let texels: Vec<[f64; 2]> = (0..1024).map(both).collect();
    let channel = |k: usize| texels.iter().map(|t| half(t[k])).collect();
    let found = run(&square(32, vec![("R", channel(0)), ("G", channel(1))]), "ggx-reflection", None);
    assert_eq!((found.best().lobe.form.word, found.fit), ("joint-approx", Fit::Whole));
    says(&found.verdict(None), "PASS", &["without roots, and by 0.187", "as height-correlated Smith"]);
}

/// Neubelt's visibility alone was known, under the names of Estevez and Kulla; their own table was rejected.
#[test]
fn point_14_estevez_and_kulla_s_own_table_of_sheen_is_recognised() {
    let e = |i: usize| {
        let x = [at(i / N) * at(i / N), at(i % N)];
        EstevezKulla.at(&Variant::default(), &x, 1e-5).expect("a truth")[0]
    };
    let table = square(N, vec![("R", (0..N * N).map(e).collect())]);
    let found = run(&table, "sheen-charlie", None);
    assert_eq!((found.best().lobe.form.word, found.fit), ("estevez-kulla", Fit::Whole));
    assert_eq!(axes(&found), rising(&[Scale::Mu, Scale::Roughness], Registration::Centre));
    assert_eq!(columns(&found), [Some(Column::E)]);
    assert!(found.worst() < 2e-5 && found.margin > 10.0, "{} {}", found.worst(), found.margin);
    let (lobe, off) = found.departure.as_ref().expect("another lobe");
    assert!(lobe.form.word == "neubelt" && *off > 0.05, "{off}");
    says(&found.verdict(None), "PASS", &["sheen-charlie E", "the shadowing of Estevez and Kulla (2017)"]);
    says(
        &found.verdict(Some(0.05)),
        "FAIL",
        &["read plainly", "it has the shadowing of Estevez and Kulla", "`--smith estevez-kulla`"],
    );
    assert_eq!(found.plain.as_ref().map(|plain| plain.options.as_str()), Some("--smith estevez-kulla"));
    assert!(refused(&table, "sheen-charlie", &of(Some("correlated"))).contains("neubelt, estevez-kulla"));
}

/// A sheen as glTF's sample viewer ships it: no alpha below 0.07, nothing beyond the first centre of the 16
/// texels that it was made larger from, encoded for display.
#[test]
fn point_14_a_sheen_that_was_clamped_and_encoded_is_recognised() {
    let at = |i: usize| (i as f64 + 0.5) / 24.0;
    let stored = |i: usize| {
        let x = [(at(i / 24) * at(i / 24)).max(0.07), at(i % 24).max(1.0 / 32.0)];
        let e = EstevezKulla.at(&Variant::default(), &x, 1e-4).expect("a truth")[0];
        let encoded = if e <= 0.0031308 { 12.92 * e } else { 1.055 * ops::pow(e, 1.0 / 2.4) - 0.055 };
        (encoded.min(1.0) * 65535.0).round() / 65535.0
    };
    let found = run(&square(24, vec![("R", (0..576).map(stored).collect())]), "sheen-charlie", None);
    assert_eq!(found.encoding.map(|encoding| encoding.word), Some("srgb"));
    assert_eq!((found.best().lobe.form.word, found.fit), ("estevez-kulla", Fit::Whole));
    assert_eq!(
        found.best().axes.iter().map(|axis| axis.scale).collect::<Vec<_>>(),
        [Scale::Mu, Scale::Roughness]
    );
    assert!(found.best().axes[1].floor == 0.07 && found.worst() < 0.01, "{}", found.worst());
}

/// A table half way between both forms of Smith is of neither.
#[test]
fn a_table_between_two_lobes_is_of_no_lobe_for_certain() {
    let of = |smith, i: usize| both(smith, at(i / N) * at(i / N), at(i % N));
    let mean = |i: usize| {
        let (one, other) = (of(Smith::Correlated, i), of(Smith::Separable, i));
        (0.52 * one.0 + 0.48 * other.0, 0.52 * one.1 + 0.48 * other.1)
    };
    let channel = |f: &dyn Fn((f64, f64)) -> f64| (0..N * N).map(|i| f(mean(i))).collect::<Vec<f64>>();
    let table = square(N, vec![("R", channel(&|(e, b)| e - b)), ("G", channel(&|(_, b)| b))]);
    let found = run(&table, "ggx-reflection", None);
    let why = "since another convention fits nearly as well, and its own not closely";
    says(&found.verdict(None), "UNKNOWN", &[why, "--smith say what is meant"]);
}

/// Karis' loop with few samples and an alpha of at least 0.0001: its first rows are the same, and no value is
/// clamped.
#[test]
fn rows_that_a_clamp_makes_one_are_no_clamp_of_values() {
    const SIDE: usize = 256;
    let centre = |i: usize| (i as f64 + 0.5) / SIDE as f64;
    let texel = |i: usize| {
        let roughness = centre(i / SIDE).max(0.01);
        karis(centre(i % SIDE), roughness, 0.5 * roughness * roughness, 64).map(half)
    };
    let texels: Vec<[f64; 2]> = (0..SIDE * SIDE).map(texel).collect();
    let channel = |k: usize| texels.iter().map(|texel| texel[k]).collect();
    let found = run(&square(SIDE, vec![("R", channel(0)), ("G", channel(1))]), "ggx-reflection", None);
    says(&found.verdict(None), "PASS", &["as Schlick-Smith with k = alpha/2"]);
}
