//! The largest error that a certificate states is the largest that can be found.
#![allow(clippy::disallowed_methods)]

use crate::baked_support::bake_scene;
use lobefit::approximate::Memo;
use lobefit::effects::anisotropy::Anisotropy;
use lobefit::effects::glass;
use lobefit::effects::table::{Family, Judged, Lookup, Point, SliceAxis, Truth, error_map};
use lobefit::scene::Scene;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// Few texels, so that the peaks between them are high.
const SCENE: &str = r#"{"schema_version": 1, "reports": false, "materials": [
    {"name": "glass", "kind": "glass", "ior": [1, 1.7], "roughness": [0.2, 1],
     "wants": {"tables": [{"size": [32, 32, 4]}]}},
    {"name": "brushed", "kind": "metal", "f0": 1, "roughness": [0.2, 1], "anisotropy": [0, 1],
     "wants": {"tables": [{"size": [16, 8, 8], "layout": "azimuth"}]}}
]}"#;

/// Places drawn for each table.
const PLACES: usize = 1 << 15;

/// Every second place is in the layer mu ~ alpha, and every second one of glass has an ior that is
/// 1 to some decades: errors are large there.
fn drawn(rng: &mut Pcg64, axis: SliceAxis) -> Point {
    let mut uniform = |low: f64, high: f64| low + (high - low) * rng.random::<f64>();
    let roughness = uniform(0.2, 1.0) as f32;
    let alpha = roughness * roughness;
    let mu = if uniform(0.0, 1.0) < 0.5 {
        uniform(0.001, 1.0)
    } else {
        (f64::from(alpha) * uniform(-1.5, 1.5).exp()).clamp(0.001, 1.0)
    };
    let point = Point { roughness, alpha, mu: mu as f32, ior: 1.0, cos2_phi: 1.0, anisotropy: 0.0 };
    match axis {
        SliceAxis::Ior => {
            let excess =
                if uniform(0.0, 1.0) < 0.5 { uniform(0.0, 0.7) } else { 0.7 * uniform(-12.0, 0.0).exp() };
            Point { ior: (1.0 + excess) as f32, ..point }
        }
        SliceAxis::Anisotropy => {
            let cos2_phi = uniform(0.0, std::f64::consts::FRAC_PI_2).cos().powi(2) as f32;
            Point { anisotropy: uniform(0.0, 1.0) as f32, cos2_phi, ..point }
        }
    }
}

#[test]
fn no_place_has_a_larger_error_than_the_certificate() {
    let scene = Scene::from_json(SCENE.as_bytes(), "scene.json").expect("a scene");
    let baked = bake_scene(&scene).expect("a bake");
    assert_eq!(baked.tables.len(), 3);
    let mut rng = Pcg64::seed_from_u64(0x5eed);
    for (i, baked) in baked.tables.iter().enumerate() {
        let (family, axis): (&dyn Family, _) = if baked.side.is_some() {
            (&glass::GGX, SliceAxis::Ior)
        } else {
            (&Anisotropy, SliceAxis::Anisotropy)
        };
        let mut points = baked.judge.points.clone();
        points.all = (0..PLACES).map(|_| drawn(&mut rng, axis)).collect();
        points.uniform = vec![false; PLACES];
        let truths = family.truths(scene.smith, &points, true, &Memo::default()).expect("truths").sides;
        let side = usize::from(baked.side.is_some_and(|side| side.name() == "inside"));
        let lookup = Lookup::new(baked.table().expect("texels"), baked.decode).expect("a lookup");
        let truth = Truth { e: &truths[side].e, b: None };
        let errors = error_map(&lookup, Judged::E, &points, truth).expect("errors");
        let worst = (0..PLACES).max_by(|a, b| errors[*a].abs().total_cmp(&errors[*b].abs())).expect("some");
        let (found, stated) = (errors[worst].abs(), baked.approximation.certificate.max_abs);
        println!("{i} {}: found {found:.6}, stated {stated}", baked.approximation.name);
        assert!(found <= stated, "{}: {found} at {:?}", baked.approximation.name, points.all[worst]);
        assert!(found > 0.7 * stated, "{found} of {stated}: the places are too few to tell");
    }
}
