//! Loops, structures of fetches and lookups of tables, as each language has them.

use lobefit_shade::Source;
use lobefit_shade::code::{C_PREFIX, Language, RUST_HELPERS, TableLookup, Texels, helpers};

const TEXT: &str = "
/// What to fetch.
struct Taps { fetch_0: vec4f, fetch_1: vec4f, weight_0: f32, weight_1: f32 }

fn taps(at: vec4f, x: f32) -> Taps { return Taps(at, at, x, 1.0 - x); }

fn nearest(planes: array<vec4f, 3>, x: f32) -> f32 {
    var best = x;
    for (var i = 0; i < 3; i++) {
        let plane = planes[i];
        best = min(best, plane.w * x);
    }
    return best;
}
";

fn source() -> Source {
    Source::parse("taps.wgsl", TEXT).expect("it parses")
}

#[test]
fn a_loop_goes_over_each_vector_of_a_list() {
    for (language, opened) in [
        (Language::Wgsl, &["for (var i = 0; i < 3; i++) {", "let plane = every[i];"][..]),
        (Language::Rust, &["for plane in planes {"]),
        (Language::C, &["for (int i = 0; i < 3; ++i) {", "lobefit_float4 plane = planes[i];"]),
        (Language::Hlsl, &["for (int i = 0; i < 3; ++i) {", "float4 plane = planes[i];"]),
    ] {
        let text = source().print(language, "nearest", &[]).expect("printed");
        assert!(opened.iter().all(|line| text.contains(line)), "{text}");
    }
    for to in ["i < 2", "i < 4"] {
        let error = Source::parse("taps.wgsl", &TEXT.replace("i < 3", to)).expect_err(to).to_string();
        assert!(error.contains("a loop goes over an array of vectors"), "{error}");
    }
}

#[test]
fn fetches_and_their_weights_are_a_structure() {
    for (language, name, declared, given) in [
        (Language::C, "Taps", "typedef struct Taps {\n", "weight_1 = 1.0f - x;"),
        (Language::Hlsl, "Taps", "struct Taps {\n", "weight_1 = 1.0f - x;"),
        (
            Language::Rust,
            "Taps",
            "pub weights: [f32; 2],\n}\n",
            "Taps { fetches: [at, at], weights: [x, 1.0 - x] }",
        ),
    ] {
        let structure = source().print_structure(language, "taps").expect("printed").expect("a structure");
        assert!(structure.contains(declared) && structure.contains(name), "{structure}");
        let text = source().print(language, "taps", &[]).expect("printed");
        assert!(text.contains(given), "{text}");
    }
}

/// A table of one channel over so many axes.
fn table(sizes: &[usize]) -> TableLookup {
    TableLookup {
        name: "albedo".into(),
        stem: "albedo_at".into(),
        about: Vec::new(),
        sizes: sizes.to_vec(),
        channels: 1,
        values: 1,
        meaning: "E",
        arguments: vec!["roughness", "n_dot_v"],
        coordinates: vec!["roughness", "n_dot_v"],
        decoding: Vec::new(),
        texels: Texels::Common,
    }
}

/// Languages without textures fetch by functions of their own, and have those that a lookup calls.
#[test]
fn languages_without_textures_have_what_their_lookups_call() {
    for (language, prefix) in [(Language::C, C_PREFIX), (Language::Rust, "")] {
        for (sizes, fetch) in [(&[4, 4][..], "bilinear("), (&[4, 4, 4], "trilinear(")] {
            let lookup = table(sizes).print(language);
            let called = format!("{prefix}{fetch}");
            assert!(lookup.contains(&called) && lookup.contains("albedo_at_decode("), "{lookup}");
            let shared = helpers(language, &lookup);
            assert!(shared.contains(&called), "{shared}");
            assert_eq!(shared.contains("trilinear("), sizes.len() == 3, "{shared}");
        }
        assert_eq!(helpers(language, "return x;"), "");
    }
    assert!(
        RUST_HELPERS
            .iter()
            .all(|name| helpers(Language::Rust, &table(&[4, 4, 4]).print(Language::Rust)).contains(name))
    );
}

/// Of a built-in each language has its own function, a function beside, or what it stands for; what is not
/// read is named where a compiler asks for that.
#[test]
fn built_ins_and_unread_arguments_are_as_each_language_has_them() {
    let text = "fn f(x: f32, y: f32) -> f32 { return fma(x, x, 1.0) + smoothstep(0.0, 1.0, x); }";
    let source = Source::parse("f.wgsl", text).expect("it parses");
    for (language, lines) in [
        (Language::C, &["    (void)y;\n", "fmaf(x, x, 1.0f) + smoothstep(0.0f, 1.0f, x)"][..]),
        (
            Language::Rust,
            &["    let _ = y;\n", "fn smoothstep(lo: f32, hi: f32, x: f32)", "x.mul_add(x, 1.0) + "],
        ),
        (Language::Hlsl, &["mad(x, x, 1.0f) + "]),
        (Language::Glsl, &["return x * x + 1.0 + "]),
        (Language::Msl, &["fma(x, x, 1.0f) + "]),
    ] {
        let text = source.print(language, "f", &[]).expect("printed");
        assert!(lines.iter().all(|line| text.contains(line)), "{text}");
    }
}
