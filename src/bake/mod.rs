//! The main job. A plan becomes a bundle of files in memory, which `bake` writes and `check` compares: the same
//! scene gives the same bytes.

mod compare;
mod containers;
mod context;
mod coupling;
mod includes;
mod kept;
mod names;
mod opening;
mod parallax;
mod part;
mod recipe;
mod reflection;
mod sheen;
mod volume;

use crate::data::TableError;
use crate::effects::reflection::{Counter, Dropped, Fit, FitStageError};
use crate::effects::surface::SurfaceError;
use crate::effects::volume::{LookupError, VolumeError};
use crate::emit::container::ContainerError;
use crate::emit::exr::ExrError;
use crate::plan::{EffectName, Plan};
use crate::report::{Origin, ReportError};
use crate::scene::Scene;
use crate::store::Files;
pub use compare::{Difference, Kind, compare};
use context::Context;
pub use context::{Progress, Silent};
pub use kept::{KeptError, kept};
use lobefit_shade::code;
use lobefit_truth::integrate::IntegrateError;
pub use part::Part;
pub use recipe::{TOOL, UserHypothesis, recipe};
pub use reflection::BakedTable;
pub use volume::BakedVolume;

/// What a bake made.
#[derive(Debug)]
pub struct Baked {
    /// Contents by path.
    pub files: Files,
    /// Promises of the scene that were not kept, each a sentence.
    pub broken: Vec<String>,
    /// Truths that were integrated, or interpolated from integrals for the texels of tables of three axes.
    pub truths: u64,
    /// Tables.
    pub tables: Vec<BakedTable>,
    /// Fits, and published formulas for comparison.
    pub fits: Vec<Fit>,
    /// Hypotheses of the catalogue that have no reliable fit in this scene.
    pub dropped: Vec<Dropped>,
    /// Tables of three axes.
    pub volumes: Vec<BakedVolume>,
}

impl Baked {
    /// Adds the fits of one of an effect's jobs. A published formula is measured for each of them; one entry is enough where names are
    /// asked for.
    fn take(&mut self, fits: Vec<Fit>, dropped: Vec<Dropped>) {
        for fit in fits {
            if !self.fits.iter().any(|known| known.approximation.name == fit.approximation.name) {
                self.fits.push(fit);
            }
        }
        self.dropped.extend(dropped);
    }
}

/// Why a bake made nothing.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BakeError {
    /// A hypothesis or a fit.
    #[error(transparent)]
    Fit(#[from] FitStageError),
    /// A table's shape or values.
    #[error(transparent)]
    Table(#[from] TableError),
    /// An image could not be encoded or decoded.
    #[error(transparent)]
    Exr(#[from] ExrError),
    /// A truth could not be integrated.
    #[error(transparent)]
    Integrate(#[from] IntegrateError),
    /// A function could not be printed.
    #[error(transparent)]
    Code(#[from] code::CodeError),
    /// The report refused its data.
    #[error(transparent)]
    Report(#[from] ReportError),
    /// A document could not be put into JSON.
    #[error("cannot write JSON: {0}")]
    Json(#[from] serde_json::Error),
    /// A hypothesis has the name of another function.
    #[error(
        "{file}: function `{function}` has, or leads to, the name of another emitted function; rename it"
    )]
    Name {
        /// The hypothesis' file.
        file: String,
        /// The name.
        function: String,
    },
    /// Several fetches from a chain of a kernel for which no rule says where they go.
    #[error(
        "lookups of {kernel} chains: no rule of {fetches} fetches is fitted for that lobe; give `taps` 1"
    )]
    NoRule {
        /// The kernel's word.
        kernel: &'static str,
        /// Fetches asked for.
        fetches: usize,
    },
    /// A hypothesis whose function cannot be called so in an emitted language.
    #[error("{file}: {reason}")]
    Word {
        /// The hypothesis' file.
        file: String,
        /// What the printer says.
        reason: String,
    },
    /// A whole material.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// A table of three axes.
    #[error(transparent)]
    Volume(#[from] VolumeError),
    /// A table cannot be looked up.
    #[error(transparent)]
    Lookup(#[from] LookupError),
    /// A table cannot be put into a file.
    #[error(transparent)]
    Container(#[from] ContainerError),
    /// A defect of this program.
    #[error("internal error: {0}")]
    Internal(String),
}

/// What to bake of a plan.
#[derive(Clone, Debug, Default)]
pub struct Selection {
    /// The effects to bake; empty: all that the plan calls for.
    pub only: Vec<EffectName>,
    /// Parts of the others that are there already.
    pub kept: Vec<Part>,
}

/// Bakes a plan. Nothing is integrated, fitted, emitted or reported that it does not call for.
///
/// Errors: a hypothesis that is refused, a search that does not end in a minimum, data that is not finite. A promise that is
/// not kept is no error here: it is told in [`Baked::broken`].
pub fn bake(
    scene: &Scene,
    plan: &Plan,
    hypotheses: &[UserHypothesis],
    selection: Selection,
    progress: &dyn Progress,
) -> Result<Baked, BakeError> {
    let recipe = recipe(scene, hypotheses)?;
    let mut context = Context { recipe, counter: Counter::default(), broken: Vec::new(), progress };
    names::check(hypotheses)?;
    let wanted = |effect| selection.only.is_empty() || selection.only.contains(&effect);
    let mut baked = Baked {
        files: Files::new(),
        broken: Vec::new(),
        truths: 0,
        tables: Vec::new(),
        fits: Vec::new(),
        dropped: Vec::new(),
        volumes: Vec::new(),
    };
    let mut parts = selection.kept;
    for effect in plan.effects.iter().filter(|e| wanted(e.effect)) {
        match effect.effect {
            EffectName::Reflection => {
                parts.push(reflection::part(scene, plan, effect, hypotheses, &mut baked, &mut context)?);
            }
            EffectName::Anisotropy | EffectName::Glass => {
                parts.push(volume::part(scene, plan, effect, &mut baked, &mut context)?);
            }
            EffectName::DiffuseCoupling => {
                parts.push(coupling::part(scene, &plan.couplings, effect, &mut baked, &mut context)?);
            }
            EffectName::Sheen => {
                let job = plan.sheen.as_ref();
                let job = job.ok_or_else(|| BakeError::Internal("a sheen without a job".into()))?;
                parts.push(sheen::part(scene, job, effect, &mut baked, &mut context)?);
            }
            EffectName::Parallax => {
                parts.push(parallax::part(scene, &plan.parallaxes, effect, &mut baked, &mut context)?);
            }
            other => {
                return Err(BakeError::Internal(format!("no bake of the effect {}", other.name())));
            }
        }
    }
    parts.sort_by_key(|part| part.effect);
    let origin = origin(scene, &context);
    baked.files =
        part::assemble(plan, &parts, &opening::opening(scene.smith, scene.alpha, &parts), origin, &context)?;
    baked.truths = context.counter.total();
    baked.broken = context.broken;
    Ok(baked)
}

fn origin(scene: &Scene, context: &Context) -> Origin {
    Origin {
        scene: scene.name.clone(),
        recipe: context.recipe.hash.clone(),
        tool: env!("CARGO_PKG_VERSION").into(),
        command: context.recipe.command.clone(),
    }
}
