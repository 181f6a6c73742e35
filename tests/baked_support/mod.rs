//! Bakes for tests that look at what is made, not at how it is computed.
#![allow(dead_code, reason = "each test binary uses its part")]

use std::path::Path;
use std::sync::OnceLock;

use lobefit::approximate::Fit;
use lobefit::bake::{Baked, Selection, Silent, bake};
use lobefit::data::Source;
use lobefit::effects::BakeError;
use lobefit::plan::plan;
use lobefit::scene::Scene;
use lobefit::store::Cache;
use lobefit_promises::{Fitted, Range};

/// What bakes of a test share: a result is named by the code that computes it and by all its inputs, so
/// that what another test computed, in this run or before, is what this one would compute.
pub fn shared() -> Selection<'static> {
    static CACHE: OnceLock<Cache> = OnceLock::new();
    let folder = || Cache::at(Path::new(env!("CARGO_TARGET_TMPDIR")).join("cache"));
    Selection { cache: Some(CACHE.get_or_init(folder)), ..Selection::default() }
}

/// A bake of a scene of the product's effects, without hypotheses of its own.
pub fn bake_scene(scene: &Scene) -> Result<Baked, BakeError> {
    bake(scene, &plan(scene), &[], shared(), &Silent)
}

/// Holds the formulas that a test has fitted for the largest error to what `docs/promises.json` says.
pub fn assert_promised<'a>(test: &str, fits: impl IntoIterator<Item = &'a Fit>) {
    let of = |fit: &'a Fit| {
        let (a, formula) = (&fit.approximation, fit.hypothesis.name());
        let name = formula.rsplit('/').next().unwrap_or(formula);
        let ours = a.source == Source::Fitted && !a.name.contains("_rms");
        let certificate = &a.certificate;
        // Roughness says what alpha would.
        let domain = certificate.domain.iter().filter(|(input, _)| input.as_str() != "alpha");
        ours.then(|| Fitted {
            name,
            ops: a.cost.ops,
            error: certificate.max_abs,
            relative: certificate.max_rel,
            domain: domain.map(|(input, [low, high])| Range(input.clone(), *low, *high)).collect(),
        })
    };
    let found: Vec<Fitted> = fits.into_iter().filter_map(of).collect();
    let broken = lobefit_promises::broken(test, &found);
    assert!(broken.is_empty(), "docs/promises.json:\n{}", broken.join(",\n"));
}
