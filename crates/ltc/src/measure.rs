//! How far a pair of tables is from its lobe.

use crate::LtcError;
use crate::fit::misplaced;
use crate::lobe::{Lobe, View};
use crate::matrix::Matrix;
use crate::pair::Pair;
use crate::polygon::{cosine_share, proxy_share, vector_share};
use crate::quad::Quad;
use crate::square::{PER_PLACE, squares};
use lobefit_math::vector::{Vec3, dot, plus, scaled};
use rayon::prelude::*;

/// What a pair is measured against, and where.
#[derive(Clone, Copy, Debug)]
pub struct Setting {
    /// The lobe.
    pub lobe: Lobe,
    /// Range of roughness.
    pub roughness: [f64; 2],
    /// Range of mu.
    pub mu: [f64; 2],
    /// Places along both axes, at least 2.
    pub places: usize,
}

/// Errors over places.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Deviation {
    /// The largest.
    pub max: f64,
    /// Root of the mean square.
    pub rms: f64,
    /// The mean, with its sign.
    pub mean: f64,
    /// Roughness and mu of the largest.
    pub at: [f64; 2],
}

/// What was measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// Share of the lobe's light that a square's is off by, at the places: the shape alone.
    pub shape: Deviation,
    /// The same with weights of the lookup of 8 fractional bits.
    pub shape_8_bit: Deviation,
    /// Errors of the truths of squares.
    pub integration: Deviation,
    /// Share of the light that comes from elsewhere: the bound for lights of any shape.
    pub misplaced: Deviation,
    /// E.
    pub amplitude: Deviation,
    /// E, by coarse weights.
    pub amplitude_8_bit: Deviation,
    /// B.
    pub bias: Deviation,
    /// A square's light by the emitted function in f32, from that of the closed form.
    pub code: Deviation,
    /// A square's light with the horizon by the formula of shaders that do not clip, from the same.
    pub horizon: Deviation,
    /// Largest shape error of a square at each place, roughness fastest.
    pub map: Vec<f64>,
    /// Roughness along the map's columns, mu along its rows.
    pub axes: [Vec<f64>; 2],
    /// Squares that were looked at.
    pub squares: usize,
}

/// Errors at a place.
#[derive(Default)]
struct Place {
    at: [f64; 2],
    shape: Vec<f64>,
    shape_8_bit: Vec<f64>,
    code: Vec<f64>,
    horizon: Vec<f64>,
    integration: Vec<f64>,
    misplaced: [f64; 1],
    amplitude: [f64; 1],
    amplitude_8_bit: [f64; 1],
    bias: [f64; 1],
}

impl Place {
    /// The errors of squares of a view by a texel of matrices and by one of coarse weights.
    fn over_squares(&mut self, view: &View, [texel, coarse]: [[f64; 4]; 2], quad: &Quad) {
        let matrix = Matrix::of_texel(texel);
        self.misplaced = [misplaced(view, matrix)];
        for square in squares(view) {
            let (truth, corners) = (square.share(view), square.corners());
            let taken = corners.map(|corner| matrix.taken(corner));
            let share = cosine_share(&taken);
            self.shape.push(share - truth.value);
            self.shape_8_bit.push(Matrix::of_texel(coarse).share(&corners) - truth.value);
            self.integration.push(truth.error);
            self.code.push(quad.share(texel, &corners) - share);
            self.horizon.push(proxy_share(towards(&taken)) - share);
        }
    }
}

/// The vector form factor of a polygon, towards it whichever way round its corners go.
fn towards(corners: &[Vec3; 4]) -> Vec3 {
    let (vector, middle) = (vector_share(corners), corners.iter().fold([0.0; 3], |sum, c| plus(sum, *c)));
    if dot(vector, middle) < 0.0 { scaled(vector, -1.0) } else { vector }
}

impl Setting {
    /// Roughness along columns, mu along rows.
    fn axes(&self) -> [Vec<f64>; 2] {
        let last = (self.places - 1) as f64;
        let along = |[low, high]: [f64; 2]| -> Vec<f64> {
            (0..self.places).map(|i| low + (high - low) * i as f64 / last).collect()
        };
        let root = along([self.mu[1], self.mu[0]].map(|mu| (1.0 - mu).max(0.0).sqrt()));
        let mu = root.into_iter().map(|v| (1.0 - v * v).clamp(self.mu[0], self.mu[1]));
        [along(self.roughness), mu.collect()]
    }
}

/// Measures a pair at places even in roughness and in sqrt(1 - mu), texels and between them as they
/// fall. `alpha` is that of a roughness.
///
/// # Errors
/// A truth that cannot be integrated; a table with values that are no numbers.
pub fn measured(
    pair: &Pair,
    setting: &Setting,
    alpha: impl Fn(f64) -> f64 + Sync,
) -> Result<Measured, LtcError> {
    let (lobe, quad, axes) = (setting.lobe, Quad::new()?, setting.axes());
    let places: Vec<[f64; 2]> = axes[1].iter().flat_map(|mu| axes[0].iter().map(|r| [*r, *mu])).collect();
    let widths: Vec<[f64; 2]> = places.iter().map(|[r, mu]| [lobe.within(alpha(*r)), *mu]).collect();
    let albedos = lobe.albedo(&widths)?;
    let one = |i: usize| -> Result<Place, LtcError> {
        let ([roughness, mu], [e, b]) = (places[i], albedos[i]);
        let [[texel, [own_e, own_b, ..]], [coarse, [coarse_e, ..]]] =
            [false, true].map(|is_coarse| pair.at(roughness, mu, is_coarse));
        let mut place = Place { at: places[i], ..Place::default() };
        place.amplitude = [own_e - e];
        place.amplitude_8_bit = [coarse_e - e];
        place.bias = [own_b - b];
        place.over_squares(&View::of(lobe, widths[i], e), [texel, coarse], &quad);
        let sums = [&place.shape, &place.shape_8_bit, &place.code].map(|errors| errors.iter().sum::<f64>());
        let named = [
            ("the shape error", sums[0] + sums[1]),
            ("the emitted function", sums[2]),
            ("E", own_e),
            ("B", own_b),
        ];
        match named.into_iter().find(|(_, value)| !value.is_finite()) {
            Some((what, value)) => Err(LtcError::NotFinite { what, value, roughness, mu }),
            None => Ok(place),
        }
    };
    let all: Vec<Place> = (0..places.len()).into_par_iter().map(one).collect::<Result<_, _>>()?;
    let largest = |errors: &[f64]| errors.iter().fold(0.0_f64, |all, e| all.max(e.abs()));
    Ok(Measured {
        shape: Deviation::of(&all, |place| &place.shape),
        shape_8_bit: Deviation::of(&all, |place| &place.shape_8_bit),
        integration: Deviation::of(&all, |place| &place.integration),
        misplaced: Deviation::of(&all, |place| &place.misplaced),
        amplitude: Deviation::of(&all, |place| &place.amplitude),
        amplitude_8_bit: Deviation::of(&all, |place| &place.amplitude_8_bit),
        bias: Deviation::of(&all, |place| &place.bias),
        code: Deviation::of(&all, |place| &place.code),
        horizon: Deviation::of(&all, |place| &place.horizon),
        map: all.iter().map(|place| largest(&place.shape)).collect(),
        axes,
        squares: all.len() * PER_PLACE,
    })
}

impl Deviation {
    fn of(places: &[Place], errors: impl Fn(&Place) -> &[f64]) -> Deviation {
        let (mut found, mut count, mut square) = (Deviation::default(), 0_u32, 0.0);
        for place in places {
            for error in errors(place) {
                count += 1;
                square += error * error;
                found.mean += error;
                if error.abs() > found.max {
                    (found.max, found.at) = (error.abs(), place.at);
                }
            }
        }
        let count = f64::from(count.max(1));
        Deviation { rms: (square / count).sqrt(), mean: found.mean / count, ..found }
    }
}
