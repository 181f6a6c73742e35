//! Scenes of MaterialX: what the inputs of each model become, and what is said of the rest.

use lobefit::scene::{Kind, Material, Scene};
use lobefit_import::{About, Format, Note};

fn read(inner: &str) -> (Vec<Material>, Vec<Note>) {
    let text = format!("<materialx version=\"1.39\" colorspace=\"lin_rec709\">{inner}</materialx>");
    let read = Format::MaterialX.read(text.as_bytes(), "t.mtlx", None).unwrap_or_else(|e| panic!("{e}"));
    let scene = Scene::from_json(read.json.as_bytes(), "t").unwrap_or_else(|e| panic!("{e}: {}", read.json));
    (scene.materials, read.notes)
}

/// A shader of a model with these constants.
fn shader(model: &str, inputs: &[(&str, &str)]) -> (Vec<Material>, Vec<Note>) {
    let inputs = inputs.iter().map(|(name, value)| format!("<input name=\"{name}\" value=\"{value}\"/>"));
    read(&format!("<{model} name=\"m\">{}</{model}>", inputs.collect::<String>()))
}

fn close(found: [f64; 3], expected: [f64; 3]) -> bool {
    found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-8)
}

/// What a model is without inputs: the defaults of its specification.
#[test]
fn models_have_their_own_defaults() {
    for (model, kind, roughness, base) in [
        ("open_pbr_surface", Kind::Dielectric, 0.3, Some(0.8)),
        ("standard_surface", Kind::Dielectric, 0.2, Some(0.8)),
        ("gltf_pbr", Kind::Metal, 1.0, None),
        ("UsdPreviewSurface", Kind::Dielectric, 0.5, Some(0.18)),
    ] {
        let (materials, notes) = shader(model, &[]);
        let [material] = &materials[..] else { panic!("{model}: {materials:?}") };
        assert_eq!((material.kind, material.roughness), (kind, [roughness; 2]), "{model}");
        assert_eq!(material.base.as_ref().map(|base| base.albedo[0]), base, "{model}");
        assert_eq!(material.ior, base.map(|_| [1.5; 2]), "{model}");
        assert!(notes.is_empty(), "{model}: {notes:?}");
    }
}

/// The widths of each model's lobe are those of the scene's parameters.
#[test]
fn anisotropy_keeps_both_widths() {
    let (roughness, strength): (f64, f64) = (0.5, 0.6);
    let alpha = roughness * roughness;
    let open_pbr = alpha * (2.0_f64 / (1.0 + 0.16)).sqrt();
    let standard = (1.0 - strength).sqrt();
    for (model, names, [along, across]) in [
        (
            "open_pbr_surface",
            ["specular_roughness", "specular_roughness_anisotropy"],
            [open_pbr, 0.4 * open_pbr],
        ),
        (
            "standard_surface",
            ["specular_roughness", "specular_anisotropy"],
            [alpha / standard, alpha * standard],
        ),
        ("gltf_pbr", ["roughness", "anisotropy_strength"], [alpha + 0.75 * strength * strength, alpha]),
    ] {
        let (materials, _) = shader(model, &[(names[0], "0.5"), (names[1], "0.6")]);
        let alpha = materials[0].roughness[0] * materials[0].roughness[0];
        let aspect = (1.0 - 0.9 * materials[0].anisotropy[0]).sqrt();
        assert!((alpha / aspect - along).abs() < 1e-7, "{model}: {}", alpha / aspect);
        assert!((alpha * aspect - across).abs() < 1e-7, "{model}: {}", alpha * aspect);
    }
}

#[test]
fn lobes_of_models_become_materials() {
    let (materials, _) = shader(
        "standard_surface",
        &[("specular", "0.5"), ("specular_color", "1, 0.5, 0"), ("base", "0.5"), ("base_color", "1, 0, 0")],
    );
    assert!(close(materials[0].f0.expect("f0"), [0.02, 0.01, 0.0]));
    assert_eq!(materials[0].base.as_ref().map(|base| base.albedo), Some([0.5, 0.0, 0.0]));
    // The version before had other defaults.
    let (materials, _) = read(
        "<standard_surface name=\"m\" version=\"1.0.0\"><input name=\"base_color\" value=\"1,0,0\"/></standard_surface>",
    );
    assert_eq!(materials[0].base.as_ref().map(|base| base.albedo), Some([0.8, 0.0, 0.0]));
    // Abbe's number: half of (n - 1)/V on either side.
    let glass =
        [("specular_ior", "1.6"), ("transmission_weight", "1"), ("transmission_dispersion_scale", "0.5")];
    let (materials, _) = shader("open_pbr_surface", &glass);
    assert_eq!(
        (materials.len(), materials[0].kind, materials[0].ior),
        (1, Kind::Glass, Some([1.5925, 1.6075]))
    );
    let (materials, _) =
        shader("standard_surface", &[("transmission", "0.5"), ("transmission_extra_roughness", "0.1")]);
    let kinds: Vec<_> = materials.iter().map(|m| (m.kind, m.roughness)).collect();
    assert_eq!(kinds, [(Kind::Glass, [0.3; 2]), (Kind::Dielectric, [0.2; 2])]);
    let (materials, notes) =
        shader("open_pbr_surface", &[("transmission_weight", "1"), ("geometry_thin_walled", "true")]);
    assert_eq!((materials.len(), materials[0].kind), (1, Kind::Dielectric));
    assert!(notes[0].text.contains("thin wall"), "{notes:?}");
    let (materials, _) =
        shader("UsdPreviewSurface", &[("useSpecularWorkflow", "1"), ("specularColor", "0.1,0.2,0.3")]);
    assert_eq!(materials[0].f0, Some([0.1, 0.2, 0.3]));
    // A rough base, also without a specular lobe.
    for specular in ["0", "1"] {
        let inputs = [("specular_weight", specular), ("base_diffuse_roughness", "0.5")];
        let (materials, _) = shader("open_pbr_surface", &inputs);
        assert_eq!(materials[0].base.as_ref().map(|base| base.roughness), Some([0.5; 2]));
    }
    // A sheen without a specular lobe; its roughness is alpha there.
    let (materials, _) =
        shader("standard_surface", &[("specular", "0"), ("sheen", "1"), ("sheen_roughness", "0.25")]);
    assert_eq!(materials[0].sheen.as_ref().map(|sheen| sheen.roughness), Some([0.5; 2]));
    assert_eq!(materials[0].roughness, [0.0; 2]);
}

#[test]
fn coats_have_their_roughness_and_index() {
    let of = |model: &str, inputs: &[(&str, &str)]| {
        let (materials, _) = shader(model, inputs);
        materials.last().and_then(|m| m.coat.as_ref()).map(|coat| [coat.roughness, coat.ior])
    };
    assert_eq!(of("open_pbr_surface", &[("coat_weight", "0.5")]), Some([[0.0; 2], [1.6; 2]]));
    assert_eq!(of("standard_surface", &[("coat", "1"), ("coat_IOR", "1.3")]), Some([[0.1; 2], [1.3; 2]]));
    let mixed = [("clearcoat", "1"), ("clearcoat_roughness", "0.3"), ("metallic", "0.5")];
    assert_eq!(of("gltf_pbr", &mixed), Some([[0.3; 2], [1.5; 2]]));
    assert_eq!(of("UsdPreviewSurface", &[("clearcoat", "1")]), Some([[0.01; 2], [1.5; 2]]));
    assert_eq!(of("UsdPreviewSurface", &[("clearcoat", "1"), ("ior", "1.8")]), Some([[0.01; 2], [1.8; 2]]));
    for (ior, end) in [("4", 3.0), ("0.5", 2.0)] {
        let coat = of("open_pbr_surface", &[("coat_weight", "1"), ("coat_ior", ior)]);
        assert_eq!(coat, Some([[0.0; 2], [end; 2]]));
    }
    assert_eq!(of("open_pbr_surface", &[("coat_weight", "1"), ("coat_darkening", "0")]), None);
    assert_eq!(of("open_pbr_surface", &[("coat_weight", "1"), ("base_color", "0, 0, 0")]), None);
    assert_eq!(of("open_pbr_surface", &[("coat_roughness", "0.5")]), None);
    assert_eq!(of("open_pbr_surface", &[("coat_weight", "1"), ("base_metalness", "1")]), None);
}

/// What this version lacks is told apart from how a file was read.
#[test]
fn what_a_scene_does_not_hold_is_said() {
    let said = |model: &str, inputs: &[(&str, &str)], about: About, words: &str| {
        let (_, notes) = shader(model, inputs);
        assert!(
            notes.iter().any(|note| note.about == about && note.text.contains(words)),
            "{words}: {notes:?}"
        );
    };
    said(
        "open_pbr_surface",
        &[("coat_weight", "1")],
        About::Missing,
        "darkening of a diffuse base, and neither",
    );
    said("open_pbr_surface", &[("thin_film_weight", "1")], About::Missing, "no film");
    said("open_pbr_surface", &[("subsurface_weight", "1")], About::Missing, "subsurface");
    said("standard_surface", &[("diffuse_roughness", "1")], About::Reading, "EON's");
    said("open_pbr_surface", &[("fuzz_weight", "1")], About::Missing, "Charlie sheen");
    said("standard_surface", &[("specular_anisotropy", "0.5")], About::Reading, "(alpha_x alpha_y)^(1/4)");
    said("standard_surface", &[("specular_anisotropy", "0.97")], About::Missing, "more than 10 times");
    let (materials, notes) = read("<surfacematerial name=\"m\"/>");
    assert!(materials.is_empty() && notes[0].text == "it has no surface shader", "{notes:?}");
    let (_, notes) = read(
        "<disney_principled name=\"s\"/><surfacematerial name=\"m\"><input name=\"surfaceshader\" nodename=\"s\"/></surfacematerial>",
    );
    assert!(
        notes[0].to_string().starts_with("m: its shader is `disney_principled`: this version reads "),
        "{notes:?}"
    );
}

/// An image may hold anything, and so does what a graph computes, which is said.
#[test]
fn connections_are_ranges() {
    let image = "<image name=\"i\"><input name=\"file\" type=\"filename\" value=\"x.png\"/></image>";
    let of = |before: &str, input: &str| {
        read(&format!(
            "{before}<gltf_pbr name=\"m\"><input name=\"metallic\" value=\"0\"/><input name=\"roughness\" {input}/></gltf_pbr>"
        ))
    };
    let (materials, notes) = of(image, "nodename=\"i\"");
    assert!(notes.is_empty() && materials[0].roughness == [0.0, 1.0]);
    let (materials, notes) = of(
        "<gltf_image name=\"i\"><input name=\"file\" value=\"x.png\"/><input name=\"factor\" value=\"0.5\"/></gltf_image>",
        "nodename=\"i\"",
    );
    assert!(notes.is_empty() && materials[0].roughness == [0.0, 0.5], "{materials:?}");
    let (materials, _) = of(
        "<UsdUVTexture name=\"i\"><input name=\"file\" value=\"x.png\"/><input name=\"scale\" value=\"0.5, 0.25, 1, 1\"/><input name=\"bias\" value=\"0, 0.5, 0, 0\"/></UsdUVTexture>",
        "nodename=\"i\" output=\"g\"",
    );
    assert_eq!(materials[0].roughness, [0.5, 0.75]);
    let graph = format!("<nodegraph name=\"g\">{image}<output name=\"o\" nodename=\"i\"/></nodegraph>");
    let (materials, notes) = of(&graph, "nodegraph=\"g\" output=\"o\"");
    assert!(notes.is_empty() && materials[0].roughness == [0.0, 1.0]);
    let separate = format!("{image}<separate3 name=\"s\"><input name=\"in\" nodename=\"i\"/></separate3>");
    let (materials, notes) = of(&separate, "nodename=\"s\" output=\"outy\"");
    assert!(notes.is_empty() && materials[0].roughness == [0.0, 1.0]);
    let (materials, notes) =
        of("<constant name=\"c\"><input name=\"value\" value=\"0.25\"/></constant>", "nodename=\"c\"");
    assert!(notes.is_empty() && materials[0].roughness == [0.25; 2]);
    let (materials, notes) = of("<noise2d name=\"n\"/>", "nodename=\"n\"");
    assert!(notes[0].text.contains("`roughness` is computed by a graph"), "{notes:?}");
    assert_eq!(materials[0].roughness, [0.0, 1.0]);
}

/// Materials name what is drawn; colours have their space.
#[test]
fn documents_have_materials_and_colour_spaces() {
    let (materials, notes) = read(
        "<xi:include xmlns:xi=\"http://www.w3.org/2001/XInclude\" href=\"b.mtlx\"/>\
         <nodegraph name=\"g\"><gltf_pbr name=\"inner\"/><output name=\"o\" nodename=\"inner\"/></nodegraph>\
         <gltf_pbr name=\"unused\"/><gltf_pbr name=\"s\"><input name=\"base_color\" value=\"0.5,0.5,0.5\" colorspace=\"srgb_texture\"/></gltf_pbr>\
         <surfacematerial name=\"first\"><input name=\"surfaceshader\" nodename=\"s\"/></surfacematerial>\
         <surfacematerial name=\"second\"><input name=\"surfaceshader\" nodegraph=\"g\" output=\"o\"/></surfacematerial>",
    );
    let names: Vec<_> = materials.iter().map(|m| m.name.as_str()).collect();
    assert_eq!(names, ["first", "second"]);
    assert!(close(materials[0].f0.expect("f0"), [0.214041140482; 3]), "{:?}", materials[0].f0);
    assert!(
        notes[0].to_string().starts_with("b.mtlx: it is included, and this version opens no other document"),
        "{notes:?}"
    );
    let (_, notes) = shader("gltf_pbr", &[("base_color", "1,1,1")]);
    assert!(notes.is_empty());
    let (_, notes) = read(
        "<gltf_pbr name=\"m\"><input name=\"base_color\" value=\"1,1,1\" colorspace=\"acescg\"/></gltf_pbr>",
    );
    assert!(notes[0].text.contains("colours in `acescg`"), "{notes:?}");
}

/// Materials share a shader, whose children are gone through once.
#[test]
fn shared_shaders_are_read_once() {
    let surface = |i| {
        format!(
            "<surfacematerial name=\"m{i}\"><input name=\"surfaceshader\" nodename=\"s\"/></surfacematerial>"
        )
    };
    let surfaces: String = (0..20_000).map(surface).collect();
    let start = std::time::Instant::now();
    let (materials, _) =
        read(&format!("<gltf_pbr name=\"s\">{}</gltf_pbr>{surfaces}", "<!---->".repeat(900_000)));
    assert_eq!(materials.len(), 20_000);
    assert!(start.elapsed().as_secs() < 15, "{:?}", start.elapsed());
}

/// Glass of an index between those of a scene's glass; what is none keeps its reflection.
#[test]
fn indices_of_refraction_begin_at_one() {
    let glass = "<input name=\"transmission\" value=\"1\"/><input name=\"thickness\" value=\"1\"/><input name=\"metallic\" value=\"0\"/>";
    let of = |before: &str, input: &str| {
        read(&format!("{before}<gltf_pbr name=\"m\">{glass}<input name=\"ior\" {input}/></gltf_pbr>"))
    };
    for (before, input) in [
        ("<noise2d name=\"n\"/>", "nodename=\"n\""),
        ("<image name=\"n\"><input name=\"file\" value=\"x.png\"/></image>", "nodename=\"n\""),
    ] {
        let (materials, notes) = of(before, input);
        assert_eq!((materials[0].kind, materials[0].ior), (Kind::Glass, Some([1.0, 3.0])), "{notes:?}");
        assert!(notes.iter().any(|note| note.text.ends_with("it takes [1, 3]")), "{notes:?}");
    }
    let (materials, notes) = of("", "value=\"3.5\"");
    assert_eq!((materials.len(), materials[0].kind, materials[0].ior), (1, Kind::Dielectric, Some([3.5; 2])));
    assert!(materials[0].base.is_none() && notes[0].text.contains("beyond 3"), "{notes:?}");
    let (materials, notes) = of("", "value=\"2.9\"/><input name=\"dispersion\" value=\"4\"");
    assert_eq!(materials[0].ior, Some([2.71, 3.0]));
    assert!(notes[0].text.contains("are [2.71, 3.09], and glass ends at 1 and 3"), "{notes:?}");
}

/// An index below 1 is that of the other side: Autodesk's velvet has 0 beside a `specular` of 0.
#[test]
fn indices_below_one_have_the_f0_of_their_inverse() {
    for (index, f0) in [("0", 1.0), ("0.5", 1.0 / 9.0)] {
        let (materials, notes) = shader("standard_surface", &[("specular_IOR", index), ("specular", "0.5")]);
        let stated = materials[0].f0.unwrap_or_else(|| panic!("{materials:?}"));
        assert!(close(stated, [0.5 * f0; 3]), "{stated:?}");
        assert!(notes[0].text.contains("`specular_IOR` is below 1"), "{notes:?}");
    }
    let velvet = [("specular_IOR", "0"), ("specular", "0"), ("sheen", "1"), ("sheen_roughness", "0.3")];
    let (materials, _) = shader("standard_surface", &velvet);
    assert!(materials.iter().any(|material| material.sheen.is_some()), "{materials:?}");
}

/// The largest spread is that of the smallest of Abbe's numbers; roughness may be less where light is
/// refracted.
#[test]
fn dispersion_and_roughness_of_transmission() {
    let of = |before: &str, input: &str| {
        read(&format!(
            "{before}<standard_surface name=\"m\"><input name=\"transmission\" value=\"1\"/>{input}</standard_surface>"
        ))
    };
    let graph = "<noise2d name=\"n\"/>";
    let (materials, notes) = of(graph, "<input name=\"transmission_dispersion\" nodename=\"n\"/>");
    assert_eq!(materials[0].ior, Some([1.25, 1.75]));
    assert!(notes.iter().any(|note| note.text.contains("is below 1 somewhere")), "{notes:?}");
    let (materials, _) = of("", "<input name=\"transmission_extra_roughness\" value=\"-0.1\"/>");
    assert_eq!(materials[0].roughness, [0.1; 2]);
    let (materials, _) = of(graph, "<input name=\"transmission_extra_roughness\" nodename=\"n\"/>");
    assert_eq!(materials[0].roughness, [0.0, 1.0]);
}

/// A connected input has no constant, whatever stands beside; a bias that is not there adds nothing.
#[test]
fn factors_of_images_are_constants_or_unknown() {
    let of = |input: &str| {
        read(&format!(
            "<noise2d name=\"n\"/><UsdUVTexture name=\"i\"><input name=\"file\" value=\"x.png\"/><input {input}/></UsdUVTexture>\
             <gltf_pbr name=\"m\"><input name=\"metallic\" value=\"0\"/><input name=\"roughness\" nodename=\"i\" output=\"b\"/></gltf_pbr>"
        ))
    };
    let (materials, notes) = of("name=\"scale\" value=\"0.5\" nodename=\"n\"");
    assert!(materials[0].roughness == [0.0, 1.0] && notes.len() == 1, "{materials:?} {notes:?}");
    let (materials, _) = of("name=\"bias\" value=\"0.5, 0.5\"");
    assert_eq!(materials[0].roughness, [0.0, 1.0]);
}
