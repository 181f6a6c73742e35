//! `lobefit check` names the texel in every container, and the field of a changed header.

use crate::common;

use std::path::Path;

use common::{lobefit, stderr};
use lobefit::data::Container;

/// A table of two axes and two channels in every container, with more materials after it.
fn scene(more: &str) -> String {
    let plain = r#"{"schema_version":1,"reports":false,"languages":["c"],"formats":["exr","dds","ktx2","npy","raw"],"materials":[{"name":"plain","kind":"metal","f0":1,
        "roughness":[0.4,1],"wants":{"tables":[{"size":[16,8],"layout":"plain","serves":"split-sum"}]}}"#;
    format!("{plain}{more}]}}")
}

/// Two tables of three axes: of one channel in f32, of four in f16.
const SLICED: &str = r#",{"name":"brushed","kind":"metal","f0":1,"anisotropy":[0.4,0.6],"roughness":[0.5,0.6],
    "wants":{"tables":[{"size":[8,6,4],"format":"f32"},{"layout":"azimuth","size":[8,6,4]}]}}"#;

fn baked(scene: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let output = lobefit(folder.path(), &["bake", "-", "--quiet"], scene.as_bytes());
    assert_eq!((output.status.code(), stderr(&output).as_str()), (Some(0), ""));
    folder
}

fn check(folder: &Path, scene: &str, options: &[&str]) -> (i32, String) {
    let output = lobefit(folder, &[&["check", "-"], options].concat(), scene.as_bytes());
    (output.status.code().expect("a code"), String::from_utf8(output.stdout).expect("text"))
}

/// Flips the lowest bit of a byte of a file.
fn flip(path: &Path, at: usize) {
    let mut bytes = std::fs::read(path).expect("a table");
    bytes[at] ^= 1;
    std::fs::write(path, bytes).expect("written");
}

/// The byte of a texel, from its place and the sidecar.
fn byte(folder: &Path, file: &str, [x, y, z]: [usize; 3], channel: usize) -> usize {
    let text = std::fs::read(folder.join(format!("{file}.json"))).expect("a sidecar");
    let said: serde_json::Value = serde_json::from_slice(&text).expect("JSON");
    let number = |value: &serde_json::Value| value.as_u64().expect("a number") as usize;
    let channels = said["channels"].as_array().expect("channels").len() + number(&said["padding_channels"]);
    let bytes = if said["stored"] == "f16" { 2 } else { 4 };
    let [columns, rows] = [0, 1].map(|k| number(&said["size"][k]));
    number(&said["offset"]) + (((z * rows + y) * columns + x) * channels + channel) * bytes
}

#[test]
fn one_planted_texel_is_named_in_every_container() {
    let scene = scene(SLICED);
    let folder = baked(&scene);
    let mut expected = Vec::new();
    for (name, place, channel, words) in [
        ("ggx-dfg-correlated-16x8-plain-split-sum", [11, 5, 0], 1, "channel B, column 11, row 5"),
        ("ggx-aniso-correlated-8x6x4-f32", [5, 4, 2], 0, "channel loss, column 5, row 4, slice 2"),
        ("ggx-aniso-azimuth-correlated-8x6x4", [7, 0, 3], 2, "channel c2, column 7, row 0, slice 3"),
    ] {
        for container in Container::ALL.into_iter().filter(|c| *c != Container::Exr) {
            let file = format!("tables/{name}.{}", container.name());
            flip(&folder.path().join(&file), byte(folder.path(), &file, place, channel));
            expected.push(format!("{file}: {words}: "));
        }
    }
    let (code, text) = check(folder.path(), &scene, &[]);
    assert_eq!(code, 1, "{text}");
    for start in &expected {
        let line =
            text.lines().find(|l| l.starts_with(start)).unwrap_or_else(|| panic!("{start} in\n{text}"));
        assert!(
            line.contains(" where the recipe gives ") && line.contains("; 1 texel differs, max abs "),
            "{line}"
        );
        assert!(line.contains(", max ulp 1; promise "), "{line}");
    }
    // Nothing else differs: neither an image nor any other file.
    assert!(text.lines().count() == expected.len() + 1, "{text}");
}

#[test]
fn a_changed_header_is_named_and_never_within_a_tolerance() {
    let scene = scene("");
    let folder = baked(&scene);
    let table = "tables/ggx-dfg-correlated-16x8-plain-split-sum";
    let dictionary = "{'descr': '<f3', 'fortran_order': False, 'shape': (8, 16, 2), }";
    let meant = dictionary.replace("<f3", "<f2");
    // One change of each file at a time.
    for round in [
        &[
            ("dds", 16, "header: dwWidth is 17 where the recipe gives 16".to_string()),
            ("ktx2", 12, "header: vkFormat is 82 where the recipe gives 83".into()),
            ("npy", 23, format!("header `{dictionary}` where the recipe gives `{meant}`")),
        ][..],
        &[
            ("dds", 128, "header: dxgiFormat is 35 where the recipe gives 34".into()),
            ("ktx2", 28, "header: pixelDepth is 1 where the recipe gives 0".into()),
        ],
        &[
            ("dds", 0, "byte 0 is not that of such a file".into()),
            ("ktx2", 80, "header: byteOffset is ".into()),
        ],
        &[("ktx2", 116, "header: dfd.colorModel is 65536 where the recipe gives 65537".into())],
    ] {
        let path = |extension: &str| folder.path().join(format!("{table}.{extension}"));
        round.iter().for_each(|(extension, at, _)| flip(&path(extension), *at));
        let (code, text) = check(folder.path(), &scene, &["--values", "10"]);
        assert_eq!(code, 1, "{text}");
        for (extension, at, words) in round {
            let start = format!("{table}.{extension}: {words}");
            let line = text.lines().find(|line| line.starts_with(&start));
            let line = line.unwrap_or_else(|| panic!("`{start}` in\n{text}"));
            assert!(line.contains("texels are equal"), "{text}");
            flip(&path(extension), *at);
        }
        assert_eq!(text.lines().count(), round.len() + 1, "{text}");
    }
    // Who wrote a texture bears on none of its texels.
    let path = folder.path().join(format!("{table}.ktx2"));
    let bytes = std::fs::read(&path).expect("a table");
    let writer = bytes.windows(8).position(|w| w == b"lobefit ").expect("the writer");
    flip(&path, writer + 8);
    let (code, text) = check(folder.path(), &scene, &[]);
    assert!(code == 1 && text.contains("header: other key/value data; texels are equal"), "{text}");
    assert_eq!(check(folder.path(), &scene, &["--values", "0"]).0, 0);
    // A file that is cut short.
    std::fs::write(&path, &bytes[..60]).expect("written");
    let (code, text) = check(folder.path(), &scene, &["--values", "10"]);
    let words = format!("60 bytes where the recipe gives {}", bytes.len());
    assert!(code == 1 && text.contains(&words), "`{words}` in\n{text}");
}
