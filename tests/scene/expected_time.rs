//! The time that a plan expects.

use lobefit::plan::plan;
use lobefit::scene::Scene;

/// CPU seconds of `bake --only EFFECT --threads 1` of the built-in scene.
#[test]
fn the_built_in_scene_is_estimated_within_a_factor_of_one_and_a_half() {
    let plan = plan(&Scene::built_in().expect("the built-in scene"));
    let measured = [
        ("reflection", 5.9),
        ("anisotropy", 4.3),
        ("glass", 7.6),
        ("diffuse-coupling", 2.2),
        ("parallax", 0.6),
    ];
    let within = |estimate: f64, measured: f64| (measured / 1.5..measured * 1.5).contains(&estimate);
    assert_eq!(plan.effects.len(), measured.len());
    for (effect, (name, seconds)) in plan.effects.iter().zip(measured) {
        assert_eq!(effect.effect, name);
        assert!(within(effect.seconds, seconds), "{name}: {} for {seconds}", effect.seconds);
    }
    let all: f64 = plan.effects.iter().map(|effect| effect.seconds).sum();
    assert!(within(all, 20.6), "{all}");
}

#[test]
fn a_table_with_the_azimuth_has_four_channels() {
    let text = r#"{"schema_version":1,"materials":[{"name":"m","kind":"metal","f0":1,"anisotropy":0.5,"roughness":1,
        "wants":{"tables":[{"layout":"azimuth","size":[8,6,4]}]}}]}"#;
    let plan = plan(&Scene::from_json(text.as_bytes(), "test").expect("a scene"));
    assert_eq!(plan.effects[0].bytes, 8 * 6 * 4 * 4 * 2);
}

#[test]
fn more_work_takes_longer() {
    let job = |wants: &str| {
        let text = format!(
            r#"{{"schema_version":1,"materials":[{{"name":"m","kind":"metal","f0":1,"roughness":[0.02,1],"wants":{wants}}}]}}"#
        );
        plan(&Scene::from_json(text.as_bytes(), "test").expect("a scene")).effects[0].seconds
    };
    let table = |size: &str, more: &str| job(&format!(r#"{{"tables":[{{"size":{size}{more}}}]}}"#));
    assert!(table("[32,32]", "") < table("[64,64]", ""));
    assert!(table("[32,32]", "") < table("[32,32]", r#","serves":"split-sum""#));
    assert!(table("[256,256]", r#","layout":"plain""#) < table("[512,512]", r#","layout":"plain""#));
    let fit = |more: &str| job(&format!(r#"{{"fit":{{{more}}}}}"#));
    assert!(fit(r#""norms":["max"]"#) < fit(r#""norms":["max","rms"]"#));
    assert!(fit("") < fit(r#""average":true"#));
    assert!(fit("") < fit(r#""hypotheses":["a.wgsl"]"#));
}

#[test]
fn more_work_takes_longer_with_three_axes() {
    let glass = |tables: &str| {
        let text = format!(
            r#"{{"schema_version":1,"materials":[{{"name":"m","kind":"glass","ior":[1.3,1.9],"roughness":1,"wants":{{"tables":[{tables}]}}}}]}}"#
        );
        plan(&Scene::from_json(text.as_bytes(), "test").expect("a scene")).effects[0].seconds
    };
    assert!(glass("{}") < glass(r#"{},{"layout":"path-tracer"}"#));
    assert!(glass(r#"{"layout":"path-tracer"}"#) < glass("{}"));
    assert!(glass(r#"{"size":[64,64,32]}"#) < glass(r#"{"size":[64,64,33]}"#));
}
