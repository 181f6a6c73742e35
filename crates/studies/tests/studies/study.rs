//! `lobefit report --study`: the same bytes for any number of threads, figures that follow from the
//! truth, and a committed study that is of this version.

use crate::common;

use std::path::Path;

use common::{lobefit, names, stderr};
use lobefit::cli::CliError;
use lobefit::data::Smith;
use lobefit::store;
use lobefit_math::ops;
use lobefit_studies::study::coupling::DiffuseCouplings;
use lobefit_studies::study::{STUDIES, Size, Study, StudyError, stale};
use lobefit_truth::integrate::reflection::reflection;
use lobefit_truth::quantity::coupling::{Specular, Split, factor};
use serde_json::Value;

const STUDY: &dyn Study = &DiffuseCouplings;

const RESULTS: &str = "reports/studies/coupling-reduced/results.json";

fn run(folder: &Path, options: &[&str]) -> String {
    let output = lobefit(folder, &[&["report", "--study", "coupling", "--reduced"], options].concat(), b"");
    assert_eq!((output.status.code(), stderr(&output).as_str()), (Some(0), ""));
    String::from_utf8(output.stdout).expect("text")
}

fn results(file: &Path) -> Value {
    serde_json::from_slice(&std::fs::read(file).expect("results")).expect("JSON")
}

fn row<'a>(rows: &'a Value, name: &str) -> &'a Value {
    let found = rows.as_array().expect("rows").iter().find(|row| row["name"] == name);
    found.unwrap_or_else(|| panic!("no row `{name}`"))
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("a list").iter().map(number).collect()
}

#[test]
fn the_reduced_study_is_the_same_for_any_threads_and_says_what_is_true() {
    let (one, three) = (tempfile::tempdir().expect("a folder"), tempfile::tempdir().expect("a folder"));
    let said = run(one.path(), &["--threads", "1"]);
    assert!(said.contains("2 files written, 0 unchanged"), "{said}");
    let printed = run(three.path(), &["--threads", "3", "--json"]);
    assert_eq!(names(one.path()), ["reports"]);
    for file in STUDY.files(Size::Reduced) {
        let bytes = |folder: &Path| std::fs::read(folder.join(&file)).expect("a file");
        assert_eq!(bytes(one.path()), bytes(three.path()), "{file}");
    }
    let results = results(&one.path().join(RESULTS));
    assert_eq!(serde_json::from_str::<Value>(&printed).expect("JSON"), results);
    assert_eq!(results["origin"]["recipe"], STUDY.recipe(Size::Reduced).expect("a recipe"));
    furnace_is_the_truth(&results);
    ranking_is_sane(&results);
    page_is_true(one.path(), &results);
    checked(one.path());
}

/// The departure of a factor that is known in closed form: lobe + factor - 1 = factor - truth.
fn furnace_is_the_truth(results: &Value) {
    let mu = numbers(&results["parameters"]["furnace"]["mu"]);
    for strip in results["furnace"].as_array().expect("strips") {
        assert_eq!(strip["lobe"], "normalised");
        let f0 = number(&strip["f0"]);
        let pesce = numbers(&row(&strip["rows"], "Pesce 2019")["worst"]);
        let exact = numbers(&row(&strip["rows"], "1 - own specular")["worst"]);
        let kelemen = numbers(&row(&strip["rows"], "Kelemen-Szirmay-Kalos")["worst"]);
        for (i, roughness) in numbers(&strip["roughness"]).into_iter().enumerate() {
            let departure = |mu: f64| {
                let lobe = reflection(Smith::Correlated, roughness * roughness, mu, 1e-8).expect("a lobe");
                let truth = factor(&Split::of(&lobe), f0, Specular::Normalised).value;
                let fresnel = f0 + (1.0 - f0) * ops::pow(1.0 - mu, 5.0);
                (1.0 - fresnel) * (1.0 - roughness) + (1.0 - f0) * roughness - truth
            };
            let worst =
                mu.iter().map(|m| departure(*m)).fold(0.0, |m: f64, d| if d.abs() > m.abs() { d } else { m });
            assert!((worst - pesce[i]).abs() < 1e-5, "f0 {f0}, roughness {roughness}: {worst}, {}", pesce[i]);
            assert!(exact[i].abs() < 1e-6 && kelemen[i].abs() < 2e-6, "{} {}", exact[i], kelemen[i]);
        }
    }
}

fn ranking_is_sane(results: &Value) {
    let rows = &results["rankings"][0]["rows"];
    let flips: Vec<f64> = rows.as_array().expect("rows").iter().map(|r| number(&r["flip"])).collect();
    assert!(flips.windows(2).all(|w| w[0] <= w[1]), "{flips:?}");
    let of = |name: &str, key: &str| number(&row(rows, name)[key]);
    // Reciprocity is measured: rounding where it holds, and it is seen where it does not.
    assert!(of("Kelemen-Szirmay-Kalos", "reciprocity") < 1e-14 && of("Dassault", "reciprocity") < 1e-14);
    assert!(of("Pesce 2019", "reciprocity") > 0.5);
    let mean = |name: &str, key: &str| {
        let rows = &results["lit"][0]["rows"];
        let all = numbers(&row(rows, name)[key]);
        all.iter().sum::<f64>() / all.len() as f64
    };
    // All spheres have the same directions: their errors do not average out.
    // Figures are printed to nine digits.
    assert!((of("Pesce 2019", "flip_error") / mean("Pesce 2019", "error") - 1.0).abs() < 1e-8);
    assert_eq!(of("1 - own specular", "flip"), 0.0);
    assert_eq!(of("Kelemen-Szirmay-Kalos", "flip_reciprocal"), 0.0);
    assert!(of("none", "flip") > of("Pesce 2019", "flip"));
    // What is seen is not judged on so few spheres: the committed study is.
    let (max, seen) = ("coupling_normalised_7", "coupling_normalised_7, perceptual");
    assert!(of(max, "furnace_max") < of(seen, "furnace_max"), "fitted for the largest error");
    assert_eq!((row(rows, max)["ops"].clone(), row(rows, max)["ours"].clone()), (7.into(), true.into()));
}

/// The page: how many pairs are ordered otherwise is counted over those alone that are not nearer
/// to the reciprocal reference; every name of a coupling has a meaning; published fits and ours
/// have their rows of reciprocity.
fn page_is_true(folder: &Path, results: &Value) {
    let page =
        std::fs::read_to_string(folder.join("reports/studies/coupling-reduced/index.html")).expect("a page");
    let rows = results["rankings"][0]["rows"].as_array().expect("rows");
    let compared = rows.iter().filter(|row| {
        let of = |key: &str| number(&row[key]);
        of("flip") > 0.0 && of("furnace_max") > 1e-6 && of("flip") <= of("flip_reciprocal")
    });
    let n = compared.count();
    assert!(n > 3 && n < rows.len() - 2, "{n} of {}: some are nearer", rows.len());
    let said = format!("Of the {} pairs of the {n} inexact couplings", n * (n - 1) / 2);
    assert!(page.contains(&said), "{said}");
    let meanings = results["meanings"].as_array().expect("meanings");
    for row in rows.iter().filter(|row| row["ours"] == false) {
        assert!(meanings.iter().any(|m| m["name"] == row["name"]), "{row}");
    }
    let measured = results["surfaces"]["reciprocity"].as_array().expect("rows");
    for name in ["coupling_normalised_7", "coupling_normalised_karis", "Dassault"] {
        let row = measured.iter().find(|row| row["lobe"] == "normalised" && row["coupling"] == name);
        assert!(row.is_some_and(|row| number(&row["reciprocity"]) > 0.1), "{name}: {row:?}");
    }
    assert!(measured.iter().all(|row| (0.0..=2.0).contains(&number(&row["reciprocity"]))));
}

/// `report --check` names files of another recipe, and one that is missing.
fn checked(folder: &Path) {
    let check = || {
        let output = lobefit(folder, &["report", "--check", "."], b"");
        (output.status.code(), String::from_utf8(output.stdout).expect("text"))
    };
    assert_eq!(check(), (Some(0), String::new()));
    let recipe = STUDY.recipe(Size::Reduced).expect("a recipe");
    for file in STUDY.files(Size::Reduced) {
        let text = std::fs::read_to_string(folder.join(&file)).expect("text");
        std::fs::write(folder.join(&file), text.replace(&recipe, "of other code")).expect("written");
        let (code, said) = check();
        assert_eq!(code, Some(1), "{said}");
        assert!(
            said.starts_with(&format!("{file}: not of the recipe {recipe} of this version's study")),
            "{said}"
        );
        assert!(said.ends_with("make it again with lobefit report --study coupling --reduced\n"), "{said}");
        std::fs::write(folder.join(&file), text).expect("written");
    }
    std::fs::remove_file(folder.join(RESULTS)).expect("removed");
    let (code, said) = check();
    assert_eq!(code, Some(1), "{said}");
    assert!(said.contains("results.json: missing"), "{said}");
}

#[test]
fn the_committed_studies_are_of_this_version() {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    for study in STUDIES {
        let files = study.files(Size::Full);
        let found = store::read_set(root, files.iter().map(String::as_str), 1 << 24).expect("readable");
        assert_eq!(found.len(), files.len(), "{files:?}");
        assert_eq!(stale(study, Size::Full, &found).expect("a recipe"), None);
        let bytes: usize = found.values().map(Vec::len).sum();
        assert!(bytes < 5 << 19, "{bytes} bytes");
    }
}

/// Each fit is the best at what it was fitted for.
#[test]
fn the_committed_study_of_couplings_ranks_fits_by_what_they_minimise() {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    let results = results(&root.join("reports/studies/coupling/results.json"));
    let rows = &results["rankings"][0]["rows"];
    let of = |name: &str, key: &str| number(&row(rows, name)[key]);
    for name in ["coupling_normalised_7", "coupling_normalised_12", "coupling_normalised_18"] {
        let seen = format!("{name}, perceptual");
        assert!(of(&seen, "perceptual") < of(name, "perceptual"), "{name}: fitted for what is seen");
        assert!(of(name, "furnace_max") < of(&seen, "furnace_max"), "{name}: fitted for the largest error");
    }
}

/// What a study does not reach is a promise of the program's: it has no input that could be at
/// fault.
#[test]
fn a_study_that_fails_is_no_bad_input() {
    let failed = CliError::from(StudyError::Unfitted { name: "f".into() });
    assert_eq!((failed.exit_code(), failed.to_string().as_str()), (1, "f: no fit was made"));
}

#[test]
fn wrong_use_is_refused_and_writes_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    for (options, said) in [
        (&["report"][..], "--study <NAME>"),
        (
            &["report", "--study", "rooms"],
            "no such study; there are coupling, parallax, stability, occlusion",
        ),
        (&["report", "--study", "coupling", "--threads", "0"], "1 to 256"),
        (&["report", "--study", "coupling", "--reduced", "--times"], "the study coupling times nothing"),
    ] {
        let output = lobefit(folder.path(), options, b"");
        assert_eq!(output.status.code(), Some(2), "{options:?}");
        assert!(stderr(&output).contains(said), "{}", stderr(&output));
    }
    std::fs::write(folder.path().join("file"), b"x").expect("written");
    let output =
        lobefit(folder.path(), &["report", "--study", "coupling", "--reduced", "--out", "file"], b"");
    assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
    assert_eq!(names(folder.path()), ["file"]);
}

/// The recipe of a study follows from its own code: no study computes with another one's.
#[test]
fn no_study_names_another() {
    fn read(path: &Path, text: &mut String) {
        match std::fs::read_dir(path) {
            Ok(entries) => entries.for_each(|entry| read(&entry.expect("an entry").path(), text)),
            Err(_) => text.push_str(&std::fs::read_to_string(path).expect("text")),
        }
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let names = STUDIES.map(Study::name);
    let places = names
        .map(|name| if name == "occlusion" { "study/occlusion.rs".into() } else { format!("study/{name}") });
    for place in
        places.iter().map(String::as_str).chain(["flip", "render", "study/page.rs", "study/given.rs"])
    {
        let mut text = String::new();
        read(&root.join(place), &mut text);
        let others = names.iter().filter(|name| !place.contains(*name));
        for other in others.flat_map(|name| [format!("study::{name}"), format!("super::{name}")]) {
            assert!(!text.contains(&other), "{place} names {other}");
        }
    }
    let codes: std::collections::BTreeSet<&str> = STUDIES.map(Study::code).into_iter().collect();
    assert_eq!(codes.len(), STUDIES.len());
}

/// A triangle of a millimetre.
const SMALL: &str = r#"{"asset":{"version":"2.0"},"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
"bufferViews":[{"buffer":0,"byteLength":36}],
"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAbxKDOgAAAAAAAAAAAAAAAAAAAABvEoM6"}]}"#;

/// A scene that names a mesh: its study, its times, which the page shows from then on, and what is
/// refused with nothing written, a scene of the same file name elsewhere among it.
#[test]
fn a_mesh_beside_a_scene_is_studied_timed_or_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, bytes: &[u8]| std::fs::write(folder.path().join(name), bytes).expect("written");
    let scene = |world: &str| {
        let culling = format!("{{\"buffer\": [16, 16], \"grid\": [4, 4, 4],\n\"world\": \"{world}\"}}");
        let text = format!("{{\"schema_version\": 1, \"materials\": [], \"culling\": {culling}}}");
        write("s.json", text.as_bytes());
    };
    let of = |file: &str, options: &[&str]| {
        let command = ["report", "--study", "occlusion", "--scene", file];
        let output = lobefit(folder.path(), &[&command, options].concat(), b"");
        (output.status.code(), String::from_utf8_lossy(&output.stdout).into_owned() + &stderr(&output))
    };
    let run = |options: &[&str]| of("s.json", options);
    write("broken.glb", b"glTF\x02\0\0\0");
    write("other.glb", b"glTE\x02\0\0\0");
    write("small.gltf", SMALL.as_bytes());
    for (world, said) in [
        ("gone.glb", "error: s.json:2:19: culling.world: gone.glb: cannot read: "),
        ("broken.glb", "error: s.json:2:21: culling.world: broken.glb: the file ends in its header"),
        ("other.glb", "error: s.json:2:20: culling.world: other.glb: not a binary glTF"),
        (
            "small.gltf",
            "error: s.json:2:21: culling.world: small.gltf: none of its boxes lies in front of the camera",
        ),
    ] {
        scene(world);
        let (code, text) = run(&[]);
        assert!(code == Some(2) && text.starts_with(said), "{text}");
    }
    assert!(!names(folder.path()).contains(&"reports".to_string()));
    let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/courtyard.glb");
    write("M.GLB", &std::fs::read(example).expect("the example"));
    scene("M.GLB");
    let page = || {
        let file = folder.path().join("reports/studies/occlusion-scene-s/index.html");
        std::fs::read_to_string(file).expect("a page")
    };
    assert!(run(&[]).1.contains("2 files written"));
    assert!(page().contains("Without milliseconds") && !page().contains("ms a frame"));
    assert!(run(&["--times"]).1.contains("2 files written, 1 unchanged"));
    assert!(page().contains("fastest of five runs") && page().contains("ms a frame"));
    assert!(run(&[]).1.contains("0 files written, 2 unchanged"), "the page follows from the record");
    std::fs::create_dir(folder.path().join("b")).expect("a folder");
    write("b/s.json", br#"{"schema_version": 1, "materials": [], "culling": {}}"#);
    write(".json", br#"{"schema_version": 1, "materials": [], "culling": {}}"#);
    let before = page();
    for (file, said) in [
        (
            "b/s.json",
            "error: --scene b/s.json: reports/studies/occlusion-scene-s/results.json is of `lobefit report --study occlusion --scene s.json`; give another --out",
        ),
        (".json", "error: --scene .json: its name has nothing before `.json`"),
    ] {
        let (code, text) = of(file, &[]);
        assert!(code == Some(2) && text.starts_with(said), "{text}");
    }
    assert_eq!(page(), before);
    write("reports/studies/occlusion-scene-s/times.json", b"{}");
    let (code, text) = run(&[]);
    assert!(code == Some(2) && text.contains("occlusion-scene-s/times.json: no record of "), "{text}");
}
