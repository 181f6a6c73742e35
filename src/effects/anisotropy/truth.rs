//! E at many points.

use rayon::prelude::*;

use crate::data::Smith;
use crate::effects::table::{LookupPoints, Made, Point, Region, SliceAxis, aspect};
use lobefit_math::ops;
use lobefit_truth::integrate::aniso::fast::{Interpolants, Place, one};
use lobefit_truth::integrate::{IntegrateError, Path};
use lobefit_truth::points;
use lobefit_truth::quantity::{GgxReflectionAniso, Quantity};

/// Tolerance of E that lookups are judged against: of the mean over the azimuth, and at an azimuth.
const JUDGED: [f64; 2] = [1e-6, 1e-5];

/// A view of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct View {
    /// sqrt(alpha_x alpha_y).
    pub alpha: f64,
    /// sqrt(alpha_y/alpha_x).
    pub aspect: f64,
    /// Cosine between normal and view.
    pub mu: f64,
    /// Azimuth of the view from the alpha_x axis, radians.
    pub phi: f64,
}

impl View {
    /// The place of it, with its azimuth or without.
    pub fn place(&self, azimuth: bool) -> Place {
        let alpha = [self.alpha / self.aspect, self.alpha * self.aspect];
        Place { alpha, mu: self.mu, phi: azimuth.then_some(self.phi) }
    }
}

/// The inputs of `ggx-reflection-aniso`.
fn inputs(views: &[View], azimuth: bool) -> points::Points {
    let column = |of: fn(&View) -> f64| views.iter().map(of).collect::<Vec<f64>>();
    let inputs = [
        ("alpha_x", column(|view| view.alpha / view.aspect)),
        ("alpha_y", column(|view| view.alpha * view.aspect)),
        ("mu", column(|view| view.mu)),
    ];
    let phi = azimuth.then(|| ("phi", column(|view| view.phi)));
    points::Points::new(inputs.into_iter().chain(phi))
}

/// E of views at their azimuths, or in the mean over it.
pub(super) fn energies(
    smith: Smith,
    views: &[View],
    azimuth: bool,
    tolerance: f64,
) -> Result<(Vec<f64>, Made), IntegrateError> {
    let truth = GgxReflectionAniso.truth(&smith.into(), &inputs(views, azimuth), &["E"], tolerance)?;
    let made = Made { evaluations: truth.evaluations, integration: truth.error };
    let [e] = truth.arrays();
    Ok((e, made))
}

/// The views of the points of lookups.
fn views(points: &LookupPoints) -> Vec<View> {
    let view = |p: &Point| {
        let cos2 = f64::from(p.cos2_phi);
        View {
            alpha: f64::from(p.alpha),
            aspect: aspect(f64::from(p.anisotropy)),
            mu: f64::from(p.mu),
            phi: ops::atan2((1.0 - cos2).sqrt(), cos2.sqrt()),
        }
    };
    points.all.iter().map(view).collect()
}

/// E at the points of lookups: at the azimuth of each where azimuth is an input, else in the mean
/// over the azimuth; and the interpolants that it was read off.
pub fn truths(smith: Smith, points: &LookupPoints) -> Result<(Vec<f64>, Made, Interpolants), IntegrateError> {
    let (inputs, tolerance) = (inputs(&views(points), points.azimuth), JUDGED[usize::from(points.azimuth)]);
    let (truth, interpolants) = GgxReflectionAniso.interpolated(smith, &inputs, tolerance)?;
    let made = Made { evaluations: truth.evaluations, integration: truth.error };
    let [e] = truth.arrays();
    Ok((e, made, interpolants))
}

/// Tolerance of E at one azimuth where no sample of it is checked: a digit beyond what is judged.
const ALONE: f64 = 0.1 * JUDGED[1];

/// E at further points: off the interpolants in the mean over the azimuth, integrated at an azimuth,
/// where one integral is less work than the interpolant at one width; beyond both domains as any
/// points are.
pub(super) fn further(
    smith: Smith,
    points: &LookupPoints,
    interpolants: &Interpolants,
) -> Result<Vec<f64>, IntegrateError> {
    let (views, azimuth) = (views(points), points.azimuth);
    let at = |view: &View| match view.place(azimuth) {
        place if !azimuth => Ok(interpolants.at(&place)),
        place if place.is_covered() => Ok(Some(one(Path::Best, smith, &place, ALONE)?.value)),
        _ => Ok(None),
    };
    let known: Vec<Option<f64>> = views.par_iter().map(at).collect::<Result<_, IntegrateError>>()?;
    let beyond: Vec<usize> = (0..known.len()).filter(|i| known[*i].is_none()).collect();
    let far: Vec<View> = beyond.iter().map(|i| views[*i]).collect();
    let (integrated, _) = energies(smith, &far, azimuth, JUDGED[usize::from(azimuth)])?;
    let mut e: Vec<f64> = known.into_iter().map(|e| e.unwrap_or(f64::NAN)).collect();
    beyond.iter().zip(integrated).for_each(|(i, value)| e[*i] = value);
    Ok(e)
}

/// Points of one roughness and anisotropy over azimuths in degrees and cosines, azimuths fastest.
pub(super) fn map(
    region: &Region,
    roughness: f64,
    anisotropy: f64,
    [degrees, mu]: [&[f64]; 2],
) -> LookupPoints {
    let mut points = LookupPoints::grid(region, &vec![roughness; degrees.len()], mu, anisotropy);
    for (point, degrees) in points.all.iter_mut().zip(degrees.iter().cycle()) {
        let cosine = ops::cos(degrees.to_radians());
        point.cos2_phi = (cosine * cosine) as f32;
    }
    LookupPoints::of(points.all, points.uniform, SliceAxis::Anisotropy, true)
}
