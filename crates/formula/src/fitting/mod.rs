//! A formula of the user's fitted to a quantity: samples, search, proof, certificates, code, page.
//! [`fit`] measures, [`files`] makes what is written of it; nothing here touches the file system.

pub(crate) mod catalogue;
mod constraint_check;
mod demands;
pub(crate) mod document;
pub(crate) mod one;
mod page;
mod pictures;
mod poles;
mod printed;
mod summary;
mod vanished;
mod weight;
pub(crate) mod words;

pub use catalogue::CatalogueFit;
pub use constraint_check::ConstraintCheck;
pub use demands::Demand;
pub use document::{document, files};
pub use one::{Certified, Proof, Weighted};
pub use summary::summary;

use std::sync::Arc;

use lobefit::approximate::target::{Target, TargetError, TargetSpec};
use lobefit::approximate::{FitStageError, Memo};
use lobefit::cli::{CliError, PackageError};
use lobefit::data::WeightsError;
use lobefit::report::ReportError;
use lobefit_fit::{FitError, Fitted, Goal, Termination};
use lobefit_shade::code::{CodeError, Language};
use lobefit_shade::{Hypothesis, Place, Precision, ShadeError};

/// What to fit, and how.
#[derive(Clone, Debug)]
pub struct Job {
    /// The formula.
    pub hypothesis: Hypothesis,
    /// What it should be.
    pub spec: TargetSpec,
    /// What the coefficients minimise: one fit for each.
    pub goals: Vec<Goal>,
    /// Weight of the errors that are minimised: a WGSL expression of the inputs, or `perceptual`
    /// for [`crate::perceptual::Perceptual`].
    pub weight: Option<String>,
    /// What the coefficients have to obey.
    pub demands: Vec<Demand>,
    /// Arithmetic to certify in; the first is the main one.
    pub precisions: Vec<Precision>,
    /// Starting points of the search.
    pub starts: usize,
    /// Whether parameters that coincide or do not matter are reported, and no error.
    pub allow_undetermined: bool,
    /// Largest error that is accepted.
    pub limit: Option<f64>,
    /// Languages to print the code in.
    pub languages: Vec<Language>,
    /// Command that does this again.
    pub command: String,
}

/// Everything that was found.
#[derive(Clone, Debug)]
pub struct Fitting {
    /// What was fitted to.
    pub target: Target,
    /// One fit for each goal, in order.
    pub fits: Vec<Certified>,
    /// What the catalogue has for no more operations.
    pub catalogue: Vec<CatalogueFit>,
}

/// Why nothing was fitted.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FittingError {
    /// The quantity, the domain, the use.
    #[error(transparent)]
    Target(#[from] TargetError),
    /// The formula, its data or its domain.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// The catalogue's formulas in the same domain.
    #[error(transparent)]
    Catalogue(#[from] FitStageError),
    /// The models of vendors' GPUs: a defect of the program.
    #[error(transparent)]
    Weights(#[from] WeightsError),
    /// A fit whose main certificate cannot be had: it is not finite where it is measured.
    #[error("{name}: {reason}")]
    Uncertified {
        /// The fit.
        name: String,
        /// What is not finite and where, and the pole that was not excluded if there is one.
        reason: String,
    },
    /// Parameters that coincide or do not matter: no values of them can be told from others.
    #[error(
        "{place}: {name}: {}: {rank} of {parameters} parameters determined (rank {rank}). Take parameters out of the formula, or put \
         numbers in their place, until {rank} {} left; or have them told and no more, with --allow-undetermined",
        told.join("; "), if *rank == 1 { "is" } else { "are" }
    )]
    Undetermined {
        /// Where the first of them is declared.
        place: Box<Place>,
        /// The fit.
        name: String,
        /// Which parameters, in sentences.
        told: Vec<String>,
        /// Combinations of parameters that are determined.
        rank: usize,
        /// Number of parameters.
        parameters: usize,
    },
    /// A weight that is no expression of the inputs, or has a value that is no weight.
    #[error("weight `{expression}`: {reason}")]
    Weight {
        /// The expression.
        expression: String,
        /// What is wrong with it.
        reason: String,
    },
    /// A function that cannot be printed.
    #[error("{file}: {source}")]
    Code {
        /// The formula's file.
        file: String,
        /// What the printer says.
        source: CodeError,
    },
    /// The page refused its data.
    #[error(transparent)]
    Report(#[from] ReportError),
    /// A document could not be put into JSON.
    #[error("cannot write JSON: {0}")]
    Json(#[from] serde_json::Error),
}

impl From<ShadeError> for FittingError {
    fn from(error: ShadeError) -> Self {
        FitError::from(error).into()
    }
}

impl PackageError for FittingError {
    fn exit_code(&self) -> u8 {
        if matches!(self, FittingError::Uncertified { .. }) { 1 } else { 2 }
    }
}

impl From<FittingError> for CliError {
    fn from(error: FittingError) -> CliError {
        match &error {
            // The settings have the names of the options.
            FittingError::Target(target) if target.names_a_setting() => CliError::Usage(format!("--{error}")),
            FittingError::Weight { .. } => CliError::Usage(format!("--{error}")),
            _ => CliError::Package(Box::new(error)),
        }
    }
}

impl FittingError {
    /// Refuses a formula of which some parameters are determined nowhere. An end that is no halt is
    /// told of as such.
    fn of_rank(hypothesis: &Hypothesis, fitted: &Fitted) -> Result<(), FittingError> {
        let halted = fitted.termination.is_converged() || fitted.termination == Termination::Saddle;
        if !fitted.undetermined_everywhere || !halted {
            return Ok(());
        }
        let first = hypothesis.parameters().iter().find(|p| fitted.names_undetermined(&p.name));
        let place =
            first.map_or_else(|| hypothesis.place_of_function(), |p| hypothesis.place_of_parameter(&p.name));
        Err(FittingError::Undetermined {
            place: Box::new(place),
            name: hypothesis.name().into(),
            told: fitted.undetermined.clone(),
            rank: fitted.rank,
            parameters: hypothesis.parameters().len(),
        })
    }

    /// The measurement that failed, and the proof if it failed before.
    fn uncertified(hypothesis: &Hypothesis, proof: &Proof, error: &TargetError) -> FittingError {
        let reason = match proof {
            Proof::NotProven(pole) => format!("not proven finite in its domain: {pole}; measured, {error}"),
            Proof::Regular => format!("no certificate: {error}"),
        };
        FittingError::Uncertified { name: hypothesis.name().into(), reason }
    }
}

/// Fits the formula for every goal and certifies each fit.
///
/// # Errors
/// Bad input: an unknown input, a bad domain, a formula that is not finite on its samples,
/// constraints that contradict one another, parameters that coincide or do not matter, unless
/// allowed ([`FittingError::Undetermined`]); a formula that is not finite where it is measured in
/// the main arithmetic ([`FittingError::Uncertified`]). A search that does not converge, a pole
/// that cannot be excluded, and an error above the limit are no errors here: they are reported in
/// [`Certified::problems`].
pub fn fit(job: &Job) -> Result<Fitting, FittingError> {
    let target = Target::new(&job.spec, &job.hypothesis)?;
    // Refused before the work.
    let weight = job.weight.as_deref().map(|text| weight::Weight::parse(text, &target)).transpose()?;
    for language in &job.languages {
        printed::check(*language, &job.hypothesis)?;
    }
    let constraints = demands::constraints(&job.demands, &target, &job.hypothesis)?;
    let measured = Arc::new(target.measured(&Memo::default())?);
    let one = |goal: &Goal| one::fit_one(job, *goal, &target, weight.as_ref(), &constraints, &measured);
    let fits: Vec<Certified> = job.goals.iter().map(one).collect::<Result<_, _>>()?;
    let most = fits.iter().map(|fit| fit.approximation.cost.ops).max().unwrap_or(0);
    let catalogue = catalogue::fits(&job.spec, (&target, &measured), most, None)?;
    Ok(Fitting { target, fits, catalogue })
}
