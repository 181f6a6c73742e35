//! Lookups of probes as emitted: what they fetch, in every language.

use crate::emit_support::compilers::includes_in_cpp;
use crate::emit_support::languages::{FAMILY, compile};
use crate::emit_support::programs::compile_library;
use crate::lookup_support::{EMITTED, found, text};
use lobefit_shade::code::Language;

#[test]
fn lookups_fetch_in_every_language_what_those_of_the_study_do() {
    assert_eq!(EMITTED.len(), 19);
    let rust = text(Language::Rust);
    compile_library(&rust);
    for language in [Language::Hlsl, Language::Glsl] {
        assert!(compile(language, &text(language)).is_none_or(|functions| functions > EMITTED.len()));
    }
    includes_in_cpp(&text(Language::C));
    for emitted in EMITTED.iter() {
        let points = emitted.points();
        emitted.agrees("rust", &points, &emitted.run_in_rust(&rust, &points));
        for language in FAMILY {
            let Some(found) = found(language, emitted, &points) else { continue };
            emitted.agrees(language.name(), &points, &found);
        }
    }
}
