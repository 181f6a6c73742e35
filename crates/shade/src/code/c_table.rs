//! The lookup in C, from an array of texels, and what lookups and other functions of vectors share
//! there.

use super::c::C;
use super::printer::Printer;
use super::table::{TableLookup, kind};
use crate::Kind;

pub(super) fn lookup(table: &TableLookup) -> String {
    let sizes: Vec<String> = table.sizes.iter().map(ToString::to_string).collect();
    let [filter, order] = table.order();
    let channels = table.channels;
    let beside = if channels == 1 { String::new() } else { format!(" of {channels} channels each") };
    let mut text = format!(
        "/// {} by a {filter} fetch, clamped to the edge, from {} texels{beside}, {order}.\n",
        table.meaning,
        sizes.join(" x ")
    );
    text += &table.opening(&C, &[C.argument("texels", "const float *")]);
    let uv = table.letters().concat();
    let declare = |name: &str, kind: Kind, value: &str| {
        format!("    {}{value};\n", C.declare(name, kind, false, false))
    };
    text += &declare(&uv, kind(sizes.len()), &table.located());
    for (i, size) in table.sizes.iter().enumerate() {
        let coordinate = C.component(&uv, i);
        text +=
            &format!("    const lobefit_cell {} = lobefit_cell_at({coordinate}, {size});\n", &"xyz"[i..=i]);
    }
    let fetched: Vec<String> = (0..channels).map(|i| fetch(table, i)).collect();
    let texel = match fetched.as_slice() {
        [one] => one.clone(),
        list => format!("{{\n        {},\n    }}", list.join(",\n        ")),
    };
    text += &declare("texel", kind(channels), &texel);
    text + &format!("    return {};\n}}\n", table.decoded("texel"))
}

/// The blended texel's channel `i`.
fn fetch(table: &TableLookup, i: usize) -> String {
    let (channels, columns, rows) = (table.channels, table.sizes[0], table.sizes[1]);
    let texels = if i == 0 { "texels".to_string() } else { format!("texels + {i}") };
    if table.sizes.len() == 2 {
        format!("lobefit_bilinear({texels}, {channels}, {columns}, x, y)")
    } else {
        format!("lobefit_trilinear({texels}, {channels}, {columns}, {rows}, x, y, z)")
    }
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
static inline float lobefit_bilinear(const float *texels, int channels, int columns, lobefit_cell x, lobefit_cell y) {
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
    const float *texels, int channels, int columns, int rows, lobefit_cell x, lobefit_cell y, lobefit_cell z) {
    const int slice = channels * columns * rows;
    const float front = lobefit_bilinear(texels + slice * z.base, channels, columns, x, y);
    const float back = lobefit_bilinear(texels + slice * (z.base + z.step), channels, columns, x, y);
    return front + (back - front) * z.fraction;
}
";

/// What the text of C functions uses; empty where it uses nothing.
pub(super) fn helpers(functions: &str) -> String {
    let parts = [("lobefit_float", VECTORS), ("lobefit_cell", PLANE), ("lobefit_trilinear(", SPACE)];
    parts.iter().filter(|(word, _)| functions.contains(word)).map(|(_, text)| *text).collect()
}
