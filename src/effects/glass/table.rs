//! The tables of this effect, in both layouts.

use super::path_tracer::{axes, grid};
use super::{JUDGED, energies};
use crate::data::{Axis, Channel, Layout, Smith, Table, Warp};
use crate::effects::table::{BuildError, Made, Node, ROUNDS, Spec, TexelPlan, alpha_nodes, check, ior_axis};
use lobefit_truth::integrate::glass::table::{GlassGrid, Tabulated, tabulate_on};
use lobefit_truth::integrate::{IntegrateError, Path};
use lobefit_truth::quantity::Glass;

/// Largest error of a texel of the path tracer's layout.
const SAMPLED: f64 = 1e-6;

/// Largest error of the integrals that the targets of our layout are interpolated from, a hundredth
/// of what the lookup leaves. The targets' own error is measured.
const TARGETS: f64 = 1e-5;

/// Targets drawn for their check.
const CHECKED: usize = 1 << 15;

/// Samples per cell that the texels are optimised on: four from slice to slice, where the error is.
const SAMPLES: [usize; 3] = [2, 1, 4];

/// Axes of one side over the given range of roughness and of ior, in [1, 4]. All register their end
/// points: the ends of every range are texels.
///
/// Towards ior = 1 the loss of a view from inside changes where the refraction that an average
/// facet makes, of the order of (ior - 1) / alpha, exceeds mu, and again where mu passes the
/// critical cosine sqrt(2 (ior - 1)). The slices crowd there; the columns follow the second. From
/// outside it is smoother, and the same axes serve.
pub fn glass_axes(size: [usize; 3], roughness: [f64; 2], ior: [f64; 2]) -> [Axis; 3] {
    [
        Axis::ends("mu", size[0], Warp::HomogeneousIor, [0.0, 1.0]),
        Axis::ends("roughness", size[1], Warp::Linear, roughness),
        ior_axis(size[2], ior),
    ]
}

/// The tables for rays from outside and from inside, which share their integrals; texels not yet
/// rounded.
///
/// Errors: a truth that cannot be integrated; a layout that has no glass.
pub fn build(glass: &dyn Glass, spec: &Spec) -> Result<(Vec<Table>, Made), BuildError> {
    match spec.layout {
        Layout::Optimised => optimised(glass, spec),
        Layout::PathTracer => sampled(glass, spec),
        _ => Err(spec.no_layout()),
    }
}

/// Every texel of the path tracer's layout, within `tolerance`.
pub fn path_tracer(path: Path, smith: Smith, tolerance: f64) -> Result<Tabulated, IntegrateError> {
    let [mu, alphas, iors] = grid();
    let mu_of = |column: usize, _: f64, _: f64| mu[column];
    let grid = GlassGrid { smith, alphas: &alphas, columns: mu.len(), iors: &iors, mu: &mu_of, tolerance };
    tabulate_on(path, &grid)
}

fn sampled(glass: &dyn Glass, spec: &Spec) -> Result<(Vec<Table>, Made), BuildError> {
    let texels = path_tracer(Path::Best, spec.smith, SAMPLED)?;
    let made = Made { evaluations: texels.evaluations, integration: texels.checked.worst };
    let channels = [texels.outside, texels.inside].map(|e| vec![Channel::new("E", e)]);
    Ok((spec.tables(glass.name(), &axes(), channels.to_vec())?, made))
}

fn optimised(glass: &dyn Glass, spec: &Spec) -> Result<(Vec<Table>, Made), BuildError> {
    let Spec { smith, region, .. } = spec;
    let axes = glass_axes(spec.sizes()?, region.roughness, region.slices()?.range);
    let nodes = alpha_nodes(region.roughness.map(|r| region.alpha_map.alpha(r)));
    let plan = TexelPlan::new(axes.clone(), region.alpha_map, SAMPLES, nodes, region.mu[0]);
    let places = plan.points().into_iter().map(|p| [p.alpha, p.mu, p.slice]);
    let (sides, evaluations) = energies((glass, *smith), places, TARGETS)?;
    let wanted = sides.map(|e| plan.targets(&e.iter().map(|e| 1.0 - e).collect::<Vec<f64>>()));
    let checked =
        check(glass.name(), &plan, CHECKED, wanted.each_ref(), |nodes| direct((glass, *smith), nodes))?;
    let channels = wanted.map(|wanted| vec![Channel::new("loss", plan.optimised(&wanted, ROUNDS).0)]);
    let made = Made { evaluations: evaluations + checked.evaluations, integration: checked.worst + JUDGED };
    Ok((spec.tables(glass.name(), &axes, channels.to_vec())?, made))
}

/// Losses from outside and from inside, within [`JUDGED`], and the evaluations that they took.
fn direct(of: (&dyn Glass, Smith), nodes: &[Node]) -> Result<(Vec<[f64; 2]>, u64), IntegrateError> {
    let ([outside, inside], evaluations) =
        energies(of, nodes.iter().map(|p| [p.alpha, p.mu, p.slice]), JUDGED)?;
    Ok((outside.into_iter().zip(inside).map(|(o, i)| [1.0 - o, 1.0 - i]).collect(), evaluations))
}
