//! Lookups of binary sub-voxels in every language: the centroid of a byte's, by counting bits and
//! by a table, and the byte of a super-voxel. They are of integers, which the dialect of formulas
//! has not: the languages' texts stand here, one beside the other.

use super::Language;
use super::counted::{MaskCost, counted};
use super::expression::decimal;
use crate::ShadeError;
use crate::comment::comment;
use lobefit_math::subvoxel::{NO_CENTROID, centroid};

/// A function of masks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MaskFunction {
    /// Its name.
    pub name: &'static str,
    /// What it takes, as languages without integers of 64 bits have it.
    pub inputs: &'static [&'static str],
    /// What it returns.
    pub gives: &'static str,
}

impl MaskFunction {
    /// What it takes: of the text in WGSL.
    ///
    /// # Errors
    /// A defect of this program: the text is its own.
    pub fn cost(&self) -> Result<MaskCost, ShadeError> {
        counted(&subvoxels(Language::Wgsl), self.name)
    }
}

/// Every function, in the order of the text.
pub const MASK_FUNCTIONS: [MaskFunction; 3] = [
    MaskFunction {
        name: "subvoxel_centroid",
        inputs: &["mask"],
        gives: "mean position of the set sub-voxels in the cell [0, 1]^3, by counting bits",
    },
    MaskFunction {
        name: "subvoxel_centroid_lookup",
        inputs: &["mask"],
        gives: "the same from the table SUBVOXEL_CENTROIDS",
    },
    MaskFunction {
        name: "supervoxel_mask",
        inputs: &["low", "high"],
        gives: "byte whose bit b is set where byte b of a super-voxel is not 0",
    },
];

const CENTROID: &str = "\
Mean position of the set sub-voxels of a mask: (n + 2 k)/(4 n) along an axis with k of the n set ones in its upper half.
Bit b = x + 2 y + 4 z of a mask is the sub-voxel at (x, y, z), each 0 or 1; sub-voxels have their centres at 0.25 and
0.75 of the cell [0, 1]^3. Mask 0 has none: (-1, -1, -1), outside of the cell. Exact to the last bit where a division is
rounded once.
";
const TABLE: &str = "\
Mean position of the set sub-voxels of each mask, to the nearest float; of mask 0, which has none, (-1, -1, -1).
";
const LOOKUP: &str = "\
The same as `subvoxel_centroid`, from the table.
";
const SUPER: &str = "\
The mask of a super-voxel, eight masks in 64 bits: bit b is set where any bit of byte b, its bits 8 b to 8 b + 7, is.
With b = x + 2 y + 4 z, masks in Morton order are an octree.
";

/// The functions, each after its documentation, with the table that one reads.
pub fn subvoxels(language: Language) -> String {
    let words = words(language);
    let mut text = String::new();
    let mut add = |documentation: &[&str], code: &str| {
        let lines: Vec<String> = documentation.iter().flat_map(|doc| doc.lines()).map(String::from).collect();
        text += &format!("\n{}{code}", comment("///", &lines));
    };
    add(&[CENTROID], words.centroid);
    add(&[TABLE], &table(&words));
    add(&[LOOKUP], words.lookup);
    add(&[SUPER, words.halves], words.supervoxel);
    text
}

/// The texts of a language.
struct Words {
    centroid: &'static str,
    lookup: &'static str,
    supervoxel: &'static str,
    /// How 64 bits are given.
    halves: &'static str,
    /// What stands before and behind a table, and before and behind a row.
    table: [&'static str; 2],
    row: [&'static str; 2],
    /// What ends a literal.
    suffix: &'static str,
}

/// The table, four rows of three numbers a line.
fn table(words: &Words) -> String {
    let ([open, close], [start, end]) = (words.table, words.row);
    let row = |mask: u8| {
        let numbers = centroid(mask).unwrap_or(NO_CENTROID).map(|x| decimal(x) + words.suffix);
        format!("{start}{}{end}", numbers.join(", "))
    };
    let rows: Vec<String> = (0..=u8::MAX).map(row).collect();
    let lines: Vec<String> = rows.chunks(4).map(|four| format!("    {}", four.join(", "))).collect();
    format!("{open}\n{}\n{close}\n", lines.join(",\n"))
}

const HALVES: &str = "low has bytes 0 to 3, high bytes 4 to 7.";

/// What follows the qualifiers of a function in the shader languages of C's family.
macro_rules! family {
    ($before:literal, $uint:literal) => {
        concat!(
            $before,
            "uint supervoxel_mask(",
            $uint,
            " low, ",
            $uint,
            " high) {
    low |= low >> 4u;
    high |= high >> 4u;
    low |= low >> 2u;
    high |= high >> 2u;
    low |= low >> 1u;
    high |= high >> 1u;
    low = ((low & 0x01010101u) * 0x01020408u) >> 24u;
    high = ((high & 0x01010101u) * 0x01020408u) >> 24u;
    return (low & 0xfu) | ((high & 0xfu) << 4u);
}
"
        )
    };
}

fn words(language: Language) -> Words {
    match language {
        Language::Rust => RUST,
        Language::Wgsl => WGSL,
        Language::Hlsl => HLSL,
        Language::Glsl => GLSL,
        Language::Msl => MSL,
        Language::C => C,
    }
}

const RUST: Words = Words {
    centroid: "\
pub fn subvoxel_centroid(mask: u8) -> [f32; 3] {
    let n = mask.count_ones();
    if n == 0 {
        return [-1.0; 3];
    }
    [0xaa, 0xcc, 0xf0].map(|upper| (n + 2 * (mask & upper).count_ones()) as f32 / (4 * n) as f32)
}
",
    lookup: "\
pub fn subvoxel_centroid_lookup(mask: u8) -> [f32; 3] {
    SUBVOXEL_CENTROIDS[mask as usize]
}
",
    supervoxel: "\
pub fn supervoxel_mask(bytes: u64) -> u8 {
    let mut any = bytes | (bytes >> 4);
    any |= any >> 2;
    any |= any >> 1;
    ((any & 0x0101_0101_0101_0101).wrapping_mul(0x0102_0408_1020_4080) >> 56) as u8
}
",
    halves: "",
    table: ["pub static SUBVOXEL_CENTROIDS: [[f32; 3]; 256] = [", "];"],
    row: ["[", "]"],
    suffix: "",
};

const WGSL: Words = Words {
    centroid: "\
fn subvoxel_centroid(mask: u32) -> vec3<f32> {
    let n = countOneBits(mask & 0xffu);
    let upper = vec3<u32>(countOneBits(mask & 0xaau), countOneBits(mask & 0xccu), countOneBits(mask & 0xf0u));
    return select(vec3<f32>(-1.0), vec3<f32>(n + 2u * upper) / f32(4u * n), n != 0u);
}
",
    lookup: "\
fn subvoxel_centroid_lookup(mask: u32) -> vec3<f32> {
    return SUBVOXEL_CENTROIDS[mask & 0xffu];
}
",
    supervoxel: "\
fn supervoxel_mask(low: u32, high: u32) -> u32 {
    var any = vec2<u32>(low, high);
    any |= any >> vec2<u32>(4u);
    any |= any >> vec2<u32>(2u);
    any |= any >> vec2<u32>(1u);
    any = ((any & vec2<u32>(0x01010101u)) * 0x01020408u) >> vec2<u32>(24u);
    return (any.x & 0xfu) | ((any.y & 0xfu) << 4u);
}
",
    halves: HALVES,
    table: ["const SUBVOXEL_CENTROIDS: array<vec3<f32>, 256> = array<vec3<f32>, 256>(", ");"],
    row: ["vec3<f32>(", ")"],
    suffix: "",
};

const HLSL: Words = Words {
    centroid: "\
float3 subvoxel_centroid(uint mask) {
    const uint n = countbits(mask & 0xffu);
    const uint x = countbits(mask & 0xaau), y = countbits(mask & 0xccu), z = countbits(mask & 0xf0u);
    const float3 sum = float3(float(n + 2u * x), float(n + 2u * y), float(n + 2u * z));
    if (n == 0u) return float3(-1.0f, -1.0f, -1.0f);
    return sum / float(4u * n);
}
",
    lookup: "\
float3 subvoxel_centroid_lookup(uint mask) {
    return SUBVOXEL_CENTROIDS[mask & 0xffu];
}
",
    supervoxel: family!("", "uint"),
    halves: HALVES,
    table: ["static const float3 SUBVOXEL_CENTROIDS[256] = {", "};"],
    row: ["float3(", ")"],
    suffix: "f",
};

// Counts of bits come with GLSL 4.00 and GLSL ES 3.10: four are made at once. Integers of GLSL ES
// may have 16 bits where they are not said to be highp.
const GLSL: Words = Words {
    centroid: "\
vec3 subvoxel_centroid(highp uint mask) {
    // Counts of all set ones, and of those with x, y and z = 1: a byte each.
    highp uint count = ((mask & 0xffu) * 0x01010101u) & 0xf0ccaaffu;
    count -= (count >> 1u) & 0x55555555u;
    count = (count & 0x33333333u) + ((count >> 2u) & 0x33333333u);
    count = (count + (count >> 4u)) & 0x0f0f0f0fu;
    highp uint n = count & 0xfu, x = (count >> 8u) & 0xfu, y = (count >> 16u) & 0xfu, z = count >> 24u;
    if (n == 0u) return vec3(-1.0);
    return vec3(float(n + 2u * x), float(n + 2u * y), float(n + 2u * z)) / float(4u * n);
}
",
    lookup: "\
vec3 subvoxel_centroid_lookup(highp uint mask) {
    return SUBVOXEL_CENTROIDS[mask & 0xffu];
}
",
    supervoxel: family!("highp ", "highp uint"),
    halves: HALVES,
    table: ["const vec3 SUBVOXEL_CENTROIDS[256] = vec3[256](", ");"],
    row: ["vec3(", ")"],
    suffix: "",
};

const MSL: Words = Words {
    centroid: "\
inline float3 subvoxel_centroid(uint mask) {
    const uint n = popcount(mask & 0xffu);
    const uint x = popcount(mask & 0xaau), y = popcount(mask & 0xccu), z = popcount(mask & 0xf0u);
    const float3 sum = float3(float(n + 2u * x), float(n + 2u * y), float(n + 2u * z));
    return n == 0u ? float3(-1.0f) : sum / float(4u * n);
}
",
    lookup: "\
inline float3 subvoxel_centroid_lookup(uint mask) {
    return SUBVOXEL_CENTROIDS[mask & 0xffu];
}
",
    supervoxel: family!("inline ", "uint"),
    halves: HALVES,
    table: ["constant float3 SUBVOXEL_CENTROIDS[256] = {", "};"],
    row: ["float3(", ")"],
    suffix: "f",
};

const C: Words = Words {
    centroid: "\
static inline void subvoxel_centroid(unsigned char mask, float centre[3]) {
    /* Counts of all set ones, and of those with x, y and z = 1: a byte each. */
    unsigned long count = mask * 0x01010101ul & 0xf0ccaafful;
    int axis;
    count -= count >> 1 & 0x55555555ul;
    count = (count & 0x33333333ul) + (count >> 2 & 0x33333333ul);
    count = (count + (count >> 4)) & 0x0f0f0f0ful;
    for (axis = 0; axis < 3; ++axis) {
        const unsigned n = (unsigned)(count & 0xfu), k = (unsigned)(count >> 8 * (axis + 1) & 0xfu);
        centre[axis] = n == 0 ? -1.0f : (float)(n + 2u * k) / (float)(4u * n);
    }
}
",
    lookup: "\
static inline void subvoxel_centroid_lookup(unsigned char mask, float centre[3]) {
    int axis;
    for (axis = 0; axis < 3; ++axis) centre[axis] = SUBVOXEL_CENTROIDS[mask][axis];
}
",
    supervoxel: "\
static inline unsigned char supervoxel_mask(unsigned long long bytes) {
    bytes |= bytes >> 4;
    bytes |= bytes >> 2;
    bytes |= bytes >> 1;
    return (unsigned char)((bytes & 0x0101010101010101ull) * 0x0102040810204080ull >> 56 & 0xffu);
}
",
    halves: "",
    table: ["static const float SUBVOXEL_CENTROIDS[256][3] = {", "};"],
    row: ["{", "}"],
    suffix: "f",
};
