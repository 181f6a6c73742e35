//! Files of our own that say what they are by the sidecar beside them.

use crate::common;

use std::path::Path;
use std::sync::LazyLock;

use crate::baked_support::bake_scene;
use common::{lobefit, stderr};
use lobefit::scene::Scene;
use lobefit::store::Files;

/// Tables of two and three axes, of one, two and four channels, in f16 and f32.
const SCENE: &str = r#"{"schema_version":1,"formats":["exr","dds","ktx2","npy","raw"],"materials":[
{"name":"metal","kind":"metal","f0":1,"roughness":[0.3,1],"wants":{"tables":[{"size":[16,12],"serves":"split-sum"}]}},
{"name":"frosted","kind":"glass","ior":[1.4,1.6],"roughness":[0.5,0.6],"wants":{"tables":[{"size":[8,6,4],"format":"f32"}]}},
{"name":"brushed","kind":"metal","f0":1,"anisotropy":[0.4,0.6],"roughness":[0.5,0.6],"wants":{"tables":[
 {"layout":"azimuth","size":[8,6,4]}]}}]}"#;

const TABLES: [(&str, &str); 4] = [
    ("ggx-dfg-correlated-16x12-split-sum", "ggx-reflection"),
    ("ggx-glass-inside-correlated-8x6x4-f32", "ggx-glass"),
    ("ggx-glass-outside-correlated-8x6x4-f32", "ggx-glass"),
    ("ggx-aniso-azimuth-correlated-8x6x4", "ggx-reflection-aniso"),
];

fn baked() -> &'static Files {
    static BAKED: LazyLock<Files> = LazyLock::new(|| {
        let scene = Scene::from_json(SCENE.as_bytes(), "test.json").expect("a scene");
        bake_scene(&scene).expect("a bake").files
    });
    &BAKED
}

fn audit(folder: &Path, file: &str, quantity: &str, more: &[&str]) -> (Option<i32>, String, String) {
    let named: &[&str] = if quantity.is_empty() { &[] } else { &["--as", quantity] };
    let output = lobefit(folder, &[&["audit", file], named, more].concat(), b"");
    (output.status.code(), String::from_utf8(output.stdout.clone()).unwrap(), stderr(&output))
}

#[test]
fn point_09_a_file_with_its_sidecar_is_what_it_says_in_every_container() {
    let (files, folder) = (baked(), tempfile::tempdir().unwrap());
    let write = |name: &str, bytes: &[u8]| std::fs::write(folder.path().join(name), bytes).unwrap();
    for (path, bytes) in files.iter().filter(|(path, _)| path.starts_with("tables/")) {
        write(&path["tables/".len()..], bytes);
    }
    for (name, quantity) in TABLES {
        for extension in ["exr", "dds", "ktx2", "npy", "raw"] {
            let file = format!("{name}.{extension}");
            // What it stands for is said by an option, or by the file.
            let given = if ["exr", "ktx2", "raw"].contains(&extension) { "" } else { quantity };
            let (code, out, err) = audit(folder.path(), &file, given, &[]);
            assert!(code == Some(0) && err.is_empty(), "{file}: {out}{err}");
            let itself = match extension {
                "exr" => format!("({name})"),
                _ => "with its sidecar".into(),
            };
            let own = format!("{file} {itself} is what it says");
            assert!(
                out.starts_with(&format!("PASS {quantity} ")) && out.contains("is what it says"),
                "{out}"
            );
            // A long name ends in an ellipsis, as the 64th character or later.
            let line = out.lines().next().unwrap();
            assert!(
                line.contains(&own)
                    || line.contains(&file[..file.len().min(40)]) && line.contains('\u{2026}'),
                "{line}"
            );
            assert!(line.chars().count() <= 200 + 64, "{line}");
        }
    }
    // A file that says nothing of itself.
    let missing = |extension: &str| {
        format!(
            "; its sidecar alone.{extension}.json is missing: a table of lobefit is read as what the sidecar beside it says"
        )
    };
    for (extension, is_named) in [("dds", false), ("npy", false), ("ktx2", true)] {
        let (own, alone) = (format!("tables/{}.{extension}", TABLES[0].0), format!("alone.{extension}"));
        write(&alone, &files[&own]);
        let (code, _, err) = audit(folder.path(), &alone, "", &[]);
        let undecided = format!("{alone}: does not say which quantity it stands for");
        assert!(code == Some(2) && err.contains(&undecided), "{err}");
        // A KTX2 file of ours says who wrote it; one of others misses nothing.
        assert_eq!(err.contains(&missing(extension)), is_named, "{err}");
    }
    // A manifest of the bake lists its files by their names.
    let listed = format!("{}.npy", TABLES[0].0);
    std::fs::remove_file(folder.path().join(format!("{listed}.json"))).unwrap();
    let unknown = audit(folder.path(), &listed, "", &[]).2;
    write("manifest.json", &files["manifest.json"]);
    let known = audit(folder.path(), &listed, "", &[]).2;
    assert_eq!(
        [&unknown, &known].map(|err| err.contains(&missing("npy").replace("alone", TABLES[0].0))),
        [false, true],
        "{unknown}{known}"
    );
    let read = ["--axes", "mu,roughness", "--registration", "centre", "--smith", "correlated"];
    let (code, out, err) = audit(folder.path(), "alone.ktx2", "ggx-reflection:E", &read);
    assert!(code == Some(1) && out.contains(&missing("ktx2")[2..]) && err.is_empty(), "{out}{err}");
    // A manifest that is torn, or that cannot be read, may list it; a whole one of others does not.
    let is_named = |words: &str| {
        let (code, _, err) = audit(folder.path(), &listed, "", &[]);
        let said = format!("; manifest.json: not read ({words}");
        assert!(code == Some(2), "{err}");
        err.contains(&said) && err.contains(&format!("whether it lists {listed} is not known"))
    };
    let manifest = &files["manifest.json"];
    write("manifest.json", &manifest[..manifest.len() / 2]);
    assert!(is_named("EOF while parsing"));
    let (_, out, _) =
        audit(folder.path(), &listed, "ggx-reflection:E", &[&read[..], &["--json", "--quiet"]].concat());
    let found: serde_json::Value = serde_json::from_str(&out).unwrap();
    assert!(found["verdict"]["errors"].to_string().contains("manifest.json: not read (EOF"), "{found}");
    write(
        "manifest.json",
        String::from_utf8(manifest.clone()).unwrap().replacen("\"effects\"", "\"e\"", 1).as_bytes(),
    );
    assert!(is_named("missing field"));
    write("manifest.json", b"{\"name\": \"a page\"}");
    assert!(!is_named(""));
    std::fs::remove_file(folder.path().join("manifest.json")).unwrap();
    std::fs::create_dir(folder.path().join("manifest.json")).unwrap();
    assert!(is_named(""));
    // Another certificate, and another name of a channel.
    let (name, quantity) = TABLES[0];
    let file = format!("{name}.ktx2.json");
    let text = String::from_utf8(files[&format!("tables/{file}")].clone()).unwrap();
    let claim = text.lines().find(|l| l.contains("error (")).unwrap();
    let lie =
        format!("{}max 1e-7,{}", claim.split("max ").next().unwrap(), claim.split_once(", rms").unwrap().1);
    write(&file, text.replace(claim, &lie).as_bytes());
    let (code, out, err) = audit(folder.path(), &format!("{name}.ktx2"), quantity, &[]);
    assert!(code == Some(1) && out.contains("it is not so"), "{out}{err}");
}

#[test]
fn point_09_a_sidecar_that_is_not_that_of_the_file_is_named_and_left_aside() {
    let (files, folder) = (baked(), tempfile::tempdir().unwrap());
    let name = TABLES[0].0;
    let write = |name: &str, bytes: &[u8]| std::fs::write(folder.path().join(name), bytes).unwrap();
    for extension in ["dds", "npy", "raw"] {
        write(&format!("t.{extension}"), &files[&format!("tables/{name}.{extension}")]);
    }
    let text = |extension: &str| {
        String::from_utf8(files[&format!("tables/{name}.{extension}.json")].clone()).unwrap()
    };
    let sizes = |a: &str, b: &str| {
        text("dds").replacen(&format!("{a},\n    {b},\n"), &format!("{b},\n    {a},\n"), 1)
    };
    for (extension, sidecar, words) in [
        ("npy", format!("{{\"axes\":{}", "[".repeat(2000)), "invalid type"),
        ("npy", "{}".into(), "missing field"),
        ("npy", text("dds"), "it is that of a file of dds"),
        ("npy", text("npy").replace("\"schema_version\": 1", "\"schema_version\": 9"), "of version 9"),
        (
            "npy",
            text("npy").replace("\"bias\"", "\"bias\",\"C\""),
            "and the file ends after 896: it may be cut short",
        ),
        ("npy", text("npy").replace("16,", "18446744073709551615,"), "it does not speak of the"),
        ("dds", sizes("16", "12"), "it speaks of [12, 16] texels of 2 channels"),
    ] {
        let file = format!("t.{extension}");
        assert!(sidecar != text(extension), "{words}: nothing was changed");
        write(&format!("{file}.json"), sidecar.as_bytes());
        // One reading alone is tried: all that the file may be without its sidecar takes long.
        let read = ["--axes", "mu,roughness", "--registration", "centre", "--smith", "correlated"];
        let read = if words == "missing field" { &[][..] } else { &read[..] };
        // The verdict has it, though nothing else is to be said.
        let read = [read, &["--json", "--quiet"]].concat();
        let (code, out, err) = audit(folder.path(), &file, "ggx-reflection:E", &read);
        assert!(code.is_some_and(|c| c < 2), "{out}{err}");
        let said: serde_json::Value = serde_json::from_str(&out).unwrap();
        let said = said["verdict"]["errors"].as_array().unwrap().last().unwrap().as_str().unwrap();
        assert!(
            said.contains(&format!("{file}.json: not followed (")) && said.contains(words),
            "`{words}` in {said}"
        );
        assert!(!out.contains("is what it says"), "{out}");
    }
    // Nothing says how a raw file without one is laid out.
    let (code, _, err) = audit(folder.path(), "t.raw", "ggx-reflection", &[]);
    assert!(code == Some(2) && err.contains("state the size") && !err.contains("sidecar"), "{err}");
    // A sidecar beyond the limit is none.
    write("t.raw.json", &vec![b' '; (1 << 20) + 1]);
    let (code, _, err) = audit(folder.path(), "t.raw", "ggx-reflection", &[]);
    assert!(
        code == Some(2) && err.contains("t.raw.json: not followed (it is larger than 1048576 bytes)"),
        "{err}"
    );
}
