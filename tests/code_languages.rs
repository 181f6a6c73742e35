//! Printed functions in the languages of C's family: compilers take them without a word, and where they run they return the
//! tape's bits.

mod code_support;
mod emit_support;
mod fit_support;

use code_support::{INPUTS, POINTS, all, points, starts, values};
use emit_support::compilers::{Contraction, Target, glslang, includes_in_cpp, loops, run};
use emit_support::say;
use lobefit::emit::code::{Language, Printed, print};
use lobefit::fit::Hypothesis;

fn printed(language: Language, hypothesis: &Hypothesis) -> Printed {
    let header = [format!("The function {}.", hypothesis.name())];
    print(language, hypothesis, &starts(hypothesis), &header).unwrap()
}

/// A file of them all.
fn file(language: Language, hypotheses: &[Hypothesis]) -> String {
    let functions: Vec<String> = hypotheses.iter().map(|h| printed(language, h).text).collect();
    format!("{} All.\n{}{}", language.comment(), language.opening(), functions.join("\n"))
}

/// Calls every function at every point.
fn program(hypotheses: &[Hypothesis]) -> String {
    let call = |hypothesis: &Hypothesis| {
        let arguments: Vec<String> = (0..hypothesis.inputs().len()).map(|k| format!("p[{k}]")).collect();
        format!("        put({}({}));\n", hypothesis.name(), arguments.join(", "))
    };
    loops(INPUTS, &hypotheses.iter().map(call).collect::<Vec<_>>())
}

/// Units in the last place of the expected value, and no less than those of 1: sums that cancel keep the errors of their terms.
fn ulps(expected: f32, found: f32) -> f64 {
    let unit = f64::from(expected.abs().max(1.0)) * f64::from(f32::EPSILON);
    (f64::from(expected) - f64::from(found)).abs() / unit
}

/// Runs all functions of a language; the largest difference of those whose bits are not promised.
fn compare(language: Language, contraction: Contraction, limit: f64) -> Option<()> {
    let hypotheses = all();
    let found = run(language, &file(language, &hypotheses), &program(&hypotheses), &points(), contraction)?;
    assert_eq!(found.len(), hypotheses.len() * POINTS);
    let mut worst = (0.0, String::new());
    for (hypothesis, found) in hypotheses.iter().zip(found.chunks_exact(POINTS)) {
        let exact = printed(language, hypothesis).exact && contraction == Contraction::Off;
        for (i, (a, b)) in values(hypothesis).into_iter().zip(found).enumerate() {
            let same = a.to_bits() == b.to_bits() || (!exact && ulps(a, *b) <= limit);
            let text = || printed(language, hypothesis).text;
            assert!(same, "{}, point {i}: {a:?} and {b:?}\n{}", hypothesis.name(), text());
            if ulps(a, *b) > worst.0 {
                worst = (ulps(a, *b), hypothesis.name().to_string());
            }
        }
    }
    let (count, name) = (hypotheses.len(), language.title());
    say(&format!("{name}: {count} functions, {POINTS} points each; worst {:.2} ulp, {}", worst.0, worst.1));
    Some(())
}

#[test]
fn c_returns_the_bits_of_the_tape() {
    compare(Language::C, Contraction::Off, 4.0);
}

#[test]
fn c_is_included_from_cpp() {
    includes_in_cpp(&file(Language::C, &all()));
}

#[test]
fn shaders_read_as_cpp_return_the_bits_of_the_tape() {
    for language in [Language::Hlsl, Language::Glsl, Language::Msl] {
        compare(language, Contraction::Off, 4.0);
    }
}
