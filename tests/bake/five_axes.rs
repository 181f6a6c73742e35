//! A table of five axes: in pieces and whole the same bytes, in the order that its files state, looked up as
//! it was measured; a texel that differs is named by its five indices.

use std::fs;

use lobefit_truth::integrate::aniso::glass::glass;
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::optics::Smith;
use serde_json::Value;

use crate::common::{bytes, lobefit, stderr};

const SCENE: &str = r#"{"schema_version": 1, "formats": ["npy", "raw", "exr"], "reports": false, "languages": ["wgsl", "c"],
  "materials": [{"name": "brushed glass", "kind": "glass", "ior": [1.3, 1.7], "roughness": [0.4, 0.8], "anisotropy": [0, 0.9],
  "wants": {"tables": [{"size": [3, 2, 2, 2, 2], "format": "f32"}]}}]}"#;

#[test]
fn pieces_are_the_whole_its_texels_the_truth_and_a_bad_one_has_five_indices() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    fs::write(at.join("scene.json"), SCENE).unwrap();
    let run = |arguments: &[&str], code: i32| {
        let output = lobefit(at, arguments, b"");
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {}", stderr(&output));
        String::from_utf8_lossy(&output.stdout).into_owned() + &stderr(&output)
    };
    run(&["bake", "scene.json", "--out", "whole", "--quiet"], 0);
    for piece in ["1/2", "2/2"] {
        run(&["bake", "scene.json", "--shard", piece, "--out", "shards", "--quiet"], 0);
    }
    run(&["merge", "scene.json", "--shards", "shards", "--out", "merged", "--quiet"], 0);
    assert!(bytes(&at.join("merged")) == bytes(&at.join("whole")));
    run(&["check", "scene.json", "--against", "whole"], 0);

    let stem = "tables/ggx-glass-aniso-inside-correlated-3x2x2x2x2-f32";
    let npy = at.join("whole").join(format!("{stem}.npy"));
    let mut file = fs::read(&npy).unwrap();
    assert!(String::from_utf8_lossy(&file[..128]).contains("'shape': (2, 2, 2, 2, 3)"));
    // mu 1, azimuth 0 of x (cos^2 phi = 1), roughness 0.4, anisotropy 0.9, ior 1.3.
    let texel = 2 + 3 * (1 + 2 * 2);
    let value = f32::from_le_bytes(file[128 + 4 * texel..][..4].try_into().unwrap());
    let aspect = (1.0 - 0.9 * 0.9_f64).sqrt();
    let alpha = [0.16 / aspect, 0.16 * aspect];
    let truth = glass(Smith::Correlated, alpha, [1.0, 0.0], (1.3, Side::Inside), 1e-6).unwrap();
    assert!((f64::from(value) - truth.loss).abs() < 1.1e-4, "{value} {truth:?}");

    let manifest: Value = serde_json::from_slice(&fs::read(at.join("whole/manifest.json")).unwrap()).unwrap();
    for table in manifest["tables"].as_array().unwrap() {
        assert_eq!(table["axes"].as_array().unwrap().len(), 5, "{table}");
        let error = table["error"]["lookup"]["max"].as_f64().unwrap();
        assert!((1e-3..0.3).contains(&error), "{table}");
    }

    file[128 + 4 * texel + 2] ^= 0x40;
    fs::write(&npy, file).unwrap();
    let said = run(&["check", "scene.json", "--against", "whole"], 1);
    assert!(said.contains("column 2, row 1, slice 0, 1, 0: "), "{said}");
}
