//! What all stages of a bake share.

use crate::approximate::Counter;
use crate::emit::header::Recipe;
use crate::report::Origin;
use crate::scene::Scene;

/// Receives what the bake is doing; drawing it is the caller's affair.
pub trait Progress: Sync {
    /// A stage begins.
    fn stage(&self, name: &str);
}

/// No progress shown.
pub struct Silent;

impl Progress for Silent {
    fn stage(&self, _: &str) {}
}

/// Shared state of a bake.
pub struct Context<'a> {
    /// What makes it again.
    pub recipe: Recipe,
    /// Truths integrated, or interpolated from integrals for the texels of tables of three axes.
    pub counter: Counter,
    /// Promises that were not kept.
    pub broken: Vec<String>,
    /// Where stages are announced.
    pub progress: &'a dyn Progress,
}

/// A hypothesis of the user's.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UserHypothesis {
    /// File, as named in the scene.
    pub file: String,
    /// WGSL source.
    pub source: String,
}

/// What a page says of its making.
pub fn origin(scene: &Scene, context: &Context) -> Origin {
    Origin {
        scene: scene.name.clone(),
        recipe: context.recipe.hash.clone(),
        tool: env!("CARGO_PKG_VERSION").into(),
        command: context.recipe.command.clone(),
    }
}
