//! Culling that is refused, and scenes that have or have no lookups of sub-voxels.

use super::{case, refused, top};
use lobefit::plan::plan;
use lobefit::scene::Scene;

#[test]
fn what_is_no_culling_is_refused() {
    let culling = |fields: &str| top(&format!("\"culling\":{{{fields}}}"));
    refused(vec![
        case(culling("\"speed\":1"), "culling.speed: unknown field `speed`"),
        case(culling("\"world\":\"city\""), "culling.world: `city` is neither town nor forest"),
        case(culling("\"world\":\"../a.glb\""), "culling.world: `../a.glb` holds an empty part"),
        case(culling("\"world\":{}"), "culling.world: "),
        case(culling("\"path\":\"fly\""), "culling.path: unknown variant `fly`"),
        case(culling("\"latency\":0"), "culling.latency: 0 is outside [1, 8]"),
        case(culling("\"latency\":2.5"), "culling.latency: "),
        case(culling("\"buffer\":[8,180]"), "culling.buffer[0]: 8 is outside [16, 1024]"),
        case(culling("\"buffer\":320"), "culling.buffer: "),
        case(culling("\"grid\":[256,100,128]"), "culling.grid[1]: 100 is no power of two"),
        case(culling("\"grid\":[512,512,256]"), "culling.grid: 67108864 voxels are more than 33554432"),
        case(culling("\"seed\":-1"), "culling.seed: -1 is outside [0, 4294967295]"),
        case(culling("\"passes\":[]"), "culling.passes: no pass writes depth"),
        case(culling("\"passes\":[\"median\"]"), "culling.passes: no pass writes depth"),
        case(culling("\"passes\":[\"voxels\",\"voxels\"]"), "culling.passes[1]: `voxels` is there twice"),
        case(culling("\"passes\":[\"reproject\",\"reproject-half\"]"), "stand for one another"),
        case(top("\"culling\":[]"), "culling: "),
    ]);
}

/// A field that is judged with others is named where it stands.
#[test]
fn the_place_of_a_refused_field_is_its_own() {
    let text = "{\"schema_version\": 1, \"materials\": [], \"culling\": {\n\"passes\": [\"median\"],\n\"grid\": [2,\n 100, 2],\n\"seed\": 1\n}\n}";
    let said = |text: &str| Scene::from_json(text.as_bytes(), "s").expect_err("refused").to_string();
    assert_eq!(said(text), "s:4:4: culling.grid[1]: 100 is no power of two");
    let text = text.replace("100", "64");
    assert!(said(&text).starts_with("s:2:11: culling.passes: no pass writes depth"), "{}", said(&text));
}

/// Without the block or without voxels nothing is emitted, and the plan says why.
#[test]
fn sub_voxels_are_called_for_by_voxels() {
    let planned = |fields: &str| plan(&Scene::from_json(top(fields).as_bytes(), "s").expect("a scene"));
    let called = planned("\"culling\":{}");
    assert_eq!(called.effects.iter().map(|e| e.effect).collect::<Vec<_>>(), ["occlusion"]);
    for (fields, reason) in [
        ("\"name\":\"s\"", "the scene has no `culling`"),
        ("\"culling\":{\"passes\":[\"reproject\"]}", "`voxels` is none of the passes of culling"),
    ] {
        let plan = planned(fields);
        let left = plan.left_out.iter().find(|left| left.effect == "occlusion");
        assert_eq!(left.map(|left| left.reason.as_str()), Some(reason));
    }
}
