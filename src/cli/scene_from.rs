//! `lobefit scene-from`: the scene that a glTF or MaterialX file is read as, to be edited.

use std::path::PathBuf;

use clap::Args;
use lobefit_import::ENDINGS;

use super::CliError;
use super::input;
use super::options::TexturesOption;
use super::output::{Outcome, print};

pub(super) const EXAMPLES: &str = "\
Examples:
  lobefit scene-from room.glb > scene.json   then state errors, budgets and tables, and bake that
  lobefit scene-from room.glb --textures     ranges as narrow as the images of the file
  lobefit plan room.glb                      what the file calls for as it is";

/// Options of `scene-from`.
#[derive(Args)]
pub(super) struct Options {
    /// File of glTF 2.0 or MaterialX: .gltf, .glb or .mtlx
    pub file: PathBuf,
    #[command(flatten)]
    pub textures: TexturesOption,
    /// Say nothing of what the scene leaves out
    #[arg(long, short)]
    pub quiet: bool,
}

pub(super) fn run(options: &Options) -> Result<Outcome, CliError> {
    let text = input::text(&options.file, &options.textures)?;
    if text.ending.is_none() {
        return Err(CliError::Usage(format!("{}: {ENDINGS} is called for", text.name)));
    }
    // It is one that every verb takes.
    let scene = input::parsed(&text)?;
    print(&text.bytes)?;
    if !options.quiet {
        input::say_notes(&input::with_errors(text.notes, &scene)?);
    }
    Ok(Outcome::Done)
}
