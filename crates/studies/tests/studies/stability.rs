//! The study of stability: over every approach ours keeps its promise and the naive form breaks it.

use lobefit_studies::study::stability::{Approach, Measured, ORACLE, measured};
use serde_json::Value;

/// How many times the naive form breaks a promise that ours keeps.
const BROKEN: f64 = 100.0;

#[test]
fn ours_keeps_its_promise_and_the_naive_form_breaks_it() {
    let cases = measured().expect("measured");
    assert_eq!(cases.len(), 10);
    for Measured { name, promise, naive, ours, .. } in cases {
        assert!(ours.not_finite == 0 && ours.worst <= promise, "{name}: {} of {promise}", ours.worst);
        assert!(ours.points.len() >= 15, "{name}: {} points", ours.points.len());
        let breaks = |form: &Approach| form.not_finite > 0 || form.worst >= BROKEN * promise;
        assert!(naive.iter().any(breaks), "{name}: {naive:?}");
    }
}

/// Rows are distance, inputs, truth; distances fall, inputs of f32 are numbers of f32.
#[test]
fn the_oracle_has_the_form_that_its_generator_gives_it() {
    let cases: Vec<Value> = serde_json::from_str(ORACLE).expect("JSON");
    let generator = include_str!("../oracle/stability.py");
    for case in &cases {
        let name = case["name"].as_str().expect("a name");
        assert!(generator.contains(&format!("\"{name}\"")), "{name} is of another generator");
        let inputs = case["inputs"].as_array().expect("inputs").len();
        for precision in ["f64", "f32"] {
            let mut last = f64::INFINITY;
            for row in case[precision].as_array().expect("rows") {
                let row: Vec<f64> =
                    row.as_array().expect("a row").iter().map(|x| x.as_f64().expect("a number")).collect();
                assert_eq!(row.len(), inputs + 2, "{name}");
                assert!(row[0] < last && row[0] > 0.0, "{name}: distances fall to the limit");
                last = row[0];
                let exact = |x: &f64| precision == "f64" || f64::from(*x as f32) == *x;
                assert!(row[1..=inputs].iter().all(exact), "{name}: {row:?}");
            }
        }
    }
}
