//! Poles are found, and their absence is proven.

use crate::fit_support;

use fit_support::parse;

use lobefit_shade::{Domain, RangeProof, ShadeError, prove_range, prove_regular};

fn domain() -> Domain {
    Domain::new(&[("roughness", 0.02, 1.0), ("mu", 0.0, 1.0)])
        .and_then(|d| d.with_derived("alpha", "roughness", 2))
        .unwrap()
}

fn prove(body: &str) -> Result<(), ShadeError> {
    let hypothesis =
        parse(&format!("fn f(roughness: f32, alpha: f32, mu: f32) -> f32 {{\n    return {body};\n}}"));
    prove_regular(hypothesis.tape(), &[], &domain())
}

#[test]
fn regular_formulas_are_proven() {
    for body in [
        "1.0",
        "1.0 / roughness",
        "1.0 / (alpha + mu)",
        "sqrt(1.0 - mu * mu)",
        "sqrt((1.0 - mu) * (1.0 + mu)) / alpha",
        "sqrt(1.0 - mu)",
        "log(roughness) + log2(alpha + mu)",
        "pow(mu, 2.5) + pow(roughness, mu / roughness) + pow(1.0 - 2.0 * mu, 5.0)",
        // (alpha - mu)^2 + alpha mu: positive, but its parts cancel
        "mu / (alpha * alpha + mu * (mu - alpha) + 1e-6)",
        "select(1.0, 1.0 / mu, mu > 0.01)",
        "1.0 / max(mu, 1e-3)",
        "1.0 / (1.0 - saturate(mu * 0.5))",
        "1.0 / (roughness * roughness - alpha + 1e-4)",
        "inverseSqrt(alpha)",
    ] {
        prove(body).unwrap_or_else(|e| panic!("{body}: {e}"));
    }
}

/// A formula, the part at fault, what happens, and bounds on where: (roughness, mu).
#[test]
fn poles_are_found_and_placed() {
    for (body, part, hazard) in [
        ("1.0 / mu", "1.0 / mu", "divide by zero"),
        ("1.0 + alpha / (mu - 0.5)", "alpha / (mu - 0.5)", "divide by zero"),
        ("1.0 / (alpha - mu)", "1.0 / (alpha - mu)", "divide by zero"),
        ("1.0 / (1.0 - saturate(mu * 2.0))", "1.0 / (1.0 - saturate(mu * 2.0))", "divide by zero"),
        ("1.0 / (mu * mu - mu + 0.25)", "1.0 / (mu * mu - mu + 0.25)", "divide by zero"),
        ("sqrt(mu - 0.001)", "sqrt(mu - 0.001)", "square root of a negative"),
        ("log(mu)", "log(mu)", "logarithm"),
        ("log2(alpha - 0.9)", "log2(alpha - 0.9)", "logarithm"),
        ("pow(mu - 0.5, roughness)", "pow(mu - 0.5, roughness)", "negative number to a power"),
        ("pow(mu, roughness - 0.5)", "pow(mu, roughness - 0.5)", "zero to a power"),
        ("inverseSqrt(mu)", "inverseSqrt(mu)", "inverse square root"),
        ("exp(500.0 * mu)", "exp(500.0 * mu)", "overflow"),
        ("select(0.0, 1.0 / (mu - 0.5), mu > 0.2)", "1.0 / (mu - 0.5)", "divide by zero"),
    ] {
        let error = prove(body).expect_err(body);
        let ShadeError::Irregular { place, function, at, .. } = &error else { panic!("{error}") };
        assert_eq!((place.line, place.excerpt.as_str(), function.as_str()), (2, part, "f"), "{body}");
        assert!(at.contains("mu = "), "{at}");
        assert!(error.to_string().contains(hazard), "{error}");
    }
    let text = prove("1.0 / (mu - 0.5)").unwrap_err().to_string();
    assert!(text.starts_with("test.wgsl:2:12: `1.0 / (mu - 0.5)`: f may divide by zero near "), "{text}");
    assert!(text.contains("mu = 0.5"), "{text}");
}

#[test]
fn parameters_decide() {
    let hypothesis = parse("override c: f32; fn f(mu: f32) -> f32 { return 1.0 / (1.0 + c * mu); }");
    let domain = Domain::new(&[("mu", 0.0, 1.0)]).unwrap();
    prove_regular(hypothesis.tape(), &[-0.999], &domain).unwrap();
    prove_regular(hypothesis.tape(), &[-1.001], &domain).unwrap_err();
    prove_regular(hypothesis.tape(), &[], &domain).unwrap_err();
}

#[test]
fn domains_are_checked() {
    assert!(Domain::new(&[("mu", 1.0, 0.0)]).is_err());
    assert!(Domain::new(&[("mu", f64::NAN, 0.0)]).is_err());
    assert!(Domain::new(&[("mu", 0.0, 1.0), ("mu", 0.0, 1.0)]).is_err());
    let axis = || Domain::new(&[("roughness", 0.25, 0.5)]).unwrap();
    assert!(axis().with_derived("alpha", "rough", 2).is_err());
    assert!(axis().with_derived("alpha", "roughness", 3).is_err());
    assert!(axis().with_derived("roughness", "roughness", 2).is_err());
    assert!(Domain::new(&[("x", -1.0, 1.0)]).unwrap().with_derived("y", "x", 2).is_err());
    let domain = axis().with_derived("alpha", "roughness", 4).unwrap();
    assert_eq!(domain.bounds()["alpha"], [0.00390625, 0.0625]);
    let names = ["alpha".to_string(), "roughness".to_string()];
    let columns = domain.columns("f", &names, &[vec![0.3, 0.4]]).unwrap();
    assert_eq!(columns[0], [(0.3 * 0.3) * (0.3 * 0.3), (0.4 * 0.4) * (0.4 * 0.4)]);
    let missing = domain.columns("f", &["mu".to_string()], &[vec![0.3]]).unwrap_err();
    assert_eq!(missing.to_string(), "f: input mu is not one of roughness, alpha");
}

#[test]
fn ranges_are_proven_refuted_or_left_open() {
    let range = |body: &str, lo: f64, hi: f64| {
        let h = parse(&format!("fn f(roughness: f32, alpha: f32, mu: f32) -> f32 {{ return {body}; }}"));
        prove_range(h.tape(), &[], &domain(), lo, hi).unwrap()
    };
    // x - x^2 <= 1/4: naive intervals give [-1, 1], the subdivision does better.
    assert_eq!(range("mu - mu * mu", -1e-6, 0.2501), RangeProof::Proven);
    assert_eq!(range("1.0 + alpha * mu / (alpha + mu)", 0.999, 2.0), RangeProof::Proven);
    assert_eq!(range("saturate(3.0 * mu - 1.0)", 0.0, 1.0), RangeProof::Proven);
    assert_eq!(range("exp(mu)", 0.0, f64::INFINITY), RangeProof::Proven);
    let RangeProof::Violated { at, value } = range("mu - mu * mu", -1e-6, 0.2) else { panic!() };
    assert!(value > 0.2 && at.contains("mu = 0.5"), "{at} {value}");
    // It touches 1/4 from below: rounding decides, and intervals are wider than that.
    let RangeProof::Open { at } = range("mu - mu * mu", -1.0, 0.25) else { panic!() };
    assert!(at.contains("mu = 0.") && at.contains(".."), "{at}");
    let h = parse("fn f(mu: f32) -> f32 { return mu; }");
    let error = prove_range(h.tape(), &[], &domain(), 1.0, 0.0).unwrap_err();
    assert_eq!(error.to_string(), "domain: input value of f: 1 .. 0 is not a range of values");
    assert!(prove_range(h.tape(), &[1.0], &domain(), 0.0, 1.0).is_err());
}
