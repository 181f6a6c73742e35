//! The figures in the README are those of the committed bake.

use std::path::Path;

use serde_json::Value;

fn read(name: &str) -> String {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(name)).expect("committed")
}

fn find<'a>(list: &'a Value, name: &str) -> &'a Value {
    let list = list.as_array().expect("a list");
    list.iter().find(|e| e["name"] == name).unwrap_or_else(|| panic!("the README names {name}"))
}

#[test]
fn the_table_of_fits_is_the_manifests() {
    let (readme, manifest) = (read("README.md"), read("manifest.json"));
    let manifest: Value = serde_json::from_str(&manifest).expect("JSON");
    let mut rows = 0;
    for line in readme.lines().filter(|l| l.starts_with("| `ggx_")) {
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

#[test]
fn the_example_hypothesis_is_the_file() {
    assert!(read("README.md").contains(read("examples/own-hypothesis.wgsl").trim()));
}

#[test]
fn the_output_and_the_code_are_the_commands() {
    let (readme, wgsl) = (read("README.md"), read("fits/lobefit.wgsl"));
    let block = |start: &str| {
        let from = readme.find(start).expect("the block") + start.len();
        readme[from..].split("```").next().expect("its end").trim()
    };
    assert!(wgsl.contains(block("```wgsl\n")), "the README's function is not the emitted one");
    let manifest: Value = serde_json::from_str(&read("manifest.json")).expect("JSON");
    for line in block("```text\n").lines() {
        let name = line.split(':').next().expect("a name");
        let figure = if name.starts_with("ggx-") {
            find(&manifest["tables"], name)["error"]["lookup"]["max"].as_f64()
        } else {
            find(&manifest["fits"], name)["certificate"]["max_abs"].as_f64()
        };
        assert!(line.contains(&format!("error {}", figure.expect("a number"))), "{line}");
    }
}
