//! Words that languages have taken, as far as a WGSL identifier can be one.

use super::Language;
use super::names::{ascii, plain};

/// The words of a language.
pub(super) struct Words {
    pub language: Language,
    /// Keywords, reserved words, types, macros, and the functions that printed code calls: nothing may be named so.
    reserved: &'static str,
    /// Functions of the language: a variable may be named so, a function may not.
    functions: &'static str,
    /// Stems of the vector and matrix types: with a digit or two they are types.
    stems: &'static str,
    /// Whether words are taken in capitals too.
    any_case: bool,
}

impl Words {
    pub fn of(language: Language) -> &'static Words {
        match language {
            Language::Rust => &RUST,
            Language::Wgsl => &WGSL,
            Language::Hlsl => &HLSL,
            Language::Glsl => &GLSL,
            Language::Msl => &MSL,
            Language::C => &C,
        }
    }

    /// Whether no variable may be named so.
    pub fn takes(&self, name: &str) -> bool {
        let lower = if self.any_case { name.to_ascii_lowercase() } else { name.to_string() };
        let same = |word: &str| if self.any_case { word.eq_ignore_ascii_case(name) } else { word == name };
        self.reserved.split_whitespace().any(same) || self.is_type(&lower)
    }

    /// Whether no function may be named so.
    pub fn takes_function(&self, name: &str) -> bool {
        self.takes(name) || self.functions.split_whitespace().any(|word| word == name)
    }

    /// A name as the language can have it. Those of C's family keep names with two underscores in a row, or one before a capital,
    /// for themselves, and GLSL those with `gl_` before; rustc warns of letters that look like others.
    pub fn spelled(&self, name: &str) -> String {
        match self.language {
            Language::Wgsl => name.to_string(),
            Language::Rust => ascii(name),
            _ => plain(&ascii(name)),
        }
    }

    /// float3, mat2x4: a stem, and one digit or two about an x.
    fn is_type(&self, name: &str) -> bool {
        let size = |s: &str| s.len() == 1 && ("1"..="4").contains(&s);
        let sized = |rest: &str| size(rest) || rest.split_once('x').is_some_and(|(a, b)| size(a) && size(b));
        self.stems.split_whitespace().any(|stem| name.strip_prefix(stem).is_some_and(sized))
    }
}

/// All editions (The Rust Reference, "Keywords").
const RUST: Words = Words {
    language: Language::Rust,
    reserved: "abstract as async await become box do dyn extern f32 final gen impl in loop macro match mod move mut
        override priv pub ref static super trait try type typeof union unsafe unsized use virtual where yield crate self
        Self main",
    functions: "",
    stems: "",
    any_case: false,
};

/// Built-ins that printed code may call, and so must not be shadowed. WGSL's own words cannot stand in a hypothesis.
const WGSL: Words = Words {
    language: Language::Wgsl,
    reserved:
        "abs min max clamp saturate mix fma sqrt inverseSqrt exp exp2 log log2 pow floor sign step smoothstep
        sin cos select",
    functions: "",
    stems: "",
    any_case: false,
};

/// HLSL reference, "Keywords", "Reserved Words" and "Intrinsic Functions".
const HLSL: Words = Words {
    language: Language::Hlsl,
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
};

/// The OpenGL Shading Language 4.60, sections 3.6 and 8, and the GLSL ES 3.20 specification.
const GLSL: Words = Words {
    language: Language::Glsl,
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
};

/// The words of C++14, and those of the Metal Shading Language Specification, sections 1.4, 2, 4 and 6.
const MSL: Words = Words {
    language: Language::Msl,
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
};

/// The words of C99 and of C++20, the macros of `<math.h>` and of common platforms; the functions of `<math.h>`.
const C: Words = Words {
    language: Language::C,
    reserved: "alignas alignof and and_eq asm auto bitand bitor bool break case catch char char8_t char16_t char32_t
        class compl concept const consteval constexpr constinit const_cast continue co_await co_return co_yield decltype
        default delete do double dynamic_cast else enum explicit export extern false far float for fortran friend goto
        huge if inline int linux long mutable namespace near new noexcept not not_eq nullptr operator or or_eq pascal
        private protected public register reinterpret_cast requires restrict return short signed sizeof static
        static_assert static_cast struct switch template this thread_local throw true try typedef typeid typename typeof
        union unix unsigned using virtual void volatile wchar_t while xor xor_eq
        NAN INFINITY NULL HUGE HUGE_VAL HUGE_VALF HUGE_VALL MAXFLOAT FP_NAN FP_INFINITE FP_ZERO FP_SUBNORMAL FP_NORMAL
        FP_ILOGB0 FP_ILOGBNAN FP_FAST_FMA FP_FAST_FMAF MATH_ERRNO MATH_ERREXCEPT math_errhandling DOMAIN SING OVERFLOW
        UNDERFLOW PLOSS TLOSS M_E M_LOG2E M_LOG10E M_LN2 M_LN10 M_PI M_PI_2 M_PI_4 M_1_PI M_2_PI M_2_SQRTPI M_SQRT2
        M_SQRT1_2 main
        fabsf fminf fmaxf fmaf sqrtf expf exp2f logf log2f powf floorf sinf cosf",
    functions: "abs acos acosf acosh acoshf acosl asin asinf asinh asinhf asinl atan atan2 atan2f atan2l atanf atanh
        atanhf atanl cbrt cbrtf cbrtl ceil ceilf ceill copysign copysignf cos cosh coshf coshl cosl div drem erf erfc
        erfcf erff exp exp10 exp2 exp2l expl expm1 expm1f fabs fabsl fdim fdimf finite float_t double_t floor floorl fma
        fmal fmax fmaxl fmin fminl fmod fmodf fmodl fpclassify frexp frexpf frexpl gamma gammaf hypot hypotf hypotl
        ilogb ilogbf isfinite isgreater isgreaterequal isinf isless islessequal islessgreater isnan isnormal
        isunordered j0 j0f j1 j1f jn jnf ldexp ldexpf ldexpl lgamma lgammaf llrint llrintf llround llroundf log log10
        log10f log10l log1p log1pf log2 log2l logb logbf logl lrint lrintf lround lroundf modf modff modfl nan nanf nanl
        nearbyint nearbyintf nextafter nextafterf nexttoward pow pow10 powl remainder remainderf remquo remquof rint
        rintf round roundf roundl scalb scalbln scalbn scalbnf signbit signgam significand sin sincos sincosf sinh sinhf
        sinhl sinl sqrt sqrtl tan tanf tanh tanhf tanhl tanl tgamma tgammaf trunc truncf truncl y0 y0f y1 y1f yn ynf",
    stems: "",
    any_case: false,
};
