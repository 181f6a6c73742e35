//! The README: its commands, figures and recipes are those of the product.

use std::path::Path;
use std::process::Command;

use serde_json::Value;

use crate::common::{lobefit, stderr};
use crate::texts::{assert_rows, assert_valid, blocks, find, json, number, read};

#[test]
fn it_is_short_and_its_first_commands_run_the_main_job_and_the_tests() {
    let readme = read("README.md");
    assert!(readme.lines().count() <= 150, "{} lines", readme.lines().count());
    let commands: Vec<&str> = blocks(&readme, "sh")[0].lines().collect();
    let commands = commands.iter().map(|line| line.split('#').next().expect("a command").trim());
    assert_eq!(
        commands.collect::<Vec<_>>(),
        ["cargo run --release -- bake", "cargo test --release --workspace"]
    );
}

/// The largest departure of spheres in the furnace, as the report of the committed bake has it.
#[test]
fn the_furnace_is_the_reports() {
    let furnace = &json("reports/reflection.json")["furnace"];
    let roughness: Vec<f64> = furnace["roughness"].as_array().expect("a list").iter().map(number).collect();
    let fits = &json("manifest.json")["fits"];
    let fit = find(fits, "function", "ggx_energy_compensation")["name"].as_str().expect("a name");
    let row = |label: &str, name: &str| {
        let factors = find(&furnace["rows"], "name", name)["factors"].as_array().expect("a list");
        let worst = |i: usize| {
            let departures = factors[i].as_array().expect("a list").iter().map(|x| number(x) - 1.0);
            departures.max_by(|a, b| a.abs().total_cmp(&b.abs())).expect("a sphere")
        };
        let shown = [0.2, 0.4, 0.6, 0.8, 1.0].map(|r| {
            let i = roughness.iter().position(|&x| (x - r).abs() < 1e-9).expect("a sphere");
            format!("{:+.1} %", 100.0 * worst(i))
        });
        format!("| {label} | {} |", shown.join(" | "))
    };
    let rows = [row("single scattering", "uncompensated"), row("times `ggx_energy_compensation`", fit)];
    assert_rows("README.md", &["| single scattering", "| times `"], &rows);
    let worst = rows[0].split('|').rev().nth(1).expect("a cell").trim();
    let worst: f64 = worst.trim_end_matches(" %").parse().expect("a number");
    assert!(read("README.md").contains(&format!("by up to {:.0} %", -worst)), "{worst}");
}

/// Each function of `Which one do I take` with its operations, bytes and largest error.
#[test]
fn the_choices_are_the_manifests() {
    let manifest = json("manifest.json");
    let readme = read("README.md");
    let after = readme.split("## Which one do I take").nth(1).expect("the section");
    let section = after.split("\n## ").next().expect("its end");
    let mut rows = 0;
    for line in section.lines().filter(|line| line.contains("| `")) {
        let cells: Vec<&str> = line.split('|').map(|cell| cell.trim().trim_matches('`')).collect();
        let tables = manifest["tables"].as_array().expect("a list");
        let (cost, max) = match tables.iter().find(|table| table["function"] == cells[2]) {
            Some(entry) => (&entry["cost"], &entry["error"]["lookup"]["max"]),
            None => {
                let cost = &find(&manifest["fits"], "function", cells[2])["cost"];
                (cost, &find(&manifest["calls"], "function", cells[2])["max_error"])
            }
        };
        let wanted = format!("{} | {} | {}", cost["ops"], cost["bytes"], number(max));
        assert_eq!(cells[3..6].join(" | "), wanted, "{line}");
        rows += 1;
    }
    assert_eq!(rows, 5);
}

/// `17 operations, max error 0.015` of every function that is called, `4096 bytes, max error
/// 0.0013` of every table.
fn figures(manifest: &Value) -> Vec<String> {
    let calls = manifest["calls"].as_array().expect("a list").iter();
    let figure = |call: &Value| {
        let max = number(&call["max_error"]);
        match call["file"].is_string() {
            true => format!("{} bytes, max error {max}", call["cost"]["bytes"]),
            false => format!("{} operations, max error {max}", call["cost"]["ops"]),
        }
    };
    calls.map(figure).collect()
}

/// Each recipe is followed by the letter: its scene is baked by its command, has the stated error,
/// and the shader that calls it is valid with the emitted file.
#[test]
fn recipes_bake_and_their_calls_compile() {
    let readme = read("README.md");
    let after = readme.split("## Recipes").nth(1).expect("the section");
    let recipes: Vec<&str> = after.split("\n## ").next().expect("its end").split("\n### ").skip(1).collect();
    assert_eq!(recipes.len(), 3);
    for recipe in recipes {
        let title = recipe.lines().next().expect("a title");
        let code = ["json", "sh", "wgsl", "c"].iter().flat_map(|language| blocks(recipe, language));
        assert!(
            code.map(|block| block.trim().lines().count()).sum::<usize>() <= 10,
            "{title}: more than ten lines"
        );
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join("scene.json"), blocks(recipe, "json")[0]).expect("a file");
        let (command, comment) = blocks(recipe, "sh")[0].split_once('#').expect("what comes of it");
        let words: Vec<&str> = command.split_whitespace().collect();
        assert_eq!(words[..2], ["lobefit", "bake"], "{title}");
        let output = lobefit(folder.path(), &words[1..], b"");
        assert!(output.status.success(), "{title}: {}", stderr(&output));
        let assets = folder.path().join("assets");
        let text = |name: &str| std::fs::read_to_string(assets.join(name)).expect("a file");
        let manifest: Value = serde_json::from_str(&text("manifest.json")).expect("JSON");
        let figures = figures(&manifest);
        let mut of_tables = figures.iter().filter(|figure| figure.contains("bytes"));
        assert!(figures.iter().any(|figure| comment.contains(figure)), "{title}: {figures:?}");
        assert!(of_tables.all(|figure| comment.contains(figure)), "{title}: {figures:?}");
        match blocks(recipe, "c").first() {
            Some(code) => compile(&assets, code, title),
            None => {
                let shader = blocks(recipe, "wgsl")[0];
                assert_valid(&format!("{}\n{shader}", text("fits/lobefit.wgsl")), title);
                let glsl = recipe.split_once("In GLSL").map_or("", |(_, said)| said);
                if let Some(call) = glsl.split('`').find(|code| code.starts_with("ggx_")) {
                    assert_eq!(call, "ggx_dfg(dfg, roughness, max(n_dot_v, 1e-4))");
                    let declared = "vec3 ggx_dfg(sampler2D table, float roughness, float n_dot_v) {";
                    assert!(text("fits/lobefit.glsl").contains(declared), "{title}");
                }
            }
        }
    }
}

/// Compiles C that includes files of a folder with the compiler that links this program.
fn compile(folder: &Path, code: &str, title: &str) {
    std::fs::write(folder.join("call.c"), code).expect("a file");
    let compiler = Command::new("cc")
        .args(["-std=c99", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", "call.c"])
        .current_dir(folder)
        .output()
        .expect("a C compiler");
    assert!(compiler.status.success(), "{title}: {}", String::from_utf8_lossy(&compiler.stderr));
}
