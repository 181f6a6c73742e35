//! The constants of a lobe's axis and widths, fitted to what GGX surfaces reflect in a room that is
//! none of those that methods are judged in: half of them anywhere inside, half on its walls. The
//! lookup is the whole one, through the smooth proxy: a fetch also sees what lies below a surface,
//! which the surface does not, and how much of that to take is part of the fit.

use argmin::core::{CostFunction, Executor, State};
use argmin::solver::neldermead::NelderMead;
use rayon::prelude::*;
use serde::Serialize;

use super::super::measures::{geometric_mean, relative};
use super::methods::{Method, smooth};
use super::points::{self, Point};
use super::random::{Reference, halves};
use crate::study::parallax::findings::FittedLobe;
use crate::study::parallax::room::{Fetch, GgxRays, Patches, Room, Seen, practice};
use crate::study::{Size, StudyError};
use lobefit::effects::parallax::{LobeFit, Shading, Width};
use lobefit_math::vector::{Vec3, plus, scaled};

/// What is fitted, and where.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Parameters {
    room: Room,
    points: points::Parameters,
    roughness: Vec<f64>,
    directions: u32,
    /// Steps of each search.
    steps: u64,
}

impl Parameters {
    /// Those of a size.
    pub fn of(size: Size) -> Parameters {
        let full = size == Size::Full;
        Parameters {
            room: practice(),
            points: points::Parameters { count: if full { 800 } else { 24 }, margin: 0.1, seed: 7 },
            roughness: vec![0.15, 0.25, 0.35, 0.5, 0.7, 0.9],
            directions: if full { 256 } else { 64 },
            steps: if full { 260 } else { 6 },
        }
    }
}

/// The constants in the order of the search.
fn listed(fit: &LobeFit) -> Vec<f64> {
    [&fit.lean[..], &fit.narrow, &fit.squash].concat()
}

/// Constants by their list; those of the ratio of widths are 0 where the list ends before them: a
/// round lobe.
fn named(list: &[f64]) -> LobeFit {
    let at = |i: usize| list.get(i).copied().unwrap_or(0.0);
    LobeFit { lean: [at(0), at(1), at(2)], narrow: [at(3), at(4), at(5)], squash: [at(6), at(7)] }
}

/// Shading points of one roughness with what is reflected there.
struct Column {
    seen: Vec<Seen>,
    truth: Vec<Vec3>,
}

/// The search for the constants of a number of fetches.
struct Search<'a> {
    parameters: &'a Parameters,
    exact: &'a Patches<'a>,
    columns: &'a [Column],
    fetches: usize,
}

impl Search<'_> {
    /// The geometric mean of the relative L2 over the roughnesses.
    fn error(&self, shading: Shading) -> Result<f64, StudyError> {
        self.error_with(shading, Width::Rational)
    }

    /// The same with a width of fetches.
    fn error_with(&self, shading: Shading, width: Width) -> Result<f64, StudyError> {
        let method = Method { shading, width, ..smooth(self.fetches) };
        let (lookup, exact) = (method.lookup(&self.parameters.room)?, self.exact);
        let error = |column: &Column| {
            let values: Vec<Vec3> =
                column.seen.par_iter().map(|seen| exact.sum(&lookup.taps(seen))).collect();
            relative(&values, &column.truth)
        };
        Ok(geometric_mean(self.columns.iter().map(error)))
    }

    fn fitted(&self, start: &LobeFit, free: usize) -> Result<(LobeFit, f64), StudyError> {
        let failed = |reason: String| StudyError::Lobe { reason };
        let start = listed(start)[..free].to_vec();
        let corner = |i: usize| {
            let mut corner = start.clone();
            corner[i] += STEP;
            corner
        };
        let simplex = std::iter::once(start.clone()).chain((0..free).map(corner)).collect();
        let outcome = Executor::new(self, NelderMead::new(simplex))
            .configure(|state| state.max_iters(self.parameters.steps))
            .ctrlc(false)
            .timer(false)
            .run()
            .map_err(|e| failed(e.to_string()))?;
        let best = outcome.state.get_best_param().ok_or_else(|| failed("no step was made".into()))?;
        let fit = named(best);
        let error = self.error(Shading::Fitted(fit))?;
        if error.is_finite() { Ok((fit, error)) } else { Err(failed(format!("an error of {error}"))) }
    }
}

/// First step of every constant; all are of the order of 1.
const STEP: f64 = 0.2;

impl CostFunction for &Search<'_> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, list: &Vec<f64>) -> Result<f64, argmin::core::Error> {
        Ok(self.error(Shading::Fitted(named(list)))?)
    }
}

/// Where the search begins: the published direction by a power of alpha, the Jacobian of the half
/// vector at low roughness.
const START: LobeFit = LobeFit { lean: [0.9, 1.3, 0.0], narrow: [0.3, 0.5, 0.0], squash: [1.0, 1.0] };

/// Fits for one, two and three fetches; the lobe of one is round.
pub(super) fn fitted(parameters: &Parameters) -> Result<Vec<FittedLobe>, StudyError> {
    let rays = halves(parameters.directions);
    let exact = Patches::new(&parameters.room);
    let points = points::half_on_walls(&parameters.room, &parameters.points);
    let columns: Vec<Column> =
        parameters.roughness.iter().map(|r| column(parameters, r * r, &points, &rays)).collect();
    [(1, 6, LobeFit::ONE), (2, 8, LobeFit::TWO), (3, 8, LobeFit::THREE)]
        .into_iter()
        .map(|(fetches, free, shipped)| {
            let search = Search { parameters, exact: &exact, columns: &columns, fetches };
            let (fit, error) = search.fitted(&START, free)?;
            let of = |shading| search.error(shading);
            Ok(FittedLobe {
                fetches,
                lean: fit.lean,
                narrow: fit.narrow,
                squash: fit.squash,
                error,
                shipped: of(Shading::Fitted(shipped))?,
                emitted: search.error_with(Shading::Fitted(shipped), Width::EMITTED)?,
                mirror: of(Shading::Mirror)?,
                mirror_emitted: search.error_with(Shading::Mirror, Width::EMITTED)?,
                dominant: of(Shading::Dominant)?,
            })
        })
        .collect()
}

fn column(parameters: &Parameters, alpha: f64, points: &[Point], rays: &[GgxRays; 2]) -> Column {
    let seen: Vec<Seen> = points.iter().map(|point| Reference::Surface.seen(point, alpha)).collect();
    let truth = seen.par_iter().map(|seen| {
        let [a, b] = [0, 1].map(|half| rays[half].reflected(&parameters.room, seen));
        scaled(plus(a, b), 0.5)
    });
    Column { truth: truth.collect(), seen }
}
