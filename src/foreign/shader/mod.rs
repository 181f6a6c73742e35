//! Shader functions as tapes: one per scalar of the result, over the scalars of the arguments.

use super::Spot;
use crate::fit::Tape;

/// The language of a shader.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShaderLanguage {
    /// WebGPU's.
    Wgsl,
    /// OpenGL's and Vulkan's.
    Glsl,
}

/// A function of a shader file.
#[derive(Clone, Debug, PartialEq)]
pub struct ShaderFunction {
    /// File as the caller named it.
    pub file: String,
    /// Its name.
    pub name: String,
    /// Scalars of its arguments, in order: `roughness`, and `f0.x f0.y f0.z` for a vector f0.
    pub inputs: Vec<String>,
    /// One tape per scalar of the result, in order; each takes all inputs and no parameters.
    pub components: Vec<Tape>,
    /// Where it begins.
    pub at: Spot,
}
