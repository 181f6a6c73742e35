//! The examples of docs/audit.md are what the program prints, and first lines are short.

use std::path::Path;

use crate::common::lobefit;

/// Burley's diffuse lobe of 2012.
const BURLEY: &str = "float burley(float NdotL, float NdotV, float LdotH, float roughness) {
    float most = 0.5 + 2.0 * LdotH * LdotH * roughness;
    float light = 1.0 + (most - 1.0) * pow(1.0 - NdotL, 5.0);
    float view = 1.0 + (most - 1.0) * pow(1.0 - NdotV, 5.0);
    return light * view / 3.14159265;
}
";

/// Words of a text: lines of the page are broken where they are too long for it.
fn words(text: &str) -> Vec<&str> {
    text.split_whitespace().collect()
}

#[test]
fn examples_of_the_page_are_what_is_printed() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let page = std::fs::read_to_string(root.join("docs/audit.md")).unwrap();
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("burley.hlsl"), BURLEY).unwrap();
    for (begins, at) in [("$ lobefit audit fits/", root.as_path()), ("$ lobefit furnace ", folder.path())] {
        let example = page.split("```text\n").find(|text| text.starts_with(begins)).expect("an example");
        let (command, shown) = example.split("```").next().unwrap().split_once('\n').unwrap();
        let mut arguments = words(command)[2..].to_vec();
        if begins.contains("furnace") {
            // The package's program takes what follows its verb.
            arguments.insert(0, "audit");
        }
        let said = String::from_utf8(lobefit(at, &arguments, b"").stdout).unwrap();
        assert_eq!(words(&said), words(shown), "{command}:\n{said}");
        assert!(said.lines().next().unwrap().chars().count() <= 200, "{said}");
    }
}

#[test]
fn a_first_line_is_short_however_long_the_name_is() {
    let folder = tempfile::tempdir().unwrap();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let source = std::fs::read(root.join("fits/hypotheses/published/ggx_norm_dassault.wgsl")).unwrap();
    let name = format!("{}.wgsl", "a_long_name_of_a_file_".repeat(10));
    std::fs::write(folder.path().join(&name), source).unwrap();
    let said = lobefit(folder.path(), &["audit", &name, "--as", "ggx-reflection", "--limit", "0.01"], b"");
    let said = String::from_utf8(said.stdout).unwrap();
    let line = said.lines().next().unwrap();
    assert!(line.starts_with("FAIL ggx-reflection 1/E: ") && line.ends_with("; the limit is 0.01"), "{line}");
    assert!(line.contains("leaves |E N - 1| of at most 0.119 at alpha "), "{line}");
    assert!(
        line.chars().count() <= 200 + 64 && said.lines().skip(1).all(|point| point.starts_with("- ")),
        "{said}"
    );
    assert!(said.lines().count() <= 6, "{said}");
}

/// A surface that sends back nothing, and one of which f32 leaves little: every cell has its error.
#[test]
fn every_cell_of_a_furnace_has_its_error_in_one_place_of_its_column() {
    let folder = tempfile::tempdir().unwrap();
    let source = "float f(float NdotL, float NdotV, float roughness) { return max(roughness - 0.5, 0.0) / 3.14159265; }";
    std::fs::write(folder.path().join("f.hlsl"), source).unwrap();
    let said = lobefit(folder.path(), &["audit", "furnace", "f.hlsl", "--roughness", "0.25,0.75,1"], b"");
    let said = String::from_utf8(said.stdout).unwrap();
    let rows: Vec<&str> = said.lines().skip_while(|line| !line.starts_with("roughness ")).skip(1).collect();
    assert_eq!(rows.len(), 3, "{said}");
    let places = |row: &str| -> Vec<usize> {
        row.chars().enumerate().filter(|(_, c)| *c == '\u{b1}').map(|(place, _)| place).collect()
    };
    assert_eq!(places(rows[0]).len(), 8, "{said}");
    assert!(rows.iter().all(|row| places(row) == places(rows[0])), "{said}");
}
