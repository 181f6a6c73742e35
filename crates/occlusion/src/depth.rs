//! Depth buffers, and what fills their holes.

/// The depth of a texel that nothing was written to.
pub const EMPTY: f32 = -1.0;

/// Depth along the view's axis, row by row from the top: positive, infinite where nothing is hit,
/// or [`EMPTY`].
#[derive(Clone, Debug, PartialEq)]
pub struct Depth {
    /// Width and height.
    pub size: [usize; 2],
    /// The texels.
    pub texels: Vec<f32>,
}

impl Depth {
    /// Nothing written.
    pub fn empty(size: [usize; 2]) -> Depth {
        Depth { size, texels: vec![EMPTY; size[0] * size[1]] }
    }

    /// Texels that nothing was written to.
    pub fn holes(&self) -> usize {
        self.texels.iter().filter(|z| **z == EMPTY).count()
    }

    /// Writes where nothing is yet, and over what is farther.
    pub fn nearest(&mut self, x: usize, y: usize, z: f32) {
        let texel = &mut self.texels[y * self.size[0] + x];
        if *texel == EMPTY || z < *texel {
            *texel = z;
        }
    }

    /// Rows of a square about a texel, inside of the buffer.
    fn around(&self, x: usize, y: usize, radius: usize) -> impl Iterator<Item = &[f32]> {
        let [width, height] = self.size;
        let columns = x.saturating_sub(radius)..(x + radius + 1).min(width);
        let rows = y.saturating_sub(radius)..(y + radius + 1).min(height);
        rows.map(move |row| &self.texels[row * width..][columns.clone()])
    }

    /// Puts into each empty texel what `fill` makes of the buffer there, all at once; texels
    /// touched.
    fn filled(&mut self, radius: usize, mut fill: impl FnMut(&Depth, usize, usize) -> f32) -> u64 {
        let width = self.size[0];
        let holes: Vec<usize> = (0..self.texels.len()).filter(|i| self.texels[*i] == EMPTY).collect();
        let values: Vec<f32> = holes.iter().map(|i| fill(self, i % width, i / width)).collect();
        let touched = self.texels.len() + holes.len() * (2 * radius + 1) * (2 * radius + 1);
        for (i, value) in holes.into_iter().zip(values) {
            self.texels[i] = value;
        }
        touched as u64
    }

    /// Fills empty texels with the median of the square about them, where more than half of it is
    /// written: the farther of two in the middle. Texels touched.
    pub fn median(&mut self, radius: usize) -> u64 {
        let mut written = Vec::with_capacity((2 * radius + 1) * (2 * radius + 1));
        self.filled(radius, |depth, x, y| {
            let mut whole = 0;
            written.clear();
            for row in depth.around(x, y, radius) {
                whole += row.len();
                written.extend(row.iter().copied().filter(|z| *z != EMPTY));
            }
            if 2 * written.len() <= whole {
                return EMPTY;
            }
            let middle = written.len() / 2;
            *written.select_nth_unstable_by(middle, f32::total_cmp).1
        })
    }

    /// Fills empty texels with the farthest of what is written around them, of the smallest square
    /// up to a radius that has anything. Texels touched.
    pub fn dilation(&mut self, radius: usize) -> u64 {
        self.filled(radius, |depth, x, y| {
            let farthest = |r| depth.around(x, y, r).flatten().copied().fold(EMPTY, f32::max);
            (1..=radius).map(farthest).find(|z| *z != EMPTY).unwrap_or(EMPTY)
        })
    }

    /// The farthest of each square, empty where any of it is: what stands in front of a texel
    /// stands in front of its neighbours too.
    pub fn eroded(&self, radius: usize) -> Depth {
        let [width, height] = self.size;
        // Along rows, then along columns; over neighbours that all texels have at the same distance.
        let mut rows = self.clone();
        for (row, own) in rows.texels.chunks_mut(width).zip(self.texels.chunks(width)) {
            for step in 1..=radius.min(width - 1) {
                worsen(&mut row[step..], own);
                worsen(row, &own[step..]);
            }
        }
        let mut out = rows.clone();
        for step in 1..=radius.min(height - 1) {
            worsen(&mut out.texels[step * width..], &rows.texels);
            worsen(&mut out.texels, &rows.texels[step * width..]);
        }
        out
    }
}

/// Replaces texels by what is farther, or empty. Depths are positive, so that their bits have their order;
/// the bits of [`EMPTY`], which is negative, are larger.
fn worsen(texels: &mut [f32], others: &[f32]) {
    for (texel, other) in texels.iter_mut().zip(others) {
        *texel = f32::from_bits(texel.to_bits().max(other.to_bits()));
    }
}
