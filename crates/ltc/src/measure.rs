//! How far a pair of tables is from its lobe.

use crate::LtcError;
use crate::fit::misplaced;
use crate::lobe::{Lobe, View};
use crate::matrix::Matrix;
use crate::pair::{Lookup, Pair};
use crate::polygon::{cosine_share, proxy_share, sphere_share, vector_share};
use crate::quad::{QUAD, Quad};
use crate::square::squares;
use lobefit_math::vector::{Vec3, dot, plus, scaled};
use lobefit_shade::round_up;
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
    /// About as many places along both axes, at least 2.
    pub places: usize,
}

/// Places about which a largest error is looked for, and half texels to either side.
const WORST: usize = 3;
const NEAR: i32 = 3;

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
    /// The largest as a part of the light that it is in: of E, also where the error is B's, which falls to
    /// 1e-8
    /// itself.
    pub relative: f64,
    /// Values that were looked at.
    pub count: usize,
}

/// What was measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// Share of the lobe's light that a square's is off by, at the places: the shape alone.
    pub shape: Deviation,
    /// The same with weights of the lookup of 8 fractional bits.
    pub shape_8_bit: Deviation,
    /// The same by coordinates and texels of half precision.
    pub shape_half: Deviation,
    /// Errors of the truths of squares.
    pub integration: Deviation,
    /// Share of the light that comes from elsewhere: the bound for lights of any shape.
    pub misplaced: Deviation,
    /// E.
    pub amplitude: Deviation,
    /// B.
    pub bias: Deviation,
    /// E and B together.
    pub light: Deviation,
    /// The same by coarse weights.
    pub light_8_bit: Deviation,
    /// The same in half precision.
    pub light_half: Deviation,
    /// The share of a sphere, by cosine and length in place of roughness and mu.
    pub sphere: Deviation,
    /// A square's light by the emitted function in f32, from that of the closed form.
    pub code: Deviation,
    /// A square's light with the horizon by the formula of shaders that do not clip, from the same.
    pub horizon: Deviation,
    /// Largest shape error of a square at each place, roughness fastest.
    pub map: Vec<f64>,
    /// Roughness along the map's columns, mu along its rows.
    pub axes: [Vec<f64>; 2],
}

/// Errors at a place.
#[derive(Default)]
struct Place {
    at: [f64; 2],
    shape: Vec<f64>,
    shape_8_bit: Vec<f64>,
    shape_half: Vec<f64>,
    code: Vec<f64>,
    horizon: Vec<f64>,
    integration: Vec<f64>,
    misplaced: Vec<f64>,
}

impl Place {
    /// The errors of squares of a view by texels of matrices, one of each lookup.
    fn over_squares(&mut self, view: &View, [texel, coarse, half]: [[f64; 4]; 3], quad: &Quad) {
        let matrix = Matrix::of_texel(texel);
        self.misplaced.push(misplaced(view, matrix));
        for square in squares(view) {
            let (truth, corners) = (square.share(view), square.corners());
            let taken = corners.map(|corner| matrix.taken(corner));
            let share = cosine_share(&taken);
            self.shape.push(share - truth.value);
            self.shape_8_bit.push(Matrix::of_texel(coarse).share(&corners) - truth.value);
            self.shape_half.push(Matrix::of_texel(half).share(&corners) - truth.value);
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
    /// The ranges along the two coordinates of a table.
    fn ranges(&self) -> [[f64; 2]; 2] {
        [self.roughness, [self.mu[1], self.mu[0]].map(|mu| (1.0 - mu).max(0.0).sqrt())]
    }

    /// mu of a coordinate.
    fn mu(&self, coordinate: f64) -> f64 {
        (1.0 - coordinate * coordinate).clamp(self.mu[0], self.mu[1])
    }

    /// Roughness along columns, mu along rows: by turns a texel's place and the middle of two, and the
    /// ends.
    fn axes(&self, side: usize) -> [Vec<f64>; 2] {
        let last = (side - 1) as f64;
        let [roughness, root] = self.ranges().map(|[low, high]| {
            let place = |i: usize| {
                let at = (low + (high - low) * i as f64 / (self.places - 1) as f64) * last;
                let at = if i.is_multiple_of(2) { at.round() } else { at.floor() + 0.5 };
                (at / last).clamp(low, high)
            };
            let mut all: Vec<f64> = (0..self.places).map(place).chain([low, high]).collect();
            all.sort_by(f64::total_cmp);
            all.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
            all
        });
        [roughness, root.into_iter().map(|root| self.mu(root)).collect()]
    }

    /// The places by half texels about some, those beyond an end of the ranges on it.
    fn about(&self, side: usize, some: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let (last, ranges) = (2 * (side - 1), self.ranges());
        let near = |at: f64, [low, high]: [f64; 2]| {
            let middle = (at * last as f64).round();
            (-NEAR..=NEAR).map(move |k| ((middle + f64::from(k)) / last as f64).clamp(low, high))
        };
        let each = some.iter().flat_map(|[roughness, mu]| {
            let roots = near((1.0 - mu).max(0.0).sqrt(), ranges[1]);
            roots.flat_map(move |v| near(*roughness, ranges[0]).map(move |r| [r, self.mu(v)]))
        });
        let mut all: Vec<[f64; 2]> = each.collect();
        all.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
        all.dedup();
        all
    }

    /// Every texel's place and the thirds of the way to the next, as far as they lie in the ranges, and
    /// the ends.
    fn everywhere(&self, side: usize) -> Vec<[f64; 2]> {
        let last = 3 * (side - 1);
        let [roughness, root] = self.ranges().map(|[low, high]| {
            let inside = (0..=last).map(|i| i as f64 / last as f64).filter(|at| low < *at && *at < high);
            std::iter::once(low).chain(inside).chain([high]).collect::<Vec<f64>>()
        });
        root.into_iter().flat_map(|v| roughness.iter().map(move |r| [*r, self.mu(v)])).collect()
    }
}

/// The lookups that are measured.
const LOOKUPS: [Lookup; 3] = [Lookup::Exact, Lookup::Coarse, Lookup::Half];

/// What the lobe's albedo is off by: E, B, and both by each lookup.
fn scales(
    pair: &Pair,
    setting: &Setting,
    alpha: &(impl Fn(f64) -> f64 + Sync),
) -> Result<[Deviation; 5], LtcError> {
    let (lobe, places) = (setting.lobe, setting.everywhere(pair.side));
    let widths: Vec<[f64; 2]> = places.iter().map(|[r, mu]| [lobe.within(alpha(*r)), *mu]).collect();
    let mut found = [const { Vec::new() }; 5];
    for (&at, [e, b]) in places.iter().zip(lobe.albedo(&widths)?) {
        let own = LOOKUPS.map(|lookup| pair.at(at[0], at[1], lookup)[1]);
        for (what, value) in [("E", own[0][0]), ("B", own[0][1])] {
            if !value.is_finite() {
                return Err(LtcError::NotFinite { what, value, roughness: at[0], mu: at[1] });
            }
        }
        let errors = own.map(|[own_e, own_b, ..]| [own_e - e, own_b - b]);
        let [e_alone, b_alone] = errors[0].each_ref().map(std::slice::from_ref);
        let lists: [&[f64]; 5] = [e_alone, b_alone, &errors[0], &errors[1], &errors[2]];
        for (all, errors) in found.iter_mut().zip(lists) {
            all.extend(errors.iter().map(|error| (at, *error, e)));
        }
    }
    Ok(found.map(|errors| Deviation::of(errors.into_iter())))
}

/// What the share of a sphere is off by, at texels and at thirds between them.
fn spheres(pair: &Pair) -> Deviation {
    let last = 3 * (pair.side - 1);
    let one = |i: usize| {
        let [u, length] = [i % (last + 1), i / (last + 1)].map(|i| i as f64 / last as f64);
        let cosine = 2.0 * u - 1.0;
        let share = Pair::between(pair.side, &pair.amplitudes, [u, length], Lookup::Exact)[3] * length;
        ([cosine, length], share - sphere_share(cosine, length), 1.0)
    };
    Deviation::of((0..(last + 1) * (last + 1)).map(one))
}

/// Measures a pair: squares at places even in roughness and in sqrt(1 - mu), by turns at texels and
/// between them, and by half texels about the worst of those; E and B at all texels and at thirds between
/// them. `alpha` is that of a roughness.
///
/// # Errors
/// A truth that cannot be integrated; a texel with a value that is no number.
pub fn measured(
    pair: &Pair,
    setting: &Setting,
    alpha: impl Fn(f64) -> f64 + Sync,
) -> Result<Measured, LtcError> {
    pair.check()?;
    let (lobe, quad, axes) = (setting.lobe, Quad::new()?, setting.axes(pair.side));
    let [amplitude, bias, light, light_8_bit, light_half] = scales(pair, setting, &alpha)?;
    let places: Vec<[f64; 2]> = axes[1].iter().flat_map(|mu| axes[0].iter().map(|r| [*r, *mu])).collect();
    let one = |&[roughness, mu]: &[f64; 2]| -> Result<Place, LtcError> {
        let texels = LOOKUPS.map(|lookup| pair.at(roughness, mu, lookup)[0]);
        let mut place = Place { at: [roughness, mu], ..Place::default() };
        place.over_squares(&View::new(lobe, lobe.within(alpha(roughness)), mu)?, texels, &quad);
        let sum = |errors: &[f64]| errors.iter().sum::<f64>();
        let shapes = [&place.shape, &place.shape_8_bit, &place.shape_half].map(|errors| sum(errors));
        let named = [("the shape error", shapes.iter().sum()), (QUAD, sum(&place.code))];
        match named.into_iter().find(|(_, value)| !value.is_finite()) {
            Some((what, value)) => Err(LtcError::NotFinite { what, value, roughness, mu }),
            None => Ok(place),
        }
    };
    let all: Vec<Place> = places.par_iter().map(one).collect::<Result<_, _>>()?;
    let largest = |errors: &[f64]| errors.iter().fold(0.0_f64, |all, e| all.max(e.abs()));
    let near = setting.about(pair.side, &worst(&all, pair.side, |place| largest(&place.shape)));
    let near: Vec<Place> = near.par_iter().map(one).collect::<Result<_, _>>()?;
    let over = |errors: fn(&Place) -> &Vec<f64>| {
        let of = |places: &[Place]| {
            let each =
                places.iter().flat_map(|place| errors(place).iter().map(|error| (place.at, *error, 1.0)));
            Deviation::of(each)
        };
        of(&all).or_larger(of(&near))
    };
    Ok(Measured {
        shape: over(|place| &place.shape),
        shape_8_bit: over(|place| &place.shape_8_bit),
        shape_half: over(|place| &place.shape_half),
        integration: over(|place| &place.integration),
        misplaced: over(|place| &place.misplaced),
        amplitude,
        bias,
        light,
        light_8_bit,
        light_half,
        sphere: spheres(pair),
        code: over(|place| &place.code),
        horizon: over(|place| &place.horizon),
        map: all.iter().map(|place| largest(&place.shape)).collect(),
        axes,
    })
}

/// The places of the largest errors, no two of them within three texels.
fn worst(places: &[Place], side: usize, error: impl Fn(&Place) -> f64) -> Vec<[f64; 2]> {
    let mut all: Vec<(f64, [f64; 2])> = places.iter().map(|place| (error(place), place.at)).collect();
    all.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut found: Vec<[f64; 2]> = Vec::new();
    for (_, at) in all {
        let near = |other: &[f64; 2]| {
            let [a, b] = [at[1], other[1]].map(|mu| (1.0 - mu).max(0.0).sqrt());
            (at[0] - other[0]).abs().max((a - b).abs()) * ((side - 1) as f64) < 3.0
        };
        if found.len() < WORST && !found.iter().any(near) {
            found.push(at);
        }
    }
    found
}

impl Measured {
    /// What headers say of the errors of the two tables, beside the lookup's.
    pub fn notes(&self) -> [String; 2] {
        let Measured { shape, misplaced, amplitude, bias, sphere, .. } = self;
        let [max, rms, e, b, sphere] =
            [misplaced.max, misplaced.rms, amplitude.max, bias.max, sphere.max].map(|x| round_up(x, 3));
        let squares = shape.count;
        [
            format!(
                "Errors are shares of the lobe's light over {squares} squares that face the point; of a light of any shape at most {max} (rms {rms})."
            ),
            format!("E is off by {e} at most, B by {b}, the share of a sphere by {sphere}."),
        ]
    }
}

impl Deviation {
    /// With the largest of another, whose places are where errors are large: mean and RMS stay.
    fn or_larger(self, other: Deviation) -> Deviation {
        let count = self.count + other.count;
        let larger = if other.max > self.max { other } else { self };
        Deviation { rms: self.rms, mean: self.mean, count, ..larger }
    }

    /// Of places, errors there, and the light that each is in.
    fn of(errors: impl Iterator<Item = ([f64; 2], f64, f64)>) -> Deviation {
        let (mut found, mut square) = (Deviation::default(), 0.0);
        for (at, error, light) in errors {
            found.count += 1;
            square += error * error;
            found.mean += error;
            found.relative = found.relative.max(error.abs() / light);
            if error.abs() > found.max {
                (found.max, found.at) = (error.abs(), at);
            }
        }
        let count = found.count.max(1) as f64;
        Deviation { rms: (square / count).sqrt(), mean: found.mean / count, ..found }
    }
}
