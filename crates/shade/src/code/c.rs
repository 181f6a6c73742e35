//! C99, and C++ that includes it.

use super::c_table;
use super::family::{Family, Lacks};
use super::printer::Facts;
use super::spelling::plain;
use super::words::Words;
use crate::Builtin;

/// The printer of C.
pub(super) const C: Family = Family {
    facts: &FACTS,
    linkage: "static inline ",
    qualifier: "",
    number: "float",
    both: "",
    suffix: "f",
    constant: "const ",
    // C99 has its `bool` in another header, and C++ has none of C99's `_Bool`
    truth: ["int", "0", "1"],
    vector: "lobefit_float",
    list: "const lobefit_float4 *",
    has_vectors: false,
    strict: true,
    extremes: ["fminf", "fmaxf"],
    rounds_fma: true,
    call,
    lookup: c_table::lookup,
    shared: c_table::helpers,
};

const FACTS: Facts = Facts {
    name: "c",
    title: "C",
    extension: "h",
    comment: "//",
    notes: &[
        "C99, or C++. Its functions return the bits that were certified where a float is evaluated as a float and a * b + c is",
        "rounded twice: -ffp-contract=off for GCC and Clang, and no -ffast-math.",
    ],
    opening: "#pragma once\n#include <math.h>\n",
    attributes: "",
    reads_arrays: true,
    words: WORDS,
};

/// C's own functions, with the arguments and the order of operations of the dialect.
fn call(builtin: Builtin) -> Result<&'static str, Lacks> {
    Ok(match builtin {
        Builtin::Abs => "fabsf",
        Builtin::Min => "fminf",
        Builtin::Max => "fmaxf",
        Builtin::Fma => "fmaf",
        Builtin::Sqrt => "sqrtf",
        Builtin::Exp => "expf",
        Builtin::Exp2 => "exp2f",
        Builtin::Log => "logf",
        Builtin::Log2 => "log2f",
        Builtin::Pow => "powf",
        Builtin::Floor => "floorf",
        Builtin::Sin => "sinf",
        Builtin::Cos => "cosf",
        Builtin::Clamp => return Err(Lacks::Clamp),
        Builtin::Saturate => return Err(Lacks::Saturate),
        Builtin::Mix => return Err(Lacks::Helper("mix")),
        Builtin::InverseSqrt => return Err(Lacks::InverseSqrt("sqrtf")),
        Builtin::Sign => return Err(Lacks::Helper("sign")),
        Builtin::Step => return Err(Lacks::Helper("step")),
        Builtin::SmoothStep => return Err(Lacks::Helper("smoothstep")),
        Builtin::Dot => return Err(Lacks::Dot),
        Builtin::Select => return Err(Lacks::Select),
    })
}

/// The words of C99 and of C++20, the macros of `<math.h>` and of common platforms; the functions
/// of `<math.h>`.
const WORDS: Words = Words {
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
    spelled: plain,
};
