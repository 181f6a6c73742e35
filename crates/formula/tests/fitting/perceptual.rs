//! `lobefit fit --weight perceptual`: the weight, and what a fit with it minimises.

use crate::common;

use common::{lobefit, stderr};
use lobefit::report::{Image, luminance};
use lobefit_formula::perceptual::Perceptual;
use lobefit_studies::flip;
use lobefit_studies::render::{Environment, diffuse_light};
use serde_json::Value;

/// Between its parts: sqrt(mu) of the furnace's half alone, and sqrt(2 mu) if the lit sphere were
/// as bright everywhere.
#[test]
fn the_weight_lies_between_its_bounds_and_rises() {
    let weight = Perceptual::new();
    assert_eq!(weight.at(0.0), 0.0);
    let mut last = 0.0;
    for i in 1..=200 {
        let mu = f64::from(i) / 200.0;
        let w = weight.at(mu);
        assert!(w > mu.sqrt() && w < (2.0 * mu).sqrt(), "mu {mu}: {w}");
        assert!(w > last, "mu {mu}: {w} after {last}");
        last = w;
    }
}

/// The definition by FLIP itself: of flat grey pictures at the radiance of each pixel of a white
/// sphere, before and after a small relative error, the squares of FLIP^(1/0.7) have the weight's
/// mean.
#[test]
fn the_weight_is_the_mean_square_of_flips_colour_difference() {
    let environment = Environment::afternoon();
    let light = |n: [f64; 3]| luminance(diffuse_light(&environment, n));
    let normals = |mu: f64| {
        (0..64).map(move |k| {
            let (s, c) = lobefit_math::ops::sincos(std::f64::consts::TAU * (f64::from(k) + 0.5) / 64.0);
            let r = (1.0 - mu * mu).sqrt();
            [r * c, r * s, mu]
        })
    };
    let brightest = (0..=40).flat_map(|i| normals(f64::from(i) / 40.0)).map(light).fold(0.0, f64::max);
    let grey = |y: f64| Image::of(8, 8, |_, _| [y; 3]);
    let seen = |y: f64| {
        let map = flip::ldr(&grey(y), &grey(y * (1.0 - 1e-4)), flip::PIXELS_PER_DEGREE).expect("a map");
        lobefit_math::ops::pow(lobefit_math::sum::mean(&map.values), 2.0 / 0.7)
    };
    let weight = Perceptual::new();
    for mu in [0.125, 0.5, 0.875] {
        let lit: Vec<f64> = normals(mu).map(|n| seen(light(n) / brightest)).collect();
        let lit = lit.iter().sum::<f64>() / lit.len() as f64;
        let expected = (2.0 * mu * (1.0 + lit / seen(1.0)) / 2.0).sqrt();
        assert!(
            (weight.at(mu) / expected - 1.0).abs() < 0.01,
            "mu {mu}: {} against {expected}",
            weight.at(mu)
        );
    }
}

fn fit(options: &[&str]) -> Value {
    let folder = tempfile::tempdir().expect("a folder");
    let formula = concat!(
        "override a: f32 = 1.0;\noverride b: f32 = -1.0;\n",
        "fn mine(roughness: f32, mu: f32) -> f32 { return 1.0 + alpha_like(roughness) * (a + b * mu); }\n",
        "fn alpha_like(r: f32) -> f32 { return r * r * r; }\n"
    );
    std::fs::write(folder.path().join("mine.wgsl"), formula).expect("written");
    let all =
        [&["fit", "mine.wgsl", "--to", "ggx-reflection:E", "--use", "normalisation", "--json"], options];
    let output = lobefit(folder.path(), &all.concat(), b"");
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    serde_json::from_slice(&output.stdout).expect("JSON")
}

#[test]
fn a_weighted_fit_trades_grazing_views_for_those_that_are_seen() {
    let plain = fit(&["--norm", "rms"]);
    let weighted = fit(&["--norm", "rms", "--weight", "perceptual"]);
    assert_eq!(weighted["fits"][0]["weight"], "perceptual");
    let error = |fit: &Value, key: &str| fit["fits"][0]["certificate"][key].as_f64().expect("a number");
    assert!(error(&weighted, "rms") > error(&plain, "rms"), "the plain fit minimises the plain mean square");
    assert!(error(&weighted, "max_abs") > error(&plain, "max_abs"), "grazing views count less");
}

#[test]
fn a_quantity_without_mu_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let formula = "override a: f32 = 1.0;\nfn mine(alpha: f32) -> f32 { return 1.0 - a * alpha; }\n";
    std::fs::write(folder.path().join("mine.wgsl"), formula).expect("written");
    let options = ["fit", "mine.wgsl", "--to", "ggx-average:E_avg", "--weight", "perceptual"];
    let output = lobefit(folder.path(), &options, b"");
    assert_eq!(output.status.code(), Some(2));
    let said = stderr(&output);
    assert!(said.contains("--weight `perceptual`: weighs by mu, which is no input of ggx-average"), "{said}");
}
