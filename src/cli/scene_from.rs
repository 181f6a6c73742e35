//! `lobefit scene-from`: the scene that a glTF file is read as, to be edited.

use std::path::PathBuf;

use clap::Args;

use super::CliError;
use super::input;
use super::output::{Outcome, print};

pub(super) const EXAMPLES: &str = "\
Examples:
  lobefit scene-from room.glb > scene.json   then state errors, budgets and tables, and bake that
  lobefit plan room.glb                      what the file calls for as it is";

/// Options of `scene-from`.
#[derive(Args)]
pub(super) struct Options {
    /// File of glTF 2.0: .gltf or .glb
    pub file: PathBuf,
    /// Say nothing of what the scene leaves out
    #[arg(long, short)]
    pub quiet: bool,
}

pub(super) fn run(options: &Options) -> Result<Outcome, CliError> {
    let text = input::text(&options.file)?;
    if !text.is_foreign {
        return Err(CliError::Usage(format!("{}: neither .gltf nor .glb", text.name)));
    }
    // It is one that every verb takes.
    input::parsed(&text)?;
    print(&text.bytes)?;
    if !options.quiet {
        input::say_notes(&text.notes);
    }
    Ok(Outcome::Done)
}
