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
    /// NumPy array.
    Npy,
    /// Little-endian f32 without a header, x fastest.
    Raw,
}

impl Container {
    /// The word used in scenes, which is the files' extension too.
    pub fn name(self) -> &'static str {
        match self {
            Container::Exr => "exr",
            Container::Dds => "dds",
            Container::Npy => "npy",
            Container::Raw => "raw",
        }
    }
}
