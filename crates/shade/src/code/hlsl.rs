//! HLSL, shader model 5 and later.

use super::family::{self, Family, Lacks};
use super::printer::Facts;
use super::spelling::plain;
use super::table::Textures;
use super::words::Words;
use crate::Builtin;

/// The printer of HLSL.
pub(super) const HLSL: Family = Family {
    facts: &FACTS,
    linkage: "",
    qualifier: "",
    number: "float",
    both: "",
    suffix: "f",
    constant: "const ",
    truth: ["bool", "false", "true"],
    vector: "float",
    list: "float4",
    has_vectors: true,
    strict: false,
    extremes: ["min", "max"],
    // `mad` may round once or twice
    rounds_fma: false,
    call,
    lookup: |table| TEXTURES.lookup(&HLSL, table),
    shared: |_| String::new(),
};

/// The same in half precision. A literal has no suffix: the type of what it stands beside is its
/// own.
pub(super) const HALF: Family = Family { number: "min16float", suffix: "", vector: "min16float", ..HLSL };

/// Two evaluations at once in half precision. A literal beside a vector is each of its components.
pub(super) const PAIR: Family = Family { number: "min16float2", ..HALF };

const TEXTURES: Textures = Textures {
    resources: &[("table", "Texture#D<float4>"), ("linear_clamp", "SamplerState")],
    fetch: "table.SampleLevel(linear_clamp, #, 0.0f)",
    single: "Texels of 32 bits need a device that filters them, which Direct3D leaves open.",
    norm16: None,
};

const FACTS: Facts = Facts {
    name: "hlsl",
    title: "HLSL",
    extension: "hlsl",
    comment: "//",
    notes: &["HLSL of shader model 5 or later."],
    opening: "#pragma once\n",
    attributes: "",
    reads_arrays: false,
    words: WORDS,
};

/// What it calls otherwise than [`family::call`].
fn call(builtin: Builtin) -> Result<&'static str, Lacks> {
    match builtin {
        Builtin::Saturate => Ok("saturate"),
        Builtin::Fma => Ok("mad"),
        Builtin::Sign => Err(Lacks::FloatOfSign),
        _ => family::call(builtin),
    }
}

/// HLSL reference, "Keywords", "Reserved Words" and "Intrinsic Functions".
const WORDS: Words = Words {
    reserved: "AppendStructuredBuffer asm asm_fragment auto BlendState bool break Buffer ByteAddressBuffer case catch
        cbuffer centroid char class column_major compile compile_fragment CompileShader ComputeShader const const_cast
        ConsumeStructuredBuffer continue default delete DepthStencilState DepthStencilView discard do DomainShader
        double dword dynamic_cast else enum explicit export extern false float for friend fxgroup GeometryShader
        globallycoherent goto groupshared half HullShader if in inline inout InputPatch int int16_t int32_t int64_t
        interface line lineadj linear LineStream long matrix min10float min12int min16float min16int min16uint mutable
        namespace new nointerpolation noperspective NULL operator out OutputPatch packoffset pass payload pixelfragment
        PixelShader point PointStream precise private protected public RasterizerState RayDesc RayQuery register
        reinterpret_cast RenderTargetView return row_major RWBuffer RWByteAddressBuffer RWStructuredBuffer RWTexture1D
        RWTexture1DArray RWTexture2D RWTexture2DArray RWTexture3D sample sampler sampler1D sampler2D sampler3D
        samplerCUBE sampler_state SamplerComparisonState SamplerState shared short signed sizeof snorm stateblock
        stateblock_state static static_cast string struct StructuredBuffer switch tbuffer technique technique10
        technique11 template texture Texture1D Texture1DArray Texture2D Texture2DArray Texture2DMS Texture2DMSArray
        Texture3D TextureCube TextureCubeArray this throw triangle triangleadj TriangleStream true try typedef typename
        uint uint16_t uint32_t uint64_t uniform union unorm unsigned using vector vertexfragment VertexShader virtual
        void volatile while float16_t float32_t float64_t main
        abs min max clamp saturate mad sqrt rsqrt exp exp2 log log2 pow floor sign step smoothstep sin cos",
    functions: "abort acos all any asdouble asfloat asin asint asuint atan atan2 ceil clip cosh countbits cross ddx
        ddx_coarse ddx_fine ddy ddy_coarse ddy_fine degrees determinant distance dot dst errorf f16tof32 f32tof16
        faceforward firstbithigh firstbitlow fma fmod frac frexp fwidth isfinite isinf isnan ldexp length lerp lit log10
        modf msad4 mul noise normalize printf radians rcp reflect refract reversebits round select sincos sinh tan tanh
        tex1D tex2D tex3D texCUBE transpose trunc and or",
    stems: "float half double int uint bool dword min16float min10float min16int min12int min16uint int16_t int32_t
        int64_t uint16_t uint32_t uint64_t float16_t float32_t float64_t",
    any_case: true,
    spelled: plain,
};
