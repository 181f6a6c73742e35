//! Which fits of a bake get pictures, and that the page's words fit what was baked.

use crate::baked_support::{bake_scene, shared};
use lobefit::bake::{Silent, UserHypothesis, bake};
use lobefit::plan::plan;
use lobefit::scene::Scene;
use serde_json::Value;

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Findings and page of a scene of one metal.
fn report(wants: &str, hypotheses: &[UserHypothesis]) -> Result<(Value, String), Box<dyn std::error::Error>> {
    let json = format!(
        r#"{{"schema_version": 1, "name": "test", "pick": "all", "materials": [
            {{"name": "m", "kind": "dielectric", "f0": 0.9, "roughness": [0.2, 0.9], "wants": {wants}}}]}}"#
    );
    let scene = Scene::from_json(json.as_bytes(), "test.json")?;
    let baked = bake(&scene, &plan(&scene), hypotheses, shared(), &Silent)?;
    let page = String::from_utf8(baked.files["reports/reflection.html"].clone())?;
    Ok((serde_json::from_slice(&baked.files["reports/reflection.json"])?, page))
}

fn list<'a>(findings: &'a Value, of: &str, field: &str) -> Vec<&'a str> {
    let entries = findings[of].as_array().into_iter().flatten();
    entries.filter_map(|entry| entry[field].as_str()).collect()
}

#[test]
fn fits_alone_show_refits_beside_the_published_forms() -> Outcome {
    let own = UserHypothesis {
        file: "mine.wgsl".into(),
        source: "override a: f32 = 0.5;\nfn mine(alpha: f32) -> f32 { return 1.0 + a * alpha; }".into(),
    };
    let (findings, page) =
        report(r#"{"fit": {"max_ops": 3, "norms": ["max", "rms"], "hypotheses": ["mine.wgsl"]}}"#, &[own])?;
    let shown = list(&findings, "fits", "name");
    for name in ["ggx_norm_n1", "ggx_norm_n2", "ggx_norm_pesce_n1", "ggx_norm_pesce_n2", "mine"] {
        assert!(shown.contains(&name), "{name} is not among {shown:?}");
    }
    assert!(!shown.contains(&"ggx_norm_n1_rms"), "{shown:?}");
    let metric = &findings["effects"][0]["metric"];
    assert_eq!(metric, "furnace error |E N − 1| of the best normalisation");
    assert!(page.contains("Without pictures") && page.contains("of the user"));
    assert!(!page.contains("tables (squares)"));
    Ok(())
}

#[test]
fn a_table_alone_is_baked_not_fitted() -> Outcome {
    let (findings, page) = report(r#"{"tables":[{"size": [16, 16], "serves": "albedo"}]}"#, &[])?;
    assert_eq!(list(&findings, "approximations", "source"), ["baked"]);
    assert_eq!(findings["effects"][0]["metric"], "lookup error of the worst table");
    assert!(!page.contains("ormalisation") && !page.contains("our fits"), "no word of fits");
    Ok(())
}

/// A card has the cost of the call: of a metal's that of three channels, as budgets count it. What a page
/// says of errors holds of the functions that it lists.
#[test]
fn a_card_costs_what_its_call_costs() -> Outcome {
    let index = |pick: &str, fit: &str| -> Result<(Value, String), Box<dyn std::error::Error>> {
        let json = format!(
            r#"{{"schema_version": 1, "languages": ["wgsl"], "pick": "{pick}", "materials": [
                {{"name": "m", "kind": "metal", "f0": 0.9, "roughness": [0.2, 0.9], "wants": {{"fit": {fit}}}}}]}}"#
        );
        let scene = Scene::from_json(json.as_bytes(), "test.json")?;
        let baked = bake_scene(&scene)?;
        let page = String::from_utf8(baked.files["reports/index.html"].clone())?;
        Ok((serde_json::from_slice(&baked.files["manifest.json"])?, page))
    };
    let (manifest, page) = index("best", r#"{"max_error": 0.05, "max_ops": 16}"#)?;
    let [ops, three] = [&manifest["fits"], &manifest["calls"]].map(|list| list[0]["cost"]["ops"].clone());
    assert!(
        page.contains(&format!("<dt>Cost</dt><dd>{three} operations for three channels</dd>")),
        "{three}"
    );
    assert!(page.contains(&format!("{ops} operations for one channel</dd>")), "{ops}");
    assert!(page.contains("every error that the scene states is kept."));
    assert!(!page.contains("<dt>Scene</dt>"), "the scene has no name");
    let (_, page) = index("frontier", r#"{"max_error": 0.05, "max_ops": 14}"#)?;
    assert!(page.contains("what is recommended keeps every error that the scene states"));
    assert!(page.contains("<td>yes</td>"), "the list of calls marks it");
    let (_, page) = index("frontier", r#"{"max_ops": 12}"#)?;
    let said = "the scene states no limit on an error, and the largest of what is recommended is 0.";
    assert!(page.contains(said));
    Ok(())
}

/// The limit of a probe is on its total variation, and so is the headline; a card shows what is
/// cheaper than the lookup that is emitted, and how a scene asks for it.
#[test]
fn a_headline_states_the_error_that_the_scene_limits() -> Outcome {
    let json = r#"{"schema_version": 1, "name": "p", "languages": ["wgsl"], "materials": [], "probes": [
        {"name": "room", "roughness": [0.2, 0.9], "rho": [0.25, 2], "max_error": 0.2, "lookups": [{}]}]}"#;
    let scene = Scene::from_json(json.as_bytes(), "test.json")?;
    let baked = bake_scene(&scene)?;
    let index: Value = serde_json::from_slice(&baked.files["reports/index.json"])?;
    let manifest: Value = serde_json::from_slice(&baked.files["manifest.json"])?;
    let answer = &index["answers"][0];
    let conclusion = answer["conclusion"].as_str().ok_or("no conclusion")?;
    let measured = manifest["effects"][0]["measured_error"].as_f64().ok_or("no error")?;
    let limited = answer["purposes"][0]["choices"][0]["limited"].as_f64().ok_or("no limited error")?;
    assert_eq!(limited, lobefit_shade::round_up(measured, 4), "of {measured}");
    assert!(conclusion.contains("a fetch, total variation of the width at most 0."), "{conclusion}");
    assert!(!conclusion.contains("adjusted alpha"), "{conclusion}");
    assert!(conclusion.contains(" and a fetch, at the same error."), "{conclusion}");
    // Three lookups of one width: its error is stated once.
    let page = std::str::from_utf8(&baked.files["reports/index.html"])?;
    let card = page.split("<article").nth(1).ok_or("no card")?;
    assert_eq!(card.matches("<dd>that of the recommended, of the same width</dd>").count(), 2, "{card}");
    assert_eq!(card.matches("<dt>Error</dt>").count(), 4, "{card}");
    let choices = answer["purposes"][0]["choices"].as_array().ok_or("no choices")?;
    let of = |choice: &Value| (choice["role"].as_str().map(String::from), choice["cost"]["ops"].as_u64());
    let [(_, best), (cheap, sharp), (cheapest, hit)] = [of(&choices[0]), of(&choices[1]), of(&choices[2])];
    assert_eq!([cheap.as_deref(), cheapest.as_deref()], [Some("cheap"), Some("cheapest")]);
    assert!(hit < sharp && sharp < best, "{hit:?}, {sharp:?}, {best:?}");
    // What a card asks for is what a scene takes, at the operations that the card states.
    for (i, ops) in [(1, sharp), (2, hit)] {
        let asked = choices[i]["asked"].as_str().ok_or("nothing asked")?;
        let scene = Scene::from_json(json.replace("\"lookups\": [{}]", asked).as_bytes(), "test.json")?;
        let baked = bake_scene(&scene)?;
        let manifest: Value = serde_json::from_slice(&baked.files["manifest.json"])?;
        assert_eq!(manifest["lookups"][0]["cost"]["ops"].as_u64(), ops, "{asked}");
        assert_eq!(manifest["lookups"][0]["function"], choices[i]["name"], "{asked}");
    }
    Ok(())
}
