//! Tables of one effect that hold in different ranges: each is judged and drawn where it must hold,
//! and what one of them took is told as often as it was done.

use crate::sliced_support;

use lobefit::bake::Baked;
use serde_json::Value;
use sliced_support::baked;

fn scene(more: &str, materials: &[String]) -> Baked {
    baked(&format!(r#"{{"schema_version":1,{more}"materials":[{}]}}"#, materials.join(",")))
}

fn metal(name: &str, roughness: &str, anisotropy: &str, tables: &str) -> String {
    format!(
        r#"{{"name":"{name}","kind":"metal","f0":1,"roughness":{roughness},"anisotropy":{anisotropy},"wants":{{"tables":[{tables}]}}}}"#
    )
}

fn glass(name: &str, ior: &str, roughness: &str, tables: &str) -> String {
    format!(
        r#"{{"name":"{name}","kind":"glass","ior":{ior},"roughness":{roughness},"wants":{{"tables":[{tables}]}}}}"#
    )
}

/// The figures of an effect's page.
fn figures(baked: &Baked, effect: &str) -> Value {
    serde_json::from_slice(&baked.files[&format!("reports/{effect}.json")]).expect("JSON")
}

fn list<'a>(value: &'a Value, key: &str) -> &'a Vec<Value> {
    value[key].as_array().unwrap_or_else(|| panic!("{key}[] in {value}"))
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

/// Ranges of anisotropy whose ends do not survive two divisions: the interpolant of E over the
/// azimuth must hold its own ends.
#[test]
fn ranges_of_anisotropy_from_zero_bake() {
    for high in ["0.1", "0.2", "0.4"] {
        let tables = r#"{"layout":"azimuth","size":[8,6,4]}"#;
        let baked = scene("", &[metal("m", "[0.5,0.6]", &format!("[0,{high}]"), tables)]);
        assert_eq!((baked.tables.len(), baked.broken.len()), (1, 0), "[0, {high}]");
    }
    for high in ["0.02", "0.21"] {
        let baked = scene("", &[metal("m", "[0.5,0.6]", &format!("[0,{high}]"), r#"{"size":[8,6,4]}"#)]);
        assert_eq!((baked.tables.len(), baked.broken.len()), (1, 0), "[0, {high}]");
        assert_eq!(list(&figures(&baked, "anisotropy"), "azimuth").len(), 1);
    }
}

/// What ignoring the azimuth costs is told of each table where it must hold: of one with the
/// azimuth it is no more than its own certificate, and of a mean no less than its own.
#[test]
fn the_azimuth_is_told_of_each_region() {
    let azimuth = |columns| format!(r#"{{"layout":"azimuth","size":[{columns},8,6]}}"#);
    let baked = scene(
        "",
        &[
            metal("brushed", "[0.5,0.6]", "[0.7,0.8]", &(azimuth(12) + r#",{"size":[12,8,6]}"#)),
            metal("turned", "[0.85,0.95]", "[0.1,0.2]", &azimuth(14)),
        ],
    );
    let page = figures(&baked, "anisotropy");
    let findings = list(&page, "azimuth");
    let domains: Vec<&str> = findings.iter().map(|f| f["domain"].as_str().expect("a domain")).collect();
    let expected =
        ["roughness 0.5 to 0.6, anisotropy 0.7 to 0.8", "roughness 0.85 to 0.95, anisotropy 0.1 to 0.2"];
    assert_eq!(domains, expected);
    assert_eq!(findings.iter().map(|f| list(f, "ways").len()).collect::<Vec<_>>(), [2, 1]);
    for way in findings.iter().flat_map(|f| list(f, "ways")) {
        let (name, max) = (way["name"].as_str().expect("a name"), number(&way["error"]["max"]));
        let named = |t: &&lobefit::bake::BakedTable| name.ends_with(&t.approximation.name);
        let table = baked.tables.iter().find(named).expect("a table");
        let stated = table.errors.lookup.max;
        if name.starts_with("azimuth in the table") {
            assert!(max <= stated, "{name}: {max}, certified {stated}");
        } else {
            assert!(max > 5.0 * stated, "{name}: {max} shows what the mean leaves out, certified {stated}");
        }
    }
}

/// Largest departure of a row of spheres from white.
fn departure(row: &Value) -> f64 {
    let factors = list(row, "factors").iter().flat_map(|line| line.as_array().expect("a line"));
    let off = factors.map(|f| (number(f) - 1.0).abs());
    off.reduce(f64::max).expect("factors")
}

/// Spheres are drawn where a table holds: none of another table's index of refraction, and rows of
/// equal layouts have their table's name.
#[test]
fn furnaces_are_drawn_where_their_tables_hold() {
    let sized = |size: &str| format!(r#"{{"size":{size}}}"#);
    let baked = scene(
        "",
        &[
            glass("thin", "[1.05,1.2]", "[0.5,0.8]", &(sized("[16,12,8]") + "," + &sized("[18,12,8]"))),
            glass("dense", "[2,3]", "[0.3,0.4]", &sized("[20,12,8]")),
        ],
    );
    let page = figures(&baked, "glass");
    let furnaces = list(&page, "furnaces");
    let titles: Vec<&str> = furnaces.iter().map(|f| f["title"].as_str().expect("a title")).collect();
    let expected = ["1.1, from outside", "1.1, from inside", "2, from outside", "2, from inside"];
    assert_eq!(titles, expected.map(|t| format!("Glass, index of refraction {t}")));
    for (furnace, title) in furnaces.iter().zip(&titles) {
        let rows = list(&furnace["furnace"], "rows");
        let names: Vec<&str> = rows.iter().map(|r| r["name"].as_str().expect("a name")).collect();
        assert_eq!(names.len(), names.iter().collect::<std::collections::BTreeSet<_>>().len(), "{names:?}");
        assert!(names[0].starts_with("uncompensated (correlated Smith"), "{names:?}");
        assert_eq!(names.len(), if title.contains(" 1.1,") { 3 } else { 2 }, "{title}: {names:?}");
        // A lookup clamped to another range of ior is off by more than the loss; E is above 0.4
        // here.
        let worst = baked.tables.iter().map(|t| t.errors.lookup.max).reduce(f64::max).expect("tables");
        for row in &rows[1..] {
            let off = departure(row);
            assert!(off <= 2.5 * worst, "{title}, {}: {off}, certified {worst}", row["name"]);
        }
        assert!(departure(&rows[0]) > 1e-3, "{title}");
    }
    // Two ranges of roughness: their truths are told apart.
    let truths: Vec<&str> =
        list(&page, "truths").iter().map(|t| t["name"].as_str().expect("a name")).collect();
    assert_eq!(truths.len(), 4, "{truths:?}");
    assert!(truths.contains(&"E, ior 1.1, outside, roughness 0.5 to 0.8"), "{truths:?}");
    assert!(truths.contains(&"E, ior 2, inside, roughness 0.3 to 0.4"), "{truths:?}");
}

/// The sources' tables in two formats are integrated twice, and both counts are told.
#[test]
fn the_sources_ratio_does_not_depend_on_the_number_of_formats() {
    let ratio = |tables: &str| {
        let page = figures(&scene("", &[metal("m", "[0.3,0.6]", "[0.2,0.8]", tables)]), "anisotropy");
        number(&page["path_tracer"]["samples"]) / number(&page["path_tracer"]["evaluations"])
    };
    let half = r#"{"layout":"path-tracer"}"#;
    let both = format!(r#"{half},{{"layout":"path-tracer","format":"f32"}}"#);
    let (one, two) = (ratio(half), ratio(&both));
    assert!((two / one - 1.0).abs() < 1e-12, "{one} {two}");
}

/// A material below all rows is told of, and its limit is not silently taken for kept.
#[test]
fn a_limit_that_no_lookup_can_judge_is_a_broken_promise() {
    let of = |size: &str| {
        let map = r#""alpha":"roughness","#;
        scene(map, &[glass("slick", "1.5", "[0.0001,0.0002]", size)])
    };
    let baked = of(r#"{"size":[8,4,4],"max_error":0.5}"#);
    assert_eq!(baked.broken.len(), 2, "{:?}", baked.broken);
    for promise in &baked.broken {
        assert!(
            promise.contains("rows begin at roughness 0.0004")
                && promise.contains("slick (materials[0].wants.tables[0].max_error)"),
            "{promise}"
        );
    }
    // A bake that keeps its promises has a page.
    let kept = of(r#"{"size":[8,4,4]}"#);
    assert_eq!(kept.broken, Vec::<String>::new());
    let page = figures(&kept, "glass");
    let because = page["effect"]["because"][0].as_str().expect("a reason");
    let rows = "roughness 0.0001 to 0.0002, all below the rows, which begin at 0.0004: every lookup clamps";
    assert!(because.contains(rows), "{because}");
}
