//! The main job. A plan becomes a bundle of files in memory, which `bake` writes and `check`
//! compares: the same scene gives the same bytes.

mod assemble;
mod build;
mod cached;
mod compare;
mod includes;
mod names;
mod opening;
mod previous;
mod recipe;

use rayon::prelude::*;

use crate::approximate::{Counter, Fit};
pub use crate::effects::BakeError;
use crate::effects::context::Context;
pub use crate::effects::context::{Progress, Silent, UserHypothesis};
pub use crate::effects::table::BakedTable;
use crate::effects::{Made, Part};
use crate::emit::call::Call;
use crate::emit::manifest::FitLeftOut;
use crate::plan::Plan;
use crate::scene::Scene;
use crate::store::{Cache, Files};
pub use build::{BUILD, BUILD_FILE, sign};
pub use compare::{Difference, Kind, changed, compare};
pub use previous::{PreviousError, previous};
pub use recipe::{TOOL, recipe};

/// What a bake made.
#[derive(Debug)]
pub struct Baked {
    /// Contents by path.
    pub files: Files,
    /// Promises of the scene that were not kept, each a sentence.
    pub broken: Vec<String>,
    /// Truths that were integrated, or interpolated from integrals for the texels of tables of
    /// three axes.
    pub truths: u64,
    /// Tables, of the effects that were computed.
    pub tables: Vec<BakedTable>,
    /// Fits, and published formulas for comparison, of the effects that were computed.
    pub fits: Vec<Fit>,
    /// Hypotheses of the catalogue that have no reliable fit in this scene.
    pub dropped: Vec<FitLeftOut>,
    /// What each material and probe calls.
    pub calls: Vec<Call>,
}

impl Baked {
    /// Takes the results of an effect; what it adds to the files is handed on.
    fn take(&mut self, made: Made) -> Part {
        self.broken.extend(made.broken);
        self.tables.extend(made.tables);
        self.fits.extend(made.fits);
        self.dropped.extend(made.part.entries.fits_left_out.iter().cloned());
        self.calls.extend(made.part.entries.calls.iter().cloned());
        made.part
    }
}

/// What to bake of a plan.
#[derive(Clone, Debug, Default)]
pub struct Selection<'a> {
    /// Names of the effects to bake; empty: all that the plan calls for.
    pub only: Vec<String>,
    /// Parts of the others that are there already.
    pub kept: Vec<Part>,
    /// Where parts that were made once are found, and new ones are put. The effects must be this
    /// package's: of others the code is not known.
    pub cache: Option<&'a Cache>,
}

/// Bakes a plan. Nothing is integrated, fitted, emitted or reported that it does not call for.
///
/// Errors: a hypothesis that is refused, a search that does not end in a minimum, data that is not
/// finite. A promise that is not kept is no error here: it stands in [`Baked::broken`].
pub fn bake(
    scene: &Scene,
    plan: &Plan,
    hypotheses: &[UserHypothesis],
    selection: Selection,
    progress: &dyn Progress,
) -> Result<Baked, BakeError> {
    let recipe = recipe(scene, plan, hypotheses)?;
    let effects = plan.effects.iter().map(|called| called.effect);
    let explore = plan.effects.iter().any(|called| called.by.is_explored()).then_some("explore");
    let pages = std::iter::once("index")
        .chain(explore)
        .chain(effects)
        .map(|page| (page.into(), format!("{page}.html")));
    let pages = pages.collect();
    let context = Context { scene, hypotheses, recipe, counter: Counter::default(), pages, progress };
    names::check(plan, hypotheses)?;
    let Selection { only, kept: mut parts, cache } = selection;
    let mut baked = Baked {
        files: Files::new(),
        broken: Vec::new(),
        truths: 0,
        tables: Vec::new(),
        fits: Vec::new(),
        dropped: Vec::new(),
        calls: Vec::new(),
    };
    let wanted: Vec<_> =
        plan.effects.iter().filter(|c| only.is_empty() || only.iter().any(|o| o == c.effect)).collect();
    // The end of each effect's work, where its own parts have run dry, overlaps with the next
    // effect's.
    let made: Vec<_> =
        wanted.par_iter().with_max_len(1).map(|called| cached::made(called, &context, cache)).collect();
    for made in made {
        parts.push(baked.take(made?));
    }
    parts.sort_by_key(|part| plan.catalogue.iter().position(|effect| *effect == part.by));
    baked.files = assemble::assemble(plan, parts, &context)?;
    baked.truths = context.counter.total();
    Ok(baked)
}
