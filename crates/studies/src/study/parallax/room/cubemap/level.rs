//! One level of a cubemap: texels of six faces, interpolated.

use half::f16;

use super::CubemapError;
use super::faces::{centre, direction, face_of};
use lobefit_math::vector::Vec3;

/// Texels of six faces, row by row of t and in a row by s, each face with a border of one texel of
/// its neighbours, which interpolation reads beyond an edge: seamless filtering. At a corner of the
/// cube the border is the mean of the three texels that meet there.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    size: usize,
    bordered: Vec<[f32; 3]>,
}

impl Level {
    /// A level from the texels of its faces, in order, stored in 16 bits a channel.
    ///
    /// # Errors
    /// Another number of texels than 6 `size`^2; a value that is not finite in 16 bits.
    pub fn new(size: usize, texels: &[[f64; 3]]) -> Result<Level, CubemapError> {
        let wanted = 6 * size * size;
        if size == 0 || texels.len() != wanted {
            let found = texels.len();
            return Err(CubemapError(format!(
                "a level of {size} texels a side has {wanted} texels, not {found}"
            )));
        }
        let mut stored = Vec::with_capacity(wanted);
        for (texel, values) in texels.iter().enumerate() {
            let rounded = values.map(|value| f16::from_f32(value as f32).to_f32());
            if let Some(channel) = rounded.iter().position(|x| !x.is_finite()) {
                let value = values[channel];
                return Err(CubemapError(format!(
                    "texel {texel} of a level of {size} texels a side: {value} is no finite number in 16 bits; scale the light"
                )));
            }
            stored.push(rounded);
        }
        Ok(Level { size, bordered: bordered(size, &stored) })
    }

    /// Texels along a side of a face.
    pub fn size(&self) -> usize {
        self.size
    }

    /// The texel of a face at (s, t) = (i, j).
    pub fn texel(&self, face: usize, i: usize, j: usize) -> [f64; 3] {
        self.at(face, i + 1, j + 1)
    }

    /// Bilinear interpolation between the four texels around a direction.
    pub fn fetch(&self, towards: Vec3) -> [f64; 3] {
        let (face, place) = face_of(towards);
        let n = self.size as f64;
        let [x, y] = place.map(|c| {
            let x = 0.5 * (c + 1.0) * n - 0.5;
            // a direction whose largest coordinate is found may be a rounding error outside of its
            // face
            x.clamp(-0.5, n - 0.5)
        });
        // the border is texel -1
        let [i, j] = [x, y].map(|x| (x.floor() + 1.0) as usize);
        let [f, g] = [x - x.floor(), y - y.floor()];
        let corners = [(i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)].map(|(i, j)| self.at(face, i, j));
        let weights = [(1.0 - f) * (1.0 - g), f * (1.0 - g), (1.0 - f) * g, f * g];
        std::array::from_fn(|c| (0..4).map(|k| weights[k] * corners[k][c]).sum())
    }

    /// With the border: index 0 is texel -1.
    fn at(&self, face: usize, i: usize, j: usize) -> [f64; 3] {
        let side = self.size + 2;
        self.bordered[(face * side + j) * side + i].map(f64::from)
    }
}

/// Faces with the texels of their neighbours around them.
fn bordered(size: usize, texels: &[[f32; 3]]) -> Vec<[f32; 3]> {
    let (side, last) = (size + 2, size as isize);
    let inside = |i: isize| (0..last).contains(&i);
    let texel = |face: usize, i: isize, j: isize| texels[(face * size + j as usize) * size + i as usize];
    let neighbour = |face: usize, i: isize, j: isize| {
        let (face, place) = face_of(direction(face, [i, j].map(|i| centre(i, size))));
        // Beyond an edge the coordinate along it is that of the neighbour's texel over 1 + 1/n:
        // inside of that texel for every n, and the other one, n/(n + 1), in the outermost.
        let [i, j] = place.map(|c| ((0.5 * (c + 1.0) * size as f64).floor() as isize).clamp(0, last - 1));
        texel(face, i, j)
    };
    let one = |k: usize| {
        let (face, j, i) = (k / (side * side), k / side % side, k % side);
        let [i, j] = [i, j].map(|i| i as isize - 1);
        match (inside(i), inside(j)) {
            (true, true) => texel(face, i, j),
            (false, false) => {
                let [ci, cj] = [i, j].map(|i| i.clamp(0, last - 1));
                let three = [texel(face, ci, cj), neighbour(face, i, cj), neighbour(face, ci, j)];
                mean_of_three(three)
            }
            _ => neighbour(face, i, j),
        }
    };
    (0..6 * side * side).map(one).collect()
}

/// The same for every order of the three.
fn mean_of_three(texels: [[f32; 3]; 3]) -> [f32; 3] {
    std::array::from_fn(|c| {
        let mut values = texels.map(|texel| f64::from(texel[c]));
        values.sort_by(f64::total_cmp);
        (values.iter().sum::<f64>() / 3.0) as f32
    })
}
