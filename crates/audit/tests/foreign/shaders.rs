//! Shader functions of WGSL and GLSL, run point by point against plain Rust; what is not read.

use lobefit_audit::foreign::{ForeignError, ShaderFunction, Surroundings};

/// The functions of a source of which nothing else is known.
pub fn read_functions(
    bytes: &[u8],
    file: &str,
    entry: Option<&str>,
) -> Result<Vec<ShaderFunction>, ForeignError> {
    lobefit_audit::foreign::read_functions(bytes, file, entry, &Surroundings::default())
}

pub fn functions(source: &str, file: &str, entry: Option<&str>) -> Vec<ShaderFunction> {
    read_functions(source.as_bytes(), file, entry).unwrap_or_else(|e| panic!("{e}\n{source}"))
}

pub fn one(source: &str, file: &str, entry: &str) -> ShaderFunction {
    let mut found = functions(source, file, Some(entry));
    assert_eq!(found.len(), 1);
    found.remove(0)
}

fn refused(source: &str, file: &str) -> String {
    read_functions(source.as_bytes(), file, None).expect_err(source).to_string()
}

/// 41 x 41 points of [0, 1]^2.
pub fn points() -> impl Iterator<Item = [f32; 2]> {
    (0..41).flat_map(|i| (0..41).map(move |k| [i as f32 / 40.0, k as f32 / 40.0]))
}

/// The function has the bits of plain f32 arithmetic in the same order at every point, and is
/// finite there.
pub fn assert_bits<const N: usize>(function: &ShaderFunction, formula: impl Fn(f32, f32) -> [f32; N]) {
    assert_eq!(function.results.len(), N, "{}", function.name);
    for [a, b] in points() {
        for (k, (found, expected)) in at(function, &[a, b]).into_iter().zip(formula(a, b)).enumerate() {
            assert!(
                found.is_finite() && found.to_bits() == expected.to_bits(),
                "{} {k} at {a} {b}: {found} {expected}",
                function.name
            );
        }
    }
}

/// Its results at a point.
pub fn at(function: &ShaderFunction, inputs: &[f32]) -> Vec<f32> {
    function.at(inputs).expect("it is run")
}

#[test]
fn control_flow_of_wgsl() {
    let source = "
        fn f(x: f32, y: f32) -> f32 {
            var sum = 0.0;
            var i = 0u;
            loop {
                if i == 2u { i += 1u; continue; }
                if i >= 5u { break; }
                sum += x * f32(i);
                continuing { i++; }
            }
            while i < 8u { i += 1u; sum -= y; }
            switch i { case 8u, 9u: { sum *= 2.0; } default: { sum = 0.0; } }
            if x > 0.5 && !(y <= 0.25 || x == 0.75) { if y > 0.5 { return -sum; } sum += 1.0; }
            return select(sum, mix(sum, x, y), y < 0.1);
        }";
    let function = one(source, "f.wgsl", "f");
    assert_bits(&function, |x, y| {
        // i is 3 after the step over 2: the continuing block adds one more.
        let mut sum = 0.0 + x * 0.0 + x * 1.0 + x * 4.0;
        for _ in 5..8 {
            sum -= y;
        }
        sum *= 2.0;
        if x > 0.5 && !(y <= 0.25 || x == 0.75) {
            if y > 0.5 {
                return [-sum];
            }
            sum += 1.0;
        }
        [if y < 0.1 { sum * (1.0 - y) + x * y } else { sum }]
    });
}

#[test]
fn what_is_not_read_is_named_with_its_place() {
    let cases = [
        ("f.wgsl", "fn f(x: f32) -> f32 {\n  return sinh(x);\n}", "2:10", "Sinh"),
        (
            "f.wgsl",
            "fn f(x: f32) -> f32 {\n  var s = 0.0;\n  for (var i = 0; i >= 0; i += 0) { s += x; }\n  return s;\n}",
            "",
            "the limit is",
        ),
        (
            "f.wgsl",
            "fn f(m: mat2x2<f32>) -> f32 {\n  return m[0][0];\n}",
            "1:1",
            "argument or result of this type",
        ),
        (
            "f.wgsl",
            "@group(0) @binding(0) var<uniform> u: f32;\nfn f(x: f32) -> f32 {\n  return u * x;\n}",
            "3:10",
            "global variable u",
        ),
        (
            "f.glsl",
            "uniform vec3 tint;\nfloat f(float x) {\n  return tint.x * x;\n}",
            "3:10",
            "`f` reads the uniform `tint`, which is not read: make it an argument",
        ),
        ("f.wgsl", "fn f(x: f32) -> f32 {\n  return x + ;\n}", "2:14", "no valid WGSL"),
        ("f.wgsl", "fn f(x: f32) -> f32 {\n  return x * vec2(1.0);\n}", "", "no valid shader"),
        ("f.wgsl", "const a = 1.0;", "", "no function"),
        ("f.wgsl", "", "", "empty"),
        (
            "f.glsl",
            "float f(float x) {\n  float y;\n  if (x > 0.5) y = 1.0;\n  return y * x;\n}",
            "4:10",
            "not set on every path",
        ),
        ("f.glsl", "float f(float x) {\n  return nowhere(x);\n}", "2:10", "nowhere"),
        ("f.glsl", "void f(float x) { }", "1:", "returns nothing"),
        ("f.glsl", "float f(float x) {\n  return dFdx(x);\n}", "f.glsl: 1:15", "a derivative"),
        ("f.glsl", "float f(float x) { return x }", "1:29", "no GLSL"),
    ];
    for (file, source, place, part) in cases {
        let message = refused(source, file);
        assert!(message.starts_with(file) && message.contains(part), "{source}\n{message}");
        assert!(message.contains(place), "{source}\n{message}");
    }
    let deep = format!("float f(float x) {{ return {}x{}; }}", "(".repeat(3000), ")".repeat(3000));
    assert!(refused(&deep, "f.glsl").contains("the limit is 1024"));
    // naga's WGSL front end has a limit of its own, 256.
    let cases = [("f.glsl", "float f(float x)", 1000), ("f.wgsl", "fn f(x: f32) -> f32", 100)];
    for (file, head, depth) in cases {
        let (open, close) = ("max(x, ".repeat(depth), ")".repeat(depth));
        assert_eq!(functions(&format!("{head} {{ return {open}x{close}; }}"), file, None).len(), 1);
    }
    let beside =
        format!("fn f(x: f32) -> f32 {{ return {}x{}; }}", "max(x, ".repeat(90_000), ")".repeat(90_000));
    assert!(refused(&beside, "f.wgsl").contains("the limit is 1024"));
    let names = read_functions(b"fn f(x: f32) -> f32 { return x; }", "f.wgsl", Some("g"));
    assert!(names.unwrap_err().to_string().contains("function g is not there; the file has f"));
    assert_eq!(one("float f(float x) { return x; }", "f.txt", "f").inputs, ["x"]);
}

#[test]
fn nested_arrays_are_bounded_as_a_whole() {
    let declared = [
        "var a: array<array<f32, 11000>, 11000>;",
        "var a: array<array<array<S, 40>, 40>, 40>;",
        "var a: T;",
    ];
    for variable in declared {
        let types =
            "struct S { x: f32, y: vec4<f32> }\nstruct T { a: array<S, 20000>, b: array<S, 20000> }\n";
        let text = format!("{types}fn f(x: f32, y: f32) -> f32 {{ {variable} return x + y; }}");
        let message = refused(&text, "t.wgsl");
        assert!(message.contains("entries of a"), "{variable}: {message}");
    }
}

#[test]
fn loops_indices_and_returns_may_depend_on_the_inputs() {
    let source = "
        fn halve(x: f32, y: ptr<function, f32>) { if x > 0.5 { return; } *y *= 0.5; }
        fn f(x: f32, y: f32) -> f32 {
            let t = array<f32, 3>(1.0, 2.0, 4.0);
            var s = x;
            while s < 3.0 { s += 1.0; if s > 2.5 + y { break; } }
            halve(y, &s);
            return s * t[u32(2.0 * x)];
        }";
    assert_bits(&one(source, "t.wgsl", "f"), |x, y| {
        let mut s = x;
        while s < 3.0 {
            s += 1.0;
            if s > 2.5 + y {
                break;
            }
        }
        [if y > 0.5 { s } else { 0.5 * s } * [1.0, 2.0, 4.0][(2.0 * x) as usize]]
    });
    let beyond = one(&source.replace("2.0 * x)", "3.5 * x)"), "t.wgsl", "f").at(&[1.0, 0.0]);
    assert!(beyond.expect_err("beyond").to_string().contains("index 3, beyond the end"));
}

#[test]
fn a_branch_on_what_is_not_a_number_has_no_value() {
    let function = one("float f(float x) { return sqrt(-x) > 0.5 ? 1.0 : 2.0; }", "t.glsl", "f");
    assert!(at(&function, &[0.5])[0].is_nan());
    let function = one("float f(float x) { if (sqrt(-x) > 0.5) { return 1.0; } return 2.0; }", "t.glsl", "f");
    assert!(at(&function, &[0.5])[0].is_nan() && at(&function, &[0.0])[0] == 2.0);
}

#[test]
fn a_main_in_a_comment_is_none() {
    let text = "// see main (below)\nfloat f(float a, float b) { return a + b; }";
    assert_bits(&one(text, "t.glsl", "f"), |a, b| [a + b]);
}

#[test]
fn glsl_with_samplers_is_read_without_them() {
    let source = "#version 330\nprecision highp float;\nprecision highp sampler2D;\nuniform sampler2D lut;\nlayout(binding = 1) uniform sampler3D cube;
        vec2 fetch(vec2 uv) { return texture(lut, uv).xy; }
        #define SCALE 2.0
        float through(float x) {
        #ifdef DEBUG
            return 0.0;
        #endif
            return fetch(vec2(x)).x;
        }
        float lookup(sampler2D table, float x) { return textureLod(table, vec2(x), 0.0).x; }
        float plain(float x, float y) { return SCALE * x + y; }
        float bent(float x, float y) { return x.nonsense; }";
    let function = one(source, "a.glsl", "plain");
    assert_bits(&function, |x, y| [2.0 * x + y]);
    // What is asked for is read with what it needs, all else is left alone; where all are asked for,
    // those that cannot be read are named.
    assert!(function.left_out.is_empty());
    let left_out = functions(source, "a.glsl", None)[0].left_out.clone();
    let names: Vec<&str> = left_out.iter().map(|one| one.name.as_str()).collect();
    assert_eq!(names, ["fetch", "through", "lookup", "bent"]);
    for one in &left_out {
        let (line, why) = one.reason.split_once(": ").expect("a place, and why");
        assert!(line.contains(':') && !why.is_empty() && !why.contains(';'), "{one:?}");
    }
    // Of overloads that are asked for too.
    let overloads = "struct M { sampler2D t; float r; };\nfloat f(M m, float x) { return texture(m.t, vec2(x)).x; }\n\
                     float f(float x, float y) { return x + y; }";
    let left_out = &one(overloads, "a.glsl", "f").left_out;
    assert!(left_out.len() == 1 && left_out[0].name.starts_with("f(M"), "{left_out:?}");
    let asked = |name: &str| read_functions(source.as_bytes(), "a.glsl", Some(name)).unwrap_err().to_string();
    for name in ["fetch", "lookup"] {
        let message = asked(name);
        assert!(message.contains("texture") && message.starts_with("a.glsl: "), "{name}: {message}");
    }
    assert!(asked("bent").starts_with("a.glsl: 16:"), "{}", asked("bent"));
    assert_eq!(functions(source, "a.glsl", None).len(), 1);
    // What is asked for may be called through: that it reads a texture is said, and where.
    assert!(asked("through").contains("texture"), "{}", asked("through"));
}

#[test]
fn what_glsl_would_not_evaluate_is_refused() {
    let source = |right: &str| {
        format!(
            "float count;\nbool set(float x, out float y) {{ y = 2.0 * x; return x > 0.5; }}\nbool tick(float x) {{ count += x; return x > 0.5; }}
             bool pure(float x) {{ return x > 0.5; }}\nfloat f(float a, float b) {{ float y = a; int k = 1; if (a > b && {right}) {{ y += 1.0; }} return y; }}"
        )
    };
    let read = |right: &str| read_functions(source(right).as_bytes(), "e.glsl", Some("f"));
    for (right, named) in [
        ("set(b, y)", "set"),
        ("(tick(b) || b < 0.1)", "tick"),
        ("(y = b) > 0.2", "assignment"),
        ("(k <<= 1) > 2", "assignment"),
        ("(k >>= 1) < 2", "assignment"),
        ("(k |= 1) > 2", "assignment"),
    ] {
        let error = read(right).unwrap_err().to_string();
        assert!(error.contains(named) && error.contains("&&") && error.contains("5:"), "{right}: {error}");
    }
    assert!(read("pure(b)").is_ok() && read("(b <= 0.5 || b >= 0.9 || b == 1.0)").is_ok());
}

/// Whole numbers and truth values beside the numbers of a result are left out of it.
#[test]
fn whole_numbers_of_a_result_are_none_of_it() {
    let glsl = "struct Found { int first; vec2 ab; ivec2 index; float e; bool is_rough; };
        Found f(float x, float y) { return Found(3, vec2(x, y), ivec2(1, 2), x * y, x > y); }
        void g(float x, out int k, out float z) { k = 1; z = 2.0 * x; }
        int h(float x) { return int(x); }";
    let function = one(glsl, "r.glsl", "f");
    assert_eq!(function.results, ["ab.x", "ab.y", "e"]);
    assert_bits(&function, |x, y| [x, y, x * y]);
    let written = one(glsl, "r.glsl", "g");
    assert_eq!((at(&written, &[0.25]), written.results.len()), (vec![0.5], 1));
    let whole = read_functions(glsl.as_bytes(), "r.glsl", Some("h")).expect_err("no f32").to_string();
    assert!(whole.contains("a result of h that is no f32"), "{whole}");
}

#[test]
fn depth_is_bounded_and_length_is_not() {
    let read = |body: &str| {
        let source = format!("float f(float x) {{ {body}; }}");
        read_functions(source.as_bytes(), "d.glsl", Some("f")).map(drop).map_err(|e| e.to_string())
    };
    let chain = |n: usize| "if (x > 0.5) { return 1.0; } else ".repeat(n) + "return x";
    for long in [
        format!("return {}", vec!["vec2(x, -2.0).y"; 100].join(" + ")),
        format!("float a[5000] = float[5000]({}); return a[1]", vec!["-x"; 5000].join(", ")),
        "x = -x; ".repeat(2000) + "return x",
        format!("/* {} */ return x; // {}\n", "(-".repeat(2000), "(-".repeat(2000)),
        chain(200),
    ] {
        assert_eq!(read(&long), Ok(()), "{long:.40}");
    }
    for deep in [
        format!("return {}x{}", "(".repeat(2000), ")".repeat(2000)),
        format!("return {}x", "-".repeat(2000)),
        format!("return x{}", ".x".repeat(2000)),
        format!("return x{}", "[0]".repeat(2000)),
        format!("return {}x{}", "max(x, ".repeat(2000), ")".repeat(2000)),
        chain(2000),
    ] {
        assert!(read(&deep).unwrap_err().contains("operators and brackets around a term"), "{deep:.20}");
    }
}
