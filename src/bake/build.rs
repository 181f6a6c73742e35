//! Which build of this program made the bake in a folder.
//!
//! The recipe in headers and in the manifest covers the scene, the hypotheses and the tool's
//! version, not the code: a committed bake follows from its recipe as long as its bytes do, which
//! `check` proves, and does not go stale when a comment is edited. The parts that `--only` keeps
//! are not computed again, and so nothing proves that another build would make them. A file beside
//! the bake names its build. Only the same build keeps its parts.

use crate::store::{Files, MANIFEST};

/// Hash of the source files of this package and of those below it (`build/main.rs`): 32 hexadecimal
/// digits, the same on every machine, other ones after any edit. For what is made from results that
/// are not computed again.
pub const BUILD: &str = env!("LOBEFIT_BUILD");

/// The file that names the build, relative to the folder of a bake. It is no part of the bake: the
/// manifest does not list it, `check` does not compare it, and a repository has no use for it.
pub const BUILD_FILE: &str = "fits/build.txt";

/// The file's content: this build, and the manifest that it wrote. Beside another manifest (a
/// checkout of another commit, say) the file says nothing.
fn content(manifest: &[u8]) -> String {
    format!("build {}\nmanifest {}\n", BUILD, blake3::hash(manifest).to_hex())
}

/// Adds the file that names this build to a bake.
pub fn sign(bake: &mut Files) {
    let content = bake.get(MANIFEST).map(|manifest| content(manifest));
    bake.extend(content.map(|content| (BUILD_FILE.to_string(), content.into_bytes())));
}

/// Whether the manifest and [`BUILD_FILE`] among files say that this build made them.
pub fn is_signed(files: &Files) -> bool {
    let (Some(manifest), Some(found)) = (files.get(MANIFEST), files.get(BUILD_FILE)) else { return false };
    *found == content(manifest).into_bytes()
}
