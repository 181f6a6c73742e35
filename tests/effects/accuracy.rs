//! The points that a plan counts.

use lobefit::approximate::{Region, certification};
use lobefit::data::AlphaMap;
use lobefit::effects::reflection::{CERTIFIED, JUDGED};

#[test]
fn the_counts_are_those_of_the_program() {
    let alpha_map = AlphaMap::default();
    let region = Region { roughness: [0.02, 1.0], mu: [0.01, 1.0], alpha_map };
    for (log2, counted) in [(17, JUDGED), (20, CERTIFIED)] {
        let points = certification(&region, log2).len() as f64;
        assert!((points / counted - 1.0).abs() < 0.01, "{points} points, {counted} in the model");
    }
}
