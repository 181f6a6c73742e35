//! The formulas that the product brings, and what those of the coupling are worth at every f0.

use lobefit::effects::coupling::{F0, Peak};
use lobefit::effects::{coupling, reflection, sheen};
use lobefit_shade::Hypothesis;
use lobefit_truth::quantity::Specular;

fn parsed(file: &str, source: &str) -> Hypothesis {
    Hypothesis::parse(file, source).expect("parses")
}

#[test]
fn functions_are_named_like_their_files_and_couplings_like_their_cost() {
    let reflection = reflection::GGX.entries().chain(reflection::BECKMANN.entries());
    let sheen = sheen::HYPOTHESES.iter().chain(&sheen::PUBLISHED);
    for entry in reflection.chain(sheen).chain(coupling::entries()) {
        assert_eq!(parsed(entry.file, entry.source).name(), entry.name());
    }
    for entry in Specular::ALL.into_iter().flat_map(coupling::hypotheses) {
        let ops = parsed(entry.file, entry.source).tape().cost_ops();
        assert!(entry.name().ends_with(&format!("_{ops}")), "{}: {ops}", entry.name());
    }
}

#[test]
fn peaks_of_parabolas_lie_between_their_values_too() {
    let peak = |f: &dyn Fn(f64) -> f64| Peak::of(|k| f(k as f64 / (F0 - 1) as f64));
    let found = peak(&|x| 0.25 - (x - 0.53) * (x - 0.53)).expect("a parabola");
    assert!((found.error - 0.25).abs() < 1e-12 && (found.f0 - 0.53).abs() < 1e-9);
    let found = peak(&|x| 0.1 * x - 0.3).expect("a line");
    assert!(found.f0 == 0.0 && (found.error - 0.3).abs() < 1e-12);
    assert!(peak(&|x| x * x * x).is_none());
}
