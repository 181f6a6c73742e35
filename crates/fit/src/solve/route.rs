//! From stage to stage: least squares from all starts, then p-norms, then linear programs.

use rayon::prelude::*;

use super::bounds::Bounds;
use super::constrained::constrained;
use super::descent::{Descent, Problem};
use super::escape::{LOWER, beside, escaped};
use super::fitted::{Gap, Method, SecondOrder, Stage, Termination};
use super::global::{global, seed};
use super::levenberg::{End, Search, search};
use super::objective::Objective;
use super::options::{Goal, Options};
use super::power::PNorm;
use super::samples::digits;
use super::starts::{starts, turned};
use crate::FitError;

/// Samples that the first search from each start sees; the best then see all.
const COARSE: usize = 1536;

/// Starts whose search is carried on with all samples.
const FINALISTS: usize = 3;

/// Residuals below this part of the targets are zero.
const ZERO: f64 = 1e-14;

/// Coefficients, and how they were come by.
pub(super) struct Route {
    pub coefficients: Vec<f64>,
    pub termination: Termination,
    pub second_order: SecondOrder,
    pub stages: Vec<Stage>,
    pub evaluations: u64,
    pub gap: Gap,
    pub bound: Option<f64>,
}

impl Route {
    /// Coefficients that were not searched for.
    pub fn unmoved(coefficients: Vec<f64>, termination: Termination) -> Route {
        let stages = Vec::new();
        let second_order = SecondOrder::Unused;
        Route {
            coefficients,
            termination,
            second_order,
            stages,
            evaluations: 0,
            gap: Gap::Unknown,
            bound: None,
        }
    }
}

/// The best coefficients for a goal.
pub(super) fn route(
    objective: &Objective,
    bounds: Option<&mut Bounds>,
    declared: &[f64],
    options: &Options,
) -> Result<Route, FitError> {
    let searches = searches(objective, declared, options)?;
    if let Some(bounds) = bounds {
        let start = &searches[0];
        bounds.balance(&start.coefficients, &start.norms);
        if let Some(best) = proven(objective, Some(bounds), &searches, options) {
            return Ok(best);
        }
        return constrained(objective, bounds, &searches, declared, options, FINALISTS);
    }
    match options.goal {
        Goal::Rms => Ok(least_squares(&searches)),
        Goal::Power(p) => power(objective, &searches, p, options),
        Goal::Max => proven(objective, None, &searches, options)
            .map_or_else(|| minimax(objective, &searches, options), Ok),
    }
}

/// The globally best coefficients, where the goal is the largest residual and the formula has a
/// form that allows it.
///
/// Where parameters coincide, or the formula reproduces its targets, least squares has said all
/// there is to say.
fn proven(
    objective: &Objective,
    bounds: Option<&Bounds>,
    searches: &[Search],
    options: &Options,
) -> Option<Route> {
    let best = &searches[0];
    if options.goal != Goal::Max
        || matches!(end(best), Termination::RankDeficient { .. } | Termination::ZeroResidual)
    {
        return None;
    }
    let mut route = global(objective, bounds, &best.coefficients)?;
    if !route.termination.is_converged() {
        return None;
    }
    route.stages.insert(0, stage(Method::LeastSquares, best));
    route.evaluations += searches.iter().map(|s| s.evaluations).sum::<u64>();
    Some(route)
}

/// Least-squares searches from all starts: on a subset first, the best carried on; best first.
fn searches(objective: &Objective, declared: &[f64], options: &Options) -> Result<Vec<Search>, FitError> {
    let mut starts = starts(declared, options.starts, options.spread);
    if options.starts > 1 {
        starts.extend(turned(objective.tape, declared));
    }
    let coarse = objective.samples.subset(COARSE.max(8 * declared.len()));
    let rough = Objective::new(objective.tape, &coarse)?;
    let first = run(&rough, &starts, options.iterations)?;
    let mut all = if coarse.len() == objective.samples.len() {
        first
    } else {
        let best = first.iter().take(FINALISTS).map(|s| s.coefficients.clone());
        let carried: Vec<Vec<f64>> = best.chain(std::iter::once(declared.to_vec())).collect();
        run(objective, &carried, options.iterations)?
    };
    if all.is_empty()
        && let Some(seed) = seed(objective)
    {
        // Poles at the declared values are none of a quotient's best coefficients.
        all = run(objective, &[seed], options.iterations)?;
    }
    let Some(best) = all.first() else { return Err(refused(objective, declared)) };
    all[0] = escaped(objective, best.clone(), PNorm::SQUARE, options)?;
    Ok(all)
}

/// Searches from every start that is not refused, sorted by (rms, order of start).
fn run(objective: &Objective, starts: &[Vec<f64>], iterations: u64) -> Result<Vec<Search>, FitError> {
    let outcomes: Vec<Result<Result<Search, _>, FitError>> =
        starts.par_iter().map(|start| search(objective, start, PNorm::SQUARE, iterations)).collect();
    let mut searches = Vec::new();
    for outcome in outcomes {
        // A refused start is one fewer; that all are refused is the caller's to report.
        searches.extend(outcome?.ok());
    }
    searches.sort_by(|a: &Search, b: &Search| a.rms.total_cmp(&b.rms));
    Ok(searches)
}

/// Why a start was refused: the operation that leaves the reals, or the divisor with a pole among
/// the samples, with the inputs there.
pub(super) fn refused(objective: &Objective, start: &[f64]) -> FitError {
    let (tape, samples) = (objective.tape, objective.samples);
    let index = objective.linearise(start).err().map_or(0, |r| r.sample);
    let inputs = |index: usize| -> Vec<f64> { samples.inputs.iter().map(|column| column[index]).collect() };
    let told = |index: usize| {
        let named =
            tape.inputs().iter().zip(inputs(index)).map(|(name, x)| format!("{name} = {}", digits(x)));
        named.collect::<Vec<_>>().join(", ")
    };
    let function = tape.function().to_string();
    let mut values: Vec<f64> = Vec::with_capacity(tape.ops().len());
    for (node, op) in tape.ops().iter().enumerate() {
        let value = op.evaluate(&inputs(index), start, &values);
        if !value.is_finite() {
            let place = Box::new(tape.place(node as u32).clone());
            return FitError::Undefined { place, function, value, at: told(index) };
        }
        values.push(value);
    }
    if let Some(parameter) = tape.gradient_at(&inputs(index), start).iter().position(|g| !g.is_finite()) {
        let message = format!(
            "{function}: its derivative by parameter {parameter} (counted from 0) is not finite at {}",
            told(index)
        );
        return FitError::Solver { message };
    }
    match objective.pole(start) {
        Some((divisor, index)) => {
            FitError::PoleAtStart { place: Box::new(tape.place(divisor).clone()), function, at: told(index) }
        }
        None => FitError::Solver {
            message: format!("{function}: no start could be evaluated near {}", told(index)),
        },
    }
}

/// Whether a root mean square residual is nothing beside the targets.
pub(super) fn is_zero(objective: &Objective, rms: f64) -> bool {
    rms <= ZERO * PNorm::SQUARE.of(&objective.samples.target)
}

fn end(search: &Search) -> Termination {
    let parameters = search.coefficients.len();
    match search.end {
        End::Minimum { .. } | End::Zero if search.rank < parameters => {
            Termination::RankDeficient { rank: search.rank }
        }
        End::Minimum { cosine } => Termination::Converged { cosine },
        End::Zero => Termination::ZeroResidual,
        End::Stalled { .. } => Termination::Stalled,
        End::Saddle => Termination::Saddle,
        End::Cap => Termination::IterationCap,
    }
}

fn stage(method: Method, search: &Search) -> Stage {
    Stage { method, end: end(search), max: search.max, rms: search.rms }
}

fn least_squares(searches: &[Search]) -> Route {
    // `searches` is sorted and not empty.
    let best = &searches[0];
    Route {
        coefficients: best.coefficients.clone(),
        termination: end(best),
        second_order: best.second_order,
        stages: vec![stage(Method::LeastSquares, best)],
        evaluations: searches.iter().map(|s| s.evaluations).sum(),
        gap: Gap::Unknown,
        bound: None,
    }
}

/// The powers from 2, exclusive, to `p`, each twice the one before: a norm's minimum is a good
/// start for the next.
pub(super) fn ladder(p: f64) -> Vec<f64> {
    let mut powers: Vec<f64> =
        std::iter::successors(Some(4.0), |q| Some(2.0 * q)).take_while(|q| *q < p).collect();
    if p > 2.0 {
        powers.push(p);
    }
    powers
}

/// Searches in ever larger powers from a least-squares fit; the last is in power `p`.
fn climb(
    objective: &Objective,
    from: &Search,
    p: f64,
    options: &Options,
) -> Result<Vec<(Method, Search)>, FitError> {
    let mut climbed = vec![(Method::LeastSquares, from.clone())];
    for q in ladder(p) {
        let Some((_, last)) = climbed.last() else { break };
        let next = search(objective, &last.coefficients, PNorm(q), options.iterations)?;
        climbed.push((Method::Power(q), next.map_err(|_| refused(objective, &from.coefficients))?));
    }
    if let Some((Method::Power(q), last)) = climbed.last_mut() {
        *last = escaped(objective, last.clone(), PNorm(*q), options)?;
    }
    Ok(climbed)
}

/// The smallest p-norm reached from the finalists of the least-squares searches.
fn power(objective: &Objective, searches: &[Search], p: f64, options: &Options) -> Result<Route, FitError> {
    let finalists = &searches[..searches.len().min(FINALISTS)];
    let climbs: Vec<_> = finalists.par_iter().map(|search| climb(objective, search, p, options)).collect();
    let climbs = climbs.into_iter().collect::<Result<Vec<_>, FitError>>()?;
    let reached = |climb: &[(Method, Search)]| climb.last().map_or(f64::INFINITY, |(_, s)| s.value);
    let mut best = &climbs[0];
    for climb in &climbs {
        if reached(climb) < reached(best) {
            best = climb;
        }
    }
    let climbing = climbs.iter().flatten().map(|(_, s)| s.evaluations).sum::<u64>();
    let (_, last) = &best[best.len() - 1];
    Ok(Route {
        coefficients: last.coefficients.clone(),
        termination: end(last),
        second_order: last.second_order,
        stages: best.iter().map(|(method, search)| stage(*method, search)).collect(),
        evaluations: searches.iter().skip(finalists.len()).map(|s| s.evaluations).sum::<u64>() + climbing,
        gap: Gap::Unknown,
        bound: None,
    })
}

/// The best minimax descent from the finalists of the least-squares searches.
///
/// No p-norm stage between: measured on six rational forms of 4 to 10 parameters, disguised so that
/// only this route serves them, the descents end at the proven optimum from least squares already,
/// and a climb to p = 64 takes 2 to 4 times as long as they do.
fn minimax(objective: &Objective, searches: &[Search], options: &Options) -> Result<Route, FitError> {
    let finalists = &searches[..searches.len().min(FINALISTS)];
    let descents: Vec<_> = finalists
        .par_iter()
        .map(|search| {
            let (bounds, norm, weight, iterations) = (None, None, 1.0, options.iterations);
            Problem { objective, bounds, norm, weight, iterations }.descend(&search.coefficients)
        })
        .collect();
    let mut evaluations: u64 = searches.iter().map(|s| s.evaluations).sum();
    let mut best: Option<(usize, Descent)> = None;
    for (index, descent) in descents.into_iter().enumerate() {
        // A finalist has been evaluated before: it cannot be refused now.
        let Ok(descent) = descent else { continue };
        evaluations += descent.evaluations;
        if best.as_ref().is_none_or(|(_, b)| descent.max < b.max) {
            best = Some((index, descent));
        }
    }
    let Some((index, best)) = best else { return Err(refused(objective, &searches[0].coefficients)) };
    let (best, spent, saddle) = off_saddles(objective, best, options);
    evaluations += spent;
    let termination = match end(&searches[index]) {
        Termination::RankDeficient { rank } if best.optimal && !saddle => Termination::RankDeficient { rank },
        Termination::ZeroResidual => Termination::ZeroResidual,
        _ if saddle => Termination::Saddle,
        _ if best.optimal => Termination::Minimax,
        _ if best.capped => Termination::IterationCap,
        _ => Termination::Stalled,
    };
    let first = stage(Method::LeastSquares, &searches[index]);
    let last = Stage { method: Method::Programs, end: termination, max: best.max, rms: best.rms };
    let (stages, gap) = (vec![first, last], Gap::Local(best.gap));
    let (coefficients, second_order) = (best.coefficients, SecondOrder::Unused);
    Ok(Route { coefficients, termination, second_order, stages, evaluations, gap, bound: None })
}

/// The descent, or a better one from beside its end, where the first order holds it in fewer
/// directions than there are; the evaluations of those that were tried; and whether it comes from
/// one saddle more than the options allow, so that beside it nobody has looked.
fn off_saddles(objective: &Objective, from: Descent, options: &Options) -> (Descent, u64, bool) {
    let (mut at, mut evaluations, iterations) = (from, 0, options.iterations);
    for _ in 0..=options.saddles {
        let points = if at.optimal && at.max > 0.0 {
            beside(objective, None, &at.coefficients, Goal::Max)
        } else {
            Vec::new()
        };
        let descents: Vec<Descent> = points
            .par_iter()
            .take(FINALISTS)
            .filter_map(|point| {
                let (bounds, norm, weight) = (None, None, 1.0);
                Problem { objective, bounds, norm, weight, iterations }.descend(point).ok()
            })
            .collect();
        evaluations += descents.iter().map(|d| d.evaluations).sum::<u64>();
        let lowest = descents.into_iter().reduce(|a, b| if b.max < a.max { b } else { a });
        match lowest.filter(|lowest| lowest.max < at.max * (1.0 - LOWER)) {
            Some(lowest) => at = lowest,
            None => return (at, evaluations, false),
        }
    }
    let saddle = at.optimal && at.max > 0.0;
    (at, evaluations, saddle)
}
