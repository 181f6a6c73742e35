//! The pages in `docs/`: figures are those of the committed bake, study and record, code is
//! emitted, links resolve.

use std::path::Path;
use std::sync::LazyLock;

use clap::Parser;
use lobefit::bake::{Baked, Silent, bake};
use lobefit::cli::cost::{Beside, Options};
use lobefit::cli::input::{Input, load};
use lobefit::data::{Model, Vendor};
use lobefit::emit::header::short;
use lobefit::emit::include::Include;
use lobefit::plan::plan;
use lobefit::scene::Scene;
use lobefit::timing::isa::{Counts, IsaRecord, IsaRow, Precision};
use lobefit_math::correlation::Correlation;
use serde_json::Value;

use crate::baked_support::shared;
use crate::common::{lobefit, stderr};
use crate::texts::{assert_rows, assert_valid, blocks, find, json, number, pages, read, root};

/// The anchor that a heading gets.
fn anchor(heading: &str) -> String {
    let kept = heading.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
    kept.collect::<String>().trim().to_lowercase().replace(' ', "-")
}

#[test]
fn every_link_resolves() {
    for (page, text) in pages() {
        let mut targets = text.split("](").skip(1).map(|rest| rest.split(')').next().expect("its end"));
        assert!(targets.all(|target| resolves(&page, target)), "a link of {} leads nowhere", page.display());
    }
}

fn resolves(page: &Path, target: &str) -> bool {
    let (file, heading) = target.split_once('#').unwrap_or((target, ""));
    let path = match file {
        "" => page.to_path_buf(),
        _ => page.parent().expect("a folder").join(file),
    };
    println!("{}: {target}", page.display());
    let anchors = |text: String| text.lines().any(|line| line.starts_with('#') && anchor(line) == heading);
    path.exists() && (heading.is_empty() || std::fs::read_to_string(path).is_ok_and(anchors))
}

/// Largest error and RMS of a certificate, as a row shows them.
fn errors(entry: &Value) -> String {
    let certificate = &entry["certificate"];
    format!("{} | {}", number(&certificate["max_abs"]), short(number(&certificate["rms"])))
}

/// The example that asks for every formula, as `lobefit cost` reads it, and its bake.
static EVERY: LazyLock<(Input, Baked)> = LazyLock::new(|| {
    let input = load(&page_of_costs().scene).expect("a scene");
    let baked = input.bake(&plan(&input.scene), shared(), &Silent).expect("a bake");
    (input, baked)
});

#[test]
fn the_table_of_formulas_is_what_the_example_bakes() {
    let files = &EVERY.1.files;
    let manifest: Value = serde_json::from_slice(&files["manifest.json"]).expect("JSON");
    let fits = manifest["fits"].as_array().expect("a list");
    let name = |fit: &Value| fit["name"].as_str().expect("a name").to_string();
    let row = |fit: &Value| {
        let of_rms = fits.iter().find(|other| name(other) == name(fit) + "_rms");
        let of_rms = of_rms.map_or_else(|| " |".into(), |fit| format!(" {}", errors(fit)));
        let half = match &fit["half"]["max_abs"] {
            Value::Null => "not finite".to_string(),
            error => number(error).to_string(),
        };
        format!("| `{}` | {} | {} |{of_rms} | {half} |", name(fit), fit["cost"]["ops"], errors(fit))
    };
    let rows: Vec<String> = fits.iter().filter(|fit| !name(fit).ends_with("_rms")).map(row).collect();
    let begins =
        ["| `ggx_", "| `coupling_", "| `charlie_", "| `parallax_1", "| `parallax_c", "| `parallax_po"];
    assert_rows("docs/cost.md", &begins, &rows);
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::create_dir(folder.path().join("fits")).expect("a folder");
    for name in ["manifest.json", "fits/lobefit.wgsl"] {
        std::fs::write(folder.path().join(name), &files[name]).expect("written");
    }
    weights_follow(folder.path(), manifest["fits"].clone());
}

const PAGE: &str = "reports/cost.html";

/// What the command on the page of costs is read as.
fn page_of_costs() -> Options {
    #[derive(Parser)]
    struct Cost {
        #[command(flatten)]
        options: Options,
    }
    Cost::parse_from(["cost", "examples/every-formula.json", "--page", PAGE]).options
}

/// The committed page of costs is what the command on it writes, of the committed records.
#[test]
fn the_page_of_costs_follows_from_the_records() {
    let (options, (input, baked)) = (page_of_costs(), &*EVERY);
    let beside = Beside::read(&options.records).expect("records");
    let page = beside.page(input, baked, (&options, Path::new(PAGE))).expect("a page");
    assert!(page == read(PAGE), "not what `lobefit cost --page` writes");
}

/// The committed prices are those of a bake of every formula, where the records of all vendors are
/// of its code.
fn weights_follow(bake: &Path, fits: Value) {
    let wgsl = std::fs::read_to_string(bake.join("fits/lobefit.wgsl")).expect("a file");
    let include = Include::new(wgsl);
    let functions = || fits.as_array().expect("a list").iter().filter_map(|fit| fit["function"].as_str());
    for driver in DRIVERS {
        let text = read(&format!("reports/isa/{driver}-every-formula.json"));
        let record = IsaRecord::read(text.as_bytes()).expect("a record");
        let of = |name: &str| record.is_of(name, &include.hash(name).expect("emitted"));
        let other: Vec<&str> = functions().filter(|name| !of(name)).collect();
        if let Some(name) = other.first() {
            println!(
                "{driver}: {} functions are of other code ({name}, ...): prices are not compared",
                other.len()
            );
            return;
        }
    }
    let words = ["cost", "--weights", "--json", "--from", ".", "--records"].map(String::from);
    let words = [&words[..], &[root().display().to_string()]].concat();
    let output = lobefit(bake, &words.iter().map(String::as_str).collect::<Vec<_>>(), b"");
    assert!(output.status.success(), "{}", stderr(&output));
    assert_eq!(String::from_utf8(output.stdout).expect("text"), read("src/data/weights.json"));
}

/// Compilers whose counts are recorded.
const DRIVERS: [&str; 5] =
    ["radv-22.3.6", "intel-22.3.6", "adreno-22.3.6", "mali-22.3.6", "nvidia-nvrtc-12.9.86"];

#[test]
fn the_tables_of_published_formulas_are_the_reports() {
    let page = read("docs/cost.md");
    let section = page.split("## Published formulas").nth(1).and_then(|rest| rest.split("\n## ").next());
    let found: Vec<&str> = section.expect("it").lines().filter(|line| line.contains("| `")).collect();
    let reflection = json("reports/reflection.json")["approximations"].clone();
    let coupling = json("reports/diffuse-coupling.json")["lobes"][0]["approximations"].clone();
    let all = [reflection, coupling].map(|list| list.as_array().expect("a list").clone()).concat();
    let row = |a: &Value| {
        let [source, name] = ["source", "name"].map(|key| a[key].as_str().expect("a word"));
        format!("| {source} | `{name}` | {} | {} |", a["cost"]["ops"], errors(a))
    };
    let wanted: Vec<String> = all.iter().filter(|a| a["published"] == true).map(row).collect();
    assert_eq!(found, wanted, "the rows should be:\n{}\n", wanted.join("\n"));
}

fn table_row(table: &Value) -> String {
    let sizes = table["axes"].as_array().expect("axes").iter().map(|axis| axis["size"].to_string());
    let lookup = &table["error"]["lookup"];
    format!(
        "| `{}` | {} | {} | {} | {} | {} |",
        table["name"].as_str().expect("a name"),
        sizes.collect::<Vec<_>>().join(" x "),
        table["bytes"],
        table["cost"]["ops"],
        number(&lookup["max"]),
        short(number(&lookup["rms"])),
    )
}

#[test]
fn the_table_of_tables_is_the_manifests() {
    let page = read("docs/cost.md");
    let section = page.split("\n## Tables").nth(1).expect("the section");
    let found: Vec<&str> = section.lines().filter(|line| line.starts_with("| `")).collect();
    let wanted: Vec<String> =
        json("manifest.json")["tables"].as_array().expect("a list").iter().map(table_row).collect();
    assert_eq!(found, wanted, "the rows should be:\n{}\n", wanted.join("\n"));
}

#[test]
fn the_table_of_formats_is_what_the_example_bakes() {
    let example = root().join("examples/texel-formats.json");
    let scene = Scene::from_json(&std::fs::read(&example).expect("a scene"), "a scene").expect("a scene");
    let baked = bake(&scene, &plan(&scene), &[], shared(), &Silent).expect("a bake");
    let manifest: Value = serde_json::from_slice(&baked.files["manifest.json"]).expect("JSON");
    let row = |table: &Value| {
        let lookup = &table["error"]["lookup"];
        let size = &table["axes"][0]["size"];
        let (format, bytes) = (table["format"].as_str().expect("a format"), &table["bytes"]);
        let (max, rms) = (number(&lookup["max"]), short(number(&lookup["rms"])));
        format!("| {size} x {size} | `{format}` | {bytes} | {max} | {rms} |")
    };
    let rows: Vec<String> = manifest["tables"].as_array().expect("a list").iter().map(row).collect();
    assert_rows("docs/cost.md", &["| 32 x 32 | `", "| 64 x 64 | `", "| 128 x 128 | `"], &rows);
}

/// Microseconds of a call for each pixel of 3840 x 2160.
#[test]
fn the_times_are_the_records() {
    let page = read("docs/cost.md");
    let section = page.split("| what | microseconds |").nth(1).and_then(|rest| rest.split("\n\n").next());
    let found: Vec<&str> = section.expect("it").lines().filter(|line| line.contains('`')).collect();
    let record = json("reports/gpu/nvidia-h200.json");
    let rows = record["rows"].as_array().expect("a list").iter();
    let shown =
        |kind: &Value| ["fetch", "cubemap-fetch", "lookup-fetches", "table"].iter().any(|k| kind == k);
    let row = |row: &Value| {
        let microseconds = number(&row["nanoseconds"]["median"]) * f64::from(3840 * 2160) / 1000.0;
        format!("| `{}` | {microseconds:.0} |", row["name"].as_str().expect("a name"))
    };
    let wanted: Vec<String> = rows.filter(|row| shown(&row["kind"])).map(row).collect();
    assert_eq!(found, wanted, "the rows should be:\n{}\n", wanted.join("\n"));
}

/// Vector and transcendental instructions, moves and latency on three families, in f32.
#[test]
fn the_machine_instructions_are_the_records() {
    let page = read("docs/cost.md");
    let section =
        page.split("| operations | function | GCN").nth(1).and_then(|rest| rest.split("\n\n").next());
    let found: Vec<&str> = section.expect("it").lines().filter(|line| line.contains('`')).collect();
    let records = ["-every-formula", ""].map(|of| read(&format!("reports/isa/radv-22.3.6{of}.json")));
    let records = records.map(|text| IsaRecord::read(text.as_bytes()).expect("a record"));
    let rows =
        || records.iter().flat_map(|record| &record.rows).filter(|row| row.precision == Precision::F32);
    let row = |line: &&str| {
        let name = line.split('`').nth(1).expect("a name");
        let ops = records.iter().find_map(|record| record.ops(name)).expect("operations");
        let cell = |family| {
            let row = rows().find(|row| row.function == name && row.family == family).expect("a row");
            let Counts { vector, transcendental, moves, latency, .. } = row.counts;
            format!("{vector} + {transcendental}, {moves}, {}", latency.expect("stated"))
        };
        format!("| {ops} | `{name}` | {} |", ["polaris10", "navi21", "gfx1100"].map(cell).join(" | "))
    };
    let wanted: Vec<String> = found.iter().map(row).collect();
    assert!(found.len() > 8);
    assert_eq!(found, wanted, "the rows should be:\n{}\n", wanted.join("\n"));
    let pairs = |row: &IsaRow| Some((f64::from(records[0].ops(&row.function)?), row.counts.issued() as f64));
    for family in ["navi21", "gfx1100"] {
        let pairs: Vec<_> =
            records[0].rows.iter().filter(|row| row.family == family).filter_map(pairs).collect();
        let found = Correlation::of(&pairs).expect("functions");
        let shown =
            [format!("over the {} functions", found.count), format!("Pearson {:.3} with", found.values)];
        assert!(shown.iter().all(|words| page.replace('\n', " ").contains(words)), "{shown:?}");
    }
}

/// Of the lookups of masks instructions, loads, latency and cycles between waves.
#[test]
fn the_costs_of_mask_lookups_are_the_records() {
    let text = read("reports/isa/radv-22.3.6-culling.json");
    let record = IsaRecord::read(text.as_bytes()).expect("a record");
    let row = |name: &String| {
        let cell = |family| {
            let mut rows = record.rows.iter();
            let row = rows.find(|row| &row.function == name && row.family == family).expect("a row");
            let Counts { vector, transcendental, memory, latency, inverse_throughput, .. } = row.counts;
            let [latency, cycles] = [latency, inverse_throughput].map(|count| count.expect("stated"));
            format!("{vector} + {transcendental}, {memory}, {latency}, {cycles}")
        };
        let cells = ["polaris10", "navi21", "gfx1100"].map(cell).join(" | ");
        format!("| {} | `{name}` | {cells} |", record.ops(name).expect("operations"))
    };
    let rows: Vec<String> = record.functions.keys().map(row).collect();
    assert_rows("docs/occlusion.md", &["| 27 ", "| 1 ", "| 22 "], &rows);
    let stale = record.stale(&Include::new(lookups_of_masks()));
    assert!(stale.is_empty(), "{stale:?}: make the record again");
}

/// Instructions on GPUs of other vendors in f32, and what their drivers state of time.
#[test]
fn the_machine_instructions_of_other_vendors_are_the_records() {
    let page = read("docs/cost.md");
    let section =
        page.split("| operations | function | Skylake").nth(1).and_then(|rest| rest.split("\n\n").next());
    let found: Vec<&str> = section.expect("it").lines().filter(|line| line.contains('`')).collect();
    let columns = [
        ("intel-22.3.6", "skl"),
        ("intel-22.3.6", "dg2"),
        ("adreno-22.3.6", "a660"),
        ("mali-22.3.6", "g52"),
        ("nvidia-nvrtc-12.9.86", "sm_90"),
    ];
    let of = |driver: &str| {
        ["", "-every-formula"].map(|scene| {
            let text = read(&format!("reports/isa/{driver}{scene}.json"));
            IsaRecord::read(text.as_bytes()).expect("a record")
        })
    };
    let records = columns.map(|(driver, family)| (of(driver), family));
    let row = |line: &&str| {
        let name = line.split('`').nth(1).expect("a name");
        let ops = records[0].0.iter().find_map(|record| record.ops(name)).expect("operations");
        let cell = |(records, family): &([IsaRecord; 2], &str)| {
            let mut rows = records.iter().flat_map(|record| &record.rows);
            let row = rows
                .find(|row| row.function == name && row.family == *family && row.precision == Precision::F32);
            let Counts { vector, transcendental, moves, latency, slots, .. } = row.expect("a row").counts;
            let time = latency.or(slots).map_or_else(String::new, |time| format!(", {time}"));
            format!("{vector} + {transcendental}, {moves}{time}")
        };
        format!("| {ops} | `{name}` | {} |", records.each_ref().map(cell).join(" | "))
    };
    let wanted: Vec<String> = found.iter().map(row).collect();
    assert!(found.len() > 8);
    assert_eq!(found, wanted, "the rows should be:\n{}\n", wanted.join("\n"));
}

/// Correlations of the vendors' models are those that stand beside the prices.
#[test]
fn the_models_of_vendors_are_the_weights() {
    let wanted = Vendor::ALL.map(|vendor| {
        let Model { family, unit, agreement, left_out, operations, .. } = vendor.model().expect("committed");
        format!(
            "| {} ({family}) | {unit} | {:.3} | {:.3} | {:.3} |",
            vendor.word(),
            operations.pearson,
            agreement.pearson,
            left_out.pearson
        )
    });
    let begins = Vendor::ALL.map(|vendor| format!("| {} (", vendor.word()));
    assert_rows("docs/cost.md", &begins.each_ref().map(String::as_str), &wanted);
}

/// `what ignoring the azimuth costs`, rounded up to three digits, is the report's figure.
#[test]
fn the_price_of_ignoring_the_azimuth_is_the_reports() {
    let ways = json("reports/anisotropy.json")["azimuth"][0]["ways"].clone();
    let mut ways = ways.as_array().expect("a list").iter();
    let mean =
        ways.find(|way| way["name"].as_str().expect("a name").ends_with("ggx-aniso-correlated-64x64x32"));
    let max = number(&mean.expect("the table of means")["error"]["max"]);
    let shown = format!("off by up to {} ", (max * 1000.0).ceil() / 1000.0);
    assert!(read("docs/cost.md").contains(&shown), "docs/cost.md should say `{shown}`");
}

#[test]
fn the_example_hypothesis_is_the_file() {
    assert!(read("docs/fit.md").contains(read("examples/own-hypothesis.wgsl").trim()));
}

#[test]
fn every_example_is_named() {
    let page = read("docs/scene.md");
    for entry in std::fs::read_dir(root().join("examples")).expect("examples") {
        let name = entry.expect("a file").file_name().into_string().expect("UTF-8");
        let shown = page.contains(&format!("`examples/{name}`"));
        assert!(!name.ends_with(".json") || shown, "docs/scene.md does not name {name}");
    }
}

/// The WGSL of `examples/culling.json`.
fn lookups_of_masks() -> String {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = root().join("examples/culling.json").display().to_string();
    let output = lobefit(folder.path(), &["bake", &scene, "--quiet"], b"");
    assert!(output.status.success(), "{}", stderr(&output));
    std::fs::read_to_string(folder.path().join("fits/lobefit.wgsl")).expect("emitted")
}

/// Each piece of code is emitted, or the example's hypothesis, or (where it binds a texture, or on the
/// page of sub-voxels) calls what is emitted.
#[test]
fn the_code_is_what_is_emitted() {
    let (wgsl, own) = (read("fits/lobefit.wgsl"), read("examples/own-hypothesis.wgsl"));
    for (page, text) in pages().into_iter().filter(|(page, _)| !page.ends_with("README.md")) {
        for block in blocks(&text, "wgsl") {
            if block.starts_with("@group") {
                assert_valid(&format!("{wgsl}\n{block}"), &page.display().to_string());
            } else if page.ends_with("docs/occlusion.md") {
                assert_valid(&format!("{}\n{block}", lookups_of_masks()), &page.display().to_string());
            } else if !own.contains(block) {
                for piece in block.split("\n\n") {
                    assert!(wgsl.contains(piece), "{}: not emitted:\n{piece}", page.display());
                }
            }
        }
    }
}

#[test]
fn scenes_are_planned() {
    for (page, text) in pages() {
        for scene in blocks(&text, "json") {
            let output = lobefit(root(), &["plan", "-", "--quiet"], scene.as_bytes());
            assert!(output.status.success(), "{}: {}", page.display(), stderr(&output));
        }
    }
}

#[test]
fn the_output_is_the_commands() {
    let (page, manifest) = (read("docs/cost.md"), json("manifest.json"));
    let rows: Vec<Vec<&str>> =
        blocks(&page, "text")[0].lines().skip(1).map(|line| line.split_whitespace().collect()).collect();
    assert!(rows.len() > 3);
    for row in rows {
        let rest = row[5..].join(" ");
        let words = |call: &Value| {
            ["metric", "of"].map(|key| call[key].as_str().expect("a word").to_string()).join(" ")
        };
        let calls = manifest["calls"].as_array().expect("a list");
        let call = calls.iter().find(|call| call["function"] == row[0] && words(call) == rest);
        let call = call.unwrap_or_else(|| panic!("{row:?}"));
        let cost = ["ops", "fetches", "bytes"].map(|name| call["cost"][name].to_string());
        assert_eq!(cost.each_ref().map(String::as_str), row[1..4], "{row:?}");
        let error = number(&call["max_error"]);
        assert!((error - row[4].parse::<f64>().expect("a number")).abs() < 1e-3 * error, "{row:?}");
    }
}

#[test]
fn the_costs_of_lookups_are_the_manifests() {
    let lookups = json("manifest.json")["lookups"].as_array().expect("a list").clone();
    let row = |one: &Value| {
        let (name, cost) = (one["function"].as_str().expect("a name"), &one["cost"]);
        format!("| `{name}` | {} | {} |", cost["fetches"], cost["ops"])
    };
    let rows: Vec<String> = lookups.iter().map(row).collect();
    assert_rows("docs/probes.md", &["| `parallax_lookup"], &rows);
}

#[test]
fn the_total_variation_of_a_width_is_the_reports() {
    let manifest = json("manifest.json");
    let emitted = find(&manifest["fits"], "function", "parallax_width")["name"].as_str().expect("a name");
    let variations = &json("reports/parallax.json")["lobes"][0]["variations"];
    let mean = |name: &str| short(number(&find(variations, "name", name)["nearer"]["mean"]));
    let page = read("docs/probes.md").replace('\n', " ");
    for name in [emitted, "best width", "parallax_frostbite"] {
        assert!(page.contains(&mean(name)), "docs/probes.md should have {} of {name}", mean(name));
    }
}

/// What chooses a lookup, and the study's name of it.
const CHOICES: [(&str, &str); 5] = [
    ("{ \"hit\": true }", "what the engine hit, 1 fetch"),
    ("{ \"edges\": \"sharp\" }", "a box with sharp edges, 1 fetch"),
    ("{}", "a box with smooth edges, 1 fetch"),
    ("{ \"taps\": 2 }", "a box with smooth edges, 2 fetches"),
    ("{ \"taps\": 3 }", "a box with smooth edges, 3 fetches"),
];

/// Geometric means over roughness and rooms, as the study's page has them.
#[test]
fn the_errors_of_lookups_are_the_studys() {
    let rooms = json("reports/studies/parallax/results.json")["rooms"].clone();
    let mean = |method: &Value, lookup: &str| {
        let measured = rooms["random"].as_array().expect("rooms").iter();
        let measured = measured.filter(|room| lookup.starts_with("what") || room["room"] != "octagon");
        let of = |room: &Value| {
            let row = find(&room["references"][0]["rows"], "name", method.as_str().expect("a name")).clone();
            row["l2"]
                .as_array()
                .expect("errors")
                .iter()
                .map(|error| lobefit_math::ops::log(number(error)))
                .collect::<Vec<f64>>()
        };
        let logarithms: Vec<f64> = measured.flat_map(of).collect();
        lobefit_math::ops::exp(logarithms.iter().sum::<f64>() / logarithms.len() as f64)
    };
    let row = |(scene, lookup): (&str, &str)| {
        let cost = find(&rooms["costs"], "lookup", lookup);
        let own = mean(&cost["method"], lookup);
        let [listing, none] = ["Frostbite", "no parallax"].map(|name| mean(&Value::from(name), lookup) / own);
        format!("| `{scene}` | {lookup} | {} | {own:.3} | {listing:.2} | {none:.2} |", cost["operations"])
    };
    assert_rows("docs/probes.md", &["| `{"], &CHOICES.map(row));
}

/// A page's name of a lookup of the study, and the study's.
const LOOKUPS: [(&str, &str); 5] = [
    ("min(1, rho alpha), sharp edges", "min(1, ρ α)"),
    ("alpha' by areas, sharp edges", "rational, areas"),
    ("1 fetch, smooth edges", "rational, areas, smooth"),
    ("2 fetches, sharp edges", "2 fetches"),
    ("3 fetches, smooth edges", "3 fetches, smooth"),
];

#[test]
fn the_gains_of_lookups_are_the_studys() {
    let (page, study) = (read("docs/probes.md"), json("reports/studies/parallax/results.json"));
    let gains = study["chain"]["gains"].as_array().expect("gains");
    for (name, method) in LOOKUPS {
        let of = |room: &str| {
            let row = gains.iter().find(|row| row["room"] == room && row["method"] == method);
            let row = row.unwrap_or_else(|| panic!("the study has {method} in {room}"));
            let [exact, chain] = ["gain_exact", "gain_chain"].map(|key| number(&row[key]));
            format!("{exact:.2} ({chain:.2})")
        };
        let line = format!("| {name} | {} |", ["A", "B", "octagon"].map(of).join(" | "));
        assert!(page.lines().any(|l| l == line), "{line}");
    }
    let points = &study["parameters"]["chain"]["points"]["count"];
    assert!(page.contains(&format!("at {points} points")), "{points} points");
}
