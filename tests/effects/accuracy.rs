//! What a plan and a page say of the integrators.

use lobefit::approximate::{Region, certification};
use lobefit::data::{AlphaMap, Smith};
use lobefit::effects::reflection::{CERTIFIED, JUDGED, SAMPLERS, studies};

#[test]
fn quadrature_wins_and_the_running_sum_is_biased() {
    let studies = studies(Smith::Correlated).expect("in the domain");
    for study in &studies {
        let last = |i: usize| *study.series[i].points.last().expect("points");
        let shipped = study.series.len() - 1;
        let quadrature = last(shipped);
        assert!(quadrature.0 < 400.0 && quadrature.1 < 1e-12, "{}: {quadrature:?}", study.name);
        for i in 0..SAMPLERS.len() {
            assert!(last(i).1 > 1e6 * quadrature.1, "{}: {:?}", study.name, last(i));
        }
        assert!(study.sources.noise < 2e-4 && study.sources.bias < 3e-3, "{:?}", study.sources);
    }
    assert!(
        studies[1].sources.bias > 3.0 * studies[1].sources.noise,
        "smooth texels are biased: {studies:?}"
    );
}

#[test]
fn the_counts_are_those_of_the_program() {
    let alpha_map = AlphaMap::default();
    let region = Region { roughness: [0.02, 1.0], mu: [0.01, 1.0], alpha_map };
    for (log2, counted) in [(17, JUDGED), (20, CERTIFIED)] {
        let points = certification(&region, log2).len() as f64;
        assert!((points / counted - 1.0).abs() < 0.01, "{points} points, {counted} in the model");
    }
}
