//! Comments and names of printed code, and the features of a formula. Tests that see what is private
//! stand beside it: their files are compiled here once more, and the library is not.

use lobefit_shade::code::Language;
use lobefit_shade::{Features, Source};

#[path = "../src/comment.rs"]
mod comment;
#[path = "../src/code/spelling.rs"]
#[allow(dead_code, reason = "what of the file no test calls")]
mod spelling;

#[test]
fn names_are_read_back() {
    for language in Language::ALL {
        assert_eq!(Language::parse(language.name()), Some(language));
    }
    assert_eq!(Language::parse("HLSL"), None);
}

fn features(body: &str) -> Features {
    let code = format!("fn f(x: f32, y: f32) -> f32 {{\n{body}\n}}\n");
    Source::parse("f.wgsl", &code).unwrap().tape("f", 0).unwrap().features()
}

#[test]
fn kinds_of_work_are_counted_as_compilers_see_them() {
    // A multiply-add, a reciprocal, a multiply-add with two literals.
    let found = features("    let r = 1.0 / (x * y + 2.5);\n    return 3.5 + r * 0.7;");
    let wanted = Features {
        multiply_adds: 2.0,
        transcendentals: 1.0,
        literals: 3.0,
        pairs: 1.0,
        chain: 3.0,
        overlap: -1.0,
        ..Features::default()
    };
    assert_eq!(found, wanted);
    // The reciprocal once, a product each; numbers that instructions hold are no literals.
    let found = features("    return max(x / y, 0.5) + y * y / y - 1.0;");
    assert_eq!((found.transcendentals, found.literals, found.pairs), (1.0, 0.0, 0.0));
    assert_eq!(
        (found.products, found.multiply_adds, found.additions, found.comparisons),
        (2.0, 1.0, 1.0, 1.0)
    );
    assert_eq!(found.chain, 5.0);
    // Two transcendental instructions and a product; a constant is one literal.
    let found = features("    return pow(x, 2.0 * 1.7) + (0.1 + 0.2);");
    assert_eq!((found.transcendentals, found.additions, found.literals), (2.0, 1.0, 2.0));
    let nothing = Features { overlap: -1.0, ..Features::default() };
    assert_eq!(features("    return saturate(abs(-x));"), nothing);
    assert_eq!(Features::of(found.all()), found);
    assert_eq!(Features::of([1.0; 9]).price(&found), found.all().iter().sum::<f64>());
    assert_eq!(Features::of([1.0; 9]).price(&nothing), 0.0, "no work costs less than none");
}
