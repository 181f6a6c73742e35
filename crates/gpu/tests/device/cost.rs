//! `lobefit cost --gpu`: times of emitted functions on a Vulkan device.

use crate::emit_support::{missing, say};
use crate::gpu_support::device::INSTALL;
use crate::lookup_support as lookups;

use crate::baked_support::bake_scene;
use lobefit::bake::{Baked, Silent};
use lobefit::report::{GpuKind, GpuRecord, Origin};
use lobefit::scene::Scene;
use lobefit::timing::record::{missing as untimed, page, read, stale};
use lobefit_gpu::{GpuError, Work, measure};
use serde_json::Value;

/// Fits of roughness, alpha, cosine and f0, and tables of two axes, of f16 and of f32, and of
/// three, one with the azimuth.
const SCENE: &str = r#"{"schema_version": 1, "name": "test", "arguments": "both", "materials": [
    {"name": "m", "kind": "metal", "f0": 0.9, "roughness": [0.4, 0.6],
     "wants": {"fit": {"max_ops": 14, "blend": true}, "tables":[{"size": [8, 8]}]}},
    {"name": "f", "kind": "metal", "f0": 0.9, "roughness": [0.4, 0.6], "wants": {"tables":[{"size": [16, 8], "format": "f32"}]}},
    {"name": "a", "kind": "metal", "f0": 0.9, "roughness": [0.5, 0.6], "anisotropy": [0.4, 0.6],
     "wants": {"tables": [{"size": [4, 4, 4]}, {"layout": "azimuth", "size": [8, 4, 4]}]}},
    {"name": "g", "kind": "glass", "ior": [1.4, 1.6], "roughness": [0.5, 0.6], "wants": {"tables": [{"size": [4, 4, 4]}]}}]}"#;

/// The record of a bake; `None` without a device where the tests do not require one.
fn measured(baked: &Baked) -> Option<GpuRecord> {
    let origin = Origin {
        scene: "test".into(),
        recipe: "0".repeat(64),
        tool: "0.1.0".into(),
        command: "lobefit cost --gpu".into(),
        pages: Vec::new(),
    };
    match measure(baked, None, Work::REDUCED, origin, &Silent) {
        Ok(record) => Some(record.expect("the bake emits functions")),
        Err(GpuError::NoAdapter { .. }) => {
            missing("no Vulkan adapter", INSTALL);
            None
        }
        Err(e) => panic!("{e}"),
    }
}

/// Every function that a manifest says to be timed, with how often.
fn wanted(baked: &Baked) -> Vec<(String, usize)> {
    let manifest: Value = serde_json::from_slice(&baked.files["manifest.json"]).expect("JSON");
    let names = |list: &str, key: &str| -> Vec<String> {
        let list = manifest[list].as_array().into_iter().flatten();
        list.map(|entry| entry[key].as_str().expect("a name").to_string()).collect()
    };
    let once = names("fits", "function").into_iter().chain(names("mips", "function"));
    let once = once.chain(names("tables", "function"));
    once.map(|name| (name, 1)).chain(names("lookups", "function").into_iter().map(|name| (name, 2))).collect()
}

/// Fits that take an input.
fn inputs(baked: &Baked, input: &str) -> Vec<String> {
    let manifest: Value = serde_json::from_slice(&baked.files["manifest.json"]).expect("JSON");
    let fits = manifest["fits"].as_array().into_iter().flatten();
    let takes =
        |fit: &&Value| fit["inputs"].as_array().is_some_and(|all| all.iter().any(|name| name == input));
    fits.filter(takes).map(|fit| fit["function"].as_str().expect("a name").to_owned()).collect()
}

fn assert_whole(baked: &Baked, record: &GpuRecord) {
    for (function, times) in wanted(baked) {
        let rows = record.rows.iter().filter(|row| row.function.as_ref() == Some(&function)).count();
        let out = record.left_out.iter().filter(|out| out.function == function).count();
        assert_eq!(rows + out, times, "{function}");
    }
    assert!(!record.rows.is_empty() && !record.device.adapter.is_empty() && record.reduced);
    for row in &record.rows {
        let [low, median, high] = [row.ratio.low, row.ratio.median, row.ratio.high];
        assert!(
            0.0 < low && low <= median && median <= high && high.is_finite(),
            "{}: {:?}",
            row.name,
            row.ratio
        );
        assert!(row.loop_nanoseconds > 0.0 && row.evaluations >= 32, "{}", row.name);
        let rate = row.evaluations_per_second;
        assert_eq!(rate.is_some(), row.resolved(), "{}", row.name);
        assert!(rate.is_none_or(|rate| rate > 0.0 && rate.is_finite()), "{}", row.name);
    }
    assert_eq!(stale(record, baked), Vec::<String>::new(), "measured from this bake");
    assert_eq!(untimed(record, baked), Vec::<String>::new(), "all of it");
    let (html, figures) = page(record).expect("a page");
    assert!(html.contains(&blake3::hash(&figures).to_hex().to_string()), "the page names its record");
    let again = read(&figures).expect("a record");
    for (read, row) in again.rows.iter().zip(&record.rows) {
        let off = read.nanoseconds.median / row.nanoseconds.median - 1.0;
        assert!(read.name == row.name && off.abs() < 1e-8, "nine digits are kept: {} {off}", row.name);
    }
    assert_eq!(page(&again).expect("a page"), (html, figures), "written again it is the same");
}

#[test]
fn every_kind_of_lookup_is_timed_with_its_fetches_and_without() {
    let Some(record) = measured(&lookups::BAKED) else { return };
    assert_whole(&lookups::BAKED, &record);
    let of = |kind: GpuKind| record.rows.iter().filter(move |row| row.kind == kind);
    assert_eq!(of(GpuKind::Lookup).count(), lookups::EMITTED.len());
    assert_eq!(of(GpuKind::LookupFetches).count(), lookups::EMITTED.len());
    // A lookup of three fetches has five times the operations of one: medians tell them apart on a
    // busy machine too.
    let time = |name: &str, kind: GpuKind| {
        let row = of(kind).find(|row| row.name.contains(name)).unwrap_or_else(|| panic!("no {name}"));
        row.nanoseconds.median
    };
    let (three, one) = (time("box_smooth_3", GpuKind::Lookup), time("box_smooth_1", GpuKind::Lookup));
    let fetched = time("box_smooth_3", GpuKind::LookupFetches);
    say(&format!(
        "{}: {one:.2} ns, three taps {three:.2} ns, fetched {fetched:.2} ns",
        record.device.adapter
    ));
    assert!(three > one, "three taps {three} ns, one {one} ns");
    assert_eq!(of(GpuKind::CubemapFetch).count(), 1, "what to compare with");
    let changed = {
        let mut record = record.clone();
        record.rows.last_mut().expect("a row").code = Some("0".repeat(64));
        record
    };
    assert_eq!(stale(&changed, &lookups::BAKED), [record.rows.last().expect("a row").name.clone()]);
}

#[test]
fn tables_and_fits_are_timed() {
    let scene = Scene::from_json(SCENE.as_bytes(), "test.json").expect("a scene");
    let baked = bake_scene(&scene).expect("a bake");
    let Some(record) = measured(&baked) else { return };
    assert_whole(&baked, &record);
    let tables = record.rows.iter().filter(|row| row.kind == GpuKind::Table).count();
    assert_eq!(tables + record.left_out.len(), 6, "{:?}", record.left_out);
    for input in ["alpha", "mu", "f0", "roughness"] {
        let of = |name: &str| record.rows.iter().any(|row| row.function.as_deref() == Some(name));
        assert!(inputs(&baked, input).iter().any(|name| of(name)), "no fit of {input} is timed");
    }
    assert!(record.rows.iter().any(|row| row.kind == GpuKind::Fit && row.error.is_some()));
    assert_eq!(record.rows[0].kind, GpuKind::Fetch, "what to compare with comes first");
}
