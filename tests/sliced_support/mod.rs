//! What the tests of baked tables of three axes share: small scenes, and a reader of their files
//! that knows nothing of the program but its manifest and its EXR decoder.
#![allow(dead_code, reason = "each test binary uses its part")]

use std::collections::BTreeMap;
use std::sync::OnceLock;

use crate::baked_support::bake_scene;
use lobefit::bake::Baked;
use lobefit::data::Smith;
use lobefit::emit::exr;
use lobefit::scene::Scene;
use lobefit::store::Files;
use lobefit_truth::integrate::aniso::aniso;
use lobefit_truth::integrate::glass::{Side, glass};
use serde_json::Value;

/// Every effect in little time: narrow ranges, few texels. `{more}` stands for further fields.
const SMALL: &str = r#"{"schema_version":1,"name":"small",{more}"materials":[
{"name":"plain","kind":"metal","f0":1,"roughness":[0.4,0.6],"wants":{"tables":[{"size":[4,4],"layout":"plain"}]}},
{"name":"brushed","kind":"metal","f0":0.9,"roughness":[0.5,0.8],"anisotropy":[0.3,0.7],"wants":{"tables":[
 {"layout":"optimised","size":[16,16,8],"format":"f32"},{"layout":"azimuth","size":[12,8,6],"format":"f32"}]}},
{"name":"frosted","kind":"glass","ior":[1.3,1.7],"roughness":[0.5,0.8],"wants":{"tables":[
 {"layout":"optimised","size":[16,16,8],"format":"f32"}]}}]}"#;

/// The small scene with further fields, each followed by a comma.
pub fn small(more: &str) -> String {
    SMALL.replace("{more}", more)
}

/// The tables of the small scene.
pub const ANISO: &str = "ggx-aniso-correlated-16x16x8-f32";
pub const AZIMUTH: &str = "ggx-aniso-azimuth-correlated-12x8x6-f32";
pub const GLASS: [(&str, Side); 2] = [
    ("ggx-glass-outside-correlated-16x16x8-f32", Side::Outside),
    ("ggx-glass-inside-correlated-16x16x8-f32", Side::Inside),
];

/// Bakes a scene.
pub fn baked(scene: &str) -> Baked {
    let scene = Scene::from_json(scene.as_bytes(), "test.json").expect("a scene");
    bake_scene(&scene).expect("a bake")
}

/// The bake of the small scene, once per test binary.
pub fn small_baked() -> &'static Baked {
    static BAKED: OnceLock<Baked> = OnceLock::new();
    BAKED.get_or_init(|| baked(&small("")))
}

/// The manifest among files.
pub fn manifest(files: &Files) -> Value {
    serde_json::from_slice(&files["manifest.json"]).expect("JSON")
}

/// The entry of a table in a manifest.
pub fn entry<'a>(manifest: &'a Value, name: &str) -> &'a Value {
    let tables = manifest["tables"].as_array().expect("tables[]");
    tables.iter().find(|t| t["name"] == name).unwrap_or_else(|| panic!("no table {name}"))
}

/// A table as its file and its manifest tell it.
pub struct Read {
    /// Entry of the manifest.
    pub entry: Value,
    /// Columns, rows, slices.
    pub size: [usize; 3],
    /// Texels by channel, columns fastest, then rows, then slices.
    pub texels: BTreeMap<String, Vec<f64>>,
}

impl Read {
    /// Reads the EXR file of a table: slices lie one below the other.
    pub fn of(files: &Files, name: &str) -> Read {
        let entry = entry(&manifest(files), name).clone();
        let size = [0, 1, 2].map(|k| entry["axes"][k]["size"].as_u64().expect("a size") as usize);
        let image = exr::decode(&files[entry["file"].as_str().expect("a file")]).expect("an image");
        assert_eq!((image.width, image.height), (size[0], size[1] * size[2]));
        let texels: BTreeMap<String, Vec<f64>> =
            image.channels.into_iter().map(|c| (c.name, c.texels)).collect();
        let channels: Vec<&Value> = entry["channels"].as_array().expect("channels[]").iter().collect();
        assert_eq!(texels.keys().collect::<Vec<_>>(), channels);
        Read { entry, size, texels }
    }

    /// A texel of a channel.
    pub fn texel(&self, channel: &str, [x, y, z]: [usize; 3]) -> f64 {
        self.texels[channel][(z * self.size[1] + y) * self.size[0] + x]
    }

    /// Formula of an axis.
    pub fn warp(&self, axis: usize) -> &str {
        assert_eq!(self.entry["axes"][axis]["registration"], "endpoint");
        self.entry["axes"][axis]["warp"].as_str().expect("a warp")
    }

    /// Ends of an axis.
    pub fn range(&self, axis: usize) -> [f64; 2] {
        ["min", "max"].map(|end| self.entry["axes"][axis][end].as_f64().expect("a number"))
    }

    /// What the manifest promises of the lookup.
    pub fn promise(&self) -> f64 {
        self.entry["error"]["lookup"]["max"].as_f64().expect("an error")
    }

    /// Trilinear interpolation between end points, in f64, at unit coordinates.
    pub fn at(&self, channel: &str, u: [f64; 3]) -> f64 {
        let cells: [(usize, f64); 3] = std::array::from_fn(|k| {
            let last = self.size[k] - 1;
            let x = u[k].clamp(0.0, 1.0) * last as f64;
            let base = (x as usize).min(last - 1);
            (base, x - base as f64)
        });
        let mut sum = 0.0;
        for corner in 0..8 {
            let (mut weight, mut at) = (1.0, [0; 3]);
            for (k, (base, fraction)) in cells.into_iter().enumerate() {
                let far = corner >> k & 1;
                at[k] = base + far;
                weight *= if far == 1 { fraction } else { 1.0 - fraction };
            }
            sum += weight * self.texel(channel, at);
        }
        sum
    }
}

/// Points of the unit cube in four dimensions, spread by the additive recurrence of the generalised
/// golden ratio (Roberts 2018).
pub fn spread(count: u32) -> impl Iterator<Item = [f64; 4]> {
    let steps =
        [0.856_674_883_854_502_9, 0.733_891_856_627_126, 0.628_706_721_037_797_7, 0.538_597_255_724_5];
    (1..=count).map(move |i| steps.map(|step: f64| (0.5 + f64::from(i) * step).fract()))
}

/// A number between the ends of a range.
pub fn lerp([low, high]: [f64; 2], t: f64) -> f64 {
    low + (high - low) * t
}

/// alpha_y/alpha = alpha/alpha_x of an anisotropy (Burley 2012).
pub fn aspect(anisotropy: f64) -> f64 {
    (1.0 - 0.9 * anisotropy).sqrt()
}

/// The truth of the anisotropic lobe, within 1e-8.
pub fn true_aniso(smith: Smith, alpha: [f64; 2], mu: f64, phi: Option<f64>) -> f64 {
    aniso(smith, alpha, mu, phi, 1e-8).expect("a truth").e
}

/// The truth of glass, within 1e-8.
pub fn true_glass(smith: Smith, [alpha, mu, ior]: [f64; 3], side: Side) -> f64 {
    glass(smith, alpha, mu, ior, side, 1e-8).expect("a truth").e
}
