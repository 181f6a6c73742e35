//! The long studies, whose pages are committed with the hash of their recipe and which no bake waits for. [`run`] makes the files of
//! one in memory: the same parameters give the same bytes for any number of threads.

mod coupling;
mod parallax;

use crate::approximate::FitStageError;
use crate::bake::Progress;
use crate::effects::room::cubemap::CubemapError;
use crate::effects::surface::SurfaceError;
use crate::fitting::FittingError;
use crate::report::flip::FlipError;
use crate::report::{ReportError, study_folder};
use crate::store::Files;
use lobefit_fit::FitError;
use lobefit_shade::ShadeError;
use lobefit_truth::integrate::IntegrateError;

/// A study.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Study {
    /// Diffuse bases under specular lobes: furnace, lit spheres, ranking.
    Coupling,
    /// Lookups of a probe's cubemap in rooms.
    Parallax,
}

impl Study {
    /// All of them.
    pub const ALL: [Study; 2] = [Study::Coupling, Study::Parallax];

    /// The word for it on the command line, and its folder.
    pub fn name(self) -> &'static str {
        match self {
            Study::Coupling => "coupling",
            Study::Parallax => "parallax",
        }
    }

    /// The study of a name.
    pub fn from_name(name: &str) -> Option<Study> {
        Study::ALL.into_iter().find(|study| study.name() == name)
    }

    /// The files that it writes, relative to the folder of a bake.
    pub fn files(self) -> [String; 2] {
        ["index.html", "results.json"].map(|file| format!("{}/{file}", study_folder(self.name())))
    }

    /// Hash of everything that the study follows from: the tool's version, its parameters at a size, the formulas compared.
    ///
    /// # Errors
    /// As [`run`].
    pub fn recipe(self, size: Size) -> Result<String, StudyError> {
        match self {
            Study::Coupling => coupling::recipe(size),
            Study::Parallax => parallax::recipe(size),
        }
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
pub fn run(study: Study, size: Size, progress: &dyn Progress) -> Result<Files, StudyError> {
    let files = match study {
        Study::Coupling => coupling::files(size, progress)?,
        Study::Parallax => parallax::files(size, progress)?,
    };
    Ok(files.into_iter().map(|file| (file.path, file.bytes)).collect())
}

/// What is wrong with the files of a study in a folder, as a file and a sentence: another recipe than that of the full study of this version, or
/// one file without the other. Nothing is wrong where there are none.
///
/// # Errors
/// As [`run`].
pub fn stale(study: Study, found: &Files) -> Result<Option<(String, String)>, StudyError> {
    let names = study.files();
    let again = format!("make it again with lobefit report --study {}", study.name());
    let Some(present) = names.iter().find(|name| found.contains_key(*name)) else { return Ok(None) };
    let [_, results] = &names;
    if let Some(missing) = names.iter().find(|name| !found.contains_key(*name)) {
        return Ok(Some((missing.clone(), format!("missing, and {present} is there; {again}"))));
    }
    let recipe = study.recipe(Size::Full)?;
    let reduced = study.recipe(Size::Reduced)?;
    let wrong = |file: &String| {
        let holds = |bytes: &Vec<u8>| bytes.windows(reduced.len()).any(|w| w == reduced.as_bytes());
        let which = if found.get(file).is_some_and(holds) { ", but of the reduced one" } else { "" };
        let detail = format!("not of the recipe {recipe} of this version's study{which}; {again}");
        Ok(Some((file.clone(), detail)))
    };
    let document: Option<serde_json::Value> =
        found.get(results).and_then(|bytes| serde_json::from_slice(bytes).ok());
    if document.is_none_or(|document| document["origin"]["recipe"] != recipe) {
        return wrong(results);
    }
    // The page names the recipe in its head.
    let named = |bytes: &Vec<u8>| bytes.windows(recipe.len()).any(|w| w == recipe.as_bytes());
    match names.iter().find(|name| !found.get(*name).is_some_and(named)) {
        Some(file) => wrong(file),
        None => Ok(None),
    }
}
