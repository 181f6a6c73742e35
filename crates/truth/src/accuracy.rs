//! What accuracy costs offline: every way to compute a quantity, at a point that is easy and at one that is
//! hard. Error against evaluations of the integrand and against seconds, the setting of the path tracer,
//! random walks, and tables.
//!
//! The points are those of the inputs ([`Input::studied`](crate::quantity::Input)), the ways those of the
//! quantity: what it draws by every sequence, its rules, and its truth at falling tolerances.

mod table;

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};

use crate::integrate::count::counted;
use crate::integrate::glass::Side;
use crate::integrate::monte_carlo::{Draw, Points, Run, Sampled};
use crate::integrate::walk::Walks;
use crate::integrate::{IntegrateError, brdf};
use crate::optics::Smith;
use crate::quantity::{Quantity, Specular, Variant};
use lobefit_math::{ops, sum};
pub use table::{Tables, tables};

/// Measures the seconds of one execution.
pub type Clock<'a> = &'a dyn Fn(&mut dyn FnMut()) -> f64;

/// A quantity at a point, with its truth.
#[derive(Debug)]
pub struct Study {
    /// The quantity.
    pub quantity: &'static dyn Quantity,
    /// What is made of it: of glass the hard point is seen from inside.
    pub variant: Variant,
    /// Its inputs.
    pub x: Vec<f64>,
    /// The value by the least tolerance that is reached, and the bound of its error.
    pub truth: [f64; 2],
    /// Tolerances that are reached, falling.
    tolerances: Vec<f64>,
}

/// Error of one way against its work, by settings of rising work.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Curve {
    /// What is drawn, or the name of a quadrature.
    pub way: String,
    /// The sequence that drives what is drawn; none of a quadrature.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sequence: Option<String>,
    /// Evaluations of the integrand; none where they are not counted.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub evaluations: Vec<u64>,
    /// Of what is drawn the root mean square over seeds of the difference to the truth, of a quadrature the
    /// difference; not below the bound of the truth.
    pub error: Vec<f64>,
    /// Seconds of one thread.
    pub seconds: Vec<f64>,
}

/// The setting of the path tracer: 500 000 dispatches of 20 samples, each mean added to an f32.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PathTracer {
    /// Samples.
    pub samples: u64,
    /// Standard error of the mean.
    pub noise: f64,
    /// What the f32 running sum adds: |f32 result - f64 mean of the same samples|.
    pub bias: f64,
    /// Seconds on one thread.
    pub seconds: f64,
}

/// A random walk beside what is drawn for single scattering.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Walk {
    /// The mean that the walk has.
    pub value: f64,
    /// Nanoseconds of a path, and of a sample of visible normals.
    pub nanoseconds: [f64; 2],
    /// Seconds to the same standard error, [`WALKED_TO`], of the walk, of visible normals by Sobol points,
    /// and of the truth by quadrature.
    pub seconds: [f64; 3],
}

/// The standard error that walks are compared at.
pub const WALKED_TO: f64 = 3e-4;

/// Random points by visible normals, or as a quantity draws by itself.
const RANDOM: Run = Run { samples: 0, seed: 1, points: Points::Random, draw: Draw::VisibleNormal };

/// Least power of two of samples, and the step to the next setting.
const LOG2_FIRST: u32 = 8;
const LOG2_STEP: usize = 2;

/// Seeds of which the error is the root mean square.
const SEEDS: u64 = 16;

/// Dispatches of the path tracer's accumulation, and samples of each.
const DISPATCHES: u32 = 500_000;
const PER_DISPATCH: u32 = 20;

/// Least tolerance that is tried.
const LEAST: f64 = 1e-14;

impl Study {
    /// A quantity at its easy or its hard point.
    ///
    /// # Errors
    /// A truth that cannot be integrated there.
    pub fn new(quantity: &'static dyn Quantity, is_hard: bool) -> Result<Study, IntegrateError> {
        let variant = Variant {
            smith: Some(Smith::Correlated),
            side: Some(if is_hard { Side::Inside } else { Side::Outside }),
            specular: Some(Specular::default()),
            kernel: None,
        };
        let variant = variant.of(quantity.choices());
        let x: Vec<f64> = quantity.inputs().iter().map(|input| input.studied[usize::from(is_hard)]).collect();
        let mut study = Study { quantity, variant, x, truth: [0.0; 2], tolerances: Vec::new() };
        let mut tolerance = 0.1;
        while tolerance > LEAST {
            match study.at(tolerance) {
                Ok(truth) => study.truth = truth,
                Err(_) if !study.tolerances.is_empty() => break,
                Err(error) => return Err(error),
            }
            study.tolerances.push(tolerance);
            tolerance *= 0.1;
        }
        Ok(study)
    }

    /// The output that is studied.
    pub fn output(&self) -> &'static str {
        self.quantity.outputs()[self.quantity.studied()]
    }

    /// The value to a tolerance, and the bound of its error.
    fn at(&self, tolerance: f64) -> Result<[f64; 2], IntegrateError> {
        let values = self.quantity.at(&self.variant, &self.x, tolerance)?;
        Ok([values[self.quantity.studied()], values[values.len() - 1]])
    }

    /// The value by Monte Carlo.
    ///
    /// # Errors
    /// As [`Quantity::second_opinion`].
    pub fn sampled(&self, run: Run) -> Result<Sampled, IntegrateError> {
        Ok(self.quantity.second_opinion(&self.variant, &self.x, run)?[self.quantity.studied()])
    }

    /// The error of every way: by up to `2^most` samples, of seconds by a clock. Work is counted on the
    /// thread that calls: let it be a pool's only one.
    ///
    /// # Errors
    /// A way that is refused at the point.
    pub fn curves(&self, most: u32, clock: Clock) -> Result<Vec<Curve>, IntegrateError> {
        let mut curves = Vec::new();
        let draws = self.quantity.draws();
        let own = [Draw::VisibleNormal];
        let has_samples = match self.sampled(Run { samples: 1 << LOG2_FIRST, ..RANDOM }) {
            Err(IntegrateError::NoSecondOpinion { .. }) => false,
            other => other.map(|_| true)?,
        };
        if has_samples {
            for draw in if draws.is_empty() { &own[..] } else { draws } {
                let way = if draws.is_empty() { "own" } else { draw.name() };
                for points in Points::ALL {
                    curves.push(self.drawn(way, Run { draw: *draw, points, ..RANDOM }, most, clock)?);
                }
            }
        }
        for rule in self.quantity.rules(&self.variant, &self.x)? {
            let values = rule.steps.into_iter().map(|step| move || Ok(step()));
            curves.push(self.quadrature(rule.name, values, clock)?);
        }
        let by = |tolerance: &f64| {
            let tolerance = *tolerance;
            move || Ok(self.at(tolerance)?[0])
        };
        curves.push(self.quadrature("to a tolerance", self.tolerances.iter().map(by), clock)?);
        let lobe = match self.quantity.brdf(&self.variant, &self.x) {
            Err(IntegrateError::NoBrdf { .. }) => None,
            other => Some(other?),
        };
        if let Some(lobe) = lobe {
            let mu = self.quantity.inputs().iter().position(|input| input.name == "mu");
            let mu = mu.map_or(1.0, |k| self.x[k]);
            let by = |tolerance: &f64| {
                let (lobe, tolerance) = (&lobe, *tolerance);
                move || Ok(brdf::albedo(self.quantity.name(), lobe, mu, tolerance)?.value)
            };
            let tolerances: Vec<f64> =
                self.tolerances.iter().copied().take_while(|tolerance| by(tolerance)().is_ok()).collect();
            curves.push(self.quadrature("over the hemisphere", tolerances.iter().map(by), clock)?);
        }
        Ok(curves)
    }

    /// |value - truth|, not below the truth's own bound.
    fn off(&self, value: f64) -> f64 {
        (value - self.truth[0]).abs().max(self.truth[1])
    }

    fn drawn(&self, way: &str, run: Run, most: u32, clock: Clock) -> Result<Curve, IntegrateError> {
        let mut curve = Curve::new(way, Some(run.points.name()));
        for log2 in (LOG2_FIRST..=most).step_by(LOG2_STEP) {
            let run = Run { samples: 1 << log2, ..run };
            let by = |seed: u64| Ok(self.sampled(Run { seed, ..run })?.value);
            let values: Vec<f64> = (1..=SEEDS).map(by).collect::<Result<_, IntegrateError>>()?;
            let squares: Vec<f64> =
                values.iter().map(|v| (v - self.truth[0]) * (v - self.truth[0])).collect();
            curve.evaluations.push(run.samples);
            curve.error.push(sum::mean(&squares).sqrt().max(self.truth[1]));
            curve.seconds.push(clock(&mut || {
                let _ = std::hint::black_box(self.sampled(run));
            }));
        }
        Ok(curve)
    }

    /// Settings that do the same work as the one before are left out.
    fn quadrature<F: Fn() -> Result<f64, IntegrateError>>(
        &self,
        way: &str,
        steps: impl Iterator<Item = F>,
        clock: Clock,
    ) -> Result<Curve, IntegrateError> {
        let (mut curve, mut last) = (Curve::new(way, None), None);
        for step in steps {
            let (value, evaluations) = counted(&step);
            let now = Some((value?, evaluations));
            let Some((value, _)) = now.filter(|_| now != last) else { continue };
            last = now;
            if evaluations > 0 {
                curve.evaluations.push(evaluations);
            }
            curve.error.push(self.off(value));
            curve.seconds.push(clock(&mut || {
                let _ = std::hint::black_box(step());
            }));
        }
        Ok(curve)
    }

    /// The path tracer's setting, of a quantity that it has a table of.
    pub fn path_tracer(&self, clock: Clock) -> Option<PathTracer> {
        let trace = self.quantity.traced(&self.variant, &self.x)?;
        let (mut running, mut total, mut squares) = (0.0_f32, 0.0_f64, 0.0_f64);
        let seconds = clock(&mut || {
            let mut random = Pcg64::seed_from_u64(10);
            (running, total, squares) = (0.0, 0.0, 0.0);
            for _ in 0..DISPATCHES {
                let mut mean = 0.0;
                for _ in 0..PER_DISPATCH {
                    let kept = trace(random.random());
                    (mean, squares) = (mean + kept, squares + kept * kept);
                }
                total += mean;
                running += (mean / f64::from(PER_DISPATCH)) as f32;
            }
        });
        let samples = f64::from(DISPATCHES) * f64::from(PER_DISPATCH);
        let mean = total / samples;
        Some(PathTracer {
            samples: samples as u64,
            noise: ((squares / samples - mean * mean).max(0.0) / samples).sqrt(),
            bias: (f64::from(running) / f64::from(DISPATCHES) - mean).abs(),
            seconds,
        })
    }

    /// The random walk beside samples and quadrature; none where there is no walk.
    ///
    /// # Errors
    /// A walk that is refused at the point.
    pub fn walk(&self, clock: Clock) -> Option<Result<Walk, IntegrateError>> {
        let by = |paths: u64| self.quantity.walked(&self.x, Walks { paths, seed: 1 });
        Some(by(1 << LOG2_FIRST)?.and_then(|_| {
            let refused = IntegrateError::NoSecondOpinion { quantity: self.quantity.name() };
            let [value, path, walk] = reached(&|paths| by(paths).ok_or_else(|| refused.clone())?, clock)?;
            let sampled = |samples: u64| self.sampled(Run { samples, points: Points::Sobol, ..RANDOM });
            let [_, sample, drawn] = reached(&sampled, clock)?;
            let quadrature = clock(&mut || {
                let _ = std::hint::black_box(self.at(WALKED_TO));
            });
            let nanoseconds = [path, sample].map(|seconds| 1e9 * seconds);
            Ok(Walk { value, nanoseconds, seconds: [walk, drawn, quadrature] })
        }))
    }
}

/// The mean of samples, seconds of each, and seconds to [`WALKED_TO`]: by so many that the standard error is
/// below, and fewer in proportion to its square.
fn reached(
    by: &dyn Fn(u64) -> Result<Sampled, IntegrateError>,
    clock: Clock,
) -> Result<[f64; 3], IntegrateError> {
    let mut samples = 1 << LOG2_FIRST;
    let mut found = by(samples)?;
    while found.standard_error > WALKED_TO {
        samples *= 2;
        found = by(samples)?;
    }
    let seconds = clock(&mut || {
        let _ = std::hint::black_box(by(samples));
    });
    let part = found.standard_error / WALKED_TO;
    Ok([found.value, seconds / samples as f64, seconds * part * part])
}

/// Times the longest run: an order that was fitted to some settings says nothing of what takes longer.
pub const FARTHEST: f64 = 1e3;

impl Curve {
    fn new(way: &str, sequence: Option<&str>) -> Curve {
        let (error, seconds) = (Vec::new(), Vec::new());
        Curve { way: way.into(), sequence: sequence.map(Into::into), evaluations: Vec::new(), error, seconds }
    }

    /// The order of convergence p, of error like 1/n^p in n evaluations: the slope of the line of least
    /// squares through the logarithms, of settings whose error is above a bound; none of fewer than two, or
    /// of work that is not counted.
    pub fn order(&self, above: f64) -> Option<f64> {
        let all = self.evaluations.iter().zip(&self.error).filter(|(_, error)| **error > above);
        let (x, y): (Vec<f64>, Vec<f64>) = all.map(|(n, e)| (ops::log(*n as f64), ops::log(*e))).unzip();
        let [mx, my] = [&x, &y].map(|values| sum::mean(values));
        let square: f64 = x.iter().map(|x| (x - mx) * (x - mx)).sum();
        let cross: f64 = x.iter().zip(&y).map(|(x, y)| (x - mx) * (y - my)).sum();
        (x.len() > 1 && square > 0.0).then_some(-cross / square)
    }

    /// Seconds to an error: between settings, or beyond the last by its order, which the second value says,
    /// up to [`FARTHEST`] times as long; of a quadrature those of the first setting within it.
    pub fn seconds_to(&self, error: f64) -> Option<(f64, bool)> {
        let i = self.error.iter().position(|found| *found <= error);
        if self.sequence.is_none() || i == Some(0) {
            return Some((self.seconds[i?], false));
        }
        let last = self.error.len() - 1;
        let at = i.unwrap_or(last);
        let order = match i {
            Some(i) => {
                ops::log(self.error[i - 1] / self.error[i]) / ops::log(self.seconds[i] / self.seconds[i - 1])
            }
            None => self.order(0.0)?,
        };
        let seconds = self.seconds[at] * ops::pow(self.error[at] / error, 1.0 / order);
        (seconds <= FARTHEST * self.seconds[last]).then_some((seconds, i.is_none()))
    }
}
