//! The functions that read a table: coordinates with the remap of its registration, decoding, and the lookup itself, in WGSL
//! and in Rust. The arithmetic is that in which the table was measured.

use crate::data::{Axis, Layout, Serves, Table, Warp};

/// A table with what its channels mean.
#[derive(Clone, Copy, Debug)]
pub struct Readable<'a> {
    /// The table.
    pub table: &'a Table,
    /// Coordinates.
    pub layout: Layout,
    /// Use.
    pub serves: Serves,
    /// Header lines.
    pub header: &'a [String],
}

impl Readable<'_> {
    /// The table's name as an identifier.
    pub fn identifier(&self) -> String {
        self.table.name.replace(|c: char| !c.is_ascii_alphanumeric(), "_")
    }

    /// The WGSL functions `<name>_uv`, `<name>_decode` and `<name>_lookup`.
    pub fn wgsl(&self) -> String {
        let (name, split) = (self.identifier(), self.serves == Serves::SplitSum);
        let mut text = comment("///", self.header);
        let (x, y) = (&self.table.axes[0], &self.table.axes[1]);
        text += &format!("fn {name}_uv(roughness: f32, alpha: f32, mu: f32) -> vec2<f32> {{\n");
        text += &format!("    let u = {};\n    let v = {};\n", coordinate(x), coordinate(y));
        text += "    return vec2<f32>(u, v);\n}\n\n";
        let (texel, value) = if split { ("vec2<f32>", "vec3<f32>") } else { ("f32", "f32") };
        let meaning = if split { "E, A and B" } else { "E" };
        text += &format!("/// {meaning} from a texel of the table above.\n");
        text +=
            &format!("fn {name}_decode(texel: {texel}, mu: f32) -> {value} {{\n{}}}\n\n", self.decode(true));
        text +=
            &format!("/// {meaning} by one fetch; the sampler filters linearly and clamps to the edge.\n");
        text += &format!(
            "fn {name}_lookup(table: texture_2d<f32>, linear_clamp: sampler, roughness: f32, alpha: f32, mu: f32) -> {value} {{\n"
        );
        text += &format!("    let uv = {name}_uv(roughness, alpha, mu);\n");
        text += "    let texel = textureSampleLevel(table, linear_clamp, uv, 0.0);\n";
        text += &format!("    return {name}_decode(texel.{}, mu);\n}}\n", if split { "xy" } else { "x" });
        text
    }

    /// The same in Rust, with a bilinear fetch from slices of texels.
    pub fn rust(&self) -> String {
        let (name, split) = (self.identifier(), self.serves == Serves::SplitSum);
        let mut text = comment("///", self.header);
        let (x, y) = (&self.table.axes[0], &self.table.axes[1]);
        text += &format!("pub fn {name}_uv(roughness: f32, alpha: f32, mu: f32) -> [f32; 2] {{\n");
        if x.warp != Warp::Homogeneous {
            text += "    let _ = alpha;\n";
        }
        text += &format!("    let u = {};\n", coordinate(x).replace("sqrt(", "f32::sqrt("));
        text += &format!("    let v = {};\n    [u, v]\n}}\n\n", coordinate(y));
        let (texel, value) = if split { ("[f32; 2]", "[f32; 3]") } else { ("f32", "f32") };
        let meaning = if split { "E, A and B" } else { "E" };
        text += &format!("/// {meaning} from a texel of the table above.\n");
        text += &format!(
            "pub fn {name}_decode(texel: {texel}, mu: f32) -> {value} {{\n{}}}\n\n",
            self.decode(false)
        );
        text += &format!(
            "/// {meaning} by a bilinear fetch, clamped to the edge, from texels row by row.\n///\n"
        );
        text += &format!("/// # Panics\n/// If `texels` has fewer than {} x {} entries.\n", x.size, y.size);
        text += &format!(
            "pub fn {name}_lookup(texels: &[{texel}], roughness: f32, alpha: f32, mu: f32) -> {value} {{\n"
        );
        text += &format!("    let [u, v] = {name}_uv(roughness, alpha, mu);\n");
        text += &format!(
            "    let (column, right, fx) = cell(u * {:?} - 0.5, {});\n    let (row, down, fy) = cell(v * {:?} - 0.5, {});\n",
            x.size as f32, x.size, y.size as f32, y.size
        );
        text += &format!("    let at = |column: usize, row: usize| texels[row * {} + column];\n", x.size);
        text += "    let (a, b) = (at(column, row), at(column + right, row));\n";
        text += "    let (c, d) = (at(column, row + down), at(column + right, row + down));\n";
        let blend = if split {
            "[bilinear(a[0], b[0], c[0], d[0], fx, fy), bilinear(a[1], b[1], c[1], d[1], fx, fy)]"
        } else {
            "bilinear(a, b, c, d, fx, fy)"
        };
        text += &format!("    {name}_decode({blend}, mu)\n}}\n");
        text
    }

    fn decode(&self, wgsl: bool) -> String {
        let pick = |i: usize| match (wgsl, i) {
            (true, 0) => "texel.x",
            (true, _) => "texel.y",
            (false, 0) => "texel[0]",
            (false, _) => "texel[1]",
        };
        let triple = |e: &str, a: &str, b: &str| {
            if wgsl {
                format!("    return vec3<f32>({e}, {a}, {b});\n")
            } else {
                format!("    [{e}, {a}, {b}]\n")
            }
        };
        let single =
            |e: &str| if wgsl { format!("    return {e};\n") } else { format!("    let _ = mu;\n    {e}\n") };
        match (self.layout, self.serves) {
            (Layout::Homogeneous, Serves::Albedo) => single("1.0 - texel"),
            (_, Serves::Albedo) => single("texel"),
            (Layout::Homogeneous, Serves::SplitSum) => {
                let mut text =
                    format!("    let e = 1.0 - {};\n    let x = 1.0 - mu;\n    let x2 = x * x;\n", pick(0));
                text += &format!("    let b = e * ({} + x2 * x2 * x);\n", pick(1));
                text + &triple("e", "e - b", "b")
            }
            (_, Serves::SplitSum) => {
                let unused = if wgsl { "" } else { "    let _ = mu;\n" };
                unused.to_string() + &triple(&format!("{} + {}", pick(0), pick(1)), pick(0), pick(1))
            }
        }
    }
}

/// Names of [`RUST_HELPERS`].
pub const RUST_HELPER_NAMES: [&str; 2] = ["cell", "bilinear"];

/// The helpers that the Rust lookups of all tables share.
pub const RUST_HELPERS: &str = "\
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

/// Lines behind a comment mark.
pub fn comment(mark: &str, lines: &[String]) -> String {
    lines.iter().map(|line| format!("{mark} {line}").trim_end().to_string() + "\n").collect()
}

/// The texture coordinate of an axis as an expression, the arithmetic of [`Axis::texture_coordinate`].
fn coordinate(axis: &Axis) -> String {
    let unit = axis.expression();
    match axis.affine() {
        (1.0, 0.0) => unit,
        (scale, offset) if offset < 0.0 => format!("{unit} * {scale:?} - {:?}", -offset),
        (scale, offset) => format!("{unit} * {scale:?} + {offset:?}"),
    }
}
