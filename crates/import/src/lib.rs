//! Foreign files of materials as scenes: the JSON that one would write by hand, and notes on what a file
//! says that the scene does not hold; and the triangles of a glTF file ([`mesh()`]). Nothing here opens a
//! file; images come through [`Files`].

mod gltf;
pub mod limits;
mod mtlx;
mod note;
mod scene;
mod surface;
mod texture;

use lobefit_strict::SceneError;

pub use gltf::mesh::{Mesh, mesh};
pub use note::{About, Note};
pub use texture::{Files, Textures};

/// A scene that a foreign file was read as.
#[derive(Clone, Debug, PartialEq)]
pub struct Imported {
    /// Its JSON.
    pub json: String,
    /// What that leaves out, and how it was read.
    pub notes: Vec<Note>,
}

/// A format of foreign files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// glTF 2.0: `.gltf`, `.glb`.
    Gltf,
    /// MaterialX: `.mtlx`.
    MaterialX,
    /// Universal Scene Description, which is not read.
    Usd,
}

/// Most bytes of a file that [`Format::read`] looks at.
pub const BYTES: u64 = gltf::BYTES;

/// The endings of the formats, for messages.
pub const ENDINGS: &str = ".gltf, .glb or .mtlx";

impl Format {
    /// The format of a file by its name, or by its first bytes; none of one that is not foreign.
    pub fn of(bytes: &[u8], file: &str) -> Option<Format> {
        let lower = file.to_ascii_lowercase();
        let ends = |endings: &[&str]| endings.iter().any(|ending| lower.ends_with(ending));
        if bytes.starts_with(gltf::MAGIC) || ends(&[".gltf", ".glb"]) {
            Some(Format::Gltf)
        } else if ends(&[".usd", ".usda", ".usdc", ".usdz"])
            || bytes.starts_with(b"#usda")
            || bytes.starts_with(b"PXR-USDC")
        {
            Some(Format::Usd)
        } else if ends(&[".mtlx"]) || mtlx::is_document(bytes) {
            Some(Format::MaterialX)
        } else {
            None
        }
    }

    /// How names of its files end, by the first bytes of one.
    pub fn ending(self, bytes: &[u8]) -> &'static str {
        match self {
            Format::Gltf if bytes.starts_with(gltf::MAGIC) => "glb",
            Format::Gltf => "gltf",
            Format::MaterialX => "mtlx",
            Format::Usd => "usd",
        }
    }

    /// The scene of a file, of which at least the first [`BYTES`] are given; without `textures` each
    /// texture may hold anything.
    ///
    /// # Errors
    /// What is no file of the format, with file, place and field; images that cannot be read.
    pub fn read(
        self,
        bytes: &[u8],
        file: &str,
        textures: Option<&mut Textures>,
    ) -> Result<Imported, SceneError> {
        match self {
            Format::Gltf => gltf::read(bytes, file, textures),
            Format::MaterialX => mtlx::read(bytes, file, textures),
            Format::Usd => Err(SceneError::Whole {
                file: file.into(),
                path: String::new(),
                message: "USD is not read in this version; export the materials as MaterialX (.mtlx) or glTF (.glb)".into(),
            }),
        }
    }
}
