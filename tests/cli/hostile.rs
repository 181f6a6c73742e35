//! Files of up to 16 MiB that are made to hurt: the program reads or refuses each within 2 s of a processor
//! and 288 MiB of addresses.

use std::fs;

use crate::common::{limited, stderr};

/// The largest file of a user.
const BYTES: usize = 16 << 20;

/// A file: its name, its bytes, what the program is asked to do with it, the exit code, and words of the
/// error.
type Case = (&'static str, fn() -> Vec<u8>, &'static [&'static str], i32, &'static str);

const SCENE: &str = r#"{"schema_version":1,"materials":["#;
const GLTF: &str = r#"{"asset":{"version":"2.0"},"#;

/// Between two texts as many of a third as a file has room for, with commas.
fn filled(start: &str, unit: &str, end: &str) -> Vec<u8> {
    let count = (BYTES - start.len() - end.len()) / (unit.len() + 1);
    format!("{start}{}{end}", vec![unit; count].join(",")).into_bytes()
}

/// A file of as many entries as a list of materials takes.
fn many(start: &str, entry: fn(usize) -> String, end: &str) -> Vec<u8> {
    let entries: Vec<String> = (0..65_536).map(entry).collect();
    format!("{start}{}{end}", entries.join(",")).into_bytes()
}

/// A grey PNG of so many texels, all 0, in a file of some kilobytes.
fn bomb(side: u32) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, side, side);
    encoder.set_compression(png::Compression::Fast);
    let row = vec![0; side as usize];
    let mut writer = encoder.write_header().expect("a header");
    let mut stream = writer.stream_writer().expect("a stream");
    (0..side).for_each(|_| std::io::Write::write_all(&mut stream, &row).expect("a row"));
    stream.finish().expect("an image");
    drop(writer);
    bytes
}

#[rustfmt::skip]
const CASES: [Case; 23] = [
    // Nesting, one long token, a million of small ones.
    ("a.json", || [SCENE.as_bytes(), &vec![b'['; BYTES - 100]].concat(), &["plan"], 2, "nested deeper than 64 levels"),
    ("b.json", || [SCENE.as_bytes(), &vec![b'1'; BYTES - 100], b"]}"].concat(), &["plan"], 2, "number out of range"),
    ("c.json", || [SCENE.as_bytes(), b"{\"name\":\"", &vec![b'a'; BYTES - 100]].concat(), &["plan"], 2, "a string longer than 4096 bytes"),
    ("d.json", || filled("{\"x\":[", "{}", "]}"), &["plan"], 2, "unknown field `x`"),
    // As many materials as a scene may have, no two of which have the same goals, or the same fields.
    ("e.json", || many(SCENE, |i| format!(r#"{{"name":"{i}","kind":"metal","f0":1,"roughness":[{},1],"wants":{{"fit":{{"max_ops":{},"max_error":{}}}}}}}"#, i as f64 / 1e5, 5 + i % 995, (i + 1) as f64 / 1e5), "]}"), &["plan"], 0, ""),
    ("f.json", || many(SCENE, |i| format!(r#"{{"name":"{i}","kind":"metal","f0":1,"anisotropy":[{0},1],"roughness":[{0},1],"wants":{{"tables":[{{"max_error":{1}}}]}}}}"#, i as f64 / 1e5, (i + 1) as f64 / 1e5), "]}"), &["plan"], 0, ""),
    ("g.json", || many(SCENE, |i| format!(r#"{{"name":"{i}","kind":"dielectric","ior":1.5,"roughness":[{0},1],"coat":{{"ior":1.5,"roughness":[{0},1],"max_ops":{1},"max_error":{2}}},"wants":{{"exact_fresnel":{{"max_ops":{1},"max_error":{2}}},"fit":{{"max_error":{2}}}}}}}"#, i as f64 / 1e5, 5 + i % 995, (i + 1) as f64 / 1e5), "]}"), &["plan"], 0, ""),
    ("a.gltf", || many(&format!("{GLTF}\"materials\":["), |i| format!(r#"{{"name":"{i}","pbrMetallicRoughness":{{"roughnessFactor":{}}}}}"#, (i + 1) as f64 / 65_536.0), "]}"), &["plan"], 0, ""),
    ("b.gltf", || filled(&format!("{GLTF}\"meshes\":["), r#"{"primitives":[{}]}"#, "]}"), &["plan"], 0, ""),
    ("c.gltf", || [GLTF.as_bytes(), b"\"x\":", "{\"a\":".repeat(BYTES / 5 - 100).as_bytes()].concat(), &["plan"], 2, "nested deeper than 64 levels"),
    ("a.glb", || [&b"glTF\x02\0\0\0\0\0\0\x01\xec\xff\xff\0JSON"[..], &vec![b' '; BYTES - 20]].concat(), &["plan"], 2, "the file is empty"),
    ("a.mtlx", || "<a>".repeat(BYTES / 3).into_bytes(), &["plan"], 2, "nested deeper than 64 levels"),
    ("b.mtlx", || format!("<materialx version=\"1.39\">{}</materialx>", "<a/>".repeat(BYTES / 4 - 20)).into_bytes(), &["plan"], 2, "more than 1048576 elements and texts"),
    ("c.mtlx", || format!("<!DOCTYPE a [<!ENTITY b \"{}\">]><materialx version=\"1.39\">&b;</materialx>", "c".repeat(BYTES - 100)).into_bytes(), &["plan"], 2, "its entities are not expanded"),
    ("image.gltf", || format!(r#"{GLTF}"materials":[{{"pbrMetallicRoughness":{{"metallicRoughnessTexture":{{"index":0}}}}}}],"textures":[{{"source":0}}],"images":[{{"uri":"a.png"}}]}}"#).into_bytes(), &["plan", "--textures"], 0, ""),
    ("a.wgsl", || vec![b'('; BYTES], &["plan", "hypothesis.json"], 2, "a.wgsl: larger than 1048576 bytes"),
    ("b.wgsl", || format!("fn f(alpha: f32) -> f32 {{ return {}; }}", vec!["1.0"; 16_000].join("+")).into_bytes(), &["plan", "hypothesis-b.json"], 2, "operators and brackets in one statement"),
    ("kernel.json", || filled("{\"schema_version\":1,\"name\":\"k\",\"lobes\":[{\"alpha\":0.1,\"theta\":[", "0", "]}]}"), &["plan", "probe.json"], 2, "more than 4096 entries"),
    // Four million rows, of which the last is wrong; a line of as many columns.
    ("a.csv", || format!("roughness,mu\n{}1,x\n", "1,1\n".repeat(BYTES / 4 - 10)).into_bytes(), &["eval", "eon-single", "--points"], 2, "row 4194295: column `mu`: `x` is not a number"),
    ("b.csv", || filled("roughness,mu,", "a", "\n"), &["eval", "eon-single", "--points"], 2, "more than 4096 columns"),
    // What lies in a folder of ours.
    ("manifest.json", || filled("{\"tables\":[],\"x\":[", "0", "]}"), &["bake", "mirrors.json", "--out", "."], 0, ""),
    ("manifest.json", || filled("{\"tables\":[", "{\"file\":\"tables/a\"}", "]}"), &["check", "mirrors.json"], 1, ""),
    ("shard-1-of-1.lobefit", || vec![b'['; BYTES], &["merge", "mirrors.json", "--out", "out", "--shards", "."], 2, "not a whole shard of a bake"),
];

#[test]
fn hostile_files_take_little_time_and_memory() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    let put = |name: &str, bytes: &[u8]| fs::write(at.join(name), bytes).expect("written");
    put("mirrors.json", include_bytes!("../../examples/mirrors.json"));
    put("a.png", &bomb(8191));
    for (file, shader) in [("hypothesis.json", "a.wgsl"), ("hypothesis-b.json", "b.wgsl")] {
        let fit = format!(
            r#"{{"name":"m","kind":"metal","f0":1,"roughness":[0.4,1],"wants":{{"fit":{{"hypotheses":["{shader}"]}}}}}}]}}"#
        );
        put(file, format!("{SCENE}{fit}").as_bytes());
    }
    put("probe.json", format!(r#"{SCENE}],"probes":[{{"name":"p","kernel":"kernel.json","roughness":[0.2,1],"rho":[0.1,3],"mips":{{"map":"linear","count":5}}}}]}}"#).as_bytes());
    let mut wrong = Vec::new();
    for (name, bytes, words, code, said) in CASES {
        let bytes = bytes();
        assert!(bytes.len() <= BYTES, "{name}: {} bytes", bytes.len());
        put(name, &bytes);
        drop(bytes);
        // A verb names the file, or a file that names it.
        let is_named = words.len() == 1 || words.ends_with(&["--textures"]) || words.ends_with(&["--points"]);
        let words = if is_named { [words, &[name]].concat() } else { words.to_vec() };
        let output = limited(at, &words);
        let error = stderr(&output);
        if output.status.code() != Some(code) || !error.contains(said) {
            wrong.push(format!(
                "{words:?}: {}: `{said}` in {}",
                output.status,
                error.chars().take(300).collect::<String>()
            ));
        }
        fs::remove_file(at.join(name)).expect("removed");
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
