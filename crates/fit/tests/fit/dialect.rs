//! What the dialect of hypotheses takes, and what it refuses, where and why.

use crate::fit_support;

use fit_support::parse;
use lobefit_shade::{Hypothesis, Limits, ShadeError};

/// Sources that are WGSL but no hypotheses: source, line, column, excerpt, part of the message.
const REFUSED: [(&str, usize, usize, &str, &str); 26] = [
    ("fn f(x: f32) -> f32 {\n  let v = vec2(x, 1.0);\n  return v.x;\n}", 2, 11, "vec2(x, 1.0)", "vectors"),
    ("fn f(x: f32) -> f32 {\n  return dot(vec3(x), vec3(1.0));\n}", 2, 14, "vec3(x)", "vectors"),
    (
        "fn f(v: vec2<f32>) -> f32 { return v.x; }",
        1,
        1,
        "fn f(v: vec2<f32>) -> f32 { return v.x; }",
        "only f32",
    ),
    (
        "fn f(x: f32) -> vec2<f32> { return vec2(x, x); }",
        1,
        1,
        "fn f(x: f32) -> vec2<f32> { return vec2(x, x); }",
        "only f32",
    ),
    ("fn f(n: i32) -> f32 { return 1.0; }", 1, 1, "fn f(n: i32) -> f32 { return 1.0; }", "only f32"),
    (
        "fn f(x: f32) -> f32 {\n  var s = 0.0;\n  for (var i = 0; i < 3; i++) { s += x; }\n  return s;\n}",
        3,
        12,
        "",
        "only f32",
    ),
    (
        "fn f(x: f32) -> f32 {\n  var s = x;\n  while s < 3.0 { s += 1.0; }\n  return s;\n}",
        3,
        3,
        "while s < 3.0 { s += 1.0; }",
        "loops",
    ),
    ("fn f(x: f32) -> f32 {\n  loop { break; }\n  return x;\n}", 2, 3, "loop { break; }", "loops"),
    ("fn f(x: f32) -> f32 {\n  switch u32(x) { default: { return x; } }\n}", 2, 0, "", "not allowed"),
    ("fn f(x: f32) -> f32 {\n  return tan(x);\n}", 2, 10, "tan(x)", "Tan"),
    ("fn f(x: f32) -> f32 {\n  return atan2(x, 1.0);\n}", 2, 10, "atan2(x, 1.0)", "Atan2"),
    ("fn f(x: f32) -> f32 {\n  return 1.0 + x % 2.0;\n}", 2, 16, "x % 2.0", "operator"),
    ("fn f(x: f32) -> f32 {\n  return dpdx(x);\n}", 2, 10, "dpdx(x)", "derivatives"),
    ("fn f(x: f32) -> f32 {\n  return f32(u32(x));\n}", 2, 10, "", "conversions"),
    ("fn f(x: f32) -> f32 {\n  return bitcast<f32>(bitcast<u32>(x));\n}", 2, 10, "", "conversions"),
    ("fn f(x: f32) -> f32 {\n  return 1.0lf * 2.0lf + x;\n}", 2, 10, "", ""),
    (
        "fn g(p: ptr<function, f32>) -> f32 { return *p; }\nfn f(x: f32) -> f32 { var y = x; return g(&y); }",
        1,
        1,
        "fn g(p: ptr<function, f32>) -> f32 { return *p; }",
        "only f32",
    ),
    (
        "fn f(x: f32) -> f32 {\n  var a = array<f32, 2>(x, x);\n  return a[0];\n}",
        2,
        3,
        "var a = array<f32, 2>(x, x)",
        "only f32",
    ),
    (
        "var<private> g: f32 = 1.0;\nfn f(x: f32) -> f32 { return g * x; }",
        1,
        1,
        "var<private> g: f32 = 1.0;",
        "global variables",
    ),
    ("@fragment fn f() -> @location(0) vec4<f32> { return vec4(1.0); }", 1, 1, "", "entry points"),
    ("override n: i32 = 3;\nfn f(x: f32) -> f32 { return x; }", 1, 1, "override n: i32 = 3;", "only f32"),
    (
        "override b: bool = true;\nfn f(x: f32) -> f32 { return select(x, 1.0, b); }",
        1,
        1,
        "override b: bool = true;",
        "f32",
    ),
    (
        "override a: f32 = 1.0;\noverride b: f32 = a * 2.0;\nfn f(x: f32) -> f32 { return a * b * x; }",
        2,
        1,
        "override b: f32 = a * 2.0;",
        "constant",
    ),
    (
        "override a: f32 = 1.0;\nfn f(x: f32) -> f32 { return x; }",
        1,
        1,
        "override a: f32 = 1.0;",
        "parameter a is not used",
    ),
    (
        "fn g(x: f32) -> f32 { return x; }\nfn f(x: f32) -> f32 { return x; }",
        1,
        1,
        "fn g(x: f32) -> f32 { return x; }",
        "never called",
    ),
    (
        "fn f(x: f32) -> bool { return x > 1.0; }",
        1,
        1,
        "fn f(x: f32) -> bool { return x > 1.0; }",
        "must return an f32",
    ),
];

#[test]
fn what_the_dialect_leaves_out_is_refused_with_its_place() {
    for (source, line, column, excerpt, message) in REFUSED {
        let error = Hypothesis::parse("user.wgsl", source).expect_err(source);
        let text = error.to_string();
        assert!(text.starts_with("user.wgsl:"), "{text}");
        assert!(text.contains(message), "{source}\n{text}");
        let (ShadeError::Dialect { place, .. } | ShadeError::Syntax { place, .. }) = error else {
            panic!("{source}: {error:?}")
        };
        if !excerpt.is_empty() {
            assert_eq!((place.line, place.column, place.excerpt.as_str()), (line, column, excerpt), "{text}");
        }
    }
}

/// Sources that are no WGSL: source, line, column, part of the message.
const NOT_WGSL: [(&str, usize, usize, &str); 10] = [
    ("", 1, 1, "needs a function"),
    ("fn f(x: f32) -> f32 { return y; }", 1, 30, "no definition in scope for identifier: `y`"),
    ("fn f(x: f32) -> f32 {\n  return x * ;\n}", 2, 14, "expected expression"),
    ("fn f(x: f32) -> f32 { let y = x; }", 1, 1, ""),
    ("fn f(x: f32) -> f32 { return true; }", 1, 1, ""),
    ("fn f(x: f32) -> f32 { return f(x); }", 1, 4, "recursive"),
    ("fn f(x: f32) { let y = x; }", 1, 1, "must return a value"),
    ("fn ä(x: f32) -> f32 { return ö; }", 1, 30, "no definition"),
    (
        "override a: f32 = 1.0; override a: f32 = 2.0; fn f(x: f32) -> f32 { return a; }",
        1,
        33,
        "redefinition",
    ),
    ("fn f(x: f32) -> f32 { return 1e40 * x; }", 1, 30, ""),
];

#[test]
fn what_is_not_wgsl_is_refused_with_its_place() {
    for (source, line, column, message) in NOT_WGSL {
        let error = Hypothesis::parse("user.wgsl", source).expect_err(source);
        let text = error.to_string();
        assert!(text.contains(message), "{source}\n{text}");
        assert!(!text.contains("(see msg)") && !text.contains(" ()"), "{source}\n{text}");
        let (ShadeError::Dialect { place, .. } | ShadeError::Syntax { place, .. }) = error else {
            panic!("{source}: {error:?}")
        };
        assert_eq!((place.line, place.column), (line, column), "{text}");
    }
}

#[test]
fn sizes_are_limited() {
    let kind = |source: &str| match Hypothesis::parse("big.wgsl", source) {
        Err(ShadeError::TooLarge { what, limit, found, .. }) => {
            assert!(found > limit);
            what
        }
        other => panic!("{other:?}"),
    };
    let body = "fn f(x: f32) -> f32 { return x; }";
    assert_eq!(kind(&format!("{}{body}", "// comment\n".repeat(6000))), "bytes of source");
    let overrides = |n: usize| {
        let declared: String = (0..n).map(|i| format!("override p{i}: f32;\n")).collect();
        let sum: Vec<String> = (0..n).map(|i| format!("p{i}")).collect();
        format!("{declared}fn f(x: f32) -> f32 {{ return x * ({}); }}", sum.join(" + "))
    };
    assert_eq!(kind(&overrides(Limits::PARAMETERS + 1)), "free parameters (override)");
    assert_eq!(parse(&overrides(Limits::PARAMETERS)).parameters().len(), Limits::PARAMETERS);
    let long = format!("fn f(x: f32) -> f32 {{ return x{}; }}", " + x".repeat(Limits::STATEMENT + 1));
    for before in ["", "/* a */", "/* /* a */ b */"] {
        assert_eq!(kind(&format!("{before}{long}")), "operators and brackets in one statement");
    }
    // Nearly as long as allowed: the parser's recursion has the stack for it.
    parse(&format!("fn f(x: f32) -> f32 {{ return x{}; }}", " + x * x".repeat(Limits::STATEMENT / 2 - 16)));
    // 2^40 calls, all different: refused for what it would be, not tried.
    let mut doubling = String::from("fn g0(x: f32) -> f32 { return x + 1.5; }\n");
    for i in 1..40 {
        let below = i - 1;
        doubling += &format!("fn g{i}(x: f32) -> f32 {{ return g{below}(x * 1.5) + g{below}(x + 0.5); }}\n");
    }
    assert_eq!(kind(&doubling), "operations");
    // 2^40 equal calls are one.
    parse(&doubling.replace("x * 1.5", "x").replace("x + 0.5", "x"));
    let nested = format!(
        "fn f(x: f32) -> f32 {{ {} return x; {} }}",
        "if x > 1.0 {".repeat(70),
        "} return x;".repeat(70)
    );
    assert!(Hypothesis::parse("deep.wgsl", &nested).unwrap_err().to_string().contains("nest deeper"));
}

#[test]
fn names_starts_and_documentation_are_kept() {
    let hypothesis = parse(
        "override amount: f32 = -2.5;\noverride free: f32;\nconst HALF = 0.5;\noverride half: f32 = HALF;\n\n\
         /// What it is.\n/// Where it holds.\n\
         fn fancy(roughness: f32, mu: f32) -> f32 { return amount * roughness + free * half; }",
    );
    assert_eq!(hypothesis.name(), "fancy");
    assert_eq!(hypothesis.inputs(), ["roughness", "mu"]);
    assert_eq!(hypothesis.doc(), ["What it is.", "Where it holds."]);
    let parameters: Vec<(&str, f32)> =
        hypothesis.parameters().iter().map(|p| (p.name.as_str(), p.start)).collect();
    assert_eq!(parameters, [("amount", -2.5), ("free", 1.0), ("half", 0.5)]);
}

#[test]
fn damaged_sources_are_refused_without_a_panic() {
    let source = std::fs::read_to_string(fit_support::folder().join("ggx_norm_r6.wgsl")).unwrap();
    let characters: Vec<char> = source.chars().collect();
    let mut state = 1u64;
    let mut random = |n: usize| {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 33) as usize % n
    };
    let mut refused = 0;
    for _ in 0..300 {
        let mut damaged = characters.clone();
        for _ in 0..1 + random(3) {
            let at = random(damaged.len());
            match random(3) {
                0 => {
                    damaged.remove(at);
                }
                1 => damaged.insert(at, ['(', ')', '{', '}', ';', '*', 'x', '0', '/', 'é'][random(10)]),
                _ => {
                    let other = random(damaged.len());
                    damaged.swap(at, other);
                }
            }
        }
        let text: String = damaged.into_iter().collect();
        match Hypothesis::parse("damaged.wgsl", &text) {
            Ok(_) => {}
            Err(ShadeError::Syntax { message, .. }) if message.contains("front end failed") => {
                panic!("the front end failed on\n{text}")
            }
            Err(_) => refused += 1,
        }
    }
    assert!(refused > 100, "{refused}");
}
