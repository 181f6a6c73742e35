//! The truth as the live page holds it.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use lobefit::report::explore::{TruthTexels, across, between, view};

#[test]
fn cubics_come_back_between_texels_and_at_the_edges() {
    let f = |x: f64, y: f64| 0.5 + 0.1 * x - 0.02 * x * x * y + 1e-3 * y * y * y;
    let size = [9, 6];
    let texels: Vec<f64> = (0..54).map(|k| f((k % 9) as f64, (k / 9) as f64)).collect();
    for place in [[0.0, 0.0], [0.3, 0.6], [4.5, 2.5], [7.9, 4.8], [8.0, 5.0]] {
        let found = between(&texels, size, place);
        assert!((found - f(place[0], place[1])).abs() < 1e-12, "{place:?}: {found}");
    }
}

#[test]
fn a_column_is_that_of_its_view() {
    for (alpha, range) in [(4e-4, [1e-3, 1.0]), (0.25, [0.01, 1.0]), (1.0, [0.2, 0.9])] {
        for i in 0..=20 {
            let column = f64::from(i) / 20.0;
            let found = across(view(column, range, alpha), range, alpha);
            assert!((found - column).abs() < 1e-9, "alpha {alpha}, column {column}: {found}");
        }
    }
}

#[test]
fn what_is_stored_is_what_is_measured() {
    let channel = vec![0.25, 0.5, 0.75, 1.0];
    let texels = TruthTexels::new([[0.0, 1.0]; 2], [4, 1], std::slice::from_ref(&channel));
    assert_eq!(texels.ranges, [[0.25, 1.0]]);
    let bytes = STANDARD.decode(&texels.data).expect("base64");
    let stored = TruthTexels::values(&[channel]);
    for (pair, value) in bytes.chunks(2).zip(&stored[0]) {
        let read = 0.25 + 0.75 * f64::from(u16::from_le_bytes([pair[0], pair[1]])) / 65_535.0;
        assert!((read - value).abs() < 1e-12, "{read} {value}");
    }
}
