//! `lobefit cost --isa`: machine code of the emitted functions, by a driver that needs no GPU.

use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::common::{lobefit, names, stderr};
use crate::emit_support::{missing, say};
use crate::gpu_support::device::INSTALL;
use lobefit::timing::isa::{IsaRecord, IsaRow, Precision};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn text(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).expect("committed")
}

/// Code, output and errors of the verb; none without a driver where the tests do not require one.
fn run(folder: &Path, options: &[&str]) -> Option<(i32, String, String)> {
    let output = lobefit(folder, &[&["cost", "--isa", "--from", "."], options].concat(), b"");
    let error = stderr(&output);
    if error.contains("no driver radv") {
        missing(&error, INSTALL);
        return None;
    }
    let printed = String::from_utf8(output.stdout).expect("text");
    Some((output.status.code().expect("a code"), printed, error))
}

/// A folder with some code, and the committed manifest.
fn baked(code: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::create_dir(folder.path().join("fits")).expect("made");
    std::fs::write(folder.path().join("fits/lobefit.wgsl"), code).expect("written");
    std::fs::write(folder.path().join("manifest.json"), text("manifest.json")).expect("written");
    folder
}

fn record(printed: &str) -> IsaRecord {
    IsaRecord::read(printed.as_bytes()).expect("a record")
}

fn find<'a>(record: &'a IsaRecord, function: &str, family: &str, precision: Precision) -> &'a IsaRow {
    let mut rows = record.rows.iter().filter(|row| row.function == function && row.family == family);
    rows.find(|row| row.precision == precision).unwrap_or_else(|| panic!("no {function} on {family}"))
}

/// Its rows of f32 and of packed f16 cannot be made.
#[test]
fn a_bake_in_half_precision_is_refused() {
    let folder = baked("enable f16;\nfn f(x: f16) -> f16 { return x + x; }\n");
    let Some((code, printed, error)) = run(folder.path(), &[]) else { return };
    assert_eq!((code, printed.as_str()), (2, ""), "{error}");
    assert!(
        error.contains("fits/lobefit.wgsl: its functions are in f16; bake without `precision`"),
        "{error}"
    );
}

#[test]
fn the_committed_record_is_what_its_compiler_makes_on_every_run() {
    let Some((code, printed, error)) = run(&root(), &["--json"]) else { return };
    assert_eq!((code, error.as_str()), (0, ""));
    assert_eq!(run(&root(), &["--json"]).expect("as before").1, printed, "two runs");
    let now = record(&printed);
    let folder = root().join("reports/isa");
    let all =
        names(&folder).into_iter().map(|name| std::fs::read_to_string(folder.join(name)).expect("text"));
    let of = |record: &IsaRecord| (record.scene.clone(), record.driver.clone());
    let committed = all.map(|text| record(&text)).find(|record| of(record) == of(&now)).expect("a record");
    if committed.compiler() != now.compiler() {
        say(&format!("compiled by {}, recorded by {}: not compared", now.compiler(), committed.compiler()));
        return;
    }
    let current = |row: &IsaRow| now.functions.get(&row.function) == committed.functions.get(&row.function);
    for row in &committed.rows {
        if current(row) {
            let again = format!("lobefit cost --isa --from . --record reports/isa/{}.json", now.compiler());
            assert_eq!(find(&now, &row.function, &row.family, row.precision), row, "{again}");
        } else {
            say(&format!("{} is of other code than in the record", row.function));
        }
    }
}

/// What is in the code, and the texture's fetch, on all families, in all precisions.
#[test]
fn instructions_are_those_of_the_function_alone() {
    let folder = baked(
        "fn ratio(x: f32, y: f32) -> f32 {\n    return 1.0 / (x * y + 2.5);\n}
fn fetched(table: texture_2d<f32>, linear: sampler, x: f32, y: f32) -> vec3<f32> {
    return textureSampleLevel(table, linear, vec2<f32>(x, y), 0.0).xyz;\n}
fn moved(place: vec3<f32>, low: vec3<f32>) -> vec3<f32> {\n    return place - low;\n}
fn large(x: f32) -> f32 {\n    return x * 70000.0;\n}\n",
    );
    let Some((code, printed, error)) = run(folder.path(), &["--json"]) else { return };
    assert_eq!((code, error.as_str()), (0, ""));
    let record = record(&printed);
    assert_eq!(record.families(), ["polaris10", "navi21", "gfx1100"]);
    for family in record.families() {
        let of = |function: &str| find(&record, function, family, Precision::F32).counts;
        let ratio = of("ratio");
        assert!(ratio.transcendental == 1 && (1..=2).contains(&ratio.vector), "{family}: {ratio:?}");
        assert_eq!((ratio.memory, ratio.scalar, ratio.spills), (0, Some(0), Some(0)), "{family}");
        assert_eq!((of("fetched").memory, of("fetched").transcendental), (1, 0), "{family}");
        assert_eq!((of("moved").vector, of("moved").memory), (3, 0), "{family}");
        let positive = [ratio.vgprs, ratio.waves, ratio.bytes, ratio.latency];
        assert!(positive.iter().all(|count| count.is_some_and(|count| count > 0)), "{family}: {ratio:?}");
        assert_eq!(ratio.slots, None, "AMD's driver states none");
        // Two reciprocals, and one of everything else.
        let packed = record.rows.iter().find(|row| {
            (row.function.as_str(), row.family.as_str(), row.precision)
                == ("ratio", family, Precision::F16Packed)
        });
        assert_eq!(packed.is_none(), family == "polaris10", "{family} has no f16");
        assert!(
            packed.is_none_or(|row| row.counts.transcendental == 2 && row.counts.vector <= ratio.vector + 2)
        );
    }
    assert!(record.rows.iter().all(|row| row.precision == Precision::F32 || row.function != "large"));
    assert_eq!(record.left_out.iter().filter(|out| out.function == "large").count(), 2, "70000 is no f16");
    let listing = run(folder.path(), &["--assembly", "ratio", "--families", "navi21"]).expect("as before").1;
    assert!(listing.starts_with("; ratio, navi21, f32\n") && listing.contains("v_rcp_f32"), "{listing}");
    let kept = record.listings.expect("machine code");
    assert_eq!((kept.family.as_str(), kept.texts.len()), ("navi21", record.functions.len()));
    let instructions = |text: &str| -> Vec<String> {
        text.split_whitespace().filter(|word| word.starts_with("v_")).map(String::from).collect()
    };
    let text = &kept.texts["ratio"];
    let first = listing.split("\n; ratio, ").next().expect("in f32");
    assert_eq!(instructions(text), instructions(first), "{text}");
    assert!(!text.contains(';'), "the bytes that encode it: {text}");
    let of_others = run(folder.path(), &["--json", "--families", "gfx1100"]).expect("as before").1;
    assert_eq!(self::record(&of_others).listings, None, "a family that does not stand for the vendor");
}

#[test]
fn a_function_of_a_file_is_that_of_its_name_with_all_beside_it() {
    let ratio = "fn ratio(x: f32, y: f32) -> f32 {\n    return 1.0 / (x * y + 2.5);\n}\n";
    let folder = baked(ratio);
    let file = |name: &str, code: &str| std::fs::write(folder.path().join(name), code).expect("written");
    file(
        "aside.wgsl",
        "const shift = 2.5;\nfn product(x: f32, y: f32) -> f32 { return x * y; }
fn aside(x: f32, y: f32) -> f32 { return 1.0 / (product(x, y) + shift); }",
    );
    file("out.wgsl", "fn out(x: f32, y: f32, z: ptr<function, f32>) { *z = 1.0 / (x * y + 2.5); }");
    let of = |options: &[&str]| {
        let output = lobefit(folder.path(), &[&["cost", "--isa", "--json"], options].concat(), b"");
        (output.status.code(), String::from_utf8(output.stdout.clone()).expect("text"), stderr(&output))
    };
    let Some((_, emitted, _)) = run(folder.path(), &["--json"]) else { return };
    let (code, printed, error) = of(&["--code", "aside.wgsl,out.wgsl"]);
    assert_eq!((code, error.as_str()), (Some(0), ""));
    let (emitted, own) = (record(&emitted), record(&printed));
    assert_eq!(own.functions.keys().collect::<Vec<_>>(), ["aside", "out"]);
    for row in emitted.rows.iter().filter(|row| row.precision == Precision::F32) {
        for name in ["aside", "out"] {
            assert_eq!(find(&own, name, &row.family, row.precision).counts, row.counts, "{name}");
        }
    }
    file("other.wgsl", ratio);
    file("wrong.wgsl", "fn wrong(");
    file("none.wgsl", "fn none(x: f32) { }");
    file("counted.wgsl", "fn counted(x: f32, n: i32) -> f32 { return x * f32(n); }");
    for (options, said) in [
        (&["--code", "other.wgsl"][..], "other.wgsl: declares no function `other`"),
        (&["--code", "wrong.wgsl"], "wrong.wgsl: "),
        (&["--code", "none.wgsl"], "none: it returns nothing"),
        (&["--code", "counted.wgsl"], "counted: the argument `n` is of a type that is not known"),
        (&["--code", "missing.wgsl"], "missing.wgsl"),
        (&["--code", "out.wgsl", "--from", "."], "cannot be used with"),
    ] {
        let (code, printed, error) = of(options);
        assert!(code == Some(2) && printed.is_empty() && error.contains(said), "{options:?}: {error}");
    }
}

#[test]
fn a_formula_that_is_dearer_by_a_multiply_add_is_named_with_its_family() {
    let code = text("fits/lobefit.wgsl");
    let folder = baked(&code);
    let at = folder.path();
    let Some((_, printed, _)) = run(at, &["--json", "--families", "navi21,polaris10"]) else { return };
    std::fs::write(at.join("r.json"), &printed).expect("written");
    let against =
        |options: &[&str]| run(at, &[&["--against", "r.json"], options].concat()).expect("as before");
    let (code_0, same, error) = against(&[]);
    assert_eq!((code_0, error.as_str()), (0, ""));
    assert!(same.ends_with(" rows compared, 0 counts grew\n"), "{same}");

    let (before, function) = code.split_once("fn ggx_energy_compensation(").expect("emitted");
    let dearer = function.replacen("return 1.0 + ", "return 1.0 + n_dot_v * 0.123 + ", 1);
    assert_ne!(dearer, function);
    std::fs::write(at.join("fits/lobefit.wgsl"), format!("{before}fn ggx_energy_compensation({dearer}"))
        .expect("written");
    let (code_1, grown, _) = against(&[]);
    assert_eq!(code_1, 1, "{grown}");
    for family in ["navi21", "polaris10"] {
        let was = find(&record(&printed), "ggx_energy_compensation", family, Precision::F32).counts.vector;
        let line = format!("ggx_energy_compensation on {family} in f32: vector ");
        let line = grown.lines().find(|l| l.starts_with(&line)).unwrap_or_else(|| panic!("{line}: {grown}"));
        assert!(line.ends_with(&format!(", recorded {was}")), "{line}");
    }
    // The factor of each channel calls it; nothing else does.
    assert!(
        grown.lines().all(|l| l.starts_with("ggx_energy_compensation") || l.contains(" grew")),
        "{grown}"
    );
    let verdict: Value = serde_json::from_str(&against(&["--json"]).1).expect("JSON");
    assert!(verdict["grown"].as_array().is_some_and(|all| !all.is_empty()));

    let other = IsaRecord { version: "1.2.3".into(), ..record(&printed) };
    std::fs::write(at.join("r.json"), other.bytes().expect("JSON")).expect("written");
    let (code_2, noted, _) = against(&[]);
    assert_eq!(code_2, 0, "{noted}");
    assert!(noted.starts_with("note: recorded by radv-1.2.3, compiled by radv-"), "{noted}");
}

#[test]
fn what_cannot_be_compiled_is_named() {
    let folder = baked(&text("fits/lobefit.wgsl"));
    let before = names(folder.path());
    for (options, said) in [
        (
            &["--families", "geforce"][..],
            "family geforce: radv: Unknown family: geforce; --families takes tahiti",
        ),
        (
            &["--families", "skl"],
            "family skl: compiling for intel takes --drivers DIR, a folder that crates/gpu/drivers/mesa.sh DIR writes",
        ),
        (
            &["--families", "g52", "--drivers", "fits"],
            "--drivers fits: holds no libpanfrost_noop_drm_shim.so; ",
        ),
        (
            &["--families", "amd,mali", "--json"],
            "--json takes families of one driver: a record is of one; found radv, mali",
        ),
        (&["--assembly", "no_such"], "--assembly no_such: no function of this name is emitted"),
        (&["--record", "counts.json"], "take a name that begins so"),
        (&["--record", "radv.txt"], "a name that ends with .json is called for"),
        (&["--against", "manifest.json"], "no record of lobefit cost --isa --record"),
        (&["--precisions", "f64"], "f64"),
        (&["--gpu"], "cannot be used with"),
        (&["examples/cloth.json"], "cannot be used with"),
    ] {
        let Some((code, printed, error)) = run(folder.path(), options) else { return };
        assert_eq!((code, printed.as_str()), (2, ""), "{options:?}: {error}");
        assert!(error.contains(said), "{options:?}: {error}");
        assert_eq!(names(folder.path()), before, "{options:?}");
    }
    std::fs::write(folder.path().join("fits/lobefit.wgsl"), "fn f(x: f32) -> f32 {\n    return y;\n}\n")
        .expect("written");
    let Some((code, _, error)) = run(folder.path(), &[]) else { return };
    assert!(code == 2 && error.contains("fits/lobefit.wgsl: "), "{error}");
}
