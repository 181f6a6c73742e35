//! `lobefit cost --gpu` as its users call it.

use crate::common::{lobefit, names, stderr};
use lobefit::timing::record::read;

/// A fit and a small table.
const SCENE: &str = r#"{"schema_version": 1, "name": "test", "materials": [
    {"name": "m", "kind": "metal", "f0": 0.9, "roughness": [0.4, 0.6],
     "wants": {"fit": {"norms": ["max"], "max_ops": 5}, "tables": [{"size": [8, 8]}]}}]}"#;

#[test]
fn the_verb_writes_a_record_and_its_page_and_names_a_device_that_is_not_there() {
    let folder = tempfile::tempdir().expect("a folder");
    let run = |options: &[&str]| {
        let output = lobefit(
            folder.path(),
            &[&["cost", "-", "--gpu", "--reduced"], options].concat(),
            SCENE.as_bytes(),
        );
        (output.status.code(), output.stdout.clone(), stderr(&output))
    };
    let (code, _, error) = run(&["--adapter", "no such device", "--record", "out/a.json"]);
    assert_eq!(code, Some(2), "{error}");
    assert!(error.contains("no graphics processor whose name holds `no such device`"), "{error}");
    assert!(names(folder.path()).is_empty());
    let (code, printed, error) = run(&["--record", "out/a.json", "--json"]);
    if error.contains("no graphics processor") {
        let required = std::env::var("LOBEFIT_REQUIRE_TOOLS").is_ok_and(|v| v == "1");
        assert!(!required, "{error}; LOBEFIT_REQUIRE_TOOLS=1 asks for a Vulkan driver");
        return;
    }
    assert_eq!(code, Some(0), "{error}");
    assert_eq!(names(&folder.path().join("out")), ["a.html", "a.json"]);
    assert_eq!(std::fs::read(folder.path().join("out/a.json")).expect("written"), printed);
    let record = read(&printed).expect("a record");
    assert_eq!((record.origin.scene.as_str(), record.reduced), ("test", true));
}

#[test]
fn wrong_usage_is_exit_2() {
    let folder = tempfile::tempdir().expect("a folder");
    for (arguments, said) in [
        (&["cost", "-"][..], "--gpu, --isa or --weights is called for"),
        (&["cost", "-", "--gpu", "--record", "a.txt"], "a name that ends with .json is called for"),
        (&["cost", "-", "--gpu", "--out", "x"], "cannot be used with"),
    ] {
        let output = lobefit(folder.path(), arguments, SCENE.as_bytes());
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(stderr(&output).contains(said), "{arguments:?}: {}", stderr(&output));
        assert!(names(folder.path()).is_empty());
    }
}
