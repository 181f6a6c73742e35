//! GLSL 3.30, GLSL ES 3.00 and later.

use super::family::{self, Family, Lacks};
use super::printer::Facts;
use super::spelling::plain;
use super::table::Textures;
use super::words::Words;
use crate::Builtin;

/// The printer of GLSL.
pub(super) const GLSL: Family = Family {
    facts: &FACTS,
    linkage: "",
    qualifier: "",
    number: "float",
    both: "",
    suffix: "",
    // a `const` had a constant for its value before GLSL 4.20
    constant: "",
    truth: ["bool", "false", "true"],
    vector: "vec",
    list: "vec4",
    has_vectors: true,
    strict: false,
    extremes: ["min", "max"],
    // `x * y + z`, as older versions have no `fma`, may round once or twice
    rounds_fma: false,
    call,
    lookup: |table| TEXTURES.lookup(&GLSL, table),
    shared: |_| String::new(),
};

/// The same in half precision. Literals have no precision of their own.
pub(super) const HALF: Family = Family { qualifier: "mediump ", ..GLSL };

/// Two evaluations at once in half precision.
pub(super) const PAIR: Family = Family { number: "vec2", both: "vec2", ..HALF };

/// The table holds its sampler.
const TEXTURES: Textures = Textures {
    resources: &[("table", "sampler#D")],
    fetch: "textureLod(table, #, 0.0)",
    single: "Texels of 32 bits need, in OpenGL ES, the extension OES_texture_float_linear.",
    norm16: Some("Texels of 16-bit integers need, in OpenGL ES, the extension EXT_texture_norm16."),
};

const FACTS: Facts = Facts {
    name: "glsl",
    title: "GLSL",
    extension: "glsl",
    comment: "//",
    notes: &[
        "GLSL 3.30, GLSL ES 3.00 or later. GLSL ES needs, before this file: `precision highp float; precision highp sampler2D;`, and",
        "`precision highp sampler3D;` for a volume.",
    ],
    opening: "",
    attributes: "",
    reads_arrays: false,
    words: WORDS,
};

/// What it calls otherwise than [`family::call`].
fn call(builtin: Builtin) -> Result<&'static str, Lacks> {
    match builtin {
        Builtin::Mix => Ok("mix"),
        Builtin::InverseSqrt => Ok("inversesqrt"),
        _ => family::call(builtin),
    }
}

/// The OpenGL Shading Language 4.60, sections 3.6 and 8, and the GLSL ES 3.20 specification.
const WORDS: Words = Words {
    reserved: "active asm atomic_uint attribute bool break buffer case cast centroid class coherent common const continue
        default discard do double else enum extern external false filter fixed flat float for fvec2 fvec3 fvec4 goto
        half highp hvec2 hvec3 hvec4 if in inline inout input int interface invariant isampler1D isampler2D isampler3D
        isamplerCube layout long lowp mediump namespace noinline noperspective out output packed partition patch precise
        precision public readonly resource restrict return sample sampler sampler1D sampler1DArray sampler1DArrayShadow
        sampler1DShadow sampler2D sampler2DArray sampler2DArrayShadow sampler2DMS sampler2DRect sampler2DRectShadow
        sampler2DShadow sampler3D sampler3DRect samplerBuffer samplerCube samplerCubeArray samplerCubeShadow shared short
        sizeof smooth static struct subpassInput subroutine superp switch template texture1D texture2D texture3D
        textureCube this true typedef uint uniform union unsigned using usampler1D usampler2D usampler3D usamplerCube
        varying void volatile while writeonly image1D image2D image3D imageCube imageBuffer main
        abs min max clamp mix sqrt inversesqrt exp exp2 log log2 pow floor sign step smoothstep sin cos",
    functions: "acos acosh all any asin asinh atan atanh barrier bitCount bitfieldExtract bitfieldInsert
        bitfieldReverse ceil cosh cross dFdx dFdxCoarse dFdxFine dFdy dFdyCoarse dFdyFine degrees determinant distance
        dot equal faceforward findLSB findMSB floatBitsToInt floatBitsToUint fma fract frexp ftransform fwidth
        greaterThan intBitsToFloat inverse isinf isnan ldexp length lessThan matrixCompMult mod modf noise1 noise2 noise3
        noise4 normalize not notEqual outerProduct radians reflect refract round roundEven sinh tan tanh texelFetch
        texture textureGrad textureLod textureOffset textureProj textureSize transpose trunc uintBitsToFloat
        uaddCarry usubBorrow shadow1D shadow2D texture1DLod texture2DLod texture3DLod textureGather",
    stems: "vec ivec uvec bvec dvec mat dmat",
    any_case: false,
    spelled: plain,
};
