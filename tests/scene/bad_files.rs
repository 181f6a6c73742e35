//! Files that are refused, with the whole of what is said of each.

use std::fs;
use std::path::Path;

use lobefit::cli::input;
use lobefit::cli::options::{SceneOption, TexturesOption};

/// A file by its name and bytes, and the message.
type Case = (&'static str, Vec<u8>, &'static str);

/// What is said of a file whose images are read; none of one that is taken.
fn refusal(folder: &Path, name: &str, bytes: &[u8]) -> Option<String> {
    let path = folder.join(name);
    fs::write(&path, bytes).expect("written");
    let textures = TexturesOption { textures: !name.ends_with(".json"), quantile: None };
    let message = input::load(&SceneOption { scene: Some(path), textures }).err()?.to_string();
    let folder = folder.canonicalize().expect("a folder");
    Some(message.replace(&format!("{}/", folder.display()), ""))
}

fn all_of(cases: Vec<Case>) {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path().canonicalize().expect("a folder");
    fs::write(folder.join("broken.png"), b"\x89PNG\r\n\x1a\n....").expect("written");
    fs::write(folder.join("broken.jpg"), b"\xff\xd8\xff\xe0\0\x02").expect("written");
    fs::write(folder.join("broken.webp"), b"RIFF\x08\0\0\0WEBPVP8 ").expect("written");
    fs::create_dir(folder.join("folder")).expect("created");
    #[cfg(unix)]
    std::os::unix::fs::symlink("/etc/passwd", folder.join("link.png")).expect("linked");
    let mut wrong = Vec::new();
    for (name, bytes, expected) in cases {
        let found = refusal(&folder, name, &bytes);
        if found.as_deref() != Some(expected) {
            let start: String = String::from_utf8_lossy(&bytes).chars().take(160).collect();
            wrong.push(format!("{name}: {start}\n  expected: {expected}\n  found:    {found:?}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

fn gltf(fields: &str) -> Vec<u8> {
    format!(r#"{{"asset":{{"version":"2.0"}},{fields}}}"#).into_bytes()
}

/// A document with one material of these fields.
fn material(fields: &str) -> Vec<u8> {
    gltf(&format!(r#""materials":[{{{fields}}}]"#))
}

/// A material with an extension.
fn with(extension: &str, fields: &str) -> Vec<u8> {
    material(&format!(r#""extensions":{{"KHR_materials_{extension}":{{{fields}}}}}"#))
}

/// A material whose roughness has a texture, and where its image is.
fn textured(fields: &str) -> Vec<u8> {
    gltf(&format!(
        r#""materials":[{{"pbrMetallicRoughness":{{"metallicRoughnessTexture":{{"index":0}}}}}}],{fields}"#
    ))
}

fn image(uri: &str) -> Vec<u8> {
    textured(&format!(r#""textures":[{{"source":0}}],"images":[{{"uri":"{uri}"}}]"#))
}

fn view(fields: &str) -> Vec<u8> {
    textured(&format!(r#""textures":[{{"source":0}}],"images":[{{"bufferView":0}}],{fields}"#))
}

fn binary(version: u32, kind: &[u8; 4], length: u32, json: &[u8]) -> Vec<u8> {
    [b"glTF", &version.to_le_bytes()[..], &[0; 4], &length.to_le_bytes(), kind, json].concat()
}

/// A document of MaterialX.
fn mtlx(inner: &str) -> Vec<u8> {
    format!("<materialx version=\"1.39\">\n{inner}</materialx>").into_bytes()
}

/// One with a shader of these inputs.
fn shader(inputs: &str) -> Vec<u8> {
    mtlx(&format!("<standard_surface name=\"s\">\n{inputs}</standard_surface>"))
}

/// One whose shader has this value for an input.
fn value(name: &str, value: &str) -> Vec<u8> {
    shader(&format!("<input name=\"{name}\" value=\"{value}\"/>"))
}

/// One whose roughness has an image.
fn mtlx_image(file: &str) -> Vec<u8> {
    mtlx(&format!(
        "<image name=\"i\"><input name=\"file\" value=\"{file}\"/></image>\
         <gltf_pbr name=\"s\"><input name=\"roughness\" type=\"float\" nodename=\"i\"/></gltf_pbr>"
    ))
}

fn scene(fields: &str) -> Vec<u8> {
    format!(r#"{{"schema_version":1,"materials":[{{"name":"m",{fields}}}]}}"#).into_bytes()
}

#[test]
fn documents_of_gltf() {
    let repeated = |text: &str, count: usize| vec![text; count].join(",");
    all_of(vec![
        ("a.gltf", b"".to_vec(), "a.gltf:1:1: the file is empty; an object begins with `{`"),
        ("a.gltf", b" \n\t".to_vec(), "a.gltf:1:1: the file is empty; an object begins with `{`"),
        (
            "a.gltf",
            b"\xef\xbb\xbf{}".to_vec(),
            "a.gltf:1:1: the file begins with a byte order mark; save it as UTF-8 without one",
        ),
        (
            "a.gltf",
            b"\xff\xfe{\0}\0".to_vec(),
            "a.gltf:1:1: the file looks like UTF-16 or UTF-32; save it as UTF-8",
        ),
        (
            "a.gltf",
            b"{\"a\":\"\xff\"}".to_vec(),
            "a.gltf:1:7: this byte is not UTF-8; save the file as UTF-8",
        ),
        ("a.gltf", b"[]".to_vec(), "a.gltf:1:1: invalid type: sequence, expected a glTF document, an object"),
        (
            "a.gltf",
            b"7".to_vec(),
            "a.gltf:1:1: invalid type: integer `7`, expected a glTF document, an object",
        ),
        ("a.gltf", b"{}".to_vec(), "a.gltf:1:1: missing field `asset`"),
        (
            "a.gltf",
            b"{\"asset\":{\"version\":\"2.0\"}} x".to_vec(),
            "a.gltf:1:29: the object has ended before this: is there a bracket too many?",
        ),
        ("a.gltf", b"{\"asset\":{\"version\":\"2.0\"},}".to_vec(), "a.gltf:1:28: trailing comma"),
        (
            "a.gltf",
            b"{\"asset\":null}".to_vec(),
            "a.gltf:1:13: asset: invalid type: null, expected an object with a `version`",
        ),
        (
            "a.gltf",
            b"{\"asset\":{\"version\":2}}".to_vec(),
            "a.gltf:1:21: asset.version: invalid type: integer `2`, expected a string",
        ),
        (
            "a.gltf",
            b"{\"asset\":{\"version\":\"1.1\"}}".to_vec(),
            "a.gltf: asset.version: `1.1` is not a version of glTF 2",
        ),
        (
            "a.gltf",
            b"{\"asset\":{\"version\":\"2.0\"},// no\n\"materials\":[]}".to_vec(),
            "a.gltf:1:28: `//` begins a comment; a scene is strict JSON, without comments: delete it, or keep the commented file beside the scene and give what is left without comments on standard input (`-`)",
        ),
        (
            "a.gltf",
            b"{\"asset\":{\"version\":\"2.0\"},\"asset\":{\"version\":\"2.0\"}}".to_vec(),
            "a.gltf:1:34: duplicate field `asset`",
        ),
        (
            "a.gltf",
            gltf(&format!("\"extras\":{}", "[".repeat(100_000))),
            "a.gltf:1:100: nested deeper than 64 levels",
        ),
        (
            "a.gltf",
            gltf(&format!("\"materials\":[{}]", repeated("{}", 65_537))),
            "a.gltf:1:196651: materials: more than 65536 entries",
        ),
        ("a.gltf", vec![b' '; (16 << 20) + 1], "a.gltf: the file is larger than 16777216 bytes"),
        (
            "a.gltf",
            gltf(r#""materials":{}"#),
            "a.gltf:1:40: materials: invalid type: map, expected a list in brackets, [...], of at most 65536 entries",
        ),
        (
            "a.gltf",
            gltf(r#""materials":[7]"#),
            "a.gltf:1:41: materials[0]: invalid type: integer `7`, expected an object that describes a material",
        ),
        (
            "a.gltf",
            gltf(r#""materials":null"#),
            "a.gltf:1:43: materials: invalid type: null, expected a list in brackets, [...], of at most 65536 entries",
        ),
        ("a.gltf", gltf(r#""meshes":[{}]"#), "a.gltf:1:38: meshes[0]: missing field `primitives`"),
        (
            "a.gltf",
            gltf(r#""meshes":[{"primitives":[{"material":0}]}]"#),
            "a.gltf: meshes[0].primitives: material 0 is none of the file's 0 materials",
        ),
        (
            "a.gltf",
            gltf(r#""meshes":[{"primitives":[{"material":-1}]}]"#),
            "a.gltf:1:66: meshes[0].primitives[0].material: invalid value: integer `-1`, expected a whole number, 0 or above",
        ),
        (
            "a.gltf",
            gltf(r#""meshes":[{"primitives":[{"material":18446744073709551616}]}]"#),
            "a.gltf:1:84: meshes[0].primitives[0].material: invalid type: floating point `1.8446744073709552e+19`, expected a whole number, 0 or above",
        ),
        (
            "a.gltf",
            gltf(r#""meshes":[{"primitives":[{"extensions":{"KHR_materials_variants":{}}}]}]"#),
            "a.gltf:1:93: meshes[0].primitives[0].extensions.KHR_materials_variants: missing field `mappings`",
        ),
        (
            "a.gltf",
            gltf(&format!("\"extensionsUsed\":[{}]", repeated("\"x\"", 1025))),
            "a.gltf:1:4145: extensionsUsed: more than 1024 entries",
        ),
    ]);
}

#[test]
fn materials_of_gltf() {
    let pbr = |fields: &str| material(&format!(r#""pbrMetallicRoughness":{{{fields}}}"#));
    all_of(vec![
        (
            "a.gltf",
            material(r#""name":7"#),
            "a.gltf:1:49: materials[0].name: invalid type: integer `7`, expected a string",
        ),
        (
            "a.gltf",
            material(r#""name":"\ud800""#),
            "a.gltf:1:56: materials[0].name: unexpected end of hex escape",
        ),
        (
            "a.gltf",
            material(r#""extensions":7"#),
            "a.gltf:1:55: materials[0].extensions: invalid type: integer `7`, expected an object of extensions",
        ),
        (
            "a.gltf",
            pbr(r#""roughnessFactor":1.0000001"#),
            "a.gltf:1:92: materials[0].pbrMetallicRoughness.roughnessFactor: 1.0000001 is outside [0, 1]",
        ),
        (
            "a.gltf",
            pbr(r#""roughnessFactor":-0.0"#),
            "a.gltf:1:87: materials[0].pbrMetallicRoughness.roughnessFactor: -0 is negative zero; write 0",
        ),
        (
            "a.gltf",
            pbr(r#""roughnessFactor":1e999"#),
            "a.gltf:1:88: materials[0].pbrMetallicRoughness.roughnessFactor: number out of range",
        ),
        (
            "a.gltf",
            pbr(r#""roughnessFactor":NaN"#),
            "a.gltf:1:84: materials[0].pbrMetallicRoughness.roughnessFactor: expected a value: a number such as 0.9, a text in double quotes, a list, an object, true, false or null",
        ),
        (
            "a.gltf",
            pbr(r#""roughnessFactor":null"#),
            "a.gltf:1:87: materials[0].pbrMetallicRoughness.roughnessFactor: invalid type: null, expected a number in [0, 1]",
        ),
        (
            "a.gltf",
            pbr(r#""roughnessFactor":"0.5""#),
            "a.gltf:1:88: materials[0].pbrMetallicRoughness.roughnessFactor: invalid type: string \"0.5\", expected a number in [0, 1]",
        ),
        (
            "a.gltf",
            pbr(r#""metallicFactor":-3.5"#),
            "a.gltf:1:86: materials[0].pbrMetallicRoughness.metallicFactor: -3.5 is outside [0, 1]",
        ),
        (
            "a.gltf",
            pbr(r#""metallicFactor":12"#),
            "a.gltf:1:84: materials[0].pbrMetallicRoughness.metallicFactor: 12 is outside [0, 1]",
        ),
        (
            "a.gltf",
            pbr(r#""baseColorFactor":[1,1,1]"#),
            "a.gltf:1:90: materials[0].pbrMetallicRoughness.baseColorFactor: 3 numbers where 4 are called for",
        ),
        (
            "a.gltf",
            pbr(r#""baseColorFactor":[1,1,1,1,1]"#),
            "a.gltf:1:94: materials[0].pbrMetallicRoughness.baseColorFactor: more than 4 numbers",
        ),
        (
            "a.gltf",
            pbr(r#""baseColorFactor":[1,1,2,1]"#),
            "a.gltf:1:89: materials[0].pbrMetallicRoughness.baseColorFactor[2]: 2 is outside [0, 1]",
        ),
        (
            "a.gltf",
            pbr(r#""metallicRoughnessTexture":{}"#),
            "a.gltf:1:93: materials[0].pbrMetallicRoughness.metallicRoughnessTexture: missing field `index`",
        ),
        (
            "a.gltf",
            pbr(r#""metallicRoughnessTexture":{"index":0.5}"#),
            "a.gltf:1:104: materials[0].pbrMetallicRoughness.metallicRoughnessTexture.index: invalid type: floating point `0.5`, expected a whole number, 0 or above",
        ),
        (
            "a.gltf",
            with("ior", r#""ior":-1"#),
            "a.gltf:1:84: materials[0].extensions.KHR_materials_ior.ior: -1 is outside [0, 1e30]",
        ),
        (
            "a.gltf",
            with("ior", r#""ior":1e31"#),
            "a.gltf:1:86: materials[0].extensions.KHR_materials_ior.ior: 10000000000000000000000000000000 is outside [0, 1e30]",
        ),
        (
            "a.gltf",
            with("sheen", r#""sheenColorFactor":[1,1]"#),
            "a.gltf:1:102: materials[0].extensions.KHR_materials_sheen.sheenColorFactor: 2 numbers where 3 are called for",
        ),
        (
            "a.gltf",
            with("specular", r#""specularColorFactor":[1,1,-1]"#),
            "a.gltf:1:110: materials[0].extensions.KHR_materials_specular.specularColorFactor[2]: -1 is outside [0, 1e30]",
        ),
        (
            "a.gltf",
            with("transmission", r#""transmissionFactor":2"#),
            "a.gltf:1:107: materials[0].extensions.KHR_materials_transmission.transmissionFactor: 2 is outside [0, 1]",
        ),
        (
            "a.gltf",
            with("anisotropy", r#""anisotropyStrength":1.5"#),
            "a.gltf:1:107: materials[0].extensions.KHR_materials_anisotropy.anisotropyStrength: 1.5 is outside [0, 1]",
        ),
        (
            "a.gltf",
            with("dispersion", r#""dispersion":-1"#),
            "a.gltf:1:98: materials[0].extensions.KHR_materials_dispersion.dispersion: -1 is outside [0, 1e30]",
        ),
        (
            "a.gltf",
            with("volume", r#""thicknessFactor":[1]"#),
            "a.gltf:1:98: materials[0].extensions.KHR_materials_volume.thicknessFactor: invalid type: sequence, expected a number in [0, 1e30]",
        ),
        (
            "a.gltf",
            with("clearcoat", r#""clearcoatFactor":true"#),
            "a.gltf:1:104: materials[0].extensions.KHR_materials_clearcoat.clearcoatFactor: invalid type: boolean `true`, expected a number in [0, 1]",
        ),
        (
            "a.gltf",
            with("pbrSpecularGlossiness", r#""glossinessFactor":1.5"#),
            "a.gltf:1:116: materials[0].extensions.KHR_materials_pbrSpecularGlossiness.glossinessFactor: 1.5 is outside [0, 1]",
        ),
    ]);
}

#[test]
fn binary_files_of_gltf() {
    all_of(vec![
        ("a.glb", b"glTF".to_vec(), "a.glb: the file ends in its header"),
        ("a.glb", b"glTF\x02\0\0\0\0\0\0\0".to_vec(), "a.glb: the file ends in its header"),
        (
            "a.glb",
            binary(1, b"JSON", 2, b"{}"),
            "a.glb: a binary glTF of version 1; this program reads version 2",
        ),
        (
            "a.glb",
            binary(3, b"JSON", 2, b"{}"),
            "a.glb: a binary glTF of version 3; this program reads version 2",
        ),
        ("a.glb", binary(2, b"BIN\0", 2, b"{}"), "a.glb: the first chunk is not JSON"),
        ("a.glb", binary(2, b"JSON", 0, b""), "a.glb:1:1: the file is empty; an object begins with `{`"),
        (
            "a.glb",
            binary(2, b"JSON", 3, b"{}"),
            "a.glb: its JSON should be 3 bytes, and the file ends before",
        ),
        ("a.glb", binary(2, b"JSON", u32::MAX, b"{}"), "a.glb: its JSON is larger than 16777216 bytes"),
        ("a.glb", binary(2, b"JSON", 2, b"{}"), "a.glb:1:1: missing field `asset`"),
        ("a.glb", binary(2, b"JSON", 1, b"{}"), "a.glb:1:1: the file ends inside an object"),
        (
            "a.json",
            binary(2, b"JSON", 2, b"[]"),
            "a.json:1:1: invalid type: sequence, expected a glTF document, an object",
        ),
    ]);
}

#[test]
fn documents_of_materialx() {
    let nested = |depth: usize| "<nodegraph>".repeat(depth);
    let attributes: String = (0..257).map(|i| format!(" a{i}=\"\"")).collect();
    let namespaces: String = (0..65).map(|i| format!("<a xmlns:n{i}=\"u{i}\"/>")).collect();
    let bomb = "<!DOCTYPE m [<!ENTITY a \"aaaa\"><!ENTITY b \"&a;&a;&a;\">]><materialx>&b;</materialx>";
    all_of(vec![
        (
            "a.mtlx",
            b"".to_vec(),
            "a.mtlx:1:1: the file is empty; a MaterialX document begins with `<materialx`",
        ),
        (
            "a.mtlx",
            b"\n ".to_vec(),
            "a.mtlx:1:1: the file is empty; a MaterialX document begins with `<materialx`",
        ),
        (
            "a.mtlx",
            b"\xef\xbb\xbf<materialx/>".to_vec(),
            "a.mtlx:1:1: the file begins with a byte order mark; save it as UTF-8 without one",
        ),
        ("a.mtlx", b"<\0m\0".to_vec(), "a.mtlx:1:1: the file looks like UTF-16 or UTF-32; save it as UTF-8"),
        (
            "a.mtlx",
            b"<materialx name=\"\xff\"/>".to_vec(),
            "a.mtlx:1:18: this byte is not UTF-8; save the file as UTF-8",
        ),
        ("a.mtlx", b"materialx".to_vec(), "a.mtlx:1:1: unknown token"),
        ("a.mtlx", b"<materialx>".to_vec(), "a.mtlx:1:1: the root node was opened but never closed"),
        (
            "a.mtlx",
            b"<materialx></material>".to_vec(),
            "a.mtlx:1:12: expected 'materialx' tag, not 'material'",
        ),
        ("a.mtlx", b"<materialx a=1/>".to_vec(), "a.mtlx:1:14: expected a quote not '1'"),
        (
            "a.mtlx",
            b"<materialx a=\"\" a=\"\"/>".to_vec(),
            "a.mtlx:1:17: attribute 'a' at 1:17 is already defined",
        ),
        ("a.mtlx", b"<materialx>&nbsp;</materialx>".to_vec(), "a.mtlx:1:12: unknown entity reference 'nbsp'"),
        ("a.mtlx", b"<xi:materialx/>".to_vec(), "a.mtlx:1:2: an unknown namespace prefix 'xi'"),
        ("a.mtlx", b"<materialx/><materialx/>".to_vec(), "a.mtlx:1:13: unknown token"),
        ("a.mtlx", b"<!-- <materialx/>".to_vec(), "a.mtlx:1:18: expected '-->'"),
        ("a.mtlx", b"<svg/>".to_vec(), "a.mtlx:1:1: `svg` is not a `materialx` document"),
        (
            "a.mtlx",
            bomb.into(),
            "a.mtlx:1:1: a document type declaration: its entities are not expanded; delete it",
        ),
        (
            "a.mtlx",
            b"<!DOCTYPE m SYSTEM \"file:///etc/passwd\"><materialx/>".to_vec(),
            "a.mtlx:1:1: a document type declaration: its entities are not expanded; delete it",
        ),
        ("a.mtlx", nested(65).into(), "a.mtlx:1:705: nested deeper than 64 levels"),
        ("a.mtlx", nested(100_000).into(), "a.mtlx:1:705: nested deeper than 64 levels"),
        (
            "a.mtlx",
            mtlx(&format!("<a{attributes}/>")),
            "a.mtlx:2:1: an element with more than 256 attributes",
        ),
        ("a.mtlx", mtlx(&namespaces), "a.mtlx:2:1261: more than 64 namespaces"),
        ("a.mtlx", mtlx(&"<a/>".repeat(1 << 20)), "a.mtlx:2:4194301: more than 1048576 elements and texts"),
        ("a.mtlx", mtlx("<image name=\"a\"/><image name=\"a\"/>"), "a.mtlx:2:18: `a` is there twice"),
        (
            "a.mtlx",
            mtlx("<nodegraph name=\"g\"><output name=\"a\"/><image name=\"a\"/></nodegraph>"),
            "a.mtlx:2:39: `a` is there twice",
        ),
        ("a.mtlx", vec![b'<'; (16 << 20) + 1], "a.mtlx: the file is larger than 16777216 bytes"),
        (
            "a.json",
            b"<?xml version=\"1.0\"?><svg/>".to_vec(),
            "a.json:1:22: `svg` is not a `materialx` document",
        ),
    ]);
}

#[test]
fn inputs_of_materialx() {
    let connected = |attributes: &str| shader(&format!("<input name=\"base\" {attributes}/>"));
    let many: String = (0..129).map(|i| format!("<input name=\"i{i}\"/>")).collect();
    let of = |shader: &str| {
        mtlx(&format!(
            "<surfacematerial name=\"m\"><input name=\"surfaceshader\" nodename=\"{shader}\"/></surfacematerial>"
        ))
    };
    all_of(vec![
        (
            "a.mtlx",
            value("specular_roughness", "1.5"),
            "a.mtlx:3:1: s.specular_roughness: 1.5 is outside [0, 1]",
        ),
        (
            "a.mtlx",
            value("specular_roughness", "-0.1"),
            "a.mtlx:3:1: s.specular_roughness: -0.1 is outside [0, 1]",
        ),
        (
            "a.mtlx",
            value("specular_roughness", "nan"),
            "a.mtlx:3:1: s.specular_roughness: `nan` is no finite number",
        ),
        (
            "a.mtlx",
            value("specular_roughness", "inf"),
            "a.mtlx:3:1: s.specular_roughness: `inf` is no finite number",
        ),
        (
            "a.mtlx",
            value("specular_roughness", "1e999"),
            "a.mtlx:3:1: s.specular_roughness: `1e999` is no finite number",
        ),
        (
            "a.mtlx",
            value("specular_roughness", ""),
            "a.mtlx:3:1: s.specular_roughness: `` is no finite number",
        ),
        (
            "a.mtlx",
            value("specular_roughness", "rough"),
            "a.mtlx:3:1: s.specular_roughness: `rough` is no finite number",
        ),
        (
            "a.mtlx",
            value("specular_roughness", "0.1, 0.2"),
            "a.mtlx:3:1: s.specular_roughness: 2 numbers where 1 is called for",
        ),
        (
            "a.mtlx",
            value("specular_roughness", "1,1,1,1,1"),
            "a.mtlx:3:1: s.specular_roughness: more than 4 numbers",
        ),
        ("a.mtlx", value("base_color", "1"), "a.mtlx:3:1: s.base_color: 1 number where 3 are called for"),
        ("a.mtlx", value("base_color", "1, 1, 1.5"), "a.mtlx:3:1: s.base_color: 1.5 is outside [0, 1]"),
        ("a.mtlx", value("base_color", "1 1 1"), "a.mtlx:3:1: s.base_color: `1 1 1` is no finite number"),
        ("a.mtlx", value("specular_IOR", "-1"), "a.mtlx:3:1: s.specular_IOR: -1 is outside [0, 1e30]"),
        ("a.mtlx", value("metalness", "2"), "a.mtlx:3:1: s.metalness: 2 is outside [0, 1]"),
        (
            "a.mtlx",
            shader("<input name=\"base\" value=\"1\"/><input name=\"base\" value=\"1\"/>"),
            "a.mtlx:3:31: the input `base` is there twice",
        ),
        ("a.mtlx", shader(&many), "a.mtlx:3:2451: more than 128 inputs"),
        (
            "a.mtlx",
            connected("nodename=\"x\""),
            "a.mtlx:3:1: s.base: it is connected to `x`, which is not in this file",
        ),
        (
            "a.mtlx",
            connected("nodegraph=\"g\""),
            "a.mtlx:3:1: s.base: it is connected to `g`, which is not in this file",
        ),
        (
            "a.mtlx",
            of("s"),
            "a.mtlx:2:27: m.surfaceshader: it is connected to `s`, which is not in this file",
        ),
        (
            "a.mtlx",
            mtlx(
                "<nodegraph name=\"g\"/><gltf_pbr name=\"s\"><input name=\"roughness\" nodegraph=\"g\" output=\"o\"/></gltf_pbr>",
            ),
            "a.mtlx:2:41: s.roughness: it is connected to `o`, which is not in this file",
        ),
        (
            "a.mtlx",
            mtlx(
                "<constant name=\"c\"><input name=\"value\" value=\"x\"/></constant>\
                 <gltf_pbr name=\"s\"><input name=\"roughness\" nodename=\"c\"/></gltf_pbr>",
            ),
            "a.mtlx:2:20: s.roughness: `x` is no finite number",
        ),
    ]);
}

#[test]
fn textures() {
    all_of(vec![
        (
            "a.gltf",
            textured(r#""textures":[]"#),
            "a.gltf: textures: texture 0 is none of the file's 0 (materials[0])",
        ),
        ("a.gltf", textured(r#""textures":[{}]"#), "a.gltf: textures[0]: it has no `source` (materials[0])"),
        (
            "a.gltf",
            textured(r#""textures":[{"source":1}],"images":[{}]"#),
            "a.gltf: images: image 1 is none of the file's 1 (materials[0])",
        ),
        (
            "a.gltf",
            textured(r#""textures":[{"source":0}],"images":[{}]"#),
            "a.gltf: images[0]: it has neither `uri` nor `bufferView` (materials[0])",
        ),
        (
            "a.gltf",
            image("none.png"),
            "a.gltf: images[0]: none.png: cannot access: No such file or directory (os error 2) (materials[0])",
        ),
        (
            "a.gltf",
            image("../x.png"),
            "a.gltf: images[0].uri: `../x.png` is no plain path inside the folder of the scene: it is not opened (materials[0])",
        ),
        (
            "a.gltf",
            image("%2e%2e/x.png"),
            "a.gltf: images[0].uri: `%2e%2e/x.png` is no plain path inside the folder of the scene: it is not opened (materials[0])",
        ),
        (
            "a.gltf",
            image("/etc/passwd"),
            "a.gltf: images[0].uri: `/etc/passwd` is no plain path inside the folder of the scene: it is not opened (materials[0])",
        ),
        (
            "a.gltf",
            image("file:///etc/passwd"),
            "a.gltf: images[0].uri: `file:///etc/passwd` is no plain path inside the folder of the scene: it is not opened (materials[0])",
        ),
        (
            "a.gltf",
            image("http://localhost/x.png"),
            "a.gltf: images[0].uri: `http://localhost/x.png` is no plain path inside the folder of the scene: it is not opened (materials[0])",
        ),
        (
            "a.gltf",
            image("a\\\\b.png"),
            "a.gltf: images[0].uri: `a\\b.png` is no plain path inside the folder of the scene: it is not opened (materials[0])",
        ),
        (
            "a.gltf",
            image("%ff"),
            "a.gltf: images[0].uri: `%ff` is not a URI: its escapes are no UTF-8 (materials[0])",
        ),
        (
            "a.gltf",
            image("%0"),
            "a.gltf: images[0].uri: `%0` is not a URI: its escapes are no UTF-8 (materials[0])",
        ),
        (
            "a.gltf",
            image("%00"),
            "a.gltf: images[0].uri: `%00` is no plain path inside the folder of the scene: it is not opened (materials[0])",
        ),
        (
            "a.gltf",
            image(""),
            "a.gltf: images[0].uri: `` is no plain path inside the folder of the scene: it is not opened (materials[0])",
        ),
        (
            "a.gltf",
            image("folder"),
            "a.gltf: images[0]: `folder` is no plain path inside the folder (materials[0])",
        ),
        #[cfg(unix)]
        (
            "a.gltf",
            image("link.png"),
            "a.gltf: images[0]: `link.png` is no plain path inside the folder (materials[0])",
        ),
        (
            "a.gltf",
            image("broken.png"),
            "a.gltf: images[0]: a broken PNG: unexpected end of file (materials[0])",
        ),
        (
            "a.gltf",
            image("broken.jpg"),
            "a.gltf: images[0]: a broken JPEG: I/O errors Not enough bytes, expected 1 but found 0 (materials[0])",
        ),
        (
            "a.gltf",
            image("broken.webp"),
            "a.gltf: images[0]: a broken WebP: IO Error: failed to fill whole buffer (materials[0])",
        ),
        (
            "a.gltf",
            image("data:image/png;base64,****"),
            "a.gltf: images[0]: its base64 is broken: Invalid symbol 42, offset 0. (materials[0])",
        ),
        (
            "a.gltf",
            view(r#""bufferViews":[]"#),
            "a.gltf: bufferViews: view 0 is none of the file's 0 (materials[0])",
        ),
        (
            "a.gltf",
            view(r#""bufferViews":[{"buffer":0,"byteLength":4}]"#),
            "a.gltf: buffers: buffer 0 is none of the file's 0 (materials[0])",
        ),
        (
            "a.gltf",
            view(r#""bufferViews":[{"buffer":0,"byteLength":4}],"buffers":[{}]"#),
            "a.gltf: buffers[0]: it has no `uri` (materials[0])",
        ),
        (
            "a.gltf",
            view(
                r#""bufferViews":[{"buffer":0,"byteOffset":18446744073709551615,"byteLength":4}],"buffers":[{}]"#,
            ),
            "a.gltf: bufferViews[0]: it reaches beyond its buffer (materials[0])",
        ),
        (
            "a.gltf",
            view(r#""bufferViews":[{"buffer":0,"byteLength":9}],"buffers":[{"uri":"data:;base64,AAAA"}]"#),
            "a.gltf: bufferViews[0]: it reaches beyond its buffer (materials[0])",
        ),
        (
            "a.gltf",
            view(
                r#""bufferViews":[{"buffer":0,"byteOffset":99,"byteLength":9}],"buffers":[{"uri":"broken.png"}]"#,
            ),
            "a.gltf: images[0]: broken.png: cannot read: the file ends before the part that is asked for (materials[0])",
        ),
        (
            "a.mtlx",
            mtlx_image("none.png"),
            "a.mtlx:2:17: s.roughness: none.png: cannot access: No such file or directory (os error 2)",
        ),
        (
            "a.mtlx",
            mtlx_image("../x.png"),
            "a.mtlx:2:17: s.roughness: `../x.png` is no plain path inside the folder of the scene: it is not opened",
        ),
        (
            "a.mtlx",
            mtlx_image("C:/x.png"),
            "a.mtlx:2:17: s.roughness: `C:/x.png` is no plain path inside the folder of the scene: it is not opened",
        ),
        (
            "a.mtlx",
            mtlx_image("broken.png"),
            "a.mtlx:2:17: s.roughness: a broken PNG: unexpected end of file",
        ),
    ]);
}

#[test]
fn other_files() {
    all_of(vec![
        (
            "a.usda",
            b"#usda 1.0".to_vec(),
            "a.usda: USD is not read in this version; export the materials as MaterialX (.mtlx) or glTF (.glb)",
        ),
        (
            "a.usdz",
            b"PK\x03\x04".to_vec(),
            "a.usdz: USD is not read in this version; export the materials as MaterialX (.mtlx) or glTF (.glb)",
        ),
        (
            "a.json",
            b"PXR-USDC".to_vec(),
            "a.json: USD is not read in this version; export the materials as MaterialX (.mtlx) or glTF (.glb)",
        ),
        (
            "a.json",
            scene(r#""kind":"metal","f0":1,"roughness":0.5,"emission":1"#),
            "a.json:1:93: materials[0].emission: unknown field `emission`, expected one of `name`, `kind`, `f0`, `ior`, `roughness`, `distribution`, `anisotropy`, `sheen`, `coat`, `base`, `mixed`, `wants`",
        ),
        (
            "a.json",
            scene(
                r#""kind":"metal","f0":1,"roughness":0.5,"distribution":"beckmann","wants":{"tables":[{"layout":"area-lights"}]}"#,
            ),
            "a.json:1:151: materials[0].wants.tables[0].layout: it is of the distribution `ggx`; with `beckmann` ask for tables and fits of isotropic lobes and of glass",
        ),
        (
            "a.json",
            scene(r#""kind":"cloth","f0":1,"roughness":0.5"#),
            "a.json:1:59: materials[0].kind: unknown variant `cloth`, expected one of `metal`, `dielectric`, `glass`",
        ),
        (
            "a.json",
            scene(r#""kind":"metal","f0":1,"roughness":[0.6,0.5]"#),
            "a.json:1:89: materials[0].roughness: the range [0.6, 0.5] is upside down",
        ),
        (
            "a.json",
            scene(r#""kind":"glass","ior":3.5,"roughness":0.5"#),
            "a.json:1:69: materials[0].ior: 3.5 is outside [1, 3], where that of glass lies",
        ),
        (
            "a.json",
            scene(r#""kind":"metal","f0":1,"roughness":1e400000"#),
            "a.json:1:87: materials[0].roughness: number out of range",
        ),
    ]);
}
