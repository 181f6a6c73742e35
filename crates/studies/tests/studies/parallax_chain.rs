//! The part of the study of parallax about chains of levels.

use serde_json::Value;

fn list(value: &Value) -> &[Value] {
    value.as_array().expect("a list")
}

fn numbers(value: &Value) -> Vec<f64> {
    list(value).iter().map(|x| x.as_f64().expect("a number")).collect()
}

/// A row of a list by the name that it has under a key.
fn named<'a>(rows: &'a Value, key: &str, name: &str) -> &'a Value {
    list(rows).iter().find(|row| row[key] == name).expect("a row")
}

/// What is known of the figures whatever the size of the study.
pub fn is_measured(chain: &Value) {
    for parts in list(&chain["parts"]) {
        let of = |part: &str| numbers(&parts[part]);
        // 11 bits of mantissa
        assert!(of("half").iter().all(|&off| off > 0.0 && off < 1.0 / 2048.0), "{parts}");
        assert!(of("total").iter().zip(of("half")).all(|(total, half)| *total > 10.0 * half), "{parts}");
        assert_ne!(of("total"), of("clamped"), "{parts}");
    }
    let gain = |row: &Value, key: &str| row[key].as_f64().expect("a number");
    let frostbite = named(&chain["gains"], "method", "Frostbite");
    assert!((gain(frostbite, "gain_exact") - 1.0).abs() < 1e-12, "{frostbite}");
    assert!((gain(frostbite, "gain_chain") - 1.0).abs() < 1e-12, "{frostbite}");
    assert!(gain(named(&chain["gains"], "method", "no parallax"), "gain_chain") < 1.0);
    // the same lookup and bake by two ways
    for (method, policy) in [
        ("rational, areas", "angular, ratio of areas"),
        ("rational, distances", "angular, ratio of distances"),
    ] {
        let gains = named(&chain["gains"], "method", method);
        let policy = named(&chain["policies"], "policy", policy);
        for (a, b) in [("exact", "whole"), ("chain", "chain")] {
            let pairs = numbers(&gains[a]).into_iter().zip(numbers(&policy[b]));
            assert!(pairs.into_iter().all(|(a, b)| (a / b - 1.0).abs() < 1e-9), "{gains} {policy}");
        }
    }
    // two walls' perpendicular viewpoints disagree at their edge
    for floor in list(&chain["seams"]) {
        let edge = |policy: &str| gain(named(&floor["pictures"], "policy", policy), "edge");
        assert!(edge("perpendicular, ratio of areas") > edge("angular, ratio of areas"), "{floor}");
        assert!(edge("sliding, ratio of areas") < edge("perpendicular, ratio of areas"), "{floor}");
    }
}
