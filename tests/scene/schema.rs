//! The JSON Schema of the scene: it names every field with a description, and the examples follow
//! it.

use std::path::Path;

use lobefit::scene::{Scene, SceneError, kernel, kernel_schema, schema};
use serde_json::{Value, json};

/// The pattern of the path of a mesh: plain and relative.
const MESH: &str = r"^((\.{0,2}[^./\\:][^/\\:]*|\.{3,}[^/\\:]*)/)*[^/\\:]+\.([gG][lL][bB]|[gG][lL][tT][fF])$";

/// What is wrong with `value` by the part of JSON Schema that ours is written in; any other keyword
/// is an error.
fn violations(value: &Value, schema: &Value, root: &Value, path: &str, found: &mut Vec<String>) {
    let Value::Object(rules) = schema else {
        if schema == &json!(false) {
            found.push(format!("{path}: nothing is allowed here"));
        }
        return;
    };
    let passes = |rule: &Value| {
        let mut inner = Vec::new();
        violations(value, rule, root, path, &mut inner);
        inner.is_empty()
    };
    let number = value.as_f64();
    let list = value.as_array();
    for (keyword, rule) in rules {
        let limit = rule.as_f64().unwrap_or(f64::NAN);
        let count = list.map(|l| l.len() as f64);
        let length = value.as_str().map(|s| s.len() as f64);
        let ok = match keyword.as_str() {
            "$schema" | "title" | "description" | "$defs" => true,
            "$ref" => {
                let target = rule.as_str().and_then(|r| r.strip_prefix('#')).and_then(|r| root.pointer(r));
                violations(value, target.expect("a target"), root, path, found);
                true
            }
            "type" => match rule.as_str().expect("one type") {
                "object" => value.is_object(),
                "array" => value.is_array(),
                "string" => value.is_string(),
                "boolean" => value.is_boolean(),
                "integer" => value.is_u64() || value.is_i64(),
                "number" => value.is_number(),
                other => panic!("type {other}"),
            },
            "const" => value == rule,
            "pattern" => {
                let ends: &[&str] = match rule.as_str().expect("text") {
                    "\\.json$" => &[".json"],
                    MESH => &[".glb", ".gltf"],
                    _ => panic!("{rule} is a pattern that this test does not know"),
                };
                let plain = |s: &str| {
                    s.split('/').all(|part| !matches!(part, "" | "." | "..")) && !s.contains([':', '\\'])
                };
                let ended = |s: &str| ends.iter().any(|end| s.to_lowercase().ends_with(end));
                value.as_str().is_some_and(|s| ended(s) && (rule != MESH || plain(s)))
            }
            "contains" => list.is_some_and(|l| {
                l.iter().any(|item| {
                    let mut inner = Vec::new();
                    violations(item, rule, root, path, &mut inner);
                    inner.is_empty()
                })
            }),
            "not" => !passes(rule),
            "enum" => rule.as_array().expect("a list").contains(value),
            "oneOf" => rule.as_array().expect("a list").iter().filter(|r| passes(r)).count() == 1,
            "allOf" => rule.as_array().expect("a list").iter().all(passes),
            "anyOf" => rule.as_array().expect("a list").iter().any(passes),
            "minimum" => number.is_none_or(|x| x >= limit),
            "exclusiveMinimum" => number.is_none_or(|x| x > limit),
            "maximum" => number.is_none_or(|x| x <= limit),
            "uniqueItems" => {
                let distinct = |l: &Vec<Value>| l.iter().enumerate().all(|(i, x)| !l[..i].contains(x));
                list.is_none_or(distinct)
            }
            "minProperties" => value.as_object().is_none_or(|fields| fields.len() as f64 >= limit),
            "minItems" => count.is_none_or(|n| n >= limit),
            "maxItems" => count.is_none_or(|n| n <= limit),
            "minLength" => length.is_none_or(|n| n >= limit),
            "maxLength" => length.is_none_or(|n| n <= limit),
            "items" => {
                for (i, item) in list.into_iter().flatten().enumerate() {
                    violations(item, rule, root, &format!("{path}[{i}]"), found);
                }
                true
            }
            "properties" => {
                for (name, rule) in rule.as_object().expect("an object") {
                    if let Some(field) = value.get(name) {
                        violations(field, rule, root, &format!("{path}.{name}"), found);
                    }
                }
                true
            }
            "required" => rule
                .as_array()
                .expect("a list")
                .iter()
                .all(|n| value.get(n.as_str().expect("a name")).is_some()),
            "additionalProperties" => {
                let known = &rules["properties"];
                value.as_object().is_none_or(|fields| fields.keys().all(|name| known.get(name).is_some()))
            }
            other => panic!("the schema uses `{other}`, which this test does not know"),
        };
        if !ok {
            found.push(format!("{path}: {keyword} {rule}"));
        }
    }
}

fn check(text: &str) -> Vec<String> {
    follows(text, schema().into())
}

fn follows(text: &str, schema: Value) -> Vec<String> {
    let mut found = Vec::new();
    violations(&serde_json::from_str(text).unwrap(), &schema, &schema, "", &mut found);
    found
}

#[test]
fn the_examples_and_the_built_in_scene_follow_it() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let examples = std::fs::read_dir(root.join("examples")).unwrap().map(|e| e.unwrap().path());
    let mut seen = 0;
    for path in examples
        .filter(|p| p.extension().is_some_and(|e| e == "json"))
        .chain([root.join("src/scene/default.json")])
    {
        let text = std::fs::read_to_string(&path).unwrap();
        assert_eq!(check(&text), Vec::<String>::new(), "{}", path.display());
        Scene::with_kernels(text.as_bytes(), "example", |file, _| {
            kernel(&std::fs::read(root.join("examples").join(file)).unwrap(), file)
        })
        .unwrap_or_else(|e: SceneError| panic!("{}: {e}", path.display()));
        seen += 1;
    }
    assert!(seen >= 5);
    let table = std::fs::read_to_string(root.join("examples/kernels/phong.json")).unwrap();
    assert_eq!(follows(&table, kernel_schema().into()), Vec::<String>::new());
    Scene::built_in().unwrap();
}

#[test]
fn it_refuses_what_the_program_refuses() {
    let base = r#"{"schema_version":1,"materials":[{"name":"m","kind":"metal","f0":1,"roughness":1,"wants":{"tables":[{"size":[8,8]}]}}]}"#;
    assert!(check(base).is_empty());
    for (from, to) in [
        ("\"schema_version\":1", "\"schema_version\":2"),
        ("\"f0\":1", "\"f0\":1.5"),
        ("\"f0\":1", "\"f0\":[1,1]"),
        ("\"f0\":1", "\"fo\":1"),
        ("\"roughness\":1", "\"roughness\":\"1\""),
        ("\"roughness\":1", "\"roughness\":[0.5]"),
        ("\"roughness\":1", "\"roughness\":1,\"ior\":1"),
        ("[8,8]", "[1,8]"),
        ("[8,8]", "8"),
        ("[8,8]", "null"),
        ("\"metal\"", "\"wood\""),
        ("\"name\":\"m\",", ""),
        ("{\"schema", "{\"probes\":[1],\"schema"),
        ("\"f0\":1,", ""),
        ("\"f0\":1", "\"ior\":1.5"),
        ("\"f0\":1", "\"f0\":1,\"ior\":1.5"),
        ("\"metal\",\"f0\":1", "\"dielectric\",\"f0\":1,\"ior\":1.5"),
        ("\"metal\",\"f0\":1", "\"dielectric\""),
        ("{\"tables\":[{\"size\":[8,8]}]}", "{}"),
        ("\"tables\":[{\"size\":[8,8]}]", "\"fit\":{\"norms\":[]}"),
        ("\"tables\":[{\"size\":[8,8]}]", "\"fit\":{\"norms\":[\"max\",\"max\"]}"),
    ] {
        let text = base.replacen(from, to, 1);
        assert!(!check(&text).is_empty(), "{text}");
        assert!(Scene::from_json(text.as_bytes(), "s").is_err(), "{text}");
    }
}

#[test]
fn it_refuses_of_anisotropy_and_glass_what_the_program_refuses() {
    let anisotropic = r#"{"schema_version":1,"formats":["exr","raw"],"materials":[{"name":"m","kind":"metal","f0":1,"roughness":1,"anisotropy":[0,1],"wants":{"fit":{},"tables":[{"size":[8,8,8]},{"layout":"azimuth"},{"layout":"path-tracer"}]}}]}"#;
    let glass = r#"{"schema_version":1,"materials":[{"name":"m","kind":"glass","ior":[1,2],"roughness":1,"wants":{"tables":[{"format":"f32"}]}}]}"#;
    let sheen = r#"{"schema_version":1,"materials":[{"name":"m","kind":"metal","f0":1,"roughness":1,"sheen":{"roughness":[0.1,1],"norms":["rms"],"max_ops":9,"tables":[{"layout":"plain"}]},"wants":{"fit":{"blend":true}}}]}"#;
    let based = r#"{"schema_version":1,"materials":[{"name":"m","kind":"dielectric","f0":0.04,"roughness":1,"base":{"albedo":[0.5,1,0],"specular":"single","max_ops":9,"norms":["max"]}}]}"#;
    let exact = r#"{"schema_version":1,"materials":[{"name":"m","kind":"dielectric","ior":1.5,"roughness":1,"wants":{"exact_fresnel":{"max_ops":47,"tables":[{"format":"f32"}]}}}]}"#;
    let refracted = r#"{"schema_version":1,"materials":[{"name":"m","kind":"glass","ior":1.5,"roughness":1,"wants":{"refracted_width":{"max_ops":4}}}]}"#;
    let coated = r#"{"schema_version":1,"materials":[{"name":"m","kind":"dielectric","f0":0.04,"roughness":1,"coat":{"roughness":[0.1,1],"ior":1.6,"max_ops":8}}]}"#;
    let beckmann = r#"{"schema_version":1,"materials":[{"name":"m","kind":"dielectric","ior":1.5,"roughness":1,"distribution":"beckmann","base":{"roughness":0.5},"wants":{"fit":{"max_ops":9},"tables":[{"layout":"plain"}]}}]}"#;
    let dielectric =
        r#"{"schema_version":1,"materials":[{"name":"m","kind":"dielectric","ior":1.5,"roughness":1}]}"#;
    for (base, changes) in [
        (
            anisotropic,
            &[
                ("[\"exr\",\"raw\"]", "[\"exr\",\"exr\"]"),
                ("[\"exr\",\"raw\"]", "[]"),
                ("[\"exr\",\"raw\"]", "[\"png\"]"),
                ("[\"exr\",\"raw\"]", "\"exr\""),
                ("[0,1]", "[0,1.5]"),
                ("[0,1]", "[0]"),
                ("\"anisotropy\":[0,1],", ""),
                ("[8,8,8]", "[8,8,3]"),
                ("[8,8,8]", "[8,8,257]"),
                ("\"azimuth\"", "\"cubic\""),
                ("\"azimuth\"", "\"dielectric\""),
                ("{\"layout\":\"azimuth\"}", "{\"layout\":\"path-tracer\"}"),
                ("{\"layout\":\"azimuth\"}", "{\"serves\":\"split-sum\"}"),
            ][..],
        ),
        (
            glass,
            &[
                ("[1,2]", "[1,3.5]"),
                ("[1,2]", "3.5"),
                ("[1,2]", "0.5"),
                ("\"ior\":[1,2]", "\"f0\":0.04"),
                ("\"ior\":[1,2],", ""),
                ("\"roughness\":1", "\"roughness\":1,\"anisotropy\":1.5"),
                ("\"tables\":[{\"format\":\"f32\"}]", "\"fit\":{\"blend\":true}"),
                ("\"wants\":{\"tables\":[{\"format\":\"f32\"}]", "\"anisotropy\":0.5,\"wants\":{\"fit\":{}"),
                (
                    "\"wants\":{\"tables\":[{\"format\":\"f32\"}]",
                    "\"distribution\":\"beckmann\",\"wants\":{\"refracted_width\":{}",
                ),
                ("\"tables\":[{\"format\":\"f32\"}]", "\"tables\":[{\"layout\":\"plain\"}]"),
                ("[{\"format\":\"f32\"}]", "[]"),
            ],
        ),
        (
            refracted,
            &[
                ("\"glass\"", "\"dielectric\""),
                ("\"glass\",\"ior\":1.5", "\"metal\",\"f0\":1"),
                ("\"max_ops\":4", "\"blend\":true"),
            ],
        ),
        (
            beckmann,
            &[
                ("\"beckmann\"", "\"phong\""),
                ("\"beckmann\"", "\"beckmann\",\"anisotropy\":0.5"),
                ("\"beckmann\"", "\"beckmann\",\"coat\":{\"roughness\":0.1}"),
                ("{\"roughness\":0.5}", "{}"),
                ("\"max_ops\":9", "\"average\":true"),
                ("\"max_ops\":9", "\"multiscatter\":true"),
                ("\"fit\":{\"max_ops\":9}", "\"exact_fresnel\":{}"),
                ("\"fit\":{\"max_ops\":9}", "\"widened\":{\"light_radius\":0.1}"),
                ("\"plain\"", "\"area-lights\""),
            ],
        ),
        (
            coated,
            &[
                ("[0.1,1]", "[0.1,1.5]"),
                ("\"ior\":1.6", "\"ior\":0.5"),
                ("\"ior\":1.6", "\"ior\":[1,3.5]"),
                ("\"ior\":1.6", "\"f0\":0.04"),
                ("\"dielectric\"", "\"metal\""),
                ("\"dielectric\",\"f0\":0.04", "\"glass\",\"ior\":1.5"),
            ],
        ),
        (
            based,
            &[
                ("[0.5,1,0]", "[0.5,1]"),
                ("[0.5,1,0]", "1.5"),
                ("\"single\"", "\"kelemen\""),
                ("[\"max\"]", "[]"),
                ("\"max_ops\":9", "\"colour\":1"),
                ("\"dielectric\"", "\"metal\""),
                ("\"dielectric\",\"f0\":0.04", "\"glass\",\"ior\":1.5"),
            ],
        ),
        (dielectric, &[("1.5", "[1.5,1.6]"), ("1.5", "1"), ("1.5", "4.5")]),
        (
            exact,
            &[
                ("\"dielectric\"", "\"glass\""),
                ("\"dielectric\",\"ior\":1.5", "\"metal\",\"f0\":1"),
                ("\"ior\":1.5", "\"f0\":0.04"),
                ("\"ior\":1.5", "\"ior\":3.5"),
                ("\"ior\":1.5", "\"ior\":1.5,\"anisotropy\":0.5"),
                ("\"max_ops\":47", "\"blend\":true"),
                ("\"format\":\"f32\"", "\"layout\":\"plain\""),
                ("\"format\":\"f32\"", "\"format\":\"unorm16\""),
                ("\"format\":\"f32\"", "\"serves\":\"split-sum\""),
            ],
        ),
        (
            sheen,
            &[
                ("[0.1,1]", "[0.1,1.5]"),
                ("\"roughness\":[0.1,1],", ""),
                ("[\"rms\"]", "[]"),
                ("[\"rms\"]", "[\"rms\",\"rms\"]"),
                ("\"max_ops\":9", "\"max_ops\":1.5"),
                ("\"max_ops\":9", "\"colour\":1"),
                ("\"blend\":true", "\"blend\":1"),
            ],
        ),
    ] {
        assert_eq!(check(base), Vec::<String>::new());
        Scene::from_json(base.as_bytes(), "s").unwrap();
        for (from, to) in changes {
            let text = base.replacen(from, to, 1);
            assert_ne!(text, base, "{from}");
            assert!(!check(&text).is_empty(), "{text}");
            assert!(Scene::from_json(text.as_bytes(), "s").is_err(), "{text}");
        }
    }
}

#[test]
fn it_refuses_of_culling_what_the_program_refuses() {
    let base = r#"{"schema_version":1,"materials":[],"culling":{"world":"a/B.GLB","grid":[2,256,512],"passes":["reproject","voxels"]}}"#;
    assert_eq!(check(base), Vec::<String>::new());
    Scene::from_json(base.as_bytes(), "s").unwrap();
    for (from, to) in [
        ("a/B.GLB", "../B.glb"),
        ("a/B.GLB", "/B.glb"),
        ("a/B.GLB", "a//B.glb"),
        ("a/B.GLB", "a:B.glb"),
        ("a/B.GLB", "B.obj"),
        ("[2,256,512]", "[2,100,512]"),
        ("[2,256,512]", "[2,256]"),
        ("[\"reproject\",\"voxels\"]", "[\"median\"]"),
        ("\"voxels\"", "\"reproject-half\""),
    ] {
        let text = base.replacen(from, to, 1);
        assert!(!check(&text).is_empty(), "{text}");
        assert!(Scene::from_json(text.as_bytes(), "s").is_err(), "{text}");
    }
}

/// The field names under every `properties` of the schema, with their descriptions.
fn fields(value: &Value, found: &mut Vec<(String, bool)>) {
    match value {
        Value::Object(map) => {
            for (name, field) in map.get("properties").and_then(Value::as_object).into_iter().flatten() {
                let described = field["description"].as_str().is_some_and(|d| d.len() > 10);
                found.push((name.clone(), described));
            }
            // Conditions name fields and declare none.
            let declaring = map.iter().filter(|(key, _)| !matches!(key.as_str(), "anyOf" | "oneOf"));
            declaring.for_each(|(_, v)| fields(v, found));
        }
        Value::Array(list) => list.iter().for_each(|v| fields(v, found)),
        _ => {}
    }
}

#[test]
fn it_names_and_describes_every_field() {
    let mut found = Vec::new();
    fields(&schema().into(), &mut found);
    let mut names: Vec<&str> = found.iter().map(|(name, _)| name.as_str()).collect();
    names.sort();
    assert_eq!(
        names,
        [
            "albedo",
            "alpha",
            "anisotropy",
            "arguments",
            "average",
            "base",
            "blend",
            "buffer",
            "coat",
            "coat",
            "cost",
            "count",
            "culling",
            "distribution",
            "edges",
            "engines",
            "exact_fresnel",
            "f0",
            "f0",
            "fit",
            "format",
            "formats",
            "grid",
            "hit",
            "hypotheses",
            "ior",
            "ior",
            "kernel",
            "kind",
            "languages",
            "latency",
            "layout",
            "levels",
            "light_radius",
            "lobe",
            "lookups",
            "map",
            "materials",
            "max_error",
            "max_error",
            "max_error",
            "max_error",
            "max_error",
            "max_error",
            "max_error",
            "max_error",
            "max_error",
            "max_ops",
            "max_ops",
            "max_ops",
            "max_ops",
            "max_ops",
            "max_ops",
            "max_ops",
            "max_ops",
            "mean_length",
            "metalness",
            "mips",
            "mixed",
            "mu",
            "multiscatter",
            "n_dot_v",
            "name",
            "name",
            "name",
            "norms",
            "norms",
            "norms",
            "norms",
            "norms",
            "norms",
            "norms",
            "norms",
            "passes",
            "path",
            "pick",
            "planes",
            "precision",
            "probes",
            "refracted_width",
            "reports",
            "rho",
            "roughness",
            "roughness",
            "roughness",
            "roughness",
            "roughness",
            "schema_version",
            "seed",
            "serves",
            "sheen",
            "sheen_visibility",
            "size",
            "smith",
            "specular",
            "specular",
            "tables",
            "tables",
            "tables",
            "taps",
            "wants",
            "widened",
            "world",
        ]
    );
    for (name, described) in found {
        assert!(described, "{name} has no description");
    }
}
