//! Scenes that are refused: exit code 2, a message with place and field, and nothing written.

mod culling;
mod json;
mod materials;
mod probes;
mod scenes;
mod sliced;
mod wants;

use crate::common::{lobefit, names, stderr};

/// A scene whose only material has these fields beside its name.
fn material(fields: &str) -> String {
    format!("{{\"schema_version\":1,\n\"materials\":[\n{{\"name\":\"m\",{fields}}}]}}")
}

/// A metal with this roughness.
fn roughness(value: &str) -> String {
    material(&format!(r#""kind":"metal","f0":1,"roughness":{value}"#))
}

/// A metal that wants this.
fn wants(value: &str) -> String {
    material(&format!(r#""kind":"metal","f0":1,"roughness":1,"wants":{value}"#))
}

/// A scene without materials and with these fields.
fn top(fields: &str) -> String {
    format!(r#"{{"schema_version":1,"materials":[],{fields}}}"#)
}

/// Fields of an anisotropic metal and of glass beside their names.
const ANISOTROPIC: &str = r#""kind":"metal","f0":1,"roughness":1,"anisotropy":[0,1]"#;
const GLASS: &str = r#""kind":"glass","ior":1.5,"roughness":1"#;

/// Bytes of a scene, and what the message must hold.
type Case = (Vec<u8>, &'static str);

fn case(text: impl Into<String>, expected: &'static str) -> Case {
    (text.into().into_bytes(), expected)
}

/// Bakes each in a folder that holds nothing else.
fn refused(cases: Vec<Case>) {
    let folder = tempfile::tempdir().unwrap();
    for (bytes, expected) in cases {
        std::fs::write(folder.path().join("scene.json"), &bytes).unwrap();
        let output = lobefit(folder.path(), &["bake", "scene.json", "--out", "out"], b"");
        let message = stderr(&output);
        let start = String::from_utf8_lossy(&bytes[..bytes.len().min(200)]).into_owned();
        assert_eq!(output.status.code(), Some(2), "{start}\n{message}");
        assert!(message.starts_with("error: "), "{start}\n{message}");
        assert!(message.contains(expected), "{start}\nexpected: {expected}\nfound: {message}");
        assert!(message.trim_end().chars().all(|c| !c.is_control()), "{message:?}");
        assert!(message.contains("scene.json") || message.contains("none.wgsl"), "{message}");
        assert!(output.stdout.is_empty(), "{start}");
        assert_eq!(names(folder.path()), ["scene.json"], "{start}");
    }
}

#[test]
fn endless_and_oversized_scenes_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let output = lobefit(folder.path(), &["plan", "-"], &vec![b' '; (16 << 20) + 1]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("<stdin>: larger than 16777216 bytes"), "{}", stderr(&output));
    if cfg!(target_os = "linux") {
        let output = lobefit(folder.path(), &["plan", "/dev/zero"], b"");
        assert_eq!(output.status.code(), Some(2));
        assert!(stderr(&output).contains("/dev/zero: larger than 16777216 bytes"), "{}", stderr(&output));
    }
}
