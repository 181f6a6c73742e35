//! Promises that a bake does not keep: all are named at once, before the work of what promises nothing.

use std::sync::Mutex;

use crate::baked_support::shared;
use lobefit::bake::{Progress, bake};
use lobefit::plan::plan;
use lobefit::scene::Scene;

/// The stages that were announced.
#[derive(Default)]
struct Stages(Mutex<Vec<String>>);

impl Progress for Stages {
    fn stage(&self, name: &str) {
        self.0.lock().expect("not poisoned").push(name.into());
    }
}

/// The stages of a bake of materials, and the promises that it does not keep.
fn baked(materials: &str) -> (Vec<String>, Vec<String>) {
    let json = format!(r#"{{"schema_version":1,"reports":false,"materials":[{materials}]}}"#);
    let scene = Scene::from_json(json.as_bytes(), "test.json").expect("a scene");
    let stages = Stages::default();
    let baked = bake(&scene, &plan(&scene), &[], shared(), &stages).expect("a bake");
    (stages.0.into_inner().expect("not poisoned"), baked.broken)
}

const BRUSHED: &str = r#"{"name":"brushed","kind":"metal","f0":1,"roughness":[0.5,0.6],"anisotropy":[0.4,0.6],
    "wants":{"tables":[{"size":[4,4,4]}]}}"#;

#[test]
fn broken_promises_come_before_the_work_of_other_effects() {
    let velvet = r#"{"name":"velvet","kind":"dielectric","f0":0.04,"roughness":[0.5,0.6],
        "sheen":{"roughness":[0.3,1],"tables":[{"layout":"plain","size":[2,2],"n_dot_v":[0.05,1],"max_error":1e-3}]}}"#;
    let (stages, broken) = baked(&format!("{BRUSHED},{velvet}"));
    assert_eq!(broken.len(), 1, "{broken:?}");
    assert!(broken[0].contains("velvet (materials[1].sheen"), "{broken:?}");
    assert!(!stages.iter().any(|stage| stage.contains("aniso")), "{stages:?}");
}

#[test]
fn tables_that_promise_something_come_before_others_of_their_effect() {
    let table = r#"{"size":[4,4,4],"layout":"optimised","max_error":1e-6}"#;
    let brushed = BRUSHED.replace(r#"{"size":[4,4,4]}"#, &format!(r#"{{"size":[5,5,5]}},{table}"#));
    let (stages, broken) = baked(&brushed);
    assert_eq!(broken.len(), 1, "{broken:?}");
    assert_eq!(stages.len(), 1, "{stages:?}");
}

#[test]
fn tables_and_fits_that_break_promises_are_named_at_once() {
    let steel = r#"{"name":"steel","kind":"metal","f0":1,"roughness":[0.5,0.6],
        "wants":{"tables":[{"size":[2,2],"max_error":1e-4}],"fit":{"max_ops":1,"max_error":0.01}}}"#;
    let (_, broken) = baked(steel);
    let field = |name: &str| broken.iter().filter(|line| line.contains(name)).count();
    assert_eq!(broken.len(), 2, "{broken:?}");
    assert_eq!([field("wants.tables[0].max_error"), field("wants.fit.max_error")], [1, 1], "{broken:?}");
    assert!(!broken[0].contains("no normalisation"), "the advice on the fit stands behind its promise");
}
