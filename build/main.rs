//! Gives the library a hash of its own sources, `LOBEFIT_BUILD`.

mod sources;

use std::path::Path;

fn main() -> std::io::Result<()> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let places = sources::places(root)?;
    for place in &places {
        // Cargo watches every file below a folder.
        println!("cargo:rerun-if-changed={place}");
    }
    println!("cargo:rustc-env=LOBEFIT_BUILD={}", sources::hash(root, &places, |bytes| bytes)?);
    Ok(())
}
