//! Records of times on graphics processors: what `check` and `cost --page` make of them. Nothing
//! here needs a device.

use crate::common;

use std::path::Path;

use crate::baked_support::bake_scene;
use common::{lobefit, names, stderr};
use lobefit::bake::Baked;
use lobefit::emit::include::Include;
use lobefit::report::{
    GpuClock, GpuDevice, GpuKind, GpuLeftOut, GpuRecord, GpuRow, GpuSpread, Origin, SCHEMA_VERSION,
};
use lobefit::scene::Scene;
use lobefit::timing::isa::{IsaFunction, IsaRecord, IsaRow, Precision};
use lobefit::timing::listings::Listings;
use lobefit::timing::record::{METHOD, missing, page, read, stale};
use serde_json::{Value, json};

/// The two cheapest formulas of a rough base, in a bake of half a second.
const SCENE: &[u8] =
    br#"{"schema_version": 1, "name": "test", "reports": false, "pick": "all", "languages": ["wgsl"], "materials": [{"name": "m",
  "kind": "dielectric", "f0": 0.04, "roughness": 0, "base": {"roughness": [0.2, 0.3], "max_ops": 6}}]}"#;

/// The function of [`SCENE`] that records are about.
const NAME: &str = "eon_e_5";

/// A scene whose bake takes no time: it calls for no effect.
const SMOOTH: &[u8] = include_bytes!("../../examples/mirrors.json");

fn run(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    run_on(SCENE, folder, arguments)
}

fn run_on(scene: &[u8], folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    let output = lobefit(folder, arguments, scene);
    let text = String::from_utf8(output.stdout.clone()).expect("text");
    (output.status.code().expect("a code"), text, stderr(&output))
}

/// A function that is recorded to have been cheaper, in other code.
#[test]
fn check_fails_where_a_function_compiles_to_more_than_its_record_says() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    assert_eq!(run(at, &["bake", "-", "--quiet"]).0, 0);
    let (code, printed, error) = run(at, &["cost", "--isa", "--from", ".", "--families", "navi21", "--json"]);
    if error.contains("is not built") || error.contains("no driver radv") {
        let required = std::env::var("LOBEFIT_REQUIRE_TOOLS").is_ok_and(|v| v == "1");
        assert!(!required, "{error}; LOBEFIT_REQUIRE_TOOLS=1 asks for it");
        return;
    }
    assert_eq!((code, error.as_str()), (0, ""));
    let made = IsaRecord::read(printed.as_bytes()).expect("a record");
    let (name, file) = (NAME, format!("reports/isa/{}.json", made.compiler()));
    std::fs::create_dir_all(at.join("reports/isa")).expect("a folder");
    let put = |record: &IsaRecord| {
        std::fs::write(at.join(&file), record.bytes().expect("JSON")).expect("written");
        run(at, &["check", "-"])
    };
    let (code, text, _) = put(&made);
    assert!(code == 0 && !text.contains("note:"), "{text}");

    let mut old = made.clone();
    let of = |row: &IsaRow| row.function == name;
    old.functions.insert(name.into(), IsaFunction::of(&"0".repeat(64), Some(1)));
    let (code, text, _) = put(&old);
    let note = format!("note: {file}: 1 function is of other code than the bake's ({name}); compile again");
    assert!(code == 0 && text.contains(&note), "{text}");
    let single = |row: &&IsaRow| of(row) && row.precision == Precision::F32;
    let vector = made.rows.iter().find(single).expect("its row").counts.vector;
    old.rows.iter_mut().filter(|row| of(row)).for_each(|row| row.counts.vector -= 1);
    let (code, text, _) = put(&old);
    let more = format!("{name} on navi21 in f32: vector {vector}, recorded {}", vector - 1);
    assert!(code == 1 && text.contains(&more), "{text}");

    old.version = "1.2.3".into();
    let (code, text, _) = put(&old);
    assert!(code == 0 && text.contains("not compared: compiled by "), "{text}");
    old.driver = "intel".into();
    let (code, text, _) = put(&old);
    assert!(code == 0 && text.contains("not compared: ") && text.contains("takes --drivers DIR"), "{text}");
    old.scene = "another".into();
    let (code, text, _) = put(&old);
    assert!(code == 0 && !text.contains("note:"), "{text}");
    std::fs::write(at.join(&file), "{}").expect("written");
    let (code, text, _) = run(at, &["check", "-"]);
    assert!(code == 1 && text.contains("no record of lobefit cost --isa --record"), "{text}");
}

/// Machine code of a record stands on the page of costs where it is of the code at hand.
#[test]
fn machine_code_stands_on_the_page_of_costs() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    std::fs::write(at.join("scene.json"), SCENE).expect("written");
    let (code, _, error) = run(at, &["bake", "scene.json"]);
    assert_eq!(code, 0, "{error}");
    let scene = Scene::from_json(SCENE, "scene.json").expect("a scene");
    let baked = bake_scene(&scene).expect("a bake");
    let hash = Include::of(&baked.files).and_then(|include| include.hash(NAME)).expect("the function");
    let mut record = IsaRecord {
        schema_version: lobefit::timing::isa::VERSION,
        command: "lobefit cost --isa".into(),
        scene: "test".into(),
        driver: "radv".into(),
        version: "1".into(),
        left_out: Vec::new(),
        functions: [(NAME.into(), IsaFunction::of(&hash, Some(5)))].into(),
        rows: Vec::new(),
        listings: Some(Listings {
            family: "navi21".into(),
            texts: [(NAME.into(), "v_add_f32 v0, v1, v2 ; <&>".into())].into(),
        }),
    };
    std::fs::create_dir_all(at.join("reports/isa")).expect("a folder");
    let page = |bytes: &[u8]| {
        std::fs::write(at.join("reports/isa/radv-1.json"), bytes).expect("written");
        let (code, _, error) = run(at, &["cost", "scene.json", "--page", "page.html"]);
        (code, error, std::fs::read_to_string(at.join("page.html")).unwrap_or_default())
    };
    let bytes = record.bytes().expect("JSON");
    assert_eq!(IsaRecord::read(&bytes).as_ref(), Ok(&record));
    let (code, error, html) = page(&bytes);
    assert_eq!(code, 0, "{error}");
    assert!(html.contains("<summary>Machine code of 1 formula</summary>"));
    assert!(html.contains("v_add_f32 v0, v1, v2 ; &lt;&amp;&gt;"));
    record.functions.insert(NAME.into(), IsaFunction::of(&"0".repeat(64), Some(5)));
    let (_, _, html) = page(&record.bytes().expect("JSON"));
    assert!(!html.contains("Machine code of"), "of other code");
    let torn = String::from_utf8(bytes).expect("text").replace("\"packed\": \"", "\"packed\": \"AAAA");
    let (code, error, _) = page(torn.as_bytes());
    assert!(code == 2 && error.contains("radv-1.json: no record of lobefit cost --isa --record"), "{error}");
}

fn row(name: &str, function: Option<&str>, code: Option<String>) -> GpuRow {
    // As files hold them: in nine digits.
    let digits = |x: f64| format!("{x:.8e}").parse::<f64>().expect("a number");
    let spread = |median: f64| GpuSpread { low: digits(0.9 * median), median, high: digits(1.1 * median) };
    GpuRow {
        name: name.into(),
        kind: if function.is_some() { GpuKind::Fit } else { GpuKind::Fetch },
        function: function.map(String::from),
        code,
        ops: function.map(|_| 3),
        fetches: u32::from(function.is_none()),
        error: None,
        evaluations: 64,
        loop_nanoseconds: 0.001,
        nanoseconds: spread(0.000_25),
        ratio: spread(1.25),
        evaluations_per_second: Some(4e12),
        against: None,
    }
}

fn record(rows: Vec<GpuRow>) -> GpuRecord {
    GpuRecord {
        origin: Origin {
            scene: "test".into(),
            recipe: "0".repeat(64),
            tool: "0.1.0".into(),
            command: "lobefit cost --gpu --record FILE.json".into(),
            pages: Vec::new(),
        },
        method: METHOD,
        device: GpuDevice {
            adapter: "Some <Device>".into(),
            kind: "discrete".into(),
            driver: "some driver 1.2".into(),
            backend: "vulkan".into(),
        },
        clock: GpuClock::Timestamps,
        threads: 1 << 22,
        repeats: 15,
        reduced: false,
        rows,
        left_out: Vec::new(),
    }
}

fn put(folder: &Path, record: &GpuRecord) {
    put_as(folder, "device", record);
}

fn put_as(folder: &Path, stem: &str, record: &GpuRecord) {
    let (html, figures) = page(record).expect("a page");
    let at = folder.join("reports/gpu");
    std::fs::create_dir_all(&at).expect("a folder");
    std::fs::write(at.join(format!("{stem}.json")), figures).expect("written");
    std::fs::write(at.join(format!("{stem}.html")), html).expect("written");
}

/// A record that says of every fit of a bake but `timed` why it has no time.
fn whole(folder: &Path, timed: &str, rows: Vec<GpuRow>) -> GpuRecord {
    let manifest = std::fs::read(folder.join("manifest.json")).expect("a manifest");
    let manifest: Value = serde_json::from_slice(&manifest).expect("JSON");
    let fits = manifest["fits"].as_array().expect("fits").iter();
    let others = fits.filter_map(|fit| fit["function"].as_str()).filter(|function| *function != timed);
    let out = |function: &str| GpuLeftOut { function: function.into(), reason: "a test".into() };
    GpuRecord { left_out: others.map(out).collect(), ..record(rows) }
}

#[test]
fn check_tells_which_times_are_of_other_code_and_does_not_fail() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    assert_eq!(run(at, &["bake", "-", "--quiet"]).0, 0);
    let include = Include::new(std::fs::read_to_string(at.join("fits/lobefit.wgsl")).expect("an include"));
    let current = row(NAME, Some(NAME), include.hash(NAME));
    assert!(current.code.is_some(), "the scene's bake has the function");
    put(at, &whole(at, NAME, vec![row("fetch", None, None), current.clone()]));
    let (code, text, _) = run(at, &["check", "-"]);
    assert_eq!(code, 0, "{text}");
    assert!(!text.contains("note:") && text.contains("follow from their recipe"), "{text}");

    let other = row(NAME, Some(NAME), Some("0".repeat(64)));
    let gone = row("gone", Some("no_such_function"), Some("0".repeat(64)));
    put(at, &whole(at, NAME, vec![current.clone(), other, gone]));
    let (code, text, _) = run(at, &["check", "-"]);
    assert_eq!(code, 0, "{text}");
    assert!(
        text.contains("reports/gpu/device.json: 2 of 3 times on Some <Device> are of other code"),
        "{text}"
    );
    let verdict: Value = serde_json::from_str(&run(at, &["check", "-", "--json"]).1).expect("JSON");
    assert_eq!(verdict["same"], true);
    assert_eq!(verdict["records"][0]["stale"], json!([NAME, "gone"]));

    // A function that came after the record.
    put(at, &whole(at, NAME, vec![row("fetch", None, None)]));
    let (code, text, _) = run(at, &["check", "-"]);
    assert_eq!(code, 0, "{text}");
    let note = format!("1 of the bake's functions are not timed on Some <Device> ({NAME}); measure again");
    assert!(text.contains(&note), "{text}");
    let verdict: Value = serde_json::from_str(&run(at, &["check", "-", "--json"]).1).expect("JSON");
    assert_eq!(verdict["records"][0]["missing"], json!([NAME]));
    assert_eq!(verdict["records"][0]["stale"], json!([]));

    // Another way of measuring makes all of them others, plain fetches among them.
    let old = GpuRecord { method: METHOD + 1, ..record(vec![row("fetch", None, None), current]) };
    put(at, &old);
    let (code, text, _) = run(at, &["check", "-"]);
    assert_eq!(code, 0, "{text}");
    assert!(text.contains("2 of 2 times"), "{text}");
    put(at, &GpuRecord { origin: Origin { scene: "another".into(), ..old.origin.clone() }, ..old });
    let (code, text, _) = run(at, &["check", "-"]);
    assert!(code == 0 && !text.contains("note:"), "{text}");
}

#[test]
fn check_fails_where_a_record_is_none_or_its_page_is_of_another() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    assert_eq!(run_on(SMOOTH, at, &["bake", "-", "--quiet"]).0, 0);
    let path = |name: &str| at.join("reports/gpu").join(name);
    put(at, &record(vec![row("fetch", None, None)]));
    std::fs::write(path("device.html"), "another page").expect("written");
    let (code, text, _) = run_on(SMOOTH, at, &["check", "-"]);
    assert_eq!(code, 1, "{text}");
    assert!(text.contains("make it with lobefit cost --page reports/gpu/device.json"), "{text}");
    assert!(text.contains("1 fault in records"), "{text}");
    let (code, text, error) = run_on(SMOOTH, at, &["cost", "--page", "reports/gpu/device.json"]);
    assert_eq!((code, error.as_str()), (0, ""), "{text}");
    assert_eq!(run_on(SMOOTH, at, &["check", "-"]).0, 0, "as the message says");

    // A figure that is not the record's, on a page that names it.
    let html = std::fs::read_to_string(path("device.html")).expect("a page");
    let edited = html.replacen("1.25", "1.24", 1);
    assert_ne!(html, edited);
    std::fs::write(path("device.html"), edited).expect("written");
    let (code, text, _) = run_on(SMOOTH, at, &["check", "-"]);
    assert_eq!(code, 1, "{text}");
    assert!(text.contains("not the page of reports/gpu/device.json"), "{text}");
    std::fs::write(path("device.html"), html).expect("written");

    put_as(at, "again.json", &record(vec![row("fetch", None, None)]));
    let (code, text, _) = run_on(SMOOTH, at, &["check", "-"]);
    assert_eq!(code, 0, "again.json.json has the page again.json.html: {text}");

    std::fs::write(path("device.json"), "{\"schema_version\": 1}").expect("written");
    let (code, text, _) = run_on(SMOOTH, at, &["check", "-"]);
    assert_eq!(code, 1, "{text}");
    assert!(text.contains("reports/gpu/device.json: no record of lobefit cost --gpu --record"), "{text}");

    std::fs::remove_file(path("device.json")).expect("removed");
    let (code, text, _) = run_on(SMOOTH, at, &["check", "-"]);
    assert_eq!(code, 1, "{text}");
    assert!(text.contains("reports/gpu/device.html: extra"), "{text}");
}

#[test]
fn a_page_is_written_again_from_its_record_and_from_nothing_else() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    let made = record(vec![row("fetch", None, None), row("a<b", Some("a<b"), Some("0".repeat(64)))]);
    let (html, figures) = page(&made).expect("a page");
    assert!(html.contains("a&lt;b") && html.contains("Some &lt;Device&gt;"), "names are escaped");
    assert_eq!(read(&figures).expect("a record"), made);
    std::fs::write(at.join("one.json"), &figures).expect("written");
    let (code, _, error) = run(at, &["cost", "--page", "one.json"]);
    assert_eq!((code, error.as_str()), (0, ""));
    assert_eq!(std::fs::read_to_string(at.join("one.html")).expect("written"), html);
    assert_eq!(std::fs::read(at.join("one.json")).expect("kept"), figures);

    let changed = |key: &str, value: Value| {
        let mut document: Value = serde_json::from_slice(&figures).expect("JSON");
        *document.pointer_mut(key).expect("a key of the record") = value;
        document.to_string()
    };
    for (text, expected) in [
        ("{".to_string(), "no record of lobefit cost --gpu"),
        (changed("/schema_version", json!(SCHEMA_VERSION + 1)), "schema_version 2, this version reads 1"),
        (changed("/rows/1/loop_nanoseconds", json!(0.0)), "a<b: loop_nanoseconds is not a positive number"),
        (changed("/rows/1/ratio/low", json!(-1.0)), "a<b: ratio is not a positive number"),
        (changed("/clock", json!("sundial")), "sundial"),
    ] {
        std::fs::write(at.join("two.json"), &text).expect("written");
        let (code, _, error) = run(at, &["cost", "--page", "two.json"]);
        assert_eq!(code, 2, "{text}");
        assert!(error.contains("two.json: ") && error.contains(expected), "{error}");
        assert!(!names(at).contains(&"two.html".to_string()));
    }
}

#[test]
fn code_is_that_of_a_function_and_of_what_it_calls() {
    let text = |inner: &str, head: &str| {
        format!(
            "{head}\nstruct pair {{\n    a: f32,\n}}\nfn inner(x: f32) -> f32 {{\n    {inner}\n}}\n\n\
             fn outer(x: f32) -> pair {{\n    // a note\n    return pair(inner(x));\n}}\nfn apart() -> f32 {{\n    return 1.0;\n}}\n"
        )
    };
    let hash = |text: String, name: &str| Include::new(text).hash(name);
    let first = || text("return x;", "/// one head");
    assert!(hash(first(), "outer").is_some());
    assert_eq!(
        hash(first(), "outer"),
        hash(text("return x;", "/// another head"), "outer"),
        "comments are none"
    );
    assert_ne!(hash(first(), "outer"), hash(text("return 2.0 * x;", ""), "outer"), "what it calls is of it");
    assert_eq!(hash(first(), "apart"), hash(text("return 2.0 * x;", ""), "apart"), "and nothing else");
    assert_eq!(hash(first(), "none"), None);
    let code = Include::new(first()).code("outer").expect("a function");
    assert!(code.contains("struct pair") && code.contains("fn inner") && !code.contains("apart"), "{code}");
}

/// The bake of a table whose texels have a format.
fn textured(format: &str) -> Baked {
    let scene = format!(
        r#"{{"schema_version": 1, "pick": "all", "materials": [{{"name": "m", "kind": "metal", "f0": 0.9, "roughness": [0.5, 0.6],
           "wants": {{"tables":[{{"size": [4, 4]{format}}}]}}}}]}}"#
    );
    let scene = Scene::from_json(scene.as_bytes(), "test.json").expect("a scene");
    bake_scene(&scene).expect("a bake")
}

#[test]
fn a_table_of_other_texels_makes_its_time_one_of_other_code() {
    let [half, single] = ["", r#", "format": "f32""#].map(textured);
    let table = |baked: &Baked| -> String {
        let manifest: Value = serde_json::from_slice(&baked.files["manifest.json"]).expect("JSON");
        manifest["tables"][0]["function"].as_str().expect("a name").to_string()
    };
    let include = |baked: &Baked| Include::of(&baked.files).expect("an include");
    let name = table(&half);
    let of = |baked: &Baked| row(&name, Some(&name), include(baked).hash(&name));
    assert!(of(&half).code.is_some());
    let text = include(&half).text;
    assert_ne!(of(&half).code, Include::new(text).hash(&name), "texels are of the hash");
    assert_eq!(stale(&record(vec![of(&half)]), &half), Vec::<String>::new());
    assert_eq!(missing(&record(vec![of(&half)]), &half), Vec::<String>::new());
    assert_eq!(missing(&record(Vec::new()), &half), [name.as_str()]);
    assert_eq!(stale(&record(vec![of(&half)]), &single), [name.as_str()]);
    assert_eq!(missing(&record(vec![of(&half)]), &single).is_empty(), table(&single) == name);
}

#[test]
fn quartiles_are_values_of_the_list() {
    let spread = |values: &[f64]| GpuSpread::of(values).map(|s| [s.low, s.median, s.high]);
    assert_eq!(spread(&[]), None);
    assert_eq!(spread(&[2.0]), Some([2.0; 3]));
    assert_eq!(spread(&[5.0, 1.0, 4.0, 2.0, 3.0]), Some([2.0, 3.0, 4.0]));
    let all: Vec<f64> = (0..15).rev().map(f64::from).collect();
    assert_eq!(spread(&all), Some([4.0, 7.0, 11.0]));
}

#[test]
fn options_that_do_not_go_together_are_wrong_usage() {
    let folder = tempfile::tempdir().expect("a folder");
    for arguments in [
        &["cost", "--adapter", "x"][..],
        &["cost", "--reduced"],
        &["cost", "--record", "a.json"],
        &["cost", "--gpu", "--out", "x"],
        &["cost", "--gpu", "--page", "a.json"],
        &["cost", "--page", "a.txt"],
        &["cost", "--page", "no-such.json"],
    ] {
        let (code, text, error) = run(folder.path(), arguments);
        assert_eq!((code, text.as_str()), (2, ""), "{arguments:?}: {error}");
        assert!(!error.is_empty() && names(folder.path()).is_empty(), "{arguments:?}");
    }
}

/// A formula with half of the error of one of the bake, as a search might find it.
#[test]
fn what_a_longer_search_finds_stands_on_the_page_of_costs() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    std::fs::write(at.join("scene.json"), SCENE).expect("written");
    let (code, _, error) = run(at, &["bake", "scene.json"]);
    assert_eq!(code, 0, "{error}");
    let manifest: Value =
        serde_json::from_slice(&std::fs::read(at.join("manifest.json")).expect("a file")).expect("JSON");
    let fit = &manifest["fits"][0];
    let error = fit["certificate"]["max_abs"].as_f64().expect("an error");
    let mut record = json!({"schema_version": SCHEMA_VERSION, "command": "lobefit fit --search"});
    for key in ["quantity", "column", "use"] {
        record[key] = fit[key].clone();
    }
    record["domain"] = fit["certificate"]["domain"].clone();
    record["found"] = json!([{"ops": fit["cost"]["ops"], "max_abs": 0.5 * error}]);
    let searches = at.join("reports/searches");
    std::fs::create_dir_all(&searches).expect("a folder");
    let page = |record: &Value| {
        std::fs::write(searches.join("found.json"), record.to_string()).expect("written");
        let (code, _, error) = run(at, &["cost", "scene.json", "--page", "page.html"]);
        (code, error, std::fs::read_to_string(at.join("page.html")).unwrap_or_default())
    };
    let (code, message, html) = page(&record);
    assert_eq!(code, 0, "{message}");
    let section = html.split("What a longer search finds").nth(2).expect("a link and a section");
    assert!(section.contains("Found by lobefit fit --search.") && section.contains(">2.00<"), "{section}");
    let half = record["found"][0]["max_abs"].take();
    record["found"][0]["max_abs"] = json!(error);
    let (_, _, html) = page(&record);
    let section = html.split("What a longer search finds").nth(2).expect("a link and a section");
    assert!(section.contains("was found at every budget. Found by") && !section.contains("<th"), "{section}");
    record["found"][0]["max_abs"] = half;
    let (code, printed, error) = run(at, &["check", "scene.json"]);
    assert!(code == 0 && printed.contains("follow from their recipe\n"), "{printed}{error}");
    record["domain"]["mu"] = json!([0.5, 1.0]);
    let (code, _, html) = page(&record);
    assert!(code == 0 && !html.contains("What a longer search finds"), "errors over another domain");
    record["fits"] = json!([]);
    let (code, error, _) = page(&record);
    let says = "found.json: no record of lobefit fit --search --record: unknown field `fits`";
    assert!(code == 2 && error.contains(says), "{error}");
}
