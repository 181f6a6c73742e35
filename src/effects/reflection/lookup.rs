//! A table of this effect as a shader reads it: coordinates, bilinear fetch and decoding, in f32.

use crate::data::{Layout, Serves, Surface, Table};

/// E and B as decoded from a fetch; B is 0 for a table that serves the albedo alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Split {
    /// Directional albedo.
    pub e: f32,
    /// Schlick's bias.
    pub b: f32,
}

/// A table prepared for lookups.
#[derive(Clone, Debug)]
pub struct Lookup<'a> {
    table: &'a Table,
    texels: Vec<Vec<f32>>,
    layout: Layout,
    serves: Serves,
    /// Steps of the interpolation weights: many texture units keep 8 fractional bits.
    weight_steps: Option<f32>,
}

impl<'a> Lookup<'a> {
    /// Lookups with f32 interpolation weights. The texels are taken as they are: quantise the table first.
    pub fn new(table: &'a Table, layout: Layout, serves: Serves) -> Lookup<'a> {
        let texels = table.channels.iter().map(|c| c.texels.iter().map(|t| *t as f32).collect()).collect();
        Lookup { table, texels, layout, serves, weight_steps: None }
    }

    /// The same with interpolation weights rounded to `bits` fractional bits, as texture units do.
    pub fn with_weight_bits(mut self, bits: u32) -> Lookup<'a> {
        self.weight_steps = Some((1_u32 << bits) as f32);
        self
    }

    /// E and B at a point, in the shader's arithmetic.
    pub fn at(&self, roughness: f32, alpha: f32, mu: f32) -> Split {
        let (columns, rows) = (&self.table.axes[0], &self.table.axes[1]);
        let surface = Surface::<f32>::rough(alpha);
        let x = position(columns.texture_coordinate(mu, surface), columns.size);
        let y = position(rows.texture_coordinate(roughness, surface), rows.size);
        let first = self.fetch(0, x, y);
        let second = if self.serves == Serves::SplitSum { self.fetch(1, x, y) } else { 0.0 };
        self.decode(first, second, mu)
    }

    fn decode(&self, first: f32, second: f32, mu: f32) -> Split {
        match (self.layout, self.serves) {
            (Layout::Homogeneous, Serves::Albedo) => Split { e: 1.0 - first, b: 0.0 },
            (Layout::Homogeneous, Serves::SplitSum) => {
                let e = 1.0 - first;
                let x = 1.0 - mu;
                let x2 = x * x;
                Split { e, b: e * (second + x2 * x2 * x) }
            }
            (_, Serves::Albedo) => Split { e: first, b: 0.0 },
            (_, Serves::SplitSum) => Split { e: first + second, b: second },
        }
    }

    fn fetch(&self, channel: usize, x: f32, y: f32) -> f32 {
        let columns = self.table.axes[0].size;
        let (x0, fx) = self.cell(x, columns);
        let (y0, fy) = self.cell(y, self.table.axes[1].size);
        let t = &self.texels[channel][y0 * columns + x0..];
        let (right, down) = (usize::from(fx > 0.0), if fy > 0.0 { columns } else { 0 });
        let top = t[0] + (t[right] - t[0]) * fx;
        let bottom = t[down] + (t[down + right] - t[down]) * fx;
        top + (bottom - top) * fy
    }

    fn cell(&self, x: f32, n: usize) -> (usize, f32) {
        let x = match self.weight_steps {
            Some(steps) => (x * steps + 0.5).floor() / steps,
            None => x,
        };
        let base = x.floor().min((n - 1) as f32);
        (base as usize, x - base)
    }
}

/// Position in texels of a texture coordinate, clamped to the edge.
fn position(coordinate: f32, n: usize) -> f32 {
    (coordinate * n as f32 - 0.5).max(0.0).min((n - 1) as f32)
}
