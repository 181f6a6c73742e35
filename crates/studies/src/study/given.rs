//! A scene of the user's that a study is made of.

use std::path::Path;

use lobefit::cli::CliError;
use lobefit::scene::{Position, Scene, SceneError, limits, place};
use lobefit::store;

/// A scene file.
pub struct Given<'a> {
    file: &'a Path,
    bytes: Vec<u8>,
    /// What it says.
    pub scene: Scene,
}

impl Given<'_> {
    /// Reads a scene.
    ///
    /// # Errors
    /// A file that cannot be read, or is no scene.
    pub fn read(file: &Path) -> Result<Given<'_>, CliError> {
        let bytes = store::read(file, limits::FILE_BYTES)?;
        let scene = Scene::from_json(&bytes, &file.display().to_string())?;
        Ok(Given { file, bytes, scene })
    }

    /// The file as it was given; the folder of the study is named after its stem.
    ///
    /// # Errors
    /// A name that no folder can have on every system, or of which nothing stands before `.json`.
    pub fn file(&self) -> Result<String, CliError> {
        let file = self.file.display().to_string();
        let stem = stem(&file);
        if stem.is_empty() {
            let why = "its name has nothing before `.json`, after which the folder of the study is named";
            return Err(CliError::Usage(format!("--scene {file}: {why}")));
        }
        store::inside(Path::new(""), &stem)?;
        Ok(file)
    }

    /// What is said of a field of it that is refused.
    pub fn refused(&self, field: &str, message: impl ToString) -> CliError {
        let at = place(&self.bytes, field).unwrap_or(Position { line: 1, column: 1 });
        let (file, path) = (self.file.display().to_string(), field.into());
        SceneError::Field { file, at, path, message: message.to_string() }.into()
    }

    /// Reads a file of at most so many bytes that a field names by its path relative to the scene: its
    /// name for messages, and its bytes.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn beside(&self, path: &str, field: &str, limit: u64) -> Result<(String, Vec<u8>), CliError> {
        let refused = |e| self.refused(field, e);
        let path = store::inside(self.file.parent().unwrap_or(Path::new("")), path).map_err(refused)?;
        Ok((path.display().to_string(), store::read(&path, limit).map_err(refused)?))
    }
}

/// The name of a scene's file in its folder, without `.json`.
pub fn stem(file: &str) -> String {
    let name = Path::new(file).file_name().unwrap_or_default().to_string_lossy();
    name.strip_suffix(".json").unwrap_or(&name).into()
}
