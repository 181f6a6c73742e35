//! `lobefit report --study parallax`: the same bytes for any number of threads.

use crate::common;

use std::path::Path;

use common::{lobefit, names, stderr};
use lobefit::effects::parallax::LobeFit;
use lobefit_studies::study::parallax::ProbeLookups;
use lobefit_studies::study::parallax::room::proxies::Eased;
use lobefit_studies::study::{Size, Study};
use serde_json::Value;

const STUDY: &dyn Study = &ProbeLookups;

fn run(folder: &Path, options: &[&str]) -> String {
    let output = lobefit(folder, &[&["report", "--study", "parallax", "--reduced"], options].concat(), b"");
    assert_eq!((output.status.code(), stderr(&output).as_str()), (Some(0), ""));
    String::from_utf8(output.stdout).expect("text")
}

#[test]
fn the_reduced_study_is_the_same_for_any_threads() {
    let (one, three) = (tempfile::tempdir().expect("a folder"), tempfile::tempdir().expect("a folder"));
    let said = run(one.path(), &["--threads", "1"]);
    assert!(said.contains("2 files written, 0 unchanged"), "{said}");
    let printed = run(three.path(), &["--threads", "3", "--json"]);
    assert_eq!(names(one.path()), ["reports"]);
    for file in STUDY.files(Size::Reduced) {
        let bytes = |folder: &Path| std::fs::read(folder.join(&file)).expect("a file");
        assert_eq!(bytes(one.path()), bytes(three.path()), "{file}");
    }
    let [page, results] = STUDY.files(Size::Reduced);
    let text = std::fs::read_to_string(one.path().join(&results)).expect("results");
    let results: Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(serde_json::from_str::<Value>(&printed).expect("JSON"), results);
    let reduced = STUDY.recipe(Size::Reduced).expect("a recipe");
    assert_eq!(results["origin"]["recipe"], reduced);
    let page = std::fs::read_to_string(one.path().join(page)).expect("a page");
    assert!(page.contains(&reduced));
    answers_come_first(&page);
    rooms_are_measured(&results);
    crate::parallax_chain::is_measured(&results);
    slants_are_true(&results);
}

/// The answers stand open before all else; what they rest on is folded, and no table of it stands
/// open.
fn answers_come_first(page: &str) {
    let at = |id: &str| page.find(&format!("<section id=\"{id}\">")).unwrap_or_else(|| panic!("{id}"));
    let order = ["verdict", "random", "pictures", "creases", "compared", "slant", "chain"];
    assert!(order.map(at).is_sorted(), "{:?}", order.map(at));
    let rest = &page[at("compared")..];
    let mut depth = 0_i32;
    for (i, _) in rest.match_indices('<') {
        depth +=
            i32::from(rest[i..].starts_with("<details>")) - i32::from(rest[i..].starts_with("</details>"));
        assert!(depth > 0 || !rest[i..].starts_with("<figure>"), "{}", &rest[i..i + 200]);
    }
    assert_eq!(depth, 0);
    assert!(page[at("verdict")..at("random")].split("<details>").next().expect("text").contains("<figure>"));
}

/// Slanted walls: more fetches are nearer, and the rules come near to fetches placed for the wall.
fn slants_are_true(results: &Value) {
    let number = |value: &Value| value.as_f64().expect("a number");
    for row in results["slant"]["lobes"][0]["rows"].as_array().expect("rows") {
        let placed: Vec<f64> =
            row["placed"].as_array().expect("fetches").iter().map(|one| number(&one["tv"])).collect();
        let (same, best) = (number(&row["same"]), number(&row["best"]));
        assert!(same > best && best > 1.3 * placed[0] && placed[0] > 1.3 * placed[1], "{row}");
        for (rule, placed) in row["ruled"].as_array().expect("rules").iter().zip(&placed) {
            assert!((number(rule) / placed - 1.0).abs() < 0.06, "{row}");
        }
    }
    for refit in results["slant"]["refits"].as_array().expect("fits") {
        assert!(number(&refit["sums"][1]) <= number(&refit["sums"][0]), "{refit}");
    }
    let expectations = results["slant"]["expectations"].as_array().expect("fits");
    assert_eq!(expectations.len(), 3);
    for of in expectations {
        assert!(number(&of["off"][1]) <= number(&of["off"][0]) && number(&of["off"][0]) < 0.2, "{of}");
    }
}

/// Frostbite's gain over itself is 1, every reference is known better than any method comes to it,
/// and it is nothing off from itself.
fn rooms_are_measured(results: &Value) {
    let list = |value: &Value| value.as_array().expect("a list").clone();
    let numbers =
        |value: &Value| -> Vec<f64> { list(value).iter().map(|x| x.as_f64().expect("a number")).collect() };
    let rooms = list(&results["rooms"]["random"]);
    assert_eq!(rooms.len(), 3);
    for room in &rooms {
        for reference in list(&room["references"]) {
            let noise = numbers(&reference["noise"]);
            for row in list(&reference["rows"]) {
                let l2 = numbers(&row["l2"]);
                assert!(l2.iter().zip(&noise).all(|(l2, noise)| noise < l2), "{room}: {row}");
                if row["name"] == "Frostbite" {
                    let gain = row["gain_l2"].as_f64().expect("a number");
                    assert!((gain - 1.0).abs() < 1e-12, "{row}");
                }
                if row["name"] == "no parallax" {
                    assert!(row["gain_l2"].as_f64().expect("a number") < 1.0, "{row}");
                }
            }
        }
    }
    for pictures in list(&results["rooms"]["pictures"]) {
        let rows = list(&pictures["rows"]);
        let exact = rows.iter().find(|row| row["name"] == "exact round lobe").expect("a row");
        assert!(numbers(&exact["flip"][0]).iter().all(|&flip| flip == 0.0), "{exact}");
        assert!(numbers(&exact["flip"][1]).iter().all(|&flip| flip > 0.0), "{exact}");
        assert!(
            rows.iter()
                .filter(|row| row["name"] != "exact round lobe")
                .all(|row| { numbers(&row["flip"][0]).iter().all(|&flip| flip > 0.0 && flip < 1.0) })
        );
    }
}

/// What the issue of lookups promises, as the committed study measures it: gains over Frostbite's
/// listing, slanted walls, and the creases of smooth edges.
#[test]
fn the_committed_study_keeps_its_bars() {
    let path = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
        .join("reports/studies/parallax/results.json");
    let results: Value = serde_json::from_slice(&std::fs::read(path).expect("committed")).expect("JSON");
    let number = |value: &Value| value.as_f64().expect("a number");
    let gain = |room: &str, method: &str| {
        let rooms = results["rooms"]["random"].as_array().expect("rooms");
        let room = rooms.iter().find(|r| r["room"] == room).expect("the room");
        let rows = room["references"][0]["rows"].as_array().expect("rows");
        number(&rows.iter().find(|row| row["name"] == method).expect("the method")["gain_l2"])
    };
    for (room, one, three) in [("A", 1.65, 2.35), ("B", 2.0, 3.3)] {
        assert!(gain(room, "rational, areas, smooth") > one, "{room}");
        assert!(gain(room, "3 fetches, smooth") > three, "{room}");
    }
    let lobes = results["slant"]["lobes"].as_array().expect("lobes");
    let lobe = lobes.iter().find(|lobe| lobe["alpha"] == 0.1).expect("alpha 0.1");
    let row = lobe["rows"].as_array().expect("rows").iter().find(|row| row["slant"] == 72.0);
    let row = row.expect("72 degrees");
    assert!(number(&row["best"]) < 0.3755, "{row}");
    for (placed, bar) in row["placed"].as_array().expect("fetches").iter().zip([0.246, 0.171, 0.119, 0.049]) {
        assert!(number(&placed["tv"]) <= bar, "{placed}");
    }
    creases_keep_their_bars(&results["rooms"]);
    for lobe in results["rooms"]["lobes"].as_array().expect("fits") {
        let stated = LobeFit::expected(lobe["fetches"].as_u64().expect("a number") as u32);
        for (key, stated) in ["shipped", "mirror"].into_iter().zip(stated) {
            let measured = number(&lobe[key]);
            assert!((measured - stated).abs() < 1e-3, "{key}: {measured} where the headers say {stated}");
        }
    }
    let law = Eased::formula("alpha");
    let page = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("docs/probes.md");
    let page = std::fs::read_to_string(page).expect("a page");
    assert!(page.contains(&law), "{law}");
}

/// Creases on the edges of the room over those elsewhere, in the mean of the pictures: with one
/// fetch through smooth edges less than those of the walls themselves. At r .15 the lobe is about as
/// wide as the pixels that show an edge.
fn creases_keep_their_bars(rooms: &Value) {
    let pictures = rooms["pictures"].as_array().expect("pictures");
    let numbers = |value: &Value| -> Vec<f64> {
        value.as_array().expect("a list").iter().map(|x| x.as_f64().expect("a number")).collect()
    };
    let mean = |name: &str, key: &dyn Fn(&Value) -> Vec<f64>| -> Vec<f64> {
        let rows = pictures.iter().map(|picture| {
            let rows = picture["rows"].as_array().expect("rows");
            key(rows.iter().find(|row| row["name"] == name).expect("the method"))
        });
        let rows: Vec<Vec<f64>> = rows.collect();
        (0..rows[0].len()).map(|i| rows.iter().map(|row| row[i]).sum::<f64>() / rows.len() as f64).collect()
    };
    let ratios = |name: &str| -> Vec<f64> {
        let [edges, elsewhere] = ["edges", "elsewhere"].map(|key| mean(name, &|row| numbers(&row[key])));
        edges.iter().zip(&elsewhere).map(|(a, b)| a / b).collect()
    };
    assert_eq!(numbers(&pictures[0]["roughness"]), [0.15, 0.25, 0.35, 0.5, 0.7, 0.9]);
    let [smooth, sharp] = ["rational, areas, smooth", "rational, areas"].map(ratios);
    for (i, bar) in [2.3, 1.3, 1.2, 1.2, 1.35, 1.45].into_iter().enumerate() {
        assert!(smooth[i] <= bar && smooth[i] < 0.8 * sharp[i], "{i}: {} and {}", smooth[i], sharp[i]);
    }
    // what is seen of methods is not the noise of what they are compared with
    for picture in pictures {
        assert!(numbers(&picture["flip_of_noise"][0]).iter().all(|noise| *noise < 1e-3), "{picture}");
        assert!(numbers(&picture["noise"][0]).iter().all(|noise| *noise < 1e-3), "{picture}");
        assert!(numbers(&picture["noise"][1]).iter().all(|noise| *noise < 0.01), "{picture}");
    }
}
