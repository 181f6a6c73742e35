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
mod shard;

use rayon::prelude::*;

use crate::approximate::{Fit, Memo};
pub use crate::effects::BakeError;
pub use crate::effects::context::{Context, Progress, Silent, UserHypothesis};
pub use crate::effects::table::BakedTable;
use crate::effects::{Called, Made, Part, catalogue};
use crate::emit::call::Call;
use crate::emit::manifest::FitLeftOut;
use crate::plan::Plan;
use crate::scene::Scene;
use crate::store::{Cache, Files};
pub use build::{BUILD, BUILD_FILE, sign};
pub use compare::{Difference, Kind, changed, compare, different_text};
pub use previous::{PreviousError, previous};
pub use recipe::{TOOL, recipe};
pub use shard::{ENDING as SHARD_ENDING, MOST as SHARDS, Shard, ShardError, merge, shard};

/// What a bake made.
#[derive(Debug, Default)]
pub struct Baked {
    /// Contents by path.
    pub files: Files,
    /// Promises of the scene that were not kept, each a sentence.
    pub broken: Vec<String>,
    /// Truths that were integrated, or interpolated from integrals for the texels of tables of three axes;
    /// none of what a cache had.
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
    /// Where results that were made once are found, and new ones are put: fits, certificates, truths and
    /// texels. It is not looked at where an effect is not this package's, whose code is not known.
    pub cache: Option<&'a Cache>,
    /// Whether effects whose every input is as before are taken whole from the cache: their tables and
    /// fits are among the files then, and not in [`Baked::tables`] and [`Baked::fits`].
    pub whole: bool,
}

/// Bakes a plan. Nothing is integrated, fitted, emitted or reported that it does not call for.
///
/// Errors: a hypothesis that is refused, a search that does not end in a minimum, data that is not
/// finite. A promise that is not kept is no error here: it stands in [`Baked::broken`], with every other of
/// the scene, and effects that promise nothing are not made.
pub fn bake(
    scene: &Scene,
    plan: &Plan,
    hypotheses: &[UserHypothesis],
    selection: Selection,
    progress: &dyn Progress,
) -> Result<Baked, BakeError> {
    let Selection { only, kept, cache, whole } = selection;
    let context = context((scene, plan), hypotheses, cache, progress)?;
    let wanted = |called: &&Called| only.is_empty() || only.iter().any(|o| o == called.effect);
    let made = made(&plan.effects.iter().filter(wanted).collect::<Vec<_>>(), whole, &context)?;
    finished(plan, kept, made, &context)
}

/// What the effects of a plan share.
///
/// # Errors
/// A name of a hypothesis that emitted code has already.
pub fn context<'a>(
    (scene, plan): (&'a Scene, &Plan),
    hypotheses: &'a [UserHypothesis],
    cache: Option<&'a Cache>,
    progress: &'a dyn Progress,
) -> Result<Context<'a>, BakeError> {
    names::check(plan, hypotheses)?;
    // Of effects from outside the code is not known that results are named by.
    let is_known = plan.effects.iter().all(|called| catalogue().contains(&called.by));
    let recipe = recipe(scene, plan, hypotheses)?;
    let effects = plan.effects.iter().map(|called| called.effect);
    let explore = plan.effects.iter().any(|called| called.by.profile().is_explored).then_some("explore");
    let pages = std::iter::once("index")
        .chain(explore)
        .chain(effects)
        .map(|page| (page.into(), format!("{page}.html")));
    let pages = pages.collect();
    Ok(Context { scene, hypotheses, recipe, memo: Memo::new(cache.filter(|_| is_known)), pages, progress })
}

/// The work of effects, in their order; where a promise is not kept, of those that promise something alone.
/// The end of each effect's work, where its own parts have run dry, overlaps with the next effect's.
fn made(effects: &[&Called], whole: bool, context: &Context) -> Result<Vec<Made>, BakeError> {
    let each = |effects: &[&Called]| {
        let made = effects.par_iter().with_max_len(1).map(|called| cached::made(called, whole, context));
        made.collect::<Vec<_>>().into_iter().collect::<Result<Vec<Made>, BakeError>>()
    };
    let (promising, others): (Vec<&Called>, Vec<&Called>) =
        effects.iter().partition(|called| called.is_promised());
    let mut made = each(&promising)?;
    if made.iter().all(|made| made.broken.is_empty()) {
        made.extend(each(&others)?);
    }
    made.sort_by_key(|made| effects.iter().position(|called| called.by == made.part.by));
    Ok(made)
}

/// The files of parts that were kept and of others that were made.
fn finished(
    plan: &Plan,
    mut parts: Vec<Part>,
    made: Vec<Made>,
    context: &Context,
) -> Result<Baked, BakeError> {
    let mut baked = Baked {
        files: Files::new(),
        broken: Vec::new(),
        truths: 0,
        tables: Vec::new(),
        fits: Vec::new(),
        dropped: Vec::new(),
        calls: Vec::new(),
    };
    parts.extend(made.into_iter().map(|made| baked.take(made)));
    parts.sort_by_key(|part| plan.catalogue.iter().position(|effect| *effect == part.by));
    baked.files = assemble::assemble(plan, parts, context)?;
    baked.truths = context.memo.total();
    Ok(baked)
}
