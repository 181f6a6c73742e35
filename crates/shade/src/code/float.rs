//! The floating-point type of printed code.

/// The type of a formula's numbers in printed code. Rust and C have no f16 that every compiler
/// reads: their functions stay f32.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Float {
    /// 32 bits.
    #[default]
    F32,
    /// 16 bits, or more where the language lets a compiler keep more: `f16` in WGSL, `half` in MSL,
    /// `min16float` in HLSL, `mediump float` in GLSL.
    F16,
}

impl Float {
    /// Both.
    pub const ALL: [Float; 2] = [Float::F32, Float::F16];

    /// The word used in scenes: `f32`, `f16`.
    pub fn name(self) -> &'static str {
        match self {
            Float::F32 => "f32",
            Float::F16 => "f16",
        }
    }
}
