//! The file formats of tables.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A file format. All hold the same quantised texels.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "lowercase")]
pub enum Container {
    /// OpenEXR image; slices lie one below the other.
    #[default]
    Exr,
    /// DirectDraw surface: a 2-D or 3-D texture as graphics interfaces take it.
    Dds,
    /// Khronos texture, version 2: 2-D or 3-D, as graphics interfaces take it.
    Ktx2,
    /// NumPy array.
    Npy,
    /// Little-endian f32 without a header, x fastest.
    Raw,
}

impl Container {
    /// All formats, in the order in which a scene's list is kept.
    pub const ALL: [Container; 5] =
        [Container::Exr, Container::Dds, Container::Ktx2, Container::Npy, Container::Raw];

    /// The word used in scenes, which is the files' extension too.
    pub fn name(self) -> &'static str {
        match self {
            Container::Exr => "exr",
            Container::Dds => "dds",
            Container::Ktx2 => "ktx2",
            Container::Npy => "npy",
            Container::Raw => "raw",
        }
    }
}
