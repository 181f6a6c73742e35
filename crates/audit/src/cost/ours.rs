//! Our own formulas for a use, with their certificates and their code.

use std::collections::BTreeMap;

use super::served::Served;
use lobefit::bake::{Progress, Selection, bake};
use lobefit::cli::CliError;
use lobefit::data::Smith;
use lobefit::emit::include::Include;
use lobefit::emit::manifest::Manifest;
use lobefit::plan::plan;
use lobefit::scene::Scene;
use lobefit::store::{Cache, MANIFEST};

/// A formula that is fitted to a quantity.
pub(super) struct Formula {
    /// The function.
    pub name: String,
    /// Its largest error, as its certificate states it.
    pub error: f64,
    /// Where that holds.
    pub domain: BTreeMap<String, [f64; 2]>,
    /// The function in WGSL, with all that it needs.
    pub code: String,
}

/// All formulas for a use, fitted to a shadowing form; the cache has them from the second time on.
///
/// # Errors
/// What the bake says.
pub(super) fn formulas(
    served: &Served,
    smith: Option<Smith>,
    progress: &dyn Progress,
) -> Result<Vec<Formula>, CliError> {
    let smith = smith.unwrap_or_default().name();
    let text = format!(
        r#"{{"schema_version": 1, "pick": "all", "languages": ["wgsl"], "reports": false, "smith": "{smith}", "materials":
        [{{"name": "all", "kind": "dielectric", "f0": 0.04, "roughness": [0.02, 1], {}}}]}}"#,
        served.material
    );
    let scene = Scene::from_json(text.as_bytes(), "the scene of --isa")?;
    let cache = Cache::of_user();
    let selection = Selection { cache: cache.as_ref(), ..Selection::default() };
    let files = bake(&scene, &plan(&scene), &[], selection, progress)?.files;
    let manifest = files.get(MANIFEST).map(|bytes| Manifest::read(bytes)).transpose()?;
    let (Some(include), Some(manifest)) = (Include::of(&files), manifest) else { return Ok(Vec::new()) };
    let ours = manifest.entries.fits.into_iter().filter(|fit| {
        (fit.quantity.as_str(), fit.used_as.as_str()) == (served.quantity, served.used_as.word())
            && fit.source == "fitted"
    });
    Ok(ours
        .filter_map(|fit| {
            let code = include.code(&fit.function)?;
            let certificate = fit.certificate;
            Some(Formula { name: fit.function, error: certificate.max_abs, domain: certificate.domain, code })
        })
        .collect())
}
