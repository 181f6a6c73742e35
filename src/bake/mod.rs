//! The main job. A plan becomes a bundle of files in memory, which `bake` writes and `check` compares: the same
//! scene gives the same bytes.

mod build;
mod compare;
mod includes;
mod kept;
mod names;
mod opening;
mod part;
mod recipe;

use crate::approximate::{Counter, Dropped, Fit};
pub use crate::effects::BakeError;
use crate::effects::context::Context;
pub use crate::effects::context::{Progress, Silent, UserHypothesis};
use crate::effects::origin;
pub use crate::effects::reflection::bake::BakedTable;
pub use crate::effects::table::bake::BakedVolume;
use crate::effects::{coupling, parallax, reflection, sheen, table};
use crate::plan::{EffectName, Plan};
use crate::scene::Scene;
use crate::store::Files;
pub use build::{BUILD_FILE, sign};
pub use compare::{Difference, Kind, compare};
pub use kept::{KeptError, kept};
pub use part::Part;
pub use recipe::{TOOL, recipe};

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
    pub(crate) fn take(&mut self, fits: Vec<Fit>, dropped: Vec<Dropped>) {
        for fit in fits {
            if !self.fits.iter().any(|known| known.approximation.name == fit.approximation.name) {
                self.fits.push(fit);
            }
        }
        self.dropped.extend(dropped);
    }
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
                parts.push(reflection::bake::part(
                    scene,
                    plan,
                    effect,
                    hypotheses,
                    &mut baked,
                    &mut context,
                )?);
            }
            EffectName::Anisotropy | EffectName::Glass => {
                parts.push(table::bake::part(scene, plan, effect, &mut baked, &mut context)?);
            }
            EffectName::DiffuseCoupling => {
                parts.push(coupling::bake::part(scene, &plan.couplings, effect, &mut baked, &mut context)?);
            }
            EffectName::Sheen => {
                let job = plan.sheen.as_ref();
                let job = job.ok_or_else(|| BakeError::Internal("a sheen without a job".into()))?;
                parts.push(sheen::bake::part(scene, job, effect, &mut baked, &mut context)?);
            }
            EffectName::Parallax => {
                parts.push(parallax::bake::part(scene, &plan.parallaxes, effect, &mut baked, &mut context)?);
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
