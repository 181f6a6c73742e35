//! Functions of a chain's levels, measured against the levels that hold the best widths.

use super::catalogue::BIAS;
use super::grid::{Cell, Grid};
use super::{named, source};
use crate::approximate::{Fit, FitStageError, searched};
use crate::data::{AlphaMap, LOG_SCALE, MipChain, MipMap, Norm, Place, shortest};
use lobefit_fit::{FitError, Options, Samples};
use lobefit_math::ops;
use lobefit_shade::{Domain, Hypothesis, ShadeError, round_up};

/// What a function gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gives {
    /// The level that holds a roughness.
    Level,
    /// The roughness of a level.
    Roughness,
    /// The level to fetch, from the level of the lobe and the ratio of distances.
    Adjusted,
    /// Levels to add, from the width of the lobe and the ratio.
    Bias,
}

impl Gives {
    /// The word used in the manifest.
    pub fn name(self) -> &'static str {
        match self {
            Gives::Level => "mip",
            Gives::Roughness => "roughness",
            Gives::Adjusted => "adjusted-mip",
            Gives::Bias => "mip-bias",
        }
    }
}

/// Largest error, in levels.
#[derive(Clone, Debug, PartialEq)]
pub struct LevelError {
    /// Rounded up in its fourth digit.
    pub max: f64,
    /// Where it is.
    pub at: Place,
    /// Points measured.
    pub points: usize,
}

/// A function of a chain.
#[derive(Clone, Debug, PartialEq)]
pub struct LevelFunction {
    /// The formula.
    pub hypothesis: Hypothesis,
    /// Its coefficients.
    pub coefficients: Vec<f32>,
    /// What it gives.
    pub gives: Gives,
    /// The chain.
    pub chain: MipChain,
    /// Its error in f32: of `mip` against the map itself, of `roughness` of the way there and back,
    /// of `adjusted-mip` and `mip-bias` against the level that holds the best width, over the cells
    /// of a grid that are not saturated.
    pub error: LevelError,
}

/// Levels and roughness at which maps are measured.
const STEPS: usize = 4096;

/// The file name of a function that is written here, for messages.
const FILE: &str = "parallax_chain.wgsl";

/// The functions of a chain: its map, the inverse, and the level to fetch by a fit of the width.
/// `identifier` tells it from other chains.
///
/// # Errors
/// A fit whose source cannot be composed with these, a defect.
pub fn of_chain(
    chain: &MipChain,
    identifier: &str,
    map: AlphaMap,
    fit: &Fit,
    grid: &Grid,
) -> Result<Vec<LevelFunction>, FitStageError> {
    let parse = |text: String| Hypothesis::parse(FILE, &text);
    let level = parse(source::level(&format!("parallax_level_{identifier}"), chain))?;
    let inverse = parse(source::roughness(&format!("parallax_roughness_{identifier}"), chain))?;
    let name = named(&grid.kernel, &format!("parallax_mip_{identifier}"));
    let adjusted = parse(source::adjusted(&name, chain, map, fit))?.in_one_piece()?;
    let of_level = level_error(&level, chain)?;
    let there_and_back = round_trip(&level, &inverse, chain)?;
    let of_adjusted = adjusted_error(&adjusted, &fit.coefficients(), chain, map, grid)?;
    let function = |hypothesis, coefficients, gives, error| LevelFunction {
        hypothesis,
        coefficients,
        gives,
        chain: chain.clone(),
        error,
    };
    Ok(vec![
        function(level, Vec::new(), Gives::Level, of_level),
        function(inverse, Vec::new(), Gives::Roughness, there_and_back),
        function(adjusted, fit.coefficients(), Gives::Adjusted, of_adjusted),
    ])
}

fn level_error(level: &Hypothesis, chain: &MipChain) -> Result<LevelError, FitError> {
    let inputs: Vec<f32> = (0..=STEPS).map(|i| i as f32 / STEPS as f32).collect();
    let found = level.tape().evaluate(std::slice::from_ref(&inputs), &[])?;
    let off = inputs.iter().zip(&found).map(|(r, f)| f64::from(*f) - chain.level(f64::from(*r)));
    worst(off, |i| [("roughness".to_string(), shortest(inputs[i]))].into_iter().collect())
}

fn round_trip(level: &Hypothesis, inverse: &Hypothesis, chain: &MipChain) -> Result<LevelError, FitError> {
    let step = chain.widest() / STEPS as f64;
    let mips: Vec<f32> = (0..=STEPS).map(|i| (i as f64 * step) as f32).collect();
    let there = inverse.tape().evaluate(std::slice::from_ref(&mips), &[])?;
    let back = level.tape().evaluate(&[there], &[])?;
    let off = mips.iter().zip(&back).map(|(m, b)| f64::from(*b) - f64::from(*m));
    worst(off, |i| [("mip".to_string(), shortest(mips[i]))].into_iter().collect())
}

/// Cells that a chain holds and that one fetch can serve.
fn held<'a>(grid: &'a Grid, chain: &'a MipChain) -> impl Iterator<Item = &'a Cell> {
    let same = |cell: &&Cell| (chain.roughness(chain.level(cell.roughness)) - cell.roughness).abs() < 1e-9;
    grid.cells.iter().filter(|cell| !cell.saturated).filter(same)
}

fn adjusted_error(
    adjusted: &Hypothesis,
    coefficients: &[f32],
    chain: &MipChain,
    map: AlphaMap,
    grid: &Grid,
) -> Result<LevelError, FitError> {
    let cells: Vec<&Cell> = held(grid, chain).collect();
    let mips: Vec<f32> = cells.iter().map(|cell| chain.level(cell.roughness) as f32).collect();
    let rho: Vec<f32> = cells.iter().map(|cell| cell.rho as f32).collect();
    let found = adjusted.tape().evaluate(&[mips.clone(), rho.clone()], coefficients)?;
    let off = cells
        .iter()
        .zip(&found)
        .map(|(cell, found)| f64::from(*found) - chain.level(map.roughness(cell.best)));
    let at = |i: usize| [("mip", mips[i]), ("rho", rho[i])].map(|(name, x)| (name.to_string(), shortest(x)));
    worst(off, |i| at(i).into_iter().collect())
}

/// The levels to add in logarithmic chains, fitted for the smallest error in levels; none where no
/// chain is logarithmic.
///
/// # Errors
/// A search that does not end in a minimum.
pub fn bias(chains: &[MipChain], map: AlphaMap, grid: &Grid) -> Result<Option<LevelFunction>, FitStageError> {
    let logarithmic = |chain: &&MipChain| matches!(chain, MipChain::Mapped { map: MipMap::Log, .. });
    let Some(chain) = chains.iter().find(logarithmic) else { return Ok(None) };
    let hypothesis = Hypothesis::parse(BIAS[0].file, BIAS[0].source)?;
    let cells: Vec<&Cell> = grid.cells.iter().filter(|cell| !cell.saturated).collect();
    let target: Vec<f64> = cells
        .iter()
        .map(|cell| LOG_SCALE * ops::log2(map.roughness(cell.best) / map.roughness(cell.alpha)))
        .collect();
    let inputs = [|cell: &Cell| cell.alpha, |cell: &Cell| cell.rho];
    let columns = inputs.map(|input| cells.iter().map(|cell| f64::from(input(cell) as f32)).collect());
    let samples =
        Samples { inputs: columns.to_vec(), scale: vec![1.0; target.len()], target: target.clone() };
    let coefficients =
        searched(&hypothesis, Norm::Max, (&samples, &[]), &domain(grid)?, (&Options::new(Norm::Max), 0.0))?;
    let single: Vec<Vec<f32>> =
        samples.inputs.iter().map(|column| column.iter().map(|x| *x as f32).collect()).collect();
    let values = hypothesis.tape().evaluate(&single, &coefficients)?;
    let off = values.iter().zip(&target).map(|(value, target)| f64::from(*value) - target);
    let at = |i: usize| {
        [("alpha", cells[i].alpha), ("rho", cells[i].rho)].map(|(n, x)| (n.to_string(), shortest(x as f32)))
    };
    let error = worst(off, |i| at(i).into_iter().collect())?;
    let hypothesis = hypothesis.renamed(&named(&grid.kernel, hypothesis.name()));
    let (gives, chain) = (Gives::Bias, chain.clone());
    Ok(Some(LevelFunction { hypothesis, coefficients, gives, chain, error }))
}

/// The box of a grid's cells.
fn domain(grid: &Grid) -> Result<Domain, ShadeError> {
    let hull = |of: fn(&Cell) -> f64| {
        let values = grid.cells.iter().map(of);
        (values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max))
    };
    let ((a0, a1), (r0, r1)) = (hull(|cell| cell.alpha), hull(|cell| cell.rho));
    Domain::new(&[("alpha", a0, a1), ("rho", r0, r1)])
}

/// The largest of some differences, with its place.
///
/// # Errors
/// There is no difference: nothing is measured, and nothing is known of the function.
fn worst(off: impl Iterator<Item = f64>, place: impl Fn(usize) -> Place) -> Result<LevelError, FitError> {
    let off: Vec<f64> = off.map(f64::abs).collect();
    let Some(at) = (0..off.len()).max_by(|a, b| off[*a].total_cmp(&off[*b])) else {
        let message = "no fetch that is not saturated has its roughness in the chain of levels".into();
        return Err(FitError::Solver { message });
    };
    Ok(LevelError { max: round_up(off[at], 4), at: place(at), points: off.len() })
}
