//! The lookup in Rust, from a slice of texels, and what lookups share there.

use super::printer::Printer;
use super::rust::Rust;
use super::table::{TableLookup, kind};

/// Names of the cells' parts along an axis: the texel, the step to the next, the fraction between.
const CELLS: [[&str; 3]; 3] = [["column", "right", "fx"], ["row", "down", "fy"], ["slice", "deep", "fz"]];

pub(super) fn lookup(table: &TableLookup) -> String {
    let letters = table.letters();
    let sizes: Vec<String> = table.sizes.iter().map(ToString::to_string).collect();
    let [filter, order] = table.order();
    let mut text = format!(
        "/// {} by a {filter} fetch, clamped to the edge, from texels {order}.\n///\n",
        table.meaning
    );
    text += &format!("/// # Panics\n/// If `texels` has fewer than {} entries.\n", sizes.join(" x "));
    let texels = Rust.argument("texels", &format!("&[{}]", Rust.kind(kind(table.channels))));
    text += &table.opening(&Rust, &[texels]);
    text += &format!("    let [{}] = {};\n", letters.join(", "), table.located());
    for ((letter, size), [base, step, fraction]) in letters.iter().zip(&table.sizes).zip(CELLS) {
        let length = *size as f32;
        text +=
            &format!("    let ({base}, {step}, {fraction}) = cell({letter} * {length:?} - 0.5, {size});\n");
    }
    let blended = blended(table.sizes.len(), table.channels);
    format!("{text}{}    {}\n}}\n", corners(table), table.decoded(&blended))
}

/// The lines that fetch the texels around a position: `a` to `d` of a table of two axes, `near` and
/// `far` of one of three.
fn corners(table: &TableLookup) -> String {
    let (columns, rows) = (table.sizes[0], table.sizes[1]);
    if table.sizes.len() == 2 {
        return format!(
            "    let at = |column: usize, row: usize| texels[row * {columns} + column];
    let (a, b) = (at(column, row), at(column + right, row));
    let (c, d) = (at(column, row + down), at(column + right, row + down));
"
        );
    }
    format!(
        "    let four = |slice: usize| {{
        let at = |column: usize, row: usize| texels[(slice * {rows} + row) * {columns} + column];
        [at(column, row), at(column + right, row), at(column, row + down), at(column + right, row + down)]
    }};
    let (near, far) = (four(slice), four(slice + deep));
"
    )
}

/// The texel between those of [`corners`], channel by channel.
fn blended(axes: usize, channels: usize) -> String {
    let blend = |part: &str| match (axes, part) {
        (2, part) => format!("bilinear(a{part}, b{part}, c{part}, d{part}, fx, fy)"),
        (_, "") => "trilinear(near, far, fx, fy, fz)".into(),
        (_, part) => format!("trilinear(near.map(|t| t{part}), far.map(|t| t{part}), fx, fy, fz)"),
    };
    if channels == 1 {
        return blend("");
    }
    let blended: Vec<String> = (0..channels).map(|i| blend(&format!("[{i}]"))).collect();
    format!("[{}]", blended.join(", "))
}

/// Names of the functions that the helpers may hold.
pub const RUST_HELPERS: [&str; 3] = ["cell", "bilinear", "trilinear"];

const PLANE: &str = "\
/// Texel before a position in texels, the step to the one after it, and the fraction between.
fn cell(position: f32, size: usize) -> (usize, usize, f32) {
    let position = position.max(0.0).min((size - 1) as f32);
    let base = (position as usize).min(size - 1);
    let fraction = position - base as f32;
    (base, (fraction > 0.0) as usize, fraction)
}

fn bilinear(a: f32, b: f32, c: f32, d: f32, fx: f32, fy: f32) -> f32 {
    let (top, bottom) = (a + (b - a) * fx, c + (d - c) * fx);
    top + (bottom - top) * fy
}
";

const SPACE: &str = "
fn trilinear(near: [f32; 4], far: [f32; 4], fx: f32, fy: f32, fz: f32) -> f32 {
    let slice = |[a, b, c, d]: [f32; 4]| bilinear(a, b, c, d, fx, fy);
    let (front, back) = (slice(near), slice(far));
    front + (back - front) * fz
}
";

/// The helpers that the text of Rust lookups calls; empty where it calls none.
pub(super) fn helpers(functions: &str) -> String {
    match (functions.contains("trilinear("), functions.contains("cell(")) {
        (true, _) => format!("{PLANE}{SPACE}"),
        (false, true) => PLANE.into(),
        (false, false) => String::new(),
    }
}
