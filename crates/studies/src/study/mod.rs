//! The long studies, whose pages are committed with the hash of their recipe and which no bake
//! waits for. [`run`] makes the files of one in memory: the same parameters give the same bytes for
//! any number of threads.

pub mod coupling;
mod given;
pub mod occlusion;
mod page;
pub mod parallax;
pub mod stability;

pub use given::Given;

use serde::Serialize;
use serde_json::Value;

use crate::flip::FlipError;
use coupling::surface::SurfaceError;
use lobefit::approximate::FitStageError;
use lobefit::bake::{Progress, TOOL};
use lobefit::cli::{CliError, PackageError};
use lobefit::report::{Origin, Page, ReportError, bar_from, html};
use lobefit::scene::SceneError;
use lobefit::store::Files;
use lobefit_fit::FitError;
use lobefit_formula::fitting::FittingError;
use lobefit_shade::ShadeError;
use lobefit_truth::integrate::IntegrateError;
use page::REDUCED;
use parallax::room::cubemap::CubemapError;

/// A long experiment: a value of the list [`STUDIES`], with a folder that holds everything of it.
pub trait Study: Send + Sync {
    /// The word for it on the command line, and its folder.
    fn name(&self) -> &'static str;

    /// Hash of its code, without that of other studies.
    fn code(&self) -> &'static str;

    /// What it shows, for the help.
    fn about(&self) -> &'static str;

    /// Everything that it covers at a size.
    ///
    /// # Errors
    /// As [`run`].
    fn parameters(&self, size: Size) -> Result<Value, StudyError>;

    /// The study of a scene of the user's, in a folder of its own; none where it takes no scene, or where
    /// the scene does not call for it.
    ///
    /// # Errors
    /// A file that cannot be read, or is refused; what the study cannot measure.
    fn of_scene(&self, _given: &Given) -> Result<Option<Box<dyn Study>>, CliError> {
        Ok(None)
    }

    /// The name of the scene of the user's that it is of, and its file as it was given.
    fn scene(&self) -> Option<[&str; 2]> {
        None
    }

    /// The formulas that it compares, beside its code.
    fn formulas(&self) -> Vec<&'static str> {
        Vec::new()
    }

    /// How long its parts take on this machine, by a command; none of a study that times nothing.
    ///
    /// # Errors
    /// As [`run`].
    fn timed(&self, _size: Size, _command: String) -> Result<Option<Timed>, StudyError> {
        Ok(None)
    }

    /// The same study, whose page shows a record of [`Study::timed`]; none of one that times nothing.
    ///
    /// # Errors
    /// What is no such record.
    fn with_times(&self, _record: &[u8]) -> Result<Option<Box<dyn Study>>, serde_json::Error> {
        Ok(None)
    }

    /// Its page and its results, which name their origin.
    ///
    /// # Errors
    /// As [`run`].
    fn made(
        &self,
        size: Size,
        origin: Origin,
        progress: &dyn Progress,
    ) -> Result<(Page, Vec<u8>), StudyError>;
}

/// What [`Study::timed`] makes.
#[derive(Debug)]
pub struct Timed {
    /// The record.
    pub record: Vec<u8>,
    /// The study of the size that was timed, whose page shows the record.
    pub study: Box<dyn Study>,
}

/// Every study of this version.
pub static STUDIES: [&dyn Study; 4] = [
    &coupling::DiffuseCouplings,
    &parallax::ProbeLookups,
    &stability::Stability,
    &occlusion::Occlusion { own: None, times: None, choices: None },
];

impl dyn Study + '_ {
    /// The files that it writes, relative to the folder of a bake: page and results. The reduced
    /// study and that of each scene have a folder of their own.
    pub fn files(&self, size: Size) -> [String; 2] {
        let reduced = if size == Size::Reduced { "-reduced" } else { "" };
        let own = self.scene().map_or_else(String::new, |[_, file]| format!("-scene-{}", given::stem(file)));
        ["index.html", "results.json"]
            .map(|file| format!("reports/studies/{}{reduced}{own}/{file}", self.name()))
    }

    /// The record of its times, beside them.
    pub fn times_file(&self, size: Size) -> String {
        let [page, _] = self.files(size);
        page.replace("index.html", "times.json")
    }

    /// Hash of everything that the study follows from: the tool's version, its own code, what else its
    /// files say of their origin, the parameters at a size and the formulas compared. Of the code below
    /// this package the version stands, and values of its formulas among the parameters.
    ///
    /// # Errors
    /// As [`run`].
    pub fn recipe(&self, size: Size) -> Result<String, StudyError> {
        Ok(self.origin(size)?.recipe)
    }

    /// What makes it.
    pub fn command(&self, size: Size) -> String {
        let reduced = if size == Size::Reduced { " --reduced" } else { "" };
        let of = self.scene().map_or_else(String::new, |[_, file]| format!(" --scene {file}"));
        format!("lobefit report --study {}{of}{reduced}", self.name())
    }

    /// What made a study: enough to make it again.
    fn origin(&self, size: Size) -> Result<Origin, StudyError> {
        let mut origin = Origin {
            scene: self.scene().map_or_else(String::new, |[name, _]| name.into()),
            recipe: String::new(),
            tool: env!("CARGO_PKG_VERSION").into(),
            command: self.command(size),
            pages: bar_from("../../")?,
        }
        .with_figures("results.json");
        let mut hasher = blake3::Hasher::new();
        hasher.update(TOOL.as_bytes());
        hasher.update(self.code().as_bytes());
        hasher.update(&serde_json::to_vec(&origin)?);
        hasher.update(self.parameters(size)?.to_string().as_bytes());
        self.formulas().into_iter().fold(&mut hasher, |h, source| h.update(source.as_bytes()));
        origin.recipe = hasher.finalize().to_hex().to_string();
        Ok(origin)
    }
}

impl std::fmt::Debug for dyn Study + '_ {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

/// How much work a study does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Size {
    /// What is committed: minutes.
    Full,
    /// The same with fewer and smaller pictures: seconds.
    Reduced,
}

/// Why a study made nothing.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StudyError {
    /// A material could not be evaluated.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// Pictures could not be compared.
    #[error(transparent)]
    Flip(#[from] FlipError),
    /// A formula of the catalogue that does not parse.
    #[error(transparent)]
    Formula(#[from] FitError),
    /// A lookup that cannot be printed.
    #[error(transparent)]
    Code(#[from] lobefit_shade::code::CodeError),
    /// The catalogue could not be fitted.
    #[error(transparent)]
    Catalogue(#[from] FitStageError),
    /// A formula of the catalogue could not be fitted for what is seen.
    #[error(transparent)]
    Fitting(#[from] FittingError),
    /// A footprint could not be integrated.
    #[error(transparent)]
    Footprint(#[from] IntegrateError),
    /// A fit that returned nothing.
    #[error("{name}: no fit was made")]
    Unfitted {
        /// The formula.
        name: String,
    },
    /// A cubemap could not be made.
    #[error(transparent)]
    Cubemap(#[from] CubemapError),
    /// No constants of a lobe were found.
    #[error("fit of a lobe's axis and widths in the practice room: {reason}")]
    Lobe {
        /// What the search came to.
        reason: String,
    },
    /// A proxy is the planes about a probe.
    #[error("room {room}: its probe at {probe:?} is not inside of all of its walls; move `probe`")]
    Outside {
        /// The room.
        room: String,
        /// Where its probe is.
        probe: [f64; 3],
    },
    /// The scene of a study that could not be read.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A scene without what its study simulates.
    #[error("examples/culling.json: it has no `culling`")]
    NoCulling,
    /// The page refused its data.
    #[error(transparent)]
    Report(#[from] ReportError),
    /// Parameters could not be put into JSON.
    #[error("cannot write JSON: {0}")]
    Json(#[from] serde_json::Error),
}

impl From<ShadeError> for StudyError {
    fn from(error: ShadeError) -> Self {
        FitError::from(error).into()
    }
}

/// The files of a study, by path relative to the folder of a bake.
///
/// # Errors
/// A defect of this program: the parameters are its own.
pub fn run(study: &dyn Study, size: Size, progress: &dyn Progress) -> Result<Files, StudyError> {
    let (page, results) = study.made(size, study.origin(size)?, progress)?;
    Ok(study.files(size).into_iter().zip([html(&page).into_bytes(), results]).collect())
}

/// What is wrong with a study in a folder.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Stale {
    /// The file.
    pub file: String,
    /// A sentence.
    pub detail: String,
}

/// What is wrong with the files of a study of a size in a folder: another recipe than that of this
/// version, or one file without the other. Nothing is wrong where there are none.
///
/// # Errors
/// As [`run`].
pub fn stale(study: &dyn Study, size: Size, found: &Files) -> Result<Option<Stale>, StudyError> {
    let names = study.files(size);
    let again = format!("make it again with {}", study.origin(size)?.command);
    let Some(present) = names.iter().find(|name| found.contains_key(*name)) else { return Ok(None) };
    if let Some(missing) = names.iter().find(|name| !found.contains_key(*name)) {
        let detail = format!("missing, and {present} is there; {again}");
        return Ok(Some(Stale { file: missing.clone(), detail }));
    }
    let recipe = study.recipe(size)?;
    let [page, results] = names;
    let of = |name: &String| found.get(name).map(Vec::as_slice).unwrap_or_default();
    let document: Option<Value> = serde_json::from_slice(of(&results)).ok();
    let wrong = if document.is_none_or(|document| document["origin"]["recipe"] != recipe) {
        Some(results)
    } else {
        // The page names the recipe too.
        let named = of(&page).windows(recipe.len()).any(|w| w == recipe.as_bytes());
        (!named).then_some(page)
    };
    Ok(wrong.map(|file| Stale {
        file,
        detail: format!("not of the recipe {recipe} of this version's study; {again}"),
    }))
}

/// What made the files of a study in a folder, if that is another command than makes this one: a scene
/// of the same file name lies elsewhere.
pub fn other(study: &dyn Study, size: Size, results: &[u8]) -> Option<String> {
    let document: Option<Value> = serde_json::from_slice(results).ok();
    let command = document?["origin"]["command"].as_str()?.to_string();
    (command != study.command(size)).then_some(command)
}

impl PackageError for StudyError {
    /// A study has no input: what it does not reach is a promise of ours.
    fn exit_code(&self) -> u8 {
        1
    }
}

impl From<StudyError> for CliError {
    fn from(error: StudyError) -> CliError {
        CliError::Package(Box::new(error))
    }
}
