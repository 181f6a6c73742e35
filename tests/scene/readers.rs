//! Every reader of a file that others write, as one call on its bytes: `hostile.rs` gives them mutations, and
//! `fuzz/reader.rs` what coverage finds.

use lobefit::cli::options::quantity_of;
use lobefit::cli::points::Points;
use lobefit::plan::plan;
use lobefit::scene::{Scene, SceneError, kernel};
use lobefit_import::{Files, Format, Textures};
use lobefit_shade::Hypothesis;
use lobefit_truth::optics::kernel::Kernel;

/// A reader: its name, what it does with bytes, whether it takes them, and files that it takes.
pub struct Reader {
    /// Its name.
    pub name: &'static str,
    /// Reads bytes: whether they are a file of the kind.
    pub read: fn(&[u8]) -> bool,
    /// Files of the kind, relative to the repository.
    #[allow(dead_code, reason = "a fuzzer is given them by name")]
    pub seeds: &'static [&'static str],
}

/// All of them.
pub const READERS: [Reader; 7] = [
    Reader {
        name: "scene",
        read: |bytes| {
            let kernels = |_: &str, _| Ok::<_, SceneError>(Kernel::default());
            Scene::with_kernels(bytes, "scene.json", kernels).map(|scene| plan(&scene)).is_ok()
        },
        seeds: &[
            "examples/every-formula.json",
            "examples/coats.json",
            "examples/culling.json",
            "tests/bake/all_in_little.json",
        ],
    },
    Reader {
        name: "gltf",
        read: |bytes| foreign(Format::Gltf, bytes),
        seeds: &[
            "examples/gltf/painted.glb",
            "examples/gltf/metal.glb",
            "examples/gltf/glass.glb",
            "examples/gltf/brushed.glb",
            "examples/gltf/cloth.glb",
        ],
    },
    Reader {
        name: "materialx",
        read: |bytes| foreign(Format::MaterialX, bytes),
        seeds: &["examples/surfaces.mtlx"],
    },
    Reader {
        name: "image",
        read: |bytes| {
            let files = Image(bytes);
            Format::Gltf.read(TEXTURED, "image.gltf", Some(&mut Textures::new(&files, 0.0))).is_ok()
        },
        seeds: &[
            "tests/scene/images/grey.png",
            "tests/scene/images/baseline.jpg",
            "tests/scene/images/progressive.jpg",
            "tests/scene/images/lossless.webp",
            "tests/scene/images/lossy.webp",
        ],
    },
    Reader {
        name: "shader",
        read: |bytes| {
            let parsed = std::str::from_utf8(bytes).map(|text| Hypothesis::parse("shader.wgsl", text));
            parsed.is_ok_and(|parsed| parsed.is_ok())
        },
        seeds: &["examples/own-hypothesis.wgsl"],
    },
    Reader {
        name: "kernel",
        read: |bytes| kernel(bytes, "kernel.json").is_ok(),
        seeds: &["examples/kernels/phong.json"],
    },
    Reader {
        name: "points",
        read: |bytes| {
            let glass = quantity_of("ggx-glass").expect("a quantity");
            Points::parse(bytes.to_vec(), "points.csv", glass).is_ok()
        },
        seeds: &["tests/scene/points.csv"],
    },
];

/// A file of one material, whose roughness has the image.
const TEXTURED: &[u8] = br#"{"asset":{"version":"2.0"},"materials":[{"pbrMetallicRoughness":
    {"metallicRoughnessTexture":{"index":0}}}],"textures":[{"source":0}],"images":[{"uri":"image"}]}"#;

/// The image beside the file.
struct Image<'a>(&'a [u8]);

impl Files for Image<'_> {
    fn own(&self, _: u64, _: u64) -> Result<Vec<u8>, String> {
        Err("no file of its own".into())
    }
    fn beside(&self, _: &str, _: Option<[u64; 2]>) -> Result<Vec<u8>, String> {
        Ok(self.0.to_vec())
    }
}

/// Reads a foreign file: what it is read as is a scene.
fn foreign(format: Format, bytes: &[u8]) -> bool {
    let Ok(read) = format.read(bytes, "foreign", None) else { return false };
    Scene::from_json(read.json.as_bytes(), "m").unwrap_or_else(|error| panic!("{error}: {}", read.json));
    true
}
