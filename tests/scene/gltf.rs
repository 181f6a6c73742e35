//! Scenes of glTF files: what each extension becomes, what is said of the rest, and files that are refused.

use std::path::Path;

use crate::common;

use common::{lobefit, stderr};
use lobefit::plan::plan;
use lobefit::scene::{Kind, Scene, SceneError};
use lobefit_import::{Format, Imported};
use serde_json::{Value, json};

fn document(materials: Value) -> Value {
    json!({ "asset": { "version": "2.0" }, "materials": materials })
}

fn from_gltf(bytes: &[u8], file: &str) -> Result<Imported, SceneError> {
    Format::Gltf.read(bytes, file, None)
}

fn read(document: &Value) -> (Scene, Vec<String>) {
    let Imported { json, notes } = from_gltf(document.to_string().as_bytes(), "t.gltf").expect("a scene");
    let scene = Scene::from_json(json.as_bytes(), "t").unwrap_or_else(|e| panic!("{e}: {json}"));
    (scene, notes.iter().map(ToString::to_string).collect())
}

fn one(material: Value) -> (Scene, Vec<String>) {
    read(&document(json!([material])))
}

fn example(name: &str) -> Vec<u8> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("examples/gltf/{name}.glb"));
    std::fs::read(path).expect("an example")
}

/// Each example calls for the effects of its materials and for no other.
#[test]
fn examples_call_for_their_own_effects() {
    for (name, effects) in [
        ("metal", &["reflection", "diffuse-coupling"][..]),
        ("plastic", &["reflection", "diffuse-coupling"]),
        ("glass", &["glass"]),
        ("window", &["reflection"]),
        ("brushed", &["anisotropy"]),
        ("cloth", &["reflection", "diffuse-coupling", "sheen"]),
        ("painted", &["reflection", "dielectric", "diffuse-coupling", "clearcoat"]),
    ] {
        let bytes = example(name);
        assert_eq!(Format::of(&bytes, "-"), Some(Format::Gltf));
        let json = from_gltf(&bytes, name).expect(name).json;
        let plan = plan(&Scene::from_json(json.as_bytes(), name).expect("a scene"));
        let found: Vec<&str> = plan.effects.iter().map(|called| called.effect).collect();
        assert_eq!(found, effects, "{name}");
    }
}

/// A factor beside a texture bounds it from above; metalness between its ends is both kinds.
#[test]
fn textures_span_from_zero_to_their_factor() {
    let pbr = json!({ "baseColorFactor": [1, 0.5, 0.25, 1], "roughnessFactor": 0.8, "metallicRoughnessTexture": { "index": 0 } });
    let (scene, notes) = one(json!({ "name": "m", "pbrMetallicRoughness": pbr }));
    let [metal, dielectric] = &scene.materials[..] else { panic!("{scene:?}") };
    assert_eq!(
        (metal.name.as_str(), metal.kind, metal.f0),
        ("m (metal)", Kind::Metal, Some([1.0, 0.5, 0.25]))
    );
    assert_eq!((dielectric.name.as_str(), dielectric.ior), ("m (dielectric)", Some([1.5, 1.5])));
    let mixed = metal.mixed.as_ref().expect("both at once");
    assert_eq!((mixed.metalness, mixed.f0, dielectric.mixed.is_some()), ([0.0, 1.0], [0.04; 3], false));
    assert!(scene.materials.iter().all(|m| m.roughness == [0.0, 0.8]));
    assert_eq!(dielectric.base.as_ref().map(|base| base.albedo), Some([1.0, 0.5, 0.25]));
    assert!(notes[0].starts_with("m: metalness between 0 and 1"), "{notes:?}");
    // Without factors a material is a white, rough metal.
    let (scene, notes) = one(json!({}));
    let [metal] = &scene.materials[..] else { panic!("{scene:?}") };
    assert_eq!((metal.name.as_str(), metal.f0, metal.roughness), ("material 0", Some([1.0; 3]), [1.0; 2]));
    assert!(notes.is_empty());
}

#[test]
fn extensions_become_lobes() {
    let with = |extensions: Value| {
        one(json!({
            "name": "m", "pbrMetallicRoughness": { "metallicFactor": 0, "roughnessFactor": 0.5 }, "extensions": extensions
        }))
    };
    let f0 = |extensions: Value| with(extensions).0.materials[0].f0.expect("a reflectance");
    let specular = json!({ "specularFactor": 0.5, "specularColorFactor": [1, 2, 100] });
    let found = f0(json!({ "KHR_materials_ior": { "ior": 2 }, "KHR_materials_specular": specular }));
    for (found, expected) in found.iter().zip([0.5 / 9.0, 1.0 / 9.0, 0.5]) {
        assert!((found - expected).abs() < 1e-9, "{found} {expected}");
    }
    assert_eq!(f0(json!({ "KHR_materials_ior": { "ior": 0 } })), [1.0; 3], "0 is an infinite index");
    // A solid: half of the spread of Khronos' dispersion, (ior - 1) 0.025 dispersion, on either side.
    let solid = json!({
        "KHR_materials_transmission": { "transmissionFactor": 1 }, "KHR_materials_volume": { "thicknessFactor": 1 },
        "KHR_materials_ior": { "ior": 1.4 }, "KHR_materials_dispersion": { "dispersion": 2 }
    });
    let (scene, _) = with(solid.clone());
    assert_eq!((scene.materials.len(), scene.materials[0].ior), (1, Some([1.38, 1.42])));
    for (ior, f0, said) in [(0.0, 1.0, "infinite (0 in glTF)"), (0.5, 1.0 / 9.0, "below 1, that of a vacuum")]
    {
        let mut refused = solid.clone();
        refused["KHR_materials_ior"]["ior"] = json!(ior);
        let (scene, notes) = with(refused);
        assert_eq!((scene.materials.len(), scene.materials[0].kind), (1, Kind::Dielectric));
        assert!(scene.materials[0].f0.is_some_and(|found| (found[0] - f0).abs() < 1e-8));
        assert!(notes[0].contains(said), "{notes:?}");
    }
    let textured = json!({ "transmissionFactor": 1, "transmissionTexture": { "index": 0 } });
    let (scene, _) = with(json!({
        "KHR_materials_transmission": textured, "KHR_materials_volume": { "thicknessFactor": 1 }
    }));
    let kinds: Vec<Kind> = scene.materials.iter().map(|m| m.kind).collect();
    assert_eq!(kinds, [Kind::Glass, Kind::Dielectric], "where the texture is 0 it is opaque");
    let (scene, _) = with(
        json!({ "KHR_materials_sheen": { "sheenColorFactor": [1, 0, 0], "sheenRoughnessFactor": 0.3 } }),
    );
    assert_eq!(scene.materials[0].sheen.as_ref().map(|sheen| sheen.roughness), Some([0.3; 2]));
    let (scene, _) = with(json!({ "KHR_materials_sheen": { "sheenRoughnessFactor": 0.3 } }));
    assert_eq!(scene.materials[0].sheen, None, "a black sheen is none");
    let (scene, notes) = with(json!({ "KHR_materials_unlit": {} }));
    assert_eq!((scene.materials.len(), notes), (0, vec!["m: unlit: it has no lobe".to_string()]));
    let glossiness = json!({ "glossinessFactor": 0.75, "specularFactor": [0.2, 0.2, 0.2] });
    let (scene, _) = with(json!({ "KHR_materials_pbrSpecularGlossiness": glossiness }));
    assert_eq!((scene.materials[0].f0, scene.materials[0].roughness), (Some([0.2; 3]), [0.25; 2]));
}

/// What scales F90, colours glass, lies on metal or changes over time is planned as if it did not, and said.
#[test]
fn what_is_not_planned_is_said() {
    let with = |metalness: f64, extensions: Value| {
        one(json!({
            "name": "m", "pbrMetallicRoughness": { "metallicFactor": metalness, "roughnessFactor": 0.5 },
            "extensions": extensions
        }))
    };
    let specular = |factor: f64| json!({ "KHR_materials_specular": { "specularFactor": factor } });
    let (scene, notes) = with(0.0, specular(0.3));
    assert!(scene.materials.len() == 1 && notes[0].contains("it scales F90 too"), "{notes:?}");
    let (scene, notes) = with(0.0, specular(0.0));
    assert!(scene.materials.is_empty() && notes.is_empty(), "a lobe of nothing: {notes:?}");
    let mut glass = specular(0.0);
    glass["KHR_materials_transmission"] = json!({ "transmissionFactor": 1 });
    glass["KHR_materials_volume"] = json!({ "thicknessFactor": 1 });
    let (scene, notes) = with(0.0, glass);
    assert_eq!(scene.materials[0].kind, Kind::Glass);
    assert!(notes.iter().any(|note| note.contains("specular of glass")), "{notes:?}");
    let mut neutral = json!({ "KHR_materials_specular": {} });
    neutral["KHR_materials_transmission"] = json!({ "transmissionFactor": 1 });
    neutral["KHR_materials_volume"] = json!({ "thicknessFactor": 1 });
    assert!(with(0.0, neutral).1.is_empty(), "a specular of nothing but defaults");
    let coat = json!({ "KHR_materials_clearcoat": { "clearcoatFactor": 1 } });
    let coats = |metalness| with(metalness, coat.clone()).1.into_iter().filter(|n| n.contains("clear coat"));
    let [over_both, over_metal] = [0.5, 1.0].map(|metalness| coats(metalness).collect::<Vec<_>>());
    assert!(over_both.len() == 2 && over_both[1].contains("over its share of metal"), "{over_both:?}");
    assert!(over_metal.len() == 1 && over_metal[0].contains("the whole coat is left out"), "{over_metal:?}");
    let glossiness = json!({ "specularGlossinessTexture": { "index": 0 } });
    let (_, notes) = with(0.0, json!({ "KHR_materials_pbrSpecularGlossiness": glossiness }));
    assert!(notes.iter().any(|note| note.contains("its f0 has a texture")), "{notes:?}");
    let mut file = document(json!([{ "name": "a" }]));
    file["extensionsUsed"] = json!(["KHR_animation_pointer"]);
    let (_, notes) = read(&file);
    assert!(notes[0].contains("are planned as they are at rest"), "{notes:?}");
}

/// glTF's two widths are those of the scene's parameters: alpha_x = alpha/aspect along the tangent.
#[test]
fn anisotropy_keeps_both_widths() {
    for (roughness, strength) in [(0.5, 0.6), (0.3, 0.2), (0.9, 1.0), (0.7, 0.05)] {
        let (scene, _) = one(json!({
            "pbrMetallicRoughness": { "roughnessFactor": roughness },
            "extensions": { "KHR_materials_anisotropy": { "anisotropyStrength": strength } }
        }));
        let (alpha, aspect) = (
            scene.materials[0].roughness[0] * scene.materials[0].roughness[0],
            (1.0 - 0.9 * scene.materials[0].anisotropy[0]).sqrt(),
        );
        let across: f64 = roughness * roughness;
        let along = across + (1.0 - across) * strength * strength;
        assert!((alpha / aspect - along).abs() < 1e-7, "{roughness} {strength}: {}", alpha / aspect);
        assert!((alpha * aspect - across).abs() < 1e-7, "{roughness} {strength}: {}", alpha * aspect);
    }
    let (scene, notes) = one(json!({
        "pbrMetallicRoughness": { "roughnessFactor": 0.1 },
        "extensions": { "KHR_materials_anisotropy": { "anisotropyStrength": 1 } }
    }));
    assert_eq!(scene.materials[0].anisotropy, [1.0; 2]);
    assert!(notes.iter().any(|note| note.contains("more than 10 times")), "{notes:?}");
}

/// What primitives and their variants draw is planned; materials may share a name.
#[test]
fn only_what_is_drawn_counts() {
    let mut file =
        document(json!([{ "name": "a" }, { "name": "a" }, { "name": "unused" }, { "name": "\u{7}" }]));
    let variants = json!({ "KHR_materials_variants": { "mappings": [{ "material": 3, "variants": [0] }] } });
    file["meshes"] =
        json!([{ "primitives": [{ "material": 0, "extensions": variants }, { "material": 1 }, {}] }]);
    file["extensionsUsed"] = json!(["KHR_materials_coat", "KHR_draco_mesh_compression"]);
    let (scene, notes) = read(&file);
    let names: Vec<&str> = scene.materials.iter().map(|m| m.name.as_str()).collect();
    assert_eq!(names, ["a", "a 2", "material 3", "glTF default"]);
    assert_eq!(
        notes,
        [
            "1 material that no primitive has is left out",
            "this version does not read `KHR_materials_coat`: its materials are planned without it"
        ]
    );
}

#[test]
fn what_is_no_gltf_is_refused_with_its_place() {
    let binary = |json: &[u8], length: u32| {
        [b"glTF", &2_u32.to_le_bytes()[..], &[0; 4], &length.to_le_bytes(), b"JSON", json].concat()
    };
    let material =
        |field: &str| format!(r#"{{"asset":{{"version":"2.0"}},"materials":[{{{field}}}]}}"#).into_bytes();
    for (bytes, said) in [
        (b"glTF".to_vec(), "t.glb: the file ends in its header"),
        (binary(b"{}", 9), "t.glb: its JSON should be 9 bytes, and the file ends before"),
        (binary(b"{}", u32::MAX), "t.glb: its JSON is larger than 16777216 bytes"),
        (binary(b"{}", 2), "t.glb:1:1: missing field `asset`"),
        (b"{".to_vec(), "t.glb:1:1: the file ends inside an object"),
        (
            br#"{"asset":{"version":"1.0"}}"#.to_vec(),
            "t.glb: asset.version: `1.0` is not a version of glTF 2",
        ),
        (
            br#"{"asset":{"version":1.0},"materials":{"m":{}}}"#.to_vec(),
            "t.glb: asset.version: `1` is not a version of glTF 2",
        ),
        (
            material(r#""pbrMetallicRoughness":{"roughnessFactor":1.5}"#),
            "materials[0].pbrMetallicRoughness.roughnessFactor: 1.5 is outside [0, 1]",
        ),
        (
            material(r#""pbrMetallicRoughness":{"baseColorFactor":[1,1,1]}"#),
            "materials[0].pbrMetallicRoughness.baseColorFactor",
        ),
        (
            material(r#""extensions":{"KHR_materials_ior":{"ior":-1}}"#),
            "materials[0].extensions.KHR_materials_ior.ior: -1 is outside [0, 1e30]",
        ),
        (material(r#""name":7"#), "materials[0].name: invalid type: integer `7`"),
        (
            br#"{"asset":{"version":"2.0"},"meshes":[{"primitives":[{"material":2}]}]}"#.to_vec(),
            "t.glb: meshes[0].primitives: material 2 is none of the file's 0 materials",
        ),
    ] {
        let error = from_gltf(&bytes, "t.glb").expect_err(said).to_string();
        assert!(error.contains(said), "`{said}` in `{error}`");
    }
}

/// The scene that is printed plans as the file does, and what it leaves out is said beside it.
#[test]
fn a_scene_from_a_file_is_the_files() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("p.glb"), example("painted")).expect("written");
    let printed = lobefit(folder.path(), &["scene-from", "p.glb"], b"");
    assert_eq!(printed.status.code(), Some(0));
    assert!(
        stderr(&printed).contains(
            "note: car paint: clear coat: this version has the albedo of its lobe and its darkening"
        ),
        "{}",
        stderr(&printed)
    );
    std::fs::write(folder.path().join("p.json"), &printed.stdout).expect("written");
    let plans = ["p.glb", "p.json"].map(|file| lobefit(folder.path(), &["plan", file], b"").stdout);
    let [of_file, of_scene] = plans.map(|text| String::from_utf8(text).expect("text"));
    assert!(
        of_file.starts_with(&of_scene) && of_file.contains("\nnot in this version\n  car paint: "),
        "{of_file}"
    );
    let other = lobefit(folder.path(), &["scene-from", "p.json"], b"");
    assert_eq!(other.status.code(), Some(2));
    assert!(stderr(&other).contains("p.json: .gltf, .glb or .mtlx is called for"), "{}", stderr(&other));
}
