//! The lookup in C, from an array of texels, and what lookups and other functions of vectors share
//! there.

use super::c::C;
use super::printer::Printer;
use super::table::{TableLookup, kind};
use crate::Kind;

pub(super) fn lookup(table: &TableLookup) -> String {
    let [filter, order] = table.order();
    let (channels, uv) = (table.channels, table.letters().concat());
    let beside = if channels == 1 { String::new() } else { format!(" of {channels} channels each") };
    let sizes = table.listed().replace(", ", " x ");
    let first = format!(
        "{} by a {filter} fetch, clamped to the edge, from {sizes} texels in f32{beside}, {order} as in the `raw` file.",
        table.meaning
    );
    let mut text = table.opening(&C, &[first], &[C.argument("texels", "const float *")]);
    let declare = |name: &str, kind: Kind, value: &str| {
        format!("    {}{value};\n", C.declare(name, kind, false, false))
    };
    let corners = table.corners();
    if corners.is_empty() {
        text += &declare(&uv, kind(table.letters().len()), &table.located());
    }
    for (i, corner) in corners.iter().enumerate() {
        text += &declare(&format!("corner_{i}"), kind(4), &table.located_at(&corner.replace(".0", ".0f")));
        let at = format!("{{corner_{i}.x, corner_{i}.y, corner_{i}.z}}");
        text += &declare(&format!("{uv}_{i}"), kind(3), &at);
    }
    let fetch = |i: usize| {
        let texels = if i == 0 { "texels".to_string() } else { format!("texels + {i}") };
        let at = |uv: &str| format!("lobefit_{filter}({texels}, {channels}, {}, {uv})", table.listed());
        let of = |k: usize| format!("{} * corner_{k}.w", at(&format!("{uv}_{k}")));
        match corners.len() {
            0 => at(&uv),
            n => (0..n).map(of).collect::<Vec<_>>().join("\n        + "),
        }
    };
    let fetched: Vec<String> = (0..channels).map(fetch).collect();
    let texel = match fetched.as_slice() {
        [one] => one.clone(),
        list => format!("{{\n        {},\n    }}", list.join(",\n        ")),
    };
    text += &declare("texel", kind(channels), &texel);
    text + &format!("    return {};\n}}\n", table.decoded("texel"))
}

/// How the names of the shared functions and types begin.
pub const C_PREFIX: &str = "lobefit_";

const VECTORS: &str = "\
typedef struct lobefit_float2 { float x, y; } lobefit_float2;
typedef struct lobefit_float3 { float x, y, z; } lobefit_float3;
typedef struct lobefit_float4 { float x, y, z, w; } lobefit_float4;
";

const PLANE: &str = "
/// Texel before a position along an axis, the step to the one after it, and the fraction between.
typedef struct lobefit_cell { int base, step; float fraction; } lobefit_cell;

/// The cell of a texture coordinate.
static inline lobefit_cell lobefit_cell_at(float u, int size) {
    const float position = fminf(fmaxf(u * (float)size - 0.5f, 0.0f), (float)(size - 1));
    const int base = (int)position;
    const float fraction = position - (float)base;
    const lobefit_cell cell = {base, fraction > 0.0f ? 1 : 0, fraction};
    return cell;
}

/// A channel between four texels; `texels` points to that of the first texel.
static inline float lobefit_bilinear(const float *texels, int channels, int columns, int rows, lobefit_float2 uv) {
    const lobefit_cell x = lobefit_cell_at(uv.x, columns), y = lobefit_cell_at(uv.y, rows);
    const float *above = texels + channels * (y.base * columns + x.base);
    const float *below = above + channels * columns * y.step;
    const int next = channels * x.step;
    const float top = above[0] + (above[next] - above[0]) * x.fraction;
    const float bottom = below[0] + (below[next] - below[0]) * x.fraction;
    return top + (bottom - top) * y.fraction;
}
";

const SPACE: &str = "
/// A channel between eight texels; `texels` points to that of the first texel.
static inline float lobefit_trilinear(
    const float *texels, int channels, int columns, int rows, int slices, lobefit_float3 uvw) {
    const lobefit_cell z = lobefit_cell_at(uvw.z, slices);
    const lobefit_float2 uv = {uvw.x, uvw.y};
    const float *first = texels + channels * columns * rows * z.base;
    const float *second = first + channels * columns * rows * z.step;
    const float front = lobefit_bilinear(first, channels, columns, rows, uv);
    const float back = lobefit_bilinear(second, channels, columns, rows, uv);
    return front + (back - front) * z.fraction;
}
";

/// What the text of C functions uses; empty where it uses nothing.
pub(super) fn helpers(functions: &str) -> String {
    let parts = [("lobefit_float", VECTORS), ("linear(", PLANE), ("lobefit_trilinear(", SPACE)];
    parts.iter().filter(|(word, _)| functions.contains(word)).map(|(_, text)| *text).collect()
}
