//! Functions of vectors: parsed, counted, evaluated, written out, and printed in every language.

use lobefit_shade::Source;
use lobefit_shade::code::Language;

const TEXT: &str = "
fn fitted(alpha: f32, f0: f32) -> f32 { return alpha + f0; }
fn factor(alpha: f32, mu: f32, f0: f32) -> f32 { return fitted(alpha, f0); }
fn half_of(x: f32) -> f32 { let y = 0.5 * x; return y; }

/// A sum.
fn sum(lobe: vec3f, albedo: vec3f, alpha: f32, mu: f32, f0: f32) -> vec3f {
    let base = half_of(factor(alpha, mu, f0));
    let unit = lobe / sqrt(dot(lobe, lobe));
    return select(unit, lobe + albedo * base, base > 0.25);
}
";

fn source() -> Source {
    let source = Source::parse("sum.wgsl", TEXT).expect("it parses");
    source.inlined(|name| name != "fitted").trimmed()
}

#[test]
fn calls_are_written_out_and_unread_arguments_are_gone() {
    let source = source();
    let arguments = source.read("sum").expect("a function");
    assert_eq!(arguments, ["lobe", "albedo", "alpha", "f0"]);
    let text = source.print_documented(Language::Wgsl, "sum").expect("printed");
    for line in [
        "/// A sum.",
        "fn sum(lobe: vec3<f32>, albedo: vec3<f32>, alpha: f32, f0: f32) -> vec3<f32> {",
        "fitted(alpha, f0)",
        "let unit = lobe / sqrt(dot(lobe, lobe));",
        "return select(unit, lobe + albedo * base, base > 0.25);",
    ] {
        assert!(text.contains(line), "{line}\n{text}");
    }
}

/// A value of a variable is not that of the same variable after it was assigned to.
#[test]
fn a_name_is_not_used_again_after_its_variable_has_changed() {
    let text = "
fn raised(x: f32) -> f32 { let y = 0.5 * x; return y + 1.0; }
fn twice(x: f32) -> f32 {
    var v = x;
    let a = raised(v);
    if a > 0.0 { v = v + 2.0; }
    let b = raised(v);
    return a * b;
}
";
    let source = Source::parse("twice.wgsl", text).expect("it parses");
    for source in [source.clone(), source.inlined(|_| true)] {
        let value: f32 = source.tape("twice", 0).expect("a value").at(&[4.0], &[]);
        assert_eq!(value, 3.0 * 4.0);
    }
}

#[test]
fn languages_without_vectors_have_their_components() {
    let source = source();
    let rust = source.print(Language::Rust, "sum", &[]).expect("printed");
    let unit = "let unit = [\n        lobe[0] / ";
    assert!(
        rust.contains("pub fn sum(lobe: [f32; 3], albedo: [f32; 3], alpha: f32, f0: f32) -> [f32; 3] {"),
        "{rust}"
    );
    assert!(rust.replace("let unit = [lobe[0] / ", unit).contains(unit), "{rust}");
    assert!(rust.contains("lobe[2] * lobe[2]"), "{rust}");
    let c = source.print(Language::C, "sum", &[]).expect("printed");
    assert!(c.contains("const lobefit_float3 result = {") && c.contains("return result;"), "{c}");
}

#[test]
fn values_and_operations_are_those_of_the_text() {
    let source = source();
    let inputs = [0.6, 0.0, 0.8, 0.5, 0.25, 1.0, 0.25, 0.5];
    let value: f32 = source.tape("sum", 2).expect("a component").at(&inputs, &[]);
    assert_eq!(value, 0.8 + 1.0 * (0.5 * (0.25 + 0.5)));
    // alpha + f0; half; 3 fused products and a first one; root; a reciprocal and 3 products; 3
    // fused; a comparison and 3 choices
    assert_eq!(source.cost_ops(&["sum"]).expect("counted"), 1 + 1 + 3 + 4 + 4 + 3 + 3 + 1 + 3);
}

#[test]
fn what_no_language_can_write_is_refused_with_its_place() {
    for (text, wanted) in [
        ("fn f(x: vec3f) -> f32 { var y = x; y = y * 2.0; return y.x; }", "a vector may not change"),
        ("fn g(x: vec3f) -> vec3f { return x; } fn f(x: vec3f) -> f32 { return g(x).y; }", "named first"),
        (
            "fn g(x: vec3f) -> f32 { return x.x; } fn f(x: vec3f) -> f32 { return g(x * 2.0); }",
            "named before",
        ),
        ("fn f(x: vec3f) -> vec3f { return sqrt(x); }", "only dot and select take vectors"),
    ] {
        let error = Source::parse("f.wgsl", text).expect_err(text).to_string();
        assert!(error.contains(wanted) && error.starts_with("f.wgsl:1:"), "{error}");
    }
}

#[test]
fn long_statements_are_broken_before_the_signs_of_outer_sums() {
    let term = |n: u32| format!("sqrt(first * ({n}.0 + second))");
    let terms: Vec<String> = (1..7).map(term).collect();
    let text = format!("fn f(first: f32, second: f32) -> f32 {{ return {}; }}", terms.join(" + "));
    let printed = Source::parse("f.wgsl", &text).expect("it parses").print(Language::Wgsl, "f", &[]);
    let printed = printed.expect("printed");
    // Two terms fit into a line.
    let later: Vec<&str> = printed.lines().filter(|line| line.starts_with("        ")).collect();
    assert!(later.len() > 1 && later.iter().all(|line| line.starts_with("        + sqrt(")), "{printed}");
}
