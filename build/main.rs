//! Gives the library hashes of its own sources: `LOBEFIT_BUILD` of all, `LOBEFIT_CODE` of all but the
//! formulas.

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
    let code: Vec<String> = places.into_iter().filter(|place| place != sources::FORMULAS).collect();
    println!("cargo:rustc-env=LOBEFIT_CODE={}", sources::hash(root, &code, |bytes| bytes)?);
    Ok(())
}
