//! What makes a bake again.

use crate::approximate::of_fewer_inputs;
use crate::effects::{Effect, UserHypothesis};
use crate::emit::header::Recipe;
use crate::plan::Plan;
use crate::scene::Scene;

/// Tool and version.
pub const TOOL: &str = concat!("lobefit ", env!("CARGO_PKG_VERSION"));

/// Every shader source that an effect's results depend on.
pub fn sources(effect: &dyn Effect) -> impl Iterator<Item = &'static str> {
    effect.sources().into_iter().chain(of_fewer_inputs().map(|entry| entry.source))
}

/// The recipe of a scene: the hash covers the tool's version, the command, the scene and every hypothesis,
/// compiled in or the user's.
pub fn recipe(
    scene: &Scene,
    plan: &Plan,
    hypotheses: &[UserHypothesis],
) -> Result<Recipe, serde_json::Error> {
    let scene_hash = scene.hash()?;
    let mut built_in = Scene::built_in().ok();
    built_in.iter_mut().for_each(|built_in| built_in.output.reports = scene.output.reports);
    let named = match &scene.made_of {
        _ if built_in.as_ref() == Some(scene) => String::new(),
        made_of => format!(" {}", made_of.as_deref().unwrap_or("SCENE.json")),
    };
    let pages = if scene.output.reports { "" } else { " --no-reports" };
    let command = format!("lobefit bake{named}{pages}");
    let mut hasher = blake3::Hasher::new();
    let mut add = |text: &str| {
        hasher.update(&(text.len() as u64).to_le_bytes());
        hasher.update(text.as_bytes());
    };
    add(TOOL);
    add(&command);
    add(&scene_hash);
    plan.catalogue.iter().flat_map(|effect| sources(*effect)).for_each(&mut add);
    for hypothesis in hypotheses {
        add(&hypothesis.file);
        add(&hypothesis.source);
    }
    Ok(Recipe { command, tool: TOOL.into(), scene: scene_hash, hash: hasher.finalize().to_hex().to_string() })
}
