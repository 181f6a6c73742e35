//! A scene's bake, and its include files.

use crate::baked_support::bake_scene;
use lobefit::approximate::{Entry, Fit};
use lobefit::bake::Baked;
use lobefit::scene::Scene;
use lobefit_shade::code::Language;
use lobefit_shade::{Source, Tape};

use super::compilers::includes_in_cpp;
use super::languages::compile;
use super::programs::compile_library;

pub fn baked(json: &str) -> Baked {
    let scene = Scene::from_json(json.as_bytes(), "scene.json").expect("a scene");
    bake_scene(&scene).expect("a bake")
}

/// A function of an emitted text, its first channel where that has several.
pub fn function(source: &Source, name: &str) -> impl Fn(&[(&str, f64)]) -> f64 + use<> {
    let tape: Tape = source.tape(name, 0).expect("a function");
    move |given| {
        let of = |input: &String| {
            let found = given.iter().find(|(name, _)| input.starts_with(name));
            found.unwrap_or_else(|| panic!("{input} is not given")).1 as f32
        };
        f64::from(tape.at(&tape.inputs().iter().map(of).collect::<Vec<f32>>(), &[]))
    }
}

/// The include file of a language.
pub fn text(baked: &Baked, language: Language) -> String {
    let file = format!("fits/lobefit.{}", language.extension());
    String::from_utf8(baked.files[&file].clone()).expect("UTF-8")
}

/// Every formula has a fit, and each emitted one is within its certificate at places of roughness, mu and
/// ior, but for what the truths there are off by; no certificate is idle, for so large a part of it is met.
pub fn certified(
    baked: &Baked,
    formulas: &[Entry],
    (places, truths): (&[[f64; 3]], &[f64]),
    off: f64,
    part: f64,
) {
    let source = Source::parse("lobefit.wgsl", &text(baked, Language::Wgsl)).expect("it parses");
    let own = |fit: &&Fit| formulas.iter().any(|formula| formula.name() == fit.approximation.name);
    let emitted: Vec<&Fit> = baked.fits.iter().filter(|fit| fit.emitted).filter(own).collect();
    assert_eq!(emitted.len(), formulas.len(), "a formula has no fit");
    for fit in emitted {
        let (name, stated) = (fit.hypothesis.name(), fit.approximation.certificate.max_abs);
        let tape = source.tape(name, 0).expect("a function");
        let value = |place: &[f64; 3]| {
            let of = |input: &String| match input.as_str() {
                "roughness" => place[0] as f32,
                "alpha" => (place[0] as f32) * (place[0] as f32),
                "ior" => place[2] as f32,
                _ => place[1] as f32,
            };
            f64::from(tape.at(&tape.inputs().iter().map(of).collect::<Vec<f32>>(), &[]))
        };
        let residual = fit.approximation.used_as.residual;
        let errors =
            places.iter().zip(truths).map(|(place, truth)| (residual.of(value(place), *truth), place));
        let (error, place) = errors.max_by(|a, b| a.0.abs().total_cmp(&b.0.abs())).expect("places");
        println!("{name}: {error:.5} at roughness, mu, ior {place:?}; stated {stated}");
        assert!(error.abs() <= stated + off, "{name}: {error} at {place:?}; stated {stated}");
        assert!(error.abs() > part * stated, "{name}: {stated} is stated, {error} found");
    }
}

/// The compilers of four languages take the files.
pub fn compiled(baked: &Baked) {
    for language in [Language::Hlsl, Language::Glsl] {
        compile(language, &text(baked, language));
    }
    includes_in_cpp(&text(baked, Language::C));
    compile_library(&text(baked, Language::Rust));
}
