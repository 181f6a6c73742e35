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
pub fn is_measured(results: &Value) {
    let gains = &results["chain"]["gains"];
    let gain = |row: &Value, key: &str| row[key].as_f64().expect("a number");
    let frostbite = named(gains, "method", "Frostbite");
    assert!((gain(frostbite, "gain_exact") - 1.0).abs() < 1e-12, "{frostbite}");
    assert!((gain(frostbite, "gain_chain") - 1.0).abs() < 1e-12, "{frostbite}");
    assert!(gain(named(gains, "method", "no parallax"), "gain_chain") < 1.0);
    // the same lookup at the same points by two ways
    let random = &results["rooms"]["random"][0];
    let at = |roughness: &Value| {
        let place = list(roughness).iter().position(|r| r.as_f64() == Some(0.7));
        place.expect("roughness 0.7")
    };
    let places = [at(&results["chain"]["roughness"]), at(&random["roughness"])];
    for row in list(gains).iter().filter(|row| row["room"] == random["room"]) {
        let other = named(&random["references"][0]["rows"], "name", row["method"].as_str().expect("a name"));
        let [here, there] = [numbers(&row["exact"])[places[0]], numbers(&other["l2"])[places[1]]];
        assert!((here / there - 1.0).abs() < 1e-3, "{row} {other}");
        assert!(numbers(&row["chain"])[places[0]] != here, "{row}");
    }
}
