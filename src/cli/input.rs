//! The scene that a verb works on, with the files of kernels and hypotheses that it names.

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

use super::CliError;
use super::options::{PagesOption, SceneOption, TexturesOption};
use super::output::say_each;
use crate::approximate::FitStageError;
use crate::approximate::target::TargetError;
use crate::bake::{
    BakeError, Baked, Progress, Selection, Shard, Silent, UserHypothesis, bake, context, merge, shard,
};
use crate::emit::header::short;
use crate::plan::{Clamped, Plan};
use crate::scene::{self, Limits, Scene, SceneError, limits};
use crate::store::{self, Cache, StoreError};
use lobefit_fit::FitError;
use lobefit_import::{ENDINGS, Files, Format, Imported, Note, Textures};
use lobefit_shade::{Hypothesis, ShadeError, round_up};
use lobefit_truth::optics::kernel::Kernel;

/// A scene and what it refers to.
#[derive(Clone, Debug, PartialEq)]
pub struct Input {
    /// The scene.
    pub scene: Scene,
    /// Its file, as the user named it.
    pub(super) name: String,
    /// Its hypothesis files, in order of first mention; each parses.
    pub hypotheses: Vec<UserHypothesis>,
    /// The paths at which they were read, by the paths that the scene gives: for messages only,
    /// since nothing that is written may depend on where the scene lies.
    paths: BTreeMap<String, String>,
}

impl Input {
    /// The input as the options of a verb change it.
    pub(super) fn with(mut self, pages: &PagesOption) -> Input {
        self.scene.output.reports &= !pages.no_reports;
        self
    }

    /// The input under the limits of `cost` in place of the scene's.
    pub(super) fn limited(mut self, limits: &Limits) -> Input {
        self.scene = self.scene.limited(limits);
        self
    }

    /// Bakes the scene's plan. Errors name the scene and its hypothesis files by the paths at which
    /// they were read.
    ///
    /// # Errors
    /// What the bake says.
    pub fn bake(
        &self,
        plan: &Plan,
        selection: Selection,
        progress: &dyn Progress,
    ) -> Result<Baked, CliError> {
        self.named(bake(&self.scene, plan, &self.hypotheses, selection, progress))
    }

    /// A piece of the scene's bake: the bytes of its file, and promises that are not kept.
    ///
    /// # Errors
    /// As [`Input::bake`].
    pub(super) fn shard(
        &self,
        plan: &Plan,
        piece: Shard,
        cache: Option<&Cache>,
        progress: &dyn Progress,
    ) -> Result<(Vec<u8>, Vec<String>), CliError> {
        let context = context((&self.scene, plan), &self.hypotheses, cache, progress);
        self.named(context.and_then(|context| shard(plan, piece, &context)))
    }

    /// The scene's bake of its pieces, the files of a folder.
    ///
    /// # Errors
    /// Files that are not its pieces, each once.
    pub(super) fn merge(
        &self,
        plan: &Plan,
        folder: &Path,
        files: &[(String, Vec<u8>)],
    ) -> Result<Baked, CliError> {
        let context = self.named(context((&self.scene, plan), &self.hypotheses, None, &Silent))?;
        Ok(merge(plan, &folder.display().to_string(), files, &context)?)
    }

    /// A result whose error names the scene and its hypothesis files by the paths at which they were
    /// read.
    fn named<T>(&self, mut result: Result<T, BakeError>) -> Result<T, CliError> {
        if let Err(BakeError::Scene { field, message }) = result {
            return Err(SceneError::Whole { file: self.name.clone(), path: field, message }.into());
        }
        if let Some(file) = result.as_mut().err().and_then(hypothesis_file)
            && let Some(path) = self.paths.get(file.as_str())
        {
            path.clone_into(file);
        }
        Ok(result?)
    }
}

/// The hypothesis file that an error names.
fn hypothesis_file(error: &mut BakeError) -> Option<&mut String> {
    match error {
        BakeError::Name { file, .. } | BakeError::Word { file, .. } => Some(file),
        BakeError::Fit(error) => match error {
            FitStageError::Fit(FitError::Shade(error)) => match error {
                ShadeError::Syntax { place, .. }
                | ShadeError::Dialect { place, .. }
                | ShadeError::Irregular { place, .. } => Some(&mut place.file),
                ShadeError::TooLarge { file, .. } => Some(file),
                _ => None,
            },
            FitStageError::NotConverged { hypothesis, .. } | FitStageError::RunAway { hypothesis, .. } => {
                Some(hypothesis)
            }
            FitStageError::Target(
                TargetError::NoInputs { place, .. } | TargetError::Argument { place, .. },
            ) => Some(&mut place.file),
            _ => None,
        },
        _ => None,
    }
}

/// Reads the scene of a verb: a file, standard input, or the built-in one.
///
/// # Errors
/// A scene, or a file that it names, that cannot be read or is refused.
pub fn load(option: &SceneOption) -> Result<Input, CliError> {
    let Some(path) = &option.scene else {
        if option.textures.textures {
            return Err(no_images("the built-in scene"));
        }
        return Ok(Input {
            scene: Scene::built_in()?,
            name: "the built-in scene".into(),
            hypotheses: Vec::new(),
            paths: BTreeMap::new(),
        });
    };
    let text = text(path, &option.textures)?;
    let mut scene = parsed(&text)?;
    scene.made_of = text.ending.map(|ending| in_command(path, ending, &option.textures));
    let Text { name, folder, notes, .. } = text;
    scene.notes = with_errors(notes, &scene)?;
    let (mut hypotheses, mut paths) = (Vec::new(), BTreeMap::new());
    for (path, field) in scene.hypotheses() {
        let file = store::inside(&folder, path)?;
        let shown = file.display().to_string();
        let source = hypothesis(&file, &name, field)?;
        Hypothesis::parse(&shown, &source)?;
        paths.insert(path.to_owned(), shown);
        hypotheses.push(UserHypothesis { file: path.into(), source });
    }
    Ok(Input { scene, name, hypotheses, paths })
}

/// Notes of what a quantile leaves out, with what is off where a shader clamps to the ranges of the scene.
pub(super) fn with_errors(mut notes: Vec<Note>, scene: &Scene) -> Result<Vec<Note>, CliError> {
    for note in &mut notes {
        let Some(all) = note.beyond else { continue };
        if let Some(Clamped { error, roughness, mu }) =
            Clamped::of(scene, &note.of, all).map_err(BakeError::from)?
        {
            let (error, [roughness, mu]) = (round_up(error, 2), [roughness, mu].map(short));
            note.text += &format!(
                "; clamped to the range, E is off by up to {error} (roughness {roughness}, n_dot_v {mu})"
            );
        }
    }
    Ok(notes)
}

/// The JSON of a scene.
pub(super) struct Text {
    /// As the file has it, or made from a foreign file.
    pub bytes: Vec<u8>,
    /// Its file, as the user named it.
    pub name: String,
    /// Where the files are that it names.
    folder: PathBuf,
    /// How names of such files end, where it was made from a foreign one.
    pub ending: Option<&'static str>,
    /// What that file says that the scene does not hold.
    pub notes: Vec<Note>,
}

/// Reads the JSON of a scene: a file of ours, or a foreign one, of which a scene is made.
///
/// # Errors
/// A file that cannot be read; a foreign one that is refused.
pub(super) fn text(path: &Path, images: &TexturesOption) -> Result<Text, CliError> {
    let (bytes, name, folder) = if path.as_os_str() == "-" {
        let name = "<stdin>".to_owned();
        (store::read_stream(io::stdin().lock(), &name, limits::FILE_BYTES)?, name, PathBuf::new())
    } else {
        let folder = path.parent().map(Path::to_path_buf).unwrap_or_default();
        (store::read_beginning(path, lobefit_import::BYTES)?, path.display().to_string(), folder)
    };
    let Some(format) = Format::of(&bytes, &name) else {
        if bytes.len() as u64 > limits::FILE_BYTES {
            return Err(StoreError::TooLarge { path: path.to_owned(), limit: limits::FILE_BYTES }.into());
        }
        if images.textures {
            return Err(no_images(&name));
        }
        return Ok(Text { bytes, name, folder, ending: None, notes: Vec::new() });
    };
    let files = Beside { path, bytes: &bytes, folder: &folder };
    let mut textures = images.textures.then(|| Textures::new(&files, images.quantile.unwrap_or(0.0)));
    let Imported { json, notes } = format.read(&bytes, &name, textures.as_mut())?;
    let ending = Some(format.ending(&bytes));
    Ok(Text { bytes: json.into_bytes(), name, folder, ending, notes })
}

/// A foreign file as the header of a baked file names it in its command: without its folder, with the
/// options that change what is read of it.
fn in_command(path: &Path, ending: &str, images: &TexturesOption) -> String {
    // Headers are lines of comments, and a shell reads the command.
    let plain = |name: &&str| {
        !name.starts_with('-') && name.chars().all(|c| c.is_ascii_alphanumeric() || "._-".contains(c))
    };
    let name = path.file_name().and_then(|name| name.to_str()).filter(plain);
    let mut command = name.map_or_else(|| format!("SCENE.{ending}"), |name| name.to_string());
    if images.textures {
        command += " --textures";
    }
    if let Some(share) = images.quantile {
        command += &format!(" --quantile {share}");
    }
    command
}

fn no_images(name: &str) -> CliError {
    CliError::Usage(format!("--textures: {ENDINGS} is called for; {name} is a scene without images"))
}

/// A foreign file and the folder that it lies in.
struct Beside<'a> {
    path: &'a Path,
    /// All that is read of standard input.
    bytes: &'a [u8],
    folder: &'a Path,
}

impl Files for Beside<'_> {
    fn own(&self, at: u64, length: u64) -> Result<Vec<u8>, String> {
        if self.path.as_os_str() != "-" {
            return store::read_part(self.path, [at, length]).map_err(|e| e.to_string());
        }
        let range = usize::try_from(at).ok().zip(usize::try_from(at.saturating_add(length)).ok());
        let part = range.and_then(|(from, to)| self.bytes.get(from..to));
        part.map(<[u8]>::to_vec).ok_or_else(|| "standard input ends before the end of an image".into())
    }

    fn beside(&self, path: &str, part: Option<[u64; 2]>) -> Result<Vec<u8>, String> {
        let file = store::beside(self.folder, path).map_err(|e| e.to_string())?;
        let bytes = match part {
            Some(part) => store::read_part(&file, part),
            None => store::read(&file, lobefit_import::limits::IMAGE_BYTES),
        };
        bytes.map_err(|e| e.to_string())
    }
}

/// Says what a file holds that the scene does not.
pub(super) fn say_notes(notes: &[Note]) {
    say_each("note", &notes.iter().map(Note::to_string).collect::<Vec<_>>());
}

/// The scene of a text, with the kernels that it names.
///
/// # Errors
/// A scene, or a kernel, that is refused.
pub(super) fn parsed(text: &Text) -> Result<Scene, CliError> {
    Scene::with_kernels(&text.bytes, &text.name, |path, field| {
        let file = store::inside(&text.folder, path)?;
        let bytes = store::read(&file, limits::FILE_BYTES).map_err(|source| CliError::NamedFile {
            scene: text.name.clone(),
            field,
            source,
        })?;
        Ok::<_, CliError>(scene::kernel(&bytes, &file.display().to_string())?)
    })
}

/// The kernel of a word of a command line: one of those with a formula, or the path of a table.
pub fn kernel(word: &str) -> Result<Kernel, CliError> {
    if let Some(kernel) = Kernel::ALL.into_iter().find(|kernel| kernel.word() == word) {
        return Ok(kernel);
    }
    if !word.ends_with(".json") {
        let words = Kernel::WORDS.join(", ");
        let message =
            format!("kernel {word}: one of {words}, or the path of a .json file with a table, is called for");
        return Err(CliError::Usage(message));
    }
    Ok(scene::kernel(&store::read(Path::new(word), limits::FILE_BYTES)?, word)?)
}

/// The text of a hypothesis file that a field of a scene names.
fn hypothesis(file: &Path, scene: &str, field: String) -> Result<String, CliError> {
    let bytes = store::read(file, limits::HYPOTHESIS_BYTES).map_err(|source| CliError::NamedFile {
        scene: scene.to_owned(),
        field,
        source,
    })?;
    String::from_utf8(bytes).map_err(|e| CliError::HypothesisText {
        file: file.display().to_string(),
        at: e.utf8_error().valid_up_to(),
    })
}
