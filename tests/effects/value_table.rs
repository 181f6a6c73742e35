//! A table of a quantity that an effect of another crate declares beside its fits: texels, certificate, manifest, code and page.

use std::collections::BTreeMap;

use lobefit::approximate::Entry;
use lobefit::bake::{Baked, Selection, Silent, bake};
use lobefit::data::{Layout, TexelFormat};
use lobefit::effects::context::Context;
use lobefit::effects::demand::{Demand, Goals, Job};
use lobefit::effects::sheen::HYPOTHESES;
use lobefit::effects::table::ValueTable;
use lobefit::effects::value::ValueFits;
use lobefit::effects::{BakeError, Called, Effect, JobSummary, Made};
use lobefit::plan::plan_with;
use lobefit::scene::Scene;
use lobefit_truth::quantity::SheenCharlie;
use serde_json::{Value, json};

struct Velvet;

const FITS: ValueFits = ValueFits {
    quantity: &SheenCharlie,
    column: "E",
    own: HYPOTHESES.split_at(1).0,
    published: &[],
    of: "velvet",
    field: "sheen",
    because: "with velvet",
    caption: "E of velvet.",
    curves: &[0.5],
    seconds: [1.0, 0.1],
    table: Some(ValueTable {
        quantity: &SheenCharlie,
        column: "E",
        name: "velvet",
        layout: Layout::Homogeneous,
        size: [16, 12],
        format: TexelFormat::F16,
        seconds: 0.5,
    }),
};

impl Effect for Velvet {
    fn name(&self) -> &'static str {
        "velvet"
    }

    fn demands(&self, scene: &Scene) -> Vec<Demand> {
        let goals = Goals { max_error: Some(1.0), norms: vec![lobefit::data::Norm::Max], ..Goals::default() };
        vec![FITS.demand(scene, 0, [0.3, 1.0], goals)]
    }

    fn left_out(&self, _: &Scene) -> String {
        "nothing is of velvet".into()
    }

    fn expects(&self, _: &Scene, jobs: &[Job]) -> Vec<JobSummary> {
        FITS.expects(jobs)
    }

    fn formulas(&self) -> Vec<&'static Entry> {
        FITS.own.iter().collect()
    }

    fn prefixes(&self) -> &'static [&'static str] {
        &["velvet_"]
    }

    fn lobe(&self, _: &Scene) -> String {
        "velvet".into()
    }

    fn bake(&self, called: &Called, context: &Context) -> Result<Made, BakeError> {
        FITS.bake(called, context)
    }
}

fn velvet() -> Baked {
    let text = r#"{"schema_version":1,"name":"cloth","materials":[{"name":"m","kind":"metal","f0":1,"roughness":0.5}]}"#;
    let scene = Scene::from_json(text.as_bytes(), "test").expect("a scene");
    bake(&scene, &plan_with(&scene, &[&Velvet]), &[], Selection::default(), &Silent).expect("a bake")
}

#[test]
fn a_table_of_a_quantity_is_baked_measured_and_emitted() {
    let baked = velvet();
    assert!(baked.broken.is_empty() && baked.tables.len() == 1, "{:?}", baked.broken);
    let manifest: Value = serde_json::from_slice(&baked.files["manifest.json"]).expect("a manifest");
    let table = &manifest["tables"][0];
    let words = ["effect", "name", "quantity", "use"].map(|key| table[key].as_str().expect("a word"));
    assert_eq!(words, ["velvet", "velvet-16x12", "sheen-charlie", "value"]);
    // The sheen has no Smith form.
    assert_eq!(
        (&table["smith"], &table["channels"], &table["bytes"]),
        (&Value::Null, &json!(["loss"]), &json!(384))
    );
    let error = table["error"]["lookup"]["max"].as_f64().expect("an error");
    assert!(error > 1e-5 && error < 0.02, "{error}");
    assert!(baked.files.contains_key("tables/velvet-16x12.exr"));
    let text = |path: &str| String::from_utf8_lossy(&baked.files[path]).into_owned();
    for path in ["fits/lobefit.wgsl", "fits/lobefit.h", "fits/lobefit.rs"] {
        assert!(text(path).contains("velvet_16x12_lookup("), "{path}");
    }
    let page = text("reports/velvet.html");
    assert!(page.contains("velvet-16x12") && page.contains("charlie_e_8"), "{page}");
}

/// Texels that lie are found by the promise of the table, at the points where it was measured.
#[test]
fn other_texels_are_measured_again() {
    let baked = velvet();
    let made = &baked.tables[0];
    let mut channels = made.table().expect("texels").channels.clone();
    assert!(made.measured_again(&channels).expect("a lookup") <= made.errors.lookup.max);
    channels[0].texels[100] += 0.1;
    assert!(made.measured_again(&channels).expect("a lookup") > made.errors.lookup.max);
    let domain: &BTreeMap<String, [f64; 2]> = &made.approximation.certificate.domain;
    assert_eq!(domain["roughness"], [0.3, 1.0]);
}
