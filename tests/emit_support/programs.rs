//! Outside programs on emitted files: rustc, and Python with OpenEXR and numpy.

use std::fs;
use std::path::Path;
use std::process::Command;

use super::missing;

/// Stack of rustc's threads: LLVM's analysis of one function that calls every emitted one recurses
/// deeper than the default.
const STACK: &str = "268435456";

/// Runs rustc, which must say nothing against the source.
pub fn rustc(arguments: &[&str], source: &Path, out: &Path) {
    let compiler = std::env::var("RUSTC").unwrap_or_else(|_| "rustc".to_string());
    let mut command = Command::new(compiler);
    command.env("RUST_MIN_STACK", STACK).args(arguments).arg("-o").arg(out).arg(source);
    let result = command.output().expect("rustc runs");
    assert!(result.status.success(), "{}", String::from_utf8_lossy(&result.stderr));
}

/// Compiles a file as a library of its own, both editions, free of warnings.
pub fn compile_library(include: &str) {
    let folder = tempfile::tempdir().unwrap();
    let source = folder.path().join("lobefit.rs");
    fs::write(&source, include).unwrap();
    for edition in ["2021", "2024"] {
        rustc(
            &["--crate-type", "lib", "--edition", edition, "-D", "warnings", "-W", "missing-docs"],
            &source,
            &folder.path().join("liblobefit.rlib"),
        );
    }
}

/// Compiles a program about `lobefit.rs`, whose `main` reads points of `width` numbers from the
/// file that its first argument names and writes f32 values to that of its second; returns these.
pub fn run(include: &str, width: usize, body: &str, points: &[u8]) -> Vec<f32> {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    fs::write(path("lobefit.rs"), include).unwrap();
    fs::write(path("points"), points).unwrap();
    let source = format!(
        "mod lobefit;
fn main() {{
    let arguments: Vec<String> = std::env::args().collect();
    let bytes = std::fs::read(&arguments[1]).unwrap();
    let numbers: Vec<f32> =
        bytes.chunks_exact(4).map(|b| f32::from_le_bytes(b.try_into().unwrap())).collect();
    let points: Vec<[f32; {width}]> = numbers.chunks_exact({width}).map(|p| p.try_into().unwrap()).collect();
    let mut out: Vec<f32> = Vec::new();
{body}    std::fs::write(&arguments[2], out.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>()).unwrap();
}}
"
    );
    fs::write(path("main.rs"), source).unwrap();
    rustc(&["-C", "opt-level=0", "--edition", "2021"], &path("main.rs"), &path("harness"));
    let status = Command::new(path("harness")).arg(path("points")).arg(path("values")).status().unwrap();
    assert!(status.success(), "{status}");
    let bytes = fs::read(path("values")).unwrap();
    bytes.chunks_exact(4).map(|b| f32::from_le_bytes(b.try_into().unwrap())).collect()
}

/// Exit status of a script whose modules are not there.
const NO_MODULE: i32 = 77;

/// Imports what the scripts use.
const IMPORTS: &str = "
import json, sys
try:
    import numpy, OpenEXR
except ImportError as e:
    print(e)
    sys.exit(77)
";

/// What a Python script prints as JSON about the file that its first argument names; none where the
/// tools are missing.
pub fn python(script: &str, file: &Path) -> Option<serde_json::Value> {
    let python = std::env::var("PYTHON").unwrap_or_else(|_| "python3".to_string());
    let out = match Command::new(&python).args(["-c", &format!("{IMPORTS}{script}")]).arg(file).output() {
        Err(e) if e.kind() == std::io::ErrorKind::NotFound => {
            missing(&format!("no {python}"), "python3, then pip install OpenEXR numpy");
            return None;
        }
        Err(e) => panic!("{python}: {e}"),
        Ok(out) => out,
    };
    if out.status.code() == Some(NO_MODULE) {
        let reason = String::from_utf8_lossy(&out.stdout).trim().to_string();
        missing(&format!("{python}: {reason}"), "its modules: pip install OpenEXR numpy");
        return None;
    }
    assert!(out.status.success(), "{}: {}", file.display(), String::from_utf8_lossy(&out.stderr));
    Some(serde_json::from_slice(&out.stdout).expect("JSON"))
}

/// Prints header and channels of an EXR file, floats in full.
pub const READ_EXR: &str = r#"
with OpenEXR.File(sys.argv[1], separate_channels=True) as image:
    assert len(image.parts) == 1, image.parts
    header = image.header()
    channels = {
        name: {"type": str(channel.pixels.dtype), "rows": [[float(x) for x in row] for row in channel.pixels]}
        for name, channel in image.channels().items()
    }
    print(json.dumps({"lobefit": header["lobefit"], "name": header["name"], "channels": channels}))
"#;
