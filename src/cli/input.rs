//! The scene that a verb works on, with the hypothesis files that it names.

use std::io;
use std::path::{Path, PathBuf};

use super::CliError;
use super::options::SceneOption;
use crate::bake::UserHypothesis;
use crate::scene::{Scene, limits};
use crate::store;

/// A scene and what it refers to.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Input {
    /// The scene.
    pub scene: Scene,
    /// Its hypothesis files, in order of first mention.
    pub hypotheses: Vec<UserHypothesis>,
}

/// Reads the scene of a verb: a file, standard input, or the built-in one.
pub(super) fn load(option: &SceneOption) -> Result<Input, CliError> {
    let Some(path) = &option.scene else {
        return Ok(Input { scene: Scene::built_in()?, hypotheses: Vec::new() });
    };
    let (bytes, name, folder) = if path.as_os_str() == "-" {
        let name = "<stdin>".to_owned();
        (store::read_stream(io::stdin().lock(), &name, limits::FILE_BYTES)?, name, PathBuf::new())
    } else {
        let folder = path.parent().map(Path::to_path_buf).unwrap_or_default();
        (store::read(path, limits::FILE_BYTES)?, path.display().to_string(), folder)
    };
    let scene = Scene::from_json(&bytes, &name)?;
    let hypotheses =
        scene.hypotheses().into_iter().map(|path| hypothesis(&folder, path)).collect::<Result<_, _>>()?;
    Ok(Input { scene, hypotheses })
}

fn hypothesis(folder: &Path, path: &str) -> Result<UserHypothesis, CliError> {
    let file = store::inside(folder, path)?;
    let text = String::from_utf8(store::read(&file, limits::HYPOTHESIS_BYTES)?).map_err(|e| {
        CliError::HypothesisText { file: file.display().to_string(), at: e.utf8_error().valid_up_to() }
    })?;
    Ok(UserHypothesis { file: path.into(), source: text })
}
