//! The lookup in C, from an array of texels, and what lookups and compensations share there.

use super::functions::numbers;
use super::{LETTERS, Readable, decoding};
use crate::emit::spelling::{argument, declare, head, part, vector};
use lobefit_shade::code::Language;

const C: Language = Language::C;

pub(super) fn lookup(readable: &Readable) -> String {
    let (name, axes, channels) = (readable.identifier(), &readable.table.axes, readable.decode.channels());
    let body = decoding::body(readable.decode, |_| String::new());
    let sizes: Vec<String> = axes.iter().map(|axis| axis.size.to_string()).collect();
    let solid = axes.len() == 3;
    let (filter, order) =
        if solid { ("trilinear", "slice by slice, each row by row") } else { ("bilinear", "row by row") };
    let beside = if channels == 1 { String::new() } else { format!(" of {channels} channels each") };
    let mut text = format!(
        "/// {} by a {filter} fetch, clamped to the edge, from {} texels{beside}, {order}.\n",
        body.meaning,
        sizes.join(" x ")
    );
    let texels = argument(C, "texels", "const float *");
    let arguments = [vec![texels], numbers(C, &readable.arguments())].concat();
    text += &head(C, &format!("{name}_lookup"), &arguments, &vector(C, body.values.len()));
    let uv = LETTERS[..axes.len()].concat();
    let call = format!("{name}_{uv}({})", readable.coordinate_arguments().join(", "));
    text += &declare(C, &vector(C, axes.len()), &uv, &call);
    for (i, axis) in axes.iter().enumerate() {
        let cell = format!("lobefit_cell_at({}, {})", part(C, &uv, i), axis.size);
        text += &declare(C, "lobefit_cell", &"xyz"[i..=i], &cell);
    }
    let fetched: Vec<String> = (0..channels).map(|i| fetch(readable, channels, i)).collect();
    let texel = if channels == 1 {
        declare(C, "float", "texel", &fetched.concat())
    } else {
        let list = fetched.join(",\n        ");
        declare(C, &vector(C, channels), "texel", &format!("{{\n        {list},\n    }}"))
    };
    let decoded: String = readable.decode_arguments().iter().map(|name| format!(", {name}")).collect();
    format!("{text}{texel}    return {name}_decode(texel{decoded});\n}}\n")
}

/// The blended texel's channel `i`.
fn fetch(readable: &Readable, channels: usize, i: usize) -> String {
    let [columns, rows, _] = readable.table.size();
    let texels = if i == 0 { "texels".to_string() } else { format!("texels + {i}") };
    if readable.table.axes.len() == 2 {
        format!("lobefit_bilinear({texels}, {channels}, {columns}, x, y)")
    } else {
        format!("lobefit_trilinear({texels}, {channels}, {columns}, {rows}, x, y, z)")
    }
}

/// How the names of the shared functions and types begin.
pub const HELPER_PREFIX: &str = "lobefit_";

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
