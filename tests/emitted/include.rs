//! Include files read back: constants, calls; and figures of their comments.

use lobefit::data::Place;
use lobefit::emit::header::{place, short};
use lobefit::emit::include::{Include, call};

#[test]
fn a_constant_of_a_line_ends_there() {
    let include =
        Include::new("const A: f32 = 1.0;\nalias B = f32;\nfn f() -> f32 {\n    return A;\n}\n".into());
    assert_eq!(include.code("A").as_deref(), Some("const A: f32 = 1.0;\n"));
}

#[test]
fn a_call_has_the_declared_arguments() {
    let wgsl = "// f(\nfn f(\n    table: texture_2d<f32>,\n    f0: vec3<f32>,\n) -> vec3<f32> {\n    return f(1);\n}\n";
    let line = |text: &str| call(text, "f").map(|called| called.call);
    assert_eq!(line(wgsl).as_deref(), Some("let value = f(table, f0);"));
    let parameters = call(wgsl, "f").map(|called| called.parameters);
    assert_eq!(parameters.as_deref(), Some("table: texture_2d<f32>, f0: vec3<f32>"));
    let rust = "pub fn f(texels: &[[f32; 2]], mu: f32) -> [f32; 3] {";
    assert_eq!(line(rust).as_deref(), Some("let value = f(texels, mu);"));
    let c = "static inline lobefit_float3 f(const float *texels, float mu) {";
    let expected = "lobefit_float3 value = f(texels, mu);";
    assert_eq!(line(c).as_deref(), Some(expected));
    assert_eq!(call("    float x = f(1.0);", "f"), None);
}

#[test]
fn figures_are_short_and_places_are_ordered() {
    assert_eq!(short(0.00123456), "0.001235");
    assert_eq!(short(-2.5e-9), "-0.0000000025");
    let at: Place = [("mu".to_string(), 0.5), ("alpha".to_string(), 0.25)].into_iter().collect();
    assert_eq!(place(&at), "alpha = 0.25, mu = 0.5");
}
