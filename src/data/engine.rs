//! The engines that read a pair of tables of area lights from one file.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// An engine, by the file that it reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Engine {
    /// Babylon.js (`areaLightsLTC.bin`): halves without a header, of each texel the four of the matrix, then
    /// the four of the light.
    Babylon,
    /// Bevy (`ltc.ktx2`): a KTX 2 texture of halves, two layers.
    Bevy,
    /// three.js: a module with the arrays of `RectAreaLightTexturesLib`.
    Three,
}

impl Engine {
    /// All of them, in the order in which a scene's list is kept.
    pub const ALL: [Engine; 3] = [Engine::Babylon, Engine::Bevy, Engine::Three];

    /// The word used in scenes.
    pub fn name(self) -> &'static str {
        match self {
            Engine::Babylon => "babylon",
            Engine::Bevy => "bevy",
            Engine::Three => "three",
        }
    }

    /// What its file is named after.
    pub fn extension(self) -> &'static str {
        match self {
            Engine::Babylon => "babylon.bin",
            Engine::Bevy => "bevy.ktx2",
            Engine::Three => "three.js",
        }
    }
}
