//! Prices of kinds of work, and how well they put functions in order.

use lobefit::data::Vendor;
use lobefit_math::correlation::Correlation;
use lobefit_shade::Source;

#[test]
fn order_and_proportion_differ() {
    let of = |pairs: &[(f64, f64)]| Correlation::of(pairs).map(|c| (c.values, c.ranks));
    let close = |(a, b): (f64, f64), (c, d): (f64, f64)| (a - c).abs() + (b - d).abs() < 1e-12;
    assert!(close(of(&[(1.0, 2.0), (2.0, 4.0), (3.0, 6.0)]).unwrap(), (1.0, 1.0)));
    let (values, ranks) = of(&[(1.0, 1.0), (2.0, 2.0), (3.0, 100.0)]).unwrap();
    assert!(values < 0.9 && (ranks - 1.0).abs() < 1e-12);
    // Ranks 0, 1.5, 1.5, 3 against 3, 2, 1, 0: -4.5 / sqrt(4.5 x 5).
    let (_, ranks) = of(&[(1.0, 9.0), (2.0, 8.0), (2.0, 7.0), (4.0, 6.0)]).unwrap();
    assert!((ranks + 4.5 / 22.5_f64.sqrt()).abs() < 1e-12);
    assert_eq!(of(&[(1.0, 1.0), (2.0, 2.0)]), None);
    assert_eq!(of(&[(1.0, 1.0), (2.0, 1.0), (3.0, 1.0)]), None);
}

#[test]
fn models_know_chains_where_they_cost_and_moves_of_literals() {
    let tape = |body: &str| {
        let code = format!("fn f(x: f32, y: f32) -> f32 {{\n    return {body};\n}}\n");
        Source::parse("f.wgsl", &code).unwrap().tape("f", 0).unwrap()
    };
    // As many multiply-adds, in a chain of five and in one of three.
    let chain = tape("((((x * y + 0.3) * y + 0.7) * y + 0.1) * y + 0.2) * y + x * 0.9");
    let tree = tape("((x * y + 0.3) * (y * 0.7 + x) + 0.1) * (x * y + 0.2) + x * 0.9");
    assert_eq!(chain.cost_ops(), tree.cost_ops());
    for vendor in [Vendor::Intel, Vendor::Adreno] {
        let model = vendor.model().unwrap();
        assert!(model.cost(&chain) > model.cost(&tree) + 1.0, "{}", vendor.word());
    }
    // Two literals in a multiply-add are a move on NVIDIA GPUs.
    let [one, two] = ["x * y + 0.3", "x * 0.7 + 0.3"].map(tape);
    let model = Vendor::Nvidia.model().unwrap();
    assert!(model.cost(&two) > model.cost(&one) + 0.5);
    assert_eq!(one.cost_ops(), two.cost_ops());
    for vendor in Vendor::ALL {
        let model = vendor.model().unwrap();
        assert!(model.cost(&tape("x / y")) > model.cost(&tape("x * y")), "{}", vendor.word());
        assert!(model.agreement.pearson >= model.operations.pearson && model.left_out.pearson > 0.95);
    }
}
