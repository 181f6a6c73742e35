//! How far a pair of tables is from its lobe.

use crate::LtcError;
use crate::fit::misplaced;
use crate::lobe::{Lobe, View};
use crate::matrix::Matrix;
use crate::pair::Pair;
use crate::polygon::{cosine_share, proxy_share, vector_share};
use crate::square::{PER_PLACE, squares};
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
    /// Places along both axes.
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
    /// Error of the integrals.
    pub integration: Deviation,
    /// Share of the light that comes from elsewhere: the bound for lights of any shape.
    pub misplaced: Deviation,
    /// E.
    pub amplitude: Deviation,
    /// B.
    pub bias: Deviation,
    /// A square's light by the vector form factor, with the horizon by a formula, from that of the
    /// clipped square.
    pub horizon: Deviation,
    /// Largest shape error of a square at each place, roughness fastest.
    pub map: Vec<f64>,
    /// Squares that were looked at.
    pub squares: usize,
}

/// Errors of a place: of each square shape and horizon, then the others.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    at: [f64; 2],
    shape: Vec<f64>,
    horizon: Vec<f64>,
    integration: f64,
    misplaced: f64,
    amplitude: f64,
    bias: f64,
}

/// Errors of a matrix at a view.
pub fn at_place(view: &View, matrix: Matrix, at: [f64; 2]) -> Place {
    let mut place = Place {
        at,
        shape: Vec::with_capacity(PER_PLACE),
        horizon: Vec::with_capacity(PER_PLACE),
        integration: 0.0,
        misplaced: misplaced(view, matrix),
        amplitude: 0.0,
        bias: 0.0,
    };
    for square in squares(view) {
        let truth = square.share(view);
        let taken = square.corners().map(|corner| matrix.taken(corner));
        let share = cosine_share(&taken);
        place.shape.push(share - truth.value);
        place.integration = place.integration.max(truth.error);
        let [x, y, z] = vector_share(&taken);
        // Whichever way round the corners go: towards the light.
        let sign = if x * taken_middle(&taken)[0] + y * taken_middle(&taken)[1] + z * taken_middle(&taken)[2] < 0.0 {
            -1.0
        } else {
            1.0
        };
        place.horizon.push(proxy_share([sign * x, sign * y, sign * z]) - share);
    }
    place
}

fn taken_middle(corners: &[[f64; 3]; 4]) -> [f64; 3] {
    std::array::from_fn(|k| corners.iter().map(|corner| corner[k]).sum())
}

impl Setting {
    fn places(&self) -> Vec<[f64; 2]> {
        let n = self.places;
        let along = |[low, high]: [f64; 2], i: usize| low + (high - low) * i as f64 / (n - 1) as f64;
        let root = self.mu.map(|mu| (1.0 - mu).max(0.0).sqrt());
        let place = |t: usize| {
            let v = along([root[1], root[0]], t / n);
            [along(self.roughness, t % n), (1.0 - v * v).clamp(self.mu[0], self.mu[1])]
        };
        (0..n * n).map(place).collect()
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
    let lobe = setting.lobe;
    let places = setting.places();
    let widths: Vec<[f64; 2]> = places.iter().map(|[r, mu]| [lobe.within(alpha(*r)), *mu]).collect();
    let albedos = lobe.albedo(&widths)?;
    let one = |i: usize| -> Result<Place, LtcError> {
        let ([roughness, mu], [e, b]) = (places[i], albedos[i]);
        let (matrix, [own_e, own_b, ..]) = pair.at(roughness, mu);
        let view = View::of(lobe, widths[i], e);
        let place = Place {
            amplitude: own_e - e,
            bias: own_b - b,
            ..at_place(&view, matrix, places[i])
        };
        let named = [("the shape error", place.shape.iter().sum()), ("E", own_e), ("B", own_b)];
        match named.into_iter().find(|(_, value): &(_, f64)| !value.is_finite()) {
            Some((what, value)) => Err(LtcError::NotFinite { what, value, roughness, mu }),
            None => Ok(place),
        }
    };
    let all: Vec<Place> = (0..places.len()).into_par_iter().map(one).collect::<Result<_, _>>()?;
    let largest = |errors: &[f64]| errors.iter().fold(0.0_f64, |all, e| all.max(e.abs()));
    Ok(Measured {
        shape: Deviation::of(&all, |place| &place.shape),
        integration: Deviation::of(&all, |place| std::slice::from_ref(&place.integration)),
        misplaced: Deviation::of(&all, |place| std::slice::from_ref(&place.misplaced)),
        amplitude: Deviation::of(&all, |place| std::slice::from_ref(&place.amplitude)),
        bias: Deviation::of(&all, |place| std::slice::from_ref(&place.bias)),
        horizon: Deviation::of(&all, |place| &place.horizon),
        map: all.iter().map(|place| largest(&place.shape)).collect(),
        squares: all.len() * PER_PLACE,
    })
}

impl Deviation {
    fn of(places: &[Place], errors: impl Fn(&Place) -> &[f64]) -> Deviation {
        let (mut found, mut count, mut square) = (Deviation::default(), 0, 0.0);
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
        found.mean /= f64::from(count.max(1));
        Deviation { rms: (square / f64::from(count.max(1))).sqrt(), ..found }
    }
}
