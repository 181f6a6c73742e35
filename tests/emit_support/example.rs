//! A scene's bake, and its include files.

use lobefit::bake::{Baked, Selection, Silent, bake};
use lobefit::plan::plan;
use lobefit::scene::Scene;
use lobefit_shade::code::Language;

use super::compilers::includes_in_cpp;
use super::languages::compile;
use super::programs::compile_library;

pub fn baked(json: &str) -> Baked {
    let scene = Scene::from_json(json.as_bytes(), "scene.json").expect("a scene");
    bake(&scene, &plan(&scene), &[], Selection::default(), &Silent).expect("a bake")
}

/// The include file of a language.
pub fn text(baked: &Baked, language: Language) -> String {
    let file = format!("fits/lobefit.{}", language.extension());
    String::from_utf8(baked.files[&file].clone()).expect("UTF-8")
}

/// The compilers of four languages take the files.
pub fn compiled(baked: &Baked) {
    for language in [Language::Hlsl, Language::Glsl] {
        compile(language, &text(baked, language));
    }
    includes_in_cpp(&text(baked, Language::C));
    compile_library(&text(baked, Language::Rust));
}
