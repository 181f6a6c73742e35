//! Gives the library a hash of its own code, `LOBEFIT_STUDIES`: results of other code have another
//! recipe. Comments, blank lines and indentation are no code.

#[path = "../../build/sources.rs"]
#[allow(dead_code, reason = "the places are those of the package `lobefit`")]
mod sources;

use std::path::Path;

fn main() -> std::io::Result<()> {
    println!("cargo:rerun-if-changed=src");
    let hash = sources::hash(Path::new(env!("CARGO_MANIFEST_DIR")), &["src".into()], code)?;
    println!("cargo:rustc-env=LOBEFIT_STUDIES={hash}");
    Ok(())
}

fn code(bytes: Vec<u8>) -> Vec<u8> {
    let text = String::from_utf8_lossy(&bytes);
    let lines = text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with("//"));
    lines.flat_map(|line| [line.as_bytes(), b"\n"].concat()).collect()
}
