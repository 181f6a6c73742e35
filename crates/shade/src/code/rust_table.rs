//! The lookup in Rust, from a slice of texels, and what lookups share there.

use super::printer::Printer;
use super::rust::Rust;
use super::table::{TableLookup, kind};

pub(super) fn lookup(table: &TableLookup) -> String {
    let [filter, order] = table.order();
    let (uv, sizes) = (table.letters().concat(), table.listed());
    let first = [
        format!(
            "{} by a {filter} fetch, clamped to the edge, from texels {order} as in the `raw` file.",
            table.meaning
        ),
        format!("Panics if `texels` has fewer than {} entries.", sizes.replace(", ", " x ")),
    ];
    let texels = Rust.argument("texels", &format!("&[{}]", Rust.kind(kind(table.channels))));
    let mut text = table.opening(&Rust, &first, &[texels]);
    let corners = table.corners();
    if corners.is_empty() {
        text += &format!("    let {uv} = {};\n", table.located());
    }
    for (i, corner) in corners.iter().enumerate() {
        text += &format!("    let [u_{i}, v_{i}, w_{i}, weight_{i}] = {};\n", table.located_at(corner));
    }
    let fetch = |texel: &str| match corners.len() {
        0 => format!("{filter}([{sizes}], {uv}, |i| {texel})"),
        n => {
            let of =
                |k: usize| format!("{filter}([{sizes}], [u_{k}, v_{k}, w_{k}], |i| {texel}) * weight_{k}");
            (0..n).map(of).collect::<Vec<_>>().join("\n        + ")
        }
    };
    let texel = match table.channels {
        1 => fetch("texels[i]"),
        n => {
            let channels: Vec<String> = (0..n).map(|c| c.to_string()).collect();
            format!("[{}].map(|c: usize| {})", channels.join(", "), fetch("texels[i][c]"))
        }
    };
    format!("{text}    let texel = {texel};\n    {}\n}}\n", table.decoded("texel"))
}

/// Names of the functions that the helpers may hold.
pub const RUST_HELPERS: [&str; 3] = ["cell", "bilinear", "trilinear"];

const PLANE: &str = "\
/// Texel before a texture coordinate, the step to the one after it, and the fraction between.
fn cell(u: f32, size: usize) -> (usize, usize, f32) {
    let position = (u * size as f32 - 0.5).max(0.0).min((size - 1) as f32);
    let base = (position as usize).min(size - 1);
    let fraction = position - base as f32;
    (base, (fraction > 0.0) as usize, fraction)
}

/// The value between four texels, `at` an index.
fn bilinear([columns, rows]: [usize; 2], [u, v]: [f32; 2], at: impl Fn(usize) -> f32) -> f32 {
    let ((x, right, fx), (y, down, fy)) = (cell(u, columns), cell(v, rows));
    let (above, below) = (y * columns + x, (y + down) * columns + x);
    let top = at(above) + (at(above + right) - at(above)) * fx;
    let bottom = at(below) + (at(below + right) - at(below)) * fx;
    top + (bottom - top) * fy
}
";

const SPACE: &str = "
/// The value between eight texels, `at` an index.
fn trilinear([columns, rows, slices]: [usize; 3], [u, v, w]: [f32; 3], at: impl Fn(usize) -> f32) -> f32 {
    let (z, deep, fz) = cell(w, slices);
    let slice = |z: usize| bilinear([columns, rows], [u, v], |i| at(z * rows * columns + i));
    let (front, back) = (slice(z), slice(z + deep));
    front + (back - front) * fz
}
";

/// The helpers that the text of Rust lookups calls; empty where it calls none.
pub(super) fn helpers(functions: &str) -> String {
    match (functions.contains("trilinear("), functions.contains("bilinear(")) {
        (true, _) => format!("{PLANE}{SPACE}"),
        (false, true) => PLANE.into(),
        (false, false) => String::new(),
    }
}
