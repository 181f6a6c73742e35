//! The matrix of a linearly transformed cosine.

use crate::polygon::cosine_share;
use lobefit_math::vector::{Vec3, dot};

/// The inverse M^-1 of the matrix, which takes directions of the lobe to those of the cosine, with
/// its middle element 1: rows (m11, 0, m13), (0, 1, 0), (m31, 0, m33).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Matrix {
    /// Row 1, column 1.
    pub m11: f64,
    /// Row 1, column 3.
    pub m13: f64,
    /// Row 3, column 1.
    pub m31: f64,
    /// Row 3, column 3.
    pub m33: f64,
}

impl Matrix {
    /// The cosine itself.
    pub const IDENTITY: Matrix = Matrix { m11: 1.0, m13: 0.0, m31: 0.0, m33: 1.0 };

    /// As a texel has it: m11, m31, m13, m33, the columns of the matrix one after the other.
    pub fn texel(self) -> [f64; 4] {
        [self.m11, self.m31, self.m13, self.m33]
    }

    /// Of a texel.
    pub fn of_texel([m11, m31, m13, m33]: [f64; 4]) -> Matrix {
        Matrix { m11, m13, m31, m33 }
    }

    /// A direction of the lobe among those of the cosine.
    #[inline]
    pub fn taken(&self, [x, y, z]: Vec3) -> Vec3 {
        [self.m11 * x + self.m13 * z, y, self.m31 * x + self.m33 * z]
    }

    /// The other way round, times the determinant.
    #[inline]
    pub fn given(&self, [x, y, z]: Vec3) -> Vec3 {
        [self.m33 * x - self.m13 * z, y * self.determinant(), self.m11 * z - self.m31 * x]
    }

    /// Of the inverse.
    #[inline]
    pub fn determinant(&self) -> f64 {
        self.m11 * self.m33 - self.m13 * self.m31
    }

    /// The share of the light per solid angle from a direction of unit length: its integral over the
    /// sphere is 1.
    #[inline]
    pub fn density(&self, light: Vec3) -> f64 {
        let taken = self.taken(light);
        let square = dot(taken, taken);
        // cos/pi times |det|/|M^-1 l|^3
        taken[2].max(0.0) * self.determinant().abs() / (std::f64::consts::PI * square * square)
    }

    /// The share of the light from a polygon, in closed form.
    pub fn share(&self, corners: &[Vec3]) -> f64 {
        let taken: Vec<Vec3> = corners.iter().map(|corner| self.taken(*corner)).collect();
        cosine_share(&taken)
    }
}
