//! The tables of this effect, in all layouts.

use rayon::prelude::*;

use super::Azimuth;
use super::QUANTITY;
use super::path_tracer::{FLOOR, axes, grid};
use super::truth::{View, energies};
use crate::data::{Axis, Channel, Layout, Smith, Surface, Table, Warp};
use crate::effects::table::{BuildError, Made, Node, ROUNDS, Spec, TexelPlan, alpha_nodes, aspect, check};
use lobefit_truth::integrate::aniso::fast::{Many, Place, many, one};
use lobefit_truth::integrate::{IntegrateError, Path};

/// Largest error of a texel of the path tracer's layout.
const SAMPLED: f64 = 1e-6;

/// Largest error of the integrals that the targets of our layout are interpolated from, a hundredth
/// of what the lookup leaves. The targets' own error is measured.
const TARGETS: f64 = 1e-5;

/// Largest error of E at the samples of a cubic of the azimuth.
const AZIMUTH: f64 = 1e-5;

/// Targets drawn for their check.
const CHECKED: usize = 1 << 13;

/// Tolerance of the integrals that targets are compared with.
const DIRECT: f64 = 1e-6;

/// Samples per cell that the texels of the azimuth mean are optimised on.
const SAMPLES: [usize; 3] = [2, 2, 2];

/// Axes of the azimuth mean over the given range of roughness and of anisotropy, in [0, 1]. All
/// register their end points: the ends of every range are texels.
///
/// The columns follow the layer mu ~ alpha, with alpha the geometric mean of alpha_x and alpha_y.
pub fn aniso_axes(size: [usize; 3], roughness: [f64; 2], anisotropy: [f64; 2]) -> [Axis; 3] {
    let axis = |i: usize, name: &str, warp: Warp, range| Axis::ends(name, size[i], warp, range);
    [
        axis(0, "mu", Warp::Homogeneous, [0.0, 1.0]),
        axis(1, "roughness", Warp::Linear, roughness),
        axis(2, "anisotropy", Warp::Aspect, anisotropy),
    ]
}

/// Axes of the table with the azimuth: those of [`aniso_axes`], the columns looked up with the
/// alpha towards the view, [`Azimuth::alpha`], in place of alpha. E at one column then hardly
/// depends on the azimuth for small alpha.
pub fn azimuth_axes(size: [usize; 3], roughness: [f64; 2], anisotropy: [f64; 2]) -> [Axis; 3] {
    let [_, rows, slices] = aniso_axes(size, roughness, anisotropy);
    [Axis::ends("mu", size[0], Warp::HomogeneousAzimuth, [0.0, 1.0]), rows, slices]
}

/// The table, its texels not yet rounded.
///
/// Errors: a truth that cannot be integrated.
pub fn build(spec: &Spec) -> Result<(Vec<Table>, Made), BuildError> {
    match spec.layout {
        Layout::Optimised => optimised(spec),
        Layout::PathTracer => sampled(spec),
        Layout::Azimuth => with_azimuth(spec),
        _ => Err(spec.no_layout()),
    }
}

/// Every texel of the path tracer's layout, within `tolerance`.
pub fn path_tracer(path: Path, smith: Smith, tolerance: f64) -> Result<Many, IntegrateError> {
    let [mus, alphas, aspects] = grid();
    let mut places = Vec::with_capacity(mus.len() * alphas.len() * aspects.len());
    for aspect in &aspects {
        for alpha in &alphas {
            let alpha = [(alpha / aspect).max(FLOOR), (alpha * aspect).max(FLOOR)];
            places.extend(mus.iter().map(|mu| Place { alpha, mu: *mu, phi: None }));
        }
    }
    many(path, smith, &places, tolerance)
}

fn sampled(spec: &Spec) -> Result<(Vec<Table>, Made), BuildError> {
    let texels = path_tracer(Path::Best, spec.smith, SAMPLED)?;
    let made = Made { evaluations: texels.evaluations, integration: texels.worst };
    Ok((spec.tables(QUANTITY, &axes(), vec![vec![Channel::new("E", texels.e)]])?, made))
}

fn optimised(spec: &Spec) -> Result<(Vec<Table>, Made), BuildError> {
    let Spec { smith, region, .. } = spec;
    let axes = aniso_axes(spec.sizes()?, region.roughness, region.slices()?.range);
    let nodes = alpha_nodes(region.roughness.map(|r| region.alpha_map.alpha(r)));
    let plan = TexelPlan::new(axes.clone(), region.alpha_map, SAMPLES, nodes, region.mu[0]);
    let views: Vec<View> = plan.points().iter().map(view).collect();
    let (e, made) = energies(*smith, &views, false, TARGETS)?;
    let wanted = plan.targets(&e.iter().map(|e| 1.0 - e).collect::<Vec<f64>>());
    let checked = check(QUANTITY, &plan, CHECKED, [&wanted], |nodes| direct(*smith, nodes))?;
    let texels = plan.optimised(&wanted, ROUNDS).0;
    let made =
        Made { evaluations: made.evaluations + checked.evaluations, integration: checked.worst + DIRECT };
    Ok((spec.tables(QUANTITY, &axes, vec![vec![Channel::new("loss", texels)]])?, made))
}

fn view(node: &Node) -> View {
    View { alpha: node.alpha, aspect: aspect(node.slice), mu: node.mu, phi: 0.0 }
}

/// Losses, within [`DIRECT`], and the evaluations that they took.
fn direct(smith: Smith, nodes: &[Node]) -> Result<(Vec<[f64; 1]>, u64), IntegrateError> {
    let loss = |node: &Node| one(Path::Best, smith, &view(node).place(false), DIRECT);
    let all: Vec<_> = nodes.par_iter().map(loss).collect::<Result<_, IntegrateError>>()?;
    let evaluations = all.iter().map(|work| work.evaluations).sum();
    Ok((all.into_iter().map(|work| [1.0 - work.value]).collect(), evaluations))
}

/// The cubic of the azimuth at every texel, from exact values.
fn with_azimuth(spec: &Spec) -> Result<(Vec<Table>, Made), BuildError> {
    let (Spec { smith, region, .. }, size) = (spec, spec.sizes::<3>()?);
    let axes = azimuth_axes(size, region.roughness, region.slices()?.range);
    let surface = Surface::<f64>::rough(0.0);
    let rows: Vec<f64> = (0..size[1]).map(|i| region.alpha_map.alpha(axes[1].node(i, surface))).collect();
    let aspects: Vec<f64> = (0..size[2]).map(|i| aspect(axes[2].node(i, surface))).collect();
    // Below the region's mu a lookup at its edge still blends with a texel.
    let lowest = 0.25 * region.mu[0];
    let mut views = Vec::new();
    for &aspect in &aspects {
        for &alpha in &rows {
            let lobe = Azimuth { alpha, aspect };
            for column in 0..size[0] {
                views.extend(Azimuth::samples().into_iter().map(|t| {
                    let mu = node(&axes[0], column, lobe.alpha(t)).clamp(lowest, 1.0);
                    View { alpha, aspect, mu, phi: lobe.phi(t) }
                }));
            }
        }
    }
    let (e, made) = energies(*smith, &views, true, AZIMUTH)?;
    let losses: Vec<f64> = e.into_iter().map(|e| 1.0 - e).collect();
    let cubics: Vec<[f64; 4]> = losses.chunks(Azimuth::samples().len()).map(Azimuth::cubic).collect();
    let channel = |k: usize| Channel::new(&format!("c{k}"), cubics.iter().map(|cubic| cubic[k]).collect());
    let channels = (0..4).map(channel).collect();
    Ok((spec.tables(QUANTITY, &axes, vec![channels])?, made))
}

/// mu of a column where the alpha towards the view is `towards`.
fn node(columns: &Axis, column: usize, towards: f64) -> f64 {
    columns.node(column, Surface::<f64>::rough(towards))
}
