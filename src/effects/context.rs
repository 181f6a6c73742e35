//! What all stages of a bake share.

use crate::approximate::Memo;
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

/// A hypothesis of the user's.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UserHypothesis {
    /// File, as named in the scene.
    pub file: String,
    /// WGSL source.
    pub source: String,
}

/// What the effects of a bake share.
pub struct Context<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The user's hypotheses, in order of first mention in the scene.
    pub hypotheses: &'a [UserHypothesis],
    /// What makes it again.
    pub recipe: Recipe,
    /// Counts truths integrated, or interpolated from integrals for the texels of tables of three axes,
    /// and knows those of before.
    pub memo: Memo<'a>,
    /// The pages of the bake: what they show, and their file.
    pub pages: Vec<(String, String)>,
    /// Where stages are announced.
    pub progress: &'a dyn Progress,
}

impl Context<'_> {
    /// Whether the effect makes a page, which is then announced as a stage.
    pub fn reports(&self, effect: &str) -> bool {
        let reports = self.scene.output.reports;
        if reports {
            self.progress.stage(&format!("report of {effect}"));
        }
        reports
    }

    /// What a page says of its making.
    pub fn origin(&self) -> Origin {
        Origin {
            scene: self.scene.name.clone(),
            recipe: self.recipe.hash.clone(),
            tool: env!("CARGO_PKG_VERSION").into(),
            command: self.recipe.command.clone(),
            pages: self.pages.clone(),
        }
    }
}
