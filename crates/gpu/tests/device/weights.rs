//! Prices of kinds of work are least squares that are not negative.

use lobefit_gpu::least_squares;

#[test]
fn prices_are_found_again_and_are_not_negative() {
    let rows: Vec<([f64; 2], f64)> =
        (1..6).map(|k| [f64::from(k), f64::from(k * k % 4)]).map(|r| (r, 2.0 * r[0] + 0.5 * r[1])).collect();
    let found = least_squares(&rows);
    assert!((found[0] - 2.0).abs() + (found[1] - 0.5).abs() < 1e-9, "{found:?}");
    let rows: Vec<([f64; 2], f64)> = rows.iter().map(|(r, _)| (*r, 2.0 * r[0] - 0.5 * r[1])).collect();
    assert_eq!(least_squares(&rows)[1], 0.0);
}
