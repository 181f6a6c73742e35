//! Names that may stand inside array literals.

/// Names that may stand before a bracket of numbers: types, and what makes arrays of its arguments.
const MAKERS: [&str; 20] = [
    "array",
    "new",
    "std",
    "np",
    "numpy",
    "of",
    "from",
    "glm",
    "vec",
    "Vec",
    "Array",
    "Float32Array",
    "Float64Array",
    "Uint16Array",
    "Uint8Array",
    "Uint32Array",
    "uint16_t",
    "uint8_t",
    "u16",
    "u8",
];

/// Scalar types.
const SCALARS: [&str; 9] =
    ["float", "half", "double", "f32", "f16", "f64", "float16_t", "min16float", "uint"];

/// Types of vectors, to which a digit and sometimes a letter belong.
const VECTORS: [&str; 10] =
    ["vec", "float", "half", "double", "f16vec", "dvec", "Vec", "make_float", "Vector", "min16float"];

/// Whether a word may stand before a bracket of numbers without saying anything about them.
pub(super) fn is_maker(word: &str) -> bool {
    MAKERS.contains(&word) || is_scalar_type(word)
}

/// Whether a word is a type of numbers.
pub(super) fn is_scalar_type(word: &str) -> bool {
    SCALARS.contains(&word)
}

/// Whether a word is a type of vectors of two to four numbers: `float3`, `vec2`, `vec4f`, `Vec3A`.
pub(super) fn is_vector(word: &str) -> bool {
    let digits = word.strip_suffix(['f', 'h', 'A']).unwrap_or(word);
    digits.strip_suffix(['2', '3', '4']).is_some_and(|stem| VECTORS.contains(&stem))
}

/// What a word for a number that is none stands for.
pub(super) fn not_finite(word: &str) -> Option<f64> {
    match word {
        "nan" | "NaN" | "NAN" => Some(f64::NAN),
        "inf" | "Inf" | "INF" | "infinity" | "Infinity" | "INFINITY" => Some(f64::INFINITY),
        _ => None,
    }
}
