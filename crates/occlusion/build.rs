//! Gives the library a hash of its own code, `LOBEFIT_OCCLUSION`: results of other code have
//! another recipe.

#[path = "../../build/sources.rs"]
#[allow(dead_code, reason = "the places are those of the package `lobefit`")]
mod sources;

use std::path::Path;

fn main() -> std::io::Result<()> {
    println!("cargo:rerun-if-changed=src");
    let hash = sources::hash(Path::new(env!("CARGO_MANIFEST_DIR")), &["src".into()], sources::code)?;
    println!("cargo:rustc-env=LOBEFIT_OCCLUSION={hash}");
    Ok(())
}
