//! The Metal Shading Language.

use super::family::{self, Family, Lacks};
use super::printer::Facts;
use super::spelling::plain;
use super::table::Textures;
use super::words::Words;
use crate::Builtin;

/// The printer of MSL.
pub(super) const MSL: Family = Family {
    facts: &FACTS,
    linkage: "inline ",
    qualifier: "",
    number: "float",
    both: "",
    suffix: "f",
    constant: "const ",
    truth: ["bool", "false", "true"],
    vector: "float",
    list: "constant float4 *",
    has_vectors: true,
    strict: false,
    extremes: ["min", "max"],
    rounds_fma: true,
    call,
    lookup: |table| TEXTURES.lookup(&MSL, table),
    shared: |_| String::new(),
};

/// The same in half precision.
pub(super) const HALF: Family = Family { number: "half", suffix: "h", vector: "half", ..MSL };

/// Two evaluations at once in half precision.
pub(super) const PAIR: Family = Family { number: "half2", both: "half2", ..HALF };

const TEXTURES: Textures = Textures {
    resources: &[("table", "texture#d<float>"), ("linear_clamp", "sampler")],
    fetch: "table.sample(linear_clamp, #, level(0.0f))",
    single: "Texels of 32 bits need a device with supports32BitFloatFiltering.",
    norm16: None,
};

const FACTS: Facts = Facts {
    name: "msl",
    title: "MSL",
    extension: "metal",
    comment: "//",
    notes: &[
        "Metal Shading Language. No Metal compiler has read this file: it is checked as C++ about stand-ins for the library.",
        "Fast math, Metal's default, may reorder its sums.",
    ],
    opening: "#pragma once\n#include <metal_stdlib>\nusing namespace metal;\n",
    attributes: "",
    reads_arrays: false,
    words: WORDS,
};

/// What it calls otherwise than [`family::call`].
fn call(builtin: Builtin) -> Result<&'static str, Lacks> {
    match builtin {
        Builtin::Saturate => Ok("saturate"),
        Builtin::Fma => Ok("fma"),
        _ => family::call(builtin),
    }
}

/// The words of C++14, and those of the Metal Shading Language Specification, sections 1.4, 2, 4
/// and 6.
const WORDS: Words = Words {
    reserved: "alignas alignof and and_eq array asm atomic_bool atomic_int atomic_uint auto bfloat bitand bitor bool
        break case catch char char16_t char32_t class compl const const_cast constant constexpr continue decltype default
        delete device do double dynamic_cast else enum explicit export extern false float for fragment friend goto half
        if inline int int8_t int16_t int32_t int64_t kernel level long matrix mesh metal mutable namespace new noexcept
        not not_eq nullptr object object_data operator or or_eq private protected ptrdiff_t public r16snorm ray_data
        register reinterpret_cast restrict return sampler short signed size_t sizeof static static_assert static_cast
        struct switch template texture1d texture2d texture2d_array texture3d texturecube this thread thread_local
        threadgroup threadgroup_imageblock throw true try typedef typeid typename uchar uint uint8_t uint16_t uint32_t
        uint64_t ulong union unsigned ushort using vec vertex virtual visible void volatile wchar_t while xor xor_eq
        INFINITY NAN HUGE_VALF M_E_F M_LOG2E_F M_LOG10E_F M_LN2_F M_LN10_F M_PI_F M_PI_2_F M_PI_4_F M_1_PI_F M_2_PI_F
        M_2_SQRTPI_F M_SQRT2_F M_SQRT1_2_F MAXFLOAT FLT_MAX FLT_MIN FLT_EPSILON main
        abs min max clamp saturate fma sqrt rsqrt exp exp2 log log2 pow floor sign step smoothstep sin cos",
    functions: "acos acosh all any asin asinh atan atan2 atanh ceil copysign cosh cospi cross determinant dfdx dfdy
        distance distance_squared divide dot exp10 fabs faceforward fdim fmax fmax3 fmedian3 fmin fmin3 fmod fract frexp
        fwidth ilogb isfinite isinf isnan isnormal isordered isunordered ldexp length length_squared log10 max3 median3
        min3 mix modf nextafter normalize popcount powr precise fast reflect refract rint round select signbit sincos
        sinh sinpi tan tanh tanpi transpose trunc",
    stems: "float half int uint bool char uchar short ushort long ulong packed_float packed_half simd_float vector_float",
    any_case: false,
    spelled: plain,
};
