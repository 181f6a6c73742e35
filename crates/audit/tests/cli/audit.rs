//! `lobefit audit` from the command line: exit codes, streams, files.

use crate::common;

use common::{lobefit, names, stderr};
use lobefit::data::Smith;
use lobefit_truth::integrate::reflection::{Effort, split};
use serde_json::{Value, json};

/// An array in C of E at end points of roughness and mu.
fn array() -> String {
    let at = |i: usize| i as f64 / 15.0;
    let value = |i: usize| {
        let r = at(i % 16).max(1e-4);
        split(Smith::Correlated, r * r, at(i / 16).max(1e-4), &Effort::ladder()[1]).0
    };
    let rows: Vec<String> = (0..256).map(|i| format!("{:.6}f", value(i))).collect();
    format!("static const float table_E[256] = {{\n{}\n}};\n", rows.join(",\n"))
}

#[test]
fn a_table_is_read_judged_and_reported() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("tables.h"), array()).unwrap();
    let all = ["audit", "tables.h", "--as", "ggx-reflection", "--size", "16x16", "--out", "report"];
    let output = lobefit(folder.path(), &all, b"");
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let verdict = String::from_utf8(output.stdout.clone()).unwrap();
    assert!(verdict.contains("roughness (alpha = roughness^2) along x at end points"), "{verdict}");
    assert!(verdict.contains("mu along y at end points"), "{verdict}");
    assert!(output.stderr.is_empty(), "{}", stderr(&output));
    assert_eq!(names(&folder.path().join("report")), ["tables.h.audit.html", "tables.h.audit.json"]);
    let page = std::fs::read_to_string(folder.path().join("report/tables.h.audit.html")).unwrap();
    assert!(page.contains("<a href=\"tables.h.audit.json\" title") && page.contains("<a href=\"#verdict\">"));
    assert!(page.contains("Conventions tried") && !page.contains(&*folder.path().to_string_lossy()));
    let figures = std::fs::read(folder.path().join("report/tables.h.audit.json")).unwrap();
    // The same bytes with one thread and with two, and on standard output.
    for threads in ["1", "2"] {
        let again = [
            "audit",
            "tables.h",
            "--as",
            "ggx-reflection",
            "--size",
            "16x16",
            "--json",
            "--threads",
            threads,
        ];
        assert_eq!(lobefit(folder.path(), &again, b"").stdout, figures);
    }
    let found: Value = serde_json::from_slice(&figures).unwrap();
    assert_eq!(
        (&found["fits"], &found["verdict"]["grade"]),
        (&"whole".into(), &"FAIL".into()),
        "it is transposed"
    );
    assert!(found["verdict"]["convention"].as_str().unwrap().contains("mu along y at end points"));
    let command = "lobefit audit tables.h --as ggx-reflection --size 16x16";
    assert_eq!(found["origin"]["command"], command, "the command makes it again");
    assert_eq!(found["conventions"][0]["axes"][0]["coordinate"], "roughness");
    assert_eq!(found["conventions"][0]["axes"][1]["registration"], "endpoint");
    assert_eq!(found["channels"][0]["defects"][0]["kind"], "steps");
}

#[test]
fn points_are_drawn_for_whoever_integrates_them_again() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("tables.h"), array()).unwrap();
    let drawn = |count: &str| {
        let all =
            ["audit", "tables.h", "--as", "ggx-reflection", "--size", "16x16", "--points", count, "--json"];
        let found: Value = serde_json::from_slice(&lobefit(folder.path(), &all, b"").stdout).unwrap();
        assert!(found["origin"]["command"].as_str().unwrap().contains(&format!("--points {count}")));
        found["channels"][0]["points"].as_array().unwrap().clone()
    };
    let points = drawn("20");
    assert!(points.len() == 20 && drawn("1000").len() == 256);
    let number = |value: &Value| value.as_f64().unwrap();
    for point in points {
        let i = number(&point["texel"][0]) as usize;
        let alpha = number(&point["at"]["alpha"]);
        assert!((alpha.sqrt() - i as f64 / 15.0).abs() < 1e-6, "{point}");
        assert!((number(&point["value"]) - number(&point["truth"])).abs() < 1e-4, "{point}");
    }
}

/// The first line had the error of a lookup, a gain or a damage where `max_error` was that of a texel.
#[test]
fn the_figure_of_the_first_line_is_that_of_the_fields() {
    let folder = tempfile::tempdir().unwrap();
    let at = |i: usize| (i as f64 + 0.5) / 16.0;
    let exact = |x: usize, y: usize| split(Smith::Correlated, at(y) * at(y), at(x), &Effort::ladder()[1]);
    type Change<'a> = &'a dyn Fn(usize, usize) -> [f64; 2];
    let halves = |x: usize, y: usize| [exact(x, y).0 - exact(x, y).1, exact(x, y).1];
    let block = |x: usize, y: usize| {
        let off = (4..9).contains(&x) && (6..10).contains(&y);
        [halves(x, y)[0] + if off { 0.03 } else { 0.0 }, halves(x, y)[1]]
    };
    let gain = |x: usize, y: usize| halves(x, y).map(|v| 1.02 * v);
    let turned = |x: usize, y: usize| halves(y, x);
    let cases: [(Change, &[&str], &str, &str); 6] = [
        (&halves, &[], "lookup", "f0 A + B"),
        (&halves, &["--limit", "0.01"], "texel", ""),
        (&block, &[], "damage", "A"),
        (&block, &["--limit", "0.01"], "texel", "A"),
        (&gain, &[], "gain", "E"),
        (&turned, &[], "plain", ""),
    ];
    for (change, more, figure, of) in cases {
        let texels = (0..256).flat_map(|i| change(i % 16, i / 16)).flat_map(|v| (v as f32).to_le_bytes());
        std::fs::write(folder.path().join("t.raw"), texels.collect::<Vec<u8>>()).unwrap();
        let options = ["--size", "16x16", "--channels", "2", "--raw-format", "f32", "--json"];
        let all = [&["audit", "t.raw", "--as", "ggx-reflection"], &options[..], more].concat();
        let found: Value = serde_json::from_slice(&lobefit(folder.path(), &all, b"").stdout).unwrap();
        let line = found["verdict"]["headline"].as_str().unwrap();
        let most = found["max_error"].as_f64().unwrap();
        assert_eq!(found["figure"], figure, "{line}");
        let said = if figure == "gain" { 1.0 + most } else { most };
        let digits = if figure == "gain" { format!("{said:.4e}") } else { format!("{said:.2e}") };
        let said: f64 = digits.parse().unwrap();
        let said = if said < 1e-3 { format!(" {said:e} ") } else { format!(" {said} ") };
        assert!(line.contains(&said) && found["of"].as_str().unwrap().contains(of), "{said}: {found}");
        assert!(found["at"]["mu"].is_f64() && found["at"]["alpha"].is_f64(), "{}", found["at"]);
        let kept = all.get(12).map(|limit| most <= limit.parse().unwrap());
        assert_eq!(found["passed"].as_bool(), kept, "{line}");
    }
}

#[test]
fn the_limit_and_a_wrong_guess_are_exit_1() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("tables.h"), array()).unwrap();
    let with = |more: &[&str]| {
        let all = [&["audit", "tables.h", "--as", "ggx-reflection:E", "--size", "16x16"], more].concat();
        lobefit(folder.path(), &all, b"")
    };
    let meant = ["--axes", "roughness,mu"];
    assert_eq!(with(&[&meant[..], &["--limit", "1e-5"]].concat()).status.code(), Some(0));
    let transposed = with(&["--limit", "1e-5"]);
    assert_eq!(transposed.status.code(), Some(1));
    let told = |output: &std::process::Output| {
        assert!(output.stderr.is_empty(), "what the verdict says is said once: {}", stderr(output));
        String::from_utf8(output.stdout.clone()).unwrap()
    };
    assert!(told(&transposed).contains("say so (`--axes roughness,mu`)"), "{}", told(&transposed));
    let over = with(&[&meant[..], &["--limit", "1e-7"]].concat());
    assert_eq!(over.status.code(), Some(1));
    assert!(told(&over).contains("the limit 1e-7"), "{}", told(&over));
    let first = |output: &std::process::Output| {
        String::from_utf8_lossy(&output.stdout).lines().next().unwrap_or_default().to_string()
    };
    let line = first(&over);
    assert!(line.starts_with("FAIL ggx-reflection E: tables.h (table_E) is off by at most"), "{line}");
    assert!(line.ends_with("the limit is 1e-7"), "{line}");
    let points = String::from_utf8_lossy(&over.stdout).lines().skip(1).count();
    assert!((1..=5).contains(&points), "{points} points");
    let wrong = with(&["--axes", "mu,gloss", "--quiet"]);
    assert_eq!(wrong.status.code(), Some(1));
    assert!(wrong.stdout.is_empty());
    // Its convention is known, and the options say another.
    let told = told(&with(&["--axes", "mu,gloss"]));
    assert!(
        told.starts_with("FAIL ggx-reflection E: tables.h (table_E) is not what --axes says; "),
        "{told}"
    );
    assert!(told.contains("- Remedy: read it as it is, or make it again as --axes says\n"), "{told}");
    assert!(told.contains("\nWithout --axes: FAIL ggx-reflection E: tables.h"), "{told}");
    // Of another lobe it is read as it is.
    let lobe = ["--smith", "separable", "--axes", "roughness,mu", "--json"];
    let found: Value = serde_json::from_slice(&with(&lobe).stdout).unwrap();
    assert_eq!(
        (&found["verdict"]["grade"], &found["otherwise"]["without"]),
        (&json!("FAIL"), &json!("--smith"))
    );
    let read = &found["conventions"][0]["axes"];
    assert_eq!((&read[0]["coordinate"], &read[1]["registration"]), (&json!("roughness"), &json!("endpoint")));
    assert_eq!(names(folder.path()), ["tables.h"]);
}

#[test]
fn a_limit_is_for_the_plain_reading_and_says_how_to_declare_another() {
    let folder = tempfile::tempdir().unwrap();
    let at = |i: usize| i as f64 / 16.0;
    let value = |i: usize| {
        let r = at(i % 16).max(1e-4);
        split(Smith::Correlated, r * r, at(i / 16).max(1e-4), &Effort::ladder()[1]).0
    };
    let rows: Vec<String> = (0..256).map(|i| format!("{:.6}", value(i))).collect();
    std::fs::write(folder.path().join("t.js"), format!("const t = [{}];", rows.join(","))).unwrap();
    let with = |more: &[&str]| {
        let all =
            [&["audit", "t.js", "--as", "ggx-reflection:E", "--size", "16x16", "--limit", "1e-4"], more]
                .concat();
        lobefit(folder.path(), &all, b"")
    };
    let plain = with(&["--json"]);
    assert_eq!(plain.status.code(), Some(1), "{}", stderr(&plain));
    let told = "--axes roughness,mu --registration left,left";
    let found: Value = serde_json::from_slice(&plain.stdout).unwrap();
    let line = found["verdict"]["headline"].as_str().unwrap();
    assert!(line.contains("read plainly"), "{line}");
    let remedy = found["verdict"]["remedy"].to_string();
    assert!(remedy.contains(&format!("if it is meant so, say so (`{told}`)")), "{remedy}");
    // The figure that decides is that of the plain reading.
    assert!(found["max_error"] == found["plain"]["max"] && found["max_error"].as_f64().unwrap() > 0.02);
    let meant = with(&["--axes", "roughness,mu", "--registration", "left,left", "--json"]);
    assert_eq!(meant.status.code(), Some(0), "{}", stderr(&meant));
    let found: Value = serde_json::from_slice(&meant.stdout).unwrap();
    let command = "lobefit audit t.js --as ggx-reflection:E --axes roughness,mu --registration left,left --size 16x16 --limit 0.0001";
    assert_eq!(found["origin"]["command"], command);
}

#[test]
fn shaders_are_audited() {
    let folder = tempfile::tempdir().unwrap();
    let text = "fn half(x: f32) -> f32 { return 0.5 * x; }\nfn pesce(alpha: f32, mu: f32) -> f32 { return 1.0 + 4.0 * half(alpha) * alpha * mu; }";
    std::fs::write(folder.path().join("norm.wgsl"), text).unwrap();
    let output = lobefit(folder.path(), &["audit", "norm.wgsl", "--as", "ggx-reflection", "--json"], b"");
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(found["channels"][0]["holds"], "1/E (a normalisation)");
    assert_eq!(found["conventions"][0]["axes"][0]["axis"], "alpha");
}

/// The example of `docs/audit.md` is what the program says.
#[test]
fn the_example_of_the_page_is_the_verdict() {
    let root = std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    let page = std::fs::read_to_string(root.join("docs/audit.md")).unwrap();
    let example = page.split("```text\n$ lobefit ").nth(1).unwrap().split("```").next().unwrap();
    let (command, shown) = example.split_once('\n').unwrap();
    let words: Vec<&str> = command.split_whitespace().collect();
    let output = lobefit(root, &words, b"");
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let verdict = String::from_utf8(output.stdout).unwrap();
    let plain = |text: &str| text.split_whitespace().map(String::from).collect::<Vec<_>>();
    assert_eq!(plain(shown), plain(&verdict));
}

#[test]
fn where_a_limit_is_judged_is_said() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("tables.h"), array()).unwrap();
    let text = "fn e(alpha: f32, mu: f32) -> f32 { return sin(20.0 * alpha) * cos(13.0 * mu); }";
    std::fs::write(folder.path().join("e.wgsl"), text).unwrap();
    let with = |file: &str, more: &[&str]| {
        let all = [&["audit", file, "--as", "ggx-reflection:E"], more].concat();
        let output = lobefit(folder.path(), &all, b"");
        (output.status.code(), String::from_utf8(output.stdout.clone()).unwrap(), stderr(&output))
    };
    let (code, out, _) = with("tables.h", &["--axes", "roughness,mu", "--size", "16x16", "--limit", "1e-5"]);
    assert!(
        code == Some(0) && out.contains("is judged at the texels, which keep it; lookups between"),
        "{out}"
    );
    let (code, out, err) =
        with("tables.h", &["--axes", "roughness,mu", "--size", "16x16", "--limit", "1e-7"]);
    assert!(code == Some(1) && out.contains("at the texels, not at lookups between them"), "{out}");
    assert!(out.contains("the largest error at a texel is") && err.is_empty(), "{out}{err}");
    // A function is reported as a function; options that were not given are not mentioned.
    let (code, out, _) = with("e.wgsl", &["--limit", "0.01"]);
    assert!(code == Some(1) && out.contains("judged at those points of the arguments"), "{out}");
    assert!(out.contains("fit its constants") && !out.contains("texel") && !out.contains("table"), "{out}");
    assert!(out.contains("follows no reading of its arguments") && !out.contains("options"), "{out}");
}

/// A shader file of arrays alone was refused, as one without a function.
#[test]
fn arrays_of_a_shader_file_are_tables() {
    let folder = tempfile::tempdir().unwrap();
    let at = |i: usize| (i as f64 + 0.5) / 16.0;
    let texel = |i: usize| {
        let (e, b) = split(Smith::Correlated, at(i / 16) * at(i / 16), at(i % 16), &Effort::ladder()[1]);
        format!("({:.6}, {b:.6})", e - b)
    };
    for (file, vector, before, after) in [
        ("t.wgsl", "vec2<f32>", "const DFG = array<vec2<f32>, 256>(", ");"),
        ("t.glsl", "vec2", "const vec2 DFG[256] = vec2[256](", ");"),
        ("t.hlsl", "float2", "static const float2 DFG[256] = {", "};"),
    ] {
        let texels: Vec<String> = (0..256).map(|i| format!("{vector}{}", texel(i))).collect();
        std::fs::write(folder.path().join(file), format!("{before}{}{after}\n", texels.join(", "))).unwrap();
        let all = ["audit", file, "--as", "ggx-reflection", "--registration", "centre"];
        let output = lobefit(folder.path(), &all, b"");
        let said = String::from_utf8(output.stdout.clone()).unwrap();
        assert!(said.starts_with("PASS ggx-reflection A and B"), "{said}{}", stderr(&output));
    }
}

#[test]
fn an_index_is_tried_both_ways() {
    let folder = tempfile::tempdir().unwrap();
    let text = "fn r(eta: f32, alpha: f32, mu: f32) -> f32 {
      let c = sqrt(1.0 - eta * eta * (1.0 - mu * mu));
      let s = (eta * mu - c) / (eta * mu + c);
      return s * s * (1.0 - 0.1 * alpha);
    }";
    std::fs::write(folder.path().join("r.wgsl"), text).unwrap();
    let output = lobefit(folder.path(), &["audit", "r.wgsl", "--as", "ggx-glass:R"], b"");
    let out = String::from_utf8(output.stdout.clone()).unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(out.contains("eta given eta (eta = 1/ior)"), "{out}");
    assert!(
        out.contains("Given ior for its index it cannot be judged") && out.contains("not a finite number"),
        "{out}"
    );
}

#[test]
fn bad_usage_is_exit_2_and_writes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("tables.h"), array()).unwrap();
    let huge = std::fs::File::create(folder.path().join("huge.exr")).unwrap();
    huge.set_len((64 << 20) + 1).unwrap();
    let huge = lobefit(folder.path(), &["audit", "huge.exr", "--as", "ggx-reflection"], b"");
    assert!(huge.status.code() == Some(2), "{}", stderr(&huge));
    assert!(
        stderr(&huge).contains("(64 MiB)") && stderr(&huge).contains("largest level alone"),
        "{}",
        stderr(&huge)
    );
    std::fs::remove_file(folder.path().join("huge.exr")).unwrap();
    std::fs::write(folder.path().join("f.wgsl"), "fn f(r: f32, mu: f32) -> f32 { return r * mu; }").unwrap();
    for (arguments, expected) in [
        (&["no-such.exr", "--as", "ggx-reflection"][..], "no-such.exr"),
        (&["tables.h"], "--as"),
        (&["tables.h", "--as", "ggx-reflection:R"], "it may hold E, A, B"),
        (&["tables.h", "--as", "nothing"], "no such quantity"),
        (&["tables.h", "--as", "ggx-reflection", "--axes", "mu,height"], "no such coordinate"),
        (&["tables.h", "--as", "ggx-reflection", "--axes", "mu", "--size", "16x16"], "2 axes"),
        (&["tables.h", "--as", "ggx-reflection", "--registration", "middle"], "no such registration"),
        (&["tables.h", "--as", "ggx-reflection", "--size", "16by16"], "as 64x64"),
        (&["tables.h", "--as", "ggx-reflection", "--size", "4294967296x1"], "4294967296"),
        (&["tables.h", "--as", "ggx-reflection-aniso", "--size", "16x16"], "3 inputs"),
        (&["tables.h", "--as", "ggx-reflection", "--limit", "NaN"], "finite number"),
        (
            &["tables.h", "--as", "ggx-reflection", "--limit", "-1"],
            "'--limit <E>': a finite number, 0 or above",
        ),
        (&["tables.h", "--as", "parallax", "--limit", "1"], "no such quantity"),
        (&["tables.h", "--as", "ggx-reflection", "--set", "k=1"], "--set"),
        (&["f.wgsl", "--as", "ggx-reflection", "--size", "16x16"], "--size"),
        (&["tables.h", "--as", "ggx-reflection", "--function", "f", "--symbol", "g"], "--symbol"),
    ] {
        let all = [&["audit", "--out", "report"], arguments].concat();
        let output = lobefit(folder.path(), &all, b"");
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(expected), "{arguments:?}: {}", stderr(&output));
        assert!(output.stdout.is_empty(), "{arguments:?}");
        assert_eq!(names(folder.path()), ["f.wgsl", "tables.h"], "{arguments:?}");
    }
}

#[test]
fn a_table_that_fits_nothing_is_told_of_and_only_a_limit_fails_it() {
    let folder = tempfile::tempdir().unwrap();
    let rows: Vec<String> = (0..256).map(|i| format!("0.{:03}", i * 7919 % 1000)).collect();
    std::fs::write(folder.path().join("t.h"), format!("float t[16][16] = {{{}}};", rows.join(","))).unwrap();
    let free = lobefit(folder.path(), &["audit", "t.h", "--as", "ggx-reflection"], b"");
    assert_eq!(free.status.code(), Some(0), "{}", stderr(&free));
    let limited = ["audit", "t.h", "--as", "ggx-reflection", "--limit", "10"];
    assert_eq!(lobefit(folder.path(), &limited, b"").status.code(), Some(1));
    let help = String::from_utf8(lobefit(folder.path(), &["audit", "--help"], b"").stdout).unwrap();
    assert!(
        help.contains("the file is not what its own attribute `lobefit`, or its sidecar NAME.json, says"),
        "{help}"
    );
    let declared = lobefit(folder.path(), &["audit", "--declared"], b"").stdout;
    let declared: serde_json::Value = serde_json::from_slice(&declared).unwrap();
    let arguments = declared["arguments"].as_array().unwrap();
    assert!(arguments.iter().any(|own| own["long"] == "samples" && own["value"].is_string()), "{declared}");
}

/// A file whose audit the docs hold is named, by its bytes alone, as the quantity that it was audited as.
#[test]
fn a_shipped_file_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = include_str!("../../../../fits/hypotheses/published/ggx_blend_karis.wgsl");
    let audited = |name: &str, text: &str| {
        std::fs::write(folder.path().join(name), text).expect("written");
        let output = lobefit(folder.path(), &["audit", name, "--as", "ggx-reflection", "--json"], b"");
        let found: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        let published = &found["published"];
        assert!(published["name"] == "ggx_blend_karis" && published["made_for"] == "schlick", "{published}");
        found["verdict"]["convention"].as_str().expect("a sentence").to_string()
    };
    let known = audited("fit.wgsl", text);
    assert!(
        known.contains("It is a file of Unreal Engine (") && known.contains("Karis' fit; docs/audits.md"),
        "{known}"
    );
    let other = audited("other.wgsl", &format!("{text}\n"));
    assert!(!other.contains("It is a file"), "{other}");
}
