//! Ranges of the images of foreign scenes.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use lobefit::scene::{Kind, Material, Scene};
use lobefit_import::{Files, Format, Imported, Textures};
use lobefit_truth::integrate::glass::Side;
use lobefit_truth::optics::Smith;
use lobefit_truth::quantity::{GGX_GLASS, GGX_REFLECTION, Variant};
use serde_json::{Value, json};

use crate::common::{lobefit, stderr};

/// Files by name, and which of them were asked for.
#[derive(Default)]
struct Held {
    files: BTreeMap<&'static str, Vec<u8>>,
    asked: RefCell<Vec<String>>,
}

impl Files for Held {
    fn own(&self, _: u64, _: u64) -> Result<Vec<u8>, String> {
        Err("no file of its own".into())
    }
    fn beside(&self, path: &str, part: Option<[u64; 2]>) -> Result<Vec<u8>, String> {
        self.asked.borrow_mut().push(path.into());
        let bytes = self.files.get(path).cloned().ok_or("it is not there")?;
        Ok(part.map_or(bytes.clone(), |[at, length]| bytes[at as usize..(at + length) as usize].to_vec()))
    }
}

/// An image of these texels.
fn png(size: [u32; 2], colour: png::ColorType, depth: png::BitDepth, texels: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, size[0], size[1]);
    encoder.set_color(colour);
    encoder.set_depth(depth);
    encoder.write_header().and_then(|mut writer| writer.write_image_data(texels)).expect("an image");
    bytes
}

fn rgb(texels: &[[u8; 3]]) -> Vec<u8> {
    png([texels.len() as u32, 1], png::ColorType::Rgb, png::BitDepth::Eight, texels.as_flattened())
}

/// Images of four columns: red 255, 255, 0, 0, and four rows of green 64 to 160; blue 128. Written by
/// libjpeg, the second progressive, and libwebp.
const JPEG: &[u8] = include_bytes!("images/baseline.jpg");
const PROGRESSIVE: &[u8] = include_bytes!("images/progressive.jpg");
const WEBP: &[u8] = include_bytes!("images/lossless.webp");
const LOSSY_WEBP: &[u8] = include_bytes!("images/lossy.webp");

/// The file of one material and its images, one for each texture.
fn gltf(material: Value, images: &[&str]) -> Vec<u8> {
    let (images, textures): (Vec<_>, Vec<_>) =
        images.iter().enumerate().map(|(i, uri)| (json!({ "uri": uri }), json!({ "source": i }))).unzip();
    json!({ "asset": { "version": "2.0" }, "materials": [material], "images": images, "textures": textures })
        .to_string()
        .into_bytes()
}

fn metallic_roughness(factors: Value) -> Value {
    let mut pbr = factors;
    pbr["metallicRoughnessTexture"] = json!({ "index": 0 });
    json!({ "name": "m", "pbrMetallicRoughness": pbr })
}

fn read(format: Format, bytes: &[u8], held: &Held, quantile: f64) -> (Vec<Material>, Vec<String>) {
    let mut textures = Textures::new(held, quantile);
    let read = format.read(bytes, "t", Some(&mut textures)).unwrap_or_else(|e| panic!("{e}"));
    let Imported { json, notes } = read;
    let scene = Scene::from_json(json.as_bytes(), "t").unwrap_or_else(|e| panic!("{e}: {json}"));
    (scene.materials, notes.iter().map(ToString::to_string).collect())
}

fn held(name: &'static str, bytes: Vec<u8>) -> Held {
    Held { files: BTreeMap::from([(name, bytes)]), ..Held::default() }
}

/// The range of the roughness of a dielectric with an image, and what is said.
fn roughness(bytes: Vec<u8>, quantile: f64) -> ([f64; 2], Vec<String>) {
    let file = gltf(metallic_roughness(json!({ "metallicFactor": 0 })), &["a%20b/c.png"]);
    let (materials, notes) = read(Format::Gltf, &file, &held("a b/c.png", bytes), quantile);
    (materials[0].roughness, notes)
}

fn near(found: [f64; 2], expected: [f64; 2], within: f64) {
    let is_near = (found[0] - expected[0]).abs() <= within && (found[1] - expected[1]).abs() <= within;
    assert!(is_near, "{found:?} for {expected:?}");
}

/// Green is roughness, blue is metalness: each kind of material over what the texels hold.
#[test]
fn channels_narrow_their_ranges() {
    let image = rgb(&[[0, 51, 255], [0, 102, 255]]);
    let file = gltf(metallic_roughness(json!({ "roughnessFactor": 0.5 })), &["./x.png"]);
    let (materials, notes) = read(Format::Gltf, &file, &held("x.png", image), 0.0);
    assert_eq!((materials.len(), materials[0].kind, notes.len()), (1, Kind::Metal, 0), "all metal");
    assert_eq!(materials[0].roughness, [0.1, 0.2]);
    let image = rgb(&[[0, 51, 0], [0, 102, 0]]);
    let (materials, _) = read(Format::Gltf, &file, &held("x.png", image), 0.0);
    assert_eq!((materials.len(), materials[0].kind), (1, Kind::Dielectric), "no metal");
}

#[test]
fn formats_and_depths_are_decoded() {
    use png::{BitDepth, ColorType};
    let green = [64.0 / 255.0, 160.0 / 255.0];
    near(roughness(WEBP.to_vec(), 0.0).0, green, 1e-9);
    // What lossy formats keep of them, as libjpeg and libwebp decode it.
    near(roughness(JPEG.to_vec(), 0.0).0, [0.251, 0.6314], 0.01);
    near(roughness(PROGRESSIVE.to_vec(), 0.0).0, [0.251, 0.6314], 0.01);
    near(roughness(LOSSY_WEBP.to_vec(), 0.0).0, [0.2, 0.6745], 0.02);
    let wide = png([1, 2], ColorType::Grayscale, BitDepth::Sixteen, &[0x40, 0x01, 0x80, 0x02]);
    near(roughness(wide, 0.0).0, [16385.0 / 65535.0, 32770.0 / 65535.0], 1e-9);
    let bits = png([2, 1], ColorType::Grayscale, BitDepth::Two, &[0b0110_0000]);
    near(roughness(bits, 0.0).0, [1.0 / 3.0, 2.0 / 3.0], 1e-9);
    let alpha = png([1, 1], ColorType::GrayscaleAlpha, BitDepth::Eight, &[51, 7]);
    near(roughness(alpha, 0.0).0, [0.2; 2], 1e-9);
}

/// One black texel of 4000 widens the range, and a quantile leaves it out and says so.
#[test]
fn quantiles_leave_out_what_they_say() {
    let mut texels = vec![[0, 128, 0]; 4000];
    texels[17] = [0, 0, 0];
    let image = rgb(&texels);
    near(roughness(image.clone(), 0.0).0, [0.0, 128.0 / 255.0], 1e-9);
    let (range, notes) = roughness(image.clone(), 0.001);
    near(range, [128.0 / 255.0; 2], 1e-9);
    assert_eq!(
        notes,
        [
            "m: roughness without 0.1 % of the texels at each end is [0.502, 0.502] of its factor, with them [0, 0.502]: what is \
             promised is void there"
        ]
    );
    assert_eq!(roughness(image, 0.0002).0[0], 0.0, "a share below one texel drops none");
}

/// What is off beyond a quantile's range is said, by the albedo itself, of metal, dielectric and glass.
#[test]
fn a_quantile_says_what_is_off_beyond_it() {
    let mut texels = vec![[0, 128, 255]; 4000];
    texels[17] = [0, 26, 255];
    let metal = metallic_roughness(json!({}));
    let mut glass = metallic_roughness(json!({ "metallicFactor": 0 }));
    glass["extensions"] = json!({
        "KHR_materials_transmission": { "transmissionFactor": 1 }, "KHR_materials_volume": { "thicknessFactor": 1 }
    });
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("x.png"), rgb(&texels)).expect("written");
    let [kept, left] = [128.0, 26.0].map(|x| x / 255.0);
    for (name, material) in [("metal", metal), ("glass", glass)] {
        let file = format!("{name}.gltf");
        std::fs::write(folder.path().join(&file), gltf(material, &["x.png"])).expect("written");
        let arguments = ["plan", &file, "--textures", "--quantile", "0.001"];
        let output = lobefit(folder.path(), &arguments, b"");
        let text = String::from_utf8(output.stdout).expect("text");
        let said =
            text.split("clamped to the range, E is off by up to ").nth(1).unwrap_or_else(|| panic!("{text}"));
        let number = |after: &str| -> f64 {
            let rest = said.split(after).nth(1).expect("a number");
            rest.split([' ', ',', ')'])
                .next()
                .and_then(|x| x.parse().ok())
                .unwrap_or_else(|| panic!("{said}"))
        };
        let error: f64 = said.split(' ').next().and_then(|x| x.parse().ok()).expect("an error");
        let (roughness, mu) = (number("(roughness "), number("n_dot_v "));
        assert!((left..kept).contains(&(roughness + 1e-4)), "{said}");
        let albedo = |roughness: f64| {
            let (smith, alpha) = (Some(Smith::Correlated), roughness * roughness);
            let variant =
                Variant { smith, side: (name == "glass").then_some(Side::Inside), ..Variant::default() };
            match name {
                "metal" => GGX_REFLECTION.at(&variant, &[alpha, mu], 1e-7).expect("in the domain")[0],
                _ => GGX_GLASS.at(&variant, &[alpha, mu, 1.5], 1e-7).expect("in the domain")[2],
            }
        };
        let off = (albedo(roughness) - albedo(kept)).abs();
        assert!((off / error - 1.0).abs() < 0.06 && error > 0.02, "{name}: {off}, {said}");
        let scene = lobefit(folder.path(), &["scene-from", &file, "--textures", "--quantile", "0.001"], b"");
        assert!(stderr(&scene).contains("E is off by up to "), "{}", stderr(&scene));
    }
}

#[test]
fn colours_and_layers_follow_their_channels() {
    let image = rgb(&[[0, 128, 255]]);
    let material = json!({
        "pbrMetallicRoughness": { "metallicFactor": 0, "roughnessFactor": 0.5, "baseColorTexture": { "index": 0 } },
        "extensions": {
            "KHR_materials_anisotropy": { "anisotropyStrength": 0.5, "anisotropyTexture": { "index": 0 } },
            "KHR_materials_sheen": { "sheenColorFactor": [1, 0, 0], "sheenColorTexture": { "index": 0 } },
            "KHR_materials_clearcoat": { "clearcoatFactor": 1, "clearcoatTexture": { "index": 0 } }
        }
    });
    let (materials, notes) = read(Format::Gltf, &gltf(material, &["x.png"]), &held("x.png", image), 0.0);
    let albedo = materials[0].base.as_ref().expect("a base").albedo;
    assert!(albedo[0] == 0.0 && (albedo[1] - 0.21586).abs() < 1e-5 && albedo[2] == 1.0, "{albedo:?}");
    assert_eq!(materials[0].sheen, None, "red is 0 in the image");
    assert!(materials[0].anisotropy[0] > 0.0 && materials[0].anisotropy[0] == materials[0].anisotropy[1]);
    assert!(!notes.iter().any(|note| note.contains("clear coat")), "{notes:?}");
}

/// What is not decoded may hold anything, and is said; nothing else is opened.
#[test]
fn what_is_not_decoded_takes_its_whole_range() {
    let ktx = b"\xabKTX 20\xbb\r\n\x1a\n".to_vec();
    let (range, notes) = roughness(ktx, 0.0);
    assert_eq!(range, [0.0, 1.0]);
    assert!(
        notes[0].contains("an image of KTX2 or Basis, which this version does not decode: it takes [0, 1]"),
        "{notes:?}"
    );
    // 8193 x 8193 texels are more than 64 Mi; nothing of them is there.
    let mut header = png([1, 1], png::ColorType::Grayscale, png::BitDepth::Eight, &[0]);
    header[16..24].copy_from_slice(&[0, 0, 0x20, 1, 0, 0, 0x20, 1]);
    let checksum = crc(&header[12..29]);
    header[29..33].copy_from_slice(&checksum.to_be_bytes());
    let (range, notes) = roughness(header, 0.0);
    assert_eq!(range, [0.0, 1.0]);
    assert!(notes[0].contains("an image of 8193 x 8193 texels, more than 67108864"), "{notes:?}");
    // Textures that scale nothing that a scene holds stay closed, and so do those of a factor of 0.
    let material = json!({
        "pbrMetallicRoughness": { "metallicFactor": 0, "roughnessFactor": 0, "metallicRoughnessTexture": { "index": 0 } },
        "normalTexture": { "index": 0 }, "emissiveTexture": { "index": 0 }
    });
    let files = Held::default();
    read(Format::Gltf, &gltf(material, &["x.png"]), &files, 0.0);
    assert!(files.asked.borrow().is_empty());
}

/// The checksum of a chunk of PNG.
fn crc(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0_u32, |crc, byte| {
        (0..8).fold(
            crc ^ u32::from(*byte),
            |crc, _| if crc & 1 == 1 { 0xedb8_8320 ^ (crc >> 1) } else { crc >> 1 },
        )
    })
}

#[test]
fn images_of_materialx_are_read_too() {
    let image = rgb(&[[128, 51, 255], [128, 102, 255]]);
    let file = b"<materialx fileprefix=\"maps/\"><image name=\"i\"><input name=\"file\" value=\"x.png\"/></image>\
        <separate3 name=\"s\"><input name=\"in\" nodename=\"i\"/></separate3>\
        <image name=\"c\"><input name=\"file\" value=\"x.png\" colorspace=\"srgb_texture\"/></image>\
        <gltf_pbr name=\"m\"><input name=\"metallic\" value=\"0\"/><input name=\"roughness\" nodename=\"s\" output=\"outy\"/>\
        <input name=\"base_color\" nodename=\"c\"/></gltf_pbr></materialx>";
    let files = held("maps/x.png", image);
    let (materials, notes) = read(Format::MaterialX, file, &files, 0.0);
    assert_eq!(materials[0].roughness, [0.2, 0.4]);
    let albedo = materials[0].base.as_ref().expect("a base").albedo;
    assert!((albedo[0] - 0.21586).abs() < 1e-5 && albedo[2] == 1.0, "{albedo:?}");
    assert!(notes.is_empty(), "{notes:?}");
    assert_eq!(files.asked.borrow().len(), 1, "decoded once");
}

/// On the command line: the images of the game lie in its buffer.
#[test]
fn the_game_is_narrower_with_its_images() {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::copy(examples.join("game.glb"), folder.path().join("game.glb")).expect("copied");
    let plan = |arguments: &[&str]| {
        let output = lobefit(folder.path(), arguments, b"");
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        String::from_utf8(output.stdout).expect("text")
    };
    let text = plan(&["plan", "game.glb"]);
    assert!(text.lines().count() < 40, "{text}");
    assert!(text.contains("  because 26 dielectrics with a rough specular lobe want a table and fits: plastic 0, plastic 1 ... window\n"), "{text}");
    assert!(text.contains("roughness 0.01 to 1;"), "{text}");
    let text = plan(&["plan", "game.glb", "--textures"]);
    assert!(text.contains("roughness 0.05 to 0.902;") && !text.contains("metalness between"), "{text}");
    let scene = plan(&["scene-from", "game.glb", "--textures", "--quiet"]);
    assert!(scene.contains(r#""name": "steel 0", "kind": "metal""#), "{scene}");
    std::fs::write(folder.path().join("game.json"), scene).expect("written");
    for (arguments, said) in [
        (
            &["plan", "game.json", "--textures"][..],
            "--textures: .gltf, .glb or .mtlx is called for; game.json is a scene without images",
        ),
        (&["plan", "--textures"], "the built-in scene is a scene without images"),
        (&["plan", "game.glb", "--quantile", "0.1"], "--textures"),
        (
            &["plan", "game.glb", "--textures", "--quantile", "0.5"],
            "a number from 0 to below 0.5 is called for",
        ),
    ] {
        let output = lobefit(folder.path(), arguments, b"");
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(stderr(&output).contains(said), "{}", stderr(&output));
    }
}

/// Images and buffers in the text are decoded once, however many materials share them.
#[test]
fn shared_images_in_the_text_are_decoded_once() {
    let mut bytes = rgb(&[[0, 51, 0]]);
    let length = bytes.len();
    bytes.resize(6 << 20, 0);
    let uri = format!("data:;base64,{}", STANDARD.encode(&bytes));
    let material = json!({ "pbrMetallicRoughness": { "metallicFactor": 0, "metallicRoughnessTexture": { "index": 0 } } });
    let mut file = json!({
        "asset": { "version": "2.0" }, "materials": vec![material; 10_000], "textures": [{ "source": 0 }],
        "images": [{ "uri": uri }]
    });
    for is_view in [false, true] {
        if is_view {
            let uri = file["images"][0]["uri"].take();
            file["images"] = json!([{ "bufferView": 0 }]);
            file["bufferViews"] = json!([{ "buffer": 0, "byteLength": length }]);
            file["buffers"] = json!([{ "uri": uri }]);
        }
        let start = std::time::Instant::now();
        let (materials, _) = read(Format::Gltf, file.to_string().as_bytes(), &Held::default(), 0.0);
        assert!(materials.len() == 10_000 && materials[9999].roughness == [0.2; 2]);
        assert!(start.elapsed().as_secs() < 20, "{:?}", start.elapsed());
    }
}

/// Small files of large images: the fifth of 8192 x 8192 texels is not decoded, though each view of the one
/// buffer has all the bytes behind its image.
#[test]
fn texels_are_counted_against_bytes_that_count_once() {
    const SIDE: u32 = 8192;
    let texels = vec![255; (SIDE / 8 * SIDE) as usize];
    let image = png([SIDE; 2], png::ColorType::Grayscale, png::BitDepth::One, &texels);
    let all = [image.repeat(6), vec![0; 400_000]].concat();
    let view = |i: usize| json!({ "buffer": 0, "byteOffset": i * image.len(), "byteLength": all.len() - i * image.len() });
    let material = |i: usize| json!({ "name": format!("m{i}"), "pbrMetallicRoughness": { "metallicFactor": 0, "metallicRoughnessTexture": { "index": i } } });
    let each = |one: &dyn Fn(usize) -> Value| (0..6).map(one).collect::<Vec<Value>>();
    let file = json!({
        "asset": { "version": "2.0" }, "materials": each(&material), "textures": each(&|i| json!({ "source": i })),
        "images": each(&|i| json!({ "bufferView": i })), "bufferViews": each(&view),
        "buffers": [{ "uri": "b.bin", "byteLength": all.len() }]
    });
    let (materials, notes) =
        read(Format::Gltf, file.to_string().as_bytes(), &held("b.bin", all.clone()), 0.0);
    let ranges: Vec<[f64; 2]> = materials.iter().map(|material| material.roughness).collect();
    assert_eq!(ranges[..4], [[1.0; 2]; 4], "{notes:?}");
    assert_eq!(ranges[5], [0.0, 1.0], "{notes:?}");
    assert!(notes.iter().any(|note| note.contains("beyond the 268435456 texels")), "{notes:?}");
}

/// A frame that a comment holds is none, also behind fill bytes: 6000 x 6000 texels of a progressive JPEG
/// are more than it may take.
#[test]
fn fill_bytes_hide_no_progressive_frame() {
    let mut jpeg = PROGRESSIVE.to_vec();
    let frame = jpeg.windows(2).position(|two| two == [0xff, 0xc2]).expect("a frame");
    let side = 6000_u16.to_be_bytes();
    jpeg[frame + 5..frame + 9].copy_from_slice(&[side, side].concat());
    let mut comment = vec![0xff, 0xff, 0xfe, 0xff, 0xff];
    comment.resize(5 + 65_533, 0);
    // Where the second FF as a kind, with FE FF as its length, leads to.
    comment[2 + 0xfeff..][..4].copy_from_slice(&[0xff, 0xc0, 0, 4]);
    let (range, notes) = roughness([&jpeg[..2], &comment, &jpeg[2..]].concat(), 0.0);
    assert_eq!(range, [0.0, 1.0]);
    assert!(notes[0].contains("6000 x 6000 texels that takes more than 268435456 bytes"), "{notes:?}");
}

/// Of a colour each channel that the quantile narrows is said, and of an unknown one the range that is taken.
#[test]
fn notes_name_their_channels_and_ranges() {
    let mut texels = vec![[51, 51, 51]; 1000];
    texels[3] = [51, 255, 51];
    let material = json!({
        "pbrMetallicRoughness": { "metallicFactor": 0, "baseColorTexture": { "index": 0 } },
        "extensions": { "KHR_materials_clearcoat": { "clearcoatFactor": 0.5, "clearcoatTexture": { "index": 1 } } }
    });
    let file = gltf(material, &["x.png", "y.ktx2"]);
    let mut files = held("x.png", rgb(&texels));
    files.files.insert("y.ktx2", b"\xabKTX 20\xbb\r\n\x1a\n".to_vec());
    let (_, notes) = read(Format::Gltf, &file, &files, 0.002);
    assert!(notes.iter().any(|note| note.contains("green of its colour without 0.2 %")), "{notes:?}");
    assert!(!notes.iter().any(|note| note.contains("red of its colour")), "{notes:?}");
    let coat = |note: &String| {
        note.contains("clear coat has an image of KTX2") && note.ends_with("it takes [0, 0.5]")
    };
    assert!(notes.iter().any(coat), "{notes:?}");
    let file = b"<materialx><image name=\"c\"><input name=\"file\" value=\"x.png\"/></image>\
        <gltf_pbr name=\"m\"><input name=\"base_color\" nodename=\"c\"/></gltf_pbr></materialx>";
    let (_, notes) = read(Format::MaterialX, file, &files, 0.002);
    assert!(notes.len() == 1 && notes[0].contains("green of `base_color` without"), "{notes:?}");
}
