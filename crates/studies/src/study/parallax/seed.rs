//! The experiment that the idea comes from, read literally.

use std::f64::consts::PI;

use rayon::prelude::*;
use serde::Serialize;

use crate::study::parallax::findings::{SeedCell, SeedFindings, SeedFit, SeedSlant};
use crate::study::{Size, StudyError};
use lobefit::bake::Progress;
use lobefit_truth::integrate::IntegrateError;
use lobefit_truth::optics::kernel::Kernel;
use lobefit_truth::quantity::footprint::window::{Ordinate, WindowFit, fits, ordinate, profile, slanted};

/// What this part covers.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Parameters {
    kernel: Kernel,
    alphas: Vec<f64>,
    distances: Vec<f64>,
    /// Whose curves are drawn.
    drawn: Vec<f64>,
    slants: Vec<f64>,
    slanted_alpha: f64,
}

impl Parameters {
    /// Those of a size.
    pub fn of(size: Size) -> Parameters {
        let (alphas, distances) = match size {
            Size::Full => (vec![0.1, 0.2, 0.36, 0.5, 0.64], vec![0.25, 0.5, 1.0, 1.5, 2.0, 4.0]),
            Size::Reduced => (vec![0.5], vec![1.0, 2.0]),
        };
        Parameters {
            kernel: Kernel::Ndf,
            alphas,
            distances,
            drawn: vec![0.5, 1.0, 2.0, 4.0],
            slants: vec![PI / 6.0, PI / 2.5],
            slanted_alpha: 0.1,
        }
    }
}

/// Runs it.
pub(super) fn findings(parameters: &Parameters, progress: &dyn Progress) -> Result<SeedFindings, StudyError> {
    progress.stage("seed");
    let each = [Ordinate::Value, Ordinate::PerArea]
        .into_iter()
        .flat_map(|o| parameters.alphas.iter().map(move |a| (o, *a)))
        .flat_map(|(o, a)| parameters.distances.iter().map(move |d| (o, a, *d)));
    let cells: Vec<(Ordinate, f64, f64)> = each.collect();
    let cells = cells.into_par_iter().map(|(o, alpha, distance)| cell(parameters, o, alpha, distance));
    let slants = parameters.slants.par_iter().map(|psi| tilted(parameters, *psi));
    Ok(SeedFindings {
        cells: cells.collect::<Result<_, _>>()?,
        slants: slants.collect::<Result<_, IntegrateError>>()?,
    })
}

/// Points of a curve.
const POINTS: u32 = 80;

fn cell(
    parameters: &Parameters,
    plotted: Ordinate,
    alpha: f64,
    distance: f64,
) -> Result<SeedCell, IntegrateError> {
    let kernel = &parameters.kernel;
    let [shifted, plain] = fits(kernel, plotted, alpha, distance)?;
    let x = || (0..=POINTS).map(|i| f64::from(i) / f64::from(POINTS));
    let target = kernel.lobe(alpha);
    let curve = |fit: &WindowFit| {
        let lobe = kernel.lobe(fit.alpha);
        x().map(|x| (x, fit.scale * ordinate(&lobe, plotted, x) + fit.offset)).collect()
    };
    let seen = x().map(|x| (x, ordinate(&target, plotted, x / distance))).collect();
    Ok(SeedCell {
        energy: plotted == Ordinate::PerArea,
        alpha,
        distance,
        shifted: stated(&shifted),
        plain: stated(&plain),
        drawn: plotted == Ordinate::Value && parameters.drawn.contains(&distance),
        curves: [seen, curve(&shifted), curve(&plain)],
    })
}

fn stated(fit: &WindowFit) -> SeedFit {
    let &WindowFit { alpha, scale, offset, error, saturated } = fit;
    SeedFit { alpha, scale, offset, error, saturated }
}

fn tilted(parameters: &Parameters, slant: f64) -> Result<SeedSlant, IntegrateError> {
    let (kernel, alpha) = (parameters.kernel.clone(), parameters.slanted_alpha);
    let fit = slanted(&kernel, alpha, slant)?;
    let points = i64::from(POINTS);
    let line = |width: f64, scale: f64, psi: f64, along: bool| {
        let lobe = kernel.lobe(width);
        let at = |i: i64| {
            // the middle, where both lobes are
            let x = 0.8 * i as f64 / points as f64;
            (x, scale * profile(&lobe, psi, if along { [x, 0.0] } else { [0.0, x] }))
        };
        (-points..=points).map(at).collect()
    };
    let three = |along: bool| {
        [line(alpha, 1.0, slant, along), line(fit.alpha, fit.scale, 0.0, along), line(alpha, 1.0, 0.0, along)]
    };
    Ok(SeedSlant {
        slant: slant * 180.0 / PI,
        alpha,
        best: fit.alpha,
        scale: fit.scale,
        error: fit.error,
        same: fit.same,
        half: fit.half,
        curves: [three(true), three(false)],
    })
}
