//! E at many points.

use rayon::prelude::*;

use super::points::Lines;
use crate::data::Smith;
use crate::effects::table::{Made, Point, Points, Region, aspect};
use lobefit_math::ops;
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::integrate::aniso::table::{Azimuthal, Columns, Grid, tabulate};

/// Tolerance of the means that lookups are judged against.
const JUDGED: f64 = 1e-6;

/// Tolerance of the means that pictures show.
const SHOWN: f64 = 1e-5;

/// Tolerance of E at an azimuth that lookups are judged against.
const JUDGED_AZIMUTH: f64 = 1e-5;

/// The mean over the azimuth at the points of lines, in their order.
pub fn means(smith: Smith, lines: &Lines) -> Result<(Vec<f64>, Made), IntegrateError> {
    let alphas: Vec<f64> = lines.rows.iter().map(|p| f64::from(p.alpha)).collect();
    let aspects: Vec<f64> = lines.slices.iter().map(|a| aspect(f64::from(*a))).collect();
    let mu = |column: usize, row: usize, _: f64| f64::from(lines.cosines[row][column]);
    let columns = Columns::Varying { count: lines.columns(), mu: &mu };
    let table = tabulate(smith, &Grid { columns, alphas: &alphas, aspects: &aspects, floor: 0.0 }, JUDGED)?;
    let evaluations = table.evaluations + table.checked.evaluations;
    Ok((table.e, Made { evaluations, integration: table.checked.worst }))
}

/// The mean over the azimuth at the points of a grid of `columns` roughnesses by cosines, all of
/// one anisotropy.
pub fn means_on(smith: Smith, points: &Points, columns: usize) -> Result<Vec<f64>, IntegrateError> {
    let row = &points.all[..columns];
    let alphas: Vec<f64> = row.iter().map(|p| f64::from(p.alpha)).collect();
    let mu: Vec<f64> = points.all.iter().step_by(columns).map(|p| f64::from(p.mu)).collect();
    let aspects = [aspect(f64::from(points.all[0].anisotropy))];
    let grid = Grid { columns: Columns::Fixed(&mu), alphas: &alphas, aspects: &aspects, floor: 0.0 };
    let e = tabulate(smith, &grid, SHOWN)?.e;
    // The table has mu along its columns, the points have roughness.
    let at = |i: usize| e[i % columns * mu.len() + i / columns];
    Ok((0..points.len()).map(at).collect())
}

/// E over azimuth and mu.
#[derive(Clone, Debug, PartialEq)]
pub struct AzimuthMap {
    /// The points: azimuths fastest.
    pub points: Points,
    /// E at each.
    pub truth: Vec<f64>,
}

/// E at one roughness and anisotropy over azimuths in degrees and cosines.
pub fn azimuth_map(
    smith: Smith,
    region: &Region,
    roughness: f64,
    anisotropy: f64,
    [degrees, mu]: [&[f64]; 2],
) -> Result<AzimuthMap, IntegrateError> {
    let mut points = Points::grid(region, &vec![roughness; degrees.len()], mu, anisotropy);
    let radians: Vec<f64> = degrees.iter().map(|d| d.to_radians()).collect();
    for (i, point) in points.all.iter_mut().enumerate() {
        let cosine = ops::cos(radians[i % radians.len()]);
        point.cos2_phi = (cosine * cosine) as f32;
    }
    let (alpha, aspect) = (f64::from(points.all[0].alpha), aspect(f64::from(points.all[0].anisotropy)));
    let range = [f64::from(mu[0] as f32), f64::from(mu[mu.len() - 1] as f32)];
    let truth = azimuthal(smith, [alpha, alpha * 1.01], [aspect, 1.0], range)?;
    let pinned = truth.pinned(alpha, aspect);
    let at = |(i, p): (usize, &Point)| pinned.at(f64::from(p.mu), radians[i % radians.len()]);
    let truth = points.all.iter().enumerate().map(at).collect();
    Ok(AzimuthMap { points, truth })
}

/// E at the points of lines, each at its own azimuth.
pub fn at_azimuths(smith: Smith, lines: &Lines) -> Result<(Vec<f64>, Made), IntegrateError> {
    let truth = azimuthal(smith, lines.alpha(), lines.aspect(), lines.mu())?;
    let points = &lines.points.all;
    let values: Vec<Vec<f64>> = points
        .par_chunks(lines.columns())
        .map(|line| {
            let pinned = truth.pinned(f64::from(line[0].alpha), aspect(f64::from(line[0].anisotropy)));
            let phi = |cos2: f32| {
                let cos2 = f64::from(cos2);
                ops::atan2((1.0 - cos2).sqrt(), cos2.sqrt())
            };
            line.iter().map(|p| pinned.at(f64::from(p.mu), phi(p.cos2_phi))).collect()
        })
        .collect();
    let made = Made { evaluations: truth.evaluations(), integration: truth.worst() };
    Ok((values.into_iter().flatten().collect(), made))
}

/// E at any azimuth, within 1e-5 over these ranges.
pub(super) fn azimuthal(
    smith: Smith,
    alpha: [f64; 2],
    aspect: [f64; 2],
    mu: [f64; 2],
) -> Result<Azimuthal, IntegrateError> {
    Azimuthal::new(smith, alpha, aspect, mu, JUDGED_AZIMUTH)
}
