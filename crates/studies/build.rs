//! Gives the library a hash of the code of each study, `LOBEFIT_STUDY_NAME`: results of other code have
//! another recipe.

#[path = "../../build/sources.rs"]
#[allow(dead_code, reason = "the places are those of the package `lobefit`")]
mod sources;

use std::path::Path;

/// What several studies compute with. The verb (`cli.rs`), the list of studies (`study/mod.rs`) and the reader
/// of a user's scene (`study/given.rs`) compute nothing: what they put into files is hashed as it stands there,
/// and so is what a study takes of a scene.
const SHARED: [&str; 3] = ["src/flip", "src/render", "src/study/page.rs"];

/// The studies, a folder or a file each.
const STUDIES: [&str; 4] = ["coupling", "parallax", "stability", "occlusion.rs"];

fn main() -> std::io::Result<()> {
    println!("cargo:rerun-if-changed=src");
    for study in STUDIES {
        let places = SHARED.map(String::from).into_iter().chain([format!("src/study/{study}")]);
        let places: Vec<String> = places.collect();
        let hash = sources::hash(Path::new(env!("CARGO_MANIFEST_DIR")), &places, sources::code)?;
        let name = study.trim_end_matches(".rs").to_uppercase();
        println!("cargo:rustc-env=LOBEFIT_STUDY_{name}={hash}");
    }
    Ok(())
}
