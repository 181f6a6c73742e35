//! The tables of this effect, in both layouts.

use super::{JUDGED, QUANTITY, energies, path_tracer};
use crate::data::{Layout, Smith, Table};
use crate::effects::table::{
    BuildError, GLASS_SAMPLES, Made, Node, ROUNDS, Spec, TexelPlan, alpha_nodes, channel, check, glass_axes,
};
use lobefit_truth::integrate::glass::table::{GlassGrid, Tabulated, tabulate_on};
use lobefit_truth::integrate::{IntegrateError, Path};

/// Largest error of a texel of the sources' layout.
const SAMPLED: f64 = 1e-6;

/// Largest error of the integrals that the targets of our layout are interpolated from, a hundredth of what the lookup leaves. The
/// targets' own error is measured.
const TARGETS: f64 = 1e-5;

/// Targets drawn for their check.
const CHECKED: usize = 1 << 15;

/// The tables for rays from outside and from inside, which share their integrals; texels not yet rounded. `specs` differ in their names.
///
/// Errors: a truth that cannot be integrated; a layout that has no glass.
pub fn build(specs: &[Spec; 2]) -> Result<([Table; 2], Made), BuildError> {
    match specs[0].layout {
        Layout::Optimised => optimised(specs),
        Layout::PathTracer => sampled(specs),
        other @ (Layout::Azimuth | Layout::Homogeneous | Layout::Plain | Layout::PlainSquared) => {
            Err(BuildError::Layout { table: specs[0].name.clone(), layout: other.name() })
        }
    }
}

/// Every texel of the sources' layout, within `tolerance`.
pub fn sources(path: Path, smith: Smith, tolerance: f64) -> Result<Tabulated, IntegrateError> {
    let [mu, alphas, iors] = path_tracer::grid();
    let mu_of = |column: usize, _: f64, _: f64| mu[column];
    let grid = GlassGrid { smith, alphas: &alphas, columns: mu.len(), iors: &iors, mu: &mu_of, tolerance };
    tabulate_on(path, &grid)
}

fn sampled(specs: &[Spec; 2]) -> Result<([Table; 2], Made), BuildError> {
    let texels = sources(Path::Best, specs[0].smith, SAMPLED)?;
    let made = Made { evaluations: texels.evaluations, integration: texels.checked.worst };
    let table = |spec: &Spec, texels| spec.table(QUANTITY, path_tracer::axes(), vec![channel("E", texels)]);
    Ok(([table(&specs[0], texels.outside)?, table(&specs[1], texels.inside)?], made))
}

fn optimised(specs: &[Spec; 2]) -> Result<([Table; 2], Made), BuildError> {
    let Spec { smith, size, region, .. } = &specs[0];
    let axes = glass_axes(*size, region.roughness, region.slices.range);
    let nodes = alpha_nodes(region.roughness.map(|r| region.alpha_map.alpha(r)));
    let plan = TexelPlan::new(axes.clone(), region.alpha_map, GLASS_SAMPLES, nodes, region.mu[0]);
    let inputs: Vec<[f64; 3]> = plan.points().iter().map(|p| [p.alpha, p.mu, p.slice]).collect();
    let (both, evaluations) = energies(*smith, &inputs, TARGETS)?;
    let wanted = [0, 1].map(|side| {
        let losses: Vec<f64> = both.iter().map(|e| 1.0 - e[side]).collect();
        plan.targets(&losses)
    });
    let checked = check(QUANTITY, &plan, CHECKED, wanted.each_ref(), |nodes| direct(*smith, nodes))?;
    let table = |side: usize| {
        let texels = plan.optimised(&wanted[side], ROUNDS).0;
        specs[side].table(QUANTITY, axes.clone(), vec![channel("loss", texels)])
    };
    let made = Made { evaluations: evaluations + checked.evaluations, integration: checked.worst + JUDGED };
    Ok(([table(0)?, table(1)?], made))
}

/// Losses from outside and from inside, within [`JUDGED`], and the evaluations that they took.
fn direct(smith: Smith, nodes: &[Node]) -> Result<(Vec<[f64; 2]>, u64), IntegrateError> {
    let inputs: Vec<[f64; 3]> = nodes.iter().map(|p| [p.alpha, p.mu, p.slice]).collect();
    let (both, evaluations) = energies(smith, &inputs, JUDGED)?;
    Ok((both.into_iter().map(|e| e.map(|e| 1.0 - e)).collect(), evaluations))
}
