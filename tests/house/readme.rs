//! The figures in the README are those of the committed bake.

use std::path::Path;

use lobefit::emit::header::short;
use serde_json::Value;

fn read(name: &str) -> String {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(name)).expect("committed")
}

fn json(name: &str) -> Value {
    serde_json::from_str(&read(name)).expect("JSON")
}

fn find<'a>(list: &'a Value, name: &str) -> &'a Value {
    let list = list.as_array().expect("a list");
    list.iter().find(|e| e["name"] == name).unwrap_or_else(|| panic!("the README names {name}"))
}

/// The blocks of a language.
fn blocks<'a>(readme: &'a str, language: &str) -> Vec<&'a str> {
    let opening = format!("```{language}\n");
    readme
        .split(opening.as_str())
        .skip(1)
        .map(|rest| rest.split("```").next().expect("its end").trim())
        .collect()
}

#[test]
fn the_table_of_fits_is_the_manifests() {
    let (readme, manifest) = (read("README.md"), json("manifest.json"));
    let mut rows = 0;
    for line in readme.lines().filter(|l| l.starts_with("| `ggx_") || l.starts_with("| `coupling_")) {
        let cells: Vec<&str> = line.split('|').map(|c| c.trim().trim_matches('`')).collect();
        let fit = find(&manifest["fits"], cells[1]);
        assert_eq!(fit["cost"]["ops"].to_string(), cells[2], "{line}");
        let max = fit["certificate"]["max_abs"].as_f64().expect("a number");
        assert_eq!(max, cells[3].parse::<f64>().expect("a number"), "{line}");
        let (rms, printed) = (fit["certificate"]["rms"].as_f64().expect("a number"), cells[4].parse::<f64>());
        assert!((rms / printed.expect("a number") - 1.0).abs() < 1e-3, "{line}: {rms}");
        rows += 1;
    }
    assert!(rows >= 10, "the table is there");
}

/// The README's row of a table of the manifest.
fn table_row(table: &Value) -> String {
    let sizes = table["axes"].as_array().expect("axes").iter().map(|axis| axis["size"].to_string());
    let lookup = &table["error"]["lookup"];
    format!(
        "| `{}` | {} | {} | {} | {} | {} |",
        table["name"].as_str().expect("a name"),
        sizes.collect::<Vec<_>>().join(" x "),
        table["bytes"],
        table["cost"]["ops"],
        lookup["max"].as_f64().expect("a number"),
        short(lookup["rms"].as_f64().expect("a number")),
    )
}

#[test]
fn the_table_of_tables_is_the_manifests() {
    let (readme, manifest) = (read("README.md"), json("manifest.json"));
    let wanted: Vec<String> = manifest["tables"].as_array().expect("a list").iter().map(table_row).collect();
    let shown = |l: &&str| l.starts_with("| `ggx-") || l.starts_with("| `path-tracer-");
    let found: Vec<&str> = readme.lines().filter(shown).filter(|l| l.matches('|').count() == 7).collect();
    assert_eq!(found, wanted, "the README's rows should be:\n{}\n", wanted.join("\n"));
}

/// `what ignoring the azimuth costs` as the README rounds it, up to three digits, is the report's
/// figure.
#[test]
fn the_price_of_ignoring_the_azimuth_is_the_reports() {
    let ways = json("reports/anisotropy.json")["azimuth"][0]["ways"].clone();
    let mean = ways
        .as_array()
        .expect("a list")
        .iter()
        .find(|way| way["name"].as_str().expect("a name").ends_with("ggx-aniso-correlated-64x64x32"));
    let max = mean.expect("the table of means")["error"]["max"].as_f64().expect("a number");
    let shown = format!("off by up to {} ", (max * 1000.0).ceil() / 1000.0);
    assert!(read("README.md").contains(&shown), "the README should say `{shown}`");
}

#[test]
fn the_example_hypothesis_is_the_file() {
    assert!(read("README.md").contains(read("examples/own-hypothesis.wgsl").trim()));
}

#[test]
fn every_example_is_named() {
    let readme = read("README.md");
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    for entry in std::fs::read_dir(folder).expect("examples") {
        let name = entry.expect("a file").file_name().into_string().expect("UTF-8");
        assert!(!name.ends_with(".json") || readme.contains(&name), "the README does not name {name}");
    }
}

/// Each piece of code is emitted, or the example's hypothesis, or (where it binds a texture) calls
/// what is emitted.
#[test]
fn the_code_is_what_is_emitted() {
    let (readme, wgsl) = (read("README.md"), read("fits/lobefit.wgsl"));
    let mut bound = 0;
    for block in blocks(&readme, "wgsl") {
        if block.starts_with("@group") {
            let module = naga::front::wgsl::parse_str(&format!("{wgsl}\n{block}"))
                .expect("the README's shader parses");
            let mut validator = naga::valid::Validator::new(
                naga::valid::ValidationFlags::all(),
                naga::valid::Capabilities::empty(),
            );
            validator.validate(&module).expect("the README's shader is valid");
            bound += 1;
        } else if !read("examples/own-hypothesis.wgsl").contains(block) {
            for piece in block.split("\n\n") {
                assert!(wgsl.contains(piece), "not emitted:\n{piece}");
            }
        }
    }
    assert_eq!(bound, 1, "the README shows how to bind a table");
}

#[test]
fn the_output_is_the_commands() {
    let (readme, manifest) = (read("README.md"), json("manifest.json"));
    for line in blocks(&readme, "text")[0].lines().filter(|line| line.starts_with("ggx")) {
        let name = line.split_whitespace().next().expect("a name");
        let figure = if name.starts_with("ggx_") {
            find(&manifest["fits"], name)["certificate"]["max_abs"].as_f64()
        } else {
            find(&manifest["tables"], name)["error"]["lookup"]["max"].as_f64()
        };
        assert!(line.contains(&format!(" {}  ", figure.expect("a number"))), "{line}");
    }
}

/// The README's name of a lookup of the study, and the study's.
const LOOKUPS: [(&str, &str); 5] = [
    ("min(1, rho alpha), sharp edges", "min(1, ρ α)"),
    ("alpha' by areas, sharp edges", "rational, areas"),
    ("1 fetch, smooth edges", "rational, areas, smooth"),
    ("2 fetches, sharp edges", "2 fetches"),
    ("3 fetches, smooth edges", "3 fetches, smooth"),
];

#[test]
fn the_gains_of_lookups_are_the_studys() {
    let (readme, study) = (read("README.md"), json("reports/studies/parallax/results.json"));
    let gains = study["chain"]["gains"].as_array().expect("gains");
    for (name, method) in LOOKUPS {
        let of = |room: &str| {
            let row = gains.iter().find(|row| row["room"] == room && row["method"] == method);
            let row = row.unwrap_or_else(|| panic!("the study has {method} in {room}"));
            let [exact, chain] = ["gain_exact", "gain_chain"].map(|key| row[key].as_f64().expect("a number"));
            format!("{exact:.2} ({chain:.2})")
        };
        let line = format!("| {name} | {} |", ["A", "B", "octagon"].map(of).join(" | "));
        assert!(readme.lines().any(|l| l == line), "{line}");
    }
    let points = &study["parameters"]["chain"]["points"]["count"];
    assert!(readme.contains(&format!("at {points} points")), "{points} points");
}
