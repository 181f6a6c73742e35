//! Lookups of what an engine has hit itself: what they fetch, and that nothing is undefined.

use crate::baked_support::bake_scene;
use crate::emit_support::{functions, module};
use lobefit::data::{MipChain, MipMap};
use lobefit::scene::Scene;
use lobefit_math::sobol::Sobol;
use lobefit_math::vector::length;
use lobefit_shade::Source;
use serde_json::Value;

const SCENE: &str = r#"{"schema_version": 1, "name": "test", "languages": ["wgsl"], "reports": false, "materials": [], "probes": [
    {"name": "a", "lookups": [{"hit": true}]},
    {"name": "b", "mips": {"map": "linear", "count": 7}, "lookups": [{"hit": true}]},
    {"name": "c", "mips": {"map": "log", "count": 7}, "lookups": [{"hit": true}]}]}"#;

/// k of `parallax_1` for the ranges of a scene that gives none.
const FLOW: f64 = 1.048_127;

/// Offsets and distances from far below to far above the certified ratios, and none of both.
fn points() -> Vec<[f32; 5]> {
    let set = Sobol::new([3, 5, 7]);
    let alphas = [0.0, 1e-3, 0.04, 0.3, 0.7, 1.0];
    let point = |i: u32| {
        let [x, y, z] = [0, 1, 2].map(|k| 6.0 * set.coordinate(i, k) as f32 - 3.0);
        let distance = [0.0, 1e-6, 0.01, 0.3, 1.0, 2.7, 40.0, 1e4][i as usize % 8];
        [x, y, z, distance, alphas[i as usize / 8 % 6]]
    };
    let none = alphas.map(|alpha| [0.0, 0.0, 0.0, 0.0, alpha]);
    (0..2000).map(point).chain(none).collect()
}

#[test]
fn lookups_of_hits_fetch_the_width_of_the_ratio_of_distances() {
    let scene = Scene::from_json(SCENE.as_bytes(), "test.json").expect("a scene");
    let baked = bake_scene(&scene).expect("a bake");
    let manifest: Value = serde_json::from_slice(&baked.files["manifest.json"]).expect("JSON");
    let text = String::from_utf8(baked.files["fits/lobefit.wgsl"].clone()).expect("UTF-8");
    let known = functions(&text);
    let chain = |map| Some(MipChain::Mapped { map, count: 7 });
    let lookups = manifest["lookups"].as_array().expect("lookups");
    assert_eq!(lookups.len(), 3);
    for (entry, chain) in lookups.iter().zip([None, chain(MipMap::Linear), chain(MipMap::Log)]) {
        let name = entry["function"].as_str().expect("a name");
        assert!(name.starts_with("parallax_lookup_hit"), "{name}");
        assert!(entry["cost"]["ops"].as_u64().is_some_and(|ops| ops < 30 + 8), "{entry}");
        let source = Source::parse("lobefit.wgsl", &module(name, &known)).expect("a source");
        let points = points();
        let columns: Vec<Vec<f32>> = (0..5).map(|k| points.iter().map(|point| point[k]).collect()).collect();
        let values =
            |k: usize| source.tape(name, k).expect("a tape").evaluate(&columns, &[]).expect("values");
        assert_eq!(values(1), columns[1]);
        for (point, found) in points.iter().zip(values(3)) {
            let [x, y, z, distance, alpha] = point.map(f64::from);
            let away = length([x, y, z]);
            let rho = if away > 0.0 { (distance / away).clamp(0.0625, 8.0) } else { f64::INFINITY };
            let seen = (rho * alpha).max(0.0);
            let width = if alpha == 0.0 { 0.0 } else { 1.0 / ((1.0 + FLOW * alpha) / seen - FLOW).max(1.0) };
            let wanted = chain.as_ref().map_or(width, |chain| chain.level(width.sqrt()));
            // no direction has a length of 0: any width is right
            assert!(found.is_finite() && found >= 0.0, "{name} at {point:?}: {found}");
            let off = (f64::from(found) - wanted).abs();
            assert!(away == 0.0 || off < 2e-5, "{name} at {point:?}: {found} where {wanted} is right");
        }
    }
}
