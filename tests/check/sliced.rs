//! `lobefit check` on a table of three axes: a texel that was changed is found by column, row and
//! slice, and measured against the stated error.

use crate::common;
use crate::sliced_support;

use std::path::Path;

use common::{lobefit, stderr};
use lobefit::bake::Baked;
use lobefit::data::Table;
use lobefit::emit::exr;
use sliced_support::baked;

/// Sizes that differ, so that a transposition shows.
const SCENE: &str = r#"{"schema_version":1,"reports":false,"languages":["wgsl"],"materials":[
{"name":"frosted","kind":"glass","ior":[1.4,1.6],"roughness":[0.5,0.6],"wants":{"tables":[{"size":[8,6,4],"format":"f32"}]}},
{"name":"brushed","kind":"metal","f0":1,"anisotropy":[0.4,0.6],"roughness":[0.5,0.6],"wants":{"tables":[
 {"size":[8,6,4]},{"layout":"azimuth","size":[8,6,4]}]}}]}"#;

fn check(folder: &Path, options: &[&str]) -> (i32, String) {
    let output = lobefit(folder, &[&["check", "-"], options].concat(), SCENE.as_bytes());
    assert_eq!(stderr(&output), "");
    (output.status.code().expect("a code"), String::from_utf8(output.stdout).expect("text"))
}

/// Writes the table with one texel of a channel changed: column 5, row 4, slice 2.
fn plant(folder: &Path, baked: &Baked, name: &str, channel: usize, change: impl Fn(f64) -> f64) {
    let found = baked.tables.iter().find(|v| v.approximation.name == name).expect("the table");
    let mut table: Table = found.table().expect("texels").clone();
    let texel = &mut table.channels[channel].texels[(2 * 6 + 4) * 8 + 5];
    *texel = change(*texel);
    let path = folder.join(format!("tables/{name}.exr"));
    std::fs::write(path, exr::encode(&table, &[]).expect("an image")).expect("written");
}

#[test]
fn a_changed_texel_is_told_with_its_cell_and_the_promise() {
    let folder = tempfile::tempdir().expect("a folder");
    let baked = baked(SCENE);
    for (name, bytes) in &baked.files {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        std::fs::write(path, bytes).expect("written");
    }

    // A fine difference in one table, coarse ones in three, each in another channel or side.
    let outside = "ggx-glass-outside-correlated-8x6x4-f32";
    let coarse = [
        ("ggx-glass-inside-correlated-8x6x4-f32", 0, "loss"),
        ("ggx-aniso-correlated-8x6x4", 0, "loss"),
        ("ggx-aniso-azimuth-correlated-8x6x4", 1, "c1"),
    ];
    plant(folder.path(), &baked, outside, 0, |texel| f64::from((texel as f32).next_up()));
    let (code, text) = check(folder.path(), &[]);
    assert_eq!(code, 1, "{text}");
    assert!(
        text.contains(&format!("tables/{outside}.exr: channel loss, column 5, row 4, slice 2: ")),
        "{text}"
    );
    assert!(text.contains("\n1 of ") && text.contains(" files in . differs or is missing\n"), "{text}");
    assert!(text.contains("; 1 texel differs, max abs ") && text.contains(", max ulp 1; promise "), "{text}");

    for (name, channel, _) in coarse {
        plant(folder.path(), &baked, name, channel, |texel| texel + 0.25);
    }
    let (code, text) = check(folder.path(), &["--values", "0.5"]);
    assert_eq!(code, 1, "{text}");
    for (name, _, channel) in coarse {
        let start = format!("tables/{name}.exr: channel {channel}, column 5, row 4, slice 2: ");
        let line =
            text.lines().find(|line| line.starts_with(&start)).unwrap_or_else(|| panic!("{name} in\n{text}"));
        assert!(line.contains("; promise broken: lookup error "), "{line}");
        let stated = baked.tables.iter().find(|v| v.approximation.name == name).expect("the table");
        assert!(line.ends_with(&format!("stated {:e}", stated.errors.lookup.max)), "{line}");
    }
}
