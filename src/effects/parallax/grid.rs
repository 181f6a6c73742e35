//! Footprints cell by cell over (roughness, rho): the best fetch, and what another width loses.

use rayon::prelude::*;

use crate::approximate::FitStageError;
use crate::data::AlphaMap;
use lobefit_fit::FitError;
use lobefit_math::ops;
use lobefit_shade::{Hypothesis, ShadeError};
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::optics::kernel::Kernel;
use lobefit_truth::quantity::footprint::{self, Measures, measures};

/// One pair of a roughness and a ratio of distances.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    /// What alpha is made from.
    pub roughness: f64,
    /// GGX width.
    pub alpha: f64,
    /// Distance of the shading point over that of the probe.
    pub rho: f64,
    /// The best width.
    pub best: f64,
    /// Whether a wider lobe than any would be better.
    pub saturated: bool,
    /// What the best width leaves.
    pub least: Measures,
}

/// Cells of evenly spaced roughness and log-spaced ratios, the ratios fastest.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// The lobe that the chain is prefiltered with.
    pub kernel: Kernel,
    /// All cells.
    pub cells: Vec<Cell>,
}

/// What a formula's fetches are off by over some cells: the total variation, and mean and largest
/// of the other measures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// Mean.
    pub mean: f64,
    /// Largest.
    pub max: f64,
    /// Roughness and ratio of the largest.
    pub at: [f64; 2],
    /// Number of cells.
    pub cells: usize,
    /// Mean and largest of [`Measures::l2`].
    pub l2: [f64; 2],
    /// Of [`Measures::max`].
    pub largest: [f64; 2],
    /// Of [`Measures::encircled`].
    pub encircled: [f64; 2],
}

impl Grid {
    /// The grid of a study: `count` roughnesses and ratios between the ends of both, the ends among
    /// them.
    ///
    /// # Errors
    /// A cell outside of the domain of `parallax-alpha`.
    pub fn new(
        kernel: Kernel,
        alpha_map: AlphaMap,
        roughness: [f64; 2],
        rho: [f64; 2],
        count: [usize; 2],
    ) -> Result<Grid, IntegrateError> {
        let lerp = |[low, high]: [f64; 2], t: f64| low + (high - low) * t;
        // the ends are those given, not what their logarithms round to
        let at = |range: [f64; 2], i: usize, n: usize, between: &dyn Fn([f64; 2], f64) -> f64| match i {
            0 => range[0],
            last if last + 1 == n => range[1],
            _ => between(range, i as f64 / (n - 1) as f64).clamp(range[0], range[1]),
        };
        let one = |i: usize| {
            let roughness = at(roughness, i / count[1], count[0], &lerp);
            let geometric = |range: [f64; 2], t: f64| ops::exp2(lerp(range.map(ops::log2), t));
            let rho = at(rho, i % count[1], count[1], &geometric);
            let alpha = alpha_map.alpha(roughness);
            let (best, saturated) = footprint::best(&kernel, alpha, rho)?;
            let least = measures(&kernel, alpha, rho, best)?;
            Ok(Cell { roughness, alpha, rho, best, saturated, least })
        };
        let cells =
            (0..count[0] * count[1]).into_par_iter().map(one).collect::<Result<_, IntegrateError>>()?;
        Ok(Grid { kernel, cells })
    }

    /// The widths that a formula of alpha, roughness and rho gives in every cell, in f32 as a
    /// shader does.
    ///
    /// # Errors
    /// A formula with free parameters beyond `coefficients`, or with other inputs.
    pub fn widths(&self, hypothesis: &Hypothesis, coefficients: &[f32]) -> Result<Vec<f64>, FitError> {
        let column = |name: &String| {
            let of = |cell: &Cell| match name.as_str() {
                "alpha" => Some(cell.alpha as f32),
                "roughness" => Some(cell.roughness as f32),
                "rho" => Some(cell.rho as f32),
                _ => None,
            };
            let unknown = || ShadeError::UnknownInput {
                function: hypothesis.name().into(),
                input: name.clone(),
                given: "alpha, roughness, rho".into(),
            };
            self.cells.iter().map(of).collect::<Option<Vec<f32>>>().ok_or_else(unknown)
        };
        let inputs = hypothesis.inputs().iter().map(column).collect::<Result<Vec<_>, _>>()?;
        Ok(hypothesis.tape().evaluate(&inputs, coefficients)?.into_iter().map(f64::from).collect())
    }

    /// What fetches of these widths, one for each cell, are off by over the cells that are wanted;
    /// `None` where no point is.
    ///
    /// # Errors
    /// A width outside of [1e-12, 1].
    pub fn spread(
        &self,
        widths: &[f64],
        wanted: impl Fn(&Cell) -> bool + Sync,
    ) -> Result<Option<Spread>, FitStageError> {
        let cells: Vec<(&Cell, f64)> = self
            .cells
            .iter()
            .zip(widths)
            .filter(|(cell, _)| wanted(cell))
            .map(|(cell, width)| (cell, *width))
            .collect();
        let one = |(cell, width): &(&Cell, f64)| measures(&self.kernel, cell.alpha, cell.rho, *width);
        let off = cells.par_iter().map(one).collect::<Result<Vec<Measures>, IntegrateError>>()?;
        let of = |measure: fn(&Measures) -> f64| {
            let sum: f64 = off.iter().map(measure).sum();
            [sum / off.len() as f64, off.iter().map(measure).fold(0.0, f64::max)]
        };
        let worst = (0..off.len()).max_by(|a, b| off[*a].tv.total_cmp(&off[*b].tv));
        let [mean, max] = of(|off| off.tv);
        Ok(worst.map(|worst| Spread {
            mean,
            max,
            at: [cells[worst].0.roughness, cells[worst].0.rho],
            cells: off.len(),
            l2: of(|off| off.l2),
            largest: of(|off| off.max),
            encircled: of(|off| off.encircled),
        }))
    }
}
