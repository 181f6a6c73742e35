//! The effect ltc: from the scene to tables and functions that light a lobe by a quadrilateral within
//! the stated error, in every language, and nothing of them where a scene does not ask.

use crate::emit_support;

use std::sync::LazyLock;

use emit_support::example::{baked, compiled, text};
use lobefit::bake::Baked;
use lobefit::emit::manifest::Manifest;
use lobefit::plan::plan;
use lobefit::scene::{Limits, Scene};
use lobefit_ltc::{Lobe, View, squares};
use lobefit_shade::Source;
use lobefit_shade::code::Language;
use lobefit_truth::optics::Smith;

/// Small tables, with the ends of the range at texels.
const SCENE: &str = r#"{ "schema_version": 1, "name": "lit", "formats": ["raw"], "materials": [
    { "name": "steel", "kind": "metal", "f0": 0.5, "roughness": [0.5, 1],
      "wants": { "tables": [{ "layout": "area-lights", "size": [9, 9], "format": "f32", "n_dot_v": [0.1, 1] }] } },
    { "name": "velvet", "kind": "dielectric", "f0": 0.04, "roughness": 0, "sheen": { "roughness": [0.5, 1], "max_ops": 8,
      "tables": [{ "layout": "area-lights", "size": [9, 9], "n_dot_v": [0.1, 1] }] } }] }"#;

static LIT: LazyLock<Baked> = LazyLock::new(|| baked(SCENE));

fn manifest() -> Manifest {
    Manifest::read(&LIT.files["manifest.json"]).expect("a manifest")
}

/// The texels of a table of f32.
fn texels(name: &str) -> Vec<[f64; 4]> {
    let numbers: Vec<f64> =
        LIT.files[name].as_chunks().0.iter().map(|b| f64::from(f32::from_le_bytes(*b))).collect();
    numbers.as_chunks().0.to_vec()
}

/// The emitted function, of a texel and of the corners of a square.
fn quad() -> impl Fn([f64; 4], [[f64; 3]; 4]) -> f64 {
    // Without the lookups, which fetch.
    let text = text(&LIT, Language::Wgsl);
    let functions = &text[text.find("/// The angle of two directions").expect("the first of them")..];
    let source = Source::parse("lobefit.wgsl", functions).expect("it parses");
    let tape = source.tape("ltc_quad", 0).expect("a function");
    move |matrix, corners| {
        let of = |input: &String| {
            let (vector, part) = input.split_once('.').expect("a component");
            let part = ["x", "y", "z", "w"].iter().position(|axis| *axis == part).expect("an axis");
            match vector.strip_prefix('p') {
                Some(corner) => corners[corner.parse::<usize>().expect("a corner")][part] as f32,
                None => matrix[part] as f32,
            }
        };
        f64::from(tape.at(&tape.inputs().iter().map(of).collect::<Vec<f32>>(), &[]))
    }
}

#[test]
fn a_square_lights_the_lobe_within_the_stated_error() {
    let (name, side) = ("ggx-ltc-correlated-9x9-f32", 9);
    let entry = |name: &str| {
        manifest().entries.tables.into_iter().find(|table| table.name == name).expect("an entry")
    };
    let (entry, light) = (entry(name), entry(&format!("{name}-light")));
    let (stated, of_e) = (entry.error.lookup.max, light.error.lookup.max);
    let (matrices, lights) = (texels(&entry.file), texels(&light.file));
    let (quad, mut worst) = (quad(), 0.0_f64);
    for (i, k) in [(4, 0), (4, 4), (6, 7), (8, 2), (8, 7)] {
        let (roughness, v) = (f64::from(i) / 8.0, f64::from(k) / 8.0);
        let view =
            View::new(Lobe::Ggx(Smith::Correlated), roughness * roughness, 1.0 - v * v).expect("a view");
        let at = (k * side + i) as usize;
        let [e, b, zero, _] = lights[at];
        assert!((e - view.albedo).abs() <= of_e && (0.0..0.5).contains(&b) && zero == 0.0, "{e} {b}");
        for square in squares(&view) {
            let off = (quad(matrices[at], square.corners()) - square.share(&view).value).abs();
            assert!(off <= stated + 1e-3, "roughness {roughness}, mu {}: {off}, stated {stated}", view.mu);
            worst = worst.max(off);
        }
    }
    assert!(worst > 0.2 * stated, "{stated} is stated, {worst} found");
    // Each table has figures of its own: of squares, and of E and B at texels and between them.
    let [of_matrix, of_light] = [&entry, &light].map(|table| &table.error.lookup);
    assert_ne!(of_matrix.rms, of_light.rms);
    let headers = [name, "ggx-ltc-correlated-9x9-f32-light"].map(|name| {
        let sidecar =
            LIT.files.iter().find(|(path, _)| path.contains(&format!("/{name}.")) && path.ends_with("json"));
        String::from_utf8_lossy(sidecar.expect("a sidecar").1).into_owned()
    });
    println!("{headers:?}");
    let [matrix, light] = headers.map(|text| serde_json::from_str::<serde_json::Value>(&text).expect("JSON"));
    let figures =
        |of: &serde_json::Value| ["max_abs", "max_rel", "points"].map(|key| of["certificate"][key].as_f64());
    let ([shape, _, squares], [most, relative, places]) = (figures(&matrix), figures(&light));
    assert_eq!((shape, most), (Some(stated), Some(of_e)));
    assert!(relative > most && places != squares, "{light}");
    assert!(light.to_string().contains("the share of a sphere by"), "{light}");
    assert!(stated < 0.1 && of_e < 0.05, "{stated} {of_e}");
}

#[test]
fn what_is_called_is_said() {
    let (manifest, text) = (manifest(), text(&LIT, Language::Glsl));
    for (function, of, layer) in
        [("ggx_ltc_matrix", "steel", None), ("sheen_ltc_matrix", "velvet", Some("sheen"))]
    {
        let call = manifest.entries.calls.iter().find(|call| call.function == function).expect("a call");
        assert_eq!((call.of.as_str(), call.layer.as_deref()), (of, layer));
        assert_eq!(call.arguments, ["table", "roughness", "n_dot_v"]);
        let around = call.around.first().expect("what takes it");
        assert_eq!((around.function.as_str(), around.value.as_deref()), ("ltc_quad", Some("matrix")));
        assert!(call.recommended && text.contains(&format!("vec4 {function}(")), "{text}");
    }
    assert!(
        text.contains("of a light of any shape at most") && text.contains("In f32 it is off by"),
        "{text}"
    );
    let page = String::from_utf8(LIT.files["reports/ltc.html"].clone()).expect("UTF-8");
    assert!(page.contains("transformed cosine") && page.contains("the horizon by"));
    let light = manifest.entries.tables.iter().find(|table| table.name == "sheen-ltc-9x9-light").expect("it");
    assert_eq!(light.channels, ["E", "B", "zero", "sphere"]);
    assert_eq!(light.axes[1].warp, "u = sqrt(1 - mu)");
}

/// Both textures of a pair are what `cost --max-bytes` limits; a half that keeps the limit is taken.
#[test]
fn most_bytes_are_of_both_textures() {
    for (most, pairs) in [
        (1295, ["ggx-ltc-correlated-4x4-f32", "sheen-ltc-4x4"]),
        (1296, ["ggx-ltc-correlated-4x4-f32", "sheen-ltc-9x9"]),
        (2592, ["ggx-ltc-correlated-9x9-f32", "sheen-ltc-9x9"]),
        (1, ["ggx-ltc-correlated-9x9-f32", "sheen-ltc-9x9"]),
    ] {
        let scene = Scene::from_json(SCENE.as_bytes(), "scene.json").expect("a scene");
        let scene = scene.limited(&Limits {
            budget: None,
            vendor: None,
            max_error: None,
            max_bytes: Some(most),
            language: Language::Wgsl,
        });
        let plan = plan(&scene);
        let called = plan.effects.iter().find(|called| called.effect == "ltc").expect("called");
        let names: Vec<&str> = called.work.iter().map(|job| job.name.as_str()).collect();
        assert_eq!(names, pairs, "{most} bytes");
    }
}

#[test]
fn compilers_take_the_files() {
    compiled(&LIT);
}

#[test]
fn a_limit_is_kept_or_the_bake_fails() {
    let strict = SCENE.replacen(r#""n_dot_v": [0.1, 1]"#, r#""n_dot_v": [0.1, 1], "max_error": 0.001"#, 1);
    let broken = baked(&strict.replacen('{', r#"{ "reports": false,"#, 1)).broken;
    assert_eq!(broken.len(), 1, "{broken:?}");
    assert!(
        broken[0].contains("exceeds the max_error 0.001 of steel (materials[0].wants.tables[0].max_error)")
    );
    for (table, message) in [
        (r#""layout": "area-lights", "size": [8, 9]"#, "square tables"),
        (r#""layout": "area-lights", "serves": "split-sum""#, "area-lights layout serves the albedo"),
    ] {
        let json = format!(
            r#"{{"schema_version": 1, "materials": [{{"name": "m", "kind": "metal", "f0": 1, "roughness": 0.5,
                "wants": {{"tables": [{{{table}}}]}}}}]}}"#
        );
        let refused = Scene::from_json(json.as_bytes(), "scene.json").expect_err("refused").to_string();
        assert!(refused.contains(message), "{refused}");
    }
    // Below alpha 0.01 a sheen has no matrix: its domain begins there, and a smoother one asks for nothing.
    let of_sheen = |range: &str| {
        let json = SCENE
            .replace(r#""sheen": { "roughness": [0.5, 1]"#, &format!(r#""sheen": {{ "roughness": {range}"#));
        let plan = plan(&Scene::from_json(json.as_bytes(), "scene.json").expect("a scene"));
        let work =
            plan.effects.iter().filter(|called| called.effect == "ltc").flat_map(|called| &called.work);
        work.filter(|job| job.name.starts_with("sheen"))
            .map(|job| job.range("roughness").expect("a range"))
            .next()
    };
    assert_eq!(of_sheen("[0, 0.6]"), Some([0.1, 0.6]));
    assert_eq!(of_sheen("0.05"), None);
    let without = SCENE.replace("area-lights", "plain").replace("[9, 9]", "[8, 8]");
    let scene = Scene::from_json(without.as_bytes(), "scene.json").expect("a scene");
    let left = plan(&scene).left_out.into_iter().find(|left| left.effect == "ltc").expect("left out");
    assert_eq!(left.reason, "no material wants tables in the `area-lights` layout");
}

/// Every file for an engine has the halves of the two tables, read here as the engine does.
#[test]
fn engines_read_the_pair_from_one_file() {
    let scene = SCENE
        .replacen(r#""size": [9, 9], "format": "f32""#, r#""engines": ["three", "babylon", "bevy"]"#, 1)
        .replace(r#""size": [9, 9], "#, "")
        .replacen('{', r#"{ "reports": false, "languages": ["wgsl"],"#, 1);
    // Of two materials with one pair the second asks for the engines.
    let steel = scene.find(r#"{ "name": "steel""#).expect("a material");
    let other = r#"{ "name": "tin", "kind": "metal", "f0": 0.5, "roughness": 1, "wants": { "tables": [{ "layout": "area-lights" }] } },"#;
    let baked = baked(&format!("{}{other}{}", &scene[..steel], &scene[steel..]));
    let name = "ggx-ltc-correlated-64x64";
    let raw = |name: &str| -> Vec<[f32; 4]> {
        let numbers: Vec<f32> =
            baked.files[name].as_chunks().0.iter().map(|b| f32::from_le_bytes(*b)).collect();
        numbers.as_chunks().0.to_vec()
    };
    let [matrices, lights] = [raw(&format!("tables/{name}.raw")), raw(&format!("tables/{name}-light.raw"))];
    assert_eq!((matrices.len(), lights.len()), (64 * 64, 64 * 64));
    let halves = |bytes: &[u8]| -> Vec<[f32; 4]> {
        let numbers: Vec<f32> =
            bytes.as_chunks().0.iter().map(|b| half::f16::from_le_bytes(*b).to_f32()).collect();
        numbers.as_chunks().0.to_vec()
    };

    // What a manifest lists is removed with it, and missed where it is gone.
    let manifest = Manifest::read(&baked.files["manifest.json"]).expect("a manifest");
    let files = &manifest.entries.tables.iter().find(|table| table.name == name).expect("the matrices").files;
    for extension in ["raw", "babylon.bin", "bevy.ktx2", "three.js"] {
        assert!(files.contains(&format!("tables/{name}.{extension}")), "{files:?}");
    }

    // ltc1[i] is the first four of eight, ltc2[i] the others.
    let babylon = halves(&baked.files[&format!("tables/{name}.babylon.bin")]);
    let turns: Vec<[f32; 4]> = matrices.iter().zip(&lights).flat_map(|(m, l)| [*m, *l]).collect();
    assert!(babylon == turns);

    let bevy = &baked.files[&format!("tables/{name}.bevy.ktx2")];
    let word = |at: usize| u32::from_le_bytes(bevy[at..at + 4].try_into().expect("four bytes"));
    // VK_FORMAT_R16G16B16A16_SFLOAT, width, height, depth, layers, faces, levels, supercompression.
    let header: Vec<u32> = [12, 20, 24, 28, 32, 36, 40, 44].map(word).to_vec();
    assert_eq!(header, [97, 64, 64, 0, 2, 1, 1, 0]);
    let [first, length] = [word(80) as usize, word(88) as usize];
    assert_eq!((first + length, word(88)), (bevy.len(), word(96)));
    let both = halves(&bevy[first..]);
    assert!(both == [&matrices[..], &lights[..]].concat());

    let three = String::from_utf8(baked.files[&format!("tables/{name}.three.js")].clone()).expect("text");
    for (array, texels) in [("LTC_MAT_1", &matrices), ("LTC_MAT_2", &lights)] {
        let (_, after) = three.split_once(&format!("export const {array} = [")).expect("an array");
        let (list, _) = after.split_once("];").expect("its end");
        let numbers = list.split(',').map(str::trim).filter(|word| !word.is_empty());
        let numbers: Vec<f32> = numbers.map(|word| word.parse().expect("a number")).collect();
        assert!(numbers == texels.concat(), "{array}");
    }
    assert!(three.starts_with("// ") && three.contains("roughness"), "{}", &three[..400]);
    assert!(!baked.files.keys().any(|file| file.contains("sheen") && file.ends_with(".bin")));
}

#[test]
fn engines_are_refused_what_they_do_not_read() {
    for (scene, table, message) in [
        (
            "",
            r#""layout": "plain", "engines": ["bevy"]"#,
            "tables[0].engines: no engine reads a table in the `plain` layout",
        ),
        ("", r#""layout": "area-lights", "engines": []"#, "engines: the list is empty"),
        ("", r#""layout": "area-lights", "engines": ["bevy", "bevy"]"#, "`bevy` is there twice"),
        ("", r#""layout": "area-lights", "engines": ["unity"]"#, "`babylon`, `bevy`, `three`"),
        ("", r#""layout": "area-lights", "engines": ["bevy"], "format": "f32""#, "64x64 texels of f16"),
        ("", r#""layout": "area-lights", "engines": ["bevy"], "size": [32, 32]"#, "64x64 texels of f16"),
        (
            r#""alpha": "roughness","#,
            r#""layout": "area-lights", "engines": ["bevy"]"#,
            "the scene has `roughness`",
        ),
    ] {
        let json = format!(
            r#"{{"schema_version": 1, {scene} "materials": [{{"name": "m", "kind": "metal", "f0": 1, "roughness": 0.5,
                "wants": {{"tables": [{{{table}}}]}}}}]}}"#
        );
        let refused = Scene::from_json(json.as_bytes(), "scene.json").expect_err("refused").to_string();
        assert!(refused.contains(message), "{refused}");
    }
}
